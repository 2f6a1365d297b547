// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/glide.h"
#include "delaunay/delaunay.h"

#include "cvt/functional.h"
#include "cvt/shape.h"
#include "mesh/canonical_order.h"
#include "support/densities.h"
#include "support/sanitizer.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/quality.h>
#include <calotte/voronoi.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <optional>

using namespace calotte;
using namespace calotte::test;

namespace {

/// A pure CVT with many dislocations, some of them on the brink of a step.
Points3 with_dislocations(std::int64_t n, const Density& density, std::uint64_t seed) {
  return make_grid({.cells = n,
                    .resolution = density,
                    .start = {.kind = CvtStart::Kind::density},
                    .stop = {.tolerance = 1e-4},
                    .seed = seed})
      .mesh.points;
}

/// The same with few dislocations.
Points3 with_few_dislocations(std::int64_t n, const Density& density, std::uint64_t seed) {
  return make_grid({.cells = n,
                    .resolution = density,
                    .start = {.kind = CvtStart::Kind::multilevel},
                    .stop = {.tolerance = 1e-4, .well_centred = false},
                    .seed = seed})
      .mesh.points;
}

/// The number of Voronoi edges that are too short for their Delaunay edges, from flat triangles.
std::int64_t short_edges(const Points3& points) {
  const Mesh mesh = delaunay(points);
  const auto cotangent = [&](Eigen::Index t, int v) {
    const Eigen::Vector3d at = mesh.points.col(mesh.triangles(v, t));
    const Eigen::Vector3d a = mesh.points.col(mesh.triangles((v + 1) % 3, t)) - at,
                          b = mesh.points.col(mesh.triangles((v + 2) % 3, t)) - at;
    return a.dot(b) / a.cross(b).norm();
  };
  std::int64_t count = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v) {
      const std::int32_t u = mesh.neighbours(v, t);
      int w = 0;
      while (mesh.neighbours(w, u) != t)
        ++w;
      const double ratio = (cotangent(t, v) + cotangent(u, w)) / 2;
      count += t < u && ratio < cvt_detail::shape_limits.least_edge;
    }
  return count;
}

double energy_of(const Points3& points, const Density& density) {
  return quality(delaunay(points), density).energy;
}

/// The points after a glide, and the number of its steps.
struct Glided {
  Points3 points;
  std::int64_t steps = 0;
  std::optional<cvt_detail::Connectivity> mesh;
};

Glided glided(const Points3& points, const Density& density,
              const std::vector<std::uint8_t>& fixed = {},
              const Decomposition& decomposition = {}) {
  Glided result{points, 0, std::nullopt};
  const auto functional = cvt_detail::make_functional(result.points, Surface::sphere(), density,
                                                      {.decomposition = decomposition});
  functional->pin(fixed);
  result.steps = functional->glide(result.points, cvt_detail::shape_limits);
  result.mesh = functional->take_mesh(result.points);
  return result;
}

} // namespace

TEST_CASE("glide: short Voronoi edges go, few generators move, and the energy is lower") {
  for (const Density& density : {Density{}, x8()})
    for (std::uint64_t seed = 1; seed <= (test::sanitized ? 1 : 2); ++seed) {
      CAPTURE(seed);
      const Points3 before = with_few_dislocations(10000, density, seed);
      const Glided after = glided(before, density);
      REQUIRE(short_edges(before) > 1);
      CHECK(short_edges(after.points) < short_edges(before));
      CHECK(after.steps > 0);
      const auto ways = (after.points - before).colwise().norm();
      CHECK((ways.array() == 0).count() > 2500); // far from all brinks
      CHECK((after.points.colwise().norm().array() - 1).abs().maxCoeff() < 1e-15);
      CHECK(energy_of(after.points, density) < energy_of(before, density));
    }
}

TEST_CASE("glide: the mesh that it leaves is the triangulation of the points") {
  Glided after = glided(with_dislocations(1500, x8(), 3), x8());
  REQUIRE(after.mesh);
  REQUIRE(after.steps > 0);
  mesh_detail::make_canonical(after.mesh->triangles, after.mesh->neighbours);
  const Mesh mesh = delaunay(after.points);
  CHECK((after.mesh->triangles == mesh.triangles));
  CHECK((after.mesh->neighbours == mesh.neighbours));
}

TEST_CASE("glide: fixed generators keep their bits") {
  const Points3 before = with_dislocations(2000, Density{}, 1);
  std::vector<std::uint8_t> fixed(2000, 0);
  std::fill(fixed.begin(), fixed.begin() + 1000, cvt_detail::pinned);
  const Glided after = glided(before, {}, fixed), free = glided(before, {});
  CHECK(after.steps > 0);
  CHECK((after.points.leftCols(1000) == before.leftCols(1000)));
  CHECK((free.points.leftCols(1000) != before.leftCols(1000)));
}

TEST_CASE("glide: a mesh without short edges stays") {
  const Points3 points = make_grid({.start = {.points = bisected_icosahedron(4)}}).mesh.points;
  const Glided after = glided(points, {});
  CHECK(after.steps == 0);
  CHECK((after.points == points));
}

TEST_CASE("glide: threads and regions have no effect") {
  const Points3 before = with_dislocations(3000, x8(), 4);
  const auto with = [&](std::size_t threads, int regions) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return glided(before, x8(), {}, {.regions = regions});
  };
  const Glided one = with(1, 1);
  CHECK(one.steps > 0);
  CHECK((one.points == with(2, 12).points));
  CHECK((one.points == with(4, 40).points));
}

TEST_CASE("glide: in a periodic box, a rectangle and a region of the sphere") {
  for (const Surface& domain : {rectangle({0, 0}, {2, 1}), Surface::periodic({2, 1})}) {
    CAPTURE(domain.is_box());
    Recipe recipe{.surface = domain,
                  .start = {.points = random_points(900, domain, {}, 5)},
                  .stop = {.tolerance = 1e-4}};
    const Cvt pure = make_grid(recipe);
    recipe.start.points = pure.mesh.points;
    recipe.stop.well_centred = true;
    const Cvt grid = make_grid(recipe);
    CHECK(check(grid.mesh).failure == "");
    CHECK(grid.report.well_centred);
    const double energy = quality(pure.mesh).energy;
    CHECK(quality(grid.mesh).energy < energy * (1 + 1e-3));
    CHECK(quality(grid.mesh).obtuse <= quality(pure.mesh).obtuse);
  }
  const Surface region = circle({0, 0, 1}, 0.6);
  const Cvt grid = make_grid({.surface = region,
                              .start = {.points = random_points(900, region, Density{}, 5)},
                              .stop = {.tolerance = 1e-4, .well_centred = true}});
  CHECK(grid.report.well_centred);
  CHECK(grid.report.iterations.back().shape_excess <= 0.03);
}
