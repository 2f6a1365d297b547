// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "base/require.h"
#include "mesh/room.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace calotte::mesh_detail {

inline bool are_ids(const std::int32_t* ids, std::int64_t count, std::int64_t bound,
                    std::int32_t least) {
  return holds_for_blocks(count, [=](std::int64_t begin, std::int64_t end) {
    std::int32_t low = ids[begin], high = low;
    for (std::int64_t k = begin; k != end; ++k) {
      low = std::min(low, ids[k]);
      high = std::max(high, ids[k]);
    }
    return low >= least && high < bound;
  });
}

/// True if all ids are at least `least` and below the bound.
inline bool are_ids(const Triangles& ids, std::int64_t bound, std::int32_t least = 0) {
  return are_ids(ids.data(), ids.size(), bound, least);
}
inline bool are_ids(const std::vector<std::int32_t>& ids, std::int64_t bound,
                    std::int32_t least = 0) {
  return are_ids(ids.data(), std::ssize(ids), bound, least);
}

/// \throws Error invalid_argument for a mesh that lacks neighbours.
template <class AnyMesh> void require_neighbours(const AnyMesh& mesh) {
  require(mesh.neighbours.cols() == mesh.triangles.cols(),
          "the mesh has {} triangles but neighbours of {}; give a mesh with both",
          mesh.triangles.cols(), mesh.neighbours.cols());
}

} // namespace calotte::mesh_detail
