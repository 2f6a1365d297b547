// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/geojson.h"

#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/bytes/json_stream.h"
#include "io/shapes/shapefile.h"

#include <cmath>
#include <istream>

namespace calotte::io_detail {
namespace {

constexpr const char* as_rfc = "; give GeoJSON as RFC 7946 has it";
constexpr int deepest = 8; ///< nesting depth of geometry collections

/// Parses a file and passes each feature to `take`. \returns its object without the features.
Json parse(std::istream& in, const std::string& name,
           const std::function<void(const Json& feature)>& take) {
  bool in_features = false;
  const auto keep = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::key && depth == 1)
      in_features = parsed == "features";
    if (event != Json::parse_event_t::object_end || depth != 2 || !in_features)
      return true;
    take(parsed);
    return false;
  };
  JsonBuffer buffer(in, name);
  std::istream checked(&buffer);
  try {
    return Json::parse(checked, keep);
  } catch (const Json::parse_error& error) {
    fail_file(name, "no JSON from byte {} on; the file was cut short or damaged", error.byte);
  } catch (const Json::exception&) {
    fail_file(name, "a number that no double can hold; correct it");
  }
}

/// \param where names the feature.
const Json& array(const Json& object, const char* key, const std::string& name,
                  const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array())
    fail_file(name, "{}no array \"{}\"{}", where, key, as_rfc);
  return *found;
}

void take_feature(const Json& object, std::int64_t number, const std::string& name,
                  const std::function<void(const GeoFeature&)>& take) {
  const std::string where = number < 0 ? "" : message("feature {}: ", number);
  const std::string type = text_in(object, "type");
  if (type != "Feature" && (object.contains("coordinates") || object.contains("geometries")))
    return take({number, where, Json(), object}); // a single geometry
  if (type != "Feature" && !(type.empty() && object.contains("geometry")))
    fail_file(name, "{}no object of the type \"Feature\"{}", where, as_rfc);
  take({number, where, object.value("properties", Json()), object.value("geometry", Json())});
}

void visit_geometry(const Json& object, int depth, const GeoFeature& feature,
                    const std::string& name, const GeometryVisit& visit) {
  const std::string type = object.is_object() ? text_in(object, "type") : "";
  const bool is_collection = type == "GeometryCollection";
  if (is_collection && depth < deepest)
    for (const Json& part : array(object, "geometries", name, feature.where))
      visit_geometry(part, depth + 1, feature, name, visit);
  else
    visit(feature, type,
          type.empty() || is_collection ? Json()
                                        : array(object, "coordinates", name, feature.where));
}

} // namespace

Json read_features(std::istream& in, const std::string& name,
                   const std::function<void(const GeoFeature&)>& take) {
  std::int64_t count = 0;
  Json rest =
      parse(in, name, [&](const Json& feature) { take_feature(feature, count++, name, take); });
  if (!rest.is_object())
    fail_file(name, "no GeoJSON object; give features or a geometry");
  const std::string type = text_in(rest, "type");
  if (type == "FeatureCollection") {
    if (!array(rest, "features", name, "").empty())
      fail_file(name, "\"features\" holds other values than objects{}", as_rfc);
  } else if (type == "Feature") {
    take_feature(rest, -1, name, take);
  } else {
    take({-1, "", Json(), rest});
  }
  return rest;
}

Json read_geometries(std::istream& in, const std::string& name, const GeoPair& pair,
                     const GeometryVisit& visit) {
  if (is_shapefile(name)) {
    read_shapefile(name, pair, visit);
    return Json();
  }
  return read_features(in, name, [&](const GeoFeature& feature) {
    if (!feature.geometry.is_null())
      visit_geometry(feature.geometry, 0, feature, name, visit);
  });
}

std::string text_in(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

bool is_position(const Json& value) {
  return value.is_array() && value.size() >= 2 && value[0].is_number() && value[1].is_number();
}

GeoPosition position_of(const Json& value) {
  return {value[0].get<double>(), value[1].get<double>()};
}

bool are_degrees(const GeoPosition& position) {
  constexpr double two_turns = 720;
  return std::abs(position[0]) <= two_turns && std::abs(position[1]) <= 90;
}

} // namespace calotte::io_detail
