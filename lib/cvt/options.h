// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/density.h>

#include <cstdint>
#include <vector>

namespace calotte {

/// Options of a CVT run. A function that takes them throws Error invalid_argument for a value out
/// of range.
struct CvtOptions {
  Density density = {};              ///< rho of the energy; default uniform
  Method method = Method::automatic; ///< see Method
  Norm norm = Norm::l2_scaled;       ///< compared with the tolerance
  double tolerance = 1e-6;           ///< stop when the norm is at most this; > 0 and finite
  /// Maximum number of evaluations per level; >= 0. The last line search may exceed it.
  int max_iterations = 1000;
  /// Number of bisections after the first level; >= 0, and at most 2^30 generators in the last
  /// level. A level that has converged or reached max_iterations is bisected (n -> 4n - 6, see
  /// bisect()) and converges again.
  int bisections = 0;
  /// Rounds of insertion and contraction on the last level, see split_and_collapse(), and up to
  /// 14 on coarser levels; each is followed by a descent. A round after a descent of more than 25
  /// evaluations counts for two. With rounds, all descents but the last end at an l2_scaled norm of
  /// 1e-3 or the tolerance, whichever is larger, or after 75 evaluations. >= 0; default 0.
  int insertion_rounds = 0;
  /// Number of generators of the result; > 0 if and only if insertion_rounds is. A level of b
  /// bisections before the last has 4^-b times as many.
  std::int64_t cells = 0;
  /// Ends the run with the shapes that models ask for. A pure CVT has few others, at dislocations,
  /// pairs of cells with 5 and 7 neighbours. First, up to four times at the end of the last
  /// descent, dislocations at short Voronoi edges are moved along their rows, and the generators
  /// around them relax; after the first time the descent goes on. Then a polish minimises the
  /// energy plus the squares of excesses over limits that are left: angles of triangles from 38 to
  /// 87 degrees, Voronoi edges from 0.21 to 1.1 times the length of the Delaunay edges across, and
  /// these from 0.8 to 1.3 times the spacing that the density demands. It moves generators next to
  /// such shapes away from their centroids: at first in subdomains of some hundred cells around
  /// each shape, then all, where that leaves some. It ends when no cotangent and no such ratio
  /// exceeds its limit by more than 0.02, after 60 evaluations, or after ten that hardly improve
  /// the worst shape; the mesh is well-centred if none does by 0.03. Near that the polish goes on,
  /// up to twice, with squares of four times the weight. A mesh within the limits does not change.
  /// A descent before a polish also converges when six evaluations have not halved its norm, 45 of
  /// a run without insertion. Default false: a pure CVT.
  bool well_centred = false;
  /// In a polish: the least length of a Delaunay edge over the spacing that the density demands
  /// there; 0 to 0.95. The shortest edge decides the stable step of gravity waves. Values near 1
  /// move many generators away from their centroids. Where the widths do not allow it, the report
  /// is not well_centred. Default 0.8.
  double least_spacing = usual_least_spacing;
  static constexpr double usual_least_spacing = 0.8; ///< its default
  /// Quadrature points per half kite, see make_integrand(); no effect for uniform density. All runs
  /// of make_grid() have 3 in the loop and 6 to finish, but see options_of_descent().
  int rule = 3;
  /// Rule from the iteration on in which the norm is at most ten times the tolerance or a line
  /// search fails. A run converges with this rule only. No effect for uniform density and with
  /// Norm::none. With insertion_rounds and a tolerance of 1e-5 or more, `rule` takes its place.
  int final_rule = 6;
  int divisions = 1;                         ///< of both rules, see make_integrand()
  Duplicates duplicates = Duplicates::merge; ///< of the start, see DelaunayOptions
  double merge_within = 0;                   ///< of the start, see DelaunayOptions; >= 0 and finite
  /// Number of generators that stay where they are: the first columns of the start, and of the
  /// result. A unit column, up to round-off, keeps its bits; others are normalised. They are
  /// distinct, count as cells, and for all norms as being at their centroids. Bisections keep them,
  /// and insertion contracts no edge between two of them; an edge to another generator is
  /// contracted to the fixed one. >= 0; default 0.
  std::int64_t fixed = 0;
  Boundary boundary = Boundary::clip; ///< of a bounded surface
  Partition partition = {};           ///< affects time and memory, not the result
  /// Of the run, in place of those that follow from the values above. Default: none.
  std::vector<CvtAction> actions = {};
};

} // namespace calotte
