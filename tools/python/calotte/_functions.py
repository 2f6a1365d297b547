# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of the package."""
from __future__ import annotations

import contextlib
import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments, _border, _calotte, _display, _fields, _labels, _units
from ._arguments import EARTH_RADIUS_KM
from ._calotte import (Check, Density, Error, IdLists, Locations, Mesh, OperatorErrors, Polygons,
                       Quality, Raster, Surface, Voronoi)
from ._fields import content_of
from ._objects import Geometries, LabelledRaster
from ._oceans import ClosedSea, GeneralisedSea

Array = NDArray[np.float64]
Path = str | os.PathLike[str]
Grid = Mesh | Polygons
DensityLike = str | Sequence[str] | Density | Callable[[Array], ArrayLike]
WidthLike = Any  #: a number, a file, (values, lon, lat or x, y), a DataArray or a function
SurfaceLike = Path | Surface | GeneralisedSea | Geometries
Progress = Callable[[dict[str, Any]], "bool | None"]

_USUAL = _calotte.Recipe()  #: the library's defaults


def _count(value, what):
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
        return int(value)
    raise Error(f"{what} is {value!r}; give a whole number")


@contextlib.contextmanager
def threads(count: int) -> Iterator[None]:
    """The number of threads of calls in a `with` block, in this Python thread. It has no effect without `with`.

    >>> with threads(2):
    ...     mesh = delaunay(random_points(1000))
    """
    if _count(count, "the number of threads") < 1:
        raise Error(f"the number of threads is {count}; give 1 or more")
    before = _calotte.set_threads(count)
    try:
        yield
    finally:
        _calotte.set_threads(before)


# ---- Triangulations

def delaunay(points: ArrayLike, surface: SurfaceLike | None = None, *, merge_within: float = 0.0,
             duplicates: str = "merge", regions: int | None = None) -> Mesh:
    """The Delaunay triangulation of points on the sphere, or in the plane.

    points: n x 3 directions of any length, or n x 2 longitudes and latitudes in degrees; in a plane
        n x 2, in any unit.
    surface: where the points live, as for cvt(); plane() for a plane without an end. Default: the
        sphere. Its rings clip the Voronoi cells, and have no effect on the triangles.
    merge_within: points nearer than this become one; radians, in the plane the unit of the points.
    duplicates: "merge" makes one site of equal points; "refuse" raises an error for them.
    regions: the number of parts that are triangulated in parallel; no effect on the result.
    Returns a Mesh. Raises Error.

    >>> mesh = delaunay(random_points(1000))
    >>> mesh.triangles.shape
    (1996, 3)
    """
    if duplicates not in ("merge", "refuse"):
        raise Error(f"duplicates is {duplicates!r}; give merge or refuse")
    where = _arguments.surface(surface)
    try:
        sites = _arguments.points_of(where, points)
    except Error as error:  # such as x and y in metres
        if surface is None and np.shape(points)[1:] == (2,):
            error.args = (f"{error}; or for x and y of a plane surface=, such as plane()",)
        raise
    return _calotte.delaunay(sites, where, merge_within, duplicates == "merge", regions)


def area_weights(points: ArrayLike, surface: SurfaceLike | None = None, *, edge: str | float | None = None,
                 gap: float = 4.0, merge_within: float = 0.0) -> Array:
    """The area of each point's Voronoi cell, such as the weights of the nodes of a mean or of a loss
    function. Equal points share their cell in equal parts.

    points, surface: as for delaunay(), with duplicates and in any order. Rings of the surface bound the
        cells.
    edge: where cells end at the edge of the set. "whole": nowhere, they are Voronoi cells. "hull": at the
        convex hull of the points. "neighbours": half way to their neighbours, mirrored at their point,
        where the open reaches it; cells at the edge of a lattice are as large as those inside. Or a
        distance from their point, at which all cells end: degrees, or a length such as "100km", at most
        90 degrees; in a plane a number. Default: whole if the points surround the sphere or fill a
        periodic box, else neighbours.
    gap: with "neighbours" open are triangles whose circumcircle is more than this times as wide as the
        narrowest one around each of their points. Raise it where the spacing of the points jumps.
    merge_within: points this near share a cell; as for delaunay().
    Returns n weights, in steradians or the square of the plane's unit. They sum to the area that the
    cells cover. Raises Error, with the index of a point that is wrong.

    >>> nodes = lat_lon_sphere(91, 180)
    >>> weights = area_weights(nodes)
    >>> bool(abs(weights.sum() - 4 * math.pi) < 1e-12)
    True
    """
    where = _arguments.surface(surface)
    sites = _arguments.points_of(where, points)
    if edge is None or edge in ("whole", "hull", "neighbours"):
        return _calotte.area_weights(sites, where, edge, 0.0, gap, merge_within)
    if isinstance(edge, str) and _calotte.measure_of(edge) is None:
        raise Error(f"edge is {edge!r}; give whole, hull, neighbours, or a distance such as '100km'")
    reach = _arguments.angle(edge, "edge") if where.is_sphere else _arguments.positive(edge, "edge", "units of the plane")
    return _calotte.area_weights(sites, where, "reach", reach, gap, merge_within)


def neighbours(mesh: Grid) -> IdLists:
    """The neighbours of each cell: the sites at the other ends of the edges of its own.

    mesh: of a mesh that read() returns with cells of its file, and of Polygons, the neighbours are
        those that share a side, ascending; of others they are counter-clockwise.
    Returns IdLists: neighbours(mesh)[i] is an array of the neighbours of cell i. As a sparse matrix
    they are scipy.sparse.csr_matrix((np.ones(len(ids)), ids, begin)). Raises Error.

    >>> around = neighbours(delaunay(fibonacci_sphere(1000)))
    >>> len(around), around[17].tolist()
    (1000, [4, 9, 22, 30, 38, 25, 12])
    """
    return _calotte.neighbours(content_of(mesh), mesh)


def within(mesh, surface):
    """The mesh; where a surface is given, in a plane, with its boundary."""
    if surface is None or isinstance(mesh, Polygons):
        return mesh
    if mesh.surface.is_sphere:
        raise Error("the mesh is on the sphere, and surface clips the cells of a plane; leave it out")
    return _calotte.within(mesh, _arguments.surface(surface, plane=True))


def _require_end(mesh):
    """Cells at the hull of a mesh in a plane are unbounded."""
    if mesh.surface.period.any() and not mesh.surface.period.all():
        raise Error("a mesh with one period has no Voronoi cells at its walls; give one of a "
                    "periodic box")
    if math.isinf(mesh.surface.area):
        raise Error("a mesh in a plane without an end needs a surface that clips its cells; give "
                    "surface=")


def voronoi(mesh: Grid, surface: SurfaceLike | None = None) -> Voronoi:
    """The Voronoi cells of a mesh, on its surface: the sphere, a periodic box, or a part of the
    sphere or of a plane, which clips them.

    Cell i has the entries begin[i] to begin[i + 1] of edges_on_cell, vertices_on_cell and
    cells_on_cell, counter-clockwise. Areas are steradians and lengths radians, in the plane those of
    the points' unit.

    mesh: what read() returns of a part of the sphere, such as an ocean or a limited area, has the
        cells of its file. The cells of other sites in a hemisphere reach round the far side of the
        sphere. Polygons that are no Voronoi cells raise Error; they have areas and corners.
    surface: a part of the plane, which clips the cells of a mesh there; meshes of cvt() have theirs.

    >>> cells = voronoi(delaunay(fibonacci_sphere(500)))
    >>> bool(abs(cells.cell_area.sum() - 4 * math.pi) < 1e-12)
    True
    """
    content = content_of(mesh)
    if isinstance(mesh, Polygons) and content is None:
        raise Error("polygons without the file that they are of have no Voronoi cells; use areas")
    mesh = within(mesh, surface)
    if content is not None and content.polygons is not None:
        return _calotte.cells_of_file(content, mesh)
    _require_end(mesh)
    return _calotte.voronoi(mesh)


def _require_mesh(grid):
    """Polygons have no triangles to measure."""
    if isinstance(grid, Polygons):
        raise Error("polygons have no triangles to measure; use their areas and shapes(), or "
                    "voronoi() where they are Voronoi cells")


def _density_for(grid, density, cell_width):
    """The density of a name or of widths, of the space that the grid is in."""
    plane = not grid.surface.is_sphere
    widths = (None if cell_width is None else
              _arguments.rule(cell_width, grid.surface)._field(grid.surface))
    return _arguments.density(density, widths, plane)


def check(mesh: Grid) -> Check:
    """Proves that a mesh is the Delaunay triangulation of its points, in exact arithmetic.

    Returns a Check, which is true if all laws hold; its failure names the first that does not.

    >>> bool(check(delaunay(random_points(100))))
    True
    """
    _require_mesh(mesh)
    return _calotte.check(mesh)


def quality(mesh: Grid, *, surface: SurfaceLike | None = None, density: DensityLike | None = None,
            cell_width: WidthLike = None, units: str | None = None) -> Quality:
    """Measures a mesh and its Voronoi cells; see the attributes of Quality.

    surface: as for voronoi(). density, cell_width: as for cvt(); dc_over_h and excess use them.
    units: of the attribute `unit`, in which the result is shown: km, degrees or radians. Default: km
        where the planet's radius is known, see Mesh.earth_radius, else degrees.

    A plane that ends at walls in one direction and is periodic in the other, such as a channel of a
    file, needs no surface: its whole cells are measured.

    >>> quality(delaunay(bisected_icosahedron(3))).obtuse
    0
    """
    _require_mesh(mesh)
    unit = _units.unit_of(mesh, units)
    mesh = within(mesh, surface)
    if not mesh.surface.period.any():
        _require_end(mesh)
    found = _calotte.quality(mesh, _density_for(mesh, density, cell_width))
    found._unit = unit
    return found


@dataclass(frozen=True)
class Gate:
    """One demand of a model on grids, and what a grid has, of gates().

    name: such as "sides of a cell, least".
    value: the grid's worst.
    limit: of the demand; None for a value that informs.
    at_least: whether values below the limit fail; else those above it.
    beyond: number of cells, or of edges, that fail.
    cell: at which the worst is; of an edge its first cell; -1 for none.
    """

    name: str
    value: float
    limit: float | None
    at_least: bool
    beyond: int
    cell: int

    @property
    def passed(self) -> bool:
        """Whether no cell and no edge fails."""
        return self.beyond == 0


def gates(mesh: Grid, model: str, *, mask: ArrayLike | None = None) -> list[Gate]:
    """Compares a grid of the sphere with the demands of a model, as `calotte check --for` does.

    mesh: as for voronoi().
    model: "mpas-atmosphere", "mpas-ocean" or "mpas-sw".
    mask: bdyMaskCell of a limited area, by cell, whose rings must follow one another.
    Returns a list of Gate. A demand that fails is a result, not an error. Raises Error.

    >>> all(gate.passed for gate in gates(delaunay(bisected_icosahedron(4)), "mpas-atmosphere"))
    True
    """
    if not mesh.surface.is_sphere:
        raise Error("a model's demands are on grids of the sphere; give one")
    radius = _units.radius_of(mesh)
    found = _calotte.gates(voronoi(mesh), model, None if radius is None else 1000 * radius,
                           np.empty(0, np.int32) if mask is None else np.asarray(mask, np.int32))
    return [Gate(*gate) for gate in found]


def operator_errors(mesh: Grid, *, surface: SurfaceLike | None = None,
                    density: DensityLike | None = None,
                    cell_width: WidthLike = None) -> OperatorErrors:
    """Measures the errors of the operators of a C-grid model (TRiSK) for smooth fields.

    divergence, gradient, laplacian, curl, tangential and kinetic_energy have l2, max, and the cell
    and the position of the greatest error, over the root mean square of the exact values; an attribute
    such as divergence_by_cell has the errors of all cells, NaN at a boundary. The largest
    eigenvalues of the Laplacians at cells and at vertices, over the square of the unit of length
    (on the sphere radians), bound time steps: wave_step() and diffusion_step().

    surface: as for voronoi(). density, cell_width: as for cvt(); off_centroid uses them.

    >>> operator_errors(delaunay(bisected_icosahedron(3))).gradient.l2 < 0.01
    True
    """
    _require_mesh(mesh)
    mesh = within(mesh, surface)
    _require_end(mesh)
    return _calotte.operator_errors(mesh, _density_for(mesh, density, cell_width))


def _require_triangles(mesh):
    if isinstance(mesh, Polygons):
        raise Error("polygons have no triangles; give a mesh")
    if not isinstance(mesh, Mesh):
        raise Error(f"the mesh is {type(mesh).__name__}; give a Mesh")


def _positions(mesh, positions):
    _require_triangles(mesh)
    return _arguments.points_of(mesh.surface, positions, "positions")


def locate(mesh: Mesh, positions: ArrayLike) -> Locations:
    """Where positions lie in a mesh: the triangle and its weights, and the nearest site. Exact in
    a Delaunay triangulation and in a part of one.

    positions: k x 3 directions of any length, or k x 2 longitudes and latitudes in degrees; k x 2 in
        the plane, in a periodic box inside or outside of it.
    Returns Locations. A position outside of an open mesh has the triangle -1 and the weights NaN.
    Raises Error, with the index of the position.

    >>> mesh = delaunay(fibonacci_sphere(1000))
    >>> found = locate(mesh, [(-105.0, 40.0), (0.0, 90.0)])
    >>> found.triangle.shape, found.weights.shape, int(found.nearest[1])
    ((2,), (2, 3), 0)
    >>> position = found.weights[0] @ mesh.points[mesh.triangles[found.triangle[0]]]
    >>> bool(np.allclose(to_lonlat(position[np.newaxis]), (-105, 40)))
    True
    """
    return _calotte.locate(mesh, _positions(mesh, positions))


def cells_at(cells: Polygons, positions: ArrayLike) -> Array:
    """The polygon that contains each position, such as the faces of a UGRID file in which particles are.

    cells: Polygons, on the sphere of arcs of great circles; they may be concave.
    positions: as for locate().
    Returns k ids, of several polygons the lowest; -1 where there is none. Sides belong to both polygons
    beside them, up to rounding. Raises Error, with the index of the position.

    >>> dual = voronoi(delaunay(fibonacci_sphere(1000)))
    >>> cells = Polygons(dual.vertices, dual.begin, dual.vertices_on_cell)
    >>> cells_at(cells, [(-105.0, 40.0), (0.0, 90.0)]).shape
    (2,)
    """
    if not isinstance(cells, Polygons):
        raise Error(f"the cells are {type(cells).__name__}; give Polygons, or for a Mesh use locate()")
    return _calotte.cells_at(cells, _arguments.points_of(cells.surface, positions, "positions"))


_NO_HINTS = np.empty(0, np.int32)


class Locator:
    """A mesh, prepared for many searches, which threads may make at the same time. It may be pickled.

    mesh: as for locate().

    >>> locator = Locator(delaunay(fibonacci_sphere(1000)))
    >>> before = locator.find([(-105.0, 40.0), (0.0, 90.0)])
    >>> after = locator.find([(-104.9, 40.1), (10.0, 89.8)], hints=before.triangle)
    >>> locator.nearest([(-105.0, 40.0), (0.0, 90.0)], 3).shape
    (2, 3)
    >>> len(locator.within([(-105.0, 40.0)], math.radians(5))[0])
    2
    """

    def __init__(self, mesh: Mesh) -> None:
        _require_triangles(mesh)
        self._mesh, self._prepared = mesh, _calotte.Locator(mesh)

    @property
    def mesh(self) -> Mesh:
        """The mesh in which it searches."""
        return self._mesh

    def find(self, positions: ArrayLike, hints: ArrayLike | None = None) -> Locations:
        """The same as locate(). hints: k triangles near the positions, such as those where particles
        were before; -1 for none. They change no result in a Delaunay triangulation, and save little time."""
        return self._prepared.find(_positions(self._mesh, positions), _NO_HINTS if hints is None else hints)

    def nearest(self, positions: ArrayLike, k: int | None = None, hints: ArrayLike | None = None) -> Array:
        """The nearest site of each position, the lowest of those that are equally near. With k an array
        (n, k) of the k nearest sites, by distance and then by id. hints: as for find(), without k."""
        places = _positions(self._mesh, positions)
        if k is None:
            return self._prepared.nearest(places, _NO_HINTS if hints is None else hints)
        if k > len(self._mesh):
            raise Error(f"k is {k}, and the mesh has {len(self._mesh)} sites; give at most as many")
        return self._prepared.nearest_few(places, k).ids.reshape(len(places), k)

    def within(self, positions: ArrayLike, distance: float) -> IdLists:
        """The sites within a distance of each position, ascending. distance: radians, at most pi; in a
        plane in its unit."""
        return self._prepared.within(_positions(self._mesh, positions), distance)

    def __reduce__(self) -> tuple[Any, ...]:
        return Locator, (self._mesh,)

    def __repr__(self) -> str:
        return f"<calotte.Locator: in {len(self._mesh)} sites>"


# ---- From one grid to another

def raster(longitudes: ArrayLike, latitudes: ArrayLike | None = None) -> Raster:
    """The boxes of a raster of longitudes and latitudes.

    longitudes, latitudes: of the nodes, degrees; latitudes may descend. The sides of the boxes are
        half way between nodes. Or the numbers of columns and rows of equal boxes over the sphere. Or
        an xarray.DataArray or Dataset alone, whose coordinates lat and lon are the nodes.
    Returns a Raster. Raises Error, with the index of a value out of order.

    >>> boxes = raster(720, 360)
    >>> len(boxes), bool(abs(boxes.areas.sum() - 4 * math.pi) < 1e-11)
    (259200, True)
    """
    if isinstance(longitudes, (str, os.PathLike)):
        path = os.fspath(longitudes)
        raise Error(f"longitudes is the file {path}; give the DataArray of a NetCDF file, as xarray.open_dataarray() "
                    "reads it; gdalwarp -t_srs EPSG:4326 -of netCDF makes one of an image")
    if latitudes is None:
        if not (hasattr(longitudes, "dims") and hasattr(longitudes, "coords")):
            raise Error("there are no latitudes; give longitudes and latitudes in degrees, two numbers of boxes, or a "
                        "DataArray with the coordinates lat and lon")
        longitudes, latitudes = _labels.nodes(longitudes)
    if np.ndim(longitudes) == 0 and np.ndim(latitudes) == 0:
        columns, rows = _count(longitudes, "the number of columns"), _count(latitudes, "the number of rows")
        if rows > columns:
            _arguments.warn(f"{columns} columns and {rows} rows make boxes of {360 / max(columns, 1):.3g} x "
                            f"{180 / max(rows, 1):.3g} degrees; the columns come first, as in raster(720, 360)")
        return _calotte.global_raster(columns, rows)
    longitudes, latitudes = _arguments.numbers(longitudes, "longitudes"), _arguments.numbers(latitudes, "latitudes")
    _arguments.warn_of_radians(latitudes, "the raster")
    return _calotte.raster_of_nodes(longitudes, latitudes)


_METHODS = ("conservative", "linear", "nearest", "natural")
_METHODS_AT_POSITIONS = ("linear", "natural", "nearest")


def _grid_of(value):
    """The raster of an array or a Dataset of xarray with latitudes and longitudes; others as they are."""
    if hasattr(value, "coords") and _labels.find_lat_lon(value) is not None:
        return raster(value)
    return value


def _field_of(grid, values, cells):
    """Numbers at the cells of a grid, which may be unknown."""
    return _fields.field_at(values, cells, grid)


def _field_grid(grid):
    """The grid as interpolation takes it."""
    if isinstance(grid, Raster):
        return _calotte.grid_of_boxes(grid)
    if not isinstance(grid, (Mesh, Polygons)):
        raise Error(f"a grid is {type(grid).__name__}; give a Mesh, Polygons, a Raster or a DataArray with lat and lon")
    return _fields.grid_of_cells(grid)


def _require_method(method, methods):
    if method not in methods:
        raise Error(f"no method {method}; give one of: {', '.join(methods)}")


@dataclass(frozen=True, repr=False)
class Weights:
    """Weights from the cells of a source to those of a target, of interpolation_weights().

    matrix: that of to_scipy_sparse().
    source_area: of the cells; steradians, in a plane the square of its unit. Empty unless
        conservative.
    target_area: the same of the target.
    source_fraction: of each cell's area, what the target covers.
    target_fraction: of each cell's area, what the source covers.
    """

    _weights: Any
    _method: str
    _source: Any = None
    _target: Any = None
    _dim: str | None = None

    def to_scipy_sparse(self) -> Any:
        """The weights as a scipy.sparse.csr_matrix, a row for each cell or position of the target.

        Rows sum to 1; those outside of the source have no entries. It needs scipy.
        """
        try:
            from scipy.sparse import csr_matrix
        except ImportError:
            raise Error("a sparse matrix needs scipy; install it, as with pip install scipy, or use apply()") from None
        values, columns, begin, shape = self._weights.rows()
        return csr_matrix((values, columns, begin), shape=shape)

    @property
    def matrix(self) -> Any:
        return self.to_scipy_sparse()

    @property
    def source_area(self) -> Array:
        return self._weights.source_area

    @property
    def target_area(self) -> Array:
        return self._weights.target_area

    @property
    def source_fraction(self) -> Array:
        return self._weights.source_fraction

    @property
    def target_fraction(self) -> Array:
        return self._weights.target_fraction

    def __repr__(self) -> str:
        rows, columns = self._weights.rows()[3]
        return (f"<calotte.Weights: {columns} to {_display.counted(rows, 'position' if self._dim else 'cell')}, "
                f"{self._method}>")

    def apply(self, values: ArrayLike, *, min_cover: float = 0.0) -> Any:
        """The values at the target.

        values: a number for each cell of the source; or an array with further dimensions, such as
            times before the cells and levels after them. Of a raster the last two may be its
            latitudes and longitudes. Or an xarray.DataArray, of which one comes back: with its other
            dimensions, their coordinates, its name and attributes, and with those of the target.
            NaN does not count: the others are divided by their part of the weights.
        min_cover: the part of a cell, 0 to 1, that values must cover; below it the cell is NaN.
        """
        return self._at_target(_field_of(self._source, values, self._weights.rows()[3][1]), min_cover)

    def _at_target(self, field, min_cover=0.0):
        return _fields.at_target(field, self._weights.apply(field.by_cell, min_cover), self._target, self._dim)

    def write(self, path: Path, *, format: str = "esmf") -> None:
        """Writes the weights as NetCDF: "esmf", for ncremap, or "scrip", for CDO."""
        if format not in ("esmf", "scrip"):
            raise Error(f"no format {format} of weights; give esmf or scrip")
        if self._source is None or self._dim is not None:
            raise Error("these weights are not between two grids; of a file, use the file")
        _calotte.write_grid_weights(str(path), self._weights, _field_grid(self._source), _field_grid(self._target),
                                    self._method, format == "scrip")


def interpolation_weights(source: ArrayLike | Grid | Raster, target: ArrayLike | Grid | Raster, *,
                          method: str | None = None) -> Weights:
    """The weights from the cells of one grid to those of another, on one surface, or to positions.

    source: a Mesh, Polygons or a Raster, or what raster() makes one of alone, such as a DataArray; to
        positions a Mesh or a Raster.
    target: the same, or positions, as for locate().
    method: "conservative", by shared areas, whose integrals are kept, between grids only; "linear"
        on each triangle, or bilinear in a raster; "nearest", the cell that holds the position or the
        centre; "natural", of a mesh, by the areas that a cell of the position would take from the
        cells around it (Sibson, 1980), which is smooth except at the sites. Default: conservative,
        at positions linear.
    Returns Weights. Raises Error, with the index of the position.

    >>> mesh = delaunay(fibonacci_sphere(500))
    >>> weights = interpolation_weights(raster(36, 18), mesh)
    >>> ones = weights.apply(np.ones(36 * 18))
    >>> bool(np.abs(ones - 1).max() < 1e-12)
    True
    """
    source, target = _grid_of(source), _grid_of(target)
    if not isinstance(target, (Mesh, Polygons, Raster)):
        return _weights_at(source, target, "linear" if method is None else method)
    method = "conservative" if method is None else method
    _require_method(method, _METHODS)
    return Weights(_calotte.grid_weights(_field_grid(source), _field_grid(target), method), method, source, target)


def _weights_at(source, positions, method):
    """Weights at positions."""
    _require_method(method, _METHODS_AT_POSITIONS)
    dim = str(positions.dims[0]) if hasattr(positions, "dims") else "position"
    positions = (_arguments.sphere_points(positions, "positions") if isinstance(source, Raster) else
                 _positions(source, positions))
    return Weights(_calotte.weights_at(source, positions, method), method, source, positions, dim)


def read_weights(path: Path) -> Weights:
    """Reads weights of ESMF or SCRIP, also of other programs. Raises Error."""
    return Weights(_calotte.read_grid_weights(str(path)), "of a file")


def interpolate(source: ArrayLike | Grid | Raster, values: ArrayLike, target: ArrayLike | Grid | Raster, *,
                method: str | None = None) -> Any:
    """Values at positions, or at the cells of another grid.

    source: what the values are of, as for interpolation_weights(); to positions a Mesh or a Raster.
    values: n numbers, one for each site or cell, with any further dimensions; also of xarray. See
        Weights.apply().
    target: positions, as for locate(); or as for interpolation_weights().
    method: as for interpolation_weights(), whose result serves for many values: to another grid
        "conservative" by default, as calotte interpolate, at positions "linear".
    Returns k numbers in place of the n; NaN outside of an open mesh or a raster. A conservative
    value is the mean over the part of the cell that the source covers. Raises Error, with the index
    of the position.

    >>> mesh = delaunay(random_points(200, rectangle((0, 0), (1, 1))), plane())
    >>> values = mesh.points @ [1.0, 2.0]
    >>> inside, outside = interpolate(mesh, values, [(0.5, 0.25), (7.0, 7.0)], method="natural")
    >>> round(float(inside), 12), float(outside)
    (1.0, nan)
    """
    source = _grid_of(source)
    if not isinstance(source, (Mesh, Polygons, Raster)):
        _field_grid(source)  # raises
    field = _field_of(source, values, len(source))  # before the weights are made
    return interpolation_weights(source, target, method=method)._at_target(field)


def _scattered_target(surface, targets):
    """The target of scattered values as interpolation takes it."""
    if isinstance(targets, str):
        raise Error(f"targets is {targets!r}; give the columns and rows of a raster as (720, 360), or positions")
    if isinstance(targets, (tuple, list)) and len(targets) == 2 and all(np.ndim(size) == 0 for size in targets):
        targets = raster(*targets)
    targets = _grid_of(targets)
    if isinstance(targets, (Mesh, Polygons, Raster)):
        return _field_grid(targets)
    return _calotte.grid_of_positions(_arguments.points_of(surface, targets, "targets"), surface)


def interpolate_scattered(points: ArrayLike, values: ArrayLike, targets: Any, *, method: str = "linear",
                          surface: SurfaceLike | None = None) -> Array:
    """Values at scattered points, such as those of stations, at positions or at the cells of a grid.

    points: n x 3 directions of any length, or n x 2 longitudes and latitudes in degrees; n x 2 in the
        plane.
    values: n numbers, or k x n for k fields. NaN is missing: its point counts for the other fields
        alone. Points at one position are one, whose value is the mean; a warning tells their number.
    targets: positions, as the points; columns and rows of a global raster, such as (720, 360); or a
        Raster, Mesh or Polygons, at the centres of whose cells the values are.
    method: "linear" on each Delaunay triangle of the points; "natural", by natural neighbours
        (Sibson, 1980), which is smooth except at the points; "nearest", the value of the nearest
        point.
    surface: where the points live: the sphere (default), or a plane such as plane().
    Returns m numbers, or k x m: of a raster row after row. NaN outside of the triangles, unless
    "nearest": points of a part of the sphere, or of a plane, have triangles in their convex hull.
    Raises Error, with the index of the point, and for points on one great circle or line.

    >>> stations = [(0, 0), (90, 0), (0, 90), (45, -30)]
    >>> interpolate_scattered(stations, [2, 2, 5, 2], [(45, -10), (200, 0)]).round(12).tolist()
    [2.0, nan]
    >>> interpolate_scattered(stations, [2, 2, 5, 2], (36, 18), method="nearest").shape
    (648,)
    """
    _require_method(method, _METHODS_AT_POSITIONS)
    surface = _arguments.surface(surface)
    source = _arguments.points_of(surface, points)
    numbers = _arguments.numbers(values, "values")
    if numbers.ndim not in (1, 2) or numbers.shape[-1] != len(source):
        raise Error(f"values have the shape {numbers.shape} for {len(source)} points; give n numbers, or k x n")
    if np.isinf(numbers).any():
        first = tuple(int(i) for i in np.argwhere(np.isinf(numbers))[0])
        raise Error(f"values[{', '.join(map(str, first))}] is infinite; give NaN where there is no value")
    target = _scattered_target(surface, targets)
    found, merged = _calotte.interpolate_scattered(_calotte.grid_of_positions(source, surface),
                                                   np.atleast_2d(numbers), target, method)
    if merged > 0:
        _arguments.warn(f"{_display.counted(merged, 'point')} had the position of an earlier one; the values at one "
                        "position are averaged")
    return found[0] if numbers.ndim == 1 else found


# ---- Centroidal Voronoi tessellations

@dataclass(frozen=True)
class Action:
    """A step of a run: what happens to the generators, and the descent that follows.

    kind: start (its generators), bisect (one more at the midpoint of each edge), insert (a round of
        insertion and contraction), converge (the descent to the end), polish (shapes come within
        their limits), raise (with a larger penalty, where it fell short).
    cells: at its end.
    times: how often, at most.
    norm: of each descent.
    tolerance: of this norm; 0 with iterations, and in a polish.
    max_iterations: of each descent.
    done: how often the run did it; 0 for one that was left out, and of a plan.
    iterations: of all its descents.
    """

    kind: str
    cells: int
    times: int
    norm: str
    tolerance: float
    max_iterations: int
    done: int = 0
    iterations: int = 0


@dataclass(frozen=True, repr=False)
class Cvt:
    """A centroidal Voronoi tessellation: its mesh, and the course of its run, of cvt().

    mesh: the Delaunay triangulation of the generators; with walls that of a wider box.
    converged: whether the norm fell below the tolerance.
    well_centred: whether all shapes are within the limits of models.
    cells_beyond_limits: number of cells beyond them, where that was asked for.
    worst_cell: the cell farthest beyond them; -1 for none.
    moved_on_lines: number of generators on lines that left these for the sake of shapes.
    farthest_move: the largest of their distances from where they were, in cell widths.
    off_boundary: with boundary "generators" the number of the mesh's outer edges that do not join
        generators there; 0 if it ends at the boundary.
    residual: the norm at the end, relative to the spacing of the cells.
    energy: at the end: integral of density times squared distance from the generator.
    iterations: their number, of all actions.
    seconds: of wall-clock time.
    energies: by iteration.
    norms: by iteration, l2-scaled.
    actions: of the run, in order; see Action.
    cells: with walls the Polygons between them; otherwise None.
    """

    mesh: Mesh
    converged: bool
    well_centred: bool
    cells_beyond_limits: int
    worst_cell: int
    moved_on_lines: int
    farthest_move: float
    off_boundary: int
    residual: float
    energy: float
    iterations: int
    seconds: float
    energies: Array
    norms: Array
    actions: tuple[Action, ...] = ()
    cells: Polygons | None = None

    def _grid(self) -> Any:
        return self.mesh if self.cells is None else self.cells

    def __repr__(self) -> str:
        end = "converged after" if self.converged else "not converged in"
        shape = ("well-centred, " if self.well_centred else
                 f"{_display.counted(self.cells_beyond_limits, 'cell')} beyond limits, "
                 if self.cells_beyond_limits else "")
        return (f"<calotte.Cvt: {_display.counted(len(self._grid()), 'cell')}, {end} "
                f"{_display.counted(self.iterations, 'iteration')}, {shape}residual "
                f"{self.residual:.2g}>")

    def _repr_html_(self) -> str:
        rows = [(name, getattr(self, name), "") for name in
                ("converged", "well_centred", "cells_beyond_limits", "worst_cell", "residual",
                 "energy", "iterations", "seconds")]
        return self._grid()._repr_html_() + _display.table(repr(self).strip("<>"), rows)

    def plot(self, field: Any = None, **options: Any) -> Any:
        """Draws the cells; see Mesh.plot()."""
        return self._grid().plot(field, **options)

    def voronoi(self) -> Voronoi:
        """The Voronoi cells; see voronoi()."""
        return voronoi(self._grid())


@dataclass(frozen=True, repr=False)
class Plan:
    """What a run would do, of plan().

    cells: their number.
    actions: of the run, in order; see Action.
    start: its kind; see cvt().
    widths: the least and the greatest, km, in a plane in its unit; None without widths.
    gradient: the largest of the widths, km per km; most models need less than 0.03. None in a plane
        and without widths.
    steepest: longitude and latitude of it, degrees; None as gradient.
    """

    cells: int
    actions: tuple[Action, ...]
    start: str
    widths: tuple[float, float] | None = None
    gradient: float | None = None
    steepest: tuple[float, float] | None = None

    @property
    def least_km(self) -> float:
        """The least width, km."""
        return self._width(0)

    @property
    def greatest_km(self) -> float:
        """The greatest width, km."""
        return self._width(1)

    def __repr__(self) -> str:
        unit = "" if self.gradient is None else " km"
        widths = "" if self.widths is None else f", {self.widths[0]:.4g} to {self.widths[1]:.4g}{unit}"
        return (f"<calotte.Plan: {_display.counted(self.cells, 'cell')}, start {self.start}, "
                f"{_display.counted(len(self.actions), 'action')}{widths}>")

    def _width(self, k: int) -> float:
        return math.nan if self.widths is None else self.widths[k]


def plan(cell_width: WidthLike = None, *, surface: SurfaceLike | None = None,
         earth_radius: float = EARTH_RADIUS_KM, **options: Any) -> Plan:
    """What cvt() would do with the same arguments: cells, actions, and what the widths demand.

    options: other arguments of cvt(), such as cells and density.

    >>> plan(120.0).cells
    40962
    >>> [action.kind for action in plan(cells=2562, density="x8").actions]
    ['start', 'insert', 'bisect', 'insert', 'converge', 'polish', 'raise']
    """
    recipe = _recipe(cell_width=cell_width, surface=surface, earth_radius=earth_radius,
                             **options)
    schedule = _calotte.plan(recipe)
    made = {"cells": schedule.cells, "start": schedule.start, "actions": _actions(schedule.actions)}
    widths = schedule.widths
    if widths is None:
        return Plan(**made)
    made["widths"] = widths.least, widths.greatest
    if widths.of_plane:
        return Plan(**made)
    slope, longitude, latitude = _calotte.largest_gradient(widths, earth_radius)
    return Plan(**made, gradient=slope, steepest=(longitude, latitude))


def _actions(rows):
    return tuple(Action(*row) for row in rows)


def _take_start(recipe, cells, points):
    """A number of cells, or points; neither where the widths give the number."""
    if points is not None:
        recipe.points = _arguments.points_of(recipe.surface, points)
        if recipe.start == _USUAL.start:
            recipe.start = "points"
    if cells is None:
        return
    if np.ndim(cells) > 0:
        raise Error(f"the number of cells is an array of the shape {np.shape(cells)}; give the generators to begin with "
                    "as points=")
    if points is not None:
        raise Error("points give the number of cells; leave cells out")
    recipe.cells = _count(cells, "the number of cells")
    if recipe.cells == 0:
        raise Error("the number of cells is 0; give a larger one, or None where widths give it")


def _take_lines(recipe, lines):
    """Lines from a file or from arrays."""
    if isinstance(lines, (str, os.PathLike)):
        recipe.take_lines(os.fspath(lines))
    elif lines is not None:
        recipe.lines = [_arguments.points_of(recipe.surface, line, "points of a line")
                        for line in lines]


def _set(target, name, value):
    """Sets an argument of a run, of the kind that the library takes."""
    if name == "start" and not isinstance(value, str):
        raise Error("start is the kind of start, a word such as 'geodesic'; give the number of cells as cells=, the "
                    "generators to begin with as points=")
    try:
        setattr(target, name, value)
    except TypeError:
        raise Error(f"{name} is {value!r}, which is out of range or of another kind; help(calotte.cvt) tells what it "
                    "is") from None


def _recipe(cells=None, density=None, cell_width=None, surface=None, fixed=None, lines=None,
            earth_radius=EARTH_RADIUS_KM, points=None, **fields):
    """The recipe of the arguments of cvt()."""
    recipe = _calotte.Recipe()
    for name, value in fields.items():
        if not hasattr(type(recipe), name):
            raise TypeError(f"unexpected keyword argument {name!r}")
        _set(recipe, name, value)
    surface = _arguments.surface(surface, earth_radius=earth_radius)
    recipe.surface, recipe.radius_km = surface, earth_radius
    _arguments.require_one(density, cell_width)
    if cell_width is None:
        recipe.take_density(_arguments.density(density, plane=not surface.is_sphere))
    else:
        recipe.take_widths(_arguments.rule(cell_width, surface, earth_radius))
    if fixed is not None:
        recipe.fixed = _arguments.points_of(surface, fixed, "fixed points")
    _take_lines(recipe, lines)
    _take_start(recipe, cells, points)
    return recipe


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


def cvt(cells: int | None = None, *, density: DensityLike | None = None,
        cell_width: WidthLike = None, surface: SurfaceLike | None = None,
        points: ArrayLike | None = None, fixed: ArrayLike | None = None,
        lines: Path | Geometries | Sequence[ArrayLike | Geometries] | None = None, seed: int = _USUAL.seed,
        method: str = _USUAL.method, norm: str = _USUAL.norm, tolerance: float | None = None,
        max_iterations: int = _USUAL.max_iterations, well_centred: bool | None = None,
        least_spacing: float = _USUAL.least_spacing,
        most_off_midpoint: float = _USUAL.most_off_midpoint, insertion_rounds: int | None = None,
        start: str = _USUAL.start, bisections: int | None = None, iterations: int | None = None,
        boundary: str = _USUAL.boundary, walls: str = _USUAL.walls,
        limited_area: bool = _USUAL.limited_area, duplicates: str = _USUAL.duplicates,
        merge_within: float = _USUAL.merge_within, regions: int | None = None,
        progress: Progress | bool | None = None, earth_radius: float = EARTH_RADIUS_KM) -> Cvt:
    """A centroidal Voronoi tessellation of the sphere, of a plane, or of a part of them.

    cells: their number; None where cell_width or points give it.
    density: "uniform"; "x8", the paper's bump with an eightfold contrast of widths;
        "tanh:lon=270,lat=30,beta=30deg,alpha=0.2,gamma=x8"; several such names, of which the
        maximum counts; the result of density(); or a function of k x 3 unit vectors (in a plane
        k x 3 with z = 0) that returns k densities.
    cell_width: in km, in place of a density: a number; text with a unit, "60km" or "60000m";
        (values, longitudes, latitudes) in degrees; an xarray.DataArray over lat and lon, in km or
        in the length of its attribute units; a file as `calotte cvt --cell-width` reads it; or a
        function of arrays of longitudes and latitudes, which is sampled every quarter of a degree.
        In a plane, in the unit of its coordinates: a number; (values, x, y); a file; a rule of
        it; or a function of arrays of x and y.
    surface: where the cells are. Default: the sphere. A part of it is one of circle(), ellipse(),
        box(), channel() or polygon(); text as of `calotte cvt --region`, such as
        "circle=-105,40,1000km" or "box=-20,30,40,60"; a file of a region; or the result of
        generalised_sea(). A plane is one of rectangle(), periodic_box() or planar_polygon().
    points: the generators to begin with: n x 3 directions, or n x 2 longitudes and latitudes in
        degrees; in a plane n x 2.
    fixed: generators that stay, as points; the first cells of the result. The number of cells
        includes them, points do not; without a number, free ones are added where the fixed ones
        leave the widths unmet.
    lines: that generators follow, such as rivers: a file, GeoJSON of LineString; or arrays as of
        fixed, one for each line. They are at the demanded distances; ends and confluences have one.
        They follow the fixed ones in the result. Those next to bad shapes move, see Cvt.
    seed: of random points. method: auto, lloyd, lbfgs or lbfgs-laplacian.
    norm: that is compared with the tolerance: l2, linf, l2-scaled or linf-scaled.
    tolerance: default 1e-6, and 1e-4 with well_centred.
    max_iterations: on each level.
    well_centred: without obtuse triangles and short Voronoi edges, as models need. Default: with
        the start multilevel, unless iterations are given.
    least_spacing: with well_centred, the least distance of neighbours over the demanded width, 0 to
        0.95.
    most_off_midpoint: with well_centred, the distance between the midpoints of an edge and of its
        Voronoi edge, over the edge, above which generators are moved to lessen it. 0.01 halves a
        model's largest errors; default 1, nowhere.
    insertion_rounds: of the start multilevel, on its last level; default as `calotte cvt`.
    start: multilevel, continuation, density, random, fibonacci, spiral, icosahedron, geodesic or
        hexagonal, as `calotte cvt --start`. Default: multilevel where a density, widths,
        fixed points, a region or a plane are given, unless bisections or iterations are; otherwise
        continuation, in the plane density.
    bisections: of the converged grid, each followed by a descent; for other starts than multilevel
        and continuation, which choose them. Default 0.
    iterations: this number on each level, in place of norm, tolerance and max_iterations.
    boundary: "clip", where that of a region clips the cells; or "generators", where the mesh ends
        at generators on it, which follow the fixed ones in the result.
    walls: "x" or "y", a direction in which a periodic box ends at walls. The run covers a wider box;
        `cells` of the result are those between the walls.
    limited_area: the run covers the region and the rings of cells around it; see limited_area().
    duplicates, merge_within: of the start, as for delaunay().
    regions: parts that run in parallel.
    progress: a function that receives a dict after each iteration and ends the run by returning
        True; or True for a bar of tqdm.
    earth_radius: km, of the sphere that lengths in km and m refer to.
    Returns a Cvt. A run that does not converge is no error. Raises Error.

    >>> grid = cvt(642)
    >>> grid.converged, len(grid.mesh)
    (True, 642)
    >>> channel = cvt(200, surface=periodic_box(2, 1), walls="y")
    >>> 190 < len(channel.cells) < 210
    True
    """
    recipe = _recipe(
        cells, density, cell_width, surface, fixed, lines, earth_radius, points, seed=seed, method=method,
        norm=norm, tolerance=tolerance, max_iterations=max_iterations, well_centred=well_centred,
        least_spacing=least_spacing, most_off_midpoint=most_off_midpoint,
        insertion_rounds=insertion_rounds, start=start,
        bisections=bisections, iterations=iterations, boundary=boundary, walls=walls,
        limited_area=limited_area, duplicates=duplicates, merge_within=merge_within)
    schedule = _calotte.plan(recipe)
    if schedule.widths is not None and not schedule.widths.of_plane:
        _warn_of_steep(schedule, recipe)
    mesh, report, between = _calotte.make_grid(recipe, schedule, regions, _reporting(progress))
    report["actions"] = _actions(report["actions"])
    if between is not None:
        polygons, polygons._content = between
        report["cells"] = polygons
    if cell_width is not None and mesh.surface.is_sphere:
        mesh._earth_radius = earth_radius
    grid = Cvt(mesh, **report)
    _warn_of_shortfall(grid.converged, grid.cells_beyond_limits)
    if grid.off_boundary:
        _arguments.warn(f"the mesh leaves the boundary in places: {grid.off_boundary} of its outer edges do not join "
                        "generators there; where the surface is narrower than its cells, give more cells")
    return grid


def _warn_of_steep(schedule, recipe):
    scale = 1 if recipe.cells == 0 else math.sqrt(schedule.implied_cells / recipe.cells)
    slope, longitude, latitude = _calotte.largest_gradient(schedule.widths, recipe.radius_km)
    limit = _calotte.steepest_width
    if _calotte.is_too_steep(scale * slope):
        _arguments.warn(f"the cell width changes by {scale * slope:.2g} km per km at longitude {longitude:.1f}, "
                        f"latitude {latitude:.1f}, above {limit}, the limit for most models; limit it, as "
                        f"calotte.widths.rule(widths).limit_gradient({limit}) does")


def _warn_of_shortfall(converged, beyond):
    if not converged:
        _arguments.warn("not converged; increase max_iterations or the tolerance")
    elif beyond:
        _arguments.warn(f"not well-centred: {beyond} cells have shapes beyond the limits of models; make the "
                        "widths or the density smoother, or give more cells")


# ---- Meshes of which a part changes

_KEPT = _calotte.RefineOptions()  #: the library's defaults


@dataclass(frozen=True)
class ChangedPatch:
    """A part of a mesh that changed, of a ChangedMesh.

    removed: number of sites of the old mesh.
    added: number of sites of the new mesh in their place.
    converged: whether the norm of its run fell below the tolerance.
    well_centred: whether all its shapes are within the limits of models.
    cells_beyond_limits: number of its cells beyond them.
    residual: the norm at the end, relative to the spacing of the cells.
    iterations: of its run.
    seconds: of wall-clock time.
    """

    removed: int
    added: int
    converged: bool
    well_centred: bool
    cells_beyond_limits: int
    residual: float
    iterations: int
    seconds: float


@dataclass(frozen=True, repr=False)
class ChangedMesh:
    """A mesh of which a part changed, of refine() or coarsen().

    mesh: the sites that stayed, in their order and with their bits, then the new ones; with what the
        file held, if the old mesh was read from one.
    new_of_old: (n,) by site of the old mesh its site in the new one; -1 for none.
    old_of_new: (m,) by site of the new mesh its site in the old one; -1 for none.
    width_ratio: (m,) by site of the new mesh the width that its cell is to have over that of the old
        mesh there; 1 for those that stayed.
    patches: the parts that changed, by step; those of a step do not touch. None if the demand is met.
        See ChangedPatch.
    held: number of sites of the old mesh where the demand is not met because sites at the mesh's
        boundary, and those next to them, stay.
    missed: number of sites of the new mesh that are wider than a finer demand by more than 0.3; of a
        coarser demand that is met nowhere the number of sites of the old mesh to which it applies.
    nearest: names of the file's fields whose new cells have the value of the nearest old one.
    left_out: names of the file's fields at edges and vertices, which do not follow.
    converged: whether all patches are.
    well_centred: whether all patches are.
    """

    mesh: Mesh
    new_of_old: NDArray[np.int32]
    old_of_new: NDArray[np.int32]
    width_ratio: Array
    patches: tuple[ChangedPatch, ...]
    held: int
    missed: int
    nearest: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()

    @property
    def converged(self) -> bool:
        return all(patch.converged for patch in self.patches)

    @property
    def well_centred(self) -> bool:
        return all(patch.well_centred for patch in self.patches)

    def __repr__(self) -> str:
        added = int((self.old_of_new < 0).sum())
        parts = f"{len(self.patches)} patch{'' if len(self.patches) == 1 else 'es'}"
        short = [f"{self.held} held"] if self.held else []
        short += [f"{self.missed} missed"] if self.missed else []
        short += [] if self.converged else ["not converged"]
        short += [] if self.well_centred else ["not well-centred"]
        return (f"<calotte.ChangedMesh: {_display.counted(len(self.mesh), 'cell')}, "
                f"{', '.join([f'{added} new in {parts}', *short])}>")


def _demand(mesh, cell_width, region, factor, earth_radius):
    """The widths that cells are to have."""
    demand, plane = _calotte.WidthDemand(), not mesh.surface.is_sphere
    if earth_radius is None:
        earth_radius = _units.radius_of_widths(mesh)
    demand.radius_km = earth_radius
    if (region is None) != (factor is None):
        raise Error("region and factor belong together; give both, or cell_width")
    if region is not None:
        demand.region = _arguments.surface(region, plane, demand.radius_km)
        demand.factor = factor
    if cell_width is not None:
        part = _calotte.rectangle(mesh.points.min(axis=0), mesh.points.max(axis=0)) if plane else None
        demand.widths = _arguments.rule(cell_width, part, demand.radius_km)
    return demand


def _require_cells(mesh, content):
    """Other polygons do not change with the triangles."""
    if content is not None and content.polygons is not None and content.not_voronoi and mesh.closed:
        raise Error(f"the cells of the mesh's file are no Voronoi cells: {content.not_voronoi}; give "
                    "a Voronoi mesh")


def _names(given, content):
    """Names of fields at the cells of a file."""
    names = [given] if isinstance(given, str) else list(given)
    known = {} if content is None else content.fields
    for name in names:
        if name not in known:
            raise Error(f"the mesh has no field {name!r} at cells; give the name of one that read() "
                        "took from its file, with fields=\"all\"")
    return names


def _methods(nearest, conservative, content):
    """How values of fields reach new cells."""
    methods = _calotte.FieldMethods()
    methods.nearest, methods.conservative = _names(nearest, content), _names(conservative, content)
    for name in set(methods.nearest) & set(methods.conservative):
        raise Error(f"the field {name!r} is to be both nearest and conservative; give it one of the "
                    "two")
    return methods


def _changed(change, mesh, demand, surface, nearest, conservative, progress, **fields):
    content, planet = content_of(mesh), _units.radius_of(mesh)
    _require_cells(mesh, content)
    mesh = within(mesh, surface)
    options = _calotte.RefineOptions()
    for name, value in fields.items():
        _set(options, name, value)
    made, made_content, values = change(mesh, content, demand, options,
                                        _methods(nearest, conservative, content),
                                        _reporting(progress))
    made._earth_radius = planet
    if made_content is not None:
        made._content = made_content
    made._order = "input"  # of written files: the cells that stayed come first
    for name in ("nearest", "left_out"):
        values[name] = tuple(values[name])
    values["patches"] = tuple(ChangedPatch(**patch) for patch in values["patches"])
    changed = ChangedMesh(made, **values)
    _warn_of_change(changed, f"{changed.missed} cells are wider than demanded by more than 0.3; refine the "
                    "result again, or give a larger gradient" if change is _calotte.refine else
                    f"the demand is met in none of its {changed.missed} cells: coarser ones grow from those "
                    "around; give a larger region or gradient")
    return changed


def _warn_of_change(changed, missed):
    if changed.held:
        _arguments.warn(f"{changed.held} cells stay as they are, against the demand, because they are at the "
                        "boundary or next to it")
    if changed.missed:
        _arguments.warn(missed)
    if not changed.converged:
        _arguments.warn("not converged")
    if not changed.well_centred:
        beyond = sum(patch.cells_beyond_limits for patch in changed.patches)
        _arguments.warn(f"not well-centred: {beyond} cells are beyond the limits of shapes")


def refine(mesh: Mesh, cell_width: WidthLike = None, *, region: SurfaceLike | None = None,
           factor: float | None = None, gradient: float = _KEPT.gradient,
           tolerance: float = _KEPT.tolerance, boundary: str = _KEPT.boundary,
           surface: SurfaceLike | None = None, nearest: str | Sequence[str] = (),
           conservative: str | Sequence[str] = (), regions: int | None = None, progress: Progress | bool | None = None,
           earth_radius: float | None = None) -> ChangedMesh:
    """Makes cells of a mesh finer where they are wider than demanded; all others keep their bits.

    The cells around grow from there at the gradient; with three to seven rows of cells more they
    form the patches that change. Each patch is a centroidal Voronoi tessellation, beside which two
    rows of sites stay. Cells at a boundary, and those next to them, stay as well, but see boundary.

    mesh: a Delaunay triangulation. What a file held besides it follows: fields at cells keep the
        values of those that stayed, and are linear between old cells at new ones; whole numbers are
        those of the nearest old cell. The field mapNewToBase is added: the number of each cell in
        the old file, from 1 on, and 0 for new cells. Read it with fields="all" to keep all.
    cell_width: widths in km that cells become as narrow as, in a plane in its unit, as for cvt();
        where a rule of calotte.widths says nothing, cells stay. Or:
    region, factor: the part, as surface of cvt(), whose cells become so many times as narrow as they
        are, more than 1 to 100.
    gradient: the greatest change of the width by distance in the transition, 0.001 to 1.
    tolerance: share of a cell's width within which it meets the demand, 0.01 to 0.5.
    boundary: "clip"; or for a mesh that ends at its sites, as one of cvt() with this word,
        "generators": finer cells reach its boundary, where new generators replace its sites.
    surface: as for voronoi(). Default: the mesh's; of a file of a plane what its cells fill.
    nearest: names of fields whose new cells have the value of the nearest old one.
    conservative: names of fields whose new cells have the mean by the areas that they share with old
        ones; of whole numbers that of the greatest area.
    regions: parts that run in parallel; no effect on the result.
    progress: a function that receives a dict after each iteration of a patch, whose True raises Error
        of the code "cancelled"; or True for a bar of tqdm.
    earth_radius: km, that the widths refer to. Default: that of the mesh, or 6371.
    Returns a ChangedMesh. A patch that does not converge is no error. Raises Error.

    >>> base = cvt(2562).mesh
    >>> finer = refine(base, region="circle=10,50,1500km", factor=1.5)
    >>> kept = finer.new_of_old >= 0
    >>> bool((finer.mesh.points[finer.new_of_old[kept]] == base.points[kept]).all())
    True
    """
    _require_triangles(mesh)
    demand = _demand(mesh, cell_width, region, factor, earth_radius)
    return _changed(_calotte.refine, mesh, demand, surface, nearest, conservative, progress,
                    gradient=gradient, tolerance=tolerance, boundary=boundary, regions=regions)


def coarsen(mesh: Mesh, cell_width: WidthLike = None, *, region: SurfaceLike | None = None,
            factor: float | None = None, gradient: float = _KEPT.gradient,
            tolerance: float = _KEPT.tolerance, surface: SurfaceLike | None = None,
            nearest: str | Sequence[str] = (), conservative: str | Sequence[str] = (),
            regions: int | None = None, progress: Progress | bool | None = None,
            earth_radius: float | None = None) -> ChangedMesh:
    """Makes cells of a mesh coarser where they are narrower than demanded; all others keep their
    bits. Coarser cells begin at those that stay around them, and grow from there at the gradient.

    cell_width, region, factor: the widths that cells become as wide as, and how many times as wide as
        they are. All arguments are as for refine().
    Returns a ChangedMesh. Raises Error.

    >>> base = cvt(2562).mesh
    >>> coarser = coarsen(base, region=circle((10, 50), "3000km"), factor=1.5)
    >>> len(coarser.mesh) < len(base), bool(check(coarser.mesh))
    (True, True)
    """
    _require_triangles(mesh)
    demand = _demand(mesh, cell_width, region, factor, earth_radius)
    return _changed(_calotte.coarsen, mesh, demand, surface, nearest, conservative, progress,
                    gradient=gradient, tolerance=tolerance, regions=regions)


def _lonlat(point, name):
    """A longitude and a latitude."""
    given = np.asarray(_arguments.numbers(point, name), dtype=float)
    if given.shape != (2,):
        raise Error(f"{name} is {point!r}; give (longitude, latitude) in degrees")
    return float(given[0]), float(given[1])


def rotate(mesh: Grid, *, from_: Sequence[float], to: Sequence[float], bearing: float = 0.0) -> Grid:
    """Rotates a mesh of the sphere, or cells, so that a point moves to where it is needed.

    Ids, triangles, areas and scalar fields stay. Of what a file held besides the mesh, the directions
    turn with it: zonal and meridional components of one vector, Cartesian components in three fields,
    and components along edges, which keep their values. fCell, fEdge and fVertex are computed anew where
    they were 2 Omega sin(latitude). A warning names directions that cannot turn.

    mesh: a mesh or polygons; read it with fields="all" to keep all that the file holds.
    from_, to: a point of the mesh, and where it is to be: (longitude, latitude), degrees. North at a pole
        is along the meridian of the longitude given.
    bearing: where to what is north of from_ then points from to, degrees clockwise from north.
    Returns the rotated mesh, or polygons. A point returns within 3e-16 there and back. Raises Error.

    >>> base = cvt(642).mesh
    >>> there = rotate(base, from_=(0, 90), to=(-105, 40))
    >>> back = rotate(there, from_=(-105, 40), to=(0, 90))
    >>> bool((there.triangles == base.triangles).all()), bool(abs(back.points - base.points).max() < 1e-15)
    (True, True)
    """
    made, content, unturned = _calotte.rotate(mesh, content_of(mesh), _lonlat(from_, "from_"),
                                              _lonlat(to, "to"), bearing)
    made._earth_radius = _units.radius_of(mesh)
    if content is not None:
        made._content = content
    made._order = "input"  # of written files: ids stay
    if unturned:
        _arguments.warn(f"not turned, and wrong at the new place: {', '.join(unturned)}")
    return made


# ---- Points

def random_points(n: int, surface: SurfaceLike | None = None, *,
                  density: DensityLike | None = None, seed: int = 1) -> Array:
    """Independent random points that follow a density: n x 3 unit vectors, in a plane n x 2.

    surface, density: as for cvt(). seed: of the random numbers; the same one gives the same points.

    >>> random_points(3).shape, random_points(3, rectangle((0, 0), (2, 1))).shape
    ((3, 3), (3, 2))
    """
    surface = _arguments.surface(surface)
    return _calotte.random_points(_count(n, "the number of points"), surface,
                                  _arguments.density(density, plane=not surface.is_sphere), seed)


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


def hexagonal_lattice(n: int, surface: SurfaceLike) -> Array:
    """A hexagonal lattice of about n points in a part of the plane or a periodic box, n x 2."""
    return _calotte.hexagonal_lattice(_count(n, "the number of points"),
                                      _arguments.surface(surface, plane=True))


def bisect(mesh: Mesh) -> Array:
    """The points of a mesh and the midpoints of its edges: (4 n - 6) x 3 on the sphere.

    Midpoints outside of the mesh's surface are left out. In a plane there are two columns.

    >>> bisect(delaunay(bisected_icosahedron(0))).shape
    (42, 3)
    """
    return mesh.bisected_points()


def from_lonlat(longitudes: ArrayLike, latitudes: ArrayLike) -> Array:
    """Unit vectors, n x 3, at longitudes and latitudes in degrees."""
    pairs = np.stack(np.broadcast_arrays(longitudes, latitudes), axis=-1)
    return _calotte.from_lonlat(_arguments.numbers(np.atleast_2d(pairs), "points"))


def to_lonlat(points: ArrayLike) -> Array:
    """Longitudes (-180 to 180) and latitudes in degrees, n x 2, of directions."""
    return _calotte.to_lonlat(_arguments.sphere_points(points))


# ---- Surfaces

def circle(centre: ArrayLike, radius: float | str, corners: int = 360, *,
           earth_radius: float = EARTH_RADIUS_KM) -> Surface:
    """The region around a centre (longitude and latitude in degrees, or a vector).

    radius: degrees, or text with a unit: "1000km", "500000m", "10deg".
    corners: number of the ring's corners, which lie on the circle.
    earth_radius: km, of the sphere that lengths in km and m refer to.

    >>> round(circle((-105, 40), 10).area, 3), round(circle((-105, 40), "1000km").area, 3)
    (0.095, 0.077)
    """
    return _calotte.circle(_arguments.direction(centre, "the centre"),
                           _arguments.angle(radius, "the radius", earth_radius), corners)


def ellipse(centre: ArrayLike, semi_major: float | str, semi_minor: float | str,
            bearing: float = 0.0, corners: int = 360, *,
            earth_radius: float = EARTH_RADIUS_KM) -> Surface:
    """The region in an ellipse.

    centre, corners, earth_radius: as for circle(). semi_major, semi_minor: as its radius.
    bearing: of the major axis, degrees clockwise from north.
    """
    if not math.isfinite(bearing):
        raise Error(f"the bearing of the ellipse is {bearing!r}; give degrees clockwise from north")
    axes = [_arguments.angle(size, "a semi-axis", earth_radius)
            for size in (semi_major, semi_minor)]
    if not axes[0] >= axes[1] or not axes[0] < math.pi / 2:
        raise Error(f"the semi-axes of the ellipse are {semi_major!r} and {semi_minor!r}; give the major one first, below "
                    "90 degrees, in degrees or as text such as '1000km'")
    return _calotte.ellipse(_arguments.direction(centre, "the centre"), *axes,
                            math.radians(bearing), corners)


def channel(lower: float, upper: float, corners: int = 360) -> Surface:
    """The region between two latitudes in degrees.

    corners: of the ring along each of them, a pole excepted.
    """
    return _calotte.channel(*_arguments.latitudes(lower, upper, "the channel's latitudes"), corners)


def box(west: float, south: float, east: float, north: float) -> Surface:
    """The region between two meridians and two parallels, in degrees.

    It runs eastward from west to east, over the date line if east is less. -180 and 180 give a band.
    A box up to a pole (south -90 or north 90) is a sector of its cap.

    >>> round(box(0, 0, 90, 90).area / (4 * math.pi), 12), round(box(170, -10, -170, 10).area, 3)
    (0.125, 0.121)
    """
    return _calotte.box(*(math.radians(side) for side in (west, south, east, north)))


def polygon(*rings: ArrayLike | Path | Geometries, inside: ArrayLike | None = None) -> Surface:
    """The region that rings enclose, each k x 2 longitudes and latitudes in degrees or k x 3.

    Rings may run either way, be closed, and reach a pole along a meridian. They enclose the side
    without poles; if both sides have one, the smaller side.

    A single file in place of rings is read as by `calotte cvt --region`; geometries, too.
    inside: a point (longitude and latitude, or a vector) of the region, which decides instead.

    >>> round(polygon([(0, 0), (90, 0), (0, 90)]).area / (4 * math.pi), 12)
    0.125
    """
    if len(rings) == 1 and isinstance(rings[0], (str, os.PathLike)):
        if inside is not None:
            raise Error("a file says by its property inside which side its rings enclose; leave inside out")
        return _arguments.surface(rings[0], plane=False)
    return _calotte.polygon([_arguments.sphere_points(ring, "corners") for ring in rings],
                            None if inside is None
                            else _arguments.direction(inside, "the point inside"))


def plane() -> Surface:
    """The plane without an end, for points x and y in any unit."""
    return _calotte.plane()


def rectangle(lower: ArrayLike, upper: ArrayLike) -> Surface:
    """The domain between two corners (x, y) of the plane."""
    for corner, what in ((lower, "lower"), (upper, "upper")):
        if _arguments.numbers(corner, what).shape != (2,):
            raise Error(f"{what} is {corner!r}; give a corner as (x, y)")
    return _calotte.rectangle(lower, upper)


def periodic_box(x: float, y: float) -> Surface:
    """The doubly periodic box [0, x) x [0, y) of the plane."""
    if not (x > 0 and y > 0):
        raise Error(f"the periodic box is {x} x {y}; give two positive lengths, in the unit of the points")
    return _calotte.periodic_box([x, y])


def planar_polygon(*rings: ArrayLike | Path | Geometries) -> Surface:
    """The domain inside rings of k x 2 corners: what an odd number of them contains.

    A single file in place of rings is read as by `calotte cvt --domain`; geometries, too.
    """
    if len(rings) == 1 and isinstance(rings[0], (str, os.PathLike)):
        return _arguments.surface(rings[0], plane=True)
    return _calotte.planar_polygon([_arguments.plane_points(ring, "corners") for ring in rings])


def density(*names: str, join: str = "maximum", surface: SurfaceLike | None = None) -> Density:
    """A density of bumps by their names, as `calotte cvt --density` has them.

    names: "x8", or "tanh:lon=270,lat=30,beta=30deg,alpha=0.2,gamma=x8", with stretch and azimuth for
        an ellipse. In a plane "tanh:x=3,y=4,beta=1.5,alpha=0.5,gamma=x8", with stretch and angle.
    join: the "maximum" of several, or their "sum". surface: as for cvt().

    >>> density("x8").uniform
    False
    """
    if not names:
        raise Error("give the name of a bump, such as x8")
    return _arguments.bumps(names, join, plane=not _arguments.surface(surface).is_sphere)


# ---- Files

def read(path: Path, *, fields: str = "scalars", mesh: Path | None = None,
         at: Mapping[str, int] | None = None) -> Grid:
    """What a file holds, of any format that `calotte convert` reads.

    fields: which of the file's fields to read: "scalars", those with one number for each cell;
        "all", or "none". They are the attribute `fields`, and written files get them again.
    mesh: the file of the mesh, where `path` holds fields alone, such as a model's history. The cells
        have the same order in both; longitudes and latitudes in `path`, or lonCell and latCell, are
        compared with the mesh's.
    at: indices of fields in their further dimensions, from 0 on, -1 for the last, as {"Time": 3,
        "lev": 0}: a name may be a part of that of the dimension, in any case.
    Returns a Mesh, whose attribute `cells` has the file's cells where these are not the Voronoi cells
    of a whole mesh; or Polygons, where the file has no triangles for its cells.
    Raises Error, naming the line or the variable.
    """
    if fields not in ("scalars", "all", "none"):
        raise Error(f"fields is {fields!r}; give scalars, all or none")
    grid, content = _calotte.read(str(path), fields, "" if mesh is None else str(mesh), _fields.choices(at))
    grid._content = content
    return grid


def read_fields(path: Path, *, mesh: Path | None = None, at: Mapping[str, int] | None = None) -> dict[str, Array]:
    """The numbers at the cells of a file: a dict of arrays in the order of read()'s sites.

    mesh, at: as for read().
    """
    return dict(read(path, mesh=mesh, at=at).fields)


def read_points(path: Path) -> Array:
    """The sites of a mesh file, n x 3, without its triangles."""
    return _calotte.read_points(str(path))


def write(path: Path, mesh: Grid, *, format: str = "by-name", model: str | None = None,
          sphere_radius: float | None = None, density: DensityLike | None = None,
          cell_width: WidthLike = None, surface: SurfaceLike | None = None,
          fields: Mapping[str, ArrayLike] | None = None, depth_levels: ArrayLike = (),
          history: str = "", order: str | None = None) -> None:
    """Writes a mesh in the format of the name (.nc: MPAS, .vtp, .geojson ...), or as `format`.

    mesh: of read(), with its cells and fields, or of another function.
    model: that reads the file: "mpas-atmosphere", "mpas-ocean", "mpas-sw" or "fesom". It sets the
        radius, dimensions, and the order of the vertices around cells: MPAS-Atmosphere has edge k of
        a cell between vertices k and k + 1, others between k - 1 and k. Default: the order of a file
        that was read, else that of the others.
    sphere_radius: of NetCDF files, metres. MPAS-Atmosphere needs 1, MPAS-Ocean 6371220. Default:
        the model's, else that of a file that was read, else 1.
    density, cell_width: as for cvt(); they set meshDensity and nominalMinDc. Without them the density
    of an MPAS file on the sphere follows from the smoothed spacing of the cells, if this varies.
    surface: as for voronoi().
    fields: a dict of numbers at the cells, beside those that were read: n, or an array with further
        dimensions, of which one has the size n. Those before it have the name Time in a NetCDF file,
        those after it levels. An xarray.DataArray gives the names, with its unit and its long_name.
        Raises Error for a format that does not hold them, and for the name of a variable that the
        format has of its own, such as latCell. SCHISM, ADCIRC and SMS take depth, metres down; these
        and Gmsh take open, which is above 0 at the sites of the open boundary. FESOM takes depth with
        depth_levels.
    depth_levels: the bounds of FESOM's layers, metres, 0 first, at least 3; they are written with
        the field depth, of fields or of the mesh's file, to aux3d.out beside nod2d.out. Default: none,
        no such file.
    order: of the cells: "curve", along a space-filling curve; or "input", that of the mesh, which
        arrays have beside it. Default: curve in NetCDF files, input in others and for meshes of
        refine() and coarsen().
    """
    content, levels, fields = content_of(mesh), _depth_levels(depth_levels), dict(fields or {})
    if levels.size > 0 and content is not None and "depth" in content.fields:
        fields = {"depth": content.fields["depth"], **fields}
    values = [_fields.state_of(mesh, name, value) for name, value in fields.items()]
    output = _calotte.Output(str(path), format, sphere_radius,
                             _density_for(mesh, density, cell_width),
                             density is not None or cell_width is not None, values, history,
                             vars(mesh).get("_order") if order is None else order, model,
                             _units.radius_of(mesh), levels)
    mesh = within(mesh, surface)
    if content is None and isinstance(mesh, Polygons):
        raise Error("polygons without the file that they are of cannot be written; give what "
                    "read() returns")
    written = _calotte.write(mesh, output) if content is None else _calotte.write_content(content, mesh, output)
    dropped = [name for name in written["dropped"] if name in content.fields and name not in fields]
    if dropped:
        _arguments.warn(f"{path}: the format does not hold {', '.join(dropped)}")
    _warn_of_ears(path, *written["ears"])
    _warn_of_coast(written["hidden"], written["small"])


def _depth_levels(levels):
    given = np.empty(0) if np.size(levels) == 0 else _arguments.numbers(levels, "depth_levels")
    if given.ndim != 1:
        raise Error(f"depth_levels have the shape {given.shape}; give the bounds of layers, 0 first, such as [0, 10, 100]")
    return given


def _warn_of_ears(path, triangles, sites):
    if triangles or sites:
        _arguments.warn(f"{path}: without {_display.counted(triangles, 'triangle')} of fewer than two neighbours, and "
                        f"without the {_display.counted(sites, 'site')} that no triangle has then: FESOM refuses them")


def _warn_of_coast(hidden, small):
    """hidden, small: number of cells, and the first."""
    words = (hidden, "behind a bend of the coast, with parts of negative area"), (
        small, "with less than a third of the area of those beside")
    faults = [f"{_display.counted(number, 'cell')} {what}, the first of which is {first} of the file"
              for (number, first), what in words if number]
    if faults:
        _arguments.warn(f"the coast leaves {' and '.join(faults)}; make the region by generalised_sea(), give more "
                        "cells, or leave boundary=\"generators\" out, which puts centres on the coast")


def partition(mesh: Grid, parts: int, *, weights: ArrayLike | None = None) -> NDArray[np.int32]:
    """The part of each cell, 0 to parts - 1, for the processes of a model; by METIS, as gpmetis makes
    them. The cells are those of the file that the mesh was read from, or the Voronoi cells of its
    sites. Each part is connected if the mesh is, and none is empty.

    parts: from 1 to the number of cells.
    weights: n numbers >= 0, the work of each cell. Default: all are equal.
    Returns n integers; np.savetxt("graph.info.part.16", part, "%d") writes them as MPAS reads them.
    Raises Error, with the index of the cell.

    >>> mesh = delaunay(fibonacci_sphere(1000))
    >>> part = partition(mesh, 16)
    >>> part.shape, int(part.min()), int(part.max())
    ((1000,), 0, 15)
    >>> bool(np.bincount(part).max() <= 1.03 * 1000 / 16 + 1)
    True
    """
    given = _arguments.numbers([] if weights is None else weights, "weights")
    if given.ndim != 1:
        raise Error(f"weights have the shape {given.shape}; give a number for each cell")
    if weights is not None and given.size == 0:
        raise Error("there are no weights; give one for each cell, or None")
    return _calotte.partition(content_of(mesh), mesh, parts, given)


def cut(source: Path, target: Path, surface: SurfaceLike, *, rings: int = 7,
        sphere_radius: float | None = 1.0, model: str | None = None) -> dict[str, Any]:
    """Cuts a limited-area grid out of an MPAS file; all fields go along. Returns a dict of counts.

    surface: as for cvt(). rings: of boundary cells around the region.
    sphere_radius: of the new file; None keeps that of the source.
    model: as for write(); its radius replaces sphere_radius. Default: MPAS-Atmosphere, or with
        sphere_radius None the order of the source.
    """
    return _calotte.cut(str(source), str(target), _arguments.surface(surface, plane=False), rings,
                        sphere_radius if model is None else None, model)


def limited_area(path: Path, surface: SurfaceLike, cell_width: WidthLike, *,
                 sphere_radius: float = 1.0, earth_radius: float = EARTH_RADIUS_KM,
                 **options: Any) -> dict[str, Any]:
    """Makes a limited-area grid: the cells of a region with seven rings of boundary cells around it.

    surface, cell_width, earth_radius: as for cvt().
    sphere_radius: of the MPAS file; the model expects 1.
    options: other arguments of cvt(), such as fixed, seed and progress.
    Returns a dict of counts: cells, and cells_by_mask (inside, then by ring).
    """
    surface = _arguments.surface(surface, plane=False, earth_radius=earth_radius)
    widths = _arguments.rule(cell_width, surface, earth_radius).on_sphere(earth_radius)
    grid = cvt(cell_width=widths, surface=surface, limited_area=True, earth_radius=earth_radius,
               **options)
    density = _arguments.density(None, widths._field(grid.mesh.surface))
    output = _calotte.Output(str(path), "mpas", sphere_radius, density, True, [], "", None, None,
                             earth_radius, np.empty(0))
    return _calotte.write_limited_area(output, grid.mesh, surface)


def _items(value):
    """One file or several, or other items; none of None."""
    return [] if value is None else [value] if isinstance(value, (str, os.PathLike)) else list(value)


def _files(value, what):
    """The names of one file or of several."""
    files = _items(value)
    for file in files:
        if not isinstance(file, (str, os.PathLike)):
            raise Error(f"{what} holds {_border.described(file)}; give the name of a file, or a list of such")
    return [str(file) for file in files]


def _seeds(points):
    """One point or several in the sea, n x 3."""
    given = np.empty((0, 2)) if np.size(points) == 0 else np.atleast_2d(_arguments.numbers(points, "seeds"))
    return _arguments.sphere_points(given, "seeds")


def _passages(given):
    """The lines of files, or of arrays, n x 3 each."""
    lines = []
    for each in _items(given):
        is_file = isinstance(each, (str, os.PathLike))
        lines += _calotte.read_lines(str(each)) if is_file else [_arguments.sphere_points(each, "points of passages")]
    return lines


def _warn_of_passages(stranded, where):
    if stranded:
        _arguments.warn(f"passages {where}, without effect: {', '.join(map(str, stranded))}; begin and end them in the "
                        "sea")


def cull(source: Path, target: Path, *, land: Path | Geometries | Sequence[Path | Geometries] | None = None,
         coast: Path | Geometries | None = None, raster: Path | LabelledRaster | None = None, raster_variable: str = "",
         raster_values: str = "height", land_fraction: float = 0.5, field: str = "",
         field_file: Path | None = None, sea_below: float | None = None,
         sea_from: float | None = None, passages: Path | Geometries | Sequence[Path | Geometries] | None = None,
         barriers: Path | Geometries | Sequence[Path | Geometries] | None = None, fill: bool = True, seeds: ArrayLike = (),
         least_area: float = 0, sea_ice_latitude: float | None = None,
         land_mesh: Path | None = None, mask: Path | None = None, cell_map: Path | None = None,
         sphere_radius: float | None = None, model: str | None = None) -> dict[str, Any]:
    """Removes the land cells from an MPAS file; all fields go along. Returns a dict of counts.

    The dict's severed_parts are the largest parts of the sea that are left out: the cells, longitude
    and latitude of the middle of each. Its stranded_passages are the passages that reach no sea, and
    have no effect: their numbers among the lines of all files, from 0 on.

    land: GeoJSON of land, or a binned file of GSHHG; one or several. coast: an older name of it.
    least_area: of the islands and lakes of the land that count, km^2 on the Earth.
    raster: a NetCDF raster of latitudes and longitudes, whose raster_values are "height" (below 0 is
        sea), "sea-fraction" or "land-fraction"; raster_variable: its variable, of a file with several.
    land_fraction: cells with a larger fraction of land are land.
    field: a variable with a number for each cell; from sea_from to below sea_below is sea (default
        below 0). field_file: its NetCDF file; default the source.
    passages, barriers: GeoJSON of lines whose cells are sea or land; one file or several.
    fill: cells with a single neighbour in the sea become land.
    seeds: points in the sea, longitude and latitude in degrees; default its largest part.
    sea_ice_latitude: from there on towards both poles, degrees, cells need a vertex whose three cells
        are sea, such as 43; default no such rule. Passages stay.
    land_mesh: MPAS file of all other cells; its number is the dict's others.
    mask: NetCDF file for masks by cell of the source, and its ids in both files. cell_map: folder for
        maps of cell numbers.
    sphere_radius: of the new file, metres; default that of the source. model: as for write().
    """
    if raster_values not in ("height", "sea-fraction", "land-fraction"):
        raise Error(f"raster_values is {raster_values!r}; give height, sea-fraction or "
                    "land-fraction")
    words = {"land": _files(land, "land") + _files(coast, "coast"), "passages": _files(passages, "passages"),
             "barriers": _files(barriers, "barriers"), "raster": "" if raster is None else os.fspath(raster),
             "raster_variable": raster_variable, "raster_values": raster_values, "field": field,
             "field_file": "" if field_file is None else str(field_file), "sea_from": sea_from,
             "sea_below": sea_below, "land_fraction": land_fraction, "least_area": least_area,
             "sea_ice_latitude": sea_ice_latitude,
             "land_mesh": "" if land_mesh is None else str(land_mesh)}
    report = _calotte.cull(str(source), str(target), words, fill, _seeds(seeds),
                           "" if mask is None else str(mask),
                           "" if cell_map is None else str(cell_map), sphere_radius, model)
    _warn_of_passages(report["stranded_passages"], "on land only")
    return report


def generalised_sea(coast: Path | Geometries | Sequence[Path | Geometries], cell_width: WidthLike, *,
                    region: SurfaceLike | None = None, least_island: float = 1.0,
                    passages: Path | Geometries | Sequence[Path | Geometries | ArrayLike] | None = None, seeds: ArrayLike = (),
                    earth_radius: float = EARTH_RADIUS_KM) -> GeneralisedSea:
    """The region of the sea at the widths of a grid, for a grid that ends at the coast, as `calotte
    coast` makes it.

    With the local width w, bays and straits narrower than w become land, and so do the seas behind
    them. Capes narrower than w become sea. Land between two parts of the sea stays. The rings have
    corners about w apart, on the coast where it is within w/2.

    coast: GeoJSON of land, or a binned file of GSHHG; one or several.
    cell_width, earth_radius: as for cvt(); rules must give a width everywhere.
    region: part of the sphere to which the sea belongs, as for refine(); its sides in the sea are open
        boundaries. Default: the whole sphere.
    least_island: islands and lakes of fewer cells do not count; from 0.25 on.
    passages: lines along which the sea is a cell wide at least, also over land, such as straits, and
        from their ends on to where the sea is as wide: GeoJSON, one file or several; or arrays as of
        lines of cvt().
    seeds: points in the sea, longitude and latitude in degrees. The region is what is connected with
        one of them; default the largest part of the sea.
    Returns a GeneralisedSea, a surface of cvt() and others; Surface.write() makes a file of it.
    Raises Error, with the number of the seed or of the passage.
    """
    widths = _arguments.rule(cell_width, earth_radius=earth_radius)
    if widths.of_plane:
        raise Error("cell_width is of a plane, and coasts are of the sphere; give widths in km")
    try:
        made = _calotte.generalised_sea(_files(coast, "coast"), widths.on_sphere(earth_radius),
                                        _arguments.surface(region, earth_radius=earth_radius), least_island,
                                        _passages(passages), _seeds(seeds))
    except Error as error:
        if str(error).startswith("line "):  # such as "line 0, point 3 is no direction"
            error.args = (f"passages: {error}",)
        raise
    for name in ("parts", "straits"):
        made[name] = tuple(ClosedSea(*row) for row in made[name])
    made["stranded_passages"] = tuple(made["stranded_passages"])
    _warn_of_passages(made["stranded_passages"], "that no sea of the region reaches")
    return GeneralisedSea(**made)
