# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of mpas_tools.mesh.creation that make base meshes: change the import."""
import numpy as np

from . import _arguments, _functions
from ._arguments import Error


def build_spherical_mesh(cellWidth, lon, lat, earth_radius, out_filename="base_mesh.nc",
                         plot_cellWidth=False, dir="./", logger=None, **ignored):
    """Makes an MPAS mesh whose cells have widths.

    cellWidth: len(lat) x len(lon), km. lon, lat: degrees. earth_radius: metres; the file's
    sphere_radius. Options of JIGSAW have no effect. Returns the number of cells.
    """
    if plot_cellWidth:
        raise Error("plot_cellWidth is not supported; draw the mesh with calotte draw")
    widths = _arguments.cell_width((cellWidth, lon, lat))
    grid = _functions.cvt(cell_width=widths, earth_radius=earth_radius / 1000)
    path = _joined(dir, out_filename)
    if logger is not None:
        logger.info(f"{path}: {len(grid.mesh)} cells, {grid.iterations} iterations")
    grid.mesh.to_mpas(path, sphere_radius=earth_radius, cell_width=widths)
    return len(grid.mesh)


def build_planar_mesh(cellWidth, x, y, geom_points, geom_edges, out_filename="base_mesh.nc",
                      logger=None, **ignored):
    """Makes an MPAS mesh of a planar domain whose cells have widths.

    cellWidth: len(y) x len(x), km. x, y: metres. geom_points: the corners of the domain, in metres,
    as records of jigsawpy, [((x, y), tag), ...], or k x 2. geom_edges: pairs of their ids.
    Returns the number of cells.
    """
    from . import _calotte
    values = _arguments.numbers(cellWidth, "cell widths")
    x, y = _arguments.numbers(x, "x"), _arguments.numbers(y, "y")
    if values.shape != (y.size, x.size):
        raise Error(f"cell widths have the shape {values.shape}; give y x x, here {y.size} x "
                    f"{x.size}")
    if not (values > 0).all():
        raise Error("cell widths must be positive")
    domain = _calotte.PlanarDomain(_rings(geom_points, geom_edges))
    rho = _calotte.density_of_planar_raster((values.min() / values)**4, x, y)
    grid = _functions.cvt(_cells_in(domain, values, x, y), domain=domain, density=rho)
    if logger is not None:
        logger.info(f"{out_filename}: {len(grid.mesh)} cells, {grid.iterations} iterations")
    grid.mesh.to_mpas(out_filename, domain=domain, density=rho)
    return len(grid.mesh)


def _joined(folder, name):
    return name if folder in ("./", ".", "") else f"{folder.rstrip('/')}/{name}"


def _rings(points, edges):
    """The rings that edges between points make."""
    places = np.array([p[0] if len(p) == 2 and np.ndim(p[0]) else p for p in points], dtype=float)
    following = {}
    for edge in edges:
        a, b = (edge[0] if np.ndim(edge[0]) else edge)[:2]
        following[int(a)] = int(b)
    rings = []
    while following:
        first, here = next(iter(following)), next(iter(following))
        ring = []
        while here in following:
            ring.append(here)
            here = following.pop(here)
        if here != first:
            raise Error(f"the edges of the domain do not close at point {here}")
        rings.append(np.ascontiguousarray(places[ring]))
    return rings


def _cells_in(domain, widths, x, y):
    """The integral of 2/(sqrt(3) h^2) over the domain, by the mean over random places."""
    places = _functions.random_places(1 << 16, domain)
    i = np.clip(np.searchsorted(x, places[:, 0]) - 1, 0, x.size - 2)
    j = np.clip(np.searchsorted(y, places[:, 1]) - 1, 0, y.size - 2)
    s, t = (places[:, 0] - x[i]) / (x[i + 1] - x[i]), (places[:, 1] - y[j]) / (y[j + 1] - y[j])
    h = 1000 * ((1 - t) * ((1 - s) * widths[j, i] + s * widths[j, i + 1])
                + t * ((1 - s) * widths[j + 1, i] + s * widths[j + 1, i + 1]))
    return round(2 / np.sqrt(3) * domain.area * np.mean(h**-2))
