// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/point_file.h"

#include "io/command.h"
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
  return {name, std::move(read.points), std::move(read.lines),
          columns == Columns::xy ? Surface::plane() : Surface::sphere()};
}

} // namespace

PointFile read_point_file(const std::string& path, Columns columns) {
  if (!holds_points(path))
    return read_text_points(path, columns);
  if (columns == Columns::lonlat)
    refuse_path(path, "the points of a mesh are x y z; leave --lonlat out, or give text");
  auto [points, surface] = read_sites_and_surface(path);
  if (columns == Columns::xy && surface.is_sphere())
    refuse_path(path, "it holds points of the sphere; give points of a plane, or leave --plane or "
                      "the domain out");
  return {path, std::move(points), {}, std::move(surface)};
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
