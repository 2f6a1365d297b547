// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/start_files.h"

#include "options/format_options.h"
#include "options/point_file.h"

#include <calotte/io.h>

#include <boost/crc.hpp>

#include <string>
#include <utility>

namespace calotte::tools {
namespace {

/// The points of a mesh of the plane.
PlanarPointFile planar_points_of(const std::string& path) {
  return {path, calotte::read_planar_mesh(path).points, {}};
}

/// "NAME n with checksum c", a line of the configuration.
template <class Points> std::string fingerprint(const std::string& name, const Points& points) {
  boost::crc_32_type checksum;
  checksum.process_bytes(points.data(), sizeof(double) * static_cast<std::size_t>(points.size()));
  return name + " " + std::to_string(points.cols()) + " with checksum " +
         std::to_string(checksum.checksum()) + "\n";
}

/// \param file of either kind of points. \returns them.
template <class File> auto take(File&& file, CvtStart::File& origin) {
  origin = {std::move(file.name), std::move(file.lines)};
  return std::move(file.points);
}

Points3 read_points(const CvtRequest& request, const std::string& path, CvtStart::File& origin) {
  return take(read_point_file(path, request.lonlat), origin);
}

Points2 read_places(const std::string& path, CvtStart::File& origin) {
  return take(holds_points(path) ? planar_points_of(path) : read_planar_point_file(path), origin);
}

} // namespace

CvtStart read_start(const CvtRequest& request) {
  CvtStart start;
  if (planar(request))
    start.places = read_places(request.points, start.file);
  else
    start.points = read_points(request, request.points, start.file);
  start.configuration = "start points\n" + (planar(request) ? fingerprint("points", start.places)
                                                            : fingerprint("points", start.points));
  return start;
}

void add_fixed(const CvtRequest& request, CvtStart& start) {
  if (request.fixed.empty())
    return;
  if (planar(request)) {
    const Points2 fixed = read_places(request.fixed, start.fixed_file);
    start.fixed = fixed.cols();
    start.configuration += fingerprint("fixed", fixed);
    start.places = joined(fixed, start.places);
  } else {
    const Points3 fixed = read_points(request, request.fixed, start.fixed_file);
    start.fixed = fixed.cols();
    start.configuration += fingerprint("fixed", fixed);
    start.points = joined(fixed, start.points);
  }
}

void require_free(const CvtRequest& request, const CvtStart& start) {
  if (!request.cells || start.fixed < *request.cells)
    return;
  const std::int64_t last = *request.cells - 1;
  const auto& [name, lines] = start.fixed_file;
  const std::string line = last < std::ssize(lines)
                               ? " line " + std::to_string(lines[static_cast<std::size_t>(last)])
                               : "";
  throw Error(ErrorCode::bad_option, name + line + (name.empty() ? "" : ": ") + "fixed point " +
                                         std::to_string(last) + " leaves no free one of the " +
                                         std::to_string(*request.cells) +
                                         " cells; give more cells or fewer fixed points");
}

void rethrow_with_line(const Error& error, const CvtStart& start) {
  if (error.index() < start.fixed)
    rethrow_with_line(error, start.fixed_file.name, start.fixed_file.lines);
  std::vector<std::int64_t> lines(static_cast<std::size_t>(start.fixed), 0);
  lines.insert(lines.end(), start.file.lines.begin(), start.file.lines.end());
  rethrow_with_line(error, start.file.name, lines);
}

} // namespace calotte::tools
