// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/geojson_areas.h"

#include "base/lonlat.h"
#include "base/message.h"
#include "io/bytes/file_error.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace calotte::io_detail {
namespace {

WrittenRing make_ring(const GeoRing& positions, const std::string& name, const std::string& where,
                      std::size_t number) {
  WrittenRing ring{{}, message("{}ring {}", where, number)};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    require_degrees(positions[i], name, message("{}position {} of ring {}", where, i, number));
    ring.corners.push_back(from_lonlat(positions[i][0], positions[i][1]));
  }
  drop_repeated(ring.corners);
  return ring;
}

} // namespace

GeoArea make_area(const GeoGeometry& geometry, const std::string& name) {
  GeoArea area{geometry.where, {}};
  const std::optional<GeoPosition> inside = read_inside(geometry, name);
  for (const GeoPolygon& polygon : geometry.polygons)
    for (std::size_t r = 0; r < polygon.size(); ++r) {
      area.rings.push_back(make_ring(polygon[r], name, geometry.where, area.rings.size()));
      if (!inside && area.rings.back().corners.size() > 2)
        enclose(area.rings.back(), r > 0);
    }
  if (!inside)
    return area;
  return named(name, [&] {
    area.rings = around(std::move(area.rings), from_lonlat((*inside)[0], (*inside)[1]));
    return area;
  });
}

void require_degrees(const GeoPosition& position, const std::string& name,
                     const std::string& what) {
  if (!are_degrees(position))
    fail_file(name, "{} is [{}, {}], no longitude and latitude in degrees; give longitude first",
              what, Json(position[0]).dump(), Json(position[1]).dump());
}

std::optional<GeoPosition> read_inside(const GeoGeometry& geometry, const std::string& name) {
  if (!geometry.properties.is_object() || !geometry.properties.contains("inside"))
    return std::nullopt;
  const Json& given = geometry.properties["inside"];
  const std::string what = geometry.where + "its property \"inside\"";
  if (!is_position(given))
    fail_file(name, "{} is not a position [longitude, latitude]; give degrees", what);
  const GeoPosition position = position_of(given);
  require_degrees(position, name, what);
  return position;
}

std::vector<GeoArea> read_areas(std::istream& in, const std::string& name) {
  std::vector<GeoArea> areas;
  const GeoPolygons polygons = read_polygons(in, name, lonlat_pair);
  for (const GeoGeometry& geometry : polygons.geometries)
    areas.push_back(make_area(geometry, name));
  return areas;
}

} // namespace calotte::io_detail
