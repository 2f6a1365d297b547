// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/check.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/ocean.h>

#include "support/constants.h"
#include "support/descent.h"
#include "support/directions.h"
#include "support/files.h"
#include "support/gshhg.h"
#include "support/laws.h"
#include "support/region_laws.h"
#include "support/text.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

// Tessellations of the land within a coast.

using namespace calotte;
using namespace calotte::test;
using namespace calotte::test::region_laws;

namespace {

constexpr double square_km = 1 / (6371.0 * 6371.0); ///< steradians

} // namespace

TEST_CASE("the land around a place: the smallest ring that contains it") {
  const Surface continent = circle(direction(20, 10), 30 * degree),
                island = circle(direction(20, 10), degree);
  const Points3 lake = circle(direction(20, 10), 5 * degree).rings()[0].rowwise().reverse();
  const Coast coast{{continent.rings()[0], lake, island.rings()[0]}, 0};
  CHECK(land_around(coast, direction(20, 10)) == island);
  CHECK(land_around(coast, direction(40, 10)) == continent);
  CHECK(land_around(coast, direction(23, 10)) == continent); // in the lake
  for (const Eigen::Vector3d& sea : {direction(-160, -10), direction(60, 10)})
    CHECK(message_of([&] { land_around(coast, sea); }) ==
          "no ring of the coast contains the place; give one on land");
  CHECK(message_of([&] {
          land_around(coast, {0, 0, 0});
        }).starts_with("the place on land is no direction"));
}

TEST_CASE("the land around a place is without the loops in which its coast crosses itself") {
  const Surface island = circle(direction(20, 10), degree, 100);
  const double whole = island.area();
  const auto around = [&](const std::vector<Eigen::Index>& order) {
    return land_around({{island.rings()[0](Eigen::all, order)}, 0}, direction(20, 10));
  };
  std::vector<Eigen::Index> order(100);
  std::iota(order.begin(), order.end(), 0);
  CHECK(around(order) == island);
  for (const Eigen::Index at : {0, 7, 50, 98}) { // corners in another order, or visited again
    auto crossed = order;
    std::swap(crossed[static_cast<std::size_t>(at)], crossed[static_cast<std::size_t>(at) + 1]);
    const Surface exchanged = around(crossed);
    CHECK(std::abs(exchanged.area() / whole - 1) < 0.01);
    CHECK(exchanged.rings()[0].cols() >= 97);
    auto again = order;
    again.insert(again.begin() + at + 1, {(at + 2) % 100, (at + 1) % 100, at});
    CHECK(std::abs(around(again).area() / whole - 1) < 0.01);
  }
  std::swap(order[20], order[60]); // no small loop
  CHECK(has(message_of([&] { around(order); }), "meet; rings may neither"));
}

TEST_CASE("GSHHG: continents and islands around places, by their known areas") {
  const Coast coast = gshhg('l');
  const auto area_around = [&](double lon, double lat) {
    return land_around(coast, direction(lon, lat)).area() / square_km;
  };
  CHECK(area_around(134, -25) == doctest::Approx(7.59e6).epsilon(0.01)); // Australia's mainland
  CHECK(area_around(47, -19) == doctest::Approx(587e3).epsilon(0.02));   // Madagascar
  CHECK(area_around(-19, 65) == doctest::Approx(102e3).epsilon(0.02));   // Iceland
  CHECK(area_around(-40, 70) == doctest::Approx(2.13e6).epsilon(0.02));  // Greenland
  CHECK(area_around(0, -90) == doctest::Approx(13.9e6).epsilon(0.03));   // Antarctica with its ice
}

TEST_CASE("GSHHG: the area of a continent hardly depends on the resolution") {
  for (const Eigen::Vector3d& place :
       {direction(60, 50), direction(20, 0), direction(-60, -10), direction(-100, 45)}) {
    double least = 10, most = 0;
    for (const char resolution : {'c', 'l', 'i'}) {
      const double size = land_around(gshhg(resolution), place).area();
      least = std::min(least, size);
      most = std::max(most, size);
    }
    CHECK(most < 1.02 * least);
  }
}

TEST_CASE("Australia: the cells' areas sum to the region's, and generators stay inside") {
  const Surface australia = land_around(gshhg('l'), direction(134, -25));
  REQUIRE(australia.rings()[0].cols() > 1000);
  const double whole = australia.area();
  const Points3 start = random_points(500, australia);
  CHECK(std::abs(sum_of_cells(australia, start) / whole - 1) < 1e-12);
  const Recipe recipe{
      .surface = australia, .start = {.points = start}, .stop = {.max_iterations = 25}};
  const auto with = [&](std::size_t threads, int regions) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return make_grid(recipe, {.decomposition = {.regions = regions}});
  };
  const Cvt grid = with(1, 1);
  CHECK(std::abs(sum_of_cells(australia, grid.mesh.points) / whole - 1) < 1e-12);
  CHECK(check_surface(grid.mesh).failure == "");
  check_descent(grid.report, 1e-9);
  for (const auto& x : grid.mesh.points.colwise())
    CHECK(australia.contains(x));
  CHECK(identical(grid.mesh, with(2, 12).mesh));
  CHECK(identical(grid.mesh, with(1, 12).mesh));
  CHECK(identical(grid.mesh, with(2, 1).mesh));
}

// Slow: a run for each number of threads and of regions.
TEST_CASE("Australia: a graded grid has the same bits for all threads and regions [slow]") {
  const Surface australia = land_around(gshhg('l'), direction(134, -25));
  const Density density = tanh_bump(direction(146, -38), 6 * degree, 4 * degree, 1.0 / 81);
  const Recipe recipe{
      .cells = 1500, .resolution = density, .surface = australia, .stop = {.tolerance = 3e-4}};
  const auto with = [&](std::size_t threads, int regions) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return make_grid(recipe, {.decomposition = {.regions = regions}});
  };
  const Cvt one = with(1, 1);
  CHECK(one.mesh.points.cols() == 1500);
  CHECK(one.report.converged);
  CHECK(std::abs(sum_of_cells(australia, one.mesh.points, density) / australia.area() - 1) < 1e-12);
  CHECK(identical(one.mesh, with(2, 12).mesh));
}
