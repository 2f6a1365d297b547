// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_start.h"

#include "options/format_options.h"
#include "options/numbers.h"
#include "options/region_option.h"
#include "run/start_files.h"

#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/io.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace calotte::tools {
namespace {

constexpr std::int64_t fewest = 12; ///< cells of a CVT

[[noreturn]] void refuse(const std::string& problem) {
  throw Error(ErrorCode::bad_option, problem);
}

bool seeded(const std::string& kind) {
  return kind == "multilevel" || kind == "continuation" || kind == "random" || kind == "density";
}

bool chooses_bisections(const std::string& kind) {
  return kind == "multilevel" || kind == "continuation";
}

/// The number of cells after bisections of n: n -> 4n - 6.
std::int64_t bisected(std::int64_t n, int bisections) { return ((n - 2) << (2 * bisections)) + 2; }

/// The start from which that number of bisections reaches `cells`; 0 if there is none.
std::int64_t start_count(std::int64_t cells, int bisections) {
  const std::int64_t count = ((cells - 2) >> (2 * bisections)) + 2;
  return count >= fewest && bisected(count, bisections) == cells ? count : 0;
}

/// The level of the bisected icosahedron with that number of points, or -1.
int level_of(std::int64_t count) {
  int level = 0;
  while (bisected(fewest, level) < count)
    ++level;
  return bisected(fewest, level) == count ? level : -1;
}

/// "the nearest counts are ...": those of `below` and `above` that a run can have.
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

/// In a periodic box n cells become 4n; elsewhere midpoints outside the domain are omitted.
void require_planar_cells(const CvtRequest& request) {
  const std::int64_t cells = *request.cells,
                     divisor = std::int64_t{1} << (2 * request.bisections.value_or(0));
  const std::string bisections = "--bisections " + std::to_string(request.bisections.value_or(0));
  if (cells / divisor < 3)
    refuse(bisections + " to " + std::to_string(cells) +
           " cells requires a start of fewer than 3 cells; give more cells or fewer bisections");
  if (request.domain->periodic && cells % divisor != 0)
    refuse(bisections + " does not lead to " + std::to_string(cells) + " cells; " +
           nearest(cells / divisor * divisor, (cells / divisor + 1) * divisor, 3 * divisor));
}

/// Rejects options that a planar run does not support, and those that only a planar run supports.
void require_kind(const CvtRequest& request) {
  const std::string kind = start_kind(request);
  const bool both = kind == "multilevel" || kind == "random" || kind == "density",
             plane = planar(request);
  if (!request.part.region.empty() && !both)
    refuse("--start " + kind +
           " applies to the whole sphere only; give multilevel, density or random");
  if (!request.fixed.empty() && !both)
    refuse("--start " + kind +
           " does not leave room for fixed points; give multilevel, density or random");
  if (plane && !both && kind != "hexagonal")
    refuse("--start " + kind +
           " applies to the sphere only; give multilevel, density, random or hexagonal");
  if (!plane && kind == "hexagonal")
    refuse("--start hexagonal applies to the plane only; give --domain, --rectangle or --periodic");
}

/// Puts generators on the boundary after the other fixed ones.
void add_boundary(const CvtRequest& request, const Region& region, const Density& density,
                  CvtStart& start) {
  const Points3 shore = boundary_points(region, *request.cells, density);
  start.fixed += shore.cols();
  start.on_boundary = shore.cols();
  start.points = joined(start.points, shore);
  start.configuration += "boundary generators\n";
}

void require_cells(const CvtRequest& request) {
  const std::string kind = start_kind(request);
  require_kind(request);
  if (request.cells_of_widths && !request.density->widths.in_km())
    refuse("--cells auto requires cell widths; give --cell-width, or a number of cells");
  if (!request.cells && !cells_follow(request))
    refuse("no start: give a file of points, or the number of cells (--cells N), or cell widths "
           "(--cell-width 60km)");
  if (request.lonlat && request.fixed.empty())
    refuse("--lonlat applies to a file of points only; leave it out");
  if (request.seed && !seeded(kind))
    refuse("--seed applies to the starts multilevel, continuation, random and density only; leave "
           "it out");
  if (request.bisections && chooses_bisections(kind))
    refuse("--start " + kind + " chooses the bisections; leave --bisections out");
  if (request.insertion_rounds && kind != "multilevel")
    refuse("--insertion-rounds applies to --start multilevel only; leave it out");
  if (!request.cells) // see settle_cells
    return;
  if (planar(request) && kind != "multilevel")
    require_planar_cells(request);
  else if (planar(request) || !request.part.region.empty())
    return;
  else if (*request.cells < fewest)
    refuse("--cells " + std::to_string(*request.cells) + " is too few; give at least " +
           std::to_string(fewest));
  else if (kind == "icosahedron")
    require_icosahedral(*request.cells, request.bisections.value_or(0));
  else if (!chooses_bisections(kind))
    require_bisected(*request.cells, request.bisections.value_or(0));
}

void require_file(const CvtRequest& request) {
  if (request.fixed == "-" && request.points == "-")
    refuse("START and --fixed are both standard input; give a file for one of them");
  const auto exclude = [&](bool given, const std::string& option) {
    if (given)
      refuse("the start is the file " + request.points + "; leave " + option + " out");
  };
  exclude(request.cells.has_value() || request.cells_of_widths, "--cells");
  exclude(request.start.has_value(), "--start");
  exclude(request.seed.has_value(), "--seed");
  exclude(request.insertion_rounds.has_value(), "--insertion-rounds");
}

/// Describes the start of a continuation of a density to a number that no bisected icosahedron has.
std::string note_on(const Continuation& start, std::int64_t cells, const Density& density) {
  if (start.icosahedral || density.uniform())
    return "";
  const std::string points = std::to_string(start.start.cols()) + " points drawn from the density";
  const std::string times = start.bisections == 0 ? ""
                            : start.bisections == 1
                                ? ", bisected once"
                                : ", bisected " + std::to_string(start.bisections) + " times";
  return std::to_string(cells) + " cells is not 10 x 4^k + 2: the start is " + points + times;
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
  if (kind == "geodesic")
    return geodesic_sphere(count);
  return bisected_icosahedron(level_of(count));
}

Points2 generate(const std::string& kind, std::int64_t count, const PlanarDomain& domain,
                 const Density& density, std::uint64_t seed) {
  if (kind == "hexagonal")
    return hexagonal_lattice(count, domain);
  if (kind == "random")
    return random_places(count, domain, seed);
  return random_places(count, domain, site_density(density, domain), seed);
}

std::uint64_t seed_of(const CvtRequest& request) { return request.seed.value_or(1); }

std::string configuration_of_start(const CvtRequest& request) {
  const std::string kind = start_kind(request);
  return "start " + kind + "\ncells " + std::to_string(*request.cells) + "\n" +
         (seeded(kind) ? "seed " + std::to_string(seed_of(request)) + "\n" : "");
}

/// Sets a number of cells that follows from widths to that which fixed points leave.
void count_beside_fixed(CvtRequest& request, const Density& density,
                        const std::optional<PlanarDomain>& domain,
                        const std::optional<RunRegion>& region, CvtStart& start) {
  if (request.fixed.empty() || !cells_follow(request))
    return;
  request.cells =
      static_cast<int>(domain ? cells_beside(start.places, *request.cells, density, *domain)
                              : cells_beside(start.points, *request.cells, density,
                                             region ? region->meshed : Region{}));
  start.note = std::to_string(start.fixed) + " fixed points leave room for " +
               std::to_string(*request.cells - start.fixed) +
               " free ones: " + std::to_string(*request.cells) + " cells";
}

/// Sets the points and bisections of a start that insertion leads to any number of cells.
void make_multilevel(const CvtRequest& request, const Density& density,
                     const std::optional<PlanarDomain>& domain,
                     const std::optional<RunRegion>& region, CvtStart& start) {
  if (domain) {
    PlanarContinuation from =
        multilevel(*request.cells, *domain, density, seed_of(request), start.places);
    start.bisections = from.bisections;
    start.places = joined(start.places, from.start);
  } else {
    Continuation from = multilevel(*request.cells, region ? region->meshed : Region{}, density,
                                   seed_of(request), start.points);
    start.bisections = from.bisections;
    start.points = joined(start.points, from.start);
  }
}

/// Sets the number of cells to that of the widths in a region.
std::vector<std::string> settle_region(CvtRequest& request, const Resolution& resolution,
                                       const RunRegion& region) {
  if (!cells_follow(request))
    return {};
  const RegionWords& part = request.part;
  request.cells_of_widths = true;
  request.cells = cells_of_region(part, request.density->widths, resolution, region);
  return {part.region + " requires " + std::to_string(*request.cells) + " cells" +
          (part.limited_area ? ", with those of the rings and some beyond" : "")};
}

/// The same in a domain of the plane.
std::vector<std::string> settle_domain(CvtRequest& request, const Resolution& resolution,
                                       const PlanarDomain& domain) {
  if (!resolution.planar_widths)
    return {};
  const WidthWords& words = request.density->widths;
  require_covering(*resolution.planar_widths, domain);
  const double implied = implied_cells(*resolution.planar_widths, domain);
  if (cells_follow(request)) {
    constexpr double least = 3, most = 1 << 30;
    if (!(std::round(implied) >= least && std::round(implied) <= most))
      refuse("--cells auto: the widths require " + formatted("%.4g", implied) +
             " cells, but a mesh has 3 to 1073741824; give widths in the unit of the domain");
    request.cells_of_widths = true;
    request.cells = static_cast<int>(std::lround(implied));
    require_cells(request);
  }
  return notes_on(*resolution.planar_widths, words, implied, request.cells);
}

} // namespace

int rounds_of(const CvtRequest& request) {
  return request.insertion_rounds.value_or(request.fixed.empty() ? usual_insertion_rounds
                                                                 : insertion_rounds_beside_fixed);
}

void require_start(const CvtRequest& request) {
  require_region_words(request.part);
  if (ends_at_boundary(request.part) && !request.points.empty())
    refuse("--boundary generators does not apply to a file of points; give --cells, or fixed "
           "points on the boundary (--fixed)");
  if (planar(request) && request.lonlat)
    refuse("--lonlat applies to the sphere only; leave it out");
  if (request.points.empty())
    require_cells(request);
  else
    require_file(request);
}

std::vector<std::string> settle_cells(CvtRequest& request, const Resolution& resolution,
                                      const std::optional<RunRegion>& region,
                                      const std::optional<PlanarDomain>& domain) {
  if (domain)
    return settle_domain(request, resolution, *domain);
  const std::optional<CellWidth>& widths = resolution.widths;
  if (!widths)
    return {};
  if (region)
    return settle_region(request, resolution, *region);
  const WidthWords& words = request.density->widths;
  if (cells_follow(request)) {
    request.cells_of_widths = true;
    request.cells =
        static_cast<int>(cells_for(*widths, words, start_kind(request) == "continuation"));
    require_cells(request);
  }
  return notes_on(*widths, words, request.cells);
}

CvtStart open_start(CvtRequest& request, const Density& density,
                    const std::optional<PlanarDomain>& domain,
                    const std::optional<RunRegion>& region) {
  CvtStart start = request.points.empty() ? CvtStart{} : read_start(request);
  add_fixed(request, start);
  if (ends_at_boundary(request.part))
    add_boundary(request, region->meshed, density, start);
  count_beside_fixed(request, density, domain, region, start);
  if (request.points.empty())
    start.configuration = configuration_of_start(request) + start.configuration;
  require_free(request, start);
  start.bisections = request.bisections.value_or(0);
  if (const std::string kind = start_kind(request); kind == "multilevel")
    start.configuration += "insertion-rounds " + std::to_string(rounds_of(request)) + "\n";
  else if (!chooses_bisections(kind)) // whose bisections follow from cells and density
    start.configuration += "bisections " + std::to_string(start.bisections) + "\n";
  if (planar(request))
    start.configuration += domain_configuration(*request.domain);
  if (region)
    start.configuration += region_configuration(region->meshed);
  return start;
}

void generate_points(const CvtRequest& request, const Density& density,
                     const std::optional<PlanarDomain>& domain,
                     const std::optional<RunRegion>& region, CvtStart& start) {
  if (!request.points.empty())
    return;
  const std::string kind = start_kind(request);
  const std::int64_t cells = *request.cells;
  if (kind == "multilevel") {
    make_multilevel(request, density, domain, region, start);
    return;
  }
  const bool open = domain || region;
  const std::int64_t count = (open                     ? cells >> (2 * start.bisections)
                              : kind == "continuation" ? cells
                                                       : start_count(cells, start.bisections)) -
                             start.fixed;
  if (count < 1)
    refuse("--bisections " + std::to_string(start.bisections) + " to " + std::to_string(cells) +
           " cells leave no free point in the start beside " + std::to_string(start.fixed) +
           " fixed ones; give more cells or fewer bisections");
  if (domain) {
    start.places = joined(start.places, generate(kind, count, *domain, density, seed_of(request)));
    return;
  }
  if (region) {
    start.points =
        joined(start.points, random_sphere(count, region->meshed,
                                           kind == "density" ? site_density(density) : Density{},
                                           seed_of(request)));
    return;
  }
  if (kind != "continuation") {
    start.points = joined(start.points, generate(kind, count, density, seed_of(request)));
    return;
  }
  Continuation from = continuation(cells, density, seed_of(request));
  start.note = note_on(from, cells, density);
  start.bisections = from.bisections;
  start.points = std::move(from.start);
}

} // namespace calotte::tools
