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

std::vector<Points3> points_of(const std::string& path) {
  const Points3 points = read_points(path, Columns::lonlat);
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

} // namespace

std::vector<Points3> read_shapes(const std::string& path) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".txt")
    return points_of(path);
  return suffix == ".nc" || is_netcdf_file(path) ? shores(read_coast(path)) : read_geojson(path);
}

} // namespace calotte
