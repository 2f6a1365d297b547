# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of other packages in place of files: geometries of shapely, geopandas or fiona, and rasters of xarray.

The library reads files alone. For the time of a call an object is a file of a temporary folder, and an error names the
object in its place.
"""
import contextlib
import json
import math
import os
import tempfile
from collections.abc import Mapping
from itertools import islice
from typing import Any, Protocol

import numpy as np

from . import _calotte, _labels
from ._calotte import Error, Surface

class Geometries(Protocol):
    """Geometries of shapely, geopandas or fiona, in place of a file of GeoJSON."""

    @property
    def __geo_interface__(self) -> Mapping[str, Any]: ...


class LabelledRaster(Protocol):
    """An xarray.DataArray of latitudes and longitudes, in place of a file of a raster."""

    def to_netcdf(self, *args: Any, **options: Any) -> Any: ...


#: Those that take names of files of geometries or rasters.
_ARGUMENTS = {"surface", "region", "rings", "lines", "land", "coast", "passages", "barriers", "raster", "path"}

#: Of these, those that also take arrays, and those of lines.
_OF_LINES = {"lines", "passages", "barriers"}
_OF_ARRAYS = _OF_LINES | {"rings"}

_GEOMETRIES = ("Point", "MultiPoint", "LineString", "MultiLineString", "Polygon", "MultiPolygon", "GeometryCollection",
               "Feature", "FeatureCollection")


def is_geometry(value):
    """Whether a value has the interface of geometries, or is an object of GeoJSON."""
    if isinstance(value, dict):
        return value.get("type") in _GEOMETRIES
    if type(value).__module__.startswith("calotte"):
        return False
    # Not hasattr(): it would make the GeoJSON of a whole frame.
    return hasattr(type(value), "__geo_interface__") or "__geo_interface__" in getattr(value, "__dict__", ())


def _are_geometries(value):
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(map(is_geometry, value))


def _is_raster(value):
    return _is_labelled(value) and _labels.find_lat_lon(value) is not None


def _is_labelled(value):
    return hasattr(value, "to_netcdf") and hasattr(value, "dims")


def _name(value):
    if isinstance(value, (list, tuple)):
        return f"the {type(value).__name__} of {_name(value[0])}"
    return "the GeoJSON" if isinstance(value, dict) else f"the {type(value).__name__}"


def _require_degrees(value, plane, what):
    """Refuses a frame of projected coordinates where longitudes and latitudes are meant."""
    if isinstance(value, (list, tuple)):
        for k, each in enumerate(value):
            _require_degrees(each, plane, f"{what}[{k}]")
    system = getattr(value, "crs", None)
    if not plane and system is not None and getattr(system, "is_geographic", True) is False:
        raise Error(f"{what} is {_name(value)} of projected coordinates; give longitudes and latitudes in degrees, as of "
                    "to_crs(4326)")


def _plain(value):
    """A value that JSON has; None for another one, such as a time or NaN."""
    if hasattr(value, "item") and getattr(value, "ndim", 1) == 0:
        value = value.item()
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    return value if isinstance(value, (bool, int, str)) else None


def _feature(value):
    """A geometry or a feature as a feature."""
    given = value if isinstance(value, dict) else value.__geo_interface__
    if given.get("type") != "Feature":
        return {"type": "Feature", "properties": {}, "geometry": given}
    properties = {key: _plain(each) for key, each in (given.get("properties") or {}).items()}
    return {"type": "Feature", "properties": {key: each for key, each in properties.items() if each is not None},
            "geometry": given.get("geometry")}


def _features(value):
    if isinstance(value, (list, tuple)):
        return [feature for each in value for feature in _features(each)]
    given = value if isinstance(value, dict) else value.__geo_interface__
    if given.get("type") == "FeatureCollection":
        if not isinstance(given.get("features"), (list, tuple)):
            raise Error(f'{_name(value)}: no array "features"; give GeoJSON as RFC 7946 has it')
        return [_feature(each) for each in given["features"]]
    return [_feature(given)]


def _text(features):
    """The text of a collection of features. What is not finite is null there, which readers refuse by its index."""
    collection = {"type": "FeatureCollection", "features": features}
    try:
        return json.dumps(collection, allow_nan=False)
    except ValueError:
        return json.dumps(_plain_numbers(collection))


def _plain_numbers(value):
    if isinstance(value, dict):
        return {key: _plain_numbers(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain_numbers(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _line(array):
    """A line, n x 2 or n x 3, as GeoJSON."""
    points = np.asarray(array, float)
    return {"type": "LineString",
            "coordinates": (_calotte.to_lonlat(points) if points.shape[1] == 3 else points).tolist()}


def _is_line(value):
    shape = np.shape(value) if isinstance(value, (np.ndarray, list, tuple)) else ()
    return len(shape) == 2 and shape[0] > 0 and shape[1] in (2, 3)


class _Folder:
    """A temporary folder of files, and the names of the objects in them."""

    def __init__(self, plane):
        self._plane, self._names = plane, {}
        self._folder = tempfile.TemporaryDirectory(prefix="calotte-")
        self.close = self._folder.cleanup

    def _path(self, value, suffix):
        path = os.path.join(self._folder.name, f"{len(self._names)}{suffix}")
        self._names[path] = _name(value)
        return path

    def replaced(self, value, what):
        """The name of a file of an object, or names of several; another value as it is."""
        if is_geometry(value) or _are_geometries(value):
            _require_degrees(value, self._plane, what)
            path, text = self._path(value, ".geojson"), _text(_features(value))
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            return path
        if _is_raster(value):
            path = self._path(value, ".nc")
            try:
                value.to_netcdf(path)
            except (ImportError, KeyError, TypeError, ValueError) as error:  # such as attributes that NetCDF lacks
                raise Error(f"{what}: {_name(value)} cannot be written to NetCDF: "
                            f"{' '.join(str(error).split())}") from None
            return path
        if _is_labelled(value) and what not in _OF_ARRAYS:
            _labels.lat_lon(value, f"the values of {what}")  # tells what is missing
        if _is_object(value):
            if what in _OF_LINES and all(is_geometry(each) or _is_line(each) for each in value):
                return self.replaced([each if is_geometry(each) else _line(each) for each in value], what)
            return [self.replaced(each, f"{what}[{k}]") for k, each in enumerate(value)]
        return value

    def rings(self, values):
        """The arguments of polygon(): a file of all geometries, or rings as they are."""
        if _are_geometries(values):
            return (self.replaced(values[0] if len(values) == 1 else values, "rings"),)
        if len(values) == 1:
            return (self.replaced(values[0], "rings"),)
        raise Error("rings are geometries and others; give all as geometries, or all as arrays")

    def named(self, text):
        for path, name in self._names.items():
            text = text.replace(repr(path), name).replace(path, name)
        return text


def _plane_is_meant(bound):
    surfaces = [bound.arguments.get("surface"), getattr(bound.arguments.get("mesh"), "surface", None)]
    return any(isinstance(each, Surface) and not each.is_sphere for each in surfaces)


def _is_object(value):
    """Whether a value is an object in place of a file, or a list with one among its first."""
    if is_geometry(value) or _is_raster(value):
        return True
    return isinstance(value, (list, tuple)) and any(is_geometry(each) or _is_raster(each) or _are_geometries(each)
                                                    for each in islice(value, 1000))


@contextlib.contextmanager
def in_files(bound, plane):
    """For the time of a call, files in place of the objects among its arguments, an inspect.BoundArguments.

    plane: whether the function is one of planes; others are if their arguments say so.
    """
    found = [name for name in _ARGUMENTS & bound.arguments.keys()
             if _is_object(bound.arguments[name]) or _is_labelled(bound.arguments[name])]
    if not found:
        yield
        return
    folder = _Folder(plane or _plane_is_meant(bound))
    try:
        for name in found:
            value = bound.arguments[name]
            bound.arguments[name] = folder.rings(value) if name == "rings" else folder.replaced(value, name)
        yield
    except Error as error:
        error.args = (folder.named(str(error)), *error.args[1:])
        raise
    finally:
        folder.close()
