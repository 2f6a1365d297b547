// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/regions.h"

#include "base/parallel.h"
#include "delaunay/owners.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calotte::delaunay_detail {
namespace {

/// Mean step along the curve between sites of one owner, by region: the local spacing, up to a
/// factor near 1. A region of one or two sites has the mean of all sites.
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

/// A circumcap of random sites rarely spans more than this number of steps across a bisector; for
/// the others a query is cheaper than a wider halo of all regions.
constexpr double halo_steps = 2.5;

HalfSpace beyond_bisector(const Vec3& own, const Vec3& other, double width) {
  const Vec3 apart = other - own;
  const double length = norm(apart);
  const double offset =
      dot(own + other, apart) / (2 * length); // 0 for unit vectors, up to rounding
  return {(1 / length) * apart, offset + width};
}

std::vector<std::vector<HalfSpace>> halo_half_spaces(const Sites& sites, const Regions& regions,
                                                     const IdLists& adjacent) {
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

std::vector<std::vector<HalfSpace>> distance_half_spaces(const Sites& sites, const Regions& regions,
                                                         const IdLists& adjacent) {
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

/// A site that is nearer to a region's centre than to any centre that is not its neighbour's is
/// certainly owned by the region or a neighbour. `nearest` compares squared distances with an error
/// of 5e-15 each, which is large over a bisector of centres that are close together.
std::vector<std::vector<HalfSpace>> voronoi_half_spaces(const Regions& regions,
                                                        const IdLists& adjacent) {
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
        covered[k].assign(
            1, {regions.centres[k], -2}); // a coincident centre: no site is certainly covered
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

/// Descends the quadtree together with the regions whose half-spaces may contain a part of a cell's
/// sites. The regions are kept on a stack, as in a descent to owners.
class MemberDescent {
public:
  MemberDescent(const Sites& sites, const Regions& regions)
      : sites_(sites), covered_(regions.covered), candidates_(all_of(regions.centres)) {}

  /// The runs of the cell that lie in regions, along the curve in each.
  std::vector<RegionRun> run(const QuadtreeCell& cell) && {
    collect(cell, 0);
    return std::move(runs_);
  }

private:
  /// Collects the members in a cell. The candidates are those from index `first` on.
  void collect(const QuadtreeCell& cell, std::size_t first) {
    const std::size_t end = candidates_.size();
    const Ball ball = bounding_ball(cell);
    const auto cell_begin = static_cast<std::int32_t>(cell.begin),
               cell_end = static_cast<std::int32_t>(cell.end);
    for (std::size_t c = first; c != end; ++c) {
      const std::int32_t k = candidates_[c];
      const Side s = side(ball, covered_[static_cast<std::size_t>(k)]);
      if (s == Side::inside)
        runs_.push_back({k, {cell_begin, cell_end}});
      if (s == Side::across)
        candidates_.push_back(k);
    }
    if (cell.size() <= leaf_size || !cell.divisible()) {
      for (std::size_t c = end; c != candidates_.size(); ++c)
        collect_sites(cell_begin, cell_end, candidates_[c]);
    } else if (candidates_.size() > end) {
      for (const QuadtreeCell& child : sites_.cells.children(cell))
        if (child.size() > 0)
          collect(child, end);
    }
    candidates_.resize(end);
  }

  void collect_sites(std::int32_t begin, std::int32_t end, std::int32_t k) {
    for (std::int32_t r = begin; r != end; ++r) {
      if (!inside(sites_.unit[r], covered_[static_cast<std::size_t>(k)]))
        continue;
      if (!runs_.empty() && runs_.back().region == k && runs_.back().run.end == r)
        ++runs_.back().run.end;
      else
        runs_.push_back({k, {r, r + 1}});
    }
  }

  const Sites& sites_;
  const std::vector<std::vector<HalfSpace>>& covered_;
  std::vector<std::int32_t> candidates_;
  std::vector<RegionRun> runs_;
};

std::vector<std::vector<Run>> members_inside(const Sites& sites, const Regions& regions) {
  const std::vector<QuadtreeCell> cells = task_cells(sites.cells);
  std::vector<std::vector<RegionRun>> found(cells.size());
  for_each_task(std::ssize(cells), [&](std::int64_t c) {
    const auto index = static_cast<std::size_t>(c);
    found[index] = MemberDescent(sites, regions).run(cells[index]);
  });
  std::vector<std::vector<Run>> members(regions.centres.size());
  for (const auto& list : found)
    for (const RegionRun& r : list)
      append(members[static_cast<std::size_t>(r.region)], r.run);
  return members;
}

std::vector<std::vector<Run>> members_of_neighbours(const Regions& regions,
                                                    const IdLists& adjacent) {
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

namespace {

template <class Body> void for_each_member(const std::vector<Run>& runs, const Body& body) {
  for (const Run& run : runs)
    for (std::int32_t r = run.begin; r != run.end; ++r)
      body(r);
}

/// By region: the lowest region of its group, failed regions that share members; -1 for others.
std::vector<std::int32_t> group_failed(const Regions& regions, const std::vector<char>& failed) {
  std::vector<std::int32_t> group(failed.size(), -1);
  for (std::size_t k = 0; k < failed.size(); ++k)
    if (failed[k] != 0)
      group[k] = static_cast<std::int32_t>(k);
  for (std::size_t k = 0; k < failed.size(); ++k) {
    if (failed[k] == 0)
      continue;
    for_each_member(regions.members[k], [&](std::int32_t r) {
      const std::int32_t other = group[static_cast<std::size_t>(regions.owner[r])], own = group[k];
      if (other >= 0 && other != own)
        std::replace(group.begin(), group.end(), std::max(own, other), std::min(own, other));
    });
  }
  return group;
}

/// Number of sites beyond its own that a merged region has: some rings around them.
constexpr std::int64_t merged_halo = 500;

/// Radius, as a chord, of a cap around the sites of a region and its halo.
double merged_reach(const Sites& sites, const Array<std::int32_t>& owner, std::int32_t k,
                    const Vec3& centre) {
  double own = 0;
  std::vector<double> others;
  for (std::int64_t r = 0; r < sites.size(); ++r) {
    const double chord = norm(sites.unit[r] - centre);
    if (owner[r] == k)
      own = std::max(own, chord);
    else
      others.push_back(chord);
  }
  double halo = 0;
  if (!others.empty()) {
    const auto last = others.begin() + std::min(merged_halo, std::ssize(others)) - 1;
    std::nth_element(others.begin(), last, others.end());
    halo = *last;
  }
  return 1.1 * std::max(own, halo) + 1e-12;
}

/// Sets the centre, the members and the covered part of a merged region; false if it is too large.
bool gather_merged(const Sites& sites, std::size_t k, Regions& regions) {
  const auto id = static_cast<std::int32_t>(k);
  Vec3 sum{0, 0, 0};
  std::int64_t owned = 0;
  for (std::int64_t r = 0; r < sites.size(); ++r)
    if (regions.owner[r] == id)
      sum = sum + sites.unit[r], ++owned;
  const Vec3 mean = (1 / static_cast<double>(owned)) * sum;
  if (!sites.frame && norm(mean) < 0.5)
    return false;
  const Vec3 centre = sites.frame ? mean : (1 / norm(mean)) * mean;
  const double chord = merged_reach(sites, regions.owner, id, centre);
  if (chord > 1)
    return false;
  regions.centres[k] = centre;
  regions.covered[k] = sites.frame
                           ? half_planes_around(centre, chord)
                           : std::vector<HalfSpace>{{-centre, chord * chord / 2 - 1 + 1e-12}};
  std::int64_t count = 0;
  for (std::int32_t r = 0; r < sites.size(); ++r)
    if (inside(sites.unit[r], regions.covered[k]))
      append(regions.members[k], {r, r + 1}), ++count;
  return count < sites.size() / 2;
}

} // namespace

std::vector<std::int32_t> merge_failed(const Sites& sites, const std::vector<char>& failed,
                                       Regions& regions) {
  const std::vector<std::int32_t> group = group_failed(regions, failed);
  std::vector<char> touched(failed.size(), 0);
  for_each_task(std::ssize(failed), [&](std::int64_t k) {
    const auto region = static_cast<std::size_t>(k);
    for_each_member(regions.members[region], [&](std::int32_t r) {
      if (failed[static_cast<std::size_t>(regions.owner[r])] != 0)
        touched[region] = 1;
    });
  });
  for (std::int64_t r = 0; r < sites.size(); ++r)
    if (const std::int32_t g = group[static_cast<std::size_t>(regions.owner[r])]; g >= 0)
      regions.owner[r] = g;
  std::vector<std::int32_t> again;
  for (std::size_t k = 0; k < failed.size(); ++k) {
    if (failed[k] != 0)
      regions.members[k].clear();
    const bool merged = group[k] == static_cast<std::int32_t>(k);
    if (merged && !gather_merged(sites, k, regions))
      return {};
    if (failed[k] != 0 || touched[k] != 0)
      again.push_back(static_cast<std::int32_t>(k));
  }
  return again;
}

Regions make_regions(const Sites& sites, std::vector<Vec3> centres, const IdLists& adjacent,
                     RegionOverlap overlap) {
  Regions regions;
  regions.centres = std::move(centres);
  regions.owner = owners(sites.cells, sites.unit, regions.centres);
  if (overlap == RegionOverlap::halo)
    regions.covered = halo_half_spaces(sites, regions, adjacent);
  if (overlap == RegionOverlap::distance)
    regions.covered = distance_half_spaces(sites, regions, adjacent);
  if (overlap == RegionOverlap::voronoi)
    regions.covered = voronoi_half_spaces(regions, adjacent);
  regions.members = overlap == RegionOverlap::voronoi ? members_of_neighbours(regions, adjacent)
                                                      : members_inside(sites, regions);
  return regions;
}

} // namespace calotte::delaunay_detail