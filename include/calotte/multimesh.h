// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>
#include <calotte/export.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/matrices.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

/// Nested sets of nodes for graph neural networks: a multi-mesh (Lam et al., Learning skillful
/// medium-range global weather forecasting, Science 382, 2023).
///
///     const Multimesh six = multimesh(6);                        // of a bisected icosahedron
///     const Pairs edges = all_edges(six);                        // 2 x 163 830
///     const Multimesh area = multimesh(3, {.resolution = widths, .surface = box});
CALOTTE_API_BEGIN
namespace calotte {

/// Meshes of which each has the points of the one before as its first points.
struct Multimesh {
  /// By level, the coarsest first: the mesh of its nodes. On the whole sphere it is the Delaunay
  /// triangulation; in a bounded surface it ends at nodes along the boundary, see
  /// Boundary::generators.
  std::vector<Mesh> meshes;
  /// By level 2 x e nodes: the edges of its mesh, the lower node first, sorted.
  std::vector<Pairs> edges;
  /// 2 x n, by node of the finest level, two nodes of the level before the one that it came with:
  /// where levels are bisected, the ends of the edge of which it is the midpoint, the lower first;
  /// elsewhere the two nearest, the nearest first. -1 -1 for those of the coarsest level.
  Pairs parents;
  std::vector<CvtReport> reports; ///< by level, of its run; none where levels are bisected

  /// 3 x n, the nodes of the finest level.
  const Points3& points() const { return meshes.back().points; }
};

/// Bisects a triangulation of the sphere, so many times: each level has the midpoints of the edges
/// of the one before as further nodes, which do not move. n nodes become 4n - 6.
/// \param finest the last level, counted from 0; 0 to 13.
/// \param coarsest 3 x n directions, of level 0, which keep their bits. Default: the icosahedron,
///        so that level l has 10 x 4^l + 2 nodes. Others are geodesic_sphere(n).
/// \throws Error invalid_argument for a level out of range, and for more than 2^30 nodes, and
///         for nodes within a hemisphere; with an index duplicate; as delaunay().
Multimesh multimesh(int finest, const PointsRef& coarsest = bisected_icosahedron(0));

/// Levels of which each follows a density: the number of nodes in an area is the same share of all
/// nodes at each level, a quarter of those of the next one.
///
/// Level 0 is a CVT of its own. Each further level starts with the midpoints of the edges of the
/// one before, and a descent moves these to a CVT, in which the nodes of the levels before stay.
/// In a bounded surface nodes along its boundary belong to all levels: those of a level halve the
/// gaps between those of the one before. Rows of nodes along the boundary thus lead on from level
/// to level.
///
/// The result has the same bits for any number of threads. A run that does not converge is no
/// error; its report says so.
/// \param finest the last level, counted from 0; 0 to 13.
/// \param recipe widths and the number of cells are those of the finest level, which has about as
///        many nodes; start, seed and fixed generators are of level 0. Its boundary has no effect.
///        It has no limited area, walls or lines, nor points to start from.
/// \param coarsest the number of nodes of level 0, in place of a number of cells; 0, the default:
///        follows from the finest level.
/// \param options state has no effect. progress sees the runs of the levels one after the other;
///        ProgressReply::stop ends that of a level.
/// \throws Error invalid_argument for a level out of range, for two numbers of nodes, and where
///         level 0 has too few nodes or the finest more than 2^30; as make_grid().
Multimesh multimesh(int finest, const Recipe& recipe, std::int64_t coarsest = 0,
                    const RunOptions& options = {});

/// The edges of all levels together, each once: 2 x e nodes, the lower first, sorted.
Pairs all_edges(const Multimesh& multimesh);

} // namespace calotte
CALOTTE_API_END
