# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays with named dimensions: those of xarray, which is imported only to make one from none."""
import numpy as np

from ._calotte import Error


def xarray(what):
    """The module. what: needs it."""
    try:
        import xarray as module
    except ImportError:
        raise Error(f"{what} needs xarray and netCDF4; install them, as with pip install xarray netCDF4") from None
    return module


def is_labelled(values):
    """Whether an array has named dimensions, as those of xarray do."""
    if hasattr(values, "data_vars"):
        names = ", ".join(map(str, values.data_vars))
        raise Error(f"a Dataset holds several fields; give one of them, as in dataset[name] with one of: {names}")
    return hasattr(values, "dims") and hasattr(values, "coords")


# ---- Longitudes and latitudes

def _is_axis(array, name, words, units):
    if str(name).lower() in words:
        return True
    if name not in array.coords:
        return False
    attributes = array.coords[name].attrs
    return attributes.get("standard_name") == words[-1] or str(attributes.get("units", "")).lower() in units


LATITUDES, LONGITUDES = ("lat", "latitude"), ("lon", "longitude")
_LATITUDE = LATITUDES, ("degrees_north", "degree_north", "degrees_n")
_LONGITUDE = LONGITUDES, ("degrees_east", "degree_east", "degrees_e")


def find_lat_lon(array):
    """The names of the dimensions of latitude and longitude; None without one of each."""
    found = [[name for name in array.dims if _is_axis(array, name, *axis)] for axis in (_LATITUDE, _LONGITUDE)]
    return (found[0][0], found[1][0]) if [len(names) for names in found] == [1, 1] else None


def lat_lon(array, what):
    """The same; both must be there."""
    found = find_lat_lon(array)
    if found is None:
        raise Error(f"{what} have the dimensions {tuple(array.dims)}; name one of them lat and one lon, or give their "
                    "coordinates the attribute units, degrees_north and degrees_east")
    return found


def positions(array, dim):
    """Longitudes and latitudes along a dimension, degrees, n x 2; None where the array does not have both."""
    found = []
    for words, units in (_LONGITUDE, _LATITUDE):
        names = [name for name, coordinate in array.coords.items() if coordinate.dims == (dim,)
                 and (name == words[0] + "Cell" or _is_axis(array, name, words, units))]
        if not names:
            return None
        coordinate = array.coords[names[0]]
        unit = str(coordinate.attrs.get("units", "radians" if str(names[0]).endswith("Cell") else "degrees"))
        if not unit.startswith(("deg", "rad")):
            return None
        values = np.asarray(coordinate.values, float)
        found.append(np.degrees(values) if unit.startswith("rad") else values)
    return np.stack(found, axis=1)


def nodes(array):
    """Longitudes and latitudes of the nodes of an array or a Dataset, degrees."""
    lat, lon = lat_lon(array, "the values")
    for name in (lat, lon):
        if name not in array.coords:
            raise Error(f"the dimension {name} has no coordinate; give its degrees, as in assign_coords({name}=...)")
    return array.coords[lon].values, array.coords[lat].values
