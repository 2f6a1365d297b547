// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/geojson_polygons.h"

#include "io/bytes/text.h"

#include <calotte/error.h>

namespace calotte::io_detail {
namespace {

using Json = nlohmann::json;

class Collector {
public:
  Collector(const std::string& name, const GeoPair& pair) : name_(name), pair_(pair) {}

  GeoPolygons read(std::istream& in) {
    Json members = read_features(in, name_, [&](const GeoFeature& feature) {
      where_ = feature.where;
      for_each_geometry(feature, name_, [&](const std::string& type, const Json& coordinates) {
        geometry(feature, type, coordinates);
      });
    });
    where_.clear();
    if (geometries_.empty())
      fail("no polygons; give Polygon or MultiPolygon geometries");
    return {std::move(geometries_), std::move(members)};
  }

private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::parse, name_ + ": " + where_ + problem);
  }

  void geometry(const GeoFeature& feature, const std::string& type, const Json& coordinates) {
    if (type != "Polygon" && type != "MultiPolygon")
      fail("a geometry of the type " + in_quotes(type) +
           " has no inside; give Polygon or MultiPolygon");
    GeoGeometry geometry{where_, feature.properties, {}};
    rings_ = 0;
    if (type == "Polygon")
      geometry.polygons.push_back(polygon(coordinates));
    else
      for (const Json& part : coordinates)
        geometry.polygons.push_back(polygon(part));
    geometries_.push_back(std::move(geometry));
  }

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

  std::string ring_name() const { return "ring " + std::to_string(rings_); }

  GeoRing ring(const Json& positions) const {
    if (!positions.is_array())
      fail(ring_name() + " is not an array of positions; give GeoJSON as RFC 7946 has it");
    GeoRing ring;
    for (const Json& position : positions)
      ring.push_back(place(position, ring.size()));
    if (ring.size() > 1 && ring.front() == ring.back())
      ring.pop_back();
    if (ring.size() < 3)
      fail(ring_name() + " has fewer than 3 places; leave it out");
    return ring;
  }

  GeoPosition place(const Json& position, std::size_t index) const {
    if (!is_position(position))
      fail("position " + std::to_string(index) + " of " + ring_name() + " is not a position " +
           pair_.form + "; " + pair_.remedy);
    return position_of(position);
  }

  const std::string& name_;
  const GeoPair& pair_;
  std::string where_;
  std::int64_t rings_ = 0; ///< of the geometry, before the one being read
  std::vector<GeoGeometry> geometries_;
};

} // namespace

GeoPolygons read_polygons(std::istream& in, const std::string& name, const GeoPair& pair) {
  return Collector(name, pair).read(in);
}

} // namespace calotte::io_detail
