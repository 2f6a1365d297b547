# SPDX-License-Identifier: GPL-3.0-or-later
"""Planar MPAS files of regular hexagons as MPAS-Tools makes them: channels, periodic along x with walls
in y, and boxes from which cells have been culled."""
import math

import netcdf3

# Corners of a hexagon, counter-clockwise from the lower right, in halves of its width and sixths of its
# height over the square root of 3.
CORNERS = [(1, -1), (1, 1), (0, 2), (-1, 1), (-1, -1), (0, -2)]


class Hexagons:
    """Rows of whole cells, and what is true of them: functions of columns, rows and the width dc."""

    def __init__(self, columns, rows, dc, culled=(), box=False, turned=False):
        self.dc, self.turned = dc, turned
        self.period = [columns * dc, rows * dc * math.sqrt(3) / 2 if box else 0.0]
        wrap = lambda u, v: (u % (2 * columns), v % (3 * rows) if box else v)
        self.cells, self.rings, self.corners, number = [], [], [], {}
        for j in range(rows):
            for i in range(columns):
                if (i, j) in culled:
                    continue
                u, v = 2 * i + j % 2 + 1, 3 * j + 2
                self.cells.append(self.place(u, v))
                ring = []
                for a, b in CORNERS:
                    key = wrap(u + a, v + b)
                    if key not in number:
                        number[key] = len(self.corners)
                        self.corners.append(self.place(u + a, v + b))  # beside the box, too
                    ring.append(number[key])
                self.rings.append(ring)
        self.link()

    def place(self, u, v):
        return u * self.dc / 2, v * self.dc / (2 * math.sqrt(3))

    def link(self):
        """Edges from vertex to vertex with their first cell to the left; -1 for no second cell."""
        sides = {}
        for i, ring in enumerate(self.rings):
            for k, end in enumerate(ring):
                sides[ring[k - 1], end] = i
        self.edges, self.edge_of = [], {}
        for (start, end), i in sides.items():
            other = sides.get((end, start), -1)
            if other < 0 or i < other:
                self.edge_of[start, end] = self.edge_of[end, start] = len(self.edges)
                self.edges.append((i, other, start, end))
        self.beyond = [[sides.get((end, ring[k - 1]), -1) for k, end in enumerate(ring)]
                       for ring in self.rings]
        self.around = [[] for _ in self.corners]  # cells with the corners before and after
        for i, ring in enumerate(self.rings):
            for k, corner in enumerate(ring):
                self.around[corner].append((i, ring[k - 1], ring[(k + 1) % 6]))

    def fan(self, v):
        """The cells at a corner counter-clockwise, and the edges before each and after the last."""
        sectors = list(self.around[v])
        starts = [s for s in sectors if all(s[2] != other[1] for other in sectors)]
        fan = [(starts or sectors)[0]]
        while len(fan) < len(sectors):
            fan.append(next(s for s in sectors if s[2] == fan[-1][1]))
        edges = [self.edge_of[v, s[2]] for s in fan] + ([self.edge_of[v, fan[-1][1]]] if starts else [])
        return [s[0] for s in fan], edges

    def triangles(self):
        return sum(1 for around in self.around if len(around) == 3)

    def boundary(self):
        """Edges between two cells of which one end alone has three cells."""
        whole = lambda v: len(self.around[v]) == 3
        return sum(1 for _, other, start, end in self.edges if other >= 0 and whole(start) != whole(end))

    def write(self, path, **attributes):
        n, m, e = len(self.cells), len(self.corners), len(self.edges)
        area, dv = math.sqrt(3) / 2 * self.dc ** 2, self.dc / math.sqrt(3)
        cell, edge, vertex = ("nCells",), ("nEdges",), ("nVertices",)
        pad = lambda row, size: [i + 1 for i in row] + [0] * (size - len(row))
        flat = lambda rows: [x for row in rows for x in row]
        fans = [self.fan(v) for v in range(m)]
        turn = (lambda p: (-p[1], p[0])) if self.turned else (lambda p: p)
        middles = []
        for i, _, start, _ in self.edges:  # from its first cell, half a width in the edge's direction
            k = next(k for k in range(6) if self.rings[i][k - 1] == start)
            angle = math.pi / 3 * (k - 1)
            middles.append((self.cells[i][0] + self.dc / 2 * math.cos(angle),
                            self.cells[i][1] + self.dc / 2 * math.sin(angle), angle))
        variables = {}
        for kind, dims, places in (("Cell", cell, self.cells), ("Vertex", vertex, self.corners),
                                   ("Edge", edge, [p[:2] for p in middles])):
            for k, axis in enumerate("xy"):
                variables[axis + kind] = (dims, [turn(p)[k] for p in places], {})
            variables["z" + kind] = (dims, [0.0] * len(places), {})
        quarter = math.pi / 2 if self.turned else 0
        variables.update({
            "nEdgesOnCell": (cell, [6] * n, {}),
            "verticesOnCell": (("nCells", "maxEdges"), flat(pad(r, 6) for r in self.rings), {}),
            "cellsOnCell": (("nCells", "maxEdges"), [i + 1 for i in flat(self.beyond)], {}),
            "edgesOnCell": (("nCells", "maxEdges"),
                            [self.edge_of[r[k - 1], r[k]] + 1 for r in self.rings for k in range(6)], {}),
            "cellsOnVertex": (("nVertices", "vertexDegree"), flat(pad(f[0], 3) for f in fans), {}),
            "edgesOnVertex": (("nVertices", "vertexDegree"), flat(pad(f[1], 3) for f in fans), {}),
            "cellsOnEdge": (("nEdges", "TWO"), flat((a + 1, b + 1) for a, b, _, _ in self.edges), {}),
            "verticesOnEdge": (("nEdges", "TWO"), flat((a + 1, b + 1) for _, _, a, b in self.edges), {}),
            "areaCell": (cell, [area] * n, {}), "dcEdge": (edge, [self.dc] * e, {}),
            "dvEdge": (edge, [dv] * e, {}),
            "angleEdge": (edge, [(p[2] + quarter) % (2 * math.pi) for p in middles], {}),
            "kiteAreasOnVertex": (("nVertices", "vertexDegree"),
                                  flat([area / 6] * len(f[0]) + [0.0] * (3 - len(f[0])) for f in fans), {}),
            "areaTriangle": (vertex, [area / 6 * len(f[0]) for f in fans], {}),
            "bottomDepth": (cell, [float(i) for i in range(n)], {"units": "m"})})
        period = self.period[::-1] if self.turned else self.period
        netcdf3.write(path, {"nCells": n, "nEdges": e, "nVertices": m, "maxEdges": 6, "TWO": 2,
                             "vertexDegree": 3}, variables,
                      {"on_a_sphere": "NO", "is_periodic": "YES", "sphere_radius": 0.0,
                       "x_period": period[0], "y_period": period[1], **attributes})
