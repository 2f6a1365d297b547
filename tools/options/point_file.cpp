// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/point_file.h"

#include "options/format_options.h"

#include <iostream>
#include <string_view>
#include <utility>

namespace calotte::tools {
namespace {

/// Reads as read_points(); "-" is standard input.
Points3 points_from(const std::string& path, Columns columns, std::vector<std::int64_t>* lines) {
  return path == "-" ? read_points(std::cin, "standard input", columns, lines)
                     : read_points(path, columns, lines);
}

} // namespace

PointFile read_point_file(const std::string& path, bool lonlat) {
  if (holds_points(path)) {
    if (lonlat)
      throw Error(ErrorCode::bad_option,
                  path + ": the points of a mesh are x y z; leave --lonlat out, or give text");
    return {path, read_sites(path), {}};
  }
  PointFile file;
  file.name = path == "-" ? "standard input" : path;
  file.points = points_from(path, lonlat ? Columns::lonlat : Columns::xyz, &file.lines);
  return file;
}

PointFile read_planar_point_file(const std::string& path) {
  PointFile file;
  file.name = path == "-" ? "standard input" : path;
  if (holds_points(path)) {
    Mesh mesh = read_mesh(path);
    if (mesh.surface.is_sphere())
      throw Error(ErrorCode::bad_option, path + ": it holds points of the sphere, not of a plane");
    file.points = std::move(mesh.points);
    return file;
  }
  const Points2 places = path == "-" ? read_planar_points(std::cin, file.name, &file.lines)
                                     : read_planar_points(path, &file.lines);
  file.points = Points3::Zero(3, places.cols());
  file.points.topRows<2>() = places;
  return file;
}

void rethrow_with_line(const Error& error, const std::string& name,
                       const std::vector<std::int64_t>& lines) {
  const bool of_input = error.code() == ErrorCode::not_finite ||
                        error.code() == ErrorCode::zero_vector ||
                        error.code() == ErrorCode::duplicate ||
                        // outside of a domain; other options' indices are of other things
                        (error.code() == ErrorCode::bad_option &&
                         (std::string_view(error.what()).starts_with("point ") ||
                          std::string_view(error.what()).starts_with("generator ") ||
                          std::string_view(error.what()).starts_with("fixed generator ") ||
                          std::string_view(error.what()).starts_with("fixed point ")));
  if (!of_input || error.index() < 0 || error.index() >= static_cast<std::int64_t>(lines.size()))
    throw error;
  const std::int64_t line = lines[static_cast<std::size_t>(error.index())];
  throw Error(error.code(), name + " line " + std::to_string(line) + ": " + error.what(), line);
}

} // namespace calotte::tools
