// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/progress.h>
#include <calotte/types.h>

#include <optional>

CALOTTE_API_BEGIN
namespace calotte {

/// The sites that a region triangulates besides its own. The choice affects time and memory, not
/// the result.
enum class Overlap {
  halo,     ///< those within a thin strip around its coarse Voronoi cell; the default
  distance, ///< those closer to its centre than the farthest neighbouring centre (Jacobsen et al.,
            ///< 2013, Sect. 2.1.1)
  voronoi,  ///< those owned by the neighbouring regions (same section)
};

/// Where the centres of the regions are placed.
enum class Centres {
  /// A coarse CVT of a sample of the sites, so that regions hold about equal work; the default.
  sample,
  /// A Fibonacci lattice on the sphere, or in the plane over the bounding box of the sites. It
  /// ignores the density of the sites.
  fibonacci,
};

/// How the sites are divided into regions, which are triangulated in parallel. These options affect
/// time and memory, not the result.
///
/// A function that takes them throws Error invalid_argument for an option out of range; for a
/// centre that is out of range, index() is its column.
struct Partition {
  /// Number of regions; >= 1. The library uses at most one per site. Default: 1 for fewer than 4096
  /// sites, otherwise one per 16384 sites, but at least 12.
  std::optional<int> regions = {};
  Centres centres = Centres::sample; ///< no effect if given_centres is set
  /// The centres of the regions, at least one column; overrides the two options above. On the
  /// sphere 3 x k finite, non-zero directions of any norm. In the plane 2 x k finite points in the
  /// unit of the points, or 3 x k, whose third row is ignored. Default: none.
  std::optional<DoubleMatrix> given_centres = {};
  Overlap overlap = Overlap::halo; ///< no effect if there is one region
};

/// What happens to points of equal direction, in the plane of equal position, and to points that
/// merge_within joins.
enum class Duplicates {
  merge,  ///< they become one site, that of the lowest index; the default
  refuse, ///< the function throws Error duplicate; index() is the first that duplicates another
};

/// Options of a triangulation. `duplicates` and `merge_within` affect the result.
struct DelaunayOptions {
  Duplicates duplicates = Duplicates::merge; ///< see Duplicates
  /// A site nearer than this to an earlier site that stays is merged into it; >= 0 and finite.
  /// Default 0: only equal sites merge. On the sphere an angle in radians, measured in doubles to
  /// 1e-15. In the plane a distance in the unit of the points, not measured across the edge of a
  /// periodic box.
  double merge_within = 0;
  Partition partition = {}; ///< affects time and memory, not the result
  /// Stages: sites, regions, triangulate, unite; in a periodic box it may repeat the last three.
  /// Default: none.
  ProgressCallback progress = {};
};

} // namespace calotte
CALOTTE_API_END
