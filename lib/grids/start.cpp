// SPDX-License-Identifier: GPL-3.0-or-later
#include "grids/start.h"

#include "base/message.h"
#include "base/points.h"
#include "base/require.h"
#include "cvt/levels.h"
#include "domain/surface.h"
#include "generators/room.h"
#include "grids/free_points.h"

#include <calotte/generators.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace calotte::grids_detail {
namespace {

using base_detail::require;
using base_detail::with_z;
using cvt_detail::bisected;
using cvt_detail::fewest_generators;

/// The minimum number of generators of a geodesic start. With fewer, cells of five neighbours are
/// so near to each other that a descent may change the neighbours of cells.
constexpr std::int64_t fewest_geodesic = 150;

bool is_icosahedral(std::int64_t n) {
  std::int64_t tens = n - 2;
  while (tens % 4 == 0 && tens > 10)
    tens /= 4;
  return tens == 10;
}

int icosahedral_level(std::int64_t n) {
  const Surface sphere = Surface::sphere();
  int level = 0;
  while (bisected(sphere, fewest_generators(sphere), level) < n)
    ++level;
  return level;
}

/// The number of points distributed as a density of which on average 12 lie in the emptiest
/// hemisphere. A descent from fewer may lose the last of these, so that no triangulation exists.
std::int64_t spreading(const Density& sites) {
  constexpr double in_hemisphere = 12;
  const Points3 samples = bisected_icosahedron(5), directions = bisected_icosahedron(1);
  const DoubleVector weights = evaluate(sites, samples);
  double least = 1; // share of a hemisphere
  for (const auto& direction : directions.colwise()) {
    const auto inside = direction.transpose().lazyProduct(samples).array() > 0;
    least = std::min(least, inside.select(weights.transpose().array(), 0).sum() / weights.sum());
  }
  return least * static_cast<double>(generators_detail::most_points) > in_hemisphere
             ? static_cast<std::int64_t>(std::ceil(in_hemisphere / least))
             : generators_detail::most_points;
}

/// The number of generators of a density that leave no empty circle as wide as half of a periodic
/// box, with which no triangulation exists. The largest empty circle of independent random points
/// has a diameter of about 2.5 spacings. 0 for other planes.
std::int64_t spreading_in_plane(const Density& density, const Surface& surface) {
  if (surface.is_bounded())
    return 0;
  constexpr double spacings_across = 6;
  const DoubleVector rho =
      evaluate(density, random_points(1 << 14, surface), surface).cwiseMax(1e-150);
  const double root = surface.area() * rho.cwiseSqrt().mean(),
               widest = surface.period().minCoeff() / spacings_across;
  const double cells =
      2 / std::numbers::sqrt3 * root / (std::sqrt(rho.minCoeff()) * widest * widest);
  return static_cast<std::int64_t>(
      std::ceil(std::min(cells, double(generators_detail::most_points))));
}

/// "the nearest numbers are ...": those of `below` and `above` that a run can have.
std::string nearest(std::int64_t below, std::int64_t above, std::int64_t least) {
  return below < least ? base_detail::message("the nearest number is {}", std::max(above, least))
                       : base_detail::message("the nearest numbers are {} and {}", below, above);
}

std::string words_of(int bisections) {
  return base_detail::message("{} bisection{}", bisections, bisections == 1 ? "" : "s");
}

std::string not_leading(int bisections, std::int64_t cells) {
  return base_detail::message("{} {} not lead to {} cells; ", words_of(bisections),
                              bisections == 1 ? "does" : "do", cells);
}

void require_icosahedral(std::int64_t cells, int bisections) {
  const Surface sphere = Surface::sphere();
  const std::int64_t fewest = fewest_generators(sphere);
  if (is_icosahedral(cells) && icosahedral_level(cells) >= bisections)
    return;
  const int level = std::max(icosahedral_level(cells), bisections);
  require(false, "the start icosahedron makes 10 x 4^k + 2 cells, not {}; {}", cells,
          nearest(level == bisections ? 0 : bisected(sphere, fewest, level - 1),
                  bisected(sphere, fewest, level), fewest));
}

/// The number of generators from which bisections lead to a number of cells of the whole sphere.
std::int64_t start_on_sphere(std::int64_t cells, int bisections) {
  const Surface sphere = Surface::sphere();
  const std::int64_t n = ((cells - 2) >> (2 * bisections)) + 2, fewest = fewest_generators(sphere);
  require(n >= fewest && bisected(sphere, n, bisections) == cells,
          not_leading(bisections, cells) + nearest(bisected(sphere, n, bisections),
                                                   bisected(sphere, n + 1, bisections),
                                                   bisected(sphere, fewest, bisections)));
  return n;
}

/// The same in a plane: in a box n cells become 4n; elsewhere midpoints outside are not added.
std::int64_t start_in_plane(std::int64_t cells, int bisections, bool box) {
  const std::int64_t divisor = std::int64_t{1} << (2 * bisections), n = cells / divisor;
  require(n >= fewest_generators(Surface::plane()),
          "{} to {} cells need a start of fewer than 3 cells; give more cells or fewer bisections",
          words_of(bisections), cells);
  require(!box || cells % divisor == 0,
          not_leading(bisections, cells) + nearest(n * divisor, (n + 1) * divisor, 3 * divisor));
  return n;
}

} // namespace

FirstLevel first_of_continuation(std::int64_t cells, bool uniform) {
  if (uniform && cells >= fewest_geodesic)
    return {CvtStart::Kind::geodesic, cells, 0};
  const std::int64_t least = uniform ? fewest_generators(Surface::sphere()) : fewest_graded;
  FirstLevel first{CvtStart::Kind::density, cells, 0};
  std::int64_t& n = first.cells;
  for (; (n - 2) % 4 == 0 && (n - 2) / 4 + 2 >= least; n = (n - 2) / 4 + 2)
    ++first.bisections;
  if (is_icosahedral(n))
    first.kind = CvtStart::Kind::icosahedron;
  else if (uniform)
    first.kind = CvtStart::Kind::fibonacci;
  return first;
}

FirstLevel first_of_multilevel(std::int64_t cells, const Surface& surface, const Density& density,
                               std::int64_t fixed, std::int64_t on_boundary) {
  constexpr std::int64_t fewest_at_start = 160;
  std::int64_t least = std::max(fewest_at_start, 4 * fixed);
  if (!surface.is_sphere())
    least = std::max(least, spreading_in_plane(density, surface));
  else if (!surface.is_bounded())
    least = std::max(least, spreading(site_density(density)));
  FirstLevel first{CvtStart::Kind::density, cells, 0};
  const auto at = [&](int bisections) {
    return cvt_detail::generators_of_level(surface, cells, bisections, on_boundary);
  };
  while (at(first.bisections + 1) >= least)
    ++first.bisections;
  first.cells = at(first.bisections);
  return first;
}

FirstLevel first_of_kind(CvtStart::Kind kind, std::int64_t cells, int bisections,
                         const Surface& surface, std::int64_t fixed) {
  FirstLevel first{kind, cells, bisections};
  if (!surface.is_sphere())
    first.cells = start_in_plane(cells, bisections, surface.is_box());
  else if (surface.is_bounded())
    first.cells = cells >> (2 * bisections);
  else if (kind == CvtStart::Kind::icosahedron)
    require_icosahedral(cells, bisections);
  if (surface.is_whole_sphere())
    first.cells = start_on_sphere(cells, bisections);
  require(first.cells > fixed,
          "{} to {} cells leave no free point in the start beside {} fixed ones; give more cells "
          "or fewer bisections",
          words_of(bisections), cells, fixed);
  return first;
}

Points3 free_generators(const Schedule& schedule) {
  const Recipe& recipe = schedule.recipe;
  const Surface& surface = recipe.surface;
  const std::int64_t count = schedule.actions.front().cells - recipe.fixed.cols();
  const Density sites = site_density(schedule.density, surface);
  if (recipe.start.kind == CvtStart::Kind::multilevel)
    return free_points(count, schedule.actions.front().cells, recipe.fixed, surface, sites,
                       recipe.seed);
  switch (schedule.first) {
  case CvtStart::Kind::geodesic:
    return geodesic_sphere(count);
  case CvtStart::Kind::icosahedron:
    return bisected_icosahedron(icosahedral_level(count));
  case CvtStart::Kind::fibonacci:
    return fibonacci_sphere(count);
  case CvtStart::Kind::spiral:
    return spiral_sphere(count);
  case CvtStart::Kind::hexagonal:
    return hexagonal_lattice(count, surface);
  case CvtStart::Kind::random:
    return random_points(count, surface, {}, recipe.seed);
  default:
    return random_points(count, surface, sites, recipe.seed);
  }
}

std::int64_t cells_beside(const Points3& fixed, std::int64_t cells, const Density& density,
                          const Surface& surface) {
  return cells_beside_fixed(fixed, cells, surface, site_density(density, surface));
}

} // namespace calotte::grids_detail
