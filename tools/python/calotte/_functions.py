# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of the package."""
import contextlib
import math
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments, _calotte
from ._arguments import EARTH_RADIUS_KM
from ._calotte import (CellWidth, Check, Density, Error, Mesh, OperatorErrors, PlanarDomain,
                       PlanarMesh, Quality, Region, Voronoi)

Array = NDArray[np.float64]
Path = str | os.PathLike[str]
DensityLike = str | Density | Callable[[Array], ArrayLike]
WidthLike = Any  #: a number, a file, (values, lon, lat), a DataArray or a function
RegionLike = Path | Region
DomainLike = Path | PlanarDomain
Progress = Callable[[dict[str, Any]], "bool | None"]

_METHODS = {"auto": _calotte.Method.automatic, "lloyd": _calotte.Method.lloyd,
            "nesterov": _calotte.Method.nesterov, "lbfgs": _calotte.Method.lbfgs,
            "lbfgs-laplacian": _calotte.Method.lbfgs_laplacian}
_NORMS = {"l2": _calotte.Norm.l2, "linf": _calotte.Norm.linf, "l2-scaled": _calotte.Norm.l2_scaled,
          "linf-scaled": _calotte.Norm.linf_scaled, "gradient": _calotte.Norm.gradient}


def _choice(words, word, what):
    try:
        return words[word]
    except (KeyError, TypeError):
        raise Error(f"no {what} {word}; give one of: {', '.join(words)}") from None


def _count(value, what):
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
        return int(value)
    raise Error(f"{what} is {value!r}; give a whole number")


@contextlib.contextmanager
def threads(count: int) -> Iterator[None]:
    """The number of threads of calls in a `with` block, in this Python thread.

    >>> with threads(2):
    ...     mesh = delaunay(random_sphere(1000))
    """
    if _count(count, "the number of threads") < 1:
        raise Error(f"the number of threads is {count}; give 1 or more")
    before = _calotte.set_threads(count)
    try:
        yield
    finally:
        _calotte.set_threads(before)


# ---- Triangulations

def delaunay(points: ArrayLike, *, plane: bool = False, period: ArrayLike | None = None,
             merge_within: float = 0.0, duplicates: str = "merge",
             regions: int | None = None) -> Mesh | PlanarMesh:
    """The Delaunay triangulation of points on the sphere, or in the plane.

    points: n x 3 directions of any length, or n x 2 longitudes and latitudes in degrees; with
        plane or period, n x 2 places in any unit.
    plane: triangulate the convex hull of places in the plane.
    period: the side lengths (x, y) of a doubly periodic box.
    merge_within: points nearer than this become one; radians, in the plane the unit of the points.
    duplicates: "merge" makes one site of equal points; "refuse" raises an error for them.
    regions: the number of parts that are triangulated in parallel; no effect on the result.
    Returns a Mesh, or a PlanarMesh. Raises Error.

    >>> mesh = delaunay(random_sphere(1000))
    >>> mesh.triangles.shape
    (1996, 3)
    """
    if duplicates not in ("merge", "refuse"):
        raise Error(f"duplicates is {duplicates!r}; give merge or refuse")
    merge = duplicates == "merge"
    if not plane and period is None:
        sites = _arguments.sphere_points(points)
        return _calotte.delaunay(sites, merge_within, merge, regions)
    places = _arguments.plane_points(points)
    return _calotte.delaunay_in_plane(places, period, merge_within, merge, regions)


def voronoi(mesh: Mesh | PlanarMesh, domain: DomainLike | None = None) -> Voronoi:
    """The Voronoi cells of a closed mesh, of a periodic box, or of a planar mesh in a domain.

    Cell i has the entries begin[i] to begin[i + 1] of edges_on_cell, vertices_on_cell and
    cells_on_cell, counter-clockwise. Areas are steradians and lengths radians, in the plane those of
    the points' unit.

    >>> cells = voronoi(delaunay(fibonacci_sphere(500)))
    >>> bool(abs(cells.cell_area.sum() - 4 * math.pi) < 1e-12)
    True
    """
    if domain is None:
        return _calotte.voronoi(mesh)
    return _calotte.voronoi(mesh, _arguments.domain(domain))


def check(mesh: Mesh | PlanarMesh) -> Check:
    """Proves that a mesh is the Delaunay triangulation of its points, in exact arithmetic.

    Returns a Check, which is true if all laws hold; its failure names the first that does not.

    >>> bool(check(delaunay(random_sphere(100))))
    True
    """
    return _calotte.check(mesh)


def _measured(measure, mesh, domain, density, cell_width):
    """measure(mesh, density), in the plane measure(mesh, domain, density)."""
    widths = None if cell_width is None else _arguments.cell_width(cell_width)
    rho = _arguments.density(density, widths)
    if isinstance(mesh, _calotte.PlanarMesh):
        if domain is None and not mesh.period.any():
            raise Error("a planar mesh needs a domain, which clips its cells; give domain=")
        parts = periodic_box(*mesh.period) if domain is None else _arguments.domain(domain)
        return measure(mesh, parts, rho)
    return measure(mesh, rho)


def quality(mesh: Mesh | PlanarMesh, *, domain: DomainLike | None = None,
            density: DensityLike | None = None, cell_width: WidthLike = None) -> Quality:
    """Measures a mesh and its Voronoi cells; see the attributes of Quality.

    density, cell_width: as for cvt(); they set what dc_over_h and excess compare with.

    >>> quality(delaunay(bisected_icosahedron(3))).obtuse
    0
    """
    return _measured(_calotte.quality, mesh, domain, density, cell_width)


def operator_errors(mesh: Mesh | PlanarMesh, *, domain: DomainLike | None = None,
                    density: DensityLike | None = None,
                    cell_width: WidthLike = None) -> OperatorErrors:
    """Measures the errors of the operators of a C-grid model (TRiSK) for smooth fields.

    divergence, gradient, laplacian, curl, tangential and kinetic_energy have l2, max, and the cell
    and the place of the greatest error, over the root mean square of the exact values; an attribute
    such as divergence_by_cell has the errors of all cells, NaN at a boundary. The largest
    eigenvalues of the Laplacians at cells and at vertices, over the square of the unit of length
    (on the sphere radians), bound time steps: sqrt(8 / primal_eigenvalue) / c for gravity waves of
    the speed c with a Runge-Kutta method of order 4.

    density, cell_width: as for cvt(); they weight the centroids of off_centroid.

    >>> operator_errors(delaunay(bisected_icosahedron(3))).gradient.l2 < 0.01
    True
    """
    return _measured(_calotte.operator_errors, mesh, domain, density, cell_width)


# ---- Centroidal Voronoi tessellations

@dataclass(frozen=True)
class Cvt:
    """A centroidal Voronoi tessellation: its mesh, and the course of its run."""

    mesh: Mesh | PlanarMesh
    converged: bool
    well_centred: bool
    residual: float  #: the norm at the end
    energy: float  #: at the end
    iterations: int
    seconds: float
    energies: Array  #: by iteration
    norms: Array  #: by iteration, l2-scaled


@dataclass(frozen=True)
class Plan:
    """What widths demand, before a mesh is made."""

    cells: int
    least_km: float
    greatest_km: float
    gradient: float  #: the largest, km per km; most models need less than 0.03
    steepest: tuple[float, float]  #: longitude and latitude of it, degrees


def plan(cell_width: WidthLike, *, region: RegionLike | None = None,
         earth_radius: float = EARTH_RADIUS_KM) -> Plan:
    """What cell widths demand: cells, range and largest gradient. Arguments as for cvt().

    >>> plan(120.0).cells
    40962
    """
    widths = _arguments.cell_width(cell_width, earth_radius)
    part = _arguments.region(region)
    slope, longitude, latitude = _calotte.largest_gradient(widths, earth_radius)
    return Plan(_cells_for(widths, part, earth_radius), float(widths.widths.min()),
                float(widths.widths.max()), slope, (longitude, latitude))


def _cells_for(widths, part, earth_radius):
    implied = round(_calotte.implied_cells(widths, part, earth_radius))
    if not 12 <= implied <= 2**30:
        raise Error(f"the widths require {implied:.4g} cells, but a grid has 12 to 1073741824; give "
                    "widths in km")
    if part.whole and np.ptp(widths.widths) == 0:
        return _calotte.geodesic_count(implied)
    return implied


def _options(rho, method, norm, tolerance, max_iterations, least_spacing, well_centred, regions):
    options = _calotte.CvtOptions()
    options.density = rho
    options.method = _choice(_METHODS, method, "method")
    options.norm = _choice(_NORMS, norm, "norm")
    options.well_centred = well_centred
    options.least_spacing = least_spacing
    if tolerance is not None:
        options.tolerance = tolerance
    elif well_centred:
        options.tolerance = _calotte.tolerance_before_finish
    options.max_iterations = max_iterations
    options.regions = regions
    return options


def _multilevel(options, cells, insertion_rounds):
    options.cells = cells
    options.insertion_rounds = (_calotte.usual_insertion_rounds if insertion_rounds is None
                                else insertion_rounds)


def _reporting(progress):
    """The caller's function, or for True a bar of tqdm."""
    if progress is not True:
        return progress
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise Error("progress=True needs tqdm; install it, or give a function") from None
    bar = tqdm(unit=" iterations")

    def show(now):
        bar.update(now["iterations"] - bar.n)
        bar.set_postfix(cells=now["cells"], residual=f"{now['residual']:.2g}")

    return show


def cvt(start: int | ArrayLike | None = None, *, density: DensityLike | None = None,
        cell_width: WidthLike = None, region: RegionLike | None = None,
        domain: DomainLike | None = None, seed: int = 1, method: str = "auto",
        norm: str = "l2-scaled", tolerance: float | None = None, max_iterations: int = 1000,
        well_centred: bool | None = None, least_spacing: float = 0.8,
        insertion_rounds: int | None = None, regions: int | None = None,
        progress: Progress | bool | None = None,
        earth_radius: float = EARTH_RADIUS_KM) -> Cvt:
    """A centroidal Voronoi tessellation of the sphere, of a region, or of a planar domain.

    start: the number of cells; or the generators at the start, as points of delaunay(); or None,
        where cell_width gives the number.
    density: "uniform"; "x8", the paper's bump with an eightfold contrast of widths;
        "tanh:lon=270,lat=30,beta=30deg,alpha=0.2,gamma=x8"; or a function of k x 3 unit vectors (in
        a domain k x 2 places, z = 0) that returns k densities.
    cell_width: in km, in place of a density: a number; (values, longitudes, latitudes) in degrees;
        an xarray.DataArray over lat and lon; a file as `calotte cvt --cell-width` reads it; or a
        function of arrays of longitudes and latitudes, which is sampled every quarter of a degree.
    region: a part of the sphere, of circle(), ellipse(), channel(), polygon() or a file.
    domain: a part of the plane, of rectangle(), periodic_box(), planar_polygon() or a file.
    seed: of random points. method: auto, lloyd, nesterov, lbfgs or lbfgs-laplacian.
    norm: that is compared with the tolerance: l2, linf, l2-scaled, linf-scaled or gradient.
    tolerance: default 1e-6, and 1e-4 with well_centred.
    max_iterations: on each level.
    well_centred: without obtuse triangles and short Voronoi edges, as models need. Default: where a
        density or widths are given with a number of cells.
    least_spacing: with well_centred, the least distance of neighbours over the demanded width, 0 to
        0.95.
    insertion_rounds: default as `calotte cvt`. regions: parts that run in parallel.
    progress: a function that receives a dict after each iteration and ends the run by returning
        True; or True for a bar of tqdm.
    Returns a Cvt. A run that does not converge is no error. Raises Error.

    >>> grid = cvt(642)
    >>> grid.converged, len(grid.mesh)
    (True, 642)
    """
    if domain is not None:
        if region is not None or cell_width is not None:
            raise Error("a domain of the plane has no region and no cell widths in km; give a "
                        "density")
        return _planar_cvt(start, _arguments.domain(domain), density, seed,
                           (method, norm, tolerance, max_iterations, least_spacing), well_centred,
                           insertion_rounds, regions, progress)
    widths = None if cell_width is None else _arguments.cell_width(cell_width, earth_radius)
    rho, part = _arguments.density(density, widths), _arguments.region(region)
    if start is None:
        if widths is None:
            raise Error("give a number of cells, points, or cell widths in km")
        start = _cells_for(widths, part, earth_radius)
    counted = np.ndim(start) == 0
    graded = counted and not (part.whole and rho.uniform)
    finish = graded if well_centred is None else well_centred
    options = _options(rho, method, norm, tolerance, max_iterations, least_spacing, finish,
                       regions)
    if not counted:
        points = _arguments.sphere_points(start)
    elif graded:
        cells = _count(start, "the number of cells")
        points, options.bisections = _calotte.multilevel(cells, part, rho, seed)
        _multilevel(options, cells, insertion_rounds)
    else:
        points, options.bisections = _calotte.continuation(_count(start, "the number of cells"),
                                                           rho, seed)
    result, report = _calotte.cvt(points, part, options, _reporting(progress))
    return Cvt(result, **report)


def _planar_cvt(start, parts, density, seed, words, well_centred, insertion_rounds, regions,
                progress):
    if start is None:
        raise Error("give a number of cells, or places in the domain")
    rho, counted = _arguments.density(density), np.ndim(start) == 0
    graded = counted and not rho.uniform
    options = _options(rho, *words,
                       graded if well_centred is None else well_centred, regions)
    if not counted:
        places = _arguments.plane_points(start)
    elif graded:
        cells = _count(start, "the number of cells")
        places, options.bisections = _calotte.multilevel_in_plane(cells, parts, rho, seed)
        _multilevel(options, cells, insertion_rounds)
    else:
        places = _calotte.random_places(_count(start, "the number of cells"), parts, rho, seed)
    result, report = _calotte.cvt_in_plane(places, parts, options, _reporting(progress))
    return Cvt(result, **report)


# ---- Points

def random_sphere(n: int, *, density: DensityLike | None = None, region: RegionLike | None = None,
                  seed: int = 1) -> Array:
    """Independent random points, n x 3 unit vectors, that follow a density, inside a region.

    >>> random_sphere(3).shape
    (3, 3)
    """
    return _calotte.random_sphere(_count(n, "the number of points"), _arguments.region(region),
                                  _arguments.density(density), seed)


def fibonacci_sphere(n: int) -> Array:
    """The Fibonacci lattice, n x 3, from north to south."""
    return _calotte.fibonacci_sphere(_count(n, "the number of points"))


def spiral_sphere(n: int) -> Array:
    """The spiral of Rakhmanov, Saff and Zhou (1994), n x 3, from south to north."""
    return _calotte.spiral_sphere(_count(n, "the number of points"))


def geodesic_sphere(n: int) -> Array:
    """n points, 12 of which have five neighbours and all others six, after a uniform cvt().

    Any number of at least 12 but 13.

    >>> geodesic_sphere(1000).shape
    (1000, 3)
    """
    return _calotte.geodesic_sphere(_count(n, "the number of points"))


def bisected_icosahedron(level: int) -> Array:
    """The icosahedron with every edge bisected `level` times: 10 * 4^level + 2 points."""
    return _calotte.bisected_icosahedron(_count(level, "the level"))


def lat_lon_sphere(latitudes: int, longitudes: int, *, poles: bool = False) -> Array:
    """A regular grid of latitudes x longitudes points, with the poles if wanted."""
    return _calotte.lat_lon_sphere(latitudes, longitudes, poles)


def cubed_sphere(m: int) -> Array:
    """The centres of the 6 m^2 cells of the equiangular cubed sphere."""
    return _calotte.cubed_sphere(m)


def random_places(n: int, domain: DomainLike, *, density: DensityLike | None = None,
                  seed: int = 1) -> Array:
    """Independent random places in a domain of the plane, n x 2."""
    return _calotte.random_places(_count(n, "the number of places"), _arguments.domain(domain),
                                  _arguments.density(density), seed)


def hexagonal_lattice(n: int, domain: DomainLike) -> Array:
    """A hexagonal lattice of about n places in a domain of the plane."""
    return _calotte.hexagonal_lattice(_count(n, "the number of places"),
                                      _arguments.domain(domain))


def bisect(mesh: Mesh) -> Array:
    """The points of a mesh and the midpoints of its edges, (4 n - 6) x 3.

    >>> bisect(delaunay(bisected_icosahedron(0))).shape
    (42, 3)
    """
    return mesh.bisected_points()


def from_lonlat(longitudes: ArrayLike, latitudes: ArrayLike) -> Array:
    """Unit vectors, n x 3, at longitudes and latitudes in degrees."""
    pairs = np.stack(np.broadcast_arrays(longitudes, latitudes), axis=-1)
    return _calotte.from_lonlat(_arguments.numbers(np.atleast_2d(pairs), "places"))


def to_lonlat(points: ArrayLike) -> Array:
    """Longitudes (-180 to 180) and latitudes in degrees, n x 2, of directions."""
    return _calotte.to_lonlat(_arguments.sphere_points(points))


# ---- Regions and domains

def circle(centre: ArrayLike, radius: float, corners: int = 360) -> Region:
    """The region within an angle (degrees) of a centre (longitude and latitude, or a vector).

    >>> round(circle((-105, 40), 10).area, 3)
    0.095
    """
    return _calotte.circle(_arguments.direction(centre, "the centre"), math.radians(radius),
                           corners)


def ellipse(centre: ArrayLike, semi_major: float, semi_minor: float, bearing: float = 0.0,
            corners: int = 360) -> Region:
    """The region in an ellipse; its axes and bearing (clockwise from north) in degrees."""
    return _calotte.ellipse(_arguments.direction(centre, "the centre"), math.radians(semi_major),
                            math.radians(semi_minor), math.radians(bearing), corners)


def channel(lower: float, upper: float, corners: int = 360) -> Region:
    """The region between two latitudes in degrees."""
    return _calotte.channel(math.radians(lower), math.radians(upper), corners)


def polygon(*rings: ArrayLike, inside: ArrayLike | None = None) -> Region:
    """The region that rings enclose, each k x 2 longitudes and latitudes in degrees or k x 3.

    Rings may run either way, be closed, and reach a pole along a meridian. They enclose the side
    without poles; if both sides have one, the smaller side.

    inside: a place (longitude and latitude, or a vector) of the region, which decides instead.

    >>> round(polygon([(0, 0), (90, 0), (0, 90)]).area / (4 * math.pi), 12)
    0.125
    """
    return _calotte.polygon([_arguments.sphere_points(ring, "corners") for ring in rings],
                            None if inside is None
                            else _arguments.direction(inside, "the place inside"))


def rectangle(lower: ArrayLike, upper: ArrayLike) -> PlanarDomain:
    """The domain between two corners (x, y) of the plane."""
    return _calotte.rectangle(lower, upper)


def periodic_box(x: float, y: float) -> PlanarDomain:
    """The doubly periodic box [0, x) x [0, y) of the plane."""
    return _calotte.periodic_box([x, y])


def planar_polygon(*rings: ArrayLike) -> PlanarDomain:
    """The domain inside rings of k x 2 corners: what an odd number of them contains."""
    return _calotte.PlanarDomain([_arguments.plane_points(ring, "corners") for ring in rings])


# ---- Files

def read(path: Path) -> Mesh | PlanarMesh:
    """The mesh of a file of any format that `calotte convert` reads.

    Returns a Mesh, or a PlanarMesh. Raises Error, naming the line or the variable.
    """
    return _calotte.read(str(path))[0]


def read_fields(path: Path) -> dict[str, Array]:
    """The numbers at the cells of a file: a dict of arrays in the order of read()'s sites."""
    return _calotte.read(str(path))[1]


def read_points(path: Path) -> Array:
    """The sites of a mesh file, n x 3, without its triangles."""
    return _calotte.read_points(str(path))


def write(path: Path, mesh: Mesh | PlanarMesh, *, format: str = "by-name",
          sphere_radius: float = 1.0, density: DensityLike | None = None,
          cell_width: WidthLike = None, domain: DomainLike | None = None,
          fields: Mapping[str, ArrayLike] | None = None, history: str = "") -> None:
    """Writes a mesh in the format of the name (.nc: MPAS, .vtp, .geojson ...), or as `format`.

    sphere_radius: of NetCDF files. MPAS-Atmosphere needs 1, MPAS-Ocean metres, 6371220.
    density, cell_width: as for cvt(); they set meshDensity and nominalMinDc. Without them the density
    of an MPAS file on the sphere follows from the smoothed spacing of the cells, if this varies.
    domain: of a planar mesh, which clips its cells. Its meshDensity follows from a density with it.
    fields: a dict of n numbers at the cells.
    """
    widths = None if cell_width is None else _arguments.cell_width(cell_width)
    values = {name: _arguments.numbers(value, name) for name, value in (fields or {}).items()}
    output = _calotte.Output(str(path), format, sphere_radius,
                             _arguments.density(density, widths),
                             density is not None or cell_width is not None, values, history)
    if isinstance(mesh, _calotte.PlanarMesh):
        part = None if domain is None else _arguments.domain(domain)
        _calotte.write_in_plane(mesh, part, output)
    else:
        _calotte.write(mesh, output)


def cut(source: Path, target: Path, region: RegionLike, *, rings: int = 7,
        sphere_radius: float | None = 1.0) -> dict[str, Any]:
    """Cuts a limited-area grid out of an MPAS file; all fields go along. Returns a dict of counts.

    sphere_radius: of the new file; None keeps that of the source.
    """
    return _calotte.cut(str(source), str(target), _arguments.region(region), rings, sphere_radius)


def limited_area(path: Path, region: RegionLike, cell_width: WidthLike, *,
                 sphere_radius: float = 1.0, earth_radius: float = EARTH_RADIUS_KM,
                 **options: Any) -> dict[str, Any]:
    """Makes a limited-area grid: the cells of a region with seven rings of boundary cells around it.

    cell_width: as for cvt(). sphere_radius: of the MPAS file; the model expects 1.
    options: seed, max_iterations, regions and progress as for cvt().
    Returns a dict of counts: cells, and cells_by_mask (inside, then by ring).
    """
    widths, part = _arguments.cell_width(cell_width, earth_radius), _arguments.region(region)
    meshed = _calotte.with_rings(part, widths, earth_radius)
    grid = cvt(cell_width=widths, region=meshed, earth_radius=earth_radius, **options)
    output = _calotte.Output(str(path), "mpas", sphere_radius, _arguments.density(None, widths),
                             True, {}, "")
    return _calotte.write_limited_area(output, grid.mesh.points, meshed, part)


def cull(source: Path, target: Path, *, coast: Path | None = None, land_fraction: float = 0.5,
         passages: Path | None = None, barriers: Path | None = None, fill: bool = True,
         seeds: ArrayLike = ()) -> dict[str, Any]:
    """Leaves the cells of land out of an MPAS file; all fields go along. Returns a dict of counts.

    coast: GeoJSON of land, or a binned file of GSHHG. passages, barriers: GeoJSON of lines.
    seeds: places in the sea, longitude and latitude in degrees; default its largest part.
    """
    places = np.asarray(seeds, dtype=float).reshape(-1, 2 if np.size(seeds) % 2 == 0 else 3)
    text = [None if path is None else str(path) for path in (coast, passages, barriers)]
    return _calotte.cull(str(source), str(target), text[0], land_fraction, text[1], text[2], fill,
                         _arguments.sphere_points(places, "seeds"))
