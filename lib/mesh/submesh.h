// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/connectivity.h"
#include "mesh/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

namespace calotte::mesh_detail {

/// Some triangles of a mesh by themselves, and their sites, with numbers of their own.
struct Submesh {
  /// An edge with the part to its left and none of it to its right.
  struct RimEdge {
    std::int32_t triangle; ///< in the mesh: where the edge was
    int across;            ///< from this vertex of it there
    std::int32_t from, to; ///< own numbers
  };

  Connectivity faces = {};                  ///< own numbers; -1 beyond the rim
  std::vector<std::int32_t> triangles = {}; ///< by own number: that in the mesh
  std::vector<std::int32_t> sites = {};     ///< by own number: that in the mesh
  std::vector<RimEdge> rim = {};            ///< ascending by `from`, then by `to`
};

/// A part of a mesh. Its sites ascend; its triangles start at their lowest site, whatever the mesh
/// has.
/// \param triangles, neighbours of the mesh.
/// \param part numbers of its triangles, each once; they keep their order.
Submesh extract(const Triangles& triangles, const Triangles& neighbours,
                std::vector<std::int32_t> part);

/// Numbers the sites of a part anew: first those with a mark; both kinds keep their order.
/// \param marks by own number.
/// \returns how many have one.
std::int32_t put_first(Submesh& part, const std::vector<std::uint8_t>& marks);

/// Writes the triangles of a part back into the mesh. They may have been flipped since they were
/// extracted, but for edges of the rim; what is beyond the rim may have changed, too.
/// \pre no two edges of the rim have the same ends.
void splice(const Submesh& part, Connectivity& mesh);

/// A part as a mesh of its own, on the same surface.
Mesh as_mesh(const Submesh& part, const Mesh& whole);

} // namespace calotte::mesh_detail
