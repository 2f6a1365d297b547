// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <nlohmann/json.hpp>

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

/// Polygons of GeoJSON (RFC 7946), for whatever they stand for.
namespace calotte::io_detail {

using GeoPosition = std::array<double, 2>;
using GeoRing = std::vector<GeoPosition>; ///< its first position is not repeated at the end
using GeoPolygon = std::vector<GeoRing>;  ///< the outer ring first, then holes

/// One geometry of the type Polygon or MultiPolygon.
struct GeoGeometry {
  std::string where;         ///< "feature 3: " or nothing, for messages
  nlohmann::json properties; ///< of its feature, or null
  std::vector<GeoPolygon> polygons;
};

/// What a pair of coordinates is, for messages.
struct GeoPair {
  std::string form;   ///< "[longitude, latitude]"
  std::string remedy; ///< "give degrees"
};

/// The file's root. \throws Error parse where it is no JSON, or no object; file.
nlohmann::json read_geojson(std::istream& in, const std::string& name);

/// All polygons of a geometry, a feature, or a collection of either. Places are not looked at but
/// for being numbers; rings have three of them at least.
/// \throws Error parse, "NAME: WHERE..." with the remedy; where there is no polygon, too.
std::vector<GeoGeometry> geojson_polygons(const nlohmann::json& root, const std::string& name,
                                          const GeoPair& pair);

} // namespace calotte::io_detail
