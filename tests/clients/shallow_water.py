# SPDX-License-Identifier: GPL-3.0-or-later
"""A shallow-water model on an MPAS file: TRiSK on the C-grid (Ringler, Thuburn, Klemp and Skamarock,
J. Comput. Phys. 229, 2010) in its energy-conserving form, with the classical Runge-Kutta method of
order 4. It knows the grid from the file alone, and no code of the library.

    dh/dt = -div(h u)
    du/dt = q (h u)_perp - grad(g h + K),   q = (f + curl u) / h at the vertices

Units are metres and seconds. Arrays of fields have one value a cell, an edge or a vertex."""

import netCDF4
import numpy

RADIUS = 6.37122e6  # metres; Williamson et al., J. Comput. Phys. 102, 1992
GRAVITY = 9.80616
ROTATION = 7.292e-5  # radians per second
DAY = 86400.0


def rows(ids, counts):
    """Ids from 0 on of a padded table of MPAS, and 1 where an entry counts, else 0."""
    used = numpy.arange(ids.shape[1]) < counts[:, None]
    return numpy.where(used, ids - 1, 0), used.astype(float)


class Grid:
    """A global grid of an MPAS file, scaled to the Earth."""

    def __init__(self, path):
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            read = {name: variable[:] for name, variable in file.variables.items()}
            radius = file.sphere_radius
        scale = RADIUS / radius
        self.cells, self.edges, self.vertices = (
            numpy.stack([read[axis + place] for axis in "xyz"], axis=1) / radius
            for place in ("Cell", "Edge", "Vertex")
        )
        self.cells_on_edge = read["cellsOnEdge"].T - 1
        self.vertices_on_edge = read["verticesOnEdge"].T - 1
        self.dc, self.dv = read["dcEdge"] * scale, read["dvEdge"] * scale
        self.cell_area = read["areaCell"] * scale**2
        self.vertex_area = read["areaTriangle"] * scale**2
        self.kites = read["kiteAreasOnVertex"] * scale**2
        self.cells_on_vertex = read["cellsOnVertex"] - 1
        others, used = rows(read["edgesOnEdge"], read["nEdgesOnEdge"])
        self.others, self.weights = others, read["weightsOnEdge"] * used

        edges, used = rows(read["edgesOnCell"], read["nEdgesOnCell"])
        leaves = self.cells_on_edge[0][edges] == numpy.arange(len(edges))[:, None]
        self.edges_on_cell, self.out_of_cell = edges, used * numpy.where(leaves, 1.0, -1.0)
        edges = read["edgesOnVertex"] - 1
        left = self.vertices_on_edge[1][edges] == numpy.arange(len(edges))[:, None]
        self.edges_on_vertex, self.around_vertex = edges, numpy.where(left, 1.0, -1.0)

    def divergence(self, flux):
        passing = self.out_of_cell * (flux * self.dv)[self.edges_on_cell]
        return passing.sum(axis=1) / self.cell_area

    def gradient(self, scalar):
        first, second = scalar[self.cells_on_edge]
        return (second - first) / self.dc

    def curl(self, velocity):
        along = self.around_vertex * (velocity * self.dc)[self.edges_on_vertex]
        return along.sum(axis=1) / self.vertex_area

    def tangential(self, values):
        """What TRiSK's weights make of a normal flux."""
        return (self.weights * values[self.others]).sum(axis=1)

    def at_vertices(self, scalar):
        """The mean over a triangle of a scalar on cells, weighted by kites."""
        return (self.kites * scalar[self.cells_on_vertex]).sum(axis=1) / self.vertex_area

    def kinetic_energy(self, velocity):
        quarter = 0.25 * self.dc * self.dv * velocity**2
        return (numpy.abs(self.out_of_cell) * quarter[self.edges_on_cell]).sum(axis=1) / self.cell_area


def mean(pair):
    return 0.5 * (pair[0] + pair[1])


class Model:
    """The flow over flat ground on a rotating sphere."""

    def __init__(self, grid, axis):
        """\param axis the direction of the pole of rotation."""
        self.grid = grid
        self.coriolis = 2 * ROTATION * grid.vertices @ axis

    def tendencies(self, height, velocity):
        """dh/dt and du/dt."""
        grid = self.grid
        flux = mean(height[grid.cells_on_edge]) * velocity
        vorticity = (self.coriolis + grid.curl(velocity)) / grid.at_vertices(height)
        on_edge = mean(vorticity[grid.vertices_on_edge])
        # The mean of q at both edges does no work.
        turning = 0.5 * (on_edge * grid.tangential(flux) + grid.tangential(on_edge * flux))
        head = GRAVITY * height + grid.kinetic_energy(velocity)
        return -grid.divergence(flux), turning - grid.gradient(head)

    def step(self, state, seconds):
        """The state (h, u) a Runge-Kutta step later."""
        slopes = [self.tendencies(*state)]
        for part in (0.5, 0.5, 1.0):
            slopes.append(self.tendencies(*(x + part * seconds * s for x, s in zip(state, slopes[-1]))))
        return tuple(x + seconds / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(state, *slopes))

    def gain(self, height, velocity):
        """The rate at which the total energy changes, over that at which its parts are exchanged. It
        is 0 up to rounding if weight dc_e / dv_e' is antisymmetric."""
        grid = self.grid
        rising, speeding = self.tendencies(height, velocity)
        head = GRAVITY * height + grid.kinetic_energy(velocity)
        on_edges = grid.dc * grid.dv * mean(height[grid.cells_on_edge]) * velocity * speeding
        parts = numpy.concatenate([grid.cell_area * head * rising, on_edges])
        return float(parts.sum() / numpy.abs(parts).sum())


def relative_norms(values, exact, areas):
    """Errors in l2 and in the maximum, as Williamson et al. define them (Eqs. 82 to 84)."""
    error = values - exact
    l2 = numpy.sqrt(areas @ error**2 / (areas @ exact**2))
    return float(l2), float(numpy.abs(error).max() / numpy.abs(exact).max())


def steady_flow(grid, axis, days=1.0, step=900.0):
    """Runs Williamson's test case 2, a steady zonal flow in geostrophic balance around an axis.

    \param step upper bound of the time step in seconds.
    \returns relative errors at the end: "h l2", "h max" and "vorticity l2"; the relative change of
             "mass"; and "energy", as Model.gain(). "tangential max" is the worst tangential velocity that the
             weights reconstruct at the end, over the greatest speed."""
    axis = numpy.asarray(axis) / numpy.linalg.norm(axis)
    speed = 2 * numpy.pi * RADIUS / (12 * DAY)
    at_cells, at_vertices = grid.cells @ axis, grid.vertices @ axis
    drop = RADIUS * ROTATION * speed + 0.5 * speed**2
    exact = (2.94e4 - drop * at_cells**2) / GRAVITY
    stream = -RADIUS * speed * at_vertices
    right, left = stream[grid.vertices_on_edge]
    model = Model(grid, axis)
    state = exact, (right - left) / grid.dv
    steps = int(numpy.ceil(days * DAY / step))
    for _ in range(steps):
        state = model.step(state, days * DAY / steps)
    height, velocity = state
    l2, greatest = relative_norms(height, exact, grid.cell_area)
    first, second = grid.cells[grid.cells_on_edge]
    normal = (second - first) / numpy.linalg.norm(second - first, axis=1)[:, None]
    along = (numpy.cross(axis, grid.edges) * numpy.cross(grid.edges, normal)).sum(axis=1)
    vorticity = relative_norms(grid.curl(velocity), 2 * speed / RADIUS * at_vertices, grid.vertex_area)
    return {
        "h l2": l2,
        "h max": greatest,
        "vorticity l2": vorticity[0],
        "tangential max": float(numpy.abs(grid.tangential(velocity) / speed - along).max()),
        "mass": float(grid.cell_area @ (height - exact) / (grid.cell_area @ exact)),
        "energy": model.gain(*state),
    }
