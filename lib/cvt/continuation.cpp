// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>
#include <calotte/generators.h>

#include "base/require.h"
#include "cvt/free_points.h"
#include "cvt/region_world.h"
#include "cvt/room.h"
#include "cvt/worlds.h"
#include "generators/room.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace calotte {
namespace {

/// The level of the bisected icosahedron of n = 10 * 4^level + 2 points.
std::optional<int> icosahedral_level(std::int64_t n) {
  int level = 0;
  std::int64_t tens = n - 2;
  for (; tens % 4 == 0 && tens > 10; tens /= 4)
    ++level;
  return tens == 10 ? std::optional(level) : std::nullopt;
}

constexpr std::int64_t fewest_at_start = 160;

/// With fewer, cells of five neighbours are so near to each other that a descent may change the
/// neighbours of cells.
constexpr std::int64_t fewest_geodesic = 150;

/// Halves the number of cells along both axes while enough are left. Returns how often.
template <class World> int coarsen(std::int64_t& cells, std::int64_t least) {
  int levels = 0;
  for (; World::halved(cells) >= least; cells = World::halved(cells))
    ++levels;
  return levels;
}

void require_room(std::int64_t cells, std::int64_t fixed) {
  base_detail::require(fixed < cells, "there are " + std::to_string(fixed) +
                                          " fixed generators; give fewer than the " +
                                          std::to_string(cells) + " cells");
}

/// The least number of generators on a level with some fixed ones.
std::int64_t least_with(std::int64_t fixed) { return std::max(fewest_at_start, 4 * fixed); }

/// How many points that follow a density spread over the sphere: on average 12 lie in the emptiest
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

/// How many generators of a density leave no empty circle as wide as half of a periodic box, which
/// would hold no triangulation: the largest of independent random points has a diameter of
/// about 2.5 spacings. 0 of other domains.
std::int64_t spreading(const Density& density, const PlanarDomain& domain) {
  if (!domain.periodic())
    return 0;
  constexpr double spacings_across = 6;
  const DoubleVector rho =
      evaluate(density, domain, random_places(1 << 14, domain)).cwiseMax(1e-150);
  const double root = area(domain) * rho.cwiseSqrt().mean(),
               widest = domain.period.minCoeff() / spacings_across;
  const double cells =
      2 / std::numbers::sqrt3 * root / (std::sqrt(rho.minCoeff()) * widest * widest);
  return static_cast<std::int64_t>(
      std::ceil(std::min(cells, double(generators_detail::most_points))));
}

} // namespace

Continuation continuation(std::int64_t cells, const Density& density, std::uint64_t seed) {
  base_detail::require_count(cells, 12, "the number of cells");
  evaluate(density, bisected_icosahedron(
                        0)); // throws for an ill-formed density, even if the start does not use it
  const std::int64_t least = density.uniform() ? 12 : 642;
  Continuation result;
  if (density.uniform() && cells >= fewest_geodesic) {
    result.start = geodesic_sphere(cells);
    return result;
  }
  std::int64_t n = cells;
  for (; (n - 2) % 4 == 0 && (n - 2) / 4 + 2 >= least; n = (n - 2) / 4 + 2)
    ++result.bisections;
  const std::optional<int> level = icosahedral_level(n);
  result.icosahedral = level.has_value();
  if (level)
    result.start = bisected_icosahedron(*level);
  else
    result.start =
        density.uniform() ? fibonacci_sphere(n) : random_sphere(n, site_density(density), seed);
  return result;
}

Continuation multilevel(std::int64_t cells, const Density& density, std::uint64_t seed,
                        const Points3& fixed) {
  base_detail::require_count(cells, cvt_detail::SphericalWorld::fewest, "the number of cells");
  require_room(cells, fixed.cols());
  Continuation result;
  const Density sites = site_density(density);
  result.bisections = coarsen<cvt_detail::SphericalWorld>(
      cells, std::max(least_with(fixed.cols()), spreading(sites)));
  result.start = cvt_detail::free_points(cells - fixed.cols(), cells, fixed, Region{}, sites, seed);
  return result;
}

Continuation multilevel(std::int64_t cells, const Region& region, const Density& density,
                        std::uint64_t seed, const Points3& fixed) {
  if (region.whole())
    return multilevel(cells, density, seed, fixed);
  base_detail::require_count(cells, cvt_detail::RegionWorld::fewest, "the number of cells");
  require_room(cells, fixed.cols());
  Continuation result;
  result.bisections = coarsen<cvt_detail::RegionWorld>(cells, least_with(fixed.cols()));
  result.start = cvt_detail::free_points(cells - fixed.cols(), cells, fixed, region,
                                         site_density(density), seed);
  return result;
}

PlanarContinuation multilevel(std::int64_t cells, const PlanarDomain& domain,
                              const Density& density, std::uint64_t seed, const Points2& fixed) {
  base_detail::require_count(cells, cvt_detail::PlanarWorld::fewest, "the number of cells");
  require_room(cells, fixed.cols());
  PlanarContinuation result;
  result.bisections = coarsen<cvt_detail::PlanarWorld>(
      cells, std::max(least_with(fixed.cols()), spreading(density, domain)));
  result.start = cvt_detail::free_points(cells - fixed.cols(), cells, fixed, domain,
                                         site_density(density, domain), seed);
  return result;
}

} // namespace calotte
