// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/text.h"
#include "view/view_mesh.h"

#include <calotte/generators.h>

namespace calotte::tools {

std::string cell_table(const ViewMesh& mesh, std::int64_t cell) {
  if (cell >= mesh.cells)
    refuse(message("--cell {}: the mesh has the cells 0 to {}", cell, mesh.cells - 1));
  std::string lines;
  const auto add = [&lines](const std::string& name, const std::string& value) {
    lines += row(name, 28, value);
  };
  add("cell", message("{}", cell));
  const Eigen::Vector3d point = mesh.points.col(cell);
  if (mesh.on_sphere) {
    const Points2 at = to_lonlat(point);
    add("longitude", formatted("%.6g", at(0, 0)));
    add("latitude", formatted("%.6g", at(1, 0)));
  } else {
    add("x", formatted("%.6g", point.x()));
    add("y", formatted("%.6g", point.y()));
  }
  for (const Quantity& quantity : mesh.quantities)
    if (!quantity.on_triangles)
      add(quantity.label, value_text(quantity.values[cell], quantity.unit));
  return lines;
}

} // namespace calotte::tools
