// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/first_fault.h"
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

/// \throws Error invalid_argument for a mesh without neighbours, and for triangles whose vertices
/// are
///         not three of its points, with the index of the first.
inline void require_triangles(const Mesh& mesh) {
  require_neighbours(mesh);
  FirstFault fault;
  for_each_block(mesh.triangles.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t) {
      const std::int32_t a = mesh.triangles(0, t), b = mesh.triangles(1, t),
                         c = mesh.triangles(2, t);
      if (std::min({a, b, c}) < 0 || std::max({a, b, c}) >= mesh.points.cols() || a == b ||
          b == c || c == a)
        fault.at(t);
    }
  });
  fault.refuse("triangle", "has a vertex outside the mesh's points, or one of them twice: "
                           "triangulate the points anew");
}

} // namespace calotte::mesh_detail
