# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of mpas_tools.mesh.creation.build_mesh: change the import."""
import warnings

import numpy as np

from . import _arguments, _calotte, _display, _functions
from ._arguments import Error


def build_spherical_mesh(cellWidth, lon, lat, earth_radius, out_filename="base_mesh.nc",
                         plot_cellWidth=True, dir="./", logger=None):
    """Makes an MPAS mesh whose cells have widths.

    cellWidth: len(lat) x len(lon), km. lon, lat: degrees. earth_radius: metres; the file's
    sphere_radius. plot_cellWidth: draws the widths to cellWidthGlobal.png, with matplotlib where it
    is installed. dir: no effect, as there are no temporary files of a mesh generator.
    Returns the number of cells.
    """
    widths = _arguments.cell_width((cellWidth, lon, lat))
    if plot_cellWidth:
        _draw_widths(np.asarray(cellWidth), lon, lat)
    grid = _functions.cvt(cell_width=widths, earth_radius=earth_radius / 1000)
    if logger is not None:
        logger.info(f"{out_filename}: {len(grid.mesh)} cells, {grid.iterations} iterations")
    grid.mesh.to_mpas(out_filename, sphere_radius=earth_radius, cell_width=widths)
    return len(grid.mesh)


def build_planar_mesh(cellWidth, x, y, geom_points, geom_edges, out_filename="base_mesh.nc",
                      logger=None):
    """Makes an MPAS mesh of a planar domain whose cells have widths.

    cellWidth: len(y) x len(x), km. x, y: metres. geom_points: the corners of the domain, in metres,
    as records of jigsawpy, [((x, y), tag), ...], or k x 2. geom_edges: pairs of their ids, in any
    order and direction. Returns the number of cells.
    """
    values = _arguments.numbers(cellWidth, "cell widths")
    x, y = _arguments.numbers(x, "x"), _arguments.numbers(y, "y")
    if values.shape != (y.size, x.size):
        raise Error(f"cell widths have the shape {values.shape}; give y x x, here {y.size} x "
                    f"{x.size}")
    if not (values > 0).all():
        raise Error("cell widths must be positive")
    domain = _calotte.PlanarDomain(_rings(geom_points, geom_edges))
    _require_cover(domain, x, y)
    rho = _calotte.density_of_planar_raster((values.min() / values)**4, x, y)
    grid = _functions.cvt(_cells_in(domain, values, x, y), domain=domain, density=rho)
    if logger is not None:
        logger.info(f"{out_filename}: {len(grid.mesh)} cells, {grid.iterations} iterations")
    grid.mesh.to_mpas(out_filename, domain=domain, density=rho)
    return len(grid.mesh)


def _draw_widths(values, lon, lat):
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        warnings.warn("cellWidthGlobal.png needs matplotlib; install it, or give "
                      "plot_cellWidth=False", stacklevel=3)
        return
    figure = Figure(figsize=(16, 8), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    image = axes.pcolormesh(lon, lat, values, shading="nearest")
    for line in _calotte.coastlines():
        axes.plot(line[:, 0], line[:, 1], color="black", linewidth=0.8)
    axes.set(xlim=(np.min(lon), np.max(lon)), ylim=(np.min(lat), np.max(lat)),
             title=f"Grid cell size, km, min: {values.min():.1f} max: {values.max():.1f}",
             xlabel="longitude, degrees", ylabel="latitude, degrees", aspect="equal")
    figure.colorbar(image, shrink=0.6)
    figure.savefig("cellWidthGlobal.png")


def _neighbours(edges):
    """For each id of a point the ids at the other ends of its edges; an edge may be given twice."""
    neighbours = {}
    for edge in edges:
        a, b = (int(end) for end in (edge[0] if np.ndim(edge[0]) else edge)[:2])
        if a == b:
            raise Error(f"an edge of the domain joins point {a} to itself; leave it out")
        neighbours.setdefault(a, set()).add(b)
        neighbours.setdefault(b, set()).add(a)
    return neighbours


def _rings(points, edges):
    """The rings that edges between points make, whatever their directions."""
    places = np.array([p[0] if len(p) == 2 and np.ndim(p[0]) else p for p in points], dtype=float)
    neighbours = _neighbours(edges)
    for point, others in neighbours.items():
        if not 0 <= point < len(places):
            raise Error(f"an edge of the domain has the point {point}, but there are {len(places)}")
        if len(others) != 2:
            raise Error(f"the edges of the domain do not make rings: point {point} has "
                        f"{_display.counted(len(others), 'edge')} instead of 2")
    rings, left = [], set(neighbours)
    while left:
        ring, here, before = [], min(left), None
        while here in left:
            left.remove(here)
            ring.append(here)
            here, before = next((other for other in sorted(neighbours[here]) if other != before),
                                None), here
        rings.append(np.ascontiguousarray(places[ring]))
    return rings


def _require_cover(domain, x, y):
    """Widths outside their grid would be those at its border."""
    corners = np.concatenate(domain.rings)
    for name, axis, values in (("x", x, corners[:, 0]), ("y", y, corners[:, 1])):
        slack = 0.5 * np.diff(axis).max()
        if values.min() < axis[0] - slack or values.max() > axis[-1] + slack:
            raise Error(f"{name} of the cell widths runs from {axis[0]:g} to {axis[-1]:g} and the "
                        f"domain from {values.min():g} to {values.max():g}; give widths for all "
                        "of it")


def _cells_in(domain, widths, x, y):
    """The integral of 2/(sqrt(3) h^2) over the domain, by the mean over random places."""
    places = _functions.random_places(1 << 16, domain)
    i = np.clip(np.searchsorted(x, places[:, 0]) - 1, 0, x.size - 2)
    j = np.clip(np.searchsorted(y, places[:, 1]) - 1, 0, y.size - 2)
    s, t = (places[:, 0] - x[i]) / (x[i + 1] - x[i]), (places[:, 1] - y[j]) / (y[j + 1] - y[j])
    h = 1000 * ((1 - t) * ((1 - s) * widths[j, i] + s * widths[j, i + 1])
                + t * ((1 - s) * widths[j + 1, i] + s * widths[j + 1, i + 1]))
    return round(2 / np.sqrt(3) * domain.area * np.mean(h**-2))
