// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/text.h"
#include "view/view_mesh.h"

#include <calotte/generators.h>

#include <nlohmann/json.hpp>

#include <array>

namespace calotte::tools {

namespace {

/// A coordinate of a cell.
struct Coordinate {
  const char* name;
  double value;
};

/// Longitude and latitude in degrees, or x and y.
std::array<Coordinate, 2> location_of(const ViewMesh& mesh, std::int64_t cell) {
  if (cell >= mesh.cells)
    refuse(message("--cell {}: the mesh has the cells 0 to {}", cell, mesh.cells - 1));
  const Eigen::Vector3d point = mesh.points.col(cell);
  if (!mesh.on_sphere)
    return {{{"x", point.x()}, {"y", point.y()}}};
  const Points2 at = to_lonlat(point);
  return {{{"longitude", at(0, 0)}, {"latitude", at(1, 0)}}};
}

} // namespace

std::string cell_table(const ViewMesh& mesh, std::int64_t cell) {
  std::string lines;
  const auto add = [&lines](const std::string& name, const std::string& value) {
    lines += row(name, 28, value);
  };
  add("cell", message("{}", cell));
  for (const Coordinate& coordinate : location_of(mesh, cell))
    add(coordinate.name, formatted("%.6g", coordinate.value));
  for (const Quantity& quantity : mesh.quantities)
    if (!quantity.on_triangles)
      add(quantity.label, value_text(quantity.values[cell], quantity.unit));
  return lines;
}

std::string cell_report(const ViewMesh& mesh, std::int64_t cell) {
  nlohmann::ordered_json json;
  json["cell"] = cell;
  for (const Coordinate& coordinate : location_of(mesh, cell))
    json[coordinate.name] = coordinate.value;
  nlohmann::ordered_json& quantities = json["quantities"] = nlohmann::ordered_json::object();
  for (const Quantity& quantity : mesh.quantities) {
    if (quantity.on_triangles)
      continue;
    nlohmann::ordered_json& numbers = quantities[quantity.name];
    numbers["value"] = quantity.values[cell]; // null for NaN
    numbers["unit"] = quantity.unit;
  }
  return json.dump(2) + "\n";
}

} // namespace calotte::tools
