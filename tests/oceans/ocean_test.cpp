// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/ocean.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/widths.h>

#include "base/lonlat.h"
#include "delaunay/delaunay.h"
#include "support/directions.h"
#include "support/gshhg.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

// The oceans of the Earth on uniform grids, with the coast of GSHHG.

using namespace calotte;
using namespace calotte::test;

namespace {

// The channels of straits from sea to sea, and lines across them from land to land.
const Points3 gibraltar = directions({{-7.5, 35.9}, {-5.6, 35.95}, {-3.5, 36}}),
              bosphorus = directions({{25.5, 39.6},
                                      {26.2, 40.05},
                                      {26.7, 40.4},
                                      {27.5, 40.7},
                                      {28.9, 40.9},
                                      {29.05, 41.1},
                                      {29.2, 41.5}}),
              across_gibraltar = directions({{-5.6, 37}, {-5.6, 35}}),
              across_bosphorus = directions({{28.2, 41.5}, {29.9, 40.7}}),
              across_dardanelles = directions({{26, 40.6}, {27.2, 39.7}});
const Eigen::Vector3d atlantic = direction(-30, 30), mediterranean = direction(18, 35),
                      black_sea = direction(34, 43.2);

/// A uniform grid of the Earth and its land.
struct Earth {
  Coast coast = gshhg('l');
  Voronoi cells;
  Eigen::VectorXd fractions;
  std::vector<std::uint8_t> land;

  explicit Earth(int bisections)
      : cells(voronoi(delaunay(bisected_icosahedron(bisections)))),
        fractions(land_fractions(cells, coast)) {
    for (const double fraction : fractions)
      land.push_back(fraction > 0.5 ? 1 : 0);
  }
  Eigen::Index cell_at(const Eigen::Vector3d& place) const {
    Eigen::Index nearest = 0;
    (place.transpose() * cells.cells).maxCoeff(&nearest);
    return nearest;
  }
  bool is_sea(const Ids& sea, const Eigen::Vector3d& place) const {
    return sea[cell_at(place)] >= 0;
  }
  SeaCells decided(const std::vector<Points3>& passages,
                   const std::vector<Points3>& barriers = {}) const {
    SeaOptions options;
    options.opened = cells_on_lines(cells, passages);
    options.closed = cells_on_lines(cells, barriers);
    return sea_cells(cells.cells_on_cell, land, options);
  }
  Ids sea(const std::vector<Points3>& passages, const std::vector<Points3>& barriers = {}) const {
    return decided(passages, barriers).mask;
  }
};

/// The cells that are connected with the first one of the sea.
std::int64_t reached(const Voronoi& cells, const Ids& sea) {
  std::vector<bool> seen(static_cast<std::size_t>(sea.size()));
  std::vector<std::int32_t> stack;
  for (std::int32_t i = 0; i < sea.size() && stack.empty(); ++i)
    if (sea[i] >= 0)
      stack.push_back(i);
  seen[static_cast<std::size_t>(stack.back())] = true;
  std::int64_t count = 0;
  while (!stack.empty()) {
    const std::int32_t cell = stack.back();
    stack.pop_back();
    ++count;
    for (const std::int32_t other : cells.cells_on_cell[cell])
      if (sea[other] >= 0 && !seen[static_cast<std::size_t>(other)]) {
        seen[static_cast<std::size_t>(other)] = true;
        stack.push_back(other);
      }
  }
  return count;
}

void check_sea(const Earth& earth, const Ids& sea) {
  CHECK(reached(earth.cells, sea) == (sea.array() >= 0).count());
  std::int64_t dead_ends = 0;
  for (std::int64_t i = 0; i < sea.size(); ++i) {
    int neighbours = 0;
    for (const std::int32_t other : earth.cells.cells_on_cell[i])
      neighbours += sea[other] >= 0;
    dead_ends += sea[i] >= 0 && neighbours < 2;
  }
  CHECK(dead_ends == 0);
}

void check_fractions(const Earth& earth) {
  CHECK(earth.fractions.minCoeff() >= 0);
  CHECK(earth.fractions.maxCoeff() <= 1);
  const double land = earth.fractions.dot(earth.cells.cell_area);
  CHECK(std::abs(land / earth.coast.area - 1) <= 1e-10);
  CHECK(earth.coast.area * 6371 * 6371 == doctest::Approx(149e6).epsilon(0.01)); // km^2
}

/// Each strait is open with its passage, and closed by its barrier alone.
void check_straits(const Earth& earth) {
  const auto [open, report] = earth.decided({gibraltar, bosphorus});
  CHECK(report.opened > 0);
  check_sea(earth, open);
  for (const Eigen::Vector3d& place : {atlantic, mediterranean, black_sea})
    CHECK(earth.is_sea(open, place));

  const Ids no_black_sea = earth.sea({gibraltar}, {across_bosphorus, across_dardanelles});
  check_sea(earth, no_black_sea);
  CHECK(earth.is_sea(no_black_sea, mediterranean));
  CHECK_FALSE(earth.is_sea(no_black_sea, black_sea));

  const Ids no_mediterranean = earth.sea({bosphorus}, {across_gibraltar});
  check_sea(earth, no_mediterranean);
  CHECK(earth.is_sea(no_mediterranean, atlantic));
  CHECK_FALSE(earth.is_sea(no_mediterranean, mediterranean));
  CHECK_FALSE(earth.is_sea(no_mediterranean, black_sea));

  // Both: what is opened stays open.
  const Ids both = earth.sea({gibraltar, bosphorus}, {across_gibraltar, across_bosphorus});
  for (const Eigen::Vector3d& place : {mediterranean, black_sea})
    CHECK(earth.is_sea(both, place));
}

} // namespace

TEST_CASE("the oceans at 120 and 60 km: land, a connected sea, straits") {
  for (const int bisections : {6, 7}) {
    CAPTURE(bisections);
    const Earth earth(bisections);
    check_fractions(earth);
    check_straits(earth);
  }
}

// Slow: 655 362 cells.
TEST_CASE("the oceans at 30 km: land, a connected sea, straits [slow]") {
  const Earth earth(8);
  REQUIRE(earth.cells.cells.cols() == 655362);
  check_fractions(earth);
  check_straits(earth);
}

namespace {

/// Points on a line, at most a km apart.
Points3 points_along(const Points3& line) {
  std::vector<Eigen::Vector3d> points;
  for (Eigen::Index k = 0; k + 1 < line.cols(); ++k) {
    const Eigen::Vector3d from = line.col(k), way = line.col(k + 1) - line.col(k);
    const int steps = static_cast<int>(std::ceil(way.norm() * earth_radius_km));
    for (int i = 0; i <= steps; ++i)
      points.emplace_back((from + way * i / steps).normalized());
  }
  Points3 all(3, std::ssize(points));
  for (std::size_t i = 0; i < points.size(); ++i)
    all.col(static_cast<Eigen::Index>(i)) = points[i];
  return all;
}

std::vector<Points3> example_lines(const std::string& name) {
  return read_lines(CALOTTE_FIXTURES "/../../tools/examples/" + name);
}

} // namespace

TEST_CASE("the passages of the world are in the sea from end to end, its barriers on land") {
  constexpr double half_round = std::numbers::pi * earth_radius_km, zero = 1e6;
  const Widths tells = Widths::by_distance( // the distance from the coast, positive in the sea
      gshhg('i'), {{{-half_round, zero - half_round}, {half_round, zero + half_round}}});
  const auto distances = [&](const Points3& line) {
    return DoubleVector(evaluate(tells, points_along(line)).array() - zero);
  };
  const std::vector<Points3> passages = example_lines("passages.geojson"),
                             barriers = example_lines("barriers.geojson");
  CHECK(passages.size() > 50);
  CHECK(barriers.size() > 20);
  constexpr double of_coast = 0.1; // km: what the intermediate coast simplifies
  for (std::size_t k = 0; k < passages.size(); ++k) {
    CAPTURE(k);
    const DoubleVector sea = distances(passages[k]);
    CHECK(sea.minCoeff() > -of_coast);
    CHECK(std::min(sea[0], sea[sea.size() - 1]) > 5);
  }
  for (std::size_t k = 0; k < barriers.size(); ++k) {
    CAPTURE(k);
    CHECK(distances(barriers[k]).maxCoeff() < 5 * of_coast); // canals, Matochkin Strait
  }
}

TEST_CASE("with the passages of the world the marginal seas belong to a coarse ocean") {
  const Earth earth(6);
  const SeaCells decided =
      earth.decided(example_lines("passages.geojson"), example_lines("barriers.geojson"));
  check_sea(earth, decided.mask);
  for (const auto& [longitude, latitude] : std::vector<std::array<double, 2>>{
           {34, 43.2}, {38, 20.5}, {51, 27}, {19, 57.5}, {-85, 59}, {135, 40}, {18, 35}}) {
    CAPTURE(longitude);
    CHECK(earth.is_sea(decided.mask, direction(longitude, latitude)));
  }
  const SeaCells without = earth.decided({});
  REQUIRE(!without.report.severed_parts.empty());
  CHECK(without.report.severed_parts[0].cells > 50); // the Mediterranean or the Black Sea
  for (std::size_t k = 1; k < without.report.severed_parts.size(); ++k)
    CHECK(without.report.severed_parts[k].cells <= without.report.severed_parts[k - 1].cells);
}

TEST_CASE("the widths of E3SM's unified meshes are polaris': ocean, coast, land and rivers") {
  (void)gshhg('i'); // which the rules name
  const auto widths = [](const std::string& name, const Points3& places) {
    return evaluate(read_widths(CALOTTE_FIXTURES "/../../tools/examples/unified/" + name + ".toml"),
                    places);
  };
  const auto at = [](double value) { return doctest::Approx(value).epsilon(0.01); };
  // The Pacific at the equator and at 45 S, the Sahara, the Lena, and the way inland to the Sahara.
  std::vector<std::array<double, 2>> places{{-130, 0}, {-130, -45}, {10, 24}, {127.3, 71.4}};
  constexpr int steps = 60;
  for (int k = 0; k <= steps; ++k)
    places.push_back({-17.5 + 2.5 * k / steps, 20});
  const Points3 x = directions(places);
  const Coast coast = gshhg('i');
  constexpr double far = 1e5;
  const DoubleVector from =
      evaluate(Widths::by_distance(coast, {{{-2e4, far - 2e4}, {2e4, far + 2e4}}}), x).array() -
      far;
  const auto ocean_so = [](double distance) {
    return 12 + 9 * (1 + std::tanh((distance - 500) / 1600));
  };
  const double g = std::pow(6.0 / 18, 4);
  const auto rrs = [g](double latitude) {
    return 6 *
           std::pow((1 - g) * std::pow(std::sin(latitude * std::numbers::pi / 180), 4) + g, -0.25);
  };
  const DoubleVector coarse = widths("u.oi240.lr240", x), oi30 = widths("u.oi30.lr10", x),
                     so = widths("u.oi.so12to30.lr10", x), rrs_18 = widths("u.oi6to18.lr6to10", x);
  CHECK(coarse == DoubleVector::Constant(x.cols(), 240));
  CHECK(oi30.head(3) == DoubleVector{{30, 30, 10}});
  CHECK(rrs_18[0] == at(18));
  CHECK(rrs_18[1] == at(rrs(45)));
  CHECK(rrs_18[2] == 10);
  CHECK(rrs_18[3] == at(6));
  CHECK(so[2] == 10);
  for (Eigen::Index k = 0; k < 2; ++k) // from the nearest corner of the region
    CHECK(so[k] == at(ocean_so(earth_radius_km * angle(x.col(k), direction(-124.5, -54)))));
  for (Eigen::Index k = 4; k < x.cols(); ++k) {
    const double inland = std::clamp(-from[k], 0.0, 60.0);
    CHECK(oi30[k] == at(30 - inland / 60 * 20));
    CHECK(so[k] == at(so[4] + inland / 60 * (10 - so[4])));
    CHECK(rrs_18[k] == at(rrs(20) + std::min(inland / 36, 1.0) * (10 - rrs(20))));
  }
}
