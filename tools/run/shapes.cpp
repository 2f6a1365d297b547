// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/shapes.h"

#include "text/text.h"

#include <calotte/check.h>

#include <nlohmann/json.hpp>

#include <iomanip>
#include <sstream>

namespace calotte::tools {

std::string shape_rows(const PolygonShapes& found, const std::optional<Mesh>& mesh, int width) {
  std::ostringstream out;
  const auto row = [&](const char* name) -> std::ostream& {
    return out << std::left << std::setw(width) << name;
  };
  if (found.without_area > 0)
    row("without area") << found.without_area << "; the first is cell " << found.first_without_area
                        << "\n";
  row("not convex") << found.not_convex;
  if (found.not_convex > 0)
    out << "; the first is cell " << found.first_not_convex;
  out << "\n";
  if (found.worst_centred >= 0) {
    row("not centroidal") << found.not_centroidal;
    if (found.not_centroidal > 0)
      out << "; the farthest centre is " << std::setprecision(6) << found.off_centring
          << " widths from the centroid, of cell " << found.worst_centred;
    out << "\n";
  }
  if (mesh)
    row("not Delaunay") << count_edges(*mesh).not_delaunay << " edges\n";
  return out.str();
}

void add_shapes(const PolygonShapes& found, const std::optional<Mesh>& mesh,
                nlohmann::ordered_json& report) {
  if (found.without_area > 0) {
    report["without_area"] = found.without_area;
    report["first_without_area"] = found.first_without_area;
  }
  report["not_convex"] = found.not_convex;
  if (found.not_convex > 0)
    report["first_not_convex"] = found.first_not_convex;
  if (found.worst_centred >= 0) {
    report["not_centroidal"] = found.not_centroidal;
    report["off_centring"] = {{"max", found.off_centring}, {"cell", found.worst_centred}};
  }
  if (mesh)
    report["not_delaunay"] = count_edges(*mesh).not_delaunay;
}

std::string without_area(const PolygonShapes& found) {
  if (found.without_area == 0)
    return "";
  const bool one = found.without_area == 1;
  return message("{} {} no area; {} cell {}", counted(found.without_area, "cell"),
                 one ? "has" : "have", one ? "it is" : "the first is", found.first_without_area);
}

} // namespace calotte::tools
