// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// The values of fields follow their cells, edges and vertices to other places.
namespace calotte::io_detail {

/// Whether a field has its values for so many places.
bool has_values_for(const MeshField& field, std::int64_t places);

/// \param place by old place: the new one, each once.
void move_values(MeshField& field, std::span<const std::int32_t> place);

/// The same for all fields with values for so many triangles.
void move_vertex_values(std::vector<MeshField>& fields, std::span<const std::int32_t> place);

/// \param from by new place: the old one.
void select_values(MeshField& field, std::span<const std::int32_t> from);

/// The edges of a closed mesh, the lower site first, in the order of FieldLocation::edges.
/// \pre triangles counter-clockwise, two at each edge.
Pairs edges_of(const Triangles& triangles);

/// Where pairs of sites stand in that order.
struct EdgeOrder {
  Pairs sorted;                    ///< the same pairs in that order, the lower site first
  std::vector<std::int32_t> place; ///< by pair
  std::vector<bool> turned;        ///< by pair: the higher site came first
};
EdgeOrder order_of(const Pairs& pairs);

/// Brings values at edges into that order. Directed ones change their sign at turned edges.
void move_edge_values(MeshField& field, const EdgeOrder& order);

/// Brings all fields at edges from a file's order into that of the mesh.
/// \param pairs the sites of the file's edges; -1 where an edge has but one.
/// \param changes receives a line that tells which fields change their signs.
/// \param ignored receives the fields of a file whose edges are not those of the mesh; they are
///        removed.
void settle_edge_fields(const Triangles& triangles, const Pairs& pairs,
                        std::vector<MeshField>& fields, std::vector<std::string>& changes,
                        std::vector<std::string>& ignored);

} // namespace calotte::io_detail
