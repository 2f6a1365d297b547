// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/centres.h"
#include "delaunay/regions.h"

#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>

using namespace calotte;
using namespace calotte::delaunay_detail;

namespace {

/// As many neighbours of each region as `next` gives.
template <class Next> IdLists lists_of(std::int64_t count, std::int64_t each, const Next& next) {
  IdLists lists;
  lists.begin.resize(count + 1);
  lists.items.resize(count * each);
  for (std::int64_t k = 0; k <= count; ++k)
    lists.begin[k] = k * each;
  for (std::int64_t k = 0; k < count; ++k)
    for (std::int64_t m = 0; m < each; ++m)
      lists.items[k * each + m] = static_cast<std::int32_t>(next(k, m) % count);
  return lists;
}

Regions regions_of(const Sites& sites, int count, RegionCentres centres, RegionOverlap overlap) {
  Decomposition decomposition;
  decomposition.regions = count;
  decomposition.centres = centres;
  return make_regions(sites, make_centres(sites, decomposition),
                      lists_of(count, count - 1, [](auto k, auto m) { return k + m + 1; }),
                      overlap);
}

/// For the sampled regions, the largest number of owned sites over the mean.
double fullest(const Points3& points, int count) {
  const Sites sites = make_sites(points, Duplicates::merge, 0);
  const Regions regions = regions_of(sites, count, RegionCentres::sample, RegionOverlap::halo);
  std::vector<std::int64_t> owned(static_cast<std::size_t>(count), 0);
  for (const std::int32_t k : regions.owner)
    ++owned[static_cast<std::size_t>(k)];
  return static_cast<double>(*std::max_element(owned.begin(), owned.end())) * count /
         static_cast<double>(sites.size());
}

/// Half of the sites within a tenth of the sphere.
Points3 crowded_cap() {
  const Points3 all = random_sphere(60000, 3);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < all.cols(); ++i)
    if (all(2, i) > 0.8 || i % 9 == 0)
      kept.push_back(i);
  return all(Eigen::all, kept);
}

} // namespace

TEST_CASE("each site is owned by the nearest centre, by brute force") {
  const Sites sites = make_sites(random_sphere(5000, 8), Duplicates::merge, 0);
  for (const int count : {2, 12, 100}) {
    const Regions regions = regions_of(sites, count, RegionCentres::sample, RegionOverlap::halo);
    for (std::int64_t r = 0; r < sites.size(); ++r) {
      const auto squared = [&](std::int32_t k) {
        const Vec3 apart = sites.unit[r] - regions.centres[static_cast<std::size_t>(k)];
        return dot(apart, apart);
      };
      for (std::int32_t k = 0; k < count; ++k) {
        const bool tie_to_lowest = squared(k) == squared(regions.owner[r]) && k >= regions.owner[r];
        CHECK((squared(k) > squared(regions.owner[r]) || tie_to_lowest));
      }
    }
  }
}

TEST_CASE(
    "members ascend, hold all owned sites and all sites of the covered part, for every overlap") {
  const Sites sites = make_sites(random_sphere(4000, 9), Duplicates::merge, 0);
  for (const RegionOverlap overlap :
       {RegionOverlap::halo, RegionOverlap::distance, RegionOverlap::voronoi})
    for (const int count : {2, 12, 60}) {
      const Regions regions = regions_of(sites, count, RegionCentres::fibonacci, overlap);
      for (std::size_t k = 0; k < regions.members.size(); ++k) {
        std::vector<bool> member(static_cast<std::size_t>(sites.size()), false);
        std::int32_t end = 0;
        for (const Run& run : regions.members[k]) {
          CHECK(run.begin >= end);
          CHECK(run.end > run.begin);
          end = run.end;
          std::fill(member.begin() + run.begin, member.begin() + run.end, true);
        }
        for (std::int64_t r = 0; r < sites.size(); ++r) {
          bool covered = true;
          for (const HalfSpace& h : regions.covered[k])
            covered = covered && dot(sites.unit[r], h.normal) <= h.offset;
          const bool owned = regions.owner[r] == static_cast<std::int32_t>(k);
          CHECK((!(covered || owned) || member[static_cast<std::size_t>(r)]));
        }
      }
    }
}

TEST_CASE("what the voronoi overlap calls covered is, though centres stand too close to tell "
          "owners apart") {
  // Near the centres and their antipodes, each site is equally near to both centres in doubles.
  Points3 points = random_sphere(20000, 6), centres = random_sphere(40, 7);
  const Eigen::Vector3d middle = centres.col(0);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = (i % 2 == 0 ? 1 : -1) * middle + 1e-3 * points.col(i);
  for (Eigen::Index k = 0; k < centres.cols(); ++k)
    centres.col(k) = middle + 3e-12 * centres.col(k);
  const Sites sites = make_sites(points, Duplicates::merge, 0);
  Decomposition decomposition;
  decomposition.given_centres = centres;
  const IdLists adjacent = // only a few: most owners are no members
      lists_of(40, 2, [](auto k, auto m) { return k + (m == 0 ? 39 : 1); });
  const Regions regions =
      make_regions(sites, make_centres(sites, decomposition), adjacent, RegionOverlap::voronoi);
  for (std::size_t k = 0; k < 40; ++k)
    for (std::int64_t r = 0; r < sites.size(); ++r) {
      const auto in = [&](const HalfSpace& h) { return dot(sites.unit[r], h.normal) <= h.offset; };
      if (!std::all_of(regions.covered[k].begin(), regions.covered[k].end(), in))
        continue;
      const std::int32_t owner = regions.owner[r];
      CHECK((owner == static_cast<std::int32_t>(k) || owner == adjacent[k][0] ||
             owner == adjacent[k][1]));
    }
}

TEST_CASE("there are no more placed centres than sites, and halos stay thin with one each") {
  const Sites sites = make_sites(random_sphere(1000, 5), Duplicates::merge, 0);
  Decomposition decomposition;
  decomposition.regions = 1000000000;
  CHECK(make_centres(sites, decomposition).size() == 1000);
  decomposition.centres = RegionCentres::fibonacci;
  CHECK(make_centres(sites, decomposition).size() == 1000);
  const Regions regions = regions_of(sites, 1000, RegionCentres::sample, RegionOverlap::halo);
  std::int64_t members = 0;
  for (const std::vector<Run>& runs : regions.members)
    for (const Run& run : runs)
      members += run.end - run.begin;
  CHECK(members < 100 * sites.size());
}

TEST_CASE("regions of sampled centres hold nearly equal numbers of sites") {
  CHECK(fullest(random_sphere(60000, 3), 24) < 1.2);
  CHECK(fullest(bisected_icosahedron(6), 24) < 1.2);
  CHECK(fullest(random_sphere(300000, 4), 160) < 1.2);
  CHECK(fullest(crowded_cap(), 24) < 1.3);
}

TEST_CASE("centres need a number and directions") {
  const Sites sites = make_sites(random_sphere(50), Duplicates::merge, 0);
  Decomposition decomposition;
  decomposition.regions = 0;
  CHECK_THROWS_WITH_AS(make_centres(sites, decomposition),
                       "the number of regions is 0: give at least 1", Error);
  decomposition.given_centres = Points3::Zero(3, 2);
  CHECK_THROWS_AS(make_centres(sites, decomposition), Error);
}
