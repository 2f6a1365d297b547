// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/centres.h"

#include "base/message.h"
#include "base/require.h"
#include "delaunay/owners.h"
#include "exact/predicates.h"

#include <calotte/generators.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace calotte::delaunay_detail {
namespace {

/// Sites at even steps along the curve: a sample that follows any density.
struct Sample {
  Array<Vec3> unit;
  Quadtree cells;
  Array<double> density; ///< of samples around each, up to a factor
};

/// The density at samples, from the mean step along the curve over a few samples before and after
/// each.
Array<double> densities(const Array<Vec3>& unit) {
  constexpr std::int64_t reach = 8;
  Array<double> density(unit.size());
  for (std::int64_t s = 0; s < unit.size(); ++s) {
    const std::int64_t begin = std::max<std::int64_t>(0, s - reach);
    const std::int64_t end = std::min(unit.size() - 1, s + reach);
    double length = 1e-15; // samples may differ by less than rounding
    for (std::int64_t t = begin; t < end; ++t)
      length += norm(unit[t + 1] - unit[t]);
    const double inverse = static_cast<double>(end - begin) / length;
    density[s] = inverse * inverse;
  }
  return density;
}

Sample take_sample(const Sites& sites, std::int64_t count) {
  count = std::min(count, sites.size());
  Array<Vec3> unit(count);
  Array<std::uint64_t> keys(count);
  for (std::int64_t s = 0; s < count; ++s) {
    const std::int64_t rank = (2 * s + 1) * sites.size() / (2 * count);
    unit[s] = sites.unit[rank];
    keys[s] = sites.cells.keys()[rank];
  }
  Array<double> density = densities(unit);
  return {std::move(unit), Quadtree(std::move(keys), sites.frame.has_value()), std::move(density)};
}

/// Moves each centre to the mean of the samples it owns, on the sphere to its direction. A centre
/// that owns no samples, or whose mean has no direction, stays. Each sample has the weight of the
/// density there: the centres of a CVT are distributed as the square root of the density that it
/// integrates (Gersho, IEEE Trans. Inf. Theory 25, 1979), here samples times weights, and thus as
/// the sites are.
void move_to_means(const Sample& sample, const Array<std::int32_t>& owner, bool planar,
                   std::vector<Vec3>& centres) {
  std::vector<Vec3> sum(centres.size(), Vec3{0, 0, 0});
  std::vector<double> weight(centres.size(), 0);
  for (std::int64_t s = 0; s < owner.size(); ++s) {
    const auto k = static_cast<std::size_t>(owner[s]);
    sum[k] = sum[k] + sample.density[s] * sample.unit[s];
    weight[k] += sample.density[s];
  }
  for (std::size_t k = 0; k < centres.size(); ++k)
    if (const double length = planar ? weight[k] : norm(sum[k]); length > 1e-9 * weight[k])
      centres[k] = (1 / length) * sum[k];
}

/// Moves each centre towards the neighbours that own more samples than it does, and away from those
/// that own fewer: a region shrinks as the centres of its neighbours approach. Two centres are
/// neighbours if the curve passes between their regions, with the number of passages as weight.
void move_to_load(const Sample& sample, const Array<std::int32_t>& owner, bool planar,
                  std::vector<Vec3>& centres) {
  std::vector<double> load(centres.size(), 0), passages(centres.size(), 0); // load 1 is the mean
  for (const std::int32_t k : owner)
    load[static_cast<std::size_t>(k)] +=
        static_cast<double>(centres.size()) / static_cast<double>(sample.unit.size());
  std::vector<Vec3> way(centres.size(), Vec3{0, 0, 0});
  for (std::int64_t s = 0; s + 1 < owner.size(); ++s) {
    const auto k = static_cast<std::size_t>(owner[s]), m = static_cast<std::size_t>(owner[s + 1]);
    if (k == m)
      continue;
    const double excess = std::clamp(load[m] - load[k], -0.25, 0.25);
    const Vec3 pull = excess * (centres[m] - centres[k]);
    for (const std::size_t both : {k, m}) {
      way[both] = way[both] + pull;
      ++passages[both];
    }
  }
  // A cell of a hexagonal lattice loses its excess when its six neighbours move by half of it, in
  // units of their distance. Each neighbour sees the excess in a sixth of its passages, so that the
  // factor would be 3. Half of that does not overshoot if neighbours have excesses, too.
  constexpr double rate = 1.5;
  for (std::size_t k = 0; k < centres.size(); ++k)
    if (passages[k] > 0) {
      const Vec3 moved = centres[k] + (rate / passages[k]) * way[k];
      centres[k] = planar ? moved : normalised(moved);
    }
}

/// A Fibonacci lattice over the bounding box of the sites; it ignores their density.
std::vector<Vec3> plane_lattice(const Frame& frame, int regions) {
  constexpr double golden = 0.6180339887498949;
  std::vector<Vec3> centres;
  for (int k = 0; k < regions; ++k) {
    const double turns = k * golden;
    centres.push_back({std::lerp(frame.low.x, frame.high.x, turns - std::floor(turns)),
                       std::lerp(frame.low.y, frame.high.y, (k + 0.5) / regions), 0});
  }
  return centres;
}

/// A coarse CVT of a sample, whose regions own about equal numbers of sites. It starts from equal
/// parts of the curve; a few steps make the cells round, and a few more equalise the numbers.
std::vector<Vec3> sampled_centres(const Sites& sites, int regions) {
  const Sample sample = take_sample(sites, std::int64_t{128} * regions);
  std::vector<Vec3> centres(static_cast<std::size_t>(regions), sample.unit[0]);
  Array<std::int32_t> owner(sample.unit.size());
  for (std::int64_t s = 0; s < owner.size(); ++s)
    owner[s] = static_cast<std::int32_t>(s * regions / owner.size());
  const bool planar = sites.frame.has_value();
  move_to_means(sample, owner, planar, centres);
  constexpr int steps = 4;
  for (const auto move : {move_to_means, move_to_load})
    for (int step = 0; step < steps; ++step) {
      owner = owners(sample.cells, sample.unit, centres);
      move(sample, owner, planar, centres);
    }
  return centres;
}

std::vector<Vec3> columns(const PointsRef& points, const std::optional<Frame>& plane) {
  require(points.rows() == 3 || (plane && points.rows() == 2),
          "the regions' centres have {}; give {}", counted(points.rows(), "row"),
          plane ? "2 x k columns x y" : "3 x k columns x y z");
  std::vector<Vec3> out(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const Vec3 p{points(0, k), points(1, k), plane ? 0 : points(2, k)};
    if (plane && is_finite(p)) {
      out[static_cast<std::size_t>(k)] = (*plane)(p.x, p.y);
      continue;
    }
    if (!is_finite(p) || is_zero(p))
      refuse_at(k, "region centre {} has no direction: give finite, non-zero centres");
    const double scale = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const Vec3 q{p.x / scale, p.y / scale, p.z / scale};
    out[static_cast<std::size_t>(k)] = (1 / norm(q)) * q;
  }
  return out;
}

} // namespace

int default_region_count(std::int64_t sites) {
  constexpr std::int64_t whole = 4096, a_region = 16384, least = 12;
  if (sites < whole)
    return 1;
  return static_cast<int>(std::max(least, sites / a_region));
}

std::vector<Vec3> make_centres(const Sites& sites, const Decomposition& decomposition) {
  if (decomposition.given_centres) {
    require(decomposition.given_centres->cols() > 0,
            "no region centre is given; give at least one");
    return columns(*decomposition.given_centres, sites.frame);
  }
  const int regions = decomposition.regions.value_or(default_region_count(sites.size()));
  require(regions >= 1, "the number of regions is {}: give at least 1", regions);
  // More regions than sites would own no sites; their centres would only cost time and memory.
  const auto useful = static_cast<int>(std::min<std::int64_t>(regions, sites.size()));
  if (decomposition.centres == RegionCentres::fibonacci)
    return sites.frame ? plane_lattice(*sites.frame, useful)
                       : columns(fibonacci_sphere(useful), std::nullopt);
  return sampled_centres(sites, useful);
}

} // namespace calotte::delaunay_detail
