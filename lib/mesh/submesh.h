// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/connectivity.h"
#include "mesh/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

namespace calotte::mesh_detail {

/// Some triangles of a mesh with their sites, under local numbers.
struct Submesh {
  /// An edge of the part's boundary. The part is to its left.
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

/// Extracts a part of a mesh. Its sites ascend; its triangles start at their lowest sites, even
/// where those of the mesh do not.
/// \param triangles, neighbours of the mesh.
/// \param part numbers of its triangles, each once; they keep their order.
Submesh extract(const Triangles& triangles, const Triangles& neighbours,
                std::vector<std::int32_t> part);

/// Renumbers the sites of a part: first those with a mark, then the others, each in their order.
/// \param marks by own number.
/// \returns the number of marked sites.
std::int32_t put_first(Submesh& part, const std::vector<std::uint8_t>& marks);

/// Writes the triangles of a part back into the mesh. Their edges may have been flipped since they
/// were extracted, except those of the rim. The mesh beyond the rim may have changed, too.
/// \pre no two edges of the rim have the same ends.
void splice(const Submesh& part, Connectivity& mesh);

/// A part as a mesh of its own, on the same surface.
Mesh as_mesh(const Submesh& part, const Mesh& whole);

} // namespace calotte::mesh_detail
