// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "base/points.h"
#include "io/bytes/file_error.h"
#include "io/bytes/text.h"
#include "io/cells/model_grid.h"
#include "io/cells/polygons.h"
#include "io/formats/formats.h"
#include "io/shapes/geojson.h"
#include "io/shapes/geojson_corners.h"

#include <calotte/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

// GeoJSON (Butler et al., RFC 7946, 2016), with a feature for each cell. Features with a site,
// which are points or Voronoi cells as calotte writes them, give the sites. Polygons of others give
// cells; so do Voronoi cells, if some cells are missing.

namespace calotte::io_detail {
namespace {

using nlohmann::json;

constexpr const char* no_collection = "no GeoJSON FeatureCollection; give one of the cells";

constexpr std::array axes{"x", "y", "z"};

/// Values of one property of all features; NaN if a feature does not have it.
struct FeatureValues {
  std::vector<double> values;
  bool integer = true;

  void set(std::int64_t feature, const json& value) {
    values.resize(static_cast<std::size_t>(feature), none);
    values.push_back(value.get<double>());
    integer = integer && value.is_number_integer();
  }
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
};

/// Collects the features of a file.
class Features {
public:
  explicit Features(const std::string& name) : name_(name) {}

  void take(const GeoFeature& feature) {
    if (feature.number < 0)
      fail_file(name_, no_collection);
    const json &properties = feature.properties, &geometry = feature.geometry;
    take_properties(properties);
    const std::optional<Vec3> site = site_of(properties);
    const std::string type = geometry.is_object() ? text_in(geometry, "type") : "";
    const bool is_polygon = type == "Polygon" || type == "MultiPolygon",
               is_voronoi = is_polygon && site && is_voronoi_cell(properties),
               is_cell = is_polygon && !is_voronoi;
    if (is_cell != (count_ > 0 ? !rings_.empty() && voronoi_ == 0 : is_cell))
      fail(is_cell ? "is a cell, unlike those before it" : "is no polygon, unlike those before it");
    if (is_cell)
      rings_.push_back(read_ring(geometry, type));
    else if (is_voronoi)
      take_voronoi_cell(geometry, type);
    if (site)
      sites_.push_back(*site);
    else if (!is_cell)
      sites_.push_back(point_site(geometry, type));
    ++count_;
  }

  std::int64_t count() const { return count_; }

  RawMesh raw() {
    RawMesh raw;
    const bool has_sites = std::ssize(sites_) == count_;
    if (has_sites) {
      raw.points.resize(3, count_);
      for (std::int64_t i = 0; i < count_; ++i)
        set_column(raw.points, i, sites_[static_cast<std::size_t>(i)]);
    }
    if (voronoi_ > 0 && !are_part_of_sphere())
      rings_.clear(); // the sites determine the cells
    else if (!unread_.empty())
      throw Error(ErrorCode::parse, unread_);
    if (!rings_.empty())
      raw.polygons = polygons(has_sites ? directions_of(raw.points) : Points3());
    raw.has_cells = voronoi_ == count_; // otherwise the features are polygons
    raw.turns_each = true;
    add_fields(has_sites, raw);
    raw.ignored.assign(ignored_.begin(), ignored_.end());
    return raw;
  }

private:
  [[noreturn]] void fail(const std::string& problem) const {
    fail_file(name_, count_, "feature {} {}", count_, problem);
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

  /// Reads a Voronoi cell. Its ring is needed only if other cells of the sphere are missing.
  void take_voronoi_cell(const json& geometry, const std::string& type) {
    ++voronoi_;
    rings_.emplace_back();
    try {
      rings_.back() = read_ring(geometry, type);
    } catch (const Error& error) {
      if (unread_.empty())
        unread_ = error.what();
    }
  }

  /// Whether the Voronoi cells leave an area of at least one cell of the sphere uncovered.
  bool are_part_of_sphere() const {
    const std::vector<double>& areas = columns_.at("area").values;
    if (voronoi_ < count_ || std::ssize(areas) < count_ ||
        std::all_of(sites_.begin(), sites_.end(), [](const Vec3& site) { return site.z == 0; }))
      return false;
    constexpr double whole = 4 * std::numbers::pi;
    return std::accumulate(areas.begin(), areas.end(), 0.0) <
           whole * (1 - 0.5 / static_cast<double>(count_));
  }

  /// Whether a feature has the properties of the Voronoi cells that calotte writes.
  static bool is_voronoi_cell(const json& properties) {
    return has_numbers(properties, std::array{"area", "spacing", "quality", "degree"});
  }

  static bool is_lonlat(const json& position) {
    return is_position(position) && std::abs(position[1].get<double>()) <= 90;
  }

  static Vec3 on_sphere_at(const json& position) {
    return from_lonlat(position[0].get<double>(), position[1].get<double>());
  }

  Vec3 point_site(const json& geometry, const std::string& type) const {
    const json position = type == "Point" ? geometry.value("coordinates", json()) : json();
    if (!is_lonlat(position))
      fail("is neither a polygon nor a point that is the site of its cell; give it a geometry, or "
           "numbers x, y and z as properties");
    return on_sphere_at(position);
  }

  /// Reads the ring of a cell. A cell that the meridian of 180 degrees cuts has several polygons,
  /// which are joined there.
  CornerRing read_ring(const json& geometry, const std::string& type) {
    const json coordinates = geometry.value("coordinates", json());
    if (type == "Polygon")
      return read_ring(coordinates);
    if (!coordinates.is_array() || coordinates.empty())
      fail("has no ring of positions; give GeoJSON as RFC 7946 has it");
    CornerRing whole = read_ring(coordinates[0]);
    for (std::size_t k = 1; k < coordinates.size(); ++k)
      if (!corners_.join(read_ring(coordinates[k]), whole))
        fail("is a MultiPolygon whose parts do not share one side; only cells of one ring are "
             "read, so give it as one Polygon, whose longitudes may exceed 180 degrees");
    return whole;
  }

  /// Reads a ring without consecutive equal positions, and without the detour to a pole and back
  /// along one meridian that closes a ring around the pole in the plane of longitude and latitude.
  CornerRing read_ring(const json& rings) {
    if (!rings.is_array() || rings.empty() || !rings[0].is_array())
      fail("has no ring of positions; give GeoJSON as RFC 7946 has it");
    if (rings.size() > 1)
      fail("has a hole; only cells of one ring are read");
    CornerRing ring;
    std::int32_t cut = -1; // the corner at which the detour to a pole begins and ends
    for (const json& position : rings[0]) {
      if (!is_lonlat(position))
        fail("has a position that is no longitude and latitude in degrees; correct it");
      const std::int32_t corner =
          corners_.id_of(position[0].get<double>(), position[1].get<double>());
      if (corners_.push(corner, ring))
        cut = corner;
    }
    while (ring.size() > 1 && ring.front() == ring.back())
      ring.pop_back();
    if (!ring.empty() && corners_.is_pole(ring.front()))
      std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    if (ring.size() > 3 && ring[ring.size() - 2] == ring.front() && corners_.is_pole(ring.back())) {
      ring.resize(ring.size() - 2);
      cut = ring.front();
    }
    corners_.leave_out_cut(cut, ring);
    if (ring.size() < 3)
      fail("has a ring of fewer than 3 places; leave it out");
    return ring;
  }

  static Points3 directions_of(const Points3& points) {
    Points3 centres = points;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      centres.col(i) = points.col(i).stableNormalized();
    return centres;
  }

  Polygons polygons(Points3 centres) const {
    Polygons polygons{corners_.columns(), {Offsets(count_ + 1), {}}, std::move(centres)};
    polygons.ids.begin[0] = 0;
    std::vector<std::int32_t> ids;
    for (std::int64_t i = 0; i < count_; ++i) {
      const CornerRing& ring = rings_[static_cast<std::size_t>(i)];
      ids.insert(ids.end(), ring.begin(), ring.end());
      polygons.ids.begin[i + 1] = std::ssize(ids);
    }
    polygons.ids.items = Eigen::Map<const Ids>(ids.data(), std::ssize(ids));
    return polygons;
  }

  /// Whether a field is one that a writer computes.
  bool is_derived(const std::string& name, const DoubleVector& values, bool has_sites,
                  const RawMesh& raw) const {
    if (name == "x" || name == "y" || name == "z")
      return has_sites;
    if (name == "id")
      return values == DoubleVector::LinSpaced(count_, 0, static_cast<double>(count_ - 1));
    if (raw.polygons.size() > 0 && voronoi_ == 0)
      return name == "area" && are_areas_of(raw.polygons, values);
    return name == "area" || name == "spacing" || name == "quality" || name == "degree";
  }

  void add_fields(bool has_sites, RawMesh& raw) {
    for (auto& [name, column] : columns_) {
      column.values.resize(static_cast<std::size_t>(count_), FeatureValues::none);
      DoubleVector values =
          Eigen::Map<const DoubleVector>(column.values.data(), std::ssize(column.values));
      if (is_derived(name, values, has_sites, raw))
        continue;
      if (name == "density" && values.allFinite())
        raw.density = std::move(values);
      else
        raw.fields.push_back(
            {.name = name, .values = std::move(values), .integer = column.integer});
    }
  }

  const std::string& name_;
  std::int64_t count_ = 0;
  std::vector<Vec3> sites_; ///< sites of the features
  GeoCorners corners_;
  std::vector<CornerRing> rings_; ///< rings of all features, or none
  std::int64_t voronoi_ = 0;      ///< number of features that are Voronoi cells of calotte
  std::string unread_;            ///< error of the first ring that could not be read; or ""
  std::map<std::string, FeatureValues> columns_;
  std::set<std::string> ignored_;
};

} // namespace

RawMesh get_geojson(std::istream& in, const std::string& name) {
  Features features(name);
  read_features(in, name, [&](const GeoFeature& feature) { features.take(feature); });
  if (features.count() == 0)
    fail_file(name, "\"features\" is empty; give one feature for each cell");
  return features.raw();
}

} // namespace calotte::io_detail
