// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "io/bytes/broken.h"
#include "io/cells/id_table.h"
#include "io/check/grid_check.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

// Lists of edges and neighbours that UGRID makes optional. Their order is free.

namespace calotte::io_detail {
namespace {

/// A table of ids of the file.
struct Connectivity : IdTable {
  std::string name;
};

/// Reads the table that an attribute of the mesh variable names; none without one, or with another
/// shape. Transposed tables, which UGRID allows, are not read.
Connectivity read_connectivity(const std::string& mesh, const std::string& attribute,
                               std::int64_t rows, std::int64_t bound, Deviations& deviations) {
  const NetcdfReader& file = deviations.file();
  Connectivity table{{}, file.text(mesh, attribute)};
  if (table.name.empty() || !file.has_variable(table.name))
    return table; // reported with the attributes
  const std::vector<std::int64_t> shape = file.shape_of(table.name);
  const bool transposed = shape.size() == 2 && (rows >= 0 ? shape[0] != rows && shape[1] == rows
                                                          : shape[0] == 2 && shape[1] != 2);
  if (transposed || !deviations.has(table.name, {rows, -1}))
    return table;
  table.width = deviations.width(table.name);
  const std::vector<double> values = file.doubles(table.name, {rows, -1});
  const double start = file.number(table.name, "start_index", 0);
  const double fill = file.number(table.name, "_FillValue", -1);
  Differences outside;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double id = values[k] - start;
    const bool inside = id >= 0 && id < static_cast<double>(bound);
    table.ids.push_back(inside ? static_cast<std::int32_t>(id) : -1);
    if (!inside && values[k] != fill)
      outside.note(static_cast<std::int64_t>(k), values[k], fill, 1);
  }
  deviations.add(table.name, outside, "ids in range, or _FillValue");
  return table;
}

/// Adds a deviation for the first row of a table that breaks its rule. \returns whether no row
/// does.
/// \param holds(row) runs in parallel.
template <class Holds>
bool check_rows(const Connectivity& table, const std::string& problem, const Holds& holds,
                Deviations& deviations) {
  const Broken found =
      broken(table.rows(), [&](std::int64_t row) { return verdict_of(holds(row)); });
  if (found.any())
    deviations.add(table.name, message("{}: row {} (0-based) {}", table.name, found.first, problem),
                   found.first);
  return !found.any();
}

/// The ids of a row, sorted, without missing ones.
std::vector<std::int32_t> sorted_ids(const Connectivity& table, std::int64_t row) {
  std::vector<std::int32_t> ids;
  for (std::int64_t k = 0; k < table.width; ++k)
    if (table.at(row, k) >= 0)
      ids.push_back(table.at(row, k));
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The faces to the left and to the right of an edge; -1 for none.
std::pair<std::int32_t, std::int32_t> find_faces(const Connectivity& edges, const Sides& sides,
                                                 std::int64_t edge) {
  const std::int32_t from = edges.at(edge, 0), to = edges.at(edge, 1);
  return from < 0 || to < 0 ? std::pair(-1, -1)
                            : std::pair(sides.polygon_of(from, to), sides.polygon_of(to, from));
}

/// Checks that each edge is a side of faces and that edges differ.
bool check_edge_nodes(const Connectivity& table, const Sides& sides, Deviations& deviations) {
  const auto is_side = [&](std::int64_t row) {
    const auto [left, right] = find_faces(table, sides, row);
    return left >= 0 || right >= 0;
  };
  if (!check_rows(table, "is no side of a face", is_side, deviations))
    return false;
  std::vector<std::pair<std::int32_t, std::int32_t>> sorted;
  for (std::int64_t row = 0; row < table.rows(); ++row)
    sorted.push_back(std::minmax({table.at(row, 0), table.at(row, 1)}));
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end())
    return true;
  deviations.add(table.name, message("{}: two rows are the same edge", table.name));
  return false;
}

/// Checks that each face has as many different edges as corners, all of them sides of it.
void check_face_edges(const Connectivity& table, const Connectivity& edges,
                      const Polygons& polygons, const Sides& sides, Deviations& deviations) {
  const auto holds = [&](std::int64_t face) {
    const std::vector<std::int32_t> ids = sorted_ids(table, face);
    return std::ssize(ids) == polygons.ids.count(face) &&
           std::adjacent_find(ids.begin(), ids.end()) == ids.end() &&
           std::ranges::all_of(ids, [&](std::int32_t e) {
             const auto [left, right] = find_faces(edges, sides, e);
             return left == face || right == face;
           });
  };
  check_rows(table, "does not hold the sides of its face", holds, deviations);
}

void check_face_faces(const Connectivity& table, const Polygons& polygons, const Sides& sides,
                      Deviations& deviations) {
  const auto holds = [&](std::int64_t face) {
    std::vector<std::int32_t> derived;
    const std::span<const std::int32_t> ids = polygons.ids[face];
    for (std::size_t k = 0; k < ids.size(); ++k)
      if (const std::int32_t other =
              sides.polygon_of(k + 1 < ids.size() ? ids[k + 1] : ids[0], ids[k]);
          other >= 0)
        derived.push_back(other);
    std::sort(derived.begin(), derived.end());
    return sorted_ids(table, face) == derived;
  };
  check_rows(table, "does not hold the faces across the sides of its face", holds, deviations);
}

void check_edge_faces(const Connectivity& table, const Connectivity& edges, const Sides& sides,
                      Deviations& deviations) {
  const auto holds = [&](std::int64_t row) {
    const auto [left, right] = find_faces(edges, sides, row);
    const std::int32_t a = table.at(row, 0), b = table.width > 1 ? table.at(row, 1) : -1;
    return (a == left && b == right) || (a == right && b == left);
  };
  check_rows(table, "does not hold the faces on both sides of its edge", holds, deviations);
}

} // namespace

void check_ugrid_connectivity(const Polygons& polygons, const Sides& sides, const std::string& mesh,
                              Deviations& deviations) {
  const auto read = [&](const std::string& attribute, std::int64_t rows, std::int64_t bound) {
    return read_connectivity(mesh, attribute, rows, bound, deviations);
  };
  const std::int64_t faces = polygons.size();
  check_face_faces(read("face_face_connectivity", faces, faces), polygons, sides, deviations);
  const Connectivity edges = read("edge_node_connectivity", -1, polygons.corners.cols());
  if (edges.width < 2 || edges.rows() == 0)
    return;
  if (!check_edge_nodes(edges, sides, deviations))
    return;
  check_face_edges(read("face_edge_connectivity", faces, edges.rows()), edges, polygons, sides,
                   deviations);
  check_edge_faces(read("edge_face_connectivity", edges.rows(), faces), edges, sides, deviations);
}

} // namespace calotte::io_detail
