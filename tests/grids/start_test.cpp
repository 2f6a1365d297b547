// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/densities.h"
#include "support/errors.h"
#include "support/sanitizer.h"
#include "support/starts.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

Density bump() { return tanh_bump({1, -2, 2}, 0.5, 0.2, 1.0 / 4096); }

/// A bisection takes n sites to 4 n - 6.
std::int64_t after(const test::FirstGenerators& c) {
  std::int64_t n = c.start.cols();
  for (int b = 0; b < c.bisections; ++b)
    n = 4 * n - 6;
  return n;
}

bool is_icosahedral(std::int64_t cells) {
  std::int64_t n = 12;
  while (n < cells)
    n = 4 * n - 6;
  return n == cells;
}

bool is_geodesic(std::int64_t cells, const Density& density) {
  return density.uniform() && cells >= 150;
}

void check_continuation(std::int64_t cells, const Density& density, std::int64_t least) {
  CAPTURE(cells);
  const test::FirstGenerators c = test::continuation(cells, density, 5);
  const std::int64_t n = c.start.cols();
  CHECK(after(c) == cells);
  if (is_geodesic(cells, density)) {
    CHECK(c.start == geodesic_sphere(cells));
    return;
  }
  CHECK((c.bisections == 0 || n >= least));
  CHECK((n % 4 != 2 || (n - 2) / 4 + 2 < least)); // no coarser start would do
  CHECK(c.icosahedral == is_icosahedral(cells));
}

} // namespace

TEST_CASE(
    "continuation: the start is the coarsest from which bisections reach the number of cells") {
  const Density other = bump();
  constexpr std::int64_t stride = test::sanitized ? 5 : 1;
  for (std::int64_t cells = 12; cells <= 5000; cells += (cells < 100 ? 1 : 37) * stride)
    check_continuation(cells, Density{}, 12);
  for (std::int64_t cells = 12; cells <= 5000; cells += (cells < 700 ? 13 : 47) * stride)
    check_continuation(cells, other, 642);
  for (const std::int64_t cells :
       {2562, 2563, 10242, 100000, 163842, 163838, 655362, 4 * 160001 + 2})
    for (const Density& density : {Density{}, other})
      check_continuation(cells, density, density.uniform() ? 12 : 642);
}

TEST_CASE("continuation: the kind of start") {
  CHECK(test::continuation(42, {}).start == bisected_icosahedron(0));
  CHECK(test::continuation(655362, bump()).start == bisected_icosahedron(3));
  CHECK(test::continuation(162, bump()).start == bisected_icosahedron(2));
  CHECK(test::continuation(50, {}).start == fibonacci_sphere(14));
  CHECK(test::continuation(149, {}).start == fibonacci_sphere(149));
  CHECK(test::continuation(150, {}).start == geodesic_sphere(150));
  CHECK(test::continuation(1009, bump(), 7).start == random_sphere(1009, site_density(bump()), 7));
  CHECK(test::continuation(4 * 1001 + 2, bump(), 7).start ==
        random_sphere(1003, site_density(bump()), 7));
  // Two thirds of a billion cells, from the smallest start.
  CHECK(test::continuation(10 * (std::int64_t{1} << 26) + 2, bump()).bisections == 10);
}

TEST_CASE("continuation refuses what it cannot reach in one line") {
  const auto message = [](std::int64_t cells, const Density& density) -> std::string {
    return refusal_of([&] { test::continuation(cells, density); });
  };
  for (const std::int64_t cells : {std::int64_t{-1}, std::int64_t{11}, (std::int64_t{1} << 30) + 1})
    CHECK(has(message(cells, {}), "number of cells is " + std::to_string(cells)));
  const Density bad = tanh_bump({0, 0, 1}, 0.5, -1, 0.1);
  for (const std::int64_t cells : {642, 1000}) // the start is drawn from it or not
    CHECK(has(message(cells, bad), "alpha"));
}

TEST_CASE("drawn starts of a peaked density span the sphere, and converge") {
  for (const std::int64_t cells : {643, 2000, 2571}) {
    Recipe recipe = test::recipe_of(CvtStart::Kind::continuation, cells, test::x8(), 1);
    recipe.stop.tolerance = 1e-3;
    const Cvt grid = make_grid(recipe);
    CHECK(plan(recipe).first != CvtStart::Kind::icosahedron);
    CHECK(grid.report.converged);
    CHECK(grid.mesh.points.cols() == cells);
  }
}

TEST_CASE("continuation: uniform grids of any number of cells have 12 defects after few steps") {
  std::vector<std::int64_t> numbers{642, 1000, 2563, 4922, 10250};
  for (std::int64_t cells = 150; cells < 240; ++cells)
    numbers.push_back(cells);
  for (const std::int64_t cells : numbers) {
    CAPTURE(cells);
    const Cvt grid = make_grid(test::recipe_of(CvtStart::Kind::continuation, cells, {}, 1));
    CHECK(grid.report.converged);
    CHECK(grid.report.iterations.size() <= 40);
    REQUIRE(grid.mesh.points.cols() == cells);
    std::vector<int> degree(static_cast<std::size_t>(cells), 0);
    for (const std::int32_t corner : grid.mesh.triangles.reshaped())
      ++degree[static_cast<std::size_t>(corner)];
    CHECK(std::count(degree.begin(), degree.end(), 5) == 12);
    CHECK(std::count(degree.begin(), degree.end(), 6) == cells - 12);
  }
}

namespace {

/// Widths that are in proportion to 1 near a point and to `ratio` far away.
Density steep(double ratio) {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [ratio](const PointsRef& points, Eigen::Ref<Eigen::VectorXd> values) {
    const Eigen::Vector3d centre = Eigen::Vector3d(1, -2, 2) / 3;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      values[i] = std::pow(std::clamp(60 * (points.col(i) - centre).norm() - 20, 1.0, ratio), -4);
  };
  return density;
}

} // namespace

TEST_CASE(
    "multilevel: starts of steep densities span the sphere for all seeds, and so does a run") {
  for (const double ratio : {1.0, 16.0, 80.0}) {
    for (std::uint64_t seed = 1; seed <= (test::sanitized ? 2 : 12); ++seed) {
      CAPTURE(ratio);
      CAPTURE(seed);
      const test::FirstGenerators from = test::multilevel(3000, {}, steep(ratio), seed);
      CHECK(from.start.cols() >= 160);
      CHECK(delaunay(from.start).closed());
      Recipe recipe = test::recipe_of(CvtStart::Kind::multilevel, 3000, steep(ratio), seed);
      recipe.stop = {.tolerance = 1e-2, .well_centred = false};
      const Cvt grid = make_grid(recipe);
      CHECK(grid.mesh.closed());
      CHECK(grid.mesh.points.cols() == 3000);
    }
  }
}

// ---- The plane

namespace {

Surface polygon(const std::vector<std::vector<Eigen::Vector2d>>& rings) {
  Surface::Rings matrices;
  for (const auto& corners : rings) {
    Points2 ring(2, static_cast<Eigen::Index>(corners.size()));
    for (std::size_t i = 0; i < corners.size(); ++i)
      ring.col(static_cast<Eigen::Index>(i)) = corners[i];
    matrices.push_back(ring);
  }
  return Surface::plane().within(matrices);
}

/// An L with a hole, and a triangle beside it.
Surface islands() {
  return polygon({{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}},
                  {{0.3, 0.4}, {0.7, 0.4}, {0.6, 2}},
                  {{2, 2}, {3, 2}, {2.5, 2.9}}});
}

void check_inside(const Points3& places, const Surface& domain) {
  for (const auto& place : places.colwise())
    REQUIRE(domain.contains(place));
}

} // namespace

TEST_CASE("hexagonal lattices: as near to n as the spacing allows, inside, at equal distances") {
  for (const Surface& domain : {rectangle({-1, 2}, {0, 3}), rectangle({0, 0}, {0.1, 1}), islands(),
                                polygon({{{0, 0}, {1e8, 1e7}, {1.1e8, 3e7}}})})
    for (const std::int64_t n : {100, 1000, 20000}) {
      CAPTURE(n);
      const Points3 places = hexagonal_lattice(n, domain);
      CHECK(std::abs(places.cols() - n) <= std::sqrt(static_cast<double>(n)));
      check_inside(places, domain);
    }
  // Whole rows and columns fill a rectangle evenly.
  const double rise = std::sqrt(3.0) / 2;
  const Points3 even = hexagonal_lattice(60, rectangle({0, 0}, {10, 6 * rise}));
  REQUIRE(even.cols() == 60);
  CHECK((even.col(0) - Eigen::Vector3d(0.25, rise / 2, 0)).norm() < 1e-12);
  CHECK((even.col(59) - Eigen::Vector3d(9.75, 5.5 * rise, 0)).norm() < 1e-12);
  CHECK(hexagonal_lattice(1, rectangle({0, 0}, {1, 1})).cols() == 1);
}

TEST_CASE("hexagonal lattices of periodic boxes: periodic_hexagons where these fit") {
  for (const auto& [columns, rows, spacing] :
       {std::tuple{3, 4, 1.0}, {10, 12, 1.0}, {8, 6, 0.1}, {100, 116, 30000.0}, {7, 40, 1.0 / 3}}) {
    CAPTURE(columns);
    const Mesh mesh = hexagonal_box(columns, rows, spacing);
    const Points3 places = hexagonal_lattice(columns * rows, mesh.surface);
    REQUIRE(places.cols() == mesh.points.cols());
    CHECK((places - mesh.points).cwiseAbs().maxCoeff() <= 1e-15 * mesh.surface.period().maxCoeff());
    if (spacing == 1)
      CHECK(places == mesh.points);
  }
  for (const Surface& box :
       {Surface::periodic({1, 1}), Surface::periodic({2, 1}), Surface::periodic({1e9, 3e9})})
    for (const std::int64_t n : {12, 100, 1000, 9973}) {
      const Points3 places = hexagonal_lattice(n, box);
      check_inside(places, box);
      CHECK(std::abs(places.cols() - n) <= std::max<double>(12, 0.05 * static_cast<double>(n)));
      if (n >= 100)
        CHECK(delaunay(places, box).triangles.cols() == 2 * places.cols());
    }
}

TEST_CASE("bisection in the plane: midpoints inside the domain, in a box all of them") {
  const Surface domain = islands();
  const Mesh mesh = delaunay(random_points(300, domain, {}, 3), domain);
  const Points3 finer = bisect(mesh);
  CHECK(finer.leftCols(300) == mesh.points);
  CHECK(finer.cols() > 900);
  CHECK(finer.cols() < 300 + 3 * 300);
  check_inside(finer, domain);
  std::int64_t inside = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.neighbours(i, t) < t || mesh.neighbours(i, t) < 0)
        inside += domain.contains((mesh.points.col(mesh.triangles((i + 1) % 3, t)) +
                                   mesh.points.col(mesh.triangles((i + 2) % 3, t))) /
                                  2);
  CHECK(finer.cols() == 300 + inside);

  const Mesh hexagons = hexagonal_box(6, 8, 1);
  const Points3 fine = bisect(hexagons);
  REQUIRE(fine.cols() == 4 * 48);
  check_inside(fine, hexagons.surface);
  // They are hexagons of half the spacing.
  const Mesh half = delaunay(fine, hexagons.surface);
  for (Eigen::Index t = 0; t < half.triangles.cols(); ++t) {
    Eigen::Vector3d way =
        half.points.col(half.triangles(1, t)) - half.points.col(half.triangles(0, t));
    for (int i = 0; i < 2; ++i)
      way[i] = std::remainder(way[i], half.surface.period()[i]);
    CHECK(way.norm() == doctest::Approx(0.5).epsilon(1e-12));
  }
}

TEST_CASE("starts in the plane refuse what they cannot make in one line") {
  const Surface square = rectangle({0, 0}, {1, 1}), box = Surface::periodic({1, 1});
  for (const std::int64_t n : {std::int64_t{0}, std::int64_t{-5}, (std::int64_t{1} << 30) + 1}) {
    CHECK(has(message_of([&] { hexagonal_lattice(n, square); }), "number of points"));
    CHECK(has(message_of([&] { random_points(n, box); }), "number of points"));
  }
  CHECK(has(message_of([&] { hexagonal_lattice(11, box); }), "from 12"));
  const Surface nothing = Surface::plane();
  CHECK(code_of([&] { random_points(10, nothing); }) == ErrorCode::invalid_argument);
  CHECK(code_of([&] { hexagonal_lattice(100, nothing); }) == ErrorCode::invalid_argument);
  const Mesh hexagons = hexagonal_box(6, 8, 1);
  Mesh wrong = hexagons;
  wrong.triangles.setConstant(48);
  CHECK(has(message_of([&] { bisect(wrong); }), "outside the mesh"));
}

TEST_CASE("seas behind narrow straits get their part of the cells [slow]") {
  // A basin of 20 x 20, to the right of it five bays of 3 x 3 behind straits of 0.3 x 2.
  constexpr int bays = 5;
  std::vector<Eigen::Vector2d> corners{{0, 20}, {0, 0}, {20, 0}};
  for (int bay = 0; bay < bays; ++bay) {
    const double y = 4 * bay + 2;
    for (const auto& [x, beside] : {std::pair{20.0, -0.15},
                                    {22.0, -0.15},
                                    {22.0, -1.5},
                                    {25.0, -1.5},
                                    {25.0, 1.5},
                                    {22.0, 1.5},
                                    {22.0, 0.15},
                                    {20.0, 0.15}})
      corners.emplace_back(x, y + beside);
  }
  corners.emplace_back(20, 20);
  const Points2 ring = Eigen::Map<const Points2>(corners.front().data(), 2, std::ssize(corners));
  const double area = 400 + bays * (9 + 0.6);
  for (const Boundary boundary : {Boundary::clip, Boundary::generators}) {
    Recipe recipe;
    recipe.surface = Surface::plane().within({ring});
    recipe.boundary = boundary;
    recipe.cells = 6000;
    const Mesh mesh = make_grid(recipe).mesh;
    const auto n = static_cast<double>(mesh.points.cols());
    for (int bay = 0; bay < bays; ++bay) {
      const auto here = (mesh.points.row(0).array() > 22 && mesh.points.row(1).array() > 4 * bay &&
                         mesh.points.row(1).array() < 4 * bay + 4)
                            .count();
      const double edge = boundary == Boundary::generators ? 0.5 * 12 / std::sqrt(area / n) : 0;
      CHECK((static_cast<double>(here) - edge) / n / (9 / area) == doctest::Approx(1).epsilon(0.1));
    }
  }
}
