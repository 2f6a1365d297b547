# SPDX-License-Identifier: GPL-3.0-or-later
"""Nested nodes for graph networks, and edges from and to them."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments, _calotte, _display, _functions, _graphs
from ._arguments import EARTH_RADIUS_KM
from ._calotte import Error, Mesh
from ._functions import Array, DensityLike, Locator, Progress, SurfaceLike, WidthLike

Edges = NDArray[np.int64]


def _edge_index(sources, targets):
    """2 x m, C-contiguous."""
    return np.stack((sources, targets)).astype(np.int64, copy=False)


def _both_ways(pairs):
    """Pairs of nodes in both directions, by source and then by target."""
    sources, targets = np.concatenate((pairs, pairs[:, ::-1])).T
    order = np.lexsort((targets, sources))
    return _edge_index(sources[order], targets[order])


def _listed(lists):
    """For each item of lists the number of its list, and the item."""
    return np.repeat(np.arange(len(lists)), np.diff(lists.begin)), lists.ids


def _made(make, *given):
    try:
        return Multimesh(**make(*given))
    except MemoryError:
        raise MemoryError("the nodes and edges need more memory than there is; give fewer levels or nodes") from None


@dataclass(frozen=True, repr=False, eq=False)
class Multimesh:
    """Nodes of several levels, of which each has those of the level before as its first ones, of multimesh().

    meshes: by level, the coarsest first: the Mesh of its nodes.
    points: (n, 3) the nodes of the finest level; in a plane (n, 2).
    lonlat: (n, 2) their longitudes and latitudes, degrees.
    level_sizes: the number of nodes of each level.
    parents: (n, 2) two nodes of the level before the one that a node came with: the ends of the edge
        of which it is the midpoint, where levels are bisected; elsewhere the two nearest. -1 of the
        coarsest level.
    converged: by level, whether its run did; empty where levels are bisected.
    """

    meshes: tuple[Mesh, ...]
    _level_edges: tuple[NDArray[np.int32], ...]
    _all_edges: NDArray[np.int32]
    parents: NDArray[np.int32]
    converged: tuple[bool, ...]

    @property
    def points(self) -> Array:
        return self.meshes[-1].points

    @property
    def lonlat(self) -> Array:
        return _functions.to_lonlat(self.points)

    @property
    def level_sizes(self) -> tuple[int, ...]:
        return tuple(len(mesh) for mesh in self.meshes)

    def _level(self, level):
        if not 0 <= _functions._count(level, "the level") < len(self.meshes):
            raise Error(f"the level is {level}; give 0 to {len(self.meshes) - 1}")
        return level

    def _pairs(self, level):
        return self._all_edges if level is None else self._level_edges[self._level(level)]

    def mesh(self, level: int = -1) -> Mesh:
        """The Mesh of a level; by default the finest."""
        return self.meshes[-1 if level == -1 else self._level(level)]

    def edges(self, level: int | None = None) -> Edges:
        """The edges of a level's mesh in both directions, by source and then by target: (2, m) sources and targets.

        level: by default the edges of all levels together, each once.
        """
        return _both_ways(self._pairs(level))

    def encoder(self, points: ArrayLike, *, k: int | None = None, radius: float | None = None) -> Edges:
        """Edges from data at points to nodes of the finest level: (2, m) points and nodes, by point.

        points: as for locate(). k: the number of nearest nodes of each, by distance. radius: the
        nodes within it, radians, at most pi; in a plane in its unit. Give one of them.
        """
        if (k is None) == (radius is None):
            raise Error("give k, the number of nearest nodes, or radius, a distance in which all are")
        locator = Locator(self.meshes[-1])
        if radius is not None:
            distance = float(_arguments.numbers(radius, "the radius"))
            return _edge_index(*_listed(locator.within(points, distance)))
        nodes = locator.nearest(points, _functions._count(k, "k"))
        return _edge_index(np.repeat(np.arange(len(nodes)), nodes.shape[1]), nodes.ravel())

    def decoder(self, points: ArrayLike, *, k: int | None = None) -> Edges:
        """Edges from nodes of the finest level to points: (2, m) nodes and points, by point.

        points: as for locate(). k: the number of nearest nodes of each, by distance. By default the
        corners of the triangle that contains the point; the nearest node, where none does.
        """
        if k is not None:
            return self.encoder(points, k=k)[::-1].copy()
        mesh = self.meshes[-1]
        found = Locator(mesh).find(points)
        corners = np.take(mesh.triangles, np.maximum(found.triangle, 0), axis=0)
        outside = found.triangle < 0
        corners[outside] = found.nearest[outside, np.newaxis]
        kept = np.ones(corners.shape, dtype=bool)
        kept[outside, 1:] = False
        rows = np.repeat(np.arange(len(corners)), 3).reshape(corners.shape)
        return _edge_index(corners[kept], rows[kept])

    def to_scipy_sparse(self, level: int | None = None) -> Any:
        """The edges as a symmetric scipy.sparse.csr_array of ones, n x n. level: as for edges(). It needs scipy."""
        sources, targets = self.edges(level)
        size = self.level_sizes[-1 if level is None else level]
        return _graphs.sparse(sources, targets, size)

    def to_networkx(self, level: int | None = None) -> Any:
        """The nodes and edges as a networkx.Graph. level: as for edges(). It needs networkx."""
        return _graphs.graph(self._pairs(level), self.level_sizes[-1 if level is None else self._level(level)])

    def __len__(self) -> int:
        return len(self.meshes[-1])

    def __repr__(self) -> str:
        sizes = ", ".join(map(str, self.level_sizes))
        return (f"<calotte.Multimesh: {_display.counted(len(self.meshes), 'level')} of {sizes} nodes, "
                f"{_display.counted(len(self._all_edges), 'edge')}>")


def multimesh(levels: int, *, coarsest: int | None = None, cells: int | None = None,
              points: ArrayLike | None = None, density: DensityLike | None = None,
              cell_width: WidthLike = None, surface: SurfaceLike | None = None, seed: int = 1,
              regions: int | None = None, progress: Progress | bool | None = None,
              earth_radius: float = EARTH_RADIUS_KM) -> Multimesh:
    """Nodes of levels 0 to `levels`, of which each has those of the level before as its first ones.

    Graph networks pass messages along the edges of all levels. Without cells, density, cell_width
    and surface, each level has the midpoints of the edges of the one before as further nodes, which
    are those of a bisected icosahedron, a class III geodesic (coarsest), or points. With one of
    these, each level follows the density or widths: its nodes are a CVT beside those of the level
    before, which stay. In a region some are along its boundary, and the meshes end there.

    levels: the finest level; 0 to 13. Each has about four times the nodes of the one before.
    coarsest: the number of nodes of level 0; default 12.
    cells: the number of nodes of the finest level, which has about as many. Without it and coarsest,
        it follows from the widths.
    points: the nodes of level 0, as of delaunay().
    density, surface, seed, regions, earth_radius: as for cvt().
    progress: as for cvt(), of the run of each level; True ends that of the level.
    cell_width: of the finest level, as for cvt(); with coarsest or cells its ratios count.
    Returns a Multimesh. Raises Error.

    >>> graph = multimesh(6)
    >>> graph.level_sizes
    (12, 42, 162, 642, 2562, 10242, 40962)
    >>> graph.edges().shape
    (2, 327660)
    >>> multimesh(2, cell_width=150, surface="circle=10,50,2000km").edges(0).dtype
    dtype('int64')
    """
    finest = _functions._count(levels, "the number of levels")
    if not 0 <= finest < 1 << 31:
        raise Error(f"the finest level is {finest}; give 0 to 13")
    if (points is not None) + (coarsest is not None) + (cells is not None) > 1:
        raise Error("points, coarsest and cells each give the number of nodes; give one of them")
    if cells is None and density is None and cell_width is None and surface is None:
        if points is not None:
            nodes = _arguments.sphere_points(points)
        elif coarsest is None:
            nodes = _calotte.bisected_icosahedron(0)
        else:
            nodes = _calotte.geodesic_sphere(_functions._count(coarsest, "the number of nodes of the coarsest level"))
        return _made(_calotte.bisected_multimesh, finest, nodes)
    if points is not None:
        raise Error("points are bisected as they are, and follow no density, widths or surface; leave one of them out")
    recipe = _functions._recipe(cells, density, cell_width, surface, earth_radius=earth_radius, seed=seed)
    first = 0 if coarsest is None else _functions._count(coarsest, "the number of nodes of the coarsest level")
    if coarsest is not None and first < 1:
        raise Error(f"the number of nodes of the coarsest level is {first}; give a larger one")
    made = _made(_calotte.multimesh, finest, recipe, first, regions, _functions._reporting(progress))
    for mesh in made.meshes:
        if cell_width is not None and mesh.surface.is_sphere:
            mesh._earth_radius = earth_radius
    if not all(made.converged):
        _arguments.warn(f"level {made.converged.index(False)} did not converge; make the widths or the density smoother")
    return made
