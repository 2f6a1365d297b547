// SPDX-License-Identifier: GPL-3.0-or-later
#include "regions.h"

#include "cells.h"
#include "predicates.h"

#include <calotte/error.h>
#include <calotte/generators.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace calotte::detail {
namespace {

constexpr std::int64_t leaf_size = 16;

/// Cells of like size that together hold all sites, in the order of the curve: the tasks of a
/// descent.
std::vector<Cell> task_cells(const CellTree& tree) {
  const std::int64_t enough = tree.size() / 128 + leaf_size;
  std::vector<Cell> cells, pending;
  const auto push_reversed = [&](const auto& group) {
    for (auto it = group.rbegin(); it != group.rend(); ++it)
      if (it->size() > 0)
        pending.push_back(*it);
  };
  push_reversed(tree.faces());
  while (!pending.empty()) {
    const Cell cell = pending.back();
    pending.pop_back();
    if (cell.size() <= enough || !cell.divisible())
      cells.push_back(cell);
    else
      push_reversed(tree.children(cell));
  }
  return cells;
}

// ---- Owners

std::int32_t nearest(const Vec3& x, const std::vector<Vec3>& centres,
                     const std::vector<std::int32_t>& candidates) {
  std::int32_t best = candidates.front();
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t k : candidates) { // ascending: a tie stays with the lowest
    const Vec3 apart = x - centres[static_cast<std::size_t>(k)];
    if (const double square = dot(apart, apart); square < least) {
      best = k;
      least = square;
    }
  }
  return best;
}

/// Those candidates that may be nearest to a direction in the ball.
std::vector<std::int32_t> possible_owners(const Ball& ball, const std::vector<Vec3>& centres,
                                          const std::vector<std::int32_t>& candidates) {
  std::vector<double> distance(candidates.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    distance[c] = norm(ball.centre - centres[static_cast<std::size_t>(candidates[c])]);
    least = std::min(least, distance[c]);
  }
  std::vector<std::int32_t> possible;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    if (distance[c] <= least + 2 * ball.radius + 1e-14)
      possible.push_back(candidates[c]);
  return possible;
}

void own(const Cell& cell, const CellTree& tree, const Vec3* unit, const std::vector<Vec3>& centres,
         const std::vector<std::int32_t>& candidates, std::int32_t* owner) {
  const std::vector<std::int32_t> possible =
      possible_owners(bounding_ball(cell), centres, candidates);
  if (possible.size() == 1) {
    std::fill(owner + cell.begin, owner + cell.end, possible.front());
  } else if (cell.size() <= leaf_size || !cell.divisible()) {
    for (std::int64_t r = cell.begin; r != cell.end; ++r)
      owner[r] = nearest(unit[r], centres, possible);
  } else {
    for (const Cell& child : tree.children(cell))
      if (child.size() > 0)
        own(child, tree, unit, centres, possible, owner);
  }
}

std::vector<std::int32_t> all_of(const std::vector<Vec3>& centres) {
  std::vector<std::int32_t> all(centres.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k] = static_cast<std::int32_t>(k);
  return all;
}

/// The nearest centre of each of some directions sorted along the curve.
Array<std::int32_t> owners(const CellTree& tree, const Array<Vec3>& unit,
                           const std::vector<Vec3>& centres) {
  Array<std::int32_t> owner(unit.size());
  const std::vector<Cell> cells = task_cells(tree);
  const std::vector<std::int32_t> all = all_of(centres);
  for_each_task(std::ssize(cells), [&](std::int64_t c) {
    own(cells[static_cast<std::size_t>(c)], tree, unit.begin(), centres, all, owner.begin());
  });
  return owner;
}

// ---- Centres

/// Sites at even steps along the curve: a sample that follows any density.
struct Sample {
  Array<Vec3> unit;
  CellTree cells;
  Array<double> density; ///< of samples around each, but for a factor
};

/// From the mean step along the curve between a few samples before each and a few after it.
Array<double> densities(const Array<Vec3>& unit) {
  constexpr std::int64_t reach = 8;
  Array<double> density(unit.size());
  for (std::int64_t s = 0; s < unit.size(); ++s) {
    const std::int64_t begin = std::max<std::int64_t>(0, s - reach);
    const std::int64_t end = std::min(unit.size() - 1, s + reach);
    double length = 1e-15; // some of the samples may differ by less than rounding
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
  return {std::move(unit), CellTree(std::move(keys), sites.frame.has_value()), std::move(density)};
}

/// Moves each centre to the mean of the samples it owns, on the sphere to its direction; one that
/// owns none, or whose mean has no direction, stays. Each sample weighs as much as the density
/// there: a CVT's centres are distributed as the square root of what it integrates (Gersho, IEEE
/// Trans. Inf. Theory 25, 1979), samples times weights, so as the sites are.
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

/// Moves each centre towards those neighbours that own more samples than it does, and away from
/// those that own fewer: a region shrinks as its neighbours' centres come nearer. Neighbours are
/// those between whom the curve passes, as often as it does.
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
  // units of their distance; each sees it in a sixth of its passages, so the factor were 3. Half of
  // that does not overshoot where neighbours have excesses, too.
  constexpr double rate = 1.5;
  for (std::size_t k = 0; k < centres.size(); ++k)
    if (passages[k] > 0) {
      const Vec3 moved = centres[k] + (rate / passages[k]) * way[k];
      centres[k] = planar ? moved : normalised(moved);
    }
}

/// A Fibonacci lattice over the box of the sites: even, whatever their density.
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

/// A coarse CVT of a sample, whose regions hold about equal numbers of sites: it starts from equal
/// parts of the curve, a few steps round the cells, and a few more even out what they hold.
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

std::vector<Vec3> columns(const Points3& points, const std::optional<Frame>& plane) {
  std::vector<Vec3> out(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const Vec3 p = column(points, k);
    const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    if (plane && finite) {
      out[static_cast<std::size_t>(k)] = (*plane)(p.x, p.y);
      continue;
    }
    if (!finite || (p.x == 0 && p.y == 0 && p.z == 0))
      throw Error(ErrorCode::bad_option,
                  "region centre " + std::to_string(k) +
                      " has no direction: give finite, non-zero centres",
                  k);
    const double scale = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const Vec3 q{p.x / scale, p.y / scale, p.z / scale};
    out[static_cast<std::size_t>(k)] = (1 / norm(q)) * q;
  }
  return out;
}

// ---- Members

/// Mean step along the curve between sites of one owner, by region: the local spacing, but for a
/// factor near 1. That of all sites for a region of a site or two, as where there are as many
/// regions as sites.
std::vector<double> mean_steps(const Sites& sites, const Array<std::int32_t>& owner,
                               std::size_t regions) {
  std::vector<double> sum(regions, 0), count(regions, 0);
  double sum_of_all = 0, count_of_all = 0;
  const std::int64_t stride = std::max<std::int64_t>(1, sites.size() / (256 * std::ssize(sum)));
  for (std::int64_t r = 0; r + 1 < sites.size(); r += stride) {
    const auto k = static_cast<std::size_t>(owner[r]);
    const double step = norm(sites.unit[r + 1] - sites.unit[r]);
    sum_of_all += step;
    ++count_of_all;
    if (owner[r] != owner[r + 1])
      continue;
    sum[k] += step;
    ++count[k];
  }
  for (std::size_t k = 0; k < regions; ++k)
    sum[k] = count[k] > 0 ? sum[k] / count[k] : sum_of_all / count_of_all;
  return sum;
}

/// A circumcap of random sites rarely spans more than this many steps across a bisector; for the
/// rest a query is cheaper than a wider halo of all.
constexpr double halo_steps = 2.5;

HalfSpace beyond_bisector(const Vec3& own, const Vec3& other, double width) {
  const Vec3 apart = other - own;
  const double length = norm(apart);
  const double offset =
      dot(own + other, apart) / (2 * length); // 0 of unit vectors, but for rounding
  return {(1 / length) * apart, offset + width};
}

std::vector<std::vector<HalfSpace>>
halo_half_spaces(const Sites& sites, const Regions& regions,
                 const std::vector<std::vector<std::int32_t>>& adjacent) {
  const std::size_t count = regions.centres.size();
  const std::vector<double> step = mean_steps(sites, regions.owner, count);
  std::vector<std::vector<HalfSpace>> covered(count);
  for (std::size_t k = 0; k < count; ++k)
    for (const std::int32_t m : adjacent[k]) {
      const auto other = static_cast<std::size_t>(m);
      if (norm(regions.centres[other] - regions.centres[k]) < 1e-12)
        continue; // no bisector
      const double width = halo_steps * std::max(step[k], step[other]) + 1e-13;
      covered[k].push_back(beyond_bisector(regions.centres[k], regions.centres[other], width));
    }
  return covered;
}

/// Farthest distance from each centre to a site that it owns.
std::vector<double> owned_radii(const Sites& sites, const Regions& regions) {
  std::vector<double> radius(regions.centres.size(), 0);
  for (std::int64_t r = 0; r < sites.size(); ++r) {
    const auto k = static_cast<std::size_t>(regions.owner[r]);
    radius[k] = std::max(radius[k], norm(sites.unit[r] - regions.centres[k]));
  }
  return radius;
}

/// A polygon around a disc of the plane, 0.2% wider at its corners.
std::vector<HalfSpace> half_planes_around(const Vec3& centre, double radius) {
  constexpr int sides = 48;
  std::vector<HalfSpace> polygon;
  for (int side = 0; side < sides; ++side) {
    const double angle = 2 * std::numbers::pi * side / sides;
    const Vec3 normal{std::cos(angle), std::sin(angle), 0};
    polygon.push_back({normal, dot(centre, normal) + radius + 1e-12});
  }
  return polygon;
}

std::vector<std::vector<HalfSpace>>
distance_half_spaces(const Sites& sites, const Regions& regions,
                     const std::vector<std::vector<std::int32_t>>& adjacent) {
  std::vector<double> chord = owned_radii(sites, regions);
  std::vector<std::vector<HalfSpace>> covered(regions.centres.size());
  for (std::size_t k = 0; k < covered.size(); ++k) {
    for (const std::int32_t m : adjacent[k])
      chord[k] = std::max(chord[k],
                          norm(regions.centres[static_cast<std::size_t>(m)] - regions.centres[k]));
    covered[k] =
        sites.frame
            ? half_planes_around(regions.centres[k], chord[k])
            // |x - t|^2 <= chord^2  <=>  -t.x <= chord^2/2 - 1
            : std::vector<HalfSpace>{{-regions.centres[k], chord[k] * chord[k] / 2 - 1 + 1e-12}};
  }
  return covered;
}

/// What is nearer to a region's centre than to any centre that is not its neighbour's is surely
/// owned by it or a neighbour. `nearest` compares squared distances that err by 5e-15 each; over a
/// bisector of centres that stand close together, that is much.
std::vector<std::vector<HalfSpace>>
voronoi_half_spaces(const Regions& regions,
                    const std::vector<std::vector<std::int32_t>>& adjacent) {
  const std::size_t count = regions.centres.size();
  std::vector<std::vector<HalfSpace>> covered(count);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t m = 0; m < count; ++m) {
      const bool near = m == k || std::find(adjacent[k].begin(), adjacent[k].end(),
                                            static_cast<std::int32_t>(m)) != adjacent[k].end();
      if (near)
        continue;
      const double length = norm(regions.centres[m] - regions.centres[k]);
      if (length < 1e-12) {
        covered[k].assign(1, {regions.centres[k], -2}); // a twin: nothing is surely covered
        break;
      }
      covered[k].push_back(
          beyond_bisector(regions.centres[k], regions.centres[m], -1e-13 - 1e-14 / length));
    }
  return covered;
}

struct RegionRun {
  std::int32_t region;
  Run run;
};

void append(std::vector<Run>& runs, const Run& run) {
  if (!runs.empty() && runs.back().end == run.begin)
    runs.back().end = run.end;
  else
    runs.push_back(run);
}

bool inside(const Vec3& x, const std::vector<HalfSpace>& half_spaces) {
  return std::all_of(half_spaces.begin(), half_spaces.end(),
                     [&](const HalfSpace& h) { return dot(x, h.normal) <= h.offset; });
}

enum class Side { outside, across, inside };

Side side(const Ball& ball, const std::vector<HalfSpace>& half_spaces) {
  Side result = Side::inside;
  for (const HalfSpace& h : half_spaces) {
    const double height = dot(ball.centre, h.normal) - h.offset;
    if (height > ball.radius + 1e-14)
      return Side::outside;
    if (height > -ball.radius - 1e-14)
      result = Side::across;
  }
  return result;
}

/// Emits, along the curve, the runs of the cell that lie in the candidates' half-spaces.
void collect(const Cell& cell, const CellTree& tree, const Vec3* unit,
             const std::vector<std::vector<HalfSpace>>& covered,
             const std::vector<std::int32_t>& candidates, std::vector<RegionRun>& out) {
  const Ball ball = bounding_ball(cell);
  const auto begin = static_cast<std::int32_t>(cell.begin),
             end = static_cast<std::int32_t>(cell.end);
  std::vector<std::int32_t> across;
  for (const std::int32_t k : candidates) {
    const Side s = side(ball, covered[static_cast<std::size_t>(k)]);
    if (s == Side::inside)
      out.push_back({k, {begin, end}});
    if (s == Side::across)
      across.push_back(k);
  }
  if (across.empty())
    return;
  if (cell.size() <= leaf_size || !cell.divisible()) {
    for (const std::int32_t k : across)
      for (std::int32_t r = begin; r != end; ++r)
        if (inside(unit[r], covered[static_cast<std::size_t>(k)]))
          out.push_back({k, {r, r + 1}});
    return;
  }
  for (const Cell& child : tree.children(cell))
    if (child.size() > 0)
      collect(child, tree, unit, covered, across, out);
}

std::vector<std::vector<Run>> members_inside(const Sites& sites,
                                             const std::vector<std::vector<HalfSpace>>& covered,
                                             const std::vector<std::int32_t>& all) {
  const std::vector<Cell> cells = task_cells(sites.cells);
  std::vector<std::vector<RegionRun>> found(cells.size());
  for_each_task(std::ssize(cells), [&](std::int64_t c) {
    const auto index = static_cast<std::size_t>(c);
    collect(cells[index], sites.cells, sites.unit.begin(), covered, all, found[index]);
  });
  std::vector<std::vector<Run>> members(covered.size());
  for (const auto& list : found)
    for (const RegionRun& r : list)
      append(members[static_cast<std::size_t>(r.region)], r.run);
  return members;
}

std::vector<std::vector<Run>>
members_of_neighbours(const Regions& regions,
                      const std::vector<std::vector<std::int32_t>>& adjacent) {
  std::vector<std::vector<Run>> members(regions.centres.size());
  const auto n = static_cast<std::int32_t>(regions.owner.size());
  for (std::int32_t begin = 0, end = 0; begin != n; begin = end) {
    const std::int32_t k = regions.owner[begin];
    while (end != n && regions.owner[end] == k)
      ++end;
    append(members[static_cast<std::size_t>(k)], {begin, end});
    for (const std::int32_t m : adjacent[static_cast<std::size_t>(k)])
      append(members[static_cast<std::size_t>(m)], {begin, end});
  }
  return members;
}

} // namespace

int default_region_count(std::int64_t sites) {
  constexpr std::int64_t whole = 4096, a_region = 16384, least = 12;
  if (sites < whole)
    return 1;
  return static_cast<int>(std::max(least, sites / a_region));
}

std::vector<Vec3> make_centres(const Sites& sites, const DelaunayOptions& options) {
  if (options.given_centres) {
    if (options.given_centres->cols() == 0)
      throw Error(ErrorCode::bad_option, "there is no region centre: give at least 1");
    return columns(*options.given_centres, sites.frame);
  }
  const int regions = options.regions.value_or(default_region_count(sites.size()));
  if (regions < 1)
    throw Error(ErrorCode::bad_option,
                "the number of regions is " + std::to_string(regions) + ": give at least 1");
  // More regions than sites would own nothing; their centres would only take time and memory.
  const auto useful = static_cast<int>(std::min<std::int64_t>(regions, sites.size()));
  if (options.centres == Centres::fibonacci)
    return sites.frame ? plane_lattice(*sites.frame, useful)
                       : columns(fibonacci_sphere(useful), std::nullopt);
  return sampled_centres(sites, useful);
}

Regions make_regions(const Sites& sites, std::vector<Vec3> centres,
                     const std::vector<std::vector<std::int32_t>>& adjacent, Sort sort) {
  Regions regions;
  regions.centres = std::move(centres);
  regions.owner = owners(sites.cells, sites.unit, regions.centres);
  if (sort == Sort::halo)
    regions.covered = halo_half_spaces(sites, regions, adjacent);
  if (sort == Sort::distance)
    regions.covered = distance_half_spaces(sites, regions, adjacent);
  if (sort == Sort::voronoi)
    regions.covered = voronoi_half_spaces(regions, adjacent);
  regions.members = sort == Sort::voronoi
                        ? members_of_neighbours(regions, adjacent)
                        : members_inside(sites, regions.covered, all_of(regions.centres));
  return regions;
}

} // namespace calotte::detail
