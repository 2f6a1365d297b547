# SPDX-License-Identifier: GPL-3.0-or-later
"""scipy.spatial.SphericalVoronoi with the same attributes: change the import, keep the script."""
import numpy as np

from . import _calotte
from ._arguments import numbers


class SphericalVoronoi:
    """Voronoi cells of points on a sphere.

    points: n x 3, or n x 2 on a circle. radius: of the sphere; default 1. center: of the sphere; default the origin.
    threshold: relative tolerance for duplicates and for the distance of points to the sphere.

    Points may lie in a hemisphere: on the sphere every cell is bounded.

    vertices: m x 3 (m x 2) corners of cells. regions: for each point the ids of its corners,
    counter-clockwise seen from outside. Raises ValueError for duplicates and for points off the
    sphere.

    >>> cells = SphericalVoronoi([(0, 0, 1), (0, 0, -1), (1, 0, 0), (0, 1, 0), (0, -1, 0), (-1, 0, 0)])
    >>> [len(region) for region in cells.regions]
    [4, 4, 4, 4, 4, 4]
    """

    def __init__(self, points, radius=1, center=None, threshold=1e-06):
        if radius is None:
            raise ValueError("`radius` is None; give a positive number")
        self.points = np.array(numbers(points, "points"))
        if self.points.ndim != 2 or self.points.shape[1] not in (2, 3):
            raise ValueError("points must be n x 3, or n x 2 on a circle; cells on a hypersphere are "
                             "not supported")
        self.radius = float(radius)
        self._dim = self.points.shape[1]
        self.center = np.zeros(self._dim) if center is None else np.array(center, dtype=float)
        offsets = self.points - self.center
        distances = np.linalg.norm(offsets, axis=1)
        if not (self.radius > 0 and np.abs(distances - self.radius).max() < self.radius * threshold):
            raise ValueError("Radius inconsistent with generators.")
        if self._dim == 2:
            self._divide_circle(offsets, threshold)
        else:
            self._divide_sphere(offsets, threshold)

    def _divide_circle(self, offsets, threshold):
        """Vertex k lies in the middle of the arc from point k, in the order of angles, to the next."""
        angles = np.arctan2(offsets[:, 1], offsets[:, 0])
        order = np.argsort(angles)
        self._gaps = np.diff(angles[order], append=angles[order[0]] + 2 * np.pi)
        if len(order) < 3:
            raise ValueError("Rank of input points must be at least 2")
        if 2 * np.sin(np.minimum(self._gaps, np.pi) / 2).min() <= threshold:
            raise ValueError("Duplicate generators present.")
        middles = angles[order] + self._gaps / 2
        self.vertices = (self.radius * np.stack([np.cos(middles), np.sin(middles)], axis=1)
                         + self.center)
        self._simplices = np.stack([order, np.roll(order, -1)], axis=1)
        self._rank_of = np.argsort(order)
        self._regions = [[int((rank - 1) % len(order)), int(rank)] for rank in self._rank_of]
        self._starts, self._ids = 2 * np.arange(len(order) + 1), np.ravel(self._regions)

    def _divide_sphere(self, offsets, threshold):
        if len(offsets) < 4:
            raise ValueError("Rank of input points must be at least 3")
        try:
            self._mesh = _calotte.delaunay(offsets, _calotte.Surface(), 0.0, False, None)
        except _calotte.Error as error:
            if error.code == "duplicate":
                raise ValueError(f"Duplicate generators present: {error}") from error
            raise
        corners, starts, ids, shortest, coincide = self._corners()
        if shortest <= threshold:
            raise ValueError("Duplicate generators present: two points are within the threshold "
                             f"{threshold * self.radius:.3g} of each other; merge them")
        if coincide:
            starts, ids, corners = _merged(starts, ids, corners)
        self._starts, self._ids = starts, ids
        self.vertices = self.radius * corners + self.center
        self._regions = None

    def _corners(self):
        if self._mesh.closed:
            self._simplices = self._mesh.triangles
            return _calotte.corners(self._mesh)
        cells = _calotte.voronoi(self._mesh)  # the far side of points in a hemisphere as well
        self._simplices = cells.cells_on_vertex
        shortest = 2 * np.sin(cells.dc.min() / 2)
        return cells.vertices, cells.begin, cells.vertices_on_cell, shortest, True

    @property
    def regions(self):
        """For each point the list of its corners."""
        if self._regions is None:
            self._regions = _calotte.lists_of(self._starts, self._ids)
        return self._regions

    @property
    def regions_csr(self):
        """The same as two arrays: point i has the corners ids[starts[i]:starts[i + 1]]."""
        return self._starts, self._ids

    def sort_vertices_of_regions(self):
        """Does nothing: corners are in order."""

    def calculate_areas(self):
        """The area of each cell, of points on a circle the length of its arc; of all they are whole."""
        if self._dim == 2:
            arcs = (self._gaps + np.roll(self._gaps, 1)) / 2
            return self.radius * arcs[self._rank_of]
        return self.radius**2 * _calotte.voronoi(self._mesh).cell_area


def _merged(starts, ids, corners):
    """Corners of cocircular sites, which several triangles share, once."""
    cell_ends = starts[1:] - 1
    before = np.concatenate([[0], ids[:-1]])
    before[starts[:-1]] = ids[cell_ends]  # the last corner of a cell precedes its first
    sides = corners[ids] - corners[before]
    short = np.flatnonzero(np.einsum("ij,ij->i", sides, sides) < 1e-28)
    into, pairs = np.arange(len(corners)), np.stack([ids[short], before[short]], axis=1)
    while True:  # each corner receives the lowest id of those it coincides with
        earlier, lowest = into.copy(), into[pairs].min(axis=1)
        np.minimum.at(into, pairs[:, 0], lowest)
        np.minimum.at(into, pairs[:, 1], lowest)
        into = into[into]
        if (into == earlier).all():
            break
    kept, number = np.unique(into, return_inverse=True)
    stays = into[ids] != into[before]
    cell = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    counts = np.bincount(cell[stays], minlength=len(starts) - 1)
    return np.concatenate([[0], np.cumsum(counts)]), number[ids][stays], corners[kept]
