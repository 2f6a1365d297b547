// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/point_file.h"

#include "options/format_options.h"
#include "options/warning.h"
#include "text/text.h"

#include <iostream>
#include <string_view>
#include <utility>

namespace calotte::tools {
namespace {

/// Text; "-" is standard input.
PointFile read_text_points(const std::string& path, Columns columns) {
  const std::string name = path == "-" ? "standard input" : path;
  PointLines read =
      path == "-" ? read_point_lines(std::cin, name, columns) : read_point_lines(path, columns);
  if (read.further_columns)
    warn(message("{}: columns after the first {} are ignored; a header that names the columns says "
                 "which count",
                 name, columns == Columns::xyz ? 3 : 2));
  return {name, std::move(read.points), std::move(read.lines)};
}

} // namespace

PointFile read_point_file(const std::string& path, bool lonlat) {
  if (holds_points(path)) {
    if (lonlat)
      refuse_path(path, "the points of a mesh are x y z; leave --lonlat out, or give text");
    return {path, read_sites(path), {}};
  }
  return read_text_points(path, lonlat ? Columns::lonlat : Columns::xyz);
}

PointFile read_planar_point_file(const std::string& path) {
  if (!holds_points(path))
    return read_text_points(path, Columns::xy);
  Mesh mesh = read_mesh(path);
  if (mesh.surface.is_sphere())
    refuse_path(path, "it holds points of the sphere, not of a plane");
  return {path, std::move(mesh.points), {}};
}

void rethrow_with_line(const Error& error, const std::string& name,
                       const std::vector<std::int64_t>& lines) {
  const bool of_input = error.code() == ErrorCode::not_finite ||
                        error.code() == ErrorCode::zero_vector ||
                        error.code() == ErrorCode::duplicate ||
                        // outside of a domain; other options' indices are of other things
                        (error.code() == ErrorCode::invalid_argument &&
                         (std::string_view(error.what()).starts_with("point ") ||
                          std::string_view(error.what()).starts_with("generator ") ||
                          std::string_view(error.what()).starts_with("fixed generator ") ||
                          std::string_view(error.what()).starts_with("fixed point ")));
  if (!of_input || error.index() < 0 || error.index() >= static_cast<std::int64_t>(lines.size()))
    throw error;
  const std::int64_t line = lines[static_cast<std::size_t>(error.index())];
  throw Error(error.code(), message("{} line {}: {}", name, line, error.what()), line);
}

} // namespace calotte::tools
