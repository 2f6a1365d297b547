// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/room.h"
#include "delaunay/sites.h"

#include <calotte/delaunay.h>
#include <calotte/matrices.h>

#include <cstdint>
#include <vector>

namespace calotte::delaunay_detail {

/// The sites x with x.normal <= offset; normals are unit vectors.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// Ranks begin <= r < end.
struct Run {
  std::int32_t begin, end;
};

/// The decomposition: the owner of each site, and the sites that each region triangulates.
struct Regions {
  std::vector<Vec3> centres; ///< t_k, unit vectors; in a plane points in its frame
  Array<std::int32_t> owner; ///< by rank: the region with the nearest centre, ties to the lowest
  std::vector<std::vector<Run>> members; ///< by region, ascending: its own sites and its halo
  /// By region: a site in all of these half-spaces is a member.
  std::vector<std::vector<HalfSpace>> covered;
};

/// Computes the owners of the sites, by rank, and the members by the option `overlap`.
/// \param adjacent for each region its neighbours: regions whose coarse Voronoi cells meet its own.
///         Too many neighbours cost time; too few make halos larger than necessary.
Regions make_regions(const Sites& sites, std::vector<Vec3> centres, const IdLists& adjacent,
                     RegionOverlap overlap);

/// Merges regions whose caps cannot certify their sites. Those that share members become one
/// region, which has all sites of a cap around their sites.
/// \param failed by region.
/// \return the regions to triangulate again: the merged ones, and those with a member of theirs.
///         None if a merged region would have most sites or more than a cap of 60 degrees.
std::vector<std::int32_t> merge_failed(const Sites& sites, const std::vector<char>& failed,
                                       Regions& regions);

} // namespace calotte::delaunay_detail
