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
    widths = _arguments.raster(cellWidth, lon, lat)
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
    widths = _arguments.planar_raster(1000 * _arguments.numbers(cellWidth, "cell widths"), x, y)
    surface = _calotte.planar_polygon(_rings(geom_points, geom_edges))
    rho = _calotte.density_of_widths(widths)
    cells = _functions.plan(widths, surface=surface).cells
    grid = _functions.cvt(cells, surface=surface, density=rho)
    if logger is not None:
        logger.info(f"{out_filename}: {len(grid.mesh)} cells, {grid.iterations} iterations")
    grid.mesh.to_mpas(out_filename, density=rho)
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
