// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/cvt.h"
#include "delaunay/delaunay.h"
#include "support/densities.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

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
                                 random_sphere(642, site_density(x8()), 5)}) {
      CvtOptions options;
      options.density = density;
      options.tolerance = 1e-3;
      options.bisections = 2;
      options.max_iterations = 60;
      check_triangulated(cvt(start, {}, options));
    }
}

TEST_CASE("the same if edges flip at every step, and if a run stops at any iteration") {
  CvtOptions options;
  options.density = x8();
  options.method = Method::lloyd;
  options.norm = Norm::none;
  options.max_iterations = 6;
  options.bisections = 2;
  for (std::size_t last = 1; last <= 18; ++last) {
    bool changed = false;
    const Cvt grid = cvt(random_sphere(500, 9), {}, options, [&](const CvtProgress& now) {
      const CvtIteration& iteration = now.report.iterations.back();
      changed = changed || iteration.flips > 0 || iteration.rebuilt;
      return now.report.iterations.size() == last;
    });
    CAPTURE(last);
    CHECK(grid.report.iterations.size() == last);
    CHECK((changed || last == 1));
    check_triangulated(grid);
  }
}

TEST_CASE("a run without iterations is the bisected start's triangulation") {
  CvtOptions options;
  options.max_iterations = 0;
  options.bisections = 2;
  check_triangulated(cvt(random_sphere(300, 2), {}, options));
}

TEST_CASE("in a periodic box, and in a bounded plane") {
  CvtOptions options;
  options.tolerance = 1e-3;
  options.bisections = 1;
  const Surface box = Surface::periodic({2, 1});
  const Cvt periodic = cvt(random_points(500, box), box, options);
  check_same(periodic.mesh, delaunay(periodic.mesh.points, box));
  const Surface basin = rectangle({0, 0}, {2, 1});
  const Cvt bounded = cvt(random_points(300, basin), basin, options);
  check_same(bounded.mesh, delaunay(bounded.mesh.points, basin));
}
