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

/// The point that the property "inside" of a geometry's feature names; none without it.
/// \throws Error parse.
std::optional<GeoPosition> read_inside(const GeoGeometry& geometry, const std::string& name);

/// The area of one geometry, to the left of its rings. A ring without area may have fewer than
/// three corners.
struct GeoArea {
  std::string where; ///< as in GeoGeometry
  std::vector<WrittenRing> rings;
};

/// An outer ring encloses its polygon, and a hole what is left out of it (see enclose_left()). If
/// the feature names a point inside, its rings are joined, and the area is the one around this
/// point.
/// \throws Error parse, with the feature and its ring; for a point inside, as region_around().
GeoArea make_area(const GeoGeometry& geometry, const std::string& name);

/// The areas of all geometries of a file. \throws Error as make_area().
std::vector<GeoArea> read_areas(std::istream& in, const std::string& name);

} // namespace calotte::io_detail
