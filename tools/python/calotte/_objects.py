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
from typing import Any, Protocol

from . import _labels
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

_GEOMETRIES = ("Point", "MultiPoint", "LineString", "MultiLineString", "Polygon", "MultiPolygon", "GeometryCollection",
               "Feature", "FeatureCollection")


def is_geometry(value):
    """Whether a value has the interface of geometries, or is an object of GeoJSON."""
    if isinstance(value, dict):
        return value.get("type") in _GEOMETRIES
    return not type(value).__module__.startswith("calotte") and hasattr(value, "__geo_interface__")


def _are_geometries(value):
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(map(is_geometry, value))


def _is_raster(value):
    return hasattr(value, "to_netcdf") and hasattr(value, "dims") and _labels.find_lat_lon(value) is not None


def _name(value):
    if isinstance(value, (list, tuple)):
        return f"the {type(value).__name__} of {_name(value[0])}"
    return "the GeoJSON" if isinstance(value, dict) else f"the {type(value).__name__}"


def _require_degrees(value, plane, what):
    """Refuses a frame of projected coordinates where longitudes and latitudes are meant."""
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
        return [_feature(each) for each in given["features"]]
    return [_feature(given)]


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
        """The name of a file of an object; another value as it is."""
        if is_geometry(value) or _are_geometries(value):
            _require_degrees(value, self._plane, what)
            path = self._path(value, ".geojson")
            with open(path, "w", encoding="utf-8") as file:
                json.dump({"type": "FeatureCollection", "features": _features(value)}, file)
            return path
        if _is_raster(value):
            path = self._path(value, ".nc")
            value.to_netcdf(path)
            return path
        if isinstance(value, (list, tuple)) and any(is_geometry(each) or _is_raster(each) for each in value):
            return [self.replaced(each, what) for each in value]
        return value

    def named(self, text):
        for path, name in self._names.items():
            text = text.replace(repr(path), name).replace(path, name)
        return text


def _plane_is_meant(bound):
    surfaces = [bound.arguments.get("surface"), getattr(bound.arguments.get("mesh"), "surface", None)]
    return any(isinstance(each, Surface) and not each.is_sphere for each in surfaces)


def _is_object(value):
    many = isinstance(value, (list, tuple)) and len(value) < 1000
    return is_geometry(value) or _is_raster(value) or (many and any(map(_is_object, value)))


@contextlib.contextmanager
def in_files(bound, plane):
    """For the time of a call, files in place of the objects among its arguments, an inspect.BoundArguments.

    plane: whether the function is one of planes; others are if their arguments say so.
    """
    found = [name for name in _ARGUMENTS & bound.arguments.keys() if _is_object(bound.arguments[name])]
    if not found:
        yield
        return
    folder = _Folder(plane or _plane_is_meant(bound))
    try:
        for name in found:
            value = bound.arguments[name]
            bound.arguments[name] = ((folder.replaced(value[0], name),) if name == "rings" and len(value) == 1 else
                                     folder.replaced(value, name))
        yield
    except Error as error:
        error.args = (folder.named(str(error)), *error.args[1:])
        raise
    finally:
        folder.close()
