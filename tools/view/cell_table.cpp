// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/text.h"
#include "view/view_mesh.h"

#include <calotte/generators.h>

#include <iomanip>
#include <sstream>

namespace calotte::tools {

std::string cell_table(const ViewMesh& mesh, std::int64_t cell) {
  if (cell >= mesh.cells)
    refuse(message("--cell {}: the mesh has the cells 0 to {}", cell, mesh.cells - 1));
  std::ostringstream out;
  const auto row = [&out](const std::string& name, const std::string& value) {
    out << std::left << std::setw(28) << name << value << "\n";
  };
  row("cell", std::to_string(cell));
  const Eigen::Vector3d point = mesh.points.col(cell);
  if (mesh.on_sphere) {
    const Points2 at = to_lonlat(point);
    row("longitude", formatted("%.6g", at(0, 0)));
    row("latitude", formatted("%.6g", at(1, 0)));
  } else {
    row("x", formatted("%.6g", point.x()));
    row("y", formatted("%.6g", point.y()));
  }
  for (const Quantity& quantity : mesh.quantities)
    if (!quantity.on_triangles)
      row(quantity.label, value_text(quantity.values[cell], quantity.unit));
  return out.str();
}

} // namespace calotte::tools
