# SPDX-License-Identifier: GPL-3.0-or-later
"""Delaunay triangulations and centroidal Voronoi tessellations of the sphere and the plane.

Points are n x 3 directions, or n x 2 longitudes and latitudes in degrees; in a plane n x 2, in any
unit. A Surface tells where points live; without one they live on the sphere.
Lengths on the sphere are radians and areas steradians, of the unit sphere; cell widths are km.
Results have the same bits for any number of threads. Functions raise calotte.Error, a ValueError.

>>> import calotte
>>> grid = calotte.cvt(2562)
>>> bool(calotte.check(grid.mesh))
True

calotte.scipy, calotte.stripy and calotte.mpas_tools replace classes and functions of these packages.
"""
import importlib

from . import _border, _display, _mesh, widths  # the second and third add methods that are written in Python
from ._calotte import (CellWidth, Check, Density, Error, IdLists, Locations, Mesh, OperatorErrors,
                       Polygons, Quality, Raster, Surface, Unit, Voronoi, Widths, __version__)
from ._functions import (Action, ChangedMesh, ChangedPatch, ClosedSea, Cvt, Gate, GeneralisedSea,
                         Locator, Plan, Weights, area_weights, bisect, bisected_icosahedron, box, cells_at, channel, check,
                         circle, coarsen, cubed_sphere, cull, cut, cvt, delaunay, density, ellipse,
                         fibonacci_sphere, from_lonlat, gates, generalised_sea, geodesic_sphere,
                         hexagonal_lattice, interpolate, interpolate_scattered, interpolation_weights, lat_lon_sphere,
                         limited_area, locate, neighbours, operator_errors, partition,
                         periodic_box, plan, planar_polygon, plane, polygon,
                         quality, random_points, raster, read, read_fields, read_points,
                         read_weights, rectangle, refine, rotate, spiral_sphere, threads, to_lonlat,
                         voronoi, write)
from ._multimesh import Multimesh, multimesh

__all__ = [
    "Action", "CellWidth", "ChangedMesh", "ChangedPatch", "Check", "ClosedSea", "Cvt", "Density", "Error",
    "Gate", "GeneralisedSea", "IdLists", "Locations", "Locator", "Mesh", "Multimesh", "OperatorErrors", "Plan", "Polygons",
    "Quality", "Raster", "Surface", "Unit", "Voronoi", "Weights", "Widths", "__version__", "area_weights",
    "bisect",
    "bisected_icosahedron", "box", "cells_at", "channel", "check", "circle", "coarsen", "cubed_sphere", "cull",
    "cut", "cvt", "delaunay", "density",
    "ellipse", "fibonacci_sphere", "from_lonlat", "gates", "generalised_sea", "geodesic_sphere",
    "hexagonal_lattice", "interpolate", "interpolate_scattered", "interpolation_weights", "lat_lon_sphere",
    "limited_area", "locate", "multimesh", "neighbours", "operator_errors", "partition", "periodic_box", "plan",
    "planar_polygon",
    "plane", "polygon", "quality",
    "random_points", "raster", "read", "read_fields", "read_points", "read_weights", "rectangle",
    "refine", "rotate", "spiral_sphere", "threads", "to_lonlat", "voronoi", "widths", "write",
]

_border.check_all(__all__, globals())
_border.check_all(widths.__all__, vars(widths))

_SUBMODULES = ("mpas_tools", "scipy", "stripy")


def __getattr__(name):
    if name in _SUBMODULES:
        return importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), *_SUBMODULES])
