// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/read.h>

#include "base/lonlat.h"
#include "domain/spherical_area.h"
#include "io/coast_file.h"
#include "io/file.h"
#include "io/geojson_polygons.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

constexpr double hemisphere = 2 * std::numbers::pi;

/// Unit vectors. \throws Error parse, for what is no longitude and latitude.
SphericalRing corners_of(const GeoRing& ring, const std::string& where) {
  SphericalRing corners;
  for (const auto& [longitude, latitude] : ring) {
    if (!(std::abs(longitude) <= 720) || !(std::abs(latitude) <= 90))
      throw Error(ErrorCode::parse, where + "a place is [" + std::to_string(longitude) + ", " +
                                        std::to_string(latitude) +
                                        "], no longitude and latitude in degrees; correct it");
    corners.push_back(from_lonlat(longitude, latitude));
  }
  drop_repeated(corners);
  return corners;
}

double area_to_the_left_of(const SphericalRing& ring) {
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i < ring.size(); ++i)
    arcs.push_back({ring[i], ring[(i + 1) % ring.size()]});
  return area_to_the_left(arcs);
}

} // namespace

void add_ring(SphericalRing ring, bool hole, Coast& coast) {
  if (ring.size() < 3)
    return; // a line or a place, without area
  const double left = area_to_the_left_of(ring);
  const bool larger = left > hemisphere;
  if (larger != hole)
    std::reverse(ring.begin(), ring.end());
  const double smaller = larger ? 2 * hemisphere - left : left;
  coast.area += hole ? -smaller : smaller;
  Points3 corners(3, std::ssize(ring));
  for (std::size_t i = 0; i < ring.size(); ++i)
    corners.col(static_cast<Eigen::Index>(i)) << ring[i].x, ring[i].y, ring[i].z;
  coast.rings.push_back(std::move(corners));
}

} // namespace io_detail

Coast read_coast(const std::string& path) {
  using namespace io_detail;
  if (is_netcdf_file(path))
    return read_gshhg(NetcdfReader(path));
  std::ifstream in = open_input(path);
  Coast coast;
  for (const GeoGeometry& geometry :
       geojson_polygons(read_geojson(in, path), path, {"[longitude, latitude]", "give degrees"}))
    for (const GeoPolygon& polygon : geometry.polygons)
      for (std::size_t r = 0; r < polygon.size(); ++r)
        add_ring(corners_of(polygon[r], path + ": " + geometry.where), r > 0, coast);
  return coast;
}

} // namespace calotte
