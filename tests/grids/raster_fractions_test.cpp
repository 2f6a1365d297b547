// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/ocean.h>
#include <calotte/voronoi.h>

#include "base/lonlat.h"
#include "delaunay/delaunay.h"
#include "support/constants.h"
#include "support/directions.h"
#include "support/files.h"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

// Fractions of land in cells, sampled from rasters.

using namespace calotte;
using namespace calotte::test;

namespace {

/// A raster with its nodes in the middle of equal steps.
Raster land_raster(int columns, int rows,
                   const std::function<double(double lon, double lat)>& land) {
  Raster raster;
  raster.x = Eigen::VectorXd::LinSpaced(columns, -180 + 180.0 / columns, 180 - 180.0 / columns);
  raster.y = Eigen::VectorXd::LinSpaced(rows, -90 + 90.0 / rows, 90 - 90.0 / rows);
  raster.values.resize(columns, rows);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      raster.values(i, j) = land(raster.x[i], raster.y[j]);
  return raster;
}

Voronoi voronoi_of(const Points3& points) { return voronoi(delaunay(points)); }

std::vector<Points3> clouds() {
  return {bisected_icosahedron(0), bisected_icosahedron(2), cubed_sphere(8), fibonacci_sphere(1000),
          random_sphere(500, 3)};
}

double noise(double lon, double lat) {
  return 0.5 + 0.5 * std::sin(7 * lon * degree) * std::cos(11 * lat * degree);
}

} // namespace

TEST_CASE("a raster of one value gives it to every cell; complements add up to 1") {
  for (const Points3& points : clouds()) {
    const Voronoi cells = voronoi_of(points);
    for (const auto& [columns, rows] : {std::pair{8, 4}, std::pair{90, 45}, std::pair{361, 180}}) {
      for (const double value : {0.0, 0.3, 1.0}) {
        const Eigen::VectorXd same = land_fractions(
            cells, land_raster(columns, rows, [&](double, double) { return value; }));
        CHECK((same.array() - value).abs().maxCoeff() < 1e-12);
      }
      Raster raster = land_raster(columns, rows, noise);
      const Eigen::VectorXd land = land_fractions(cells, raster);
      raster.values = 1 - raster.values.array();
      const Eigen::VectorXd sea = land_fractions(cells, raster);
      CHECK((land + sea - Eigen::VectorXd::Ones(land.size())).cwiseAbs().maxCoeff() < 1e-12);
      CHECK(land.minCoeff() >= 0);
      CHECK(land.maxCoeff() <= 1);
    }
  }
}

TEST_CASE("a fine raster of a region gives about the exact fractions") {
  for (const Surface& region :
       {circle(direction(30, 40), 50 * degree), circle(direction(0, 90), 20 * degree),
        circle(direction(180, -5), 30 * degree)}) {
    const Raster raster = land_raster(720, 360, [&](double lon, double lat) {
      return region.contains(direction(lon, lat)) ? 1 : 0;
    });
    const Coast coast{{region.rings().begin(), region.rings().end()}, region.area()};
    for (const Points3& points : {fibonacci_sphere(400), bisected_icosahedron(3)}) {
      const Voronoi cells = voronoi_of(points);
      const Eigen::VectorXd sampled = land_fractions(cells, raster),
                            exact = land_fractions(cells, coast);
      // Of a cell about 10 degrees wide, half of the rectangles along its boundary and the coast.
      CHECK((sampled - exact).cwiseAbs().maxCoeff() < 0.06);
      CHECK(std::abs(sampled.dot(cells.cell_area) / region.area() - 1) < 0.01);
    }
  }
}

TEST_CASE("a cell inside a rectangle of a coarse raster has its value") {
  for (const auto& [columns, rows] : {std::pair{12, 6}, std::pair{5, 3}}) {
    const Raster raster = land_raster(columns, rows, [](double lon, double lat) {
      return std::fmod(std::abs(3 * lon + 7 * lat), 10) / 10;
    });
    const auto index_of = [&](const Eigen::Vector3d& x) {
      const double lon = std::atan2(x.y(), x.x()) / degree, lat = std::asin(x.z()) / degree;
      return std::pair{static_cast<Eigen::Index>((lon + 180) / 360 * columns),
                       static_cast<Eigen::Index>((lat + 90) / 180 * rows)};
    };
    const Voronoi cells = voronoi_of(random_sphere(4000, 11));
    const Eigen::VectorXd fractions = land_fractions(cells, raster);
    int within = 0;
    for (Eigen::Index i = 0; i < fractions.size(); ++i) {
      const auto own = index_of(cells.cells.col(i));
      bool inside = std::abs(cells.cells(2, i)) < 0.9;
      for (const std::int32_t vertex : cells.vertices_on_cell[i])
        inside = inside && index_of(cells.vertices.col(vertex)) == own;
      if (!inside)
        continue;
      ++within;
      CHECK(fractions[i] == doctest::Approx(raster.values(own.first, own.second)).epsilon(1e-12));
    }
    CHECK(within > 2000);
  }
}

TEST_CASE("cells that are much smaller than their neighbours have a value, too") {
  Points3 points(3, 600);
  points << random_sphere(300, 5), random_points(300, circle(direction(77, 33), 1e-5));
  const Voronoi cells = voronoi_of(points);
  const Eigen::VectorXd fractions = land_fractions(cells, land_raster(36, 18, noise));
  CHECK(fractions.minCoeff() >= 0);
  CHECK(fractions.maxCoeff() <= 1);
}

TEST_CASE("the fractions of a raster have the same bits for any number of threads") {
  const Voronoi cells = voronoi_of(fibonacci_sphere(3000));
  const Raster raster = land_raster(144, 600, noise); // more rows than are taken at once
  const Eigen::VectorXd once = land_fractions(cells, raster);
  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    CHECK(arena.execute([&] { return land_fractions(cells, raster); }) == once);
  }
}

TEST_CASE("rasters that are refused") {
  const Voronoi cells = voronoi_of(bisected_icosahedron(1));
  const Raster good = land_raster(8, 4, noise);
  const auto refusal = [&](const std::function<void(Raster&)>& spoil) {
    Raster bad = good;
    spoil(bad);
    const Error error = error_of([&] { land_fractions(cells, bad); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    return std::string(error.what());
  };
  CHECK(refusal([](Raster& r) { r.values(3, 2) = 1.5; }).find("a fraction from 0 to 1") !=
        std::string::npos);
  CHECK(refusal([](Raster& r) {
          r.values(0, 0) = std::numeric_limits<double>::quiet_NaN();
        }).find("a fraction from 0 to 1") != std::string::npos);
  CHECK(refusal([](Raster& r) { r.values.resize(4, 8); }).find("longitudes x latitudes") !=
        std::string::npos);
  CHECK(refusal([](Raster& r) { r.y.reverseInPlace(); }).find("sort them") != std::string::npos);
  CHECK(refusal([](Raster& r) { r.x[7] = 300; }).find("repeated longitudes") != std::string::npos);
}
