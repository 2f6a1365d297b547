// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/check.h>
#include <calotte/checkpoint.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include "cvt/cvt.h"
#include "support/constants.h"
#include "support/descent.h"
#include "support/directions.h"
#include "support/files.h"
#include "support/laws.h"
#include "support/region_laws.h"
#include "support/text.h"

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::test::region_laws;

namespace {

Surface polygon(const std::vector<std::pair<double, double>>& corners) {
  Points3 ring(3, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t k = 0; k < corners.size(); ++k)
    ring.col(static_cast<Eigen::Index>(k)) = direction(corners[k].first, corners[k].second);
  return Surface::sphere().within({ring});
}

Surface archipelago() {
  Surface::Rings rings;
  for (int k = 0; k < 200; ++k)
    rings.push_back(
        circle(direction(6.0 * (k % 20), -30 + 6.0 * (k / 20)), (1 + 0.1 * (k % 7)) * degree, 12)
            .rings()[0]);
  return Surface::sphere().within(rings);
}

/// Walls of 0.2 degrees between bays.
Surface narrow_bays() {
  std::vector<std::pair<double, double>> corners{{0, 0}, {20, 0}};
  for (int tooth = 9; tooth >= 0; --tooth) {
    corners.push_back({2.0 * tooth + 2, 10});
    corners.push_back({2.0 * tooth + 0.4, 10});
    corners.push_back({2.0 * tooth + 0.3, 1});
    corners.push_back({2.0 * tooth + 0.2, 10});
  }
  corners.push_back({0, 10});
  return polygon(corners);
}

Surface with_hole() {
  const Surface around = circle(direction(90, 85), 25 * degree); // holds the pole
  const Points3 hole = circle(direction(0, 90), 8 * degree, 40).rings()[0].rowwise().reverse();
  return Surface::sphere().within({around.rings()[0], hole});
}

std::vector<std::pair<std::string, Surface>> regions() {
  return {{"hemisphere", circle(direction(10, 20), 90 * degree)},
          {"a degree", circle(direction(10, 20), degree)},
          {"170 degrees", circle(direction(10, 20), 170 * degree)},
          {"pole", polygon({{0, 60}, {90, 60}, {180, 60}, {-90, 60}})},
          {"date line", polygon({{170, -10}, {-170, -12}, {-165, 15}, {172, 11}})},
          {"bay", polygon({{0, 0}, {40, 0}, {40, 30}, {21, 30}, {20, 3}, {19, 30}, {0, 30}})},
          {"hole", with_hole()},
          {"comb", narrow_bays()},
          {"an octant", polygon({{0, 0}, {90, 0}, {0, 90}})}, // boxes of its arcs reach far
          {"archipelago", archipelago()}};
}

std::string message_of(const Points3& start, const Surface& region) {
  return test::message_of([&] { make_grid({.surface = region, .start = {.points = start}}); });
}

} // namespace

TEST_CASE("region: the cells' areas sum to the region's, and generators stay inside") {
  for (const auto& [name, region] : regions()) {
    CAPTURE(name);
    const Points3 start = random_points(300, region);
    const double whole = region.area();
    CHECK(std::abs(sum_of_cells(region, start) / whole - 1) < 1e-12);
    const Cvt grid =
        make_grid({.surface = region, .start = {.points = start}, .stop = {.max_iterations = 25}});
    CHECK(grid.mesh.points.cols() == 300);
    CHECK(std::abs(sum_of_cells(region, grid.mesh.points) / whole - 1) < 1e-12);
    CHECK(check_surface(grid.mesh).failure == "");
    check_descent(grid.report, 1e-9);
    for (const auto& x : grid.mesh.points.colwise())
      CHECK(region.contains(x));
  }
}

TEST_CASE("region: generators that start in a corner spread over all of it") {
  const Surface region = circle(direction(10, 20), 30 * degree);
  const Points3 corner = random_points(150, circle(direction(30, 20), degree));
  const Cvt grid =
      make_grid({.surface = region, .start = {.points = corner}, .stop = {.tolerance = 1e-3}});
  CHECK(grid.report.converged);
  CHECK(std::abs(sum_of_cells(region, grid.mesh.points) / region.area() - 1) < 1e-12);
}

TEST_CASE("region: a pure CVT converges near the limit of hexagons") {
  const Surface region = circle(direction(10, 20), 30 * degree);
  const Cvt grid =
      make_grid({.cells = 300, .surface = region, .start = {.kind = CvtStart::Kind::random}});
  CHECK(grid.report.converged);
  const double whole = region.area(), hexagons = 5 / (18 * std::sqrt(3.0)) * whole * whole / 300,
               energy = grid.report.iterations.back().energy;
  CHECK(energy > 0.99 * hexagons); // the limit holds for flat cells
  CHECK(energy < 1.05 * hexagons);
}

TEST_CASE("region: uniform density by closed forms and by quadrature") {
  const Surface region = circle(direction(200, -70), 5 * degree);
  const Points3 start = random_points(200, region);
  Recipe recipe{.surface = region,
                .start = {.points = start},
                .stop = {.iterations = 1},
                .method = Method::lloyd};
  const Cvt exact = make_grid(recipe);
  Density ones;
  ones.kind = Density::Kind::callable;
  ones.callable = [](const Eigen::Ref<const Points3>&, Eigen::Ref<Eigen::VectorXd> rho) {
    rho.setOnes();
  };
  recipe.resolution = ones;
  const Cvt ruled = cvt(start, plan(recipe), {.quadrature = {6, 6, 2}});
  CHECK((exact.mesh.points - ruled.mesh.points).cwiseAbs().maxCoeff() < 1e-11);
}

// Slow: a run for each number of threads and of regions, and for each interruption.
TEST_CASE(
    "region: a graded grid has the same bits for all threads and regions, and resumes [slow]") {
  const Surface region = circle(direction(20, 40), 14 * degree);
  const Density density = tanh_bump(direction(20, 40), 6 * degree, 4 * degree, 1.0 / 81);
  const Recipe recipe{
      .cells = 1500, .resolution = density, .surface = region, .stop = {.tolerance = 3e-4}};
  const auto with = [&](std::size_t threads, int regions) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return make_grid(recipe, {.decomposition = {.regions = regions}});
  };
  const Cvt one = with(1, 1);
  CHECK(one.mesh.points.cols() == 1500);
  CHECK(one.report.converged);
  CHECK(one.report.well_centred);
  CHECK(std::abs(sum_of_cells(region, one.mesh.points, density) / region.area() - 1) < 1e-12);
  CHECK(identical(one.mesh, with(2, 12).mesh));
  CHECK(identical(one.mesh, with(4, 42).mesh));
  const Scratch scratch;
  std::vector<CvtState> states;
  const auto keep = [&](const Progress& now) {
    states.push_back(now.run->state);
    return ProgressReply::proceed;
  };
  make_grid(recipe, {.progress = keep});
  for (std::size_t k = 5; k < states.size(); k += states.size() / 4) {
    write_checkpoint(scratch / "run.ckpt", states[k], "same");
    const CvtState state = read_checkpoint(scratch / "run.ckpt", "same");
    CHECK(identical(make_grid(recipe, {.state = state}).mesh, one.mesh));
  }
}

TEST_CASE("region: a wider one holds all places within the distance") {
  for (const auto& [name, region] : regions()) {
    if (name == "170 degrees" || name == "hemisphere")
      continue;
    CAPTURE(name);
    const Surface wide = widened(region, 3 * degree);
    REQUIRE(!wide.is_whole_sphere());
    CHECK(wide.area() > region.area());
    for (const DoubleMatrix& ring : region.rings())
      for (Eigen::Index k = 0; k < ring.cols(); ++k)
        for (int a = 0; a < 8; ++a) {
          const Eigen::Vector3d x = ring.col(k).normalized(), east = x.unitOrthogonal(),
                                north = x.cross(east);
          const double angle = a * std::numbers::pi / 4;
          CHECK(wide.contains(std::cos(3 * degree) * x +
                              std::sin(3 * degree) *
                                  (std::cos(angle) * east + std::sin(angle) * north)));
        }
  }
  CHECK(widened(circle(direction(0, 0), 170 * degree), 0.1).is_whole_sphere());
  CHECK_THROWS_AS(widened(circle(direction(0, 0), 1), -1), Error);
}

TEST_CASE("region: bad input is an error") {
  const Surface region = circle(direction(0, 0), 10 * degree);
  Points3 start = random_points(20, region);
  start.col(7) = direction(90, 0);
  CHECK(message_of(start, region).find("generator 7 is outside the region") == 0);
  CHECK(has(message_of(random_points(3, region), region), "at least 4"));
  CHECK(has(message_of(start,
                       domain_detail::UncheckedSurface::of_sphere({region.rings()[0].leftCols(2)})),
            "corners"));
}
