// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/read.h>

#include "base/lonlat.h"
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/command.h"
#include "io/shapes/geojson.h"

#include <calotte/error.h>

#include <string>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using Json = nlohmann::json;

/// \param where names the file and the feature.
Points3 line_of(const Json& positions, const std::string& where) {
  const auto fail = [&](const std::string& problem) {
    throw Error(ErrorCode::parse, where + problem);
  };
  if (!positions.is_array() || positions.empty())
    fail("a line without places; leave it out");
  Points3 places(3, std::ssize(positions));
  for (std::size_t k = 0; k < positions.size(); ++k) {
    if (!is_position(positions[k]) || !are_degrees(position_of(positions[k])))
      fail(positions[k].dump() + " is no position [longitude, latitude]; give degrees");
    const auto [longitude, latitude] = position_of(positions[k]);
    const Vec3 place = from_lonlat(longitude, latitude);
    places.col(static_cast<Eigen::Index>(k)) << place.x, place.y, place.z;
  }
  return places;
}

std::vector<Points3> read_lines(std::istream& in, const std::string& name) {
  std::vector<Points3> lines;
  read_features(in, name, [&](const GeoFeature& feature) {
    const std::string where = name + ": " + feature.where;
    for_each_geometry(feature, name, [&](const std::string& type, const Json& coordinates) {
      if (type == "LineString")
        lines.push_back(line_of(coordinates, where));
      else if (type == "MultiLineString")
        for (const Json& part : coordinates)
          lines.push_back(line_of(part, where));
      else
        throw Error(ErrorCode::parse, where + "an object of the type \"" + type +
                                          "\" is no line; give LineString or MultiLineString");
    });
  });
  if (lines.empty())
    throw Error(ErrorCode::parse,
                name + ": no lines; give LineString or MultiLineString geometries");
  return lines;
}

} // namespace
} // namespace io_detail

bool holds_lines(const std::string& path) {
  const std::string suffix = io_detail::suffix_of(path);
  if (suffix != ".geojson" && suffix != ".json")
    return false;
  std::ifstream in = io_detail::open_input(path);
  bool found = false;
  io_detail::read_features(in, path, [&](const io_detail::GeoFeature& feature) {
    io_detail::for_each_geometry(feature, path, [&](const std::string& type, const auto&) {
      found = found || type == "LineString" || type == "MultiLineString";
    });
  });
  return found;
}

std::vector<Points3> read_lines(const std::string& path) {
  std::ifstream in = io_detail::open_input(path);
  return io_detail::read_lines(in, path);
}

} // namespace calotte
