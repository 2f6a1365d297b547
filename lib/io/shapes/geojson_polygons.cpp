// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/geojson_polygons.h"

#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/bytes/text.h"

namespace calotte::io_detail {
namespace {

/// Reads the polygons of one geometry.
class PolygonReader {
public:
  PolygonReader(const std::string& name, const GeoPair& pair, const std::string& where)
      : name_(name), pair_(pair), where_(where) {}

  std::vector<GeoPolygon> read(const std::string& type, const Json& coordinates) {
    if (!is_polygon(type))
      fail(message("a geometry of the type {} has no inside; give Polygon or MultiPolygon",
                   in_quotes(type)));
    if (type == "Polygon")
      return {polygon(coordinates)};
    std::vector<GeoPolygon> polygons;
    for (const Json& part : coordinates)
      polygons.push_back(polygon(part));
    return polygons;
  }

private:
  [[noreturn]] void fail(const std::string& problem) const { fail_file(name_, where_ + problem); }

  GeoPolygon polygon(const Json& rings) {
    if (!rings.is_array() || rings.empty())
      fail("a polygon without rings; give its outer one");
    GeoPolygon polygon;
    for (const Json& each : rings) {
      polygon.push_back(ring(each));
      ++rings_;
    }
    return polygon;
  }

  GeoRing ring(const Json& positions) const {
    if (!positions.is_array())
      fail(
          message("ring {} is not an array of positions; give GeoJSON as RFC 7946 has it", rings_));
    GeoRing ring;
    for (const Json& position : positions)
      ring.push_back(read_position(position, ring.size()));
    if (ring.size() > 1 && ring.front() == ring.back())
      ring.pop_back();
    if (ring.size() < 3)
      fail(message("ring {} has fewer than 3 places; leave it out", rings_));
    return ring;
  }

  GeoPosition read_position(const Json& position, std::size_t index) const {
    if (!is_position(position))
      fail(message("position {} of ring {} is not a position {}; {}", index, rings_, pair_.form,
                   pair_.remedy));
    return position_of(position);
  }

  const std::string& name_;
  const GeoPair& pair_;
  const std::string& where_;
  std::int64_t rings_ = 0; ///< number of rings that are complete
};

} // namespace

bool is_polygon(const std::string& type) { return type == "Polygon" || type == "MultiPolygon"; }

GeoGeometry read_geometry(const GeoFeature& feature, const std::string& type,
                          const Json& coordinates, const std::string& name, const GeoPair& pair) {
  return {feature.where, feature.properties,
          PolygonReader(name, pair, feature.where).read(type, coordinates)};
}

GeoPolygons read_polygons(std::istream& in, const std::string& name, const GeoPair& pair) {
  GeoPolygons all;
  all.members = read_geometries(
      in, name, pair,
      [&](const GeoFeature& feature, const std::string& type, const Json& coordinates) {
        all.geometries.push_back(read_geometry(feature, type, coordinates, name, pair));
      });
  if (all.geometries.empty())
    fail_file(name, "no polygons; give Polygon or MultiPolygon geometries");
  return all;
}

} // namespace calotte::io_detail
