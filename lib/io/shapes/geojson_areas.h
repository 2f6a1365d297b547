// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/written_rings.h"
#include "io/shapes/geojson_polygons.h"
#include "io/shapes/room.h"

#include <optional>
#include <string>
#include <vector>

/// Polygons of GeoJSON on the sphere.
namespace calotte::io_detail {

/// \param what names the position: "position 3 of ring 0".
/// \throws Error parse, for a position that is no longitude and latitude in degrees.
void require_degrees(const GeoPosition& position, const std::string& name, const std::string& what);

/// The place that the feature of a geometry names as its property "inside", or none.
/// \throws Error parse.
std::optional<GeoPosition> inside_of(const GeoGeometry& geometry, const std::string& name);

/// The area of one geometry, to the left of its rings. A ring without area may have fewer than
/// three corners.
struct GeoArea {
  std::string where; ///< as in GeoGeometry
  std::vector<WrittenRing> rings;
};

/// An outer ring encloses its polygon, and a hole what is left out of it (see enclose_left()),
/// unless the feature names a place inside: then its rings, joined, are those around this place.
/// \throws Error parse, naming the feature and its ring; of a place inside, as region_around().
GeoArea area_of(const GeoGeometry& geometry, const std::string& name);

/// The areas of all geometries of a file. \throws Error as area_of().
std::vector<GeoArea> read_areas(std::istream& in, const std::string& name);

} // namespace calotte::io_detail
