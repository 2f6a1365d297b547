// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh_file.h>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

/// How cells that are not Voronoi cells differ from those of a CVT, for info and check.
namespace calotte::tools {

/// Rows of a table, whose names have so many characters.
/// \param mesh of the cells' centres, if there is one.
std::string shape_rows(const PolygonShapes& found, const std::optional<Mesh>& mesh, int width);

/// The same numbers for a report.
void add_shapes(const PolygonShapes& found, const std::optional<Mesh>& mesh,
                nlohmann::ordered_json& report);

/// What is wrong with a grid that has cells without area; empty if it has none.
std::string without_area(const PolygonShapes& found);

} // namespace calotte::tools
