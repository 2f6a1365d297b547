// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "density/cell_width_polygons.h"
#include "density/raster_field.h"
#include "io/bytes/file_error.h"
#include "io/shapes/cell_width_file.h"
#include "io/shapes/geojson_areas.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <set>

namespace calotte::io_detail {
namespace {

/// Reads the polygons of one file and their widths.
class Collector {
public:
  Collector(std::string name, const PolygonWidths& widths)
      : name_(std::move(name)), widths_(widths) {}

  Raster read(std::istream& in) {
    const GeoPolygons polygons = read_polygons(in, name_, lonlat_pair);
    outer_width(polygons.members, "insideWidth", "inside width", widths_.inside, false);
    outer_width(polygons.members, "outsideWidth", "outside width", widths_.outside, true);
    outer_width(polygons.members, "transition", "width of the transition", widths_.transition,
                true);
    for (const GeoGeometry& geometry : polygons.geometries) {
      where_ = geometry.where;
      regions_.push_back(make_region(geometry));
    }
    where_.clear();
    require_narrower();
    return named(name_, [&] { return make_cell_width(regions_, widths_); });
  }

private:
  [[noreturn]] void fail(const std::string& problem) const { fail_file(name_, where_ + problem); }

  double positive(const Json& value, const std::string& what) const {
    if (!value.is_number() || !(value.get<double>() > 0) || !std::isfinite(value.get<double>()))
      fail(message("{} is not a positive number; give km", what));
    return value.get<double>();
  }

  /// Uses the width from the caller or, if that is 0, the member `key` of the file.
  void outer_width(const Json& root, const char* key, const char* what, double& width,
                   bool needed) const {
    const auto given = root.find(key);
    if (width == 0 && given != root.end())
      width = positive(*given, message("\"{}\"", key));
    if (!std::isfinite(width) || width < 0 || (needed && width == 0))
      refuse_path(name_, "no positive {}; give it in km as an option or as the file's \"{}\"", what,
                  key);
  }

  double width_inside(const Json& properties) const {
    if (properties.is_object())
      if (const auto own = properties.find("cellWidth"); own != properties.end())
        return positive(*own, "its property \"cellWidth\"");
    if (widths_.inside == 0)
      fail("no inside width; give it in km as an option or as a property \"cellWidth\"");
    return widths_.inside;
  }

  /// If the geometry names a point inside, all its rings bound one area.
  WidthRegion make_region(const GeoGeometry& geometry) const {
    WidthRegion region{width_inside(geometry.properties), {}};
    const std::optional<GeoPosition> inside = read_inside(geometry, name_);
    if (inside)
      region.polygons.push_back({{}, base_detail::LonLat{(*inside)[0], (*inside)[1]}});
    std::int64_t rings = 0;
    for (const GeoPolygon& polygon : geometry.polygons) {
      if (!inside)
        region.polygons.emplace_back();
      for (const GeoRing& ring : polygon)
        region.polygons.back().rings.push_back(make_ring(ring, rings++));
    }
    return region;
  }

  Ring make_ring(const GeoRing& positions, std::int64_t number) const {
    Ring ring;
    for (const GeoPosition& position : positions) {
      require_degrees(position, name_,
                      message("{}position {} of ring {}", where_, ring.size(), number));
      ring.push_back({position[0], position[1]});
    }
    return ring;
  }

  /// The smallest of several widths applies, so that a width larger than the outside width would
  /// have no effect.
  void require_narrower() const {
    std::set<double> inside;
    for (const WidthRegion& region : regions_)
      inside.insert(region.inside);
    if (inside.size() > 1 && *inside.rbegin() > widths_.outside)
      fail(message("of several inside widths the widest, {} km, is wider than the outside; as the "
                   "least one holds it would not be seen",
                   Json(*inside.rbegin()).dump()));
  }

  std::string name_, where_;
  PolygonWidths widths_;
  std::vector<WidthRegion> regions_;
};

} // namespace

Raster read_cell_width_geojson(std::istream& in, const std::string& name,
                               const PolygonWidths& widths) {
  density_detail::require_radius(widths.radius_km);
  return Collector(name, widths).read(in);
}

} // namespace calotte::io_detail
