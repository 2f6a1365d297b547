# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of cells, by matplotlib; the projections of cartopy where it is installed."""
from dataclasses import dataclass

import numpy as np

from . import _arguments, _calotte, _display, _fields, _functions, _units
from ._calotte import Error

_DEGREES = 180 / np.pi


# ---- The cells: begin, ids and corners, as Polygons has them

def _around_sites(mesh, offsets):
    """The cells of the sites that triangles surround; others have no corners.

    offsets: of triangles and their sites, the way from the site to the triangle's centre in a plane
        at the site.
    """
    sites = mesh.triangles.ravel()
    triangle = np.repeat(np.arange(len(mesh.triangles)), 3)
    outside = np.zeros(len(mesh), dtype=bool)
    for slot in range(3):
        at_border = mesh.neighbours[:, slot] < 0
        for end in (1, 2):
            outside[mesh.triangles[at_border, (slot + end) % 3]] = True
    keep = ~outside[sites]
    sites, triangle = sites[keep], triangle[keep]
    offset = offsets(triangle, sites)
    order = np.lexsort((np.arctan2(offset[:, 1], offset[:, 0]), sites))
    begin = np.concatenate([[0], np.cumsum(np.bincount(sites, minlength=len(mesh)))])
    return begin, triangle[order]


def _whole_cells(mesh):
    """Of an open mesh of the sphere."""
    unit = mesh.points / np.linalg.norm(mesh.points, axis=1, keepdims=True)
    a, b, c = (unit[mesh.triangles[:, k]] for k in range(3))
    corners = np.cross(b - a, c - a)
    corners /= np.linalg.norm(corners, axis=1, keepdims=True)
    east = np.cross([0.0, 0.0, 1.0], unit)
    poles = np.linalg.norm(east, axis=1) < 1e-12
    east[poles] = [1.0, 0.0, 0.0]
    east /= np.linalg.norm(east, axis=1, keepdims=True)
    north = np.cross(unit, east)

    def offsets(triangle, site):
        apart = corners[triangle] - unit[site]
        return np.stack([np.einsum("ij,ij->i", apart, east[site]),
                         np.einsum("ij,ij->i", apart, north[site])], axis=1)

    begin, ids = _around_sites(mesh, offsets)
    return begin, ids, corners


def _whole_planar_cells(mesh):
    """Of a mesh of the plane without an end."""
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    period = mesh.surface.period
    b, c = (_display.nearest(end - a, period) for end in (b, c))
    twice = 2 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    bb, cc = (b**2).sum(axis=1), (c**2).sum(axis=1)
    corners = a + np.stack([c[:, 1] * bb - b[:, 1] * cc, b[:, 0] * cc - c[:, 0] * bb],
                           axis=1) / twice[:, np.newaxis]

    def offsets(triangle, site):
        return _display.nearest(corners[triangle] - mesh.points[site], period)

    begin, ids = _around_sites(mesh, offsets)
    flat = np.column_stack([corners, np.zeros(len(corners))])
    return _unrolled(begin, ids, flat, period)


def _unrolled(begin, ids, corners, period):
    """In a periodic plane: each cell with corners of its own, the copies nearest to the first."""
    if not period.any():
        return begin, ids, corners
    places = corners[ids]
    first = np.repeat(places[begin[:-1].clip(max=len(ids) - 1), :2], np.diff(begin), axis=0)
    places[:, :2] = first + _display.nearest(places[:, :2] - first, period)
    return begin, np.arange(len(places)), places


def rings(grid, surface=None):
    """begin, ids and corners of the cells of a mesh or of polygons; some may have no corners."""
    polygons = grid if isinstance(grid, _calotte.Polygons) else grid.cells
    if polygons is not None and (surface is None or polygons is grid):
        return _unrolled(polygons.begin, polygons.ids, polygons.corners, polygons.surface.period)
    mesh = _functions.within(grid, surface)
    surface = mesh.surface
    if surface.is_sphere and not mesh.closed:
        return _whole_cells(mesh)
    if np.isinf(surface.area):
        return _whole_planar_cells(mesh)
    cells = _calotte.voronoi(mesh)
    return _unrolled(cells.begin, cells.vertices_on_cell, cells.vertices, surface.period)


def _areas(begin, ids, corners, spherical):
    """Of convex cells: sums of triangles between the first corner and the others."""
    if spherical:
        return _calotte.Polygons(corners, begin, ids).areas
    following = np.arange(len(ids)) + 1
    degrees = np.diff(begin)
    some = degrees > 0
    following[begin[1:][some] - 1] = begin[:-1][some]
    x, y = corners[ids, 0], corners[ids, 1]
    cross = x * y[following] - y * x[following]
    cell = np.repeat(np.arange(len(degrees)), degrees)
    return 0.5 * np.bincount(cell, weights=cross, minlength=len(degrees))


# ---- Values

def _values(grid, field, at, areas, unit):
    """Numbers by cell, and their name."""
    if field is None or (isinstance(field, str) and field in ("width", "area")):
        if at:
            raise Error("at chooses indices of a field; give the field")
        if field == "area":
            return (areas, "cell area") if unit is None else (
                areas * unit.of_steradian, f"cell area, {unit.area}")
        widths = np.sqrt(2 / np.sqrt(3) * areas)
        return (widths, "cell width") if unit is None else (
            widths * unit.of_radian, f"cell width, {unit.name}")
    values, name = _fields.one_by_cell(grid, field, len(areas), at)
    indices = ", ".join(f"{dim}={index}" for dim, index in (at or {}).items())
    return values, f"{name} at {indices}".strip() if indices else name


# ---- Polygons of a picture

def _unwrapped(longitudes, cell, centre):
    """Longitudes of corners within half a turn of the centre of their cells."""
    return centre[cell] + (longitudes - centre[cell] + 180) % 360 - 180


def _middle(begin, ids, corners, areas):
    """The mean of the cells' places, weighted by area; near 0 for cells all around the sphere."""
    cell = np.repeat(np.arange(len(areas)), np.diff(begin))
    weights = (areas / np.maximum(np.diff(begin), 1))[cell]
    return weights @ corners[ids] / areas.sum()


def _split(places, begin):
    return np.split(places, begin[1:-1])


def _pole_ring(ring, latitude):
    """The ring of a cell around a pole, in longitude and latitude, closed along the map's edge."""
    ring = ring.copy()
    ring[:, 0] = np.degrees(np.unwrap(np.radians(ring[:, 0])))
    turn = np.sign(ring[-1, 0] - ring[0, 0]) * 360
    ring = ring[np.argsort(ring[:, 0])]
    end = ring[0] + [abs(turn), 0]
    return np.vstack([ring, end, [[end[0], latitude], [ring[0, 0], latitude]]])


def _holds_pole(ring, centre_latitude):
    """90 or -90 where a ring runs around a pole, or 0."""
    steps = (np.diff(np.append(ring[:, 0], ring[0, 0])) + 180) % 360 - 180
    return 0 if abs(steps.sum()) < 180 else 90 if centre_latitude > 0 else -90


def _map(begin, ids, corners, middle):
    """Polygons of longitudes and latitudes around the meridian `middle`, and their cells."""
    lonlat = _calotte.to_lonlat(np.ascontiguousarray(corners))
    cell = np.repeat(np.arange(len(begin) - 1), np.diff(begin))
    sums = np.stack([np.bincount(cell, weights=corners[ids, k], minlength=len(begin) - 1)
                     for k in range(3)], axis=1)
    centre = np.degrees(np.arctan2(sums[:, 1], sums[:, 0]))
    centre = middle + (centre - middle + 180) % 360 - 180
    places = lonlat[ids]
    latitudes = np.arctan2(sums[:, 2], np.hypot(sums[:, 0], sums[:, 1])) * _DEGREES
    places[:, 0] = _unwrapped(places[:, 0], cell, centre)
    parts, owners = _split(places, begin), np.arange(len(begin) - 1)
    extra, extra_owners = [], []
    edge = np.zeros(len(centre))
    np.maximum.at(edge, cell, np.abs(places[:, 0] - middle))
    for k in np.flatnonzero(edge > 180):
        pole = _holds_pole(parts[k], latitudes[k])
        if pole:
            parts[k] = _pole_ring(parts[k], pole)
        for turn in (-360, 360):
            extra.append(parts[k] + [turn, 0])
            extra_owners.append(k)
    near_pole = np.flatnonzero((edge <= 180) & (np.abs(latitudes) > 80))
    for k in near_pole:
        if len(parts[k]) and (pole := _holds_pole(parts[k], latitudes[k])):
            parts[k] = _pole_ring(parts[k], pole)
            for turn in (-360, 360):
                extra.append(parts[k] + [turn, 0])
                extra_owners.append(k)
    return parts + extra, np.concatenate([owners, np.array(extra_owners, dtype=int)])


def _globe_axes(view):
    towards = _arguments.direction(view, "the view")
    towards = towards / np.linalg.norm(towards)
    east = np.cross([0.0, 0.0, 1.0], towards)
    east = east / np.linalg.norm(east) if np.linalg.norm(east) > 1e-12 else np.array([0.0, 1.0, 0.0])
    return np.stack([east, np.cross(towards, east), towards])


def _globe(begin, ids, corners, frame):
    """Polygons of the half of the sphere that is seen, and their cells."""
    seen = corners @ frame.T
    places = seen[ids]
    cell = np.repeat(np.arange(len(begin) - 1), np.diff(begin))
    lowest = np.full(len(begin) - 1, np.inf)
    np.minimum.at(lowest, cell, places[:, 2])
    shown = np.flatnonzero((lowest > 0) & np.isfinite(lowest))
    parts = _split(places[:, :2], begin)
    return [parts[k] for k in shown], shown


def _projected(begin, ids, corners, projection):
    """Polygons in a projection of cartopy; those that its edge cuts are left out."""
    import cartopy.crs
    lonlat = _calotte.to_lonlat(np.ascontiguousarray(corners))
    places = projection.transform_points(cartopy.crs.PlateCarree(), lonlat[:, 0],
                                         lonlat[:, 1])[ids, :2]
    cell = np.repeat(np.arange(len(begin) - 1), np.diff(begin))
    low, high = np.full((2, len(begin) - 1), np.inf)
    finite = np.isfinite(places).all(axis=1)
    np.minimum.at(low, cell, np.where(finite, places[:, 0], -np.inf))
    high = -high
    np.maximum.at(high, cell, np.where(finite, places[:, 0], np.inf))
    half = np.ptp(projection.x_limits) / 2
    shown = np.flatnonzero((high - low < half) & (np.diff(begin) > 0))
    parts = _split(places, begin)
    return [parts[k] for k in shown], shown


# ---- The coast

def _coast_lines(coast):
    """Lines of longitudes and latitudes in degrees."""
    if coast is True:
        return _calotte.coastlines()
    lines = []
    for ring in _calotte.coast_rings(str(coast)):
        line = _calotte.to_lonlat(ring)
        line[:, 0] = np.degrees(np.unwrap(np.radians(line[:, 0])))
        lines.append(line)
    return lines


def _draw_coast(ax, coast, middle, frame):
    from matplotlib.collections import LineCollection
    style = {"colors": "0.25", "linewidths": 0.6, "zorder": 3}
    lines = _coast_lines(coast)
    if hasattr(ax, "projection"):
        import cartopy.crs
        for line in lines:
            ax.plot(line[:, 0], line[:, 1], color="0.25", linewidth=0.6, zorder=3,
                    transform=cartopy.crs.PlateCarree())
    elif frame is not None:
        parts = []
        for line in lines:
            seen = _calotte.from_lonlat(np.ascontiguousarray(
                np.column_stack([line[:, 0], np.clip(line[:, 1], -90, 90)]))) @ frame.T
            seen[seen[:, 2] <= 0] = np.nan
            parts.append(seen[:, :2])
        ax.add_collection(LineCollection(parts, **style), autolim=False)
    else:
        turns = [360 * (round(middle / 360) + k) for k in (-1, 0, 1)]
        ax.add_collection(LineCollection([line + [turn, 0] for line in lines for turn in turns],
                                         **style), autolim=False)


# ---- The picture

def _matplotlib():
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise Error("plot() needs matplotlib; install it, as with pip install matplotlib") from None
    return plt


def _new_axes(projection):
    plt = _matplotlib()
    if projection is None:
        return plt.subplots(figsize=(9, 5), layout="constrained")[1]
    try:
        import cartopy  # noqa: F401
    except ImportError:
        raise Error("a projection needs cartopy; install it, or give view=(longitude, latitude) "
                    "for a globe") from None
    return plt.figure(figsize=(9, 5), layout="constrained").add_subplot(projection=projection)


def plot(self, field=None, *, at=None, ax=None, projection=None, view=None, coast=True, surface=None,
         cmap=None, vmin=None, vmax=None, edgecolor=None, linewidth=0.2, colorbar=True, label=None,
         units=None, earth_radius=None):
    """Draws the cells, coloured by a field. Returns the axes of matplotlib, which it needs.

    field: "width" (default: distance between the centres of hexagons of a cell's area), "area",
        the name of one of `fields`, or n numbers, with any further dimensions; also of xarray.
    at: indices in these, as for read(): {"Time": 3, "lev": 0}. Of an array without names they are
        "axis 0" and so on.
    ax: axes to draw in; those of cartopy give the projection. Default: new ones.
    projection: of cartopy, for new axes. Default: longitude and latitude.
    view: longitude and latitude in degrees of the middle of a globe, in place of a map.
    coast: True draws coastlines (Natural Earth, 1:110 million), False none; or a file of land as
        `calotte cull --land` reads it. In a plane there are none.
    surface: as for voronoi().
    cmap, vmin, vmax: as in matplotlib. edgecolor, linewidth: of the cells' sides.
    colorbar: whether there is one. label: its name; default that of the field.
    units: of widths and areas on the sphere: km (default where the planet's radius is known, see
        Mesh.earth_radius), degrees (otherwise; areas in steradians) or radians.
    earth_radius: of the planet, km. Default: that of the mesh.
    An open mesh without the cells of a file shows the cells that triangles surround.

    >>> axes = delaunay(fibonacci_sphere(500)).plot(view=(0, 40))  # doctest: +SKIP
    """
    _matplotlib()
    from matplotlib.collections import PolyCollection
    spherical = self.surface.is_sphere
    _require_projection(spherical, ax, projection, view)
    begin, ids, corners = rings(self, surface)
    if not len(ids):
        raise Error("the mesh has no whole cell to draw")
    areas = _areas(begin, ids, corners, spherical)
    values, name = _values(self, field, at, areas, _units.unit_of(self, units, earth_radius))
    if ax is None:
        ax = _new_axes(projection)
    picture = _picture(begin, ids, corners, areas, spherical, getattr(ax, "projection", None), view)
    cells = PolyCollection(picture.parts, array=values[picture.cell], cmap=cmap,
                           linewidths=linewidth,
                           edgecolors="face" if edgecolor is None else edgecolor)
    cells.set_clim(vmin, vmax)
    ax.add_collection(cells, autolim=False)
    _set_limits(ax, picture)
    if spherical and coast:
        _draw_coast(ax, coast, picture.middle, picture.frame)
    if colorbar:
        ax.figure.colorbar(cells, ax=ax, label=name if label is None else label, shrink=0.8)
    return ax


def _require_projection(spherical, ax, projection, view):
    if not spherical and (projection is not None or view is not None):
        raise Error("a projection or a view is of the sphere; leave it out for a plane")
    if view is not None and (projection is not None or hasattr(ax, "projection")):
        raise Error("a view is a projection of its own; give one of them")


@dataclass
class _Picture:
    """Polygons of cells in the coordinates of a picture."""

    parts: list  #: k x 2 each; on a map those of all cells, then copies at its ends
    cell: np.ndarray  #: of each part
    spherical: bool
    frame: np.ndarray | None = None  #: of a globe: east, north and towards
    middle: float = 0.0  #: meridian of a map
    whole: bool = False  #: whether there are cells all around the sphere


def _picture(begin, ids, corners, areas, spherical, projection, view):
    if not spherical:
        picture = _Picture(_split(corners[ids, :2], begin), np.arange(len(begin) - 1), False)
    elif view is not None:
        frame = _globe_axes(view)
        picture = _Picture(*_globe(begin, ids, corners, frame), True, frame)
    else:
        towards = _middle(begin, ids, corners, areas)
        whole = bool(np.linalg.norm(towards) < 0.4)
        middle = 0.0 if whole else float(np.degrees(np.arctan2(towards[1], towards[0])))
        shapes = (_map(begin, ids, corners, middle) if projection is None
                  else _projected(begin, ids, corners, projection))
        picture = _Picture(*shapes, True, None, middle, whole)
    used = [k for k, part in enumerate(picture.parts) if len(part)]
    picture.parts, picture.cell = [picture.parts[k] for k in used], picture.cell[used]
    return picture


def _set_limits(ax, picture):
    projected = hasattr(ax, "projection")
    if picture.frame is not None:
        ax.set(xlim=(-1.02, 1.02), ylim=(-1.02, 1.02), aspect="equal")
        ax.set_axis_off()
        return
    if projected and picture.whole:
        ax.set_global()
        return
    places = np.concatenate(picture.parts[:len(np.unique(picture.cell))])
    low, high = np.nanmin(places, axis=0), np.nanmax(places, axis=0)
    if picture.whole:
        low = np.array([picture.middle - 180, -90])
        high = low + [360, 180]
    margin = 0 if picture.whole else 0.02 * (high - low).max()
    ax.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))
    if not projected:
        _label_axes(ax, picture.spherical, picture.whole)


def _label_axes(ax, spherical, whole):
    if not spherical:
        ax.set(aspect="equal", xlabel="x", ylabel="y")
        return
    south, north = ax.get_ylim()
    stretch = 1 if whole else 1 / max(0.2, np.cos(np.radians((south + north) / 2)))
    ax.set(aspect=stretch, xlabel="longitude, degrees", ylabel="latitude, degrees")
