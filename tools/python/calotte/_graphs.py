# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges between nodes as other packages take them."""
import math

import numpy as np

from . import _calotte
from ._calotte import Error


def _needed(name, what):
    raise Error(f"{what} needs {name}; install it, on Debian python3-{name}, or pip install {name}") from None


def sparse(sources, targets, size):
    """A scipy.sparse.csr_array of ones."""
    try:
        from scipy.sparse import csr_array
    except ImportError:
        _needed("scipy", "to_scipy_sparse()")
    return csr_array((np.ones(len(sources)), (sources, targets)), shape=(size, size))


def graph(pairs, size):
    """A networkx.Graph of pairs of nodes."""
    try:
        from networkx import Graph
    except ImportError:
        _needed("networkx", "to_networkx()")
    made = Graph()
    made.add_nodes_from(range(size))
    made.add_edges_from(pairs.tolist())
    return made


def frame(features, crs):
    """A geopandas.GeoDataFrame of features of GeoJSON. crs: of their coordinates, None for a plane without one."""
    try:
        from geopandas import GeoDataFrame
    except ImportError:
        _needed("geopandas", "to_geodataframe()")
    return GeoDataFrame.from_features(features, crs=crs)


def _is_pole(latitude):
    return abs(latitude) > 90 - 1e-9


def _cut(a, b):
    """The latitude at which the arc between two corners meets the meridian of 180 degrees."""
    p, q = _calotte.from_lonlat(np.array([a, b], float))
    return _calotte.to_lonlat((abs(q[1]) * p + abs(p[1]) * q)[np.newaxis])[0, 1]


def _enclosed(ring):
    """What a ring of longitudes and latitudes encloses, as a polygon whose longitudes continue beyond 180 degrees.

    A ring around the poles is closed along the north pole.
    """
    from shapely.geometry import Polygon
    first = next(k for k, (_, latitude) in enumerate(ring) if not _is_pole(latitude))
    ring = ring[first:-1] + ring[:first + 1]
    corners, pole = [ring[0]], 0
    for longitude, latitude in ring[1:]:
        if _is_pole(latitude):
            pole = math.copysign(90, latitude)
            continue
        last = corners[-1]
        step = abs(longitude - last[0])
        if not pole and abs(step - 180) < 1e-10:
            pole = math.copysign(90, latitude + last[1])
        if pole:
            corners += [(last[0], pole), (longitude, pole)]
        elif step > 180 and 180 not in (abs(last[0]), abs(longitude)):
            corners.append((math.copysign(180, last[0]), _cut(last, (longitude, latitude))))
        corners.append((longitude, latitude))
        pole = 0
    longitudes, latitudes = np.transpose(corners)
    corners = np.stack([np.unwrap(longitudes, period=360), latitudes], axis=1)
    west, east = corners[0, 0], corners[-1, 0]
    return Polygon([*corners, (east, 90), (west, 90)] if abs(east - west) > 180 else corners)


def outline(rings, inside):
    """A region of the sphere in the plane of longitude and latitude, valid there: cut at 180 degrees, and closed along
    the edge of the plane at a pole. rings: closed, in degrees. inside: a longitude and a latitude of the region."""
    from shapely.affinity import translate
    from shapely.geometry import Point, Polygon, box
    from shapely.validation import make_valid
    whole, found = box(-180, -90, 180, 90), Polygon()
    for ring in rings:
        part = make_valid(_enclosed(ring))
        west, _, east, _ = part.bounds
        for turn in range(math.floor((west + 180) / 360), math.ceil((east + 180) / 360)):
            found = found.symmetric_difference(translate(part, -360 * turn).intersection(whole))
    return found if found.contains(Point(inside)) else whole.difference(found)
