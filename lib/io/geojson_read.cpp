// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "base/points.h"
#include "io/formats.h"
#include "io/json_stream.h"
#include "io/model_grid.h"
#include "io/polygons.h"
#include "io/text.h"

#include <calotte/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <istream>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

// GeoJSON (Butler et al., RFC 7946, 2016): a feature a cell. Features with a site, which are
// Voronoi cells as calotte writes them or points, give the sites; polygons of others give cells.

namespace calotte::io_detail {
namespace {

using nlohmann::json;

constexpr std::array axes{"x", "y", "z"};

std::string text_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Numbers for each feature under one name; NaN where a feature has none.
struct Column {
  std::vector<double> values;
  bool integer = true;

  void set(std::int64_t feature, const json& value) {
    values.resize(static_cast<std::size_t>(feature), none);
    values.push_back(value.get<double>());
    integer = integer && value.is_number_integer();
  }
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
};

/// Corners by longitude and latitude. Those that agree to 1e-9 degrees, with any number of turns,
/// are one: neighbours may stand on both sides of the meridian of 180 degrees.
class Corners {
public:
  std::int32_t id_of(double longitude, double latitude) {
    constexpr double digits = 1e9, half_turn = 180 * digits;
    const double north = std::round(latitude * digits);
    double east = std::round(std::remainder(longitude, 360.0) * digits);
    if (east == -half_turn)
      east = half_turn;
    if (std::abs(latitude) == 90)
      east = 0;
    const auto [known, is_new] = ids_.try_emplace({east, north}, std::ssize(places_));
    if (is_new)
      places_.push_back(from_lonlat(longitude, latitude));
    return known->second;
  }

  bool is_pole(std::int32_t id) const {
    const Vec3& p = places_[static_cast<std::size_t>(id)];
    return p.x == 0 && p.y == 0;
  }

  Points3 columns() const {
    Points3 columns(3, std::ssize(places_));
    for (std::int64_t i = 0; i < columns.cols(); ++i)
      set_column(columns, i, places_[static_cast<std::size_t>(i)]);
    return columns;
  }

private:
  struct Hash {
    std::size_t operator()(const std::array<double, 2>& key) const {
      const std::hash<double> hash;
      return 31 * hash(key[0]) + hash(key[1]);
    }
  };
  std::unordered_map<std::array<double, 2>, std::int32_t, Hash> ids_;
  std::vector<Vec3> places_;
};

/// The features of a collection, one after the other.
class Features {
public:
  explicit Features(const std::string& name) : name_(name) {}

  void take(const json& feature) {
    const json properties = feature.value("properties", json()),
               geometry = feature.value("geometry", json());
    take_properties(properties);
    const std::optional<Vec3> site = site_of(properties);
    const std::string type = geometry.is_object() ? text_in(geometry, "type") : "";
    const bool is_cell =
        (type == "Polygon" || type == "MultiPolygon") && !(site && is_voronoi_cell(properties));
    if (is_cell != (count_ > 0 ? !rings_.empty() : is_cell))
      fail("is " + std::string(is_cell ? "a cell" : "no polygon") + ", unlike those before it");
    if (is_cell)
      rings_.push_back(ring_of(geometry, type));
    if (site)
      sites_.push_back(*site);
    else if (!is_cell)
      sites_.push_back(place_of_point(geometry, type));
    ++count_;
  }

  std::int64_t count() const { return count_; }

  Soup soup() {
    Soup soup;
    const bool has_sites = std::ssize(sites_) == count_;
    if (has_sites) {
      soup.points.resize(3, count_);
      for (std::int64_t i = 0; i < count_; ++i)
        set_column(soup.points, i, sites_[static_cast<std::size_t>(i)]);
    }
    if (!rings_.empty())
      soup.polygons = polygons(has_sites ? directions_of(soup.points) : Points3());
    soup.turns_each = true;
    add_fields(has_sites, soup);
    soup.ignored.assign(ignored_.begin(), ignored_.end());
    return soup;
  }

private:
  using Ring = std::vector<std::int32_t>; ///< corners

  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::parse, name_ + ": feature " + std::to_string(count_) + " " + problem,
                count_);
  }

  void take_properties(const json& properties) {
    if (!properties.is_object())
      return;
    for (const auto& [key, value] : properties.items())
      if (value.is_number())
        columns_[key].set(count_, value);
      else if (!value.is_null())
        ignored_.insert(key);
  }

  static bool has_numbers(const json& properties, const auto& names) {
    return properties.is_object() && std::all_of(names.begin(), names.end(), [&](const char* key) {
             return properties.contains(key) && properties[key].is_number();
           });
  }

  static std::optional<Vec3> site_of(const json& properties) {
    if (!has_numbers(properties, axes))
      return std::nullopt;
    return Vec3{properties["x"].get<double>(), properties["y"].get<double>(),
                properties["z"].get<double>()};
  }

  /// Those that only Voronoi cells of calotte have: their sites tell all.
  static bool is_voronoi_cell(const json& properties) {
    return has_numbers(properties, std::array{"area", "spacing", "quality", "degree"});
  }

  static bool is_position(const json& place) {
    return place.is_array() && place.size() >= 2 && place[0].is_number() && place[1].is_number() &&
           std::abs(place[1].get<double>()) <= 90;
  }

  static Vec3 on_sphere_at(const json& place) {
    return from_lonlat(place[0].get<double>(), place[1].get<double>());
  }

  Vec3 place_of_point(const json& geometry, const std::string& type) const {
    const json place = type == "Point" ? geometry.value("coordinates", json()) : json();
    if (!is_position(place))
      fail("is neither a polygon nor a point that is the site of its cell; give it a geometry, or "
           "numbers x, y and z as properties");
    return on_sphere_at(place);
  }

  /// Without consecutive equal places, and without the way to a pole and back along one meridian by
  /// which a ring around the pole is closed in the plane of longitude and latitude.
  Ring ring_of(const json& geometry, const std::string& type) {
    if (type == "MultiPolygon")
      fail("is a MultiPolygon; only cells of one ring are read, so give it as one Polygon, whose "
           "longitudes may exceed 180 degrees");
    const json rings = geometry.value("coordinates", json());
    if (!rings.is_array() || rings.empty() || !rings[0].is_array())
      fail("has no ring of positions; give GeoJSON as RFC 7946 has it");
    if (rings.size() > 1)
      fail("has a hole; only cells of one ring are read");
    Ring ring;
    for (const json& place : rings[0]) {
      if (!is_position(place))
        fail("has a position that is no longitude and latitude in degrees; correct it");
      push(corners_.id_of(place[0].get<double>(), place[1].get<double>()), ring);
    }
    while (ring.size() > 1 && ring.front() == ring.back())
      ring.pop_back();
    if (!ring.empty() && corners_.is_pole(ring.front()))
      std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    if (ring.size() > 3 && ring[ring.size() - 2] == ring.front() && corners_.is_pole(ring.back()))
      ring.resize(ring.size() - 2);
    if (ring.size() < 3)
      fail("has a ring of fewer than 3 places; leave it out");
    return ring;
  }

  void push(std::int32_t corner, Ring& ring) const {
    const std::size_t size = ring.size();
    if (size > 1 && corners_.is_pole(ring[size - 1]) && ring[size - 2] == corner)
      ring.pop_back(); // the place before the pole is the last again
    else if (size == 0 || ring.back() != corner)
      ring.push_back(corner);
  }

  static Points3 directions_of(const Points3& points) {
    Points3 centres = points;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      centres.col(i) = points.col(i).stableNormalized();
    return centres;
  }

  Polygons polygons(Points3 centres) const {
    Polygons polygons{corners_.columns(), {}, {}, std::move(centres)};
    polygons.begin.resize(count_ + 1);
    polygons.begin[0] = 0;
    std::vector<std::int32_t> ids;
    for (std::int64_t i = 0; i < count_; ++i) {
      const Ring& ring = rings_[static_cast<std::size_t>(i)];
      ids.insert(ids.end(), ring.begin(), ring.end());
      polygons.begin[i + 1] = std::ssize(ids);
    }
    polygons.ids = Eigen::Map<const Ids>(ids.data(), std::ssize(ids));
    return polygons;
  }

  /// Without those that a writer makes anew.
  bool is_derived(const std::string& name, const Eigen::VectorXd& values, bool has_sites,
                  const Soup& soup) const {
    if (name == "x" || name == "y" || name == "z")
      return has_sites;
    if (name == "id")
      return values == Eigen::VectorXd::LinSpaced(count_, 0, static_cast<double>(count_ - 1));
    if (soup.polygons.size() > 0)
      return name == "area" && are_areas_of(soup.polygons, values);
    return name == "area" || name == "spacing" || name == "quality" || name == "degree";
  }

  void add_fields(bool has_sites, Soup& soup) {
    for (auto& [name, column] : columns_) {
      column.values.resize(static_cast<std::size_t>(count_), Column::none);
      Eigen::VectorXd values =
          Eigen::Map<const Eigen::VectorXd>(column.values.data(), std::ssize(column.values));
      if (is_derived(name, values, has_sites, soup))
        continue;
      if (name == "density" && values.allFinite())
        soup.density = std::move(values);
      else
        soup.fields.push_back(
            {.name = name, .values = std::move(values), .integer = column.integer});
    }
  }

  const std::string& name_;
  std::int64_t count_ = 0;
  std::vector<Vec3> sites_; ///< of the features that have one
  Corners corners_;
  std::vector<Ring> rings_; ///< of all features, or none
  std::map<std::string, Column> columns_;
  std::set<std::string> ignored_;
};

/// The whole file without its features, of which each is shown to `take` as soon as it is read.
json parse(std::istream& in, const std::string& name,
           const std::function<void(const json& feature)>& take) {
  bool in_features = false;
  const auto keep = [&](int depth, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::key && depth == 1)
      in_features = parsed == "features";
    if (event != json::parse_event_t::object_end || depth != 2 || !in_features)
      return true;
    take(parsed);
    return false;
  };
  try {
    JsonBuffer buffer(in, name);
    std::istream checked(&buffer);
    return json::parse(checked, keep);
  } catch (const json::parse_error& error) {
    throw Error(ErrorCode::parse, name + ": invalid or incomplete JSON at byte " +
                                      std::to_string(error.byte) + "; make the file again");
  } catch (const json::exception&) {
    throw Error(ErrorCode::parse, name + ": a number is out of range; make the file again");
  }
}

} // namespace

Soup get_geojson(std::istream& in, const std::string& name) {
  Features features(name);
  const json rest = parse(in, name, [&](const json& feature) { features.take(feature); });
  if (!rest.is_object() || text_in(rest, "type") != "FeatureCollection")
    throw Error(ErrorCode::parse, name + ": no GeoJSON FeatureCollection; give one of the cells");
  const json others = rest.value("features", json());
  if (features.count() == 0 || !others.is_array() || !others.empty())
    throw Error(ErrorCode::parse, name + ": \"features\" is empty or holds other values than "
                                         "objects; give one feature for each cell");
  return features.soup();
}

} // namespace calotte::io_detail
