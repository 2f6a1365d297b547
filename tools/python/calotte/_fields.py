# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers at the cells of grids, with any further dimensions; of xarray with their names."""
from dataclasses import dataclass

import numpy as np

from . import _arguments, _calotte, _labels
from ._calotte import Error

#: Names of a dimension of cells, where several have their number.
_OF_CELLS = ("nCells", "cell", "cells", "ncells", "n_face", "nMesh2_face", "grid_size", "elementCount")
#: Attributes that hold for the source alone.
_OF_SOURCE = {"mesh", "location", "grid_mapping", "coordinates", "cell_measures", "grid_type", "CDI_grid_type"}


def content_of(grid):
    """What came from a file with a mesh or polygons, or None."""
    return vars(grid).get("_content")


# ---- The nodes of a raster

def _same_nodes(given, known, turn):
    apart = np.abs(given - known)
    if turn:
        apart = np.abs((apart + 180) % 360 - 180)
    return given.size == known.size and apart.max() <= 1e-3 * np.abs(np.diff(known)).min()


def _on_raster(array, raster):
    """The array with the latitudes in the raster's order, and the names of both dimensions."""
    lat, lon = _labels.lat_lon(array, "the values")
    shape = array.sizes[lat], array.sizes[lon]
    expected = len(raster.latitudes), len(raster.longitudes)
    if shape != expected:
        raise Error(f"the values have {shape[0]} latitudes and {shape[1]} longitudes, and the raster {expected[0]} and "
                    f"{expected[1]}; give the raster of the values, as raster(values) makes it")
    if lat in array.coords and array.coords[lat].ndim == 1:
        given = np.asarray(array.coords[lat].values, float)
        if not _same_nodes(given, raster.latitudes, False) and _same_nodes(given[::-1], raster.latitudes, False):
            array = array.isel({lat: slice(None, None, -1)})
    for name, known, turn in ((lat, raster.latitudes, False), (lon, raster.longitudes, True)):
        if name in array.coords and array.coords[name].ndim == 1 and not _same_nodes(
                np.asarray(array.coords[name].values, float), known, turn):
            raise Error(f"the coordinate {name} of the values is not that of the raster; give the raster of the values, "
                        "as raster(values) makes it")
    return array, (lat, lon)


# ---- The axes of the cells

def cell_axis(shape, cells, what, names=None):
    """The axis of the cells: the first one if it has their number, else the only one that has.

    names: of the axes, of which one such as nCells goes before all others.
    """
    fitting = [axis for axis, size in enumerate(shape) if size == cells]
    if names is not None:
        named = [axis for axis in fitting if names[axis] in _OF_CELLS]
        fitting = named if len(named) == 1 else fitting
    elif fitting[:1] == [0]:
        return 0
    if len(fitting) == 1:
        return fitting[0]
    given = f"the shape {tuple(shape)}" if names is None else f"the dimensions {dict(zip(names, shape))}"
    raise Error(f"{what} have {given}; give a number, or an array of them, for each of the {cells:d} cells"
                + (f", in one dimension of the {len(fitting)} of their number, named nCells" if fitting else ""))


@dataclass
class Field:
    """Numbers at the cells of a grid."""

    by_cell: np.ndarray  #: cells x numbers, contiguous
    axis: int  #: of the cells, where other axes keep their order
    others: tuple  #: sizes of the other axes
    array: object = None  #: of xarray, with its dimensions in their order
    dims: tuple = ()  #: of it, that number the cells

    def __post_init__(self):
        self.by_cell = np.ascontiguousarray(self.by_cell)


def field_at(values, cells, grid=None, what="values"):
    """The numbers at the cells of a grid, which may be None. Of a raster two axes may be latitudes and longitudes."""
    raster = grid if isinstance(grid, _calotte.Raster) else None
    if _labels.is_labelled(values):
        return _labelled_field(values, cells, grid, raster, what)
    array = _arguments.numbers(values, what)
    boxes = None if raster is None else (len(raster.latitudes), len(raster.longitudes))
    if boxes is not None and array.shape[-2:] == boxes:
        axis, others = array.ndim - 2, array.shape[:-2]
        return Field(array.reshape(-1, cells).T, axis, others)
    axis = cell_axis(array.shape, cells, what)
    others = array.shape[:axis] + array.shape[axis + 1:]
    return Field(np.moveaxis(array, axis, 0).reshape(cells, -1), axis, others)


def _labelled_field(array, cells, grid, raster, what):
    if raster is not None:
        array, dims = _on_raster(array, raster)
    else:
        dims = _dims_of_cells(array, cells, what)
        if grid is not None and len(dims) == 1:
            _require_order(array, dims[0], grid, what)
    others = [name for name in array.dims if name not in dims]
    axis = min(array.dims.index(name) for name in dims)
    numbers = _arguments.numbers(array.transpose(*dims, *others).values, what)
    return Field(numbers.reshape(cells, -1), axis, numbers.shape[len(dims):], array, dims)


def grid_of_cells(grid):
    """A mesh or polygons as interpolation takes them."""
    if isinstance(grid, _calotte.Polygons):
        return _calotte.grid_of_mesh(None, grid)
    content = content_of(grid)
    return _calotte.grid_of_mesh(grid, None if content is None else content.polygons)


def _require_order(array, dim, grid, what):
    """Longitudes and latitudes of an array are those of the cells."""
    positions = _labels.positions(array, dim)
    if positions is None or not grid.surface.is_sphere:
        return
    cells = grid_of_cells(grid)
    if len(cells) != len(positions):  # numbers at the sites of a mesh with other cells
        return
    known = np.isfinite(positions).all(axis=1) & (np.abs(positions[:, 1]) <= 90)
    points = np.full((len(positions), 3), np.nan)
    points[known] = _calotte.from_lonlat(np.ascontiguousarray(positions[known]))
    first = _calotte.first_misplaced(cells, points)
    if first >= 0:
        lon, lat = positions[first]
        raise Error(f"{what} have cell {first} at longitude {lon:g}, latitude {lat:g}, which is not in cell {first} of the "
                    "mesh; give the mesh of these values, or values in its order: files have that of the mesh with "
                    "order=\"input\"")


def _dims_of_cells(array, cells, what):
    try:
        return (array.dims[cell_axis(array.shape, cells, what, array.dims)],)
    except Error:
        dims = _labels.find_lat_lon(array)  # of a raster, whose weights a file holds
        if dims is None or array.sizes[dims[0]] * array.sizes[dims[1]] != cells:
            raise
        return dims


# ---- The values at another grid

def lonlat(grid):
    """Longitudes and latitudes of the cells of a mesh or of polygons, degrees, n x 2."""
    if not grid.surface.is_sphere:
        raise Error("a plane has no longitudes and latitudes; use points, or the centres of polygons")
    if not isinstance(grid, _calotte.Polygons):
        return _calotte.to_lonlat(grid.points)
    if len(grid.centres) == 0:
        raise Error("the file of the polygons gives no centres, so that they have no longitudes and latitudes; use corners")
    return _calotte.to_lonlat(grid.centres)


def _degrees(dim, positions):
    """Coordinates of positions, as xarray takes them."""
    return {name: (dim, positions[:, k].copy(), {"standard_name": word, "units": unit})
            for k, (name, word, unit) in enumerate((("lon", "longitude", "degrees_east"),
                                                    ("lat", "latitude", "degrees_north")))}


def _target_coords(target, dim):
    """Names of the target's dimensions, and its coordinates."""
    if isinstance(target, _calotte.Raster):
        nodes = {"lat": target.latitudes, "lon": target.longitudes}
        coords = {name: (name, *_degrees(name, np.stack([values, values], axis=1))[name][1:])
                  for name, values in nodes.items()}
        return ("lat", "lon"), coords
    if target is None:
        return (dim,), {}
    if isinstance(target, (_calotte.Mesh, _calotte.Polygons)):
        if isinstance(target, _calotte.Polygons) and len(target.centres) == 0:
            return (dim,), {}
        if target.surface.is_sphere:
            return (dim,), _degrees(dim, lonlat(target))
        positions = target.centres if isinstance(target, _calotte.Polygons) else target.points
    else:
        positions = target
    if positions.shape[1] == 3:
        return (dim,), _degrees(dim, _calotte.to_lonlat(np.ascontiguousarray(positions)))
    return (dim,), {name: (dim, positions[:, k].copy()) for k, name in enumerate("xy")}


def at_target(field, found, target, dim=None):
    """What was found, cells of the target x numbers, as an array such as the field is of.

    dim: the name of positions.
    """
    shaped = np.moveaxis(found.reshape(-1, *field.others), 0, field.axis)
    if field.array is None:
        return shaped
    if dim is None:
        dim = field.dims[0] if len(field.dims) == 1 else "nCells"
    dims, coords = _target_coords(target, dim)
    array = field.array
    names = [name for name in array.dims if name not in field.dims]
    names[field.axis:field.axis] = dims
    if isinstance(target, _calotte.Raster):
        sizes = len(target.latitudes), len(target.longitudes)
        shaped = shaped.reshape(*shaped.shape[:field.axis], *sizes, *shaped.shape[field.axis + 1:])
    kept = {name: coord for name, coord in array.coords.items() if not set(coord.dims) & set(field.dims)}
    attributes = {name: value for name, value in array.attrs.items() if name not in _OF_SOURCE}
    return type(array)(shaped, dims=names, coords={**kept, **coords}, attrs=attributes, name=array.name)


# ---- Fields of files

def choices(at):
    """Pairs of a dimension and an index."""
    for name, index in (at or {}).items():
        if isinstance(index, bool) or not isinstance(index, (int, np.integer)):
            raise Error(f"at gives {index!r} for the dimension {name}; give an index from 0 on, or -1 for the last")
    return [(str(name), int(index)) for name, index in (at or {}).items()]


def _names(count, first):
    """Names of dimensions that have none."""
    return [first if k == 0 else f"{first}_{k + 1}" for k in range(count)]


def _cells_of(grid, values):
    """The number of cells that an array is of: of the polygons of a mesh, or of its sites."""
    counts = [len(grid)]
    if isinstance(grid, _calotte.Mesh) and grid.cells is not None:
        counts.insert(0, len(grid.cells))
    return next((count for count in counts if count in np.shape(values)), counts[0])


def _texts(array):
    """Attributes that are text, without those that a file has of its own."""
    return [(str(name), value) for name, value in array.attrs.items()
            if isinstance(value, str) and name not in _OF_SOURCE | {"units", "long_name"}]


def state_of(grid, name, values):
    """A field as writers take it: values, dimensions, the number of those before the cells, attributes."""
    field = field_at(values, _cells_of(grid, values), grid, f"the values of {name}")
    leading, units, long_name, texts = field.axis, "", "", []
    names = _names(leading, "Time") + _names(len(field.others) - leading, "levels")
    if field.array is not None:
        names = [str(dim) for dim in field.array.dims if dim not in field.dims]
        units, long_name = (str(field.array.attrs.get(word, "")) for word in ("units", "long_name"))
        texts = _texts(field.array)
    dimensions = [(dim, size, False) for dim, size in zip(names, field.others)]
    return name, field.by_cell, dimensions, leading, units, long_name, texts


def one_by_cell(grid, field, cells, at):
    """One number for each cell, of a name, an array or a DataArray; and the name."""
    name = field if isinstance(field, str) else str(getattr(field, "name", None) or "")
    if isinstance(field, str):
        if name not in grid.fields:
            raise Error(f"no field {name}; give width, area, numbers, or one of the file's: "
                        f"{', '.join(sorted(grid.fields)) or 'none'}; read(fields=\"all\") takes all of them")
        values, names = grid.fields[name], _dimensions_of(grid, name)
        found = Field(values.reshape(len(values), -1), 0, values.shape[1:])
    else:
        found = field_at(field, cells, grid, f"the values of {name}" if name else "the values")
        names = None if found.array is None else [str(dim) for dim in found.array.dims if dim not in found.dims]
    values = _at(found, name or "the field", names, choices(at))
    if values.shape != (cells,):  # of a file, whose cells are not those of its mesh
        raise Error(f"{name} has {len(values)} numbers; give one for each of the {cells} cells")
    return values, name


def _dimensions_of(grid, name):
    content = content_of(grid)
    return None if content is None else list(content.dimensions[name])


def _at(field, name, names, at):
    """The numbers of a field at indices."""
    others = field.others
    if names is None:
        names = [f"axis {k + (k >= field.axis)}" for k in range(len(others))]
    dimensions = [(dim, size, False) for dim, size in zip(names, others)]
    try:
        index = tuple(_calotte.find_all_indices(name, dimensions, at))
    except Error as error:
        raise Error(str(error).replace("choose one index of each:", "choose one index of each by at:")) from None
    return np.ascontiguousarray(field.by_cell.reshape(-1, *others)[(slice(None), *index)])
