// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/densities.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/grid.h>

#include <doctest/doctest.h>

#include <vector>

using namespace calotte;
using test::x8;

// A run passes its mesh from level to level and never triangulates it again. By the law of
// uniqueness the result is the triangulation of its generators, to the last bit.

namespace {

void check_same(const Mesh& mesh, const Mesh& anew) {
  REQUIRE(anew.points == mesh.points);
  CHECK(anew.triangles == mesh.triangles);
  CHECK(anew.neighbours == mesh.neighbours);
  CHECK(anew.site_of_input == mesh.site_of_input);
}

void check_triangulated(const Cvt& grid) { check_same(grid.mesh, delaunay(grid.mesh.points)); }

} // namespace

TEST_CASE("the mesh of a continuation is the triangulation of its generators") {
  for (const Density& density : {Density{}, x8()})
    for (const Points3& start : {bisected_icosahedron(1), fibonacci_sphere(150),
                                 random_sphere(642, site_density(x8()), 5)})
      check_triangulated(make_grid({.resolution = density,
                                    .start = {.points = start, .bisections = 2},
                                    .stop = {.tolerance = 1e-3, .max_iterations = 60}}));
}

TEST_CASE("the same if edges flip at every step, and if a run stops at any iteration") {
  const Recipe recipe{.resolution = x8(),
                      .start = {.points = random_sphere(500, 9), .bisections = 2},
                      .stop = {.iterations = 6},
                      .method = Method::lloyd};
  for (std::size_t last = 1; last <= 18; ++last) {
    bool changed = false;
    const auto until_last = [&](const Progress& now) {
      const std::vector<CvtIteration>& iterations = now.run->report.iterations;
      changed = changed || iterations.back().flips > 0 || iterations.back().rebuilt;
      return iterations.size() == last ? ProgressReply::stop : ProgressReply::proceed;
    };
    const Cvt grid = make_grid(recipe, {.progress = until_last});
    CAPTURE(last);
    CHECK(grid.report.iterations.size() == last);
    CHECK((changed || last == 1));
    check_triangulated(grid);
  }
}

TEST_CASE("a run without iterations is the bisected start's triangulation") {
  check_triangulated(make_grid({.start = {.points = random_sphere(300, 2), .bisections = 2},
                                .stop = {.max_iterations = 0}}));
}

TEST_CASE("in a periodic box, and in a bounded plane") {
  for (const Surface& surface : {Surface::periodic({2, 1}), rectangle({0, 0}, {2, 1})}) {
    const Cvt grid = make_grid({.surface = surface,
                                .start = {.points = random_points(500, surface), .bisections = 1},
                                .stop = {.tolerance = 1e-3}});
    check_same(grid.mesh, delaunay(grid.mesh.points, surface));
  }
}
