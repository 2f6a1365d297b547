// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "moments.h"
#include "stars.h"

#include <calotte/types.h>

#include <cstdint>

namespace calotte::detail {

struct Repair {
  std::int64_t flips = 0;
  bool rebuilt =
      false; ///< a triangle turned over, or so many edges failed that a new mesh was cheaper
};

/// Makes a closed mesh whose points have moved Delaunay again: edges whose pulls do not clearly
/// hold are decided by the exact predicate, and flipped until all are Delaunay. A mesh without
/// overturned triangles whose edges are all Delaunay is the Delaunay triangulation (Delaunay,
/// 1934).
///
/// \param mesh unit columns; after flips its triangles are no longer in canonical order.
/// \param stars, pulls of the mesh, as before the move and after it; both are made anew when it
/// changes. \throws Error too_few_sites, when two generators have met.
Repair repair(Mesh& mesh, Stars& stars, Pulls& pulls);

} // namespace calotte::detail
