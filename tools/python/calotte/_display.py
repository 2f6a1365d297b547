# SPDX-License-Identifier: GPL-3.0-or-later
"""What an interpreter and a notebook show of an object: a line, and a table or a picture."""
import html

import numpy as np

from . import _calotte

_MOST_EDGES = 3000  # of a picture in a notebook


def counted(number, noun):
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _range(values, unit="", scale=1.0):
    return f"{scale * values.min:.4g} to {scale * values.max:.4g}{unit}"


# ---- A line

def _periodic(surface):
    directions = " and ".join(name for name, side in zip("xy", surface.period) if side)
    return f", periodic in {directions}" if directions else ""


def _mesh(mesh):
    if mesh.surface.is_sphere:
        surface = "" if mesh.closed else ", open"
    else:
        surface = f", in a plane{_periodic(mesh.surface)}"
    cells = "" if mesh.cells is None else f", {counted(len(mesh.cells), 'polygon')}"
    return (f"<calotte.Mesh: {counted(len(mesh), 'site')}, "
            f"{counted(len(mesh.triangles), 'triangle')}{surface}{cells}>")


def _polygons(cells):
    plane = "" if cells.surface.is_sphere else ", in a plane"
    centres = "" if len(cells.centres) else ", without centres"
    return (f"<calotte.Polygons: {counted(len(cells), 'cell')}, "
            f"{counted(len(cells.corners), 'corner')}{centres}{plane}>")


def _shapes(shapes):
    unit = vars(shapes).get("_unit")
    area = (_range(shapes.area) if unit is None else
            _range(shapes.area, f" {unit.area}", unit.of_steradian))
    return (f"<calotte.PolygonShapes: area {area}, {shapes.without_area} without area, "
            f"{shapes.not_convex} not convex, {shapes.not_centroidal} not centroidal>")


def _voronoi(cells):
    plane = "" if cells.surface.is_sphere else ", in a plane"
    return (f"<calotte.Voronoi: {counted(len(cells.cells), 'cell')}, "
            f"{counted(len(cells.edges), 'edge')}, {len(cells.vertices)} vertices{plane}>")


def _quality(quality):
    unit = vars(quality).get("_unit")
    spacing = (_range(quality.spacing) if unit is None else
               _range(quality.spacing, f" {unit.name}", unit.of_radian))
    return (f"<calotte.Quality: {counted(quality.cells, 'cell')}, spacing "
            f"{spacing}, {counted(quality.obtuse, 'obtuse triangle')}, "
            f"{counted(quality.short_edges, 'short edge')}, residual {quality.residual:.2g}>")


def _unit(unit):
    return f"<calotte.Unit: {unit.name}, {unit.area}>"


def _check(check):
    what = "passed" if check.passed else check.failure
    return (f"<calotte.Check: {what}; {counted(check.sites, 'site')}, "
            f"{counted(check.triangles, 'triangle')}>")


def _errors(errors):
    return (f"<calotte.OperatorErrors: l2 of divergence {errors.divergence.l2:.2g}, gradient "
            f"{errors.gradient.l2:.2g}, curl {errors.curl.l2:.2g}, tangential "
            f"{errors.tangential.l2:.2g}>")


def _locations(found):
    outside = int((found.triangle < 0).sum())
    return (f"<calotte.Locations: {counted(len(found), 'position')}"
            f"{f', {outside} outside' if outside else ''}>")


def _surface(surface):
    if surface.is_bounded:
        corners = sum(len(ring) for ring in surface.rings)
        area = (f"{surface.area:.4g} steradians" if surface.is_sphere else
                f"area {surface.area:.4g} in a plane")
        what = f"{counted(len(surface.rings), 'ring')}, {counted(corners, 'corner')}, {area}"
    elif surface.period.all():
        what = f"periodic box {surface.period[0]:g} x {surface.period[1]:g}"
    else:
        what = f"the whole {'sphere' if surface.is_sphere else 'plane'}{_periodic(surface)}"
    return f"<calotte.Surface: {what}>"


def _extent(x, y, names=("longitudes", "latitudes"), unit=" degrees"):
    return (f"{names[0]} {min(x):.6g} to {max(x):.6g}, {names[1]} {min(y):.6g} to {max(y):.6g}{unit}")


def _raster(raster):
    return (f"<calotte.Raster: {len(raster.longitudes)} x {len(raster.latitudes)} boxes, "
            f"{_extent(raster.meridians, raster.parallels)}>")


def _widths(widths):
    extent = (_extent(widths.x, widths.y, "xy", "") if widths.of_plane else
              _extent(widths.longitudes, widths.latitudes))
    return (f"<calotte.CellWidth: {len(widths.x)} x {len(widths.y)} nodes, {extent}, cell widths "
            f"{np.nanmin(widths.widths):.4g} to {np.nanmax(widths.widths):.4g}{'' if widths.of_plane else ' km'}>")


def _lists(lists):
    return f"<calotte.IdLists: {counted(len(lists), 'list')}, {counted(len(lists.ids), 'id')}>"


def _density(density):
    return f"<calotte.Density: {'uniform' if density.uniform else 'not uniform'}>"


def _numbers(value):
    order = ["min", "p1", "p5", "p50", "mean", "p95", "p99", "max", "l2", "cell"]
    words = (f"{name}={getattr(value, name):.4g}" for name in order if hasattr(value, name))
    return f"{type(value).__name__}({', '.join(words)})"


# ---- A table

def _cell(value):
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, np.ndarray):
        if value.size <= 12:
            return f"{np.array2string(value, precision=6)}"
        low, high = np.nanmin(value), np.nanmax(value)
        return f"{' x '.join(map(str, value.shape))} numbers, {low:.4g} to {high:.4g}"
    return str(value)


def table(title, rows):
    """Rows of a name, a value and what it is."""
    lines = "".join(f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
                    f"<td style='text-align:left'>{html.escape(_cell(value))}</td>"
                    f"<td style='text-align:left'>{html.escape(doc)}</td></tr>"
                    for name, value, doc in rows)
    return f"<table><caption>{html.escape(title)}</caption>{lines}</table>"


def attributes(value):
    """The public properties of an object and their documentation."""
    kind = type(value)
    found = [(name, member) for name, member in vars(kind).items()
             if isinstance(member, property) and not name.startswith("_")]
    return [(name, getattr(value, name), (member.__doc__ or "").split("\n")[0])
            for name, member in found]


def _as_table(value):
    return table(repr(value).strip("<>"), attributes(value))


# ---- A picture

def _seen(mesh):
    """x, y of the sites in the picture, and which of them it shows."""
    points = mesh.points
    if points.shape[1] == 2:
        period = mesh.surface.period
        low = np.where(period > 0, 0, points.min(axis=0))
        high = np.where(period > 0, period, points.max(axis=0))
        return 2 * (points - low) / np.maximum(high - low, 1e-300).max() - 1, np.full(len(points), True)
    unit = points / np.linalg.norm(points, axis=1, keepdims=True)
    towards = np.array([1.0, 0.5, 0.6])
    if not mesh.closed:
        towards = unit.mean(axis=0)
    if len(mesh) > _MOST_EDGES // 3:  # the part around the smallest triangle
        a, b, c = (unit[mesh.triangles[:, k]] for k in range(3))
        smallest = np.argmin(np.linalg.norm(np.cross(b - a, c - a), axis=1))
        towards = a[smallest]
    towards = towards / max(np.linalg.norm(towards), 1e-300)
    east = np.cross([0.0, 0.0, 1.0], towards)
    east = east / np.linalg.norm(east) if np.linalg.norm(east) > 1e-9 else np.array([0.0, 1.0, 0.0])
    north = np.cross(towards, east)
    height = unit @ towards
    count = min(len(mesh), max(12, _MOST_EDGES // 3))
    reach = np.partition(-height, count - 1)[count - 1]
    shown = (-height <= reach) & (height > 0)
    scale = 1 / max(1e-300, np.sqrt(1 - max(-reach, 0.0)**2))
    return scale * np.stack([unit @ east, unit @ north], axis=1), shown


def nearest(apart, period):
    """Differences of places in a plane, those of nearest copies in its periodic directions."""
    turn = np.where(period > 0, period, np.inf)
    return apart - period * np.round(apart / turn)


def _edges(triangles):
    pairs = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]],
                                    triangles[:, [2, 0]]]), axis=1)
    return np.unique(pairs, axis=0)


def _ends(mesh, places, edges):
    """Both ends of edges; in a periodic plane the second is the copy nearest to the first."""
    a, b = mesh.points[edges[:, 0]], mesh.points[edges[:, 1]]
    period = mesh.surface.period
    if not period.any():
        return places[edges[:, 0]], places[edges[:, 1]]
    start = places[edges[:, 0]]
    scale = 2 / max(np.where(period > 0, period, np.ptp(mesh.points, axis=0)))
    return start, start + scale * nearest(b - a, period)


def picture(mesh):
    """A small picture of the triangles, for notebooks; of a large mesh its finest part."""
    places, shown = _seen(mesh)
    triangles = mesh.triangles[shown[mesh.triangles].all(axis=1)]
    a, b = _ends(mesh, places, _edges(triangles)[:_MOST_EDGES])
    lines = "".join(f"M{p[0]:.3f} {-p[1]:.3f}L{q[0]:.3f} {-q[1]:.3f}" for p, q in zip(a, b))
    return (f'<figure><svg viewBox="-1.02 -1.02 2.04 2.04" width="240" height="240" role="img" '
            f'aria-label="triangles"><path d="{lines}" fill="none" stroke="currentColor" '
            f'stroke-width="0.004"/></svg><figcaption>{html.escape(repr(mesh).strip("<>"))}'
            "</figcaption></figure>")


for _kind, _line in ((_calotte.Mesh, _mesh), (_calotte.Polygons, _polygons),
                     (_calotte.PolygonShapes, _shapes),
                     (_calotte.Voronoi, _voronoi),
                     (_calotte.Locations, _locations), (_calotte.Quality, _quality),
                     (_calotte.Check, _check), (_calotte.Unit, _unit),
                     (_calotte.OperatorErrors, _errors), (_calotte.Surface, _surface),
                     (_calotte.CellWidth, _widths), (_calotte.Raster, _raster), (_calotte.IdLists, _lists),
                     (_calotte.Density, _density), (_calotte.Range, _numbers),
                     (_calotte.Percentiles, _numbers), (_calotte.ErrorNorms, _numbers)):
    _kind.__repr__ = _line
for _kind in (_calotte.Voronoi, _calotte.Quality, _calotte.Check, _calotte.OperatorErrors,
              _calotte.Polygons, _calotte.PolygonShapes):
    _kind._repr_html_ = _as_table
_calotte.Mesh._repr_html_ = picture
