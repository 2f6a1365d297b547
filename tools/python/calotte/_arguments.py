# SPDX-License-Identifier: GPL-3.0-or-later
"""What users pass, checked and brought to the form that the compiled part takes."""
import math
import os
import sys
import warnings

import numpy as np

from . import _calotte, _labels
from ._calotte import Error
from ._oceans import GeneralisedSea

EARTH_RADIUS_KM = 6371.0
_FOLDER = os.path.dirname(__file__)


def warn(text):
    """A warning at the line of the user that called the package."""
    frame, depth = sys._getframe(1), 2
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == _FOLDER:
        frame, depth = frame.f_back, depth + 1
    warnings.warn(text, stacklevel=depth)


def numbers(values, what):
    """An array of doubles; NaN where values are masked, as netCDF4 masks what a file lacks."""
    array = values.data if isinstance(values, np.ma.MaskedArray) else np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise Error(f"{what} must be numbers, not {array.dtype}")
    if np.ma.is_masked(values):
        array = np.where(np.ma.getmaskarray(values), np.nan, array)
    return np.ascontiguousarray(array, dtype=np.float64)


_LONLAT, _XY, _XYZ = (_labels.LONGITUDES, _labels.LATITUDES), (("x",), ("y",)), (("x",), ("y",), ("z",))


def _named_columns(points, what, *choices):
    """The columns of a table of pandas or polars that have the names of a choice; other values as they are."""
    if not hasattr(points, "columns"):
        return points
    names = [str(name).lower() for name in points.columns]
    for choice in choices:
        found = [[k for k, name in enumerate(names) if name in words] for words in choice]
        if all(len(numbers) == 1 for numbers in found):
            return np.stack([np.asarray(points[points.columns[number]]) for (number,) in found], axis=1)
    raise Error(f"{what} are a table with the columns {', '.join(names) or 'none'}; name those of the position "
                + " or ".join(", ".join(words[0] for words in choice) for choice in choices)
                + ", or give an array, such as table.to_numpy()")


def sphere_points(points, what="points"):
    """n x 3 directions, or n x 2 longitudes and latitudes in degrees, as n x 3."""
    array = numbers(_named_columns(points, what, _LONLAT, _XYZ), what)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise Error(f"{what} have the shape {array.shape}; give n x 3, or n x 2 longitudes and "
                    "latitudes in degrees")
    if array.shape[1] == 3:
        return array
    longitudes, latitudes = np.abs(array[:, 0]), np.abs(array[:, 1])
    if len(array) > 100 and longitudes.max() <= 2 * math.pi and latitudes.max() <= math.pi / 2:
        warn(f"all {what} are within 6.3 degrees of each other; longitudes and latitudes are taken as degrees, not "
             "radians, and x and y of a plane need surface=, such as plane()")
    return _calotte.from_lonlat(array)


def plane_points(points, what="points"):
    """n x 2 points."""
    array = numbers(_named_columns(points, what, _XY), what)
    if array.ndim != 2 or array.shape[1] != 2:
        raise Error(f"{what} have the shape {array.shape}; give n x 2 for a surface in the plane")
    return array


def points_of(surface, points, what="points"):
    """Directions, or points of a plane."""
    return (sphere_points if surface.is_sphere else plane_points)(points, what)


def direction(point, what):
    """A longitude and latitude in degrees, or a vector."""
    array = numbers(point, what)
    if array.shape not in ((2,), (3,)):
        raise Error(f"{what} has the shape {array.shape}; give a longitude and a latitude in degrees, or a vector x, y, z")
    if array.size == 2 and not abs(array[1]) <= 90:
        raise Error(f"{what} has the latitude {array[1]:g}; give a longitude, then a latitude of -90 to 90 degrees")
    return sphere_points(array[np.newaxis], what)[0]


def latitudes(lower, upper, what):
    """Two latitudes in degrees, as radians."""
    values = [float(numbers(value, what)) for value in (lower, upper)]
    if not -90 <= values[0] < values[1] <= 90:
        raise Error(f"{what} are {lower!r} and {upper!r}; give the lower one first, -90 to 90 degrees")
    return [math.radians(value) for value in values]


# ---- Numbers with units

def kilometres(value, unit, what):
    """A length in km, of a unit that the command knows as well."""
    try:
        return value / (1 / _calotte.kilometres_in(unit))
    except Error:
        raise Error(f"{what} has the unit {unit!r}; give km or m") from None


def seconds(value, what):
    """A number of seconds, or text such as "12.42h"."""
    if not isinstance(value, str):
        return positive(value, what, "seconds")
    try:
        return _calotte.seconds_in(value)
    except Error as error:
        raise Error(f"{what}: {error}") from None


def positive(value, what, unit):
    """A positive number."""
    number = float(numbers(value, what))
    if not 0 < number < math.inf:
        raise Error(f"{what} is {value!r}; give a positive number of {unit}")
    return number


def angle(size, what, earth_radius=EARTH_RADIUS_KM):
    """A length on the sphere in radians: a number of degrees, or text such as "1000km", "30deg"."""
    if isinstance(size, str):
        parts = _calotte.measure_of(size)
        if parts is None or parts[1] not in ("km", "m", "deg"):
            raise Error(f"{what} is {size!r}; give a number of degrees, or a length such as "
                        "'1000km' or '30deg'")
        value, unit = parts
        radians = (math.radians(value) if unit == "deg" else
                   kilometres(value, unit, what) / positive(earth_radius, "the Earth's radius", "km"))
    else:
        radians = math.radians(float(numbers(size, what)))
    if not 0 < radians <= math.pi:
        raise Error(f"{what} is {size!r}; give a positive number of degrees, up to 180, or a length such as '1000km'")
    return radians


def warn_of_radians(latitudes, what):
    if latitudes.size > 10 and np.abs(latitudes).max() <= math.pi / 2:
        warn(f"all latitudes of {what} are within 1.6 degrees of the equator; they are taken as degrees, not radians")


# ---- Widths and densities

def raster(values, longitudes, latitudes):
    array = numbers(values, "cell widths")
    lon, lat = numbers(longitudes, "longitudes"), numbers(latitudes, "latitudes")
    if array.shape != (lat.size, lon.size):
        raise Error(f"cell widths have the shape {array.shape}; give latitudes x longitudes, here "
                    f"{lat.size} x {lon.size}")
    if lat.size > 1 and lat[0] > lat[-1]:
        array, lat = array[::-1], lat[::-1]
    if lon.size > 1 and math.isclose(lon[-1] - lon[0], 360):  # the first meridian is repeated
        array, lon = array[:, :-1], lon[:-1]
    warn_of_radians(lat, "the cell widths")
    return _calotte.CellWidth(np.ascontiguousarray(array), lon, np.ascontiguousarray(lat))


def _sampled(function, step=0.25):
    """Widths of a function at the nodes of a raster."""
    lon = np.arange(-180, 180, step)
    lat = np.linspace(-90, 90, round(180 / step) + 1)
    values = numbers(function(*np.meshgrid(lon, lat)), "cell widths")
    if values.shape != (lat.size, lon.size):
        raise Error("the width function must return one number for each of its points; it returned "
                    f"the shape {values.shape} for {(lat.size, lon.size)}")
    return raster(values, lon, lat)


def rule(widths, surface=None, earth_radius=EARTH_RADIUS_KM):
    """Widths of a number, text with a unit, a raster, a file or a function, as a rule; a rule as it is.

    surface: that the widths are for, where a function of x and y is sampled. Default: the sphere.
    """
    surface = _calotte.Surface() if surface is None else surface
    plane = not surface.is_sphere
    if isinstance(widths, _calotte.Widths):
        return widths
    if isinstance(widths, _calotte.CellWidth):
        return _calotte.Widths(widths)
    if isinstance(widths, str) and (parts := _calotte.measure_of(widths)):
        if plane and parts[1]:
            raise Error(f"the cell width is {widths!r}; the plane has the unit of its coordinates, "
                        "so give a number in that unit")
        return _calotte.Widths(parts[0] if plane else kilometres(*parts, "the cell width"))
    if isinstance(widths, str) or hasattr(widths, "__fspath__"):
        return _calotte.read_widths(str(widths), surface, earth_radius)
    if callable(widths):
        return _calotte.Widths(_sampled_in(widths, surface) if plane else _sampled(widths))
    if not plane and _labels.is_labelled(widths):
        return _calotte.Widths(_labelled(widths))
    if isinstance(widths, tuple):
        if len(widths) != 3:
            raise Error("give cell widths of a plane as (values, x, y)" if plane else
                        "give cell widths as (values, longitudes, latitudes)")
        return _calotte.Widths((planar_raster if plane else raster)(*widths))
    value = np.asarray(widths)
    if value.ndim != 0 or value.dtype.kind not in "fiu":
        raise Error("give cell widths of a plane as a number in its unit, (values, x, y), a file, a "
                    "rule or a function of x and y" if plane else
                    "give cell widths as a number of km, (values, longitudes, latitudes), a "
                    "DataArray of lat and lon, a file or a function of longitude and latitude")
    return _calotte.Widths(float(value))


def _sampled_in(function, plane):
    """Widths of a function of x and y at the nodes of a raster over a plane."""
    nodes = 1e5
    grid = _calotte.Widths(1.0).sampled(math.sqrt(plane.area / nodes), plane)
    values = numbers(function(*np.meshgrid(grid.x, grid.y)), "cell widths")
    if values.shape != (grid.y.size, grid.x.size):
        raise Error("the width function must return one number for each of its points; it returned "
                    f"the shape {values.shape} for {(grid.y.size, grid.x.size)}")
    return planar_raster(values, grid.x, grid.y)


def planar_raster(values, x, y):
    array = numbers(values, "cell widths")
    x, y = numbers(x, "x"), numbers(y, "y")
    if array.shape != (y.size, x.size):
        raise Error(f"cell widths have the shape {array.shape}; give y x x, here {y.size} x {x.size}")
    return _calotte.CellWidth(array, x, y, True)


def _labelled(array):
    """An xarray.DataArray over latitude and longitude."""
    lat, lon = _labels.lat_lon(array, "cell widths")
    array = array.squeeze([name for name, size in array.sizes.items() if size == 1 and name not in (lat, lon)])
    if array.ndim != 2:
        raise Error(f"cell widths have the dimensions {tuple(array.dims)}; choose one index of the others than {lat} and "
                    f"{lon}, as in isel(time=0)")
    ordered = array.transpose(lat, lon)
    unit = str(array.attrs.get("units", ""))
    values = numbers(ordered.values, "cell widths") * _calotte.kilometres_in(unit)
    return raster(values, array.coords[lon].values, array.coords[lat].values)


_USUAL = {"lon": "270", "lat": "30", "beta": "30deg", "alpha": "0.2", "gamma": "x8"}
_ON_SPHERE = (("lon", "lat", "beta", "alpha", "gamma"), ("stretch", "azimuth"))
_IN_PLANE = (("x", "y", "beta", "alpha", "gamma"), ("stretch", "angle"))


def _bump_words(text, plane):
    """A bump by its name: "x8", or tanh: with the words of `calotte help density`.

    On the sphere, words that are not given are those of the paper's bump.
    """
    if text.startswith("x") and text[1:].isdigit() and not plane:
        return _USUAL | {"gamma": text}
    if not text.startswith("tanh:"):
        raise Error(f"no density {text}; give uniform, x4, x8, x16 or "
                    "tanh:lon=270,lat=30,beta=30deg,alpha=0.2,gamma=x8")
    words = {} if plane else dict(_USUAL)
    for word in filter(None, text.removeprefix("tanh:").split(",")):
        name, _, value = word.partition("=")
        words[name.strip()] = value.strip()
    needed, further = _IN_PLANE if plane else _ON_SPHERE
    unknown = set(words) - {*needed, *further}
    if unknown:
        raise Error(f"no parameter {min(unknown)} of a density; the parameters are "
                    f"{', '.join((*needed, *further))}")
    missing = [name for name in needed if name not in words]
    if missing or len(set(further) & set(words)) == 1:
        name = missing[0] if missing else (set(further) - set(words)).pop()
        raise Error(f"density {text}: {name} is missing")
    return words


def _positive(text, name, value, in_degrees):
    unit = "radians, or degrees such as 30deg" if in_degrees else "the plane's unit"
    try:
        number = math.radians(float(value[:-3])) if in_degrees and value.endswith("deg") else float(value)
    except ValueError:
        raise Error(f"density {text}: {name} is {value!r}; give {unit}") from None
    if not number > 0:
        raise Error(f"density {text}: {name} {value!r} is not positive; give {unit}")
    return number


def _contrast(text, gamma):
    value = float(gamma.removeprefix("x"))
    if gamma.startswith("x"):
        value = 1 / (value * value * value * value)
    if not 0 < value < 1:
        raise Error(f"density {text}: gamma {gamma!r} is not between 0 and 1; give such a number, "
                    "or x8 for widths of 8:1")
    return value


def _heading(longitude, latitude, azimuth):
    """The unit tangent at a point, in the direction so many degrees clockwise from north."""
    north = ([longitude + 180, 90 - latitude] if latitude > 0 else [longitude, 90 + latitude])
    east, north, turn = _calotte.from_lonlat(np.array([[longitude + 90, 0], north, [azimuth, 0]],
                                                      dtype=float))
    return turn[0] * north + turn[1] * east


def _bump(text, plane=False):
    words = _bump_words(text, plane)
    try:
        ratio = _contrast(text, words["gamma"])
        beta, alpha = (_positive(text, name, words[name], not plane) for name in ("beta", "alpha"))
        stretch = float(words.get("stretch", 1))
        if plane:
            centre = [float(words["x"]), float(words["y"]), 0.0]
            major = _calotte.from_lonlat(np.array([[float(words.get("angle", 0)), 0.0]]))[0]
        else:
            point = float(words["lon"]), float(words["lat"])
            centre = _calotte.from_lonlat(np.array([point]))[0]
            major = (_heading(*point, float(words["azimuth"])) if "azimuth" in words
                     else np.array([1.0, 0.0, 0.0]))
    except ValueError as error:
        if isinstance(error, Error):
            raise
        raise Error(f"density {text}: {error}") from None
    if not stretch >= 1:
        raise Error(f"density {text}: stretch is below 1; give the ratio of the axes")
    return centre, beta, alpha, ratio, stretch, major


def bumps(names, join="maximum", plane=False):
    """A density of the names of bumps, of which the maximum or the sum counts."""
    if join not in ("maximum", "sum"):
        raise Error(f"join is {join!r}; give maximum or sum")
    if list(names) == ["uniform"]:
        return _calotte.Density()
    return _calotte.density_of_bumps([_bump(name, plane) for name in names], join == "sum")


def require_one(density, widths):
    if density is not None and widths is not None:
        raise Error("give a density or cell widths, not both")


def density(value, widths=None, plane=False):
    """A density of a name or several, of widths or of a function."""
    require_one(value, widths)
    if widths is not None:
        return _calotte.density_of_widths(widths)
    if value is None or (isinstance(value, str) and value == "uniform"):
        return _calotte.Density()
    if isinstance(value, _calotte.Density):
        return value
    if isinstance(value, str):
        return bumps([value], plane=plane)
    if callable(value):
        return _calotte.density_of_function(value)
    if isinstance(value, (list, tuple)) and value and all(isinstance(v, str) for v in value):
        return bumps(value, plane=plane)
    raise Error("give a density as a name such as x8, or as a function of n x 3 points")


# ---- Surfaces

_SURFACES = {False: "of the sphere: Surface(), circle(), ellipse(), box(), channel(), polygon(), text such as "
                    "'circle=-105,40,1000km' or 'box=-20,30,40,60', or a file",
             True: "of a plane: rectangle(), periodic_box() or planar_polygon()"}


def surface(value, plane=None, earth_radius=EARTH_RADIUS_KM) -> _calotte.Surface:
    """Where points live; None is the sphere. plane: whether it must be, and a file has, a plane."""
    if value is None:
        value = _calotte.Surface()
    elif isinstance(value, str) or hasattr(value, "__fspath__"):
        value = _named(str(value), plane, earth_radius)
    elif isinstance(value, GeneralisedSea):
        value = value.sea
    if isinstance(value, _calotte.Surface) and plane in (None, not value.is_sphere):
        return value
    kinds = [text for kind, text in _SURFACES.items() if plane in (None, kind)]
    raise Error(f"surface is {value!r}; give one {', or '.join(kinds)}")


def _named(text, plane, earth_radius):
    """The surface of a file, or of the sphere of a shape such as circle=-105,40,1000km, as the command has it."""
    is_file = os.path.exists(text)
    shape = "=" in text and not is_file
    try:
        return _calotte.read_domain(text) if plane and not shape else _calotte.read_region(text, earth_radius)
    except Error as error:
        if shape:
            error.args = (f"surface {error}",)
        elif plane is None and is_file and error.code != "file":
            error.args = (f"{error}; or give a file of a plane as planar_polygon({text!r})",)
        raise
