# SPDX-License-Identifier: GPL-3.0-or-later
"""The unit in which people read lengths and areas: that of the command, see calotte info --units."""
from . import _calotte


def radius_of(grid):
    """km, of the planet that a mesh or polygons are of: of its widths or its file; or None."""
    own = vars(grid)
    if "_earth_radius" in own:
        return own["_earth_radius"]
    content = own.get("_content")
    metres = None if content is None else content.planet_radius
    return None if metres is None else metres / 1000


def radius_of_widths(mesh):
    """km, to which lengths refer in a change of a mesh: as of calotte refine."""
    content = vars(mesh).get("_content")
    return _calotte.radius_of_widths(radius_of(mesh), 1 if content is None else content.sphere_radius)


def unit_of(grid, units=None, earth_radius=None):
    """A Unit for a grid of the sphere; None in a plane."""
    if not grid.surface.is_sphere:
        if units is not None:
            raise _calotte.Error("a plane has the unit of its coordinates; leave units out")
        return None
    return _calotte.unit_of(units, radius_of(grid) if earth_radius is None else earth_radius)
