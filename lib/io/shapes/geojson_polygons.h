// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/geojson.h"
#include "io/shapes/room.h"

#include <iosfwd>
#include <string>
#include <vector>

/// Polygons of GeoJSON (RFC 7946) for any use.
namespace calotte::io_detail {

using GeoRing = std::vector<GeoPosition>; ///< its first position is not repeated at the end
using GeoPolygon = std::vector<GeoRing>;  ///< the outer ring first, then holes

/// One geometry of the type Polygon or MultiPolygon.
struct GeoGeometry {
  std::string where;         ///< "feature 3: " or nothing, for messages
  nlohmann::json properties; ///< properties of its feature, or null
  std::vector<GeoPolygon> polygons;
};

/// The contents of a file of polygons.
struct GeoPolygons {
  std::vector<GeoGeometry> geometries;
  nlohmann::json members; ///< members of the file's object, without its features
};

/// Whether geometries of a type have an area: Polygon or MultiPolygon.
bool is_polygon(const std::string& type);

/// Reads the polygons of one geometry of a feature.
/// \throws Error parse as read_polygons(); for another type.
GeoGeometry read_geometry(const GeoFeature& feature, const std::string& type,
                          const nlohmann::json& coordinates, const std::string& name,
                          const GeoPair& pair);

/// Reads all polygons of a file. Coordinates must be numbers, of any value; rings have at least
/// three positions.
/// \throws Error parse, "NAME: WHERE..." with the remedy; also if there is no polygon; file.
GeoPolygons read_polygons(std::istream& in, const std::string& name, const GeoPair& pair);

} // namespace calotte::io_detail
