// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/command.h"
#include "io/shapes/coast_file.h"
#include "io/shapes/geojson_areas.h"

#include <calotte/read.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

/// \param where names the feature.
Points3 make_line(const Json& positions, const std::string& name, const std::string& where,
                  bool plane) {
  if (!positions.is_array() || positions.empty())
    fail_file(name, where + "a line without places; leave it out");
  const GeoPair& pair = plane ? xy_pair : lonlat_pair;
  Points3 points(3, std::ssize(positions));
  for (std::size_t k = 0; k < positions.size(); ++k) {
    if (!is_position(positions[k]) || !(plane || are_degrees(position_of(positions[k]))))
      fail_file(name, "{}{} is no position {}; {}", where, positions[k].dump(), pair.form,
                pair.remedy);
    const auto [x, y] = position_of(positions[k]);
    const Vec3 point = plane ? Vec3{x, y, 0} : from_lonlat(x, y);
    points.col(static_cast<Eigen::Index>(k)) << point.x, point.y, point.z;
  }
  return points;
}

/// Reads the lines of a file of geometries: unit columns, or x y 0 in a plane. Calls `other` for
/// each other geometry.
std::vector<Points3> read_geojson_lines(const std::string& path, bool plane,
                                        const GeometryVisit& other) {
  std::ifstream in = open_geometries(path);
  std::vector<Points3> lines;
  read_geometries(in, path, plane ? xy_pair : lonlat_pair,
                  [&](const GeoFeature& feature, const std::string& type, const Json& coordinates) {
                    if (type == "LineString")
                      lines.push_back(make_line(coordinates, path, feature.where, plane));
                    else if (type == "MultiLineString")
                      for (const Json& part : coordinates)
                        lines.push_back(make_line(part, path, feature.where, plane));
                    else
                      other(feature, type, coordinates);
                  });
  return lines;
}

[[noreturn]] void refuse_type(const std::string& path, const GeoFeature& feature,
                              const std::string& type) {
  fail_file(path, "{}an object of the type \"{}\" is no line; give LineString or MultiLineString",
            feature.where, type);
}

std::vector<Points3> read_points_as_shapes(const std::string& path, bool plane) {
  const Points3 points = read_points(path, plane ? Columns::xy : Columns::lonlat);
  std::vector<Points3> shapes;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    shapes.emplace_back(points.col(i));
  return shapes;
}

/// Adds the rings of the polygons of a plane, each closed.
void add_rings(const GeoGeometry& geometry, std::vector<Points3>& rings) {
  for (const GeoPolygon& polygon : geometry.polygons)
    for (const GeoRing& ring : polygon) {
      Points3& line = rings.emplace_back(Points3::Zero(3, std::ssize(ring) + 1));
      for (std::size_t k = 0; k <= ring.size(); ++k) {
        const auto [x, y] = ring[k % ring.size()];
        line.col(static_cast<Eigen::Index>(k)) << x, y, 0;
      }
    }
}

/// Adds the points of a geometry, each a line of one point.
void add_points(const Json& positions, const std::string& path, const std::string& where,
                bool plane, std::vector<Points3>& points) {
  const Points3 all = make_line(positions, path, where, plane);
  for (Eigen::Index i = 0; i < all.cols(); ++i)
    points.emplace_back(all.col(i));
}

/// Reads points, lines, and polygons as their coasts, in a plane as their rings.
std::vector<Points3> read_lines_and_coasts(const std::string& path, bool plane) {
  std::vector<Points3> points, rings;
  Coast coast;
  std::vector<Points3> shapes = read_geojson_lines(
      path, plane,
      [&](const GeoFeature& feature, const std::string& type, const Json& coordinates) {
        if (type == "Point")
          return add_points(Json::array({coordinates}), path, feature.where, plane, points);
        if (type == "MultiPoint")
          return add_points(coordinates, path, feature.where, plane, points);
        if (!is_polygon(type))
          refuse_type(path, feature, type);
        const GeoGeometry geometry =
            read_geometry(feature, type, coordinates, path, plane ? xy_pair : lonlat_pair);
        if (plane)
          add_rings(geometry, rings);
        else
          add_land(make_area(geometry, path).rings, coast);
      });
  if (!plane)
    rings = shores(coast);
  shapes.insert(shapes.end(), points.begin(), points.end());
  shapes.insert(shapes.end(), rings.begin(), rings.end());
  if (shapes.empty())
    fail_file(path, "no points, lines or polygons; give geometries of these");
  return shapes;
}

} // namespace

std::vector<Points3> read_lines(const std::string& path, const Surface& surface) {
  std::vector<Points3> lines =
      read_geojson_lines(path, !surface.is_sphere(),
                         [&](const GeoFeature& feature, const std::string& type,
                             const Json& /*coordinates*/) { refuse_type(path, feature, type); });
  if (lines.empty())
    fail_file(path, "no lines; give LineString or MultiLineString geometries");
  return lines;
}

std::vector<Points3> lines_in(const std::string& path, const Surface& surface) {
  if (!has_geometries(path))
    return {};
  bool others = false;
  std::vector<Points3> lines =
      read_geojson_lines(path, !surface.is_sphere(), [&](const auto&...) { others = true; });
  if (others && !lines.empty())
    fail_file(path, "lines beside other geometries; give each in a file of its own");
  return lines;
}

std::vector<Points3> read_shapes(const std::string& path, const Surface& surface) {
  const std::string suffix = suffix_of(path);
  const bool plane = !surface.is_sphere();
  if (suffix == ".txt")
    return read_points_as_shapes(path, plane);
  return !plane && (suffix == ".nc" || is_netcdf_file(path)) ? shores(read_coast(path))
                                                             : read_lines_and_coasts(path, plane);
}

} // namespace calotte
