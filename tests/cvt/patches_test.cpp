// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/repair.h"
#include "delaunay/delaunay.h"
#include "integrals/patches.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

using namespace calotte;
using namespace calotte::cvt_detail;

namespace {

SitePositions<Sphere> placed(const Points3& points) {
  static constexpr Sphere sphere;
  return {sphere, {&column(points, 0), static_cast<std::size_t>(points.cols())}};
}

using Triple = std::array<std::int32_t, 3>;

/// The lowest site first.
Triple lowest_first(Triple triple) {
  std::rotate(triple.begin(), std::min_element(triple.begin(), triple.end()), triple.end());
  return triple;
}

Triple sites_of(const Triangles& triangles, Eigen::Index t) {
  return lowest_first({triangles(0, t), triangles(1, t), triangles(2, t)});
}

std::set<Triple> all_triangles(const Triangles& triangles) {
  std::set<Triple> out;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    out.insert(sites_of(triangles, t));
  return out;
}

/// Regions of random shape: a law that holds for these holds for all.
Ownership random_ownership(std::int64_t sites, std::int32_t regions, unsigned seed) {
  std::mt19937 random(seed);
  Array<std::int32_t> owner(sites);
  for (std::int32_t& k : owner)
    k = static_cast<std::int32_t>(random() % static_cast<unsigned>(regions));
  return make_ownership(std::move(owner), regions);
}

Triple global(const Patch& patch, const Triple& locals) {
  const auto site = [&](std::int32_t local) {
    return patch.sites[static_cast<std::size_t>(local)];
  };
  return {site(locals[0]), site(locals[1]), site(locals[2])};
}

/// Each patch contains the triangles with a site of its own, in the canonical order, and the sites
/// of these.
void check_patches(const std::vector<Patch>& patches, const Triangles& triangles,
                   const Ownership& ownership) {
  const std::set<Triple> all = all_triangles(triangles);
  for (const Patch& patch : patches) {
    std::vector<Triple> expected;
    std::set<std::int32_t> halo;
    for (const Triple& triple : all) { // ordered by lowest and following site
      const auto owns = [&](std::int32_t site) { return ownership.owner[site] == patch.region; };
      if (!std::any_of(triple.begin(), triple.end(), owns))
        continue;
      expected.push_back(triple);
      std::copy_if(triple.begin(), triple.end(), std::inserter(halo, halo.end()),
                   [&](std::int32_t site) { return !owns(site); });
    }
    std::vector<Triple> found, numbered;
    for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
      found.push_back(sites_of(triangles, patch.triangles[i]));
      numbered.push_back(global(patch, patch.corners[i]));
    }
    CHECK(found == expected);
    CHECK(numbered == expected);
    CHECK(
        std::equal(patch.sites.begin() + patch.owned, patch.sites.end(), halo.begin(), halo.end()));
    const auto& own = ownership.owned[static_cast<std::size_t>(patch.region)];
    CHECK(
        std::equal(patch.sites.begin(), patch.sites.begin() + patch.owned, own.begin(), own.end()));
    CHECK(std::is_sorted(own.begin(), own.end()));
  }
}

/// Points moved by some spacings at random.
Points3 shaken(const Points3& points, double amount) {
  const double h = std::sqrt(4 * std::numbers::pi / static_cast<double>(points.cols()));
  return (points + amount * h * random_sphere(points.cols(), 7)).colwise().normalized();
}

Connectivity connectivity(const Points3& points) {
  Mesh mesh = delaunay(points);
  return {std::move(mesh.triangles), std::move(mesh.neighbours)};
}

Faults all_faults(const Connectivity& mesh, const Points3& points) {
  Faults faults;
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    add_faults(mesh, placed(points), t, faults);
  return faults;
}

} // namespace

TEST_CASE("patches contain the sites of their regions, for any shape") {
  const Mesh mesh = delaunay(random_sphere(600, 3));
  Triangles other = mesh.triangles.rowwise().reverse(); // another order, and another first corner
  for (const int row : {0, 1})
    other.row(row).swap(other.row(row + 1));
  for (const std::int32_t regions : {1, 2, 7, 900}) { // some of the last regions own no sites
    const Ownership ownership = random_ownership(600, regions, 5);
    check_patches(make_patches(mesh.triangles, ownership), mesh.triangles, ownership);
    check_patches(make_patches(other, ownership), other, ownership);
  }
}

TEST_CASE("patches of a mesh of several parts") {
  const Mesh mesh = delaunay(random_sphere(40000, 4));
  const Ownership ownership = random_ownership(40000, 3, 6);
  check_patches(make_patches(mesh.triangles, ownership), mesh.triangles, ownership);
}

TEST_CASE("repair finds the Delaunay triangulation of moved points; patches are renewed with it") {
  for (const double amount : {0.0, 0.02, 0.3, 1.0}) { // of the spacing
    for (const Points3& start : {bisected_icosahedron(3), random_sphere(642, 8)}) {
      CAPTURE(amount);
      Connectivity mesh = connectivity(start);
      const Ownership ownership = random_ownership(start.cols(), 5, 6);
      std::vector<Patch> patches = make_patches(mesh.triangles, ownership);
      const Points3 points = shaken(start, amount);
      const std::optional<Repair> repaired = repair(mesh, placed(points), all_faults(mesh, points));
      if (!repaired) { // a new triangulation is cheaper
        CHECK(amount >= 0.3);
        continue;
      }
      CHECK(all_triangles(mesh.triangles) == all_triangles(delaunay(points).triangles));
      CHECK(all_faults(mesh, points).none());
      if (amount == 0.0 || amount >= 0.3)
        CHECK((repaired->flips > 0) == (amount > 0));
      renew_patches(patches, mesh.triangles, ownership, repaired->changed);
      check_patches(patches, mesh.triangles, ownership);
      for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
        for (int v = 0; v < 3; ++v) { // neighbours are mutual and share the edge
          const std::int32_t u = mesh.neighbours(v, t);
          int back = 0;
          while (mesh.neighbours(back, u) != t)
            ++back;
          CHECK(mesh.triangles((v + 1) % 3, t) == mesh.triangles((back + 2) % 3, u));
          CHECK(mesh.triangles((v + 2) % 3, t) == mesh.triangles((back + 1) % 3, u));
        }
    }
  }
}

TEST_CASE("repair turns triangles back where sites have crossed an opposite edge") {
  const Points3 start = bisected_icosahedron(4); // 2562 sites
  const double h = std::sqrt(4 * std::numbers::pi / static_cast<double>(start.cols()));
  std::int64_t overturned = 0, repairs = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    Connectivity mesh = connectivity(start);
    std::mt19937 random(seed);
    Points3 points = start;
    const Points3 aside = random_sphere(4, seed);
    for (Eigen::Index i = 0; i < 4; ++i) { // a few sites, as an iteration leaves them
      const auto site = static_cast<Eigen::Index>(random() % 2562);
      points.col(site) = (start.col(site) + 1.3 * h * aside.col(i)).normalized();
    }
    Faults faults = all_faults(mesh, points);
    overturned += static_cast<std::int64_t>(faults.overturned.size());
    bool done = true;
    for (int pass = 0; pass < 5 && done && !faults.none(); ++pass) {
      done = repair(mesh, placed(points), faults).has_value();
      faults = all_faults(mesh, points);
    }
    if (!done)
      continue; // a triangle stayed overturned: the caller triangulates
    ++repairs;
    CHECK(faults.none());
    CHECK(all_triangles(mesh.triangles) == all_triangles(delaunay(points).triangles));
  }
  CHECK(overturned > 40);
  CHECK(repairs > 10);
}
