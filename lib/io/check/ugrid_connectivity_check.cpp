// SPDX-License-Identifier: GPL-3.0-or-later
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

/// The table that an attribute of the mesh variable names; nothing without one, or of another
/// shape. Tables with a column for each face or edge, which UGRID allows, are not read.
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

/// A row of a table that breaks its rule.
void report(const Connectivity& table, std::int64_t row, const std::string& problem,
            Deviations& deviations) {
  deviations.add(table.name, table.name + ": row " + std::to_string(row) + " (0-based) " + problem,
                 row);
}

struct EdgeNodes {
  std::int32_t from, to;
};

bool is_side_of(const Sides& sides, const EdgeNodes& edge, std::int32_t face) {
  return sides.polygon_of(edge.from, edge.to) == face ||
         sides.polygon_of(edge.to, edge.from) == face;
}

/// The edges, if each is a side of faces and no two are one.
std::vector<EdgeNodes> check_edge_nodes(const Connectivity& table, const Sides& sides,
                                        Deviations& deviations) {
  std::vector<EdgeNodes> edges;
  for (std::int64_t row = 0; row < table.rows(); ++row) {
    const EdgeNodes edge{table.at(row, 0), table.at(row, 1)};
    if (edge.from < 0 || edge.to < 0 ||
        (sides.polygon_of(edge.from, edge.to) < 0 && sides.polygon_of(edge.to, edge.from) < 0)) {
      report(table, row, "is no side of a face", deviations);
      return {};
    }
    edges.push_back(edge);
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> sorted;
  for (const EdgeNodes& edge : edges)
    sorted.push_back(std::minmax(edge.from, edge.to));
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end())
    return edges;
  deviations.add(table.name, table.name + ": two rows are the same edge");
  return {};
}

/// Each face has as many different edges as corners, all of them sides of it.
void check_face_edges(const Connectivity& table, const std::vector<EdgeNodes>& edges,
                      const Polygons& polygons, const Sides& sides, Deviations& deviations) {
  for (std::int64_t row = 0; row < table.rows(); ++row) {
    std::vector<std::int32_t> ids;
    for (std::int64_t k = 0; k < table.width; ++k)
      if (table.at(row, k) >= 0)
        ids.push_back(table.at(row, k));
    std::sort(ids.begin(), ids.end());
    const bool whole = std::ssize(ids) == polygons.ids.count(row) &&
                       std::adjacent_find(ids.begin(), ids.end()) == ids.end();
    if (!whole || !std::all_of(ids.begin(), ids.end(), [&](std::int32_t e) {
          return is_side_of(sides, edges[static_cast<std::size_t>(e)],
                            static_cast<std::int32_t>(row));
        }))
      return report(table, row, "does not hold the sides of its face", deviations);
  }
}

void check_face_faces(const Connectivity& table, const Polygons& polygons, const Sides& sides,
                      Deviations& deviations) {
  for (std::int64_t row = 0; row < table.rows(); ++row) {
    std::vector<std::int32_t> stored, derived;
    for (std::int64_t k = 0; k < table.width; ++k)
      if (table.at(row, k) >= 0)
        stored.push_back(table.at(row, k));
    const std::span<const std::int32_t> ids = polygons.ids[row];
    for (std::size_t k = 0; k < ids.size(); ++k)
      if (const std::int32_t other =
              sides.polygon_of(k + 1 < ids.size() ? ids[k + 1] : ids[0], ids[k]);
          other >= 0)
        derived.push_back(other);
    std::sort(stored.begin(), stored.end());
    std::sort(derived.begin(), derived.end());
    if (stored != derived)
      return report(table, row, "does not hold the faces across the sides of its face", deviations);
  }
}

void check_edge_faces(const Connectivity& table, const std::vector<EdgeNodes>& edges,
                      const Sides& sides, Deviations& deviations) {
  for (std::int64_t row = 0; row < table.rows(); ++row) {
    const EdgeNodes& edge = edges[static_cast<std::size_t>(row)];
    const std::int32_t left = sides.polygon_of(edge.from, edge.to),
                       right = sides.polygon_of(edge.to, edge.from);
    const std::int32_t a = table.at(row, 0), b = table.width > 1 ? table.at(row, 1) : -1;
    if (std::min(a, b) != std::min(left, right) || std::max(a, b) != std::max(left, right))
      return report(table, row, "does not hold the faces on both sides of its edge", deviations);
  }
}

} // namespace

void check_ugrid_connectivity(const Polygons& polygons, const Sides& sides, const std::string& mesh,
                              Deviations& deviations) {
  const auto read = [&](const std::string& attribute, std::int64_t rows, std::int64_t bound) {
    return read_connectivity(mesh, attribute, rows, bound, deviations);
  };
  const std::int64_t faces = polygons.size();
  check_face_faces(read("face_face_connectivity", faces, faces), polygons, sides, deviations);
  const Connectivity edge_nodes = read("edge_node_connectivity", -1, polygons.corners.cols());
  if (edge_nodes.width < 2)
    return;
  const std::vector<EdgeNodes> edges = check_edge_nodes(edge_nodes, sides, deviations);
  if (edges.empty())
    return;
  check_face_edges(read("face_edge_connectivity", faces, std::ssize(edges)), edges, polygons, sides,
                   deviations);
  check_edge_faces(read("edge_face_connectivity", std::ssize(edges), faces), edges, sides,
                   deviations);
}

} // namespace calotte::io_detail
