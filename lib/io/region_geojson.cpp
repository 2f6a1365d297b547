// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "domain/arc_tree.h"
#include "domain/arcs.h"
#include "domain/rings.h"
#include "domain/spherical_area.h"
#include "io/geojson_polygons.h"
#include "io/region_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace calotte::io_detail {
namespace {

using Json = nlohmann::json;

double area_to_the_left_of(const SphericalRing& ring) {
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i < ring.size(); ++i)
    arcs.push_back({ring[i], ring[(i + 1) % ring.size()]});
  return area_to_the_left(arcs);
}

/// An area above that of a hemisphere, whose two sides are equal up to round-off.
constexpr double beyond_hemisphere = 2 * std::numbers::pi + 1e-9;

/// One file's polygons as the rings of a region.
class Collector {
public:
  explicit Collector(std::string name) : name_(std::move(name)) {}

  Region read(const Json& root) {
    for (const GeoGeometry& geometry :
         geojson_polygons(root, name_, {"[longitude, latitude]", "give degrees"})) {
      where_ = geometry.where;
      append(geometry);
    }
    where_.clear();
    rings_ = joined(std::move(rings_));
    if (rings_.empty())
      fail("its polygons cover the sphere; give no region for that");
    return checked();
  }

private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::parse, name_ + ": " + where_ + problem);
  }

  /// \pre the position is finite.
  Vec3 place(const GeoPosition& position, const std::string& what) const {
    const auto [longitude, latitude] = position;
    if (!(std::abs(longitude) <= 720) || !(std::abs(latitude) <= 90))
      fail(what + " is [" + Json(longitude).dump() + ", " + Json(latitude).dump() +
           "], no longitude and latitude in degrees; correct it");
    return from_lonlat(longitude, latitude);
  }

  RegionRing ring_of(const GeoRing& positions, std::int64_t number) const {
    const std::string ring_name = "ring " + std::to_string(number);
    RegionRing ring{{}, where_ + ring_name};
    for (std::size_t i = 0; i < positions.size(); ++i)
      ring.corners.push_back(
          place(positions[i], "position " + std::to_string(i) + " of " + ring_name));
    drop_repeated(ring.corners);
    if (ring.corners.size() < 3)
      fail(ring_name + " has fewer than 3 distinct places; an edge is the shorter arc of a great "
                       "circle, so give more places along a parallel");
    return ring;
  }

  /// The place that the feature has as its property "inside".
  std::optional<Vec3> inside_of(const Json& properties) const {
    if (!properties.is_object() || !properties.contains("inside"))
      return std::nullopt;
    const Json& given = properties["inside"];
    if (!given.is_array() || given.size() < 2 || !given[0].is_number() || !given[1].is_number())
      fail("its property \"inside\" is not a position [longitude, latitude]; give degrees");
    return place({given[0].get<double>(), given[1].get<double>()}, "its property \"inside\"");
  }

  void append(const GeoGeometry& geometry) {
    const std::optional<Vec3> inside = inside_of(geometry.properties);
    std::vector<RegionRing> rings;
    for (const GeoPolygon& polygon : geometry.polygons)
      for (std::size_t r = 0; r < polygon.size(); ++r) {
        rings.push_back(ring_of(polygon[r], std::ssize(rings)));
        if (!inside)
          orient(rings.back(), r == 0, std::ssize(rings) - 1);
      }
    if (inside)
      rings = around(joined(std::move(rings)), *inside);
    rings_.insert(rings_.end(), rings.begin(), rings.end());
  }

  /// An outer ring has its polygon to the left, a hole too. The polygon is the smaller side of its
  /// outer ring; a hole is the smaller side of its own and may run either way.
  void orient(RegionRing& ring, bool outer, std::int64_t number) {
    const bool larger = area_to_the_left_of(ring.corners) > beyond_hemisphere;
    if (!outer && !larger)
      std::reverse(ring.corners.begin(), ring.corners.end());
    if (outer && larger && doubt_.empty())
      doubt_ = name_ + ": " + where_ + "ring " + std::to_string(number) +
               " has more than half of the sphere to its left: it runs clockwise, or its inside is "
               "that large; reverse it, or name the inside by a property \"inside\": [longitude, "
               "latitude] of its feature";
  }

  std::vector<RegionRing> around(std::vector<RegionRing> rings, const Vec3& inside) const {
    try {
      const Region region = region_around(corners_of(rings), {inside.x, inside.y, inside.z});
      for (std::size_t r = 0; r < rings.size(); ++r)
        if (region.rings[r].col(0) != corners_of({rings[r]})[0].col(0))
          std::reverse(rings[r].corners.begin(), rings[r].corners.end());
      return rings;
    } catch (const Error& error) {
      throw Error(error.code(), explained(name_, rings, error), error.index());
    }
  }

  /// Rings that cross each other or themselves are refused first: they have no inside.
  Region checked() const {
    Region region{corners_of(rings_)};
    try {
      const Rings rings = rings_of(region.rings);
      simple(rings, ArcTree(rings.arcs));
      if (doubt_.empty())
        require_region(region);
    } catch (const Error& error) {
      throw Error(error.code(), explained(name_, rings_, error), error.index());
    }
    if (!doubt_.empty())
      throw Error(ErrorCode::bad_option, doubt_);
    return region;
  }

  std::string name_, where_;
  std::string doubt_; ///< of the inside of an outer ring, or empty
  std::vector<RegionRing> rings_;
};

} // namespace

Region read_region_geojson(std::istream& in, const std::string& name) {
  return Collector(name).read(read_geojson(in, name));
}

} // namespace calotte::io_detail
