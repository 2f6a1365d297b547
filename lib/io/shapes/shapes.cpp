// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/command.h"
#include "io/shapes/coast_file.h"
#include "io/shapes/geojson_areas.h"
#include "io/shapes/geojson_lines.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

std::vector<Points3> points_of(const std::string& path, bool plane) {
  const Points3 points = read_points(path, plane ? Columns::xy : Columns::lonlat);
  std::vector<Points3> shapes;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    shapes.emplace_back(points.col(i));
  return shapes;
}

/// Lines, and the shores of polygons.
std::vector<Points3> read_geojson(const std::string& path) {
  std::ifstream in = open_input(path);
  std::vector<Points3> shapes;
  Coast coast;
  read_features(in, path, [&](const GeoFeature& feature) {
    for_each_geometry(
        feature, path, [&](const std::string& type, const nlohmann::json& coordinates) {
          if (is_polygon(type))
            add_land(
                area_of(polygons_of(feature, type, coordinates, path, lonlat_pair()), path).rings,
                coast);
          else
            add_lines(feature, type, coordinates, path, shapes);
        });
  });
  for (Points3& shore : shores(coast))
    shapes.push_back(std::move(shore));
  if (shapes.empty())
    throw Error(ErrorCode::parse, path + ": no lines or polygons; give geometries of these");
  return shapes;
}

/// Of a plane: lines, and the rings of polygons, closed.
std::vector<Points3> read_planar_geojson(const std::string& path) {
  const GeoPair pair{"[x, y]", "give two numbers"};
  std::ifstream in = open_input(path);
  std::vector<Points3> shapes;
  const auto add_ring = [&](const GeoRing& ring) {
    Points3& line = shapes.emplace_back(Points3::Zero(3, std::ssize(ring) + 1));
    for (std::size_t k = 0; k <= ring.size(); ++k) {
      const auto [x, y] = ring[k % ring.size()];
      line.col(static_cast<Eigen::Index>(k)) << x, y, 0;
    }
  };
  read_features(in, path, [&](const GeoFeature& feature) {
    for_each_geometry(feature, path,
                      [&](const std::string& type, const nlohmann::json& coordinates) {
                        if (!is_polygon(type))
                          add_lines(feature, type, coordinates, path, shapes, true);
                        else
                          for (const GeoPolygon& polygon :
                               polygons_of(feature, type, coordinates, path, pair).polygons)
                            for (const GeoRing& ring : polygon)
                              add_ring(ring);
                      });
  });
  if (shapes.empty())
    throw Error(ErrorCode::parse, path + ": no lines or polygons; give geometries of these");
  return shapes;
}

} // namespace

std::vector<Points3> read_shapes(const std::string& path, const Surface& surface) {
  const std::string suffix = suffix_of(path);
  const bool plane = !surface.is_sphere();
  if (suffix == ".txt")
    return points_of(path, plane);
  if (plane)
    return read_planar_geojson(path);
  return suffix == ".nc" || is_netcdf_file(path) ? shores(read_coast(path)) : read_geojson(path);
}

} // namespace calotte
