// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/progress.h>

#include <Eigen/Core>

#include <optional>

CALOTTE_API_BEGIN
namespace calotte {

/// The sites that a region triangulates besides its own. The choice does not affect the result.
enum class Sort {
  halo,     ///< those within a thin strip around its coarse Voronoi cell
  distance, ///< those closer to its centre than the farthest neighbouring centre (Jacobsen et al.,
            ///< 2013, Sect. 2.1.1)
  voronoi,  ///< those owned by the neighbouring regions (same section)
};

/// Where the centres of the regions are placed.
enum class Centres {
  sample,    ///< a coarse CVT of a sample of the sites: regions hold about equal work
  fibonacci, ///< a Fibonacci lattice, whatever the density of the sites
};

/// How the sites are divided into regions, which are triangulated in parallel. These options change
/// time and memory only: they never affect the result.
struct Partition {
  /// Number of regions; >= 1; at most the number of sites is used. Default: from the number of
  /// sites.
  std::optional<int> regions = {};
  Centres centres = Centres::sample;
  /// The regions' centres (MPI-SCVT's RegionList); overrides the two above. On the sphere 3 x k
  /// directions of any norm; in the plane 2 x k places, or 3 x k, whose third row is ignored.
  std::optional<Eigen::MatrixXd> given_centres = {};
  Sort sort = Sort::halo;
};

/// What happens to sites of equal direction, or in the plane of equal place.
enum class Duplicates {
  merge,  ///< they become one site, that of the lowest index
  refuse, ///< they are an error
};

/// Options of a triangulation. `duplicates` and `merge_within` affect the result.
struct DelaunayOptions {
  Duplicates duplicates = Duplicates::merge;
  /// A site nearer than this to an earlier site that stays is merged into it; >= 0. On the sphere
  /// an angle in radians, measured in doubles, good to 1e-15; in the plane a distance in the unit
  /// of the points, not across the edge of a periodic box.
  double merge_within = 0;
  Partition partition = {};
  /// Stages: sites, regions, triangulate, unite.
  ProgressCallback progress = {};
};

} // namespace calotte
CALOTTE_API_END
