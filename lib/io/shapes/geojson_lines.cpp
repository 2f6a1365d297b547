// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/read.h>

#include "base/lonlat.h"
#include "io/bytes/file.h"
#include "io/shapes/geojson_polygons.h"

#include <calotte/error.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using Json = nlohmann::json;

std::string type_of(const Json& object) {
  const bool known = object.is_object() && object.contains("type") && object["type"].is_string();
  return known ? object["type"].get<std::string>() : "";
}

class LineCollector {
public:
  explicit LineCollector(const std::string& name) : name_(name) {}

  std::vector<Points3> read(const Json& root) {
    if (type_of(root) == "FeatureCollection")
      for (const Json& feature : array(root, "features")) {
        where_ = "feature " + std::to_string(features_++) + ": ";
        object(feature);
      }
    else
      object(root);
    where_.clear();
    if (lines_.empty())
      fail("no lines; give LineString or MultiLineString geometries");
    return std::move(lines_);
  }

private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::parse, name_ + ": " + where_ + problem);
  }

  const Json& array(const Json& of, const char* key) const {
    const auto found = of.is_object() ? of.find(key) : of.end();
    if (!of.is_object() || found == of.end() || !found->is_array())
      fail(std::string("no array \"") + key + "\"; give GeoJSON as RFC 7946 has it");
    return *found;
  }

  /// A feature or a geometry.
  void object(const Json& of) {
    const std::string type = type_of(of);
    if (type == "Feature" && of.contains("geometry"))
      object(of["geometry"]);
    else if (type == "GeometryCollection")
      for (const Json& part : array(of, "geometries"))
        object(part);
    else if (type == "LineString")
      lines_.push_back(line(array(of, "coordinates")));
    else if (type == "MultiLineString")
      for (const Json& part : array(of, "coordinates"))
        lines_.push_back(line(part));
    else
      fail("an object of the type \"" + type + "\" is no line; give LineString or MultiLineString");
  }

  Points3 line(const Json& positions) const {
    if (!positions.is_array() || positions.empty())
      fail("a line without places; leave it out");
    Points3 places(3, std::ssize(positions));
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const Vec3 place = place_of(positions[k]);
      places.col(static_cast<Eigen::Index>(k)) << place.x, place.y, place.z;
    }
    return places;
  }

  Vec3 place_of(const Json& position) const {
    if (!position.is_array() || position.size() < 2 || !position[0].is_number() ||
        !position[1].is_number() || !(std::abs(position[0].get<double>()) <= 720) ||
        !(std::abs(position[1].get<double>()) <= 90))
      fail(position.dump() + " is no position [longitude, latitude]; give degrees");
    return from_lonlat(position[0].get<double>(), position[1].get<double>());
  }

  const std::string& name_;
  std::string where_;
  std::int64_t features_ = 0;
  std::vector<Points3> lines_;
};

} // namespace
} // namespace io_detail

std::vector<Points3> read_lines(const std::string& path) {
  std::ifstream in = io_detail::open_input(path);
  return io_detail::LineCollector(path).read(io_detail::read_geojson(in, path));
}

} // namespace calotte
