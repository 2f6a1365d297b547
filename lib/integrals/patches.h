// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "integrals/room.h"

#include <calotte/mesh.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace calotte::integrals_detail {

/// The regions that own the sites.
struct Ownership {
  Array<std::int32_t> owner;                    ///< by site; negative if no region owns it
  Array<std::int32_t> index;                    ///< by site: its index among those of its owner
  std::vector<std::vector<std::int32_t>> owned; ///< by region: its sites, ascending
};

/// \param owner by site: a region from 0 to regions - 1, or a negative number for none.
Ownership make_ownership(Array<std::int32_t>&& owner, std::int32_t regions);

/// The part of a closed mesh that a region's task reads: the triangles with a site that the region
/// owns, and the sites of these. It has no positions; the task copies them after each move.
struct Patch {
  std::int32_t region = 0;
  std::vector<std::int32_t>
      sites; ///< by local number: those it owns, then its halo; each ascending
  std::int32_t owned = 0;
  /// Numbers in the mesh, ordered by the triangles' lowest site and the site after it. The
  /// triangulation alone determines the order, for any partition and history.
  std::vector<std::int32_t> triangles;
  /// The corners of these triangles, from their lowest site on, as local numbers.
  std::vector<std::array<std::int32_t, 3>> corners;
};

/// The sites of a triangle, starting with the lowest: moments have the same bits only if they start
/// at the same corner.
std::array<std::int32_t, 3> sites_from_lowest(const Triangles& triangles, std::int32_t t);

/// Sorts triangles in the order of a patch.
/// \param list their numbers, each once.
void sort_by_sites(std::vector<std::int32_t>& list, const Triangles& triangles);

/// True if some of a patch's own sites are consecutive in the mesh, as most are that are numbered
/// along a curve.
/// \param first, count of their local numbers.
inline bool are_consecutive(const Patch& patch, std::int64_t first, std::int64_t count) {
  const std::int32_t* const sites = patch.sites.data() + first;
  return first + count <= patch.owned && sites[count - 1] - sites[0] == count - 1;
}

/// Makes the patch of each region. \param triangles counter-clockwise, in any order.
std::vector<Patch> make_patches(const Triangles& triangles, const Ownership& ownership);

/// Updates the patches after changes of some triangles of the mesh.
/// \param changed their numbers; may repeat.
void renew_patches(std::vector<Patch>& patches, const Triangles& triangles,
                   const Ownership& ownership, std::span<const std::int32_t> changed);

} // namespace calotte::integrals_detail
