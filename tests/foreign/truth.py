# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and what is true of them, computed without Calotte: a bisected icosahedron whose sites
are moved a little, its circumcentres and Voronoi cells; and a cube of quadrilaterals."""
import math
import random


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def unit(a):
    norm = math.sqrt(dot(a, a))
    return tuple(x / norm for x in a)


def area(a, b, c):
    """Of a spherical triangle, signed (Oosterom and Strackee, 1983)."""
    return 2 * math.atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a))


def polygon_area(corners):
    return sum(area(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1))


def icosahedron():
    g = (1 + math.sqrt(5)) / 2
    points = [unit(p) for p in [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
                                (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9),
             (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    return points, faces


def bisected(points, faces):
    points, middle = list(points), {}

    def between(a, b):
        key = (min(a, b), max(a, b))
        if key not in middle:
            middle[key] = len(points)
            points.append(unit(tuple(x + y for x, y in zip(points[a], points[b]))))
        return middle[key]

    out = []
    for a, b, c in faces:
        ab, bc, ca = between(a, b), between(b, c), between(c, a)
        out += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return points, out


class Mesh:
    """Sites, counter-clockwise Delaunay triangles, their circumcentres and the Voronoi cells."""

    def __init__(self, levels=2, move=0.02, seed=1):
        points, faces = icosahedron()
        for _ in range(levels):
            points, faces = bisected(points, faces)
        random.seed(seed)
        self.sites = [unit(tuple(x + random.uniform(-move, move) for x in p)) for p in points]
        self.triangles = faces
        self.corners = [self.circumcentre(t) for t in faces]
        self.cells = [self.ring(i) for i in range(len(points))]
        self.areas = [polygon_area([self.corners[k] for k in cell]) for cell in self.cells]
        for t, (a, b, c) in enumerate(faces):  # the empty circumcircle, by its definition
            centre, reach = self.corners[t], dot(self.corners[t], self.sites[a])
            assert all(i in (a, b, c) or dot(centre, p) < reach - 1e-12
                       for i, p in enumerate(self.sites)), "the truth is not Delaunay"

    def circumcentre(self, triangle):
        a, b, c = (self.sites[i] for i in triangle)
        centre = unit(cross(minus(b, a), minus(c, a)))
        assert dot(centre, a) > 0
        return centre

    def ring(self, site):
        """The triangles around a site, counter-clockwise."""
        follows = {}
        for t, triangle in enumerate(self.triangles):
            if site in triangle:
                k = triangle.index(site)
                follows[triangle[(k + 1) % 3]] = (t, triangle[(k + 2) % 3])
        start = here = min(follows)
        ring = []
        while True:
            t, here = follows[here]
            ring.append(t)
            if here == start:
                return ring


def cube_of_quads(n):
    """Corners, cells and centres of a gnomonic cubed sphere."""
    corners, known, cells, centres = [], {}, [], []

    def corner(p):
        key = tuple(round(x, 9) for x in p)
        if key not in known:
            known[key] = len(corners)
            corners.append(unit(p))
        return known[key]

    for axis in range(3):
        for sign in (1.0, -1.0):
            def place(u, v):
                p = [0.0] * 3
                p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = sign, sign * u, v
                return tuple(p)
            for i in range(n):
                for j in range(n):
                    u, v, s = -1 + 2 * i / n, -1 + 2 * j / n, 2 / n
                    cells.append([corner(place(u + a * s, v + b * s))
                                  for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
                    centres.append(unit(place(u + s / 2, v + s / 2)))
    return corners, cells, centres
