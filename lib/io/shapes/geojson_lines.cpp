// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/read.h>

#include "base/lonlat.h"
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/command.h"
#include "io/shapes/geojson_lines.h"

#include <calotte/error.h>

#include <string>
#include <vector>

namespace calotte {
namespace io_detail {

namespace {

/// \param where names the file and the feature.
Points3 line_of(const Json& positions, const std::string& where, bool plane) {
  const auto fail = [&](const std::string& problem) {
    throw Error(ErrorCode::parse, where + problem);
  };
  if (!positions.is_array() || positions.empty())
    fail("a line without places; leave it out");
  Points3 places(3, std::ssize(positions));
  for (std::size_t k = 0; k < positions.size(); ++k) {
    if (!is_position(positions[k]) || !(plane || are_degrees(position_of(positions[k]))))
      fail(positions[k].dump() + (plane ? " is no position [x, y]; give two numbers"
                                        : " is no position [longitude, latitude]; give degrees"));
    const auto [x, y] = position_of(positions[k]);
    const Vec3 place = plane ? Vec3{x, y, 0} : from_lonlat(x, y);
    places.col(static_cast<Eigen::Index>(k)) << place.x, place.y, place.z;
  }
  return places;
}

} // namespace

void add_lines(const GeoFeature& feature, const std::string& type, const Json& coordinates,
               const std::string& name, std::vector<Points3>& lines, bool plane) {
  const std::string where = name + ": " + feature.where;
  if (type == "LineString")
    lines.push_back(line_of(coordinates, where, plane));
  else if (type == "MultiLineString")
    for (const Json& part : coordinates)
      lines.push_back(line_of(part, where, plane));
  else
    throw Error(ErrorCode::parse, where + "an object of the type \"" + type +
                                      "\" is no line; give LineString or MultiLineString");
}

} // namespace io_detail

std::vector<Points3> lines_in(const std::string& path, const Surface& surface) {
  using namespace io_detail;
  const std::string suffix = suffix_of(path);
  std::vector<Points3> lines;
  if (suffix != ".geojson" && suffix != ".json")
    return lines;
  std::ifstream in = open_input(path);
  bool others = false;
  read_features(in, path, [&](const GeoFeature& feature) {
    for_each_geometry(feature, path, [&](const std::string& type, const Json& coordinates) {
      if (type == "LineString" || type == "MultiLineString")
        add_lines(feature, type, coordinates, path, lines, !surface.is_sphere());
      else
        others = true;
    });
  });
  if (others && !lines.empty())
    throw Error(ErrorCode::parse,
                path + ": lines beside other geometries; give each in a file of its own");
  return lines;
}

std::vector<Points3> read_lines(const std::string& path, const Surface& surface) {
  using namespace io_detail;
  std::ifstream in = open_input(path);
  std::vector<Points3> lines;
  read_features(in, path, [&](const GeoFeature& feature) {
    for_each_geometry(feature, path, [&](const std::string& type, const Json& coordinates) {
      add_lines(feature, type, coordinates, path, lines, !surface.is_sphere());
    });
  });
  if (lines.empty())
    throw Error(ErrorCode::parse,
                path + ": no lines; give LineString or MultiLineString geometries");
  return lines;
}

} // namespace calotte
