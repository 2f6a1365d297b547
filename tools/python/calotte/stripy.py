# SPDX-License-Identifier: GPL-3.0-or-later
"""stripy.sTriangulation: its constructor, connectivity and refinement; change the import."""
import numpy as np

from . import _calotte
from ._arguments import numbers


def _lonlat(points):
    """Longitudes and latitudes in radians of n x 3 vectors of any length."""
    unit = points / np.linalg.norm(points, axis=1, keepdims=True)
    return np.arctan2(unit[:, 1], unit[:, 0]), np.arcsin(np.clip(unit[:, 2], -1, 1))


def _vectors(lons, lats):
    cosine = np.cos(lats)
    return np.stack([cosine * np.cos(lons), cosine * np.sin(lons), np.sin(lats)], axis=-1)


class sTriangulation:
    """The Delaunay triangulation of places on the unit sphere.

    lons, lats: radians. refinement_levels: how often the midpoints of all edges become further
    places, after those that are given. permute: kept as an attribute; the triangulation is unique,
    so that the order of the places has no effect on it, and no order is refused. tree: makes a
    k-d tree (SciPy) for nearest_vertices().

    lons, lats, x, y, z, points (n x 3), npoints and simplices (m x 3, anticlockwise seen from
    outside) are attributes. Raises ValueError for duplicates. It has no
    interpolation.

    >>> mesh = sTriangulation([0, 1.5, 3, 4.5, 0, 0], [0, 0, 0, 0, 1.5, -1.5])
    >>> mesh.simplices.shape
    (8, 3)
    >>> sTriangulation(mesh.lons, mesh.lats, refinement_levels=1).npoints
    18
    """

    def __init__(self, lons, lats, refinement_levels=0, permute=False, tree=False):
        self.permute, self.tree = permute, tree
        self._triangulate(numbers(lons, "lons").ravel(), numbers(lats, "lats").ravel())
        for _ in range(refinement_levels):
            self._triangulate(*self.uniformly_refine_triangulation())
        self._cKDtree = self._kd_tree() if tree else None

    def _triangulate(self, lons, lats):
        if lons.shape != lats.shape:
            raise ValueError("lons and lats must have the same length")
        if len(lats) and np.abs(lats).max() > np.pi / 2 + 1e-12:
            raise ValueError("lats are not within -pi/2 to pi/2; give radians")
        self.lons, self.lats = lons, lats
        self.points = _vectors(lons, lats)
        self.x, self.y, self.z = self.points.T
        self.npoints = len(self.points)
        self._mesh = _calotte.delaunay(self.points, _calotte.Surface(), 0.0, False, None)

    @property
    def simplices(self):
        """Ids of the corners of each triangle."""
        return self._mesh.triangles

    # ---- Connectivity

    def identify_segments(self):
        """The ids of both ends of each edge, the lower first."""
        pairs = np.sort(self.simplices[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        return np.unique(pairs, axis=0)

    def identify_vertex_neighbours(self, vertex):
        """The ids of the places that share an edge with one."""
        triangles = self.simplices[(self.simplices == vertex).any(axis=1)]
        return np.setdiff1d(triangles, [vertex])

    def identify_vertex_triangles(self, vertices):
        """The ids of the triangles that have one of the places as a corner."""
        return np.flatnonzero(np.isin(self.simplices, np.ravel(vertices)).any(axis=1))

    def areas(self):
        """The area of each triangle, steradians."""
        a, b, c = (self.points[self.simplices[:, k]] for k in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c))
        sums = sum(np.einsum("ij,ij->i", p, q) for p, q in ((a, b), (b, c), (c, a)))
        return 2 * np.arctan2(volume, 1 + sums)

    def edge_lengths(self):
        """The arcs ab, bc and ac of each triangle, radians."""
        a, b, c = (self.points[self.simplices[:, k]] for k in range(3))
        return tuple(2 * np.arctan2(np.linalg.norm(p - q, axis=1), np.linalg.norm(p + q, axis=1))
                     for p, q in ((a, b), (b, c), (a, c)))

    # ---- Refinement: each returns longitudes and latitudes in radians

    def segment_midpoints(self, segments=None):
        """The midpoints of edges; default all."""
        ends = self.identify_segments() if segments is None else np.asarray(segments)
        return _lonlat(self.points[ends[:, 0]] + self.points[ends[:, 1]])

    def segment_tripoints(self, ratio=0.33333):
        """Two places on each edge: at the ratio, and at one less the ratio."""
        ends = self.identify_segments()
        a, b = self.points[ends[:, 0]], self.points[ends[:, 1]]
        return _lonlat(np.concatenate([ratio * a + (1 - ratio) * b, (1 - ratio) * a + ratio * b]))

    def face_midpoints(self, simplices=None):
        """The centroids of triangles; default all."""
        corners = self.simplices if simplices is None else np.asarray(simplices)
        return _lonlat(self.points[corners].mean(axis=1))

    def uniformly_refine_triangulation(self, faces=False, trisect=False):
        """The places and the midpoints of all edges, or two places on each, or the centroids."""
        lons, lats = (self.face_midpoints() if faces
                      else self.segment_tripoints(ratio=0.333333) if trisect
                      else self.segment_midpoints())
        return np.concatenate([self.lons, lons]), np.concatenate([self.lats, lats])

    # ---- Nearest places

    def _kd_tree(self):
        try:
            from scipy.spatial import cKDTree
        except ImportError:
            raise ValueError("tree=True needs SciPy; install it, or leave tree out") from None
        return cKDTree(self.points)

    def nearest_vertices(self, lon, lat, k=1, max_distance=2.0):
        """The k places nearest to each of others, with tree=True; else (0, 0).

        lon, lat: radians. max_distance: a chord of the unit sphere. Returns the arcs in radians and
        the ids, both n x k; where fewer than k are as near, the arc is infinite and the id npoints.
        """
        if self._cKDtree is None:
            return 0, 0
        places = _vectors(np.ravel(lon), np.ravel(lat))
        chords, ids = self._cKDtree.query(places, k=k, distance_upper_bound=max_distance)
        chords, ids = chords.reshape(len(places), -1), ids.reshape(len(places), -1)
        arcs = 2 * np.arcsin(np.minimum(chords / 2, 1))
        return np.where(np.isfinite(chords), arcs, np.inf), ids
