// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Reorders the values of fields as cells, edges and vertices are renumbered.
namespace calotte::io_detail {

/// Whether a field has values for `count` cells, edges or vertices.
bool has_values_for(const MeshField& field, std::int64_t count);

/// \param new_index by old index, a permutation.
void move_values(MeshField& field, std::span<const std::int32_t> new_index);

/// The same for all fields at vertices that have values for each triangle.
void move_vertex_values(std::vector<MeshField>& fields, std::span<const std::int32_t> new_index);

/// \param from by new index: the old one.
void select_values(MeshField& field, std::span<const std::int32_t> from);

/// The edges of a closed mesh, the lower site first, in the order of FieldLocation::edges.
/// \pre triangles counter-clockwise, two at each edge.
Pairs list_edges(const Triangles& triangles);

/// The order of edges in a mesh for pairs of sites in any order.
struct EdgeOrder {
  Pairs sorted;                    ///< the pairs in that order, the lower site first
  std::vector<std::int32_t> index; ///< by pair: its index in `sorted`
  std::vector<bool> turned;        ///< by pair: the higher site came first
};
EdgeOrder sort_pairs(const Pairs& pairs);

/// Reorders values at edges. Directed ones change their sign at turned edges.
void move_edge_values(MeshField& field, const EdgeOrder& order);

/// Reorders all fields at edges from the order of a file to that of the mesh.
/// \param pairs the sites of the file's edges; -1 for a missing one.
/// \param changes receives a line that names the fields whose signs change.
/// \param ignored receives the names of the fields, which are removed, if the edges of the file are
///        not those of the mesh.
void reorder_edge_fields(const Triangles& triangles, const Pairs& pairs,
                         std::vector<MeshField>& fields, std::vector<std::string>& changes,
                         std::vector<std::string>& ignored);

} // namespace calotte::io_detail
