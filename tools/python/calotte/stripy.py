# SPDX-License-Identifier: GPL-3.0-or-later
"""stripy.sTriangulation's constructor and connectivity: change the import, keep the script."""
import numpy as np

from . import _calotte
from ._arguments import numbers


class sTriangulation:
    """The Delaunay triangulation of places on the unit sphere.

    lons, lats: radians. lons, lats, points (n x 3) and simplices (m x 3, anticlockwise seen from
    outside) are attributes. Raises ValueError for duplicates.

    >>> mesh = sTriangulation([0, 1.5, 3, 4.5, 0, 0], [0, 0, 0, 0, 1.5, -1.5])
    >>> mesh.simplices.shape
    (8, 3)
    """

    def __init__(self, lons, lats):
        self.lons, self.lats = numbers(lons, "lons").ravel(), numbers(lats, "lats").ravel()
        if self.lons.shape != self.lats.shape:
            raise ValueError("lons and lats must have the same length")
        if len(self.lats) and np.abs(self.lats).max() > np.pi / 2 + 1e-12:
            raise ValueError("lats are not within -pi/2 to pi/2; give radians")
        cosine = np.cos(self.lats)
        self.points = np.stack([cosine * np.cos(self.lons), cosine * np.sin(self.lons),
                                np.sin(self.lats)], axis=1)
        self.x, self.y, self.z = self.points.T
        self.npoints = len(self.points)
        self._mesh = _calotte.delaunay(self.points, 0.0, False, None)

    @property
    def simplices(self):
        """Ids of the corners of each triangle."""
        return self._mesh.triangles

    def identify_segments(self):
        """The ids of both ends of each edge, the lower first."""
        pairs = np.sort(self.simplices[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        return np.unique(pairs, axis=0)

    def areas(self):
        """The area of each triangle, steradians."""
        a, b, c = (self.points[self.simplices[:, k]] for k in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c))
        sums = sum(np.einsum("ij,ij->i", p, q) for p, q in ((a, b), (b, c), (c, a)))
        return 2 * np.arctan2(volume, 1 + sums)
