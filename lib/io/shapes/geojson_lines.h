// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/geojson.h"
#include "io/shapes/room.h"

#include <calotte/types.h>

#include <string>
#include <vector>

/// Lines of GeoJSON.
namespace calotte::io_detail {

/// Adds the lines of one geometry of a feature, unit columns; in a plane x y 0.
/// \throws Error parse, naming the feature; for a type other than LineString and MultiLineString.
void add_lines(const GeoFeature& feature, const std::string& type,
               const nlohmann::json& coordinates, const std::string& name,
               std::vector<Points3>& lines, bool plane = false);

} // namespace calotte::io_detail
