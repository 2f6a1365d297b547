// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt_start.h"

#include <calotte/error.h>
#include <calotte/generators.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <limits>

namespace calotte::tools {
namespace {

constexpr std::int64_t fewest = 12; ///< cells of a CVT

[[noreturn]] void refuse(const std::string& problem) {
  throw Error(ErrorCode::bad_option, problem);
}

std::string kind_of(const CvtRequest& request) {
  return request.points.empty() ? request.start.value_or("continuation") : "points";
}

bool seeded(const std::string& kind) {
  return kind == "continuation" || kind == "random" || kind == "density";
}

/// How many cells n become by so many bisections: n -> 4n - 6.
std::int64_t bisected(std::int64_t n, int bisections) { return ((n - 2) << (2 * bisections)) + 2; }

/// The count that so many bisections bring to `cells`, 0 where there is none.
std::int64_t start_count(std::int64_t cells, int bisections) {
  const std::int64_t count = ((cells - 2) >> (2 * bisections)) + 2;
  return count >= fewest && bisected(count, bisections) == cells ? count : 0;
}

/// The level of the bisected icosahedron with so many points, or -1.
int level_of(std::int64_t count) {
  int level = 0;
  while (bisected(fewest, level) < count)
    ++level;
  return bisected(fewest, level) == count ? level : -1;
}

/// "the nearest counts are ...": of `below` and `above` those that a run can have.
std::string nearest(std::int64_t below, std::int64_t above, std::int64_t least) {
  return below < least
             ? "the nearest count is " + std::to_string(std::max(above, least))
             : "the nearest counts are " + std::to_string(below) + " and " + std::to_string(above);
}

void require_bisected(std::int64_t cells, int bisections) {
  if (start_count(cells, bisections) != 0)
    return;
  const std::int64_t below = ((cells - 2) >> (2 * bisections)) + 2;
  refuse("--bisections " + std::to_string(bisections) + " does not lead to " +
         std::to_string(cells) + " cells; " +
         nearest(bisected(below, bisections), bisected(below + 1, bisections),
                 bisected(fewest, bisections)));
}

void require_icosahedral(std::int64_t cells, int bisections) {
  if (level_of(cells) >= bisections)
    return;
  int level = bisections;
  while (bisected(fewest, level) < cells)
    ++level;
  const std::int64_t below = level == bisections ? 0 : bisected(fewest, level - 1);
  refuse("--start icosahedron makes 10 x 4^k + 2 cells, not " + std::to_string(cells) + "; " +
         nearest(below, bisected(fewest, level), fewest));
}

void require_cells(const CvtRequest& request) {
  const std::string kind = kind_of(request);
  if (request.cells_of_widths && request.density->widths.file.empty())
    refuse("--cells auto is for cell widths; give --cell-width FILE, or a number of cells");
  if (!request.cells && !request.cells_of_widths)
    refuse("no start: give a file of points, or the number of cells (--cells N)");
  if (request.lonlat)
    refuse("--lonlat is for a file of points; leave it out");
  if (request.seed && !seeded(kind))
    refuse("--seed is for the starts continuation, random and density; leave it out");
  if (request.bisections && kind == "continuation")
    refuse("--start continuation chooses the bisections; leave --bisections out");
  if (!request.cells) // see settle_cells
    return;
  if (kind == "icosahedron")
    require_icosahedral(*request.cells, request.bisections.value_or(0));
  else if (kind != "continuation")
    require_bisected(*request.cells, request.bisections.value_or(0));
}

void require_file(const CvtRequest& request) {
  const auto exclude = [&](bool given, const std::string& option) {
    if (given)
      refuse("the start is the file " + request.points + "; leave " + option + " out");
  };
  exclude(request.cells.has_value() || request.cells_of_widths, "--cells");
  exclude(request.start.has_value(), "--start");
  exclude(request.seed.has_value(), "--seed");
}

/// Says what a continuation to a count that no bisected icosahedron has starts from.
std::string note_on(const Continuation& start, std::int64_t cells, const Density& density) {
  if (start.icosahedral)
    return "";
  const std::string points =
      std::to_string(start.start.cols()) +
      (density.uniform() ? " points of a Fibonacci lattice" : " points drawn from the density");
  const std::string times = start.bisections == 0 ? ""
                            : start.bisections == 1
                                ? ", to be bisected once"
                                : ", to be bisected " + std::to_string(start.bisections) + " times";
  return std::to_string(cells) + " cells are not 10 x 4^k + 2: starting from " + points + times;
}

Points3 generate(const std::string& kind, std::int64_t count, const Density& density,
                 std::uint64_t seed) {
  if (kind == "random")
    return random_sphere(count, seed);
  if (kind == "density")
    return random_sphere(count, site_density(density), seed);
  if (kind == "fibonacci")
    return fibonacci_sphere(count);
  if (kind == "spiral")
    return spiral_sphere(count);
  return bisected_icosahedron(level_of(count));
}

std::uint64_t seed_of(const CvtRequest& request) { return request.seed.value_or(1); }

CvtStart announce(const CvtRequest& request) {
  const std::string kind = kind_of(request);
  CvtStart start;
  start.configuration = "start " + kind + "\ncells " + std::to_string(*request.cells) + "\n" +
                        (seeded(kind) ? "seed " + std::to_string(seed_of(request)) + "\n" : "");
  return start;
}

CvtStart read(const CvtRequest& request) {
  CvtStart start;
  start.file = read_point_file(request.points, request.lonlat);
  const Points3& points = start.file.points;
  boost::crc_32_type checksum;
  checksum.process_bytes(points.data(), sizeof(double) * static_cast<std::size_t>(points.size()));
  start.configuration = "start points\npoints " + std::to_string(points.cols()) +
                        " with checksum " + std::to_string(checksum.checksum()) + "\n";
  return start;
}

} // namespace

void require_start(const CvtRequest& request) {
  if (request.points.empty())
    require_cells(request);
  else
    require_file(request);
}

std::vector<std::string> settle_cells(CvtRequest& request, const std::optional<CellWidth>& widths) {
  if (!widths)
    return {};
  const WidthWords& words = request.density->widths;
  if (request.cells_of_widths) {
    request.cells = static_cast<int>(cells_for(*widths, words, kind_of(request) == "continuation"));
    require_cells(request);
  }
  return notes_on(*widths, words, request.cells);
}

CvtStart open_start(const CvtRequest& request) {
  CvtStart start = request.points.empty() ? announce(request) : read(request);
  start.bisections = request.bisections.value_or(0);
  if (kind_of(request) != "continuation") // whose bisections follow from cells and density
    start.configuration += "bisections " + std::to_string(start.bisections) + "\n";
  return start;
}

void generate_points(const CvtRequest& request, const Density& density, CvtStart& start) {
  if (!request.points.empty())
    return;
  const std::string kind = kind_of(request);
  const std::int64_t cells = *request.cells;
  if (kind != "continuation") {
    start.file.points =
        generate(kind, start_count(cells, start.bisections), density, seed_of(request));
    return;
  }
  Continuation from = continuation(cells, density, seed_of(request));
  start.note = note_on(from, cells, density);
  start.bisections = from.bisections;
  start.file.points = std::move(from.start);
}

} // namespace calotte::tools
