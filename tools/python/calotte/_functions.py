# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of the package."""
from __future__ import annotations

import contextlib
import math
import os
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments, _calotte, _display
from ._arguments import EARTH_RADIUS_KM
from ._calotte import (CellWidth, Check, Density, Error, Mesh, OperatorErrors, PlanarDomain,
                       PlanarMesh, Polygons, Quality, Region, Voronoi)

Array = NDArray[np.float64]
Path = str | os.PathLike[str]
Grid = Mesh | PlanarMesh | Polygons
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


def content_of(grid):
    """What came from a file with a mesh or polygons, or None."""
    return vars(grid).get("_content")


def voronoi(mesh: Grid, domain: DomainLike | None = None) -> Voronoi:
    """The Voronoi cells of a mesh: of the sphere, of a periodic box, or of a plane in a domain.

    Cell i has the entries begin[i] to begin[i + 1] of edges_on_cell, vertices_on_cell and
    cells_on_cell, counter-clockwise. Areas are steradians and lengths radians, in the plane those of
    the points' unit.

    mesh: what read() returns of a part of the sphere, such as an ocean or a limited area, has the
        cells of its file. The cells of other sites in a hemisphere reach round the far side of the
        sphere. Polygons that are no Voronoi cells raise Error; they have areas and corners.
    domain: of a planar mesh, which clips its cells.

    >>> cells = voronoi(delaunay(fibonacci_sphere(500)))
    >>> bool(abs(cells.cell_area.sum() - 4 * math.pi) < 1e-12)
    True
    """
    part = None if domain is None else _arguments.domain(domain)
    content = content_of(mesh)
    if isinstance(mesh, Polygons) and content is None:
        raise Error("polygons without the file that they are of have no Voronoi cells; use areas")
    if content is not None and content.polygons is not None:
        return _calotte.cells_of_file(content, mesh, part)
    if isinstance(mesh, PlanarMesh) and part is None and not mesh.period.all():
        raise Error("the cells of a bounded plane need its domain, which clips them; give domain=")
    return _calotte.voronoi(mesh) if part is None else _calotte.voronoi(mesh, part)


def _require_mesh(grid):
    """Polygons have no triangles to measure."""
    if isinstance(grid, Polygons):
        raise Error("polygons have no triangles to measure; use their areas and shapes(), or "
                    "voronoi() where they are Voronoi cells")


def check(mesh: Grid) -> Check:
    """Proves that a mesh is the Delaunay triangulation of its points, in exact arithmetic.

    Returns a Check, which is true if all laws hold; its failure names the first that does not.

    >>> bool(check(delaunay(random_sphere(100))))
    True
    """
    _require_mesh(mesh)
    return _calotte.check(mesh)


def _measured(measure, mesh, domain, density, cell_width):
    """measure(mesh, density), in the plane measure(mesh, domain, density)."""
    _require_mesh(mesh)
    widths = None if cell_width is None else _arguments.cell_width(cell_width)
    rho = _arguments.density(density, widths, isinstance(mesh, _calotte.PlanarMesh))
    if isinstance(mesh, _calotte.PlanarMesh):
        if domain is None and not mesh.period.all():
            raise Error("a planar mesh needs a domain, which clips its cells; give domain=")
        parts = periodic_box(*mesh.period) if domain is None else _arguments.domain(domain)
        return measure(mesh, parts, rho)
    return measure(mesh, rho)


def quality(mesh: Grid, *, domain: DomainLike | None = None,
            density: DensityLike | None = None, cell_width: WidthLike = None) -> Quality:
    """Measures a mesh and its Voronoi cells; see the attributes of Quality.

    density, cell_width: as for cvt(); they set what dc_over_h and excess compare with.

    A plane that ends at walls in one direction and is periodic in the other, such as a channel of a
    file, needs no domain: its whole cells are measured.

    >>> quality(delaunay(bisected_icosahedron(3))).obtuse
    0
    """
    _require_mesh(mesh)
    if isinstance(mesh, PlanarMesh) and domain is None and mesh.period.any() != mesh.period.all():
        return _calotte.open_quality(mesh)
    return _measured(_calotte.quality, mesh, domain, density, cell_width)


def operator_errors(mesh: Grid, *, domain: DomainLike | None = None,
                    density: DensityLike | None = None,
                    cell_width: WidthLike = None) -> OperatorErrors:
    """Measures the errors of the operators of a C-grid model (TRiSK) for smooth fields.

    divergence, gradient, laplacian, curl, tangential and kinetic_energy have l2, max, and the cell
    and the place of the greatest error, over the root mean square of the exact values; an attribute
    such as divergence_by_cell has the errors of all cells, NaN at a boundary. The largest
    eigenvalues of the Laplacians at cells and at vertices, over the square of the unit of length
    (on the sphere radians), bound time steps: wave_step() and diffusion_step().

    density, cell_width: as for cvt(); they weight the centroids of off_centroid.

    >>> operator_errors(delaunay(bisected_icosahedron(3))).gradient.l2 < 0.01
    True
    """
    return _measured(_calotte.operator_errors, mesh, domain, density, cell_width)


# ---- Centroidal Voronoi tessellations

@dataclass(frozen=True, repr=False)
class Cvt:
    """A centroidal Voronoi tessellation: its mesh, and the course of its run, of cvt().

    mesh: the Delaunay triangulation of the generators.
    converged: whether the norm fell below the tolerance.
    well_centred: whether all shapes are within the limits of models.
    misshapen_cells: number of cells beyond them, where that was asked for.
    worst_cell: the cell farthest beyond them; -1 for none.
    residual: the norm at the end, relative to the spacing of the cells.
    energy: at the end: integral of density times squared distance from the generator.
    iterations: their number, on all levels.
    seconds: of wall-clock time.
    energies: by iteration.
    norms: by iteration, l2-scaled.
    domain: of the plane, which clips the cells.
    """

    mesh: Mesh | PlanarMesh
    converged: bool
    well_centred: bool
    misshapen_cells: int
    worst_cell: int
    residual: float
    energy: float
    iterations: int
    seconds: float
    energies: Array
    norms: Array
    domain: PlanarDomain | None = None

    def __repr__(self) -> str:
        end = "converged after" if self.converged else "not converged in"
        shape = ("well-centred, " if self.well_centred else
                 f"{_display.counted(self.misshapen_cells, 'misshapen cell')}, "
                 if self.misshapen_cells else "")
        return (f"<calotte.Cvt: {_display.counted(len(self.mesh), 'cell')}, {end} "
                f"{_display.counted(self.iterations, 'iteration')}, {shape}residual "
                f"{self.residual:.2g}>")

    def _repr_html_(self) -> str:
        rows = [(name, getattr(self, name), "") for name in
                ("converged", "well_centred", "misshapen_cells", "worst_cell", "residual",
                 "energy", "iterations", "seconds")]
        return self.mesh._repr_html_() + _display.table(repr(self).strip("<>"), rows)

    def plot(self, field: Any = None, **options: Any) -> Any:
        """Draws the cells; see Mesh.plot()."""
        if self.domain is not None:
            options.setdefault("domain", self.domain)
        return self.mesh.plot(field, **options)

    def voronoi(self) -> Voronoi:
        """The Voronoi cells; see voronoi()."""
        return voronoi(self.mesh, self.domain)


@dataclass(frozen=True)
class Plan:
    """What widths demand, before a mesh is made, of plan().

    cells: their number.
    least_km: the least width, km.
    greatest_km: the greatest width, km.
    gradient: the largest, km per km; most models need less than 0.03.
    steepest: longitude and latitude of it, degrees.
    """

    cells: int
    least_km: float
    greatest_km: float
    gradient: float
    steepest: tuple[float, float]


def plan(cell_width: WidthLike, *, region: RegionLike | None = None,
         earth_radius: float = EARTH_RADIUS_KM) -> Plan:
    """What cell widths demand: cells, range and largest gradient. Arguments as for cvt().

    >>> plan(120.0).cells
    40962
    """
    part = _arguments.region(region, earth_radius)
    widths = _arguments.cell_width(cell_width, earth_radius, part)
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
    usual = (_calotte.insertion_rounds_beside_fixed if options.fixed
             else _calotte.usual_insertion_rounds)
    options.insertion_rounds = usual if insertion_rounds is None else insertion_rounds


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
        domain: DomainLike | None = None, fixed: ArrayLike | None = None, seed: int = 1,
        method: str = "auto", norm: str = "l2-scaled", tolerance: float | None = None, max_iterations: int = 1000,
        well_centred: bool | None = None, least_spacing: float = 0.8,
        insertion_rounds: int | None = None, regions: int | None = None,
        progress: Progress | bool | None = None,
        earth_radius: float = EARTH_RADIUS_KM) -> Cvt:
    """A centroidal Voronoi tessellation of the sphere, of a region, or of a planar domain.

    start: the number of cells; or the generators at the start, as points of delaunay(); or None,
        where cell_width gives the number.
    density: "uniform"; "x8", the paper's bump with an eightfold contrast of widths;
        "tanh:lon=270,lat=30,beta=30deg,alpha=0.2,gamma=x8"; several such names, of which the
        maximum counts; the result of density(); or a function of k x 3 unit vectors (in a domain
        k x 2 places, z = 0) that returns k densities.
    cell_width: in km, in place of a density: a number; text with a unit, "60km" or "60000m";
        (values, longitudes, latitudes) in degrees; an xarray.DataArray over lat and lon, in km or
        in the length of its attribute units; a file as `calotte cvt --cell-width` reads it; or a
        function of arrays of longitudes and latitudes, which is sampled every quarter of a degree.
    region: a part of the sphere, of circle(), ellipse(), channel() or polygon(); text as of
        `calotte cvt --region`, such as "circle=-105,40,1000km"; or a file.
    domain: a part of the plane, of rectangle(), periodic_box(), planar_polygon() or a file.
    fixed: generators that stay, as points of delaunay(); the first cells of the result. A number of
        cells includes them, points of the start do not; without a number, free ones are added where
        the fixed ones leave the widths unmet.
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
        return _planar_cvt(start, _arguments.domain(domain), density, fixed, seed,
                           (method, norm, tolerance, max_iterations, least_spacing), well_centred,
                           insertion_rounds, regions, progress)
    part = _arguments.region(region, earth_radius)
    widths = (None if cell_width is None else
              _arguments.cell_width(cell_width, earth_radius, part))
    rho = _arguments.density(density, widths)
    stay = np.empty((0, 3)) if fixed is None else _arguments.sphere_points(fixed, "fixed points")
    if start is None:
        if widths is None:
            raise Error("give a number of cells, points, or cell widths in km")
        start = _cells_for(widths, part, earth_radius)
        if fixed is not None:
            start = _calotte.cells_beside(stay, start, rho, part)
    counted = np.ndim(start) == 0
    graded = counted and not (part.whole and rho.uniform and not len(stay))
    finish = graded if well_centred is None else well_centred
    options = _options(rho, method, norm, tolerance, max_iterations, least_spacing, finish,
                       regions)
    options.fixed = len(stay)
    if not counted:
        points = _arguments.sphere_points(start)
    elif graded:
        cells = _count(start, "the number of cells")
        points, options.bisections = _calotte.multilevel(cells, part, rho, seed, stay)
        _multilevel(options, cells, insertion_rounds)
    else:
        points, options.bisections = _calotte.continuation(_count(start, "the number of cells"),
                                                           rho, seed)
    points = np.concatenate([stay, points])
    result, report = _calotte.cvt(points, part, options, _reporting(progress))
    return Cvt(result, **report)


def _planar_cvt(start, parts, density, fixed, seed, words, well_centred, insertion_rounds,
                regions, progress):
    if start is None:
        raise Error("give a number of cells, or places in the domain")
    rho, counted = _arguments.density(density, plane=True), np.ndim(start) == 0
    stay = np.empty((0, 2)) if fixed is None else _arguments.plane_points(fixed, "fixed points")
    graded = counted and not (rho.uniform and not len(stay))
    options = _options(rho, *words,
                       graded if well_centred is None else well_centred, regions)
    options.fixed = len(stay)
    if not counted:
        places = _arguments.plane_points(start)
    elif graded:
        cells = _count(start, "the number of cells")
        places, options.bisections = _calotte.multilevel_in_plane(cells, parts, rho, seed, stay)
        _multilevel(options, cells, insertion_rounds)
    else:
        places = _calotte.random_places(_count(start, "the number of cells"), parts, rho, seed)
    places = np.concatenate([stay, places])
    result, report = _calotte.cvt_in_plane(places, parts, options, _reporting(progress))
    return Cvt(result, **report, domain=parts)


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
                                  _arguments.density(density, plane=True), seed)


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

def circle(centre: ArrayLike, radius: float | str, corners: int = 360, *,
           earth_radius: float = EARTH_RADIUS_KM) -> Region:
    """The region around a centre (longitude and latitude in degrees, or a vector).

    radius: degrees, or text with a unit: "1000km", "500000m", "10deg". earth_radius: km, for these.

    >>> round(circle((-105, 40), 10).area, 3), round(circle((-105, 40), "1000km").area, 3)
    (0.095, 0.077)
    """
    return _calotte.circle(_arguments.direction(centre, "the centre"),
                           _arguments.angle(radius, "the radius", earth_radius), corners)


def ellipse(centre: ArrayLike, semi_major: float | str, semi_minor: float | str,
            bearing: float = 0.0, corners: int = 360, *,
            earth_radius: float = EARTH_RADIUS_KM) -> Region:
    """The region in an ellipse.

    semi_major, semi_minor: as the radius of circle(). bearing: of the major axis, degrees clockwise
    from north.
    """
    axes = [_arguments.angle(size, "a semi-axis", earth_radius)
            for size in (semi_major, semi_minor)]
    return _calotte.ellipse(_arguments.direction(centre, "the centre"), *axes,
                            math.radians(bearing), corners)


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


def density(*names: str, join: str = "maximum", plane: bool = False) -> Density:
    """A density of bumps by their names, as `calotte cvt --density` has them.

    names: "x8", or "tanh:lon=270,lat=30,beta=30deg,alpha=0.2,gamma=x8", with stretch and azimuth for
        an ellipse. With plane: "tanh:x=3,y=4,beta=1.5,alpha=0.5,gamma=x8", with stretch and angle.
    join: the "maximum" of several, or their "sum".

    >>> density("x8").uniform
    False
    """
    if not names:
        raise Error("give the name of a bump, such as x8")
    return _arguments.bumps(names, join, plane)


# ---- Files

def read(path: Path, *, fields: str = "scalars") -> Grid:
    """What a file holds, of any format that `calotte convert` reads.

    fields: which of the file's fields to read: "scalars", those with one number for each cell;
        "all", or "none". They are the attribute `fields`, and written files get them again.
    Returns a Mesh or a PlanarMesh, whose attribute `cells` has the file's cells where these are not
    the Voronoi cells of a whole mesh; or Polygons, where the file has no triangles for its cells.
    Raises Error, naming the line or the variable.
    """
    if fields not in ("scalars", "all", "none"):
        raise Error(f"fields is {fields!r}; give scalars, all or none")
    grid, content = _read(path, fields)
    grid._content = content
    return grid


def _read(path, fields):
    return _calotte.read(str(path), fields)


def read_fields(path: Path) -> dict[str, Array]:
    """The numbers at the cells of a file: a dict of arrays in the order of read()'s sites."""
    return dict(_read(path, "scalars")[1].fields)


def read_points(path: Path) -> Array:
    """The sites of a mesh file, n x 3, without its triangles."""
    return _calotte.read_points(str(path))


def write(path: Path, mesh: Grid, *, format: str = "by-name",
          sphere_radius: float | None = None, density: DensityLike | None = None,
          cell_width: WidthLike = None, domain: DomainLike | None = None,
          fields: Mapping[str, ArrayLike] | None = None, history: str = "") -> None:
    """Writes a mesh in the format of the name (.nc: MPAS, .vtp, .geojson ...), or as `format`.

    mesh: of read(), with its cells and fields, or of another function.
    sphere_radius: of NetCDF files, metres. MPAS-Atmosphere needs 1, MPAS-Ocean 6371220. Default:
        that of a file that was read, else 1.
    density, cell_width: as for cvt(); they set meshDensity and nominalMinDc. Without them the density
    of an MPAS file on the sphere follows from the smoothed spacing of the cells, if this varies.
    domain: of a planar mesh, which clips its cells. Its meshDensity follows from a density with it.
    fields: a dict of n numbers at the cells, beside those that were read.
    """
    widths = None if cell_width is None else _arguments.cell_width(cell_width)
    values = {name: _arguments.numbers(value, name) for name, value in (fields or {}).items()}
    output = _calotte.Output(str(path), format, sphere_radius,
                             _arguments.density(density, widths, isinstance(mesh, PlanarMesh)),
                             density is not None or cell_width is not None, values, history)
    part = None if domain is None else _arguments.domain(domain)
    content = content_of(mesh)
    if content is not None:
        names = _calotte.write_content(content, mesh, part, output)
        dropped = [name for name in names if name in content.fields or name in values]
        if dropped:
            warnings.warn(f"{path}: the format does not hold {', '.join(dropped)}", stacklevel=2)
    elif isinstance(mesh, Polygons):
        raise Error("polygons without the file that they are of cannot be written; give what "
                    "read() returns")
    elif isinstance(mesh, PlanarMesh):
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
    part = _arguments.region(region, earth_radius)
    widths = _arguments.cell_width(cell_width, earth_radius, part)
    meshed = _calotte.with_rings(part, widths, earth_radius)
    grid = cvt(cell_width=widths, region=meshed, earth_radius=earth_radius, **options)
    output = _calotte.Output(str(path), "mpas", sphere_radius, _arguments.density(None, widths),
                             True, {}, "")
    return _calotte.write_limited_area(output, grid.mesh.points, meshed, part)


def _files(value):
    """The names of one file or of several."""
    if value is None:
        return []
    if isinstance(value, (str, os.PathLike)):
        return [str(value)]
    return [str(path) for path in value]


def cull(source: Path, target: Path, *, land: Path | Sequence[Path] | None = None,
         coast: Path | None = None, raster: Path | None = None, raster_variable: str = "",
         raster_values: str = "height", land_fraction: float = 0.5, field: str = "",
         field_file: Path | None = None, sea_below: float | None = None,
         sea_from: float | None = None, passages: Path | Sequence[Path] | None = None,
         barriers: Path | Sequence[Path] | None = None, fill: bool = True, seeds: ArrayLike = (),
         mask: Path | None = None, cell_map: Path | None = None,
         sphere_radius: float | None = None) -> dict[str, Any]:
    """Leaves the cells of land out of an MPAS file; all fields go along. Returns a dict of counts.

    land: GeoJSON of land, or a binned file of GSHHG; one or several. coast: an older name of it.
    raster: a NetCDF raster raster_variable(lat, lon), whose raster_values are "height" (below 0 is
        sea), "sea-fraction" or "land-fraction".
    land_fraction: cells with a larger fraction of land are land.
    field: a variable with a number for each cell; from sea_from to below sea_below is sea (default
        below 0). field_file: its NetCDF file; default the source.
    passages, barriers: GeoJSON of lines whose cells are sea or land; one file or several.
    fill: cells with a single neighbour in the sea become land.
    seeds: places in the sea, longitude and latitude in degrees; default its largest part.
    mask: NetCDF file for masks by cell of the source. cell_map: folder for maps of cell numbers.
    sphere_radius: of the new file, metres; default that of the source.
    """
    if raster is not None and not raster_variable:
        raise Error(f"{raster}: give the name of its variable as raster_variable")
    if raster_values not in ("height", "sea-fraction", "land-fraction"):
        raise Error(f"raster_values is {raster_values!r}; give height, sea-fraction or "
                    "land-fraction")
    places = np.asarray(seeds, dtype=float).reshape(-1, 2 if np.size(seeds) % 2 == 0 else 3)
    words = {"land": _files(land) + _files(coast), "passages": _files(passages),
             "barriers": _files(barriers), "raster": "" if raster is None else str(raster),
             "raster_variable": raster_variable, "raster_values": raster_values, "field": field,
             "field_file": "" if field_file is None else str(field_file), "sea_from": sea_from,
             "sea_below": sea_below, "land_fraction": land_fraction}
    return _calotte.cull(str(source), str(target), words, fill,
                         _arguments.sphere_points(places, "seeds"),
                         "" if mask is None else str(mask),
                         "" if cell_map is None else str(cell_map), sphere_radius)
