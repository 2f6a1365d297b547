# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules for cell widths: a width in km for every place of the Earth.

Rules, numbers of km, rasters and functions of longitude and latitude go in wherever a rule does, and
a rule goes in wherever cell widths do. Distances are along great circles, and km. With a plane as its
surface, a rule has the plane's unit, and places are x and y.

>>> from calotte import widths
>>> coast = widths.by_distance([(-10, 0), (10, 0)], near=10, far=60, over=600)
>>> zones = widths.by_latitude([(-90, 35), (0, 60), (90, 35)])
>>> rule = widths.minimum(zones, coast, 50).limit_gradient(0.03)
>>> rule([0, 90], [0, 0]).tolist()
[10.0, 50.0]
"""
import os

import numpy as np

from . import _arguments, _calotte, _labels
from ._calotte import Share, Widths

__all__ = ["Widths", "around", "blend", "by_channel", "by_depth", "by_latitude", "by_distance", "maximum", "minimum",
           "rule", "share", "sum", "where"]


def rule(widths):
    """A number of km, a raster, a file or a function of longitude and latitude, as a rule."""
    return _arguments.rule(widths)


def _nodes(pairs, what):
    nodes = _arguments.numbers(pairs, what)
    if nodes.ndim != 2 or nodes.shape[1] != 2:
        raise _calotte.Error(f"{what} have the shape {nodes.shape}; give pairs of a number and a width")
    return np.ascontiguousarray(nodes)


def _is_file(lines):
    return isinstance(lines, str) or hasattr(lines, "__fspath__")


def _lines(lines, surface):
    many = len(lines) > 0 and np.ndim(lines[0]) == 2
    return [_arguments.points_of(surface, line) for line in (lines if many else [lines])]


def by_latitude(nodes, *, smooth=False):
    """Widths by the latitude.

    nodes: pairs of a latitude in degrees and a width in km; between two, widths lie on a line, or
        with smooth on a cubic that is level at both.
    """
    return _calotte.widths_by_latitude(_nodes(nodes, "latitudes and widths"), smooth)


def by_distance(lines, near=None, far=None, over=None, *, profile=None, smooth=False, side=None,
                least_area=0, surface=None):
    """Widths by the distance from the nearest of some lines.

    lines: a file of lines, polygons or a coast, GeoJSON or GSHHG's .nc, or of points, .txt; one line
        as n x 2 longitudes and latitudes in degrees, or a list of such.
    near, far, over: the width at a line, and that from the distance `over` on; or
    profile: pairs of a distance and a width; with a file of polygons or a coast, negative distances
        are on land. smooth: as for by_latitude().
    side: "sea" or "land" of such a file, for a rule that says nothing on the other side.
    least_area: of the islands and lakes of such a file that count, km^2 on the Earth.
    surface: a plane, whose lines are n x 2, or a file of x and y, .geojson or .txt; distances are
        straight. Default: the sphere.
    """
    surface = _arguments.surface(surface)
    if side not in (None, "sea", "land"):
        raise _calotte.Error(f"the side {side!r} of a coast is neither sea nor land; give one of these")
    if (profile is None) != all(value is not None for value in (near, far, over)):
        raise _calotte.Error("give near, far and over, or a profile, but not both")
    if profile is None:
        unit = "km" if surface.is_sphere else "the plane's unit"
        for value, what in ((near, "near"), (far, "far"), (over, "over")):
            _arguments.positive(value, what, unit)
    nodes = _nodes([(0, near), (over, far)] if profile is None else profile, "distances and widths")
    is_file = _is_file(lines)
    signed = nodes.min(axis=0, initial=0)[0] < 0
    if side or signed or least_area:
        if not (is_file and surface.is_sphere):
            raise _calotte.Error("lines have no side of sea or land, and no area; give a file of polygons or a coast")
        return _calotte.widths_by_distance_from_coast(str(lines), nodes, smooth, side or ("both" if signed else ""),
                                                      least_area)
    if is_file:
        return _calotte.widths_by_distance_from_file(str(lines), nodes, smooth, surface)
    return _calotte.widths_by_distance(_lines(lines, surface), nodes, smooth, surface)


def around(lines, width, over, *, surface=None):
    """One width up to a distance from the nearest of some lines; beyond it the rule says nothing.

    lines, surface: as for by_distance(). width, over: the distance, km.
    """
    surface = _arguments.surface(surface)
    unit = "km" if surface.is_sphere else "the plane's unit"
    width, over = _arguments.positive(width, "the width", unit), _arguments.positive(over, "over", unit)
    if _is_file(lines):
        return _calotte.widths_around_file(str(lines), width, over, surface)
    return _calotte.widths_around(_lines(lines, surface), width, over, surface)


def by_depth(path, least, *, cells=None, period=None, rossby=None, slope=None, variable=""):
    """Widths by the depth of the sea, from NetCDF heights(lat, lon) in metres; of land none.

    period, cells: of a shallow-water wave, seconds or text such as "12.42h", and the cells in its length; or
    rossby: the cells in a Rossby radius; or slope: the cells in 2 pi depth / slope.
    least: the width at the shore, and where the sea is shallow. variable: of a file with several.
    """
    kinds = {"wavelength": cells if period is not None else None, "rossby": rossby, "slope": slope}
    given = [(kind, value) for kind, value in kinds.items() if value is not None]
    if len(given) != 1:
        raise _calotte.Error("give period and cells, or rossby, or slope")
    (kind, value), = given
    return _calotte.widths_by_depth(os.fspath(path), variable, kind, value,
                                    0.0 if period is None else _arguments.seconds(period, "period"), least)


def by_channel(coast, least, *, cells, widest=500, least_area=0):
    """Widths of which so many cells lie across each channel and strait; elsewhere the rule says nothing.

    coast: a file of polygons, GeoJSON or GSHHG's .nc. least: the width in channels narrower than so many.
    widest: of the channels that count, km. least_area: of the islands and lakes that count, km^2 on the Earth.
    """
    return _calotte.widths_by_channel(str(coast), cells, least, widest, least_area)


def minimum(*widths):
    """The least of several, place by place."""
    return _calotte.combined_widths("minimum", [rule(one) for one in widths])


def maximum(*widths):
    """The greatest of several, place by place."""
    return _calotte.combined_widths("maximum", [rule(one) for one in widths])


def sum(*widths):  # noqa: A001: of the module
    """The sum of several, place by place."""
    return _calotte.combined_widths("sum", [rule(one) for one in widths])


def share(region, over=None, *, profile=None, smooth=False, least_area=0, variable=""):
    """A share from 0 to 1 for every place, for where() and blend().

    region: a Surface, or a file of one: 1 inside and 0 outside; or a NetCDF file with t(lat, lon), the
        shares themselves, linear between nodes; or with over or a profile a coast, GSHHG's .nc, whose
        inside is the land. variable: of a file with several.
    over: outside the region the share falls to 0 at this distance, km; or
    profile: pairs of the distance from the region's boundary, negative inside, and a share. smooth: as
        for by_latitude().
    least_area: of the islands and lakes that count, km^2 on the Earth, of a coast, then GeoJSON, too.
    """
    if isinstance(region, Share):
        return region
    if over is not None:
        _arguments.positive(over, "over", "km")
    if over is not None and profile is not None:
        raise _calotte.Error("give over, or a profile, but not both")
    by_distance = over is not None or profile is not None
    if least_area and not (by_distance and _is_file(region)):
        raise _calotte.Error("islands are left out of the distance from the coast of a file; give a file, and over or a "
                             "profile")
    if str(region).endswith(".nc") and not by_distance:
        return _calotte.share_of_raster(str(region), variable)
    nodes = _nodes([(0, 1), (over, 0)] if profile is None else profile, "distances and shares") if by_distance else None
    if by_distance and _is_file(region) and (str(region).endswith(".nc") or least_area):
        return _calotte.share_by_distance_from_coast(str(region), nodes, smooth, least_area)
    surface = _arguments.surface(region)
    if not by_distance:
        return _calotte.share_of_region(surface)
    return _calotte.share_by_distance(surface, nodes, smooth)


def where(region, inside, outside):
    """One rule within a region, another outside it. region: as for share(); inside is from 1/2 on."""
    return _calotte.widths_where(share(region), rule(inside), rule(outside))


def blend(a, b, t):
    """(1 - t) a + t b, with a share t, or what share() takes as its region."""
    return _calotte.widths_blend(rule(a), rule(b), share(t))


def _at(self, longitudes, latitudes):
    """The widths in km at longitudes and latitudes in degrees, of a plane at x and y; broadcast.

    NaN where no rule gives one.
    """
    lon, lat = np.broadcast_arrays(np.asarray(longitudes, float), np.asarray(latitudes, float))
    places = np.stack([lon.ravel(), lat.ravel()], axis=1)
    widths = self.at(places if self.of_plane else _calotte.from_lonlat(places))
    return _demanded(widths).reshape(lon.shape)[()]


def _demanded(widths):
    return np.where(Widths.is_demand(widths), widths, np.nan)


def _to_xarray(self, step=0):
    """An xarray.DataArray over lat and lon, as sampled() makes it; NaN where no rule gives a width."""
    xarray = _labels.xarray("to_xarray()")
    wider = 4e8  # km, than any demand
    raster = minimum(self, wider).sampled(step)
    widths = np.where(raster.widths < wider, raster.widths, np.nan)
    return xarray.DataArray(widths, dims=("lat", "lon"), name="cellWidth",
                            coords={"lat": np.array(raster.latitudes), "lon": np.array(raster.longitudes)},
                            attrs={"units": "km"})


def _times(self, factor):
    return _calotte.widths_times(self, float(factor))


Widths.__call__ = _at
Widths.__mul__ = Widths.__rmul__ = _times
Widths.to_xarray = _to_xarray
