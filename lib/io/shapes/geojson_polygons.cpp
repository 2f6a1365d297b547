// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/geojson_polygons.h"

#include "io/bytes/json_stream.h"
#include "io/bytes/text.h"

#include <calotte/error.h>

namespace calotte::io_detail {
namespace {

using Json = nlohmann::json;

constexpr int deepest = 8; ///< geometry collections within each other

std::string type_of(const Json& object) {
  const auto type = object.find("type");
  return type != object.end() && type->is_string() ? type->get<std::string>() : "";
}

class Collector {
public:
  Collector(const std::string& name, const GeoPair& pair) : name_(name), pair_(pair) {}

  std::vector<GeoGeometry> collect(const Json& root) {
    if (type_of(root) == "FeatureCollection") {
      int count = 0;
      for (const Json& each : array(root, "features")) {
        where_ = "feature " + std::to_string(count++) + ": ";
        feature(each);
      }
    } else if (type_of(root) == "Feature") {
      feature(root);
    } else {
      geometry(root, 0);
    }
    where_.clear();
    if (geometries_.empty())
      fail("no polygons; give Polygon or MultiPolygon geometries");
    return std::move(geometries_);
  }

private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::parse, name_ + ": " + where_ + problem);
  }

  const Json& array(const Json& object, const char* key) const {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array())
      fail(std::string("no array \"") + key + "\"; give GeoJSON as RFC 7946 has it");
    return *found;
  }

  void feature(const Json& object) {
    if (!object.is_object() || type_of(object) != "Feature")
      fail("no object of the type \"Feature\"; give GeoJSON as RFC 7946 has it");
    const auto shape = object.find("geometry");
    if (shape == object.end() || shape->is_null())
      return;
    properties_ = object.value("properties", Json());
    geometry(*shape, 0);
  }

  void geometry(const Json& object, int depth) {
    const std::string type = object.is_object() ? type_of(object) : "";
    if (type == "GeometryCollection" && depth < deepest) {
      for (const Json& part : array(object, "geometries"))
        geometry(part, depth + 1);
      return;
    }
    if (type != "Polygon" && type != "MultiPolygon")
      fail("a geometry of the type " + in_quotes(type) +
           " has no inside; give Polygon or MultiPolygon");
    GeoGeometry geometry{where_, properties_, {}};
    const Json& coordinates = array(object, "coordinates");
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
    if (!position.is_array() || position.size() < 2 || !position[0].is_number() ||
        !position[1].is_number())
      fail("position " + std::to_string(index) + " of " + ring_name() + " is not a position " +
           pair_.form + "; " + pair_.remedy);
    return {position[0].get<double>(), position[1].get<double>()};
  }

  const std::string& name_;
  const GeoPair& pair_;
  std::string where_;
  Json properties_;
  std::int64_t rings_ = 0; ///< of the geometry, before the one being read
  std::vector<GeoGeometry> geometries_;
};

} // namespace

Json read_geojson(std::istream& in, const std::string& name) {
  JsonBuffer buffer(in, name);
  std::istream checked(&buffer);
  Json root;
  try {
    root = Json::parse(checked);
  } catch (const Json::parse_error& error) {
    throw Error(ErrorCode::parse, name + ": no JSON from byte " + std::to_string(error.byte) +
                                      " on; the file was cut short or damaged");
  } catch (const Json::out_of_range&) {
    throw Error(ErrorCode::parse, name + ": a number that no double can hold; correct it");
  }
  if (!root.is_object())
    throw Error(ErrorCode::parse, name + ": no GeoJSON object; give features or a geometry");
  return root;
}

std::vector<GeoGeometry> geojson_polygons(const Json& root, const std::string& name,
                                          const GeoPair& pair) {
  return Collector(name, pair).collect(root);
}

} // namespace calotte::io_detail
