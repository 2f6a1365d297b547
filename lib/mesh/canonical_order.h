// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "mesh/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <span>

/// The canonical order of a mesh's triangles: each starts at its lowest vertex, and they are sorted
/// by their vertices; triangles of equal vertices keep their order. Linear time, parallel.
namespace calotte::mesh_detail {

/// Brings triangles into canonical order, and their neighbours with them.
/// \param neighbours across from each vertex, -1 if there is none; 3 x 0 if they are not known.
/// \param new_id by old vertex: renames the vertices first; empty keeps their names.
/// \pre vertices are in [0, new_id.size()), or not negative if there are no new names; neighbours
///         are in [-1, triangles).
void make_canonical(Triangles& triangles, Triangles& neighbours,
                    std::span<const std::int32_t> new_id = {});

/// The canonical order of triangles, for arrays with an entry for each.
struct CanonicalOrder {
  Array<std::int32_t> index; ///< new index of each triangle
  Array<std::int8_t> first;  ///< which of its old vertices comes first
};

/// The two stages of make_canonical(), for a mesh that stays unchanged.
CanonicalOrder order_triangles(const Triangles& triangles, std::span<const std::int32_t> new_id,
                               Triangles& out);
void order_neighbours(const Triangles& neighbours, const CanonicalOrder& order, Triangles& out);

/// True if make_canonical() would not change the triangles.
bool is_canonical(const Triangles& triangles);

} // namespace calotte::mesh_detail
