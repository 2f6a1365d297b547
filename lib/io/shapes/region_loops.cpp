// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "domain/surface.h"
#include "exact/predicates.h"
#include "io/bytes/text.h"
#include "io/shapes/region_file.h"

#include <calotte/error.h>

#include <cmath>
#include <optional>
#include <utility>

// Files of MPI-SCVT (Jacobsen et al., Geosci. Model Dev. 6, 2013): SaveBoundaries has a point on
// each line, longitude and latitude in degrees, or x y z; SaveLoopCounts has the numbers of the
// first and the last point of a loop on each line, counted from 1, or the number of its points.

namespace calotte::io_detail {
namespace {

Vec3 point_of(const LineReader& reader, std::string_view line) {
  const auto read = numbers_of(line);
  const bool lonlat = read && read->size() == 2, xyz = read && read->size() == 3;
  if (!lonlat && !xyz)
    reader.fail(in_quotes(line) +
                " is no point; write longitude and latitude in degrees, or x y z");
  const std::vector<double>& x = *read;
  if (lonlat && !(std::abs(x[0]) <= 720 && std::abs(x[1]) <= 90))
    reader.fail(in_quotes(line) + " is no longitude and latitude in degrees; correct it");
  if (xyz && x[0] == 0 && x[1] == 0 && x[2] == 0)
    reader.fail("the zero vector has no direction; remove the point or correct it");
  return lonlat ? from_lonlat(x[0], x[1]) : normalised({x[0], x[1], x[2]});
}

/// The points from `begin` on and before `end`, counted from 0.
struct Run {
  std::int64_t begin, end;
};

Run run_of(const LineReader& reader, std::string_view line, std::int64_t before,
           std::int64_t points) {
  const auto read = numbers_of(line);
  const bool counted = read && read->size() == 1;
  if (!read || read->size() > 2 || (*read)[0] != std::floor((*read)[0]) ||
      read->back() != std::floor(read->back()))
    reader.fail(in_quotes(line) +
                " is no loop; write the numbers of its first and last point, counted from 1");
  const double first = counted ? static_cast<double>(before) + 1 : read->front(),
               last = counted ? static_cast<double>(before) + read->front() : read->back();
  if (!(first >= 1) || !(last <= static_cast<double>(points)) || !(last - first >= 2))
    reader.fail(in_quotes(line) + " is no loop of three or more of the " + std::to_string(points) +
                " points; correct it");
  return {static_cast<std::int64_t>(first) - 1, static_cast<std::int64_t>(last)};
}

std::vector<Run> runs_of(std::istream& counts, const std::string& name, std::int64_t points) {
  LineReader reader(counts, name);
  std::vector<Run> runs;
  for (std::string_view line; reader.next_content(line);)
    runs.push_back(run_of(reader, line, runs.empty() ? 0 : runs.back().end, points));
  if (runs.empty())
    throw Error(ErrorCode::parse, name + ": no loops; write the numbers of the first and the last "
                                         "point of each, counted from 1");
  return runs;
}

} // namespace

Surface read_region_loops(std::istream& in, const std::string& name, std::istream* counts,
                          const std::string& counts_name) {
  LineReader reader(in, name);
  std::vector<Vec3> points;
  std::vector<std::int64_t> lines;
  for (std::string_view line; reader.next_content(line);) {
    points.push_back(point_of(reader, line));
    lines.push_back(reader.number());
  }
  if (points.size() < 3)
    throw Error(ErrorCode::parse, name + ": " + std::to_string(points.size()) +
                                      " points enclose nothing; give three at least");
  std::vector<WrittenRing> rings;
  for (const auto& [begin, end] : counts ? runs_of(*counts, counts_name, std::ssize(points))
                                         : std::vector<Run>{{0, std::ssize(points)}}) {
    rings.push_back(
        {{points.begin() + begin, points.begin() + end},
         "the loop that begins in line " + std::to_string(lines[static_cast<std::size_t>(begin)])});
    drop_repeated(rings.back().corners);
  }
  return named(name, [&] { return UncheckedSurface::of_sphere(corners_of(enclosed(rings))); });
}

} // namespace calotte::io_detail
