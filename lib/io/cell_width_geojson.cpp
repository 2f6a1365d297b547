// SPDX-License-Identifier: GPL-3.0-or-later
#include "../cell_width_polygons.h"
#include "cell_width_file.h"
#include "file.h"

#include <calotte/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <istream>
#include <set>

namespace calotte::detail {
namespace {

using Json = nlohmann::json;

constexpr int deepest = 8; ///< geometry collections within each other

/// One file's polygons with their widths.
class Collector {
public:
  Collector(std::string name, const PolygonWidths& widths)
      : name_(std::move(name)), widths_(widths) {}

  CellWidth read(const Json& root) {
    if (!root.is_object())
      fail("no GeoJSON object; give features or a geometry");
    outer_width(root, "insideWidth", widths_.inside, false);
    outer_width(root, "outsideWidth", widths_.outside, true);
    outer_width(root, "transition", widths_.transition, true);
    if (type_of(root) == "FeatureCollection")
      for (const Json& each : array(root, "features")) {
        where_ = "feature " + std::to_string(feature_++);
        feature(each);
      }
    else if (type_of(root) == "Feature")
      feature(root);
    else
      geometry(root, width_inside(Json()), 0);
    where_.clear();
    if (regions_.empty())
      fail("no polygons; give Polygon or MultiPolygon geometries");
    require_narrower();
    try {
      return cell_width_of(regions_, widths_);
    } catch (const Error& error) {
      throw Error(error.code(), name_ + ": " + error.what());
    }
  }

private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::parse, name_ + ": " + (where_.empty() ? "" : where_ + ": ") + problem);
  }

  static std::string type_of(const Json& object) {
    const auto type = object.find("type");
    return type != object.end() && type->is_string() ? type->get<std::string>() : "";
  }

  const Json& array(const Json& object, const char* key) const {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array())
      fail(std::string("no array \"") + key + "\"; give GeoJSON as RFC 7946 has it");
    return *found;
  }

  double positive(const Json& value, const std::string& what) const {
    if (!value.is_number() || !(value.get<double>() > 0) || !std::isfinite(value.get<double>()))
      fail(what + " is no positive number; give km");
    return value.get<double>();
  }

  /// What the caller gave, or the file's member of that name.
  void outer_width(const Json& root, const std::string& key, double& width, bool needed) const {
    const auto given = root.find(key);
    if (width == 0 && given != root.end())
      width = positive(*given, "\"" + key + "\"");
    if (!std::isfinite(width) || width < 0 || (needed && width == 0))
      throw Error(ErrorCode::bad_option,
                  name_ + ": no positive " +
                      (key == "transition" ? "width of the transition"
                                           : key.substr(0, key.size() - 5) + " width") +
                      "; give it in km as an option or as the file's \"" + key + "\"");
  }

  double width_inside(const Json& properties) const {
    if (properties.is_object())
      if (const auto own = properties.find("cellWidth"); own != properties.end())
        return positive(*own, "its property \"cellWidth\"");
    if (widths_.inside == 0)
      fail("no inside width; give it in km as an option or as a property \"cellWidth\"");
    return widths_.inside;
  }

  void feature(const Json& object) {
    if (!object.is_object() || type_of(object) != "Feature")
      fail("no object of the type \"Feature\"; give GeoJSON as RFC 7946 has it");
    const auto shape = object.find("geometry");
    if (shape == object.end() || shape->is_null())
      return;
    geometry(*shape, width_inside(object.value("properties", Json())), 0);
  }

  void geometry(const Json& object, double width, int depth) {
    const std::string type = object.is_object() ? type_of(object) : "";
    if (type == "GeometryCollection" && depth < deepest) {
      for (const Json& part : array(object, "geometries"))
        geometry(part, width, depth + 1);
      return;
    }
    if (type != "Polygon" && type != "MultiPolygon")
      fail("a geometry of the type \"" + type.substr(0, 40) +
           "\" has no inside; give Polygon or MultiPolygon");
    WidthRegion region{width, {}};
    const Json& coordinates = array(object, "coordinates");
    if (type == "Polygon")
      region.polygons.push_back(polygon(coordinates));
    else
      for (const Json& part : coordinates)
        region.polygons.push_back(polygon(part));
    regions_.push_back(std::move(region));
  }

  Polygon polygon(const Json& rings) const {
    if (!rings.is_array() || rings.empty())
      fail("a polygon without rings; give its outer one");
    Polygon polygon;
    for (const Json& each : rings)
      polygon.push_back(ring(each));
    return polygon;
  }

  Ring ring(const Json& positions) const {
    if (!positions.is_array())
      fail("a ring that is no array of positions");
    Ring ring;
    for (const Json& position : positions)
      ring.push_back(place(position, ring.size()));
    if (ring.size() > 1 && ring.front().longitude == ring.back().longitude &&
        ring.front().latitude == ring.back().latitude)
      ring.pop_back();
    if (ring.size() < 3)
      fail("a ring of fewer than 3 places; leave it out");
    return ring;
  }

  Place place(const Json& position, std::size_t index) const {
    if (!position.is_array() || position.size() < 2 || !position[0].is_number() ||
        !position[1].is_number())
      fail("position " + std::to_string(index) +
           " of a ring is no [longitude, latitude]; give degrees");
    const Place place{position[0].get<double>(), position[1].get<double>()};
    if (!(std::abs(place.longitude) <= 720) || !(std::abs(place.latitude) <= 90))
      fail("position " + std::to_string(index) + " of a ring is [" + position[0].dump() + ", " +
           position[1].dump() + "], no longitude and latitude in degrees; correct it");
    return place;
  }

  /// Of several widths the least holds: one wider than the outside would never be seen.
  void require_narrower() const {
    std::set<double> inside;
    for (const WidthRegion& region : regions_)
      inside.insert(region.inside);
    if (inside.size() > 1 && *inside.rbegin() > widths_.outside)
      fail("of several inside widths the widest, " + Json(*inside.rbegin()).dump() +
           " km, is wider than the outside; as the least one holds it would not be seen");
  }

  std::string name_, where_;
  PolygonWidths widths_;
  std::vector<WidthRegion> regions_;
  int feature_ = 0;
};

} // namespace

CellWidth read_cell_width_geojson(std::istream& in, const std::string& name,
                                  const PolygonWidths& widths) {
  if (!(widths.radius > 0) || !std::isfinite(widths.radius))
    throw Error(ErrorCode::bad_option, "the sphere's radius must be positive; give it in km");
  const std::string text = read_all(in, name);
  Json root;
  try {
    root = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw Error(ErrorCode::parse, name + ": no JSON from byte " + std::to_string(error.byte) +
                                      " on; the file was cut short or damaged");
  }
  return Collector(name, widths).read(root);
}

} // namespace calotte::detail
