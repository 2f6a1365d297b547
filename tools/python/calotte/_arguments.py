# SPDX-License-Identifier: GPL-3.0-or-later
"""What users pass, checked and brought to the form that the compiled part takes."""
import math
import warnings

import numpy as np

from . import _calotte
from ._calotte import Error

EARTH_RADIUS_KM = 6371.0


def numbers(values, what):
    """An array of doubles."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise Error(f"{what} must be numbers, not {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.float64)


def sphere_points(points, what="points"):
    """n x 3 directions, or n x 2 longitudes and latitudes in degrees, as n x 3."""
    array = numbers(points, what)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise Error(f"{what} have the shape {array.shape}; give n x 3, or n x 2 longitudes and "
                    "latitudes in degrees")
    if array.shape[1] == 3:
        return array
    longitudes, latitudes = np.abs(array[:, 0]), np.abs(array[:, 1])
    if len(array) > 100 and longitudes.max() <= 2 * math.pi and latitudes.max() <= math.pi / 2:
        warnings.warn(f"all {what} are within 6.3 degrees of each other; longitudes and latitudes "
                      "are taken as degrees, not radians", stacklevel=3)
    return _calotte.from_lonlat(array)


def plane_points(points, what="points"):
    """n x 2 places."""
    array = numbers(points, what)
    if array.ndim != 2 or array.shape[1] != 2:
        raise Error(f"{what} have the shape {array.shape}; give n x 2 in the plane")
    return array


def direction(place, what):
    """A longitude and latitude in degrees, or a vector."""
    return sphere_points(np.asarray(place)[np.newaxis], what)[0]


# ---- Widths and densities

def _raster(values, longitudes, latitudes):
    array = numbers(values, "cell widths")
    lon, lat = numbers(longitudes, "longitudes"), numbers(latitudes, "latitudes")
    if array.shape != (lat.size, lon.size):
        raise Error(f"cell widths have the shape {array.shape}; give latitudes x longitudes, here "
                    f"{lat.size} x {lon.size}")
    if lat.size > 1 and lat[0] > lat[-1]:
        array, lat = array[::-1], lat[::-1]
    if lon.size > 1 and math.isclose(lon[-1] - lon[0], 360):  # the first meridian is repeated
        array, lon = array[:, :-1], lon[:-1]
    if lat.size and np.abs(lat).max() <= math.pi / 2 and lat.size > 10:
        warnings.warn("all latitudes of the cell widths are within 1.6 degrees of the equator; "
                      "they are taken as degrees, not radians", stacklevel=4)
    return _calotte.CellWidth(np.ascontiguousarray(array), lon, np.ascontiguousarray(lat))


def _sampled(function, step=0.25):
    """Widths of a function at the nodes of a raster."""
    lon = np.arange(-180, 180, step)
    lat = np.linspace(-90, 90, round(180 / step) + 1)
    values = numbers(function(*np.meshgrid(lon, lat)), "cell widths")
    if values.shape != (lat.size, lon.size):
        raise Error("the width function must return one number for each of its places; it returned "
                    f"the shape {values.shape} for {(lat.size, lon.size)}")
    return _raster(values, lon, lat)


def cell_width(widths, earth_radius=EARTH_RADIUS_KM):
    """Widths in km of a number, a raster, a file or a function, as CellWidth."""
    if isinstance(widths, _calotte.CellWidth):
        return widths
    if isinstance(widths, (str, bytes)) or hasattr(widths, "__fspath__"):
        return _calotte.read_cell_width(str(widths), 0, 0, 0, earth_radius)
    if callable(widths):
        return _sampled(widths)
    if hasattr(widths, "dims") and hasattr(widths, "coords"):
        return _labelled(widths)
    if isinstance(widths, tuple):
        if len(widths) != 3:
            raise Error("give cell widths as (values, longitudes, latitudes)")
        return _raster(*widths)
    value = np.asarray(widths)
    if value.ndim != 0 or value.dtype.kind not in "fiu":
        raise Error("give cell widths as a number of km, (values, longitudes, latitudes), a "
                    "DataArray of lat and lon, a file or a function of longitude and latitude")
    return _raster(np.full((3, 4), float(value)), [-180, -90, 0, 90], [-90, 0, 90])


def _labelled(array):
    """An xarray.DataArray over latitude and longitude."""
    def axis(*names):
        for name in names:
            if name in array.dims:
                return name
        raise Error(f"cell widths have the dimensions {tuple(array.dims)}; name two of them lat "
                    "and lon")

    lat, lon = axis("lat", "latitude"), axis("lon", "longitude")
    ordered = array.transpose(lat, lon)
    return _raster(ordered.values, array.coords[lon].values, array.coords[lat].values)


def _bump_words(text):
    """A bump of the paper by its name: "x8", or lon=...,lat=...,beta=...,alpha=...,gamma=..."""
    if text.startswith("x") and text[1:].isdigit():
        return {"gamma": text}
    if not text.startswith("tanh"):
        raise Error(f"no density {text}; give uniform, x4, x8, x16 or tanh:lon=270,lat=30,...")
    words = {}
    for word in filter(None, text.removeprefix("tanh").removeprefix(":").split(",")):
        name, _, value = word.partition("=")
        words[name.strip()] = value.strip()
    unknown = set(words) - {"lon", "lat", "beta", "alpha", "gamma"}
    if unknown:
        raise Error(f"no parameter {min(unknown)} of a density; the parameters are lon, lat, beta, "
                    "alpha and gamma")
    return words


def _angle(text):
    if text.endswith("deg"):
        return float(text[:-3]) * math.pi / 180
    return float(text)


def _bump(text):
    words = _bump_words(text)
    try:
        gamma = words.get("gamma", "x8")
        contrast = float(gamma.removeprefix("x"))
        ratio = 1 / (contrast * contrast * contrast * contrast) if gamma[0] == "x" else contrast
        place = [[float(words.get("lon", 270)), float(words.get("lat", 30))]]
        beta, alpha = _angle(words.get("beta", "30deg")), _angle(words.get("alpha", "0.2"))
    except ValueError as error:
        if isinstance(error, Error):
            raise
        raise Error(f"density {text}: {error}") from None
    return _calotte.from_lonlat(np.array(place))[0], beta, alpha, ratio


def density(value, widths=None):
    """A density of a name, of widths or of a function."""
    if widths is not None:
        if value is not None:
            raise Error("give a density or cell widths, not both")
        same = np.ptp(widths.widths) == 0
        return _calotte.Density() if same else _calotte.density_of_widths(widths)
    if value is None or (isinstance(value, str) and value == "uniform"):
        return _calotte.Density()
    if isinstance(value, _calotte.Density):
        return value
    if isinstance(value, str):
        return _calotte.density_of_bumps([_bump(value)], False)
    if callable(value):
        return _calotte.density_of_function(value)
    raise Error("give a density as a name such as x8, or as a function of n x 3 points")


# ---- Parts of the sphere and of the plane

def region(value):
    """A region of the sphere; None is all of it."""
    if value is None:
        return _calotte.Region()
    if isinstance(value, _calotte.Region):
        return value
    if isinstance(value, str) or hasattr(value, "__fspath__"):
        return _calotte.read_region(str(value))
    raise Error("give a region as circle(), ellipse(), channel(), polygon() or a file")


def domain(value):
    """A domain of the plane."""
    if isinstance(value, _calotte.PlanarDomain):
        return value
    if isinstance(value, str) or hasattr(value, "__fspath__"):
        return _calotte.read_domain(str(value))
    raise Error("give a domain as rectangle(), periodic_box(), planar_polygon() or a file")
