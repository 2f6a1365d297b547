# SPDX-License-Identifier: GPL-3.0-or-later
"""Methods of Mesh, Polygons and Surface that are written in Python."""
import json
import math
import os
import tempfile
import types

import numpy as np

from . import _arguments, _calotte, _fields, _functions, _graphs, _labels, _plot, _units


def _cells(mesh):
    """Polygons of the file, where the cells are not the Voronoi cells of a whole mesh; or None."""
    content = _functions.content_of(mesh)
    cells = None if content is None else content.polygons
    if cells is not None:
        cells._earth_radius = _units.radius_of(mesh)
    return cells


def _file_fields(grid):
    """The file's numbers at cells by name, each n or n x further dimensions, in the file's units."""
    content = _functions.content_of(grid)
    return types.MappingProxyType({} if content is None else content.fields)


def _earth_radius(grid):
    """Radius of the planet that the cells are of, km: of the widths, the file or its model; or None."""
    return _units.radius_of(grid)


_shapes_of = _calotte.Polygons.shapes


def _shapes(cells):
    """Measures of the polygons, see PolygonShapes."""
    found = _shapes_of(cells)
    found._unit = _units.unit_of(cells)
    return found


def _unit(measures):
    """The Unit in which lengths and areas are shown; None in a plane."""
    return vars(measures).get("_unit")


def _keep_unit(kind):
    """Pickled measures keep their unit."""
    measures_of, take_measures = kind.__getstate__, kind.__setstate__

    def state_of(measures):
        return measures_of(measures), vars(measures)

    def take_state(measures, state):
        take_measures(measures, state[0])
        vars(measures).update(state[1])

    kind.__getstate__, kind.__setstate__ = state_of, take_state


def _lonlat(grid, k):
    try:
        return _fields.lonlat(grid)[:, k]
    except _calotte.Error as error:  # hasattr() is false then
        raise AttributeError(str(error)) from None


def _lon(grid):
    """(n,) longitudes of the sites, or of the centres of polygons; degrees, -180 to 180."""
    return _lonlat(grid, 0)


def _lat(grid):
    """(n,) latitudes of the sites, or of the centres of polygons; degrees."""
    return _lonlat(grid, 1)


def _not_voronoi(cells):
    """Why the polygons are not the Voronoi cells of a whole mesh."""
    content = _functions.content_of(cells)
    return "" if content is None else content.not_voronoi


def _to_mpas(grid, path, **options):
    """Writes a complete MPAS mesh and its graph.info; options as write()."""
    _functions.write(path, grid, format="mpas", **options)


def _to_xarray(grid, format="mpas", order="input", **options):
    """An xarray.Dataset of the conventions of a NetCDF format: mpas, ugrid, scrip ...

    order: of the cells: "input", that of the mesh and of arrays beside it, or "curve", that of files
    which write() makes without an order. Other options as write(). It needs xarray and netCDF4.
    """
    xarray = _labels.xarray("to_xarray()")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.nc")
        _functions.write(path, grid, format=format, order=order, **options)
        return xarray.load_dataset(path)


def _features(write):
    """The features of the GeoJSON that write(path) makes, which is split where it crosses 180 degrees."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "cells.geojson")
        write(path)
        with open(path, encoding="utf-8") as file:
            return json.load(file)["features"]


def _to_geodataframe(grid, **options):
    """A geopandas.GeoDataFrame of the cells in longitude and latitude, in their order, with their areas
    and the fields of the file as columns. Cells that cross 180 degrees are split, and that at a pole
    reaches it. Those of a plane are in its x and y. Options as write(). It needs geopandas."""
    features = _features(lambda path: _functions.write(path, grid, order="input", **options))
    return _graphs.frame(features, 4326 if grid.surface.is_sphere else None)


def _region_to_geodataframe(surface):
    """A geopandas.GeoDataFrame of a region of the sphere, in longitude and latitude. The region is split where it
    crosses 180 degrees, and reaches a pole inside. write() makes a file that any region is read from. It needs geopandas."""
    (feature,) = _features(surface.write)
    frame = _graphs.frame([{"properties": {}, "geometry": feature["geometry"]}], 4326)
    frame.geometry = [_graphs.outline(feature["geometry"]["coordinates"], feature["properties"]["inside"])]
    return frame


def _to_scipy_sparse(grid):
    """Which cells are neighbours, as a symmetric scipy.sparse.csr_array of ones, n x n. It needs scipy."""
    around = _functions.neighbours(grid)
    return _graphs.sparse(np.repeat(np.arange(len(around)), np.diff(around.begin)), around.ids, len(around))


def _to_networkx(grid):
    """The cells and their neighbours as a networkx.Graph. It needs networkx."""
    around = _functions.neighbours(grid)
    cells = np.repeat(np.arange(len(around)), np.diff(around.begin))
    once = cells < around.ids
    return _graphs.graph(np.stack([cells[once], around.ids[once]], axis=1), len(around))


def _topology(mesh):
    """The arguments of uxarray.Grid.from_topology for the cells of the mesh."""
    if not mesh.surface.is_sphere:
        raise _calotte.Error("the topology has longitudes and latitudes, and a plane has none")
    begin, ids, corners = _plot.rings(mesh)
    degrees = np.diff(begin)
    width, fill = int(degrees.max()), -1
    faces = np.full((len(degrees), width), fill, dtype=np.int64)
    faces[np.arange(width) < degrees[:, np.newaxis]] = ids
    nodes = _functions.to_lonlat(corners)
    return {"node_lon": nodes[:, 0].copy(), "node_lat": nodes[:, 1].copy(),
            "face_node_connectivity": faces, "fill_value": fill, "start_index": 0}


def _contains(surface, points):
    """(n,) whether each point, as those of locate(), lies inside or on the boundary."""
    return _calotte.contains(surface, _arguments.points_of(surface, points))


def _write_region(surface, path):
    """Writes a region of the sphere to GeoJSON (.geojson, .json), a `surface` of functions and `--region` of the command."""
    _calotte.write_region(str(path), surface)


# ---- What the command prints of operators

def _at(norms):
    """Longitude and latitude of the greatest value on the sphere, degrees; see position in a plane."""
    if not norms.position.any():
        return math.nan, math.nan
    return tuple(_calotte.to_lonlat(norms.position[np.newaxis])[0].tolist())


def _wave_step(errors, speed, radius=1.0):
    """Longest stable step of gravity waves, by the Runge-Kutta method of order 4.

    speed: sqrt(g H), in the unit of length over that of time. radius: of the sphere, in the unit of
    length; 1 in a plane.
    """
    speed = _arguments.positive(speed, "the speed", "the unit of length over that of time, such as m/s")
    radius = _arguments.positive(radius, "the radius", "the unit of length, such as m")
    return float(np.sqrt(8 / errors.primal_eigenvalue)) * radius / speed


def _diffusion_step(errors, viscosity, radius=1.0, of="divergence"):
    """Longest stable step of a diffusion, by Euler's forward method.

    viscosity: in the square of the unit of length over that of time. radius: as in wave_step(). of:
    "divergence" or "vorticity".
    """
    values = {"divergence": errors.primal_eigenvalue, "vorticity": errors.dual_eigenvalue}
    if of not in values:
        raise _calotte.Error(f"no diffusion of {of}; give divergence or vorticity")
    viscosity = _arguments.positive(viscosity, "the viscosity",
                                    "the square of the unit of length over that of time, such as m^2/s")
    radius = _arguments.positive(radius, "the radius", "the unit of length, such as m")
    return 2 * radius**2 / (viscosity * values[of])


_calotte.ErrorNorms.at = property(_at, doc=_at.__doc__)
_calotte.OperatorErrors.wave_step = _wave_step
_calotte.OperatorErrors.diffusion_step = _diffusion_step
_calotte.Surface.contains = _contains
_calotte.Surface.write = _write_region
_calotte.Surface.to_geodataframe = _region_to_geodataframe
for _class in (_calotte.Mesh, _calotte.Polygons):
    _class.fields = property(_file_fields, doc=_file_fields.__doc__)
    _class.earth_radius = property(_earth_radius, doc=_earth_radius.__doc__)
    _class.lon = property(_lon, doc=_lon.__doc__)
    _class.lat = property(_lat, doc=_lat.__doc__)
    _class.to_mpas = _to_mpas
    _class.to_xarray = _to_xarray
    _class.to_geodataframe = _to_geodataframe
    _class.to_networkx = _to_networkx
    _class.to_scipy_sparse = _to_scipy_sparse
    _class.plot = _plot.plot
    _class.topology = _topology
_calotte.Polygons.shapes = _shapes
for _class in (_calotte.Quality, _calotte.PolygonShapes):
    _class.unit = property(_unit, doc=_unit.__doc__)
    _keep_unit(_class)
_calotte.Mesh.cells = property(_cells, doc=_cells.__doc__)
_calotte.Polygons.not_voronoi = property(_not_voronoi, doc=_not_voronoi.__doc__)
