// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/ocean.h>
#include <calotte/remap.h>
#include <calotte/voronoi.h>

#include "base/lonlat.h"
#include "delaunay/delaunay.h"
#include "support/constants.h"
#include "support/directions.h"
#include "support/files.h"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

// Fractions of land in cells, from the areas that they share with the boxes of rasters.

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

/// A part of the latitudes, where the part of a parallel that is shared is smooth inside.
double integral(double south, double north, const std::function<double(double)>& length) {
  constexpr int steps = 32; // trapezia after tanh-sinh: roots at the ends do no harm
  double sum = 0;
  for (int k = -steps; k <= steps; ++k) {
    const double t = 3.2 * k / steps, inner = 0.5 * pi * std::sinh(t),
                 weight = 0.5 * pi * std::cosh(t) / (std::cosh(inner) * std::cosh(inner));
    sum += weight * length(0.5 * (south + north) + 0.5 * (north - south) * std::tanh(inner));
  }
  return sum * 3.2 / steps * 0.5 * (north - south);
}

/// The area that a convex cell shares with a box, in radians, from the lengths of parallels between
/// great circles and meridians.
double shared_area(const Points3& corners, double west, double east, double south, double north) {
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> breaks{south, north};
  for (Eigen::Index k = 0; k < corners.cols(); ++k) {
    const Eigen::Vector3d from = corners.col(k), to = corners.col((k + 1) % corners.cols()),
                          normal = from.cross(to - from).normalized();
    normals.push_back(normal);
    const double top = std::atan2(normal.head<2>().norm(), std::abs(normal.z()));
    for (const double latitude : {std::atan2(from.z(), from.head<2>().norm()), top, -top})
      breaks.push_back(latitude);
    for (const double side : {west, east})
      breaks.push_back(
          std::atan(-(normal.x() * std::cos(side) + normal.y() * std::sin(side)) / normal.z()));
  }
  const auto length = [&](double latitude) {
    const double high = std::sin(latitude), wide = std::cos(latitude);
    std::vector<double> ends{west, east};
    for (const Eigen::Vector3d& n : normals) {
      const double size = wide * n.head<2>().norm(), middle = std::atan2(n.y(), n.x());
      if (const double half = std::acos(-n.z() * high / size); half == half)
        for (const double end : {middle - half, middle + half})
          for (const double turn : {-4 * pi, -2 * pi, 0.0, 2 * pi, 4 * pi})
            if (end + turn > west && end + turn < east)
              ends.push_back(end + turn);
    }
    std::sort(ends.begin(), ends.end());
    double sum = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const double middle = 0.5 * (ends[k] + ends[k + 1]);
      const Eigen::Vector3d x(wide * std::cos(middle), wide * std::sin(middle), high);
      if (std::all_of(normals.begin(), normals.end(), [&](const auto& n) { return n.dot(x) > 0; }))
        sum += ends[k + 1] - ends[k];
    }
    return sum * wide;
  };
  std::sort(breaks.begin(), breaks.end());
  double sum = 0;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    if (breaks[k] >= south && breaks[k + 1] <= north && breaks[k + 1] - breaks[k] > 1e-15)
      sum += integral(breaks[k], breaks[k + 1], length);
  return sum;
}

} // namespace

TEST_CASE("a raster of one value gives it to every cell; complements add up to 1") {
  for (const Points3& points : clouds()) {
    const Voronoi cells = voronoi_of(points);
    for (const auto& [columns, rows] : {std::pair{8, 4}, std::pair{90, 45}, std::pair{361, 180}}) {
      for (const double value : {0.0, 0.3, 1.0}) {
        const Eigen::VectorXd same = land_fractions(
            cells, land_raster(columns, rows, [&](double, double) { return value; }));
        CHECK((same.array() == value).all());
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

TEST_CASE("the fractions are those of cells that are clipped one by one") {
  Raster raster = land_raster(16, 9, noise);
  raster.x[3] += 4; // irregular
  raster.y[5] -= 3;
  const LonLatBoxes boxes = lon_lat_boxes(raster);
  for (const Points3& points : {random_sphere(60, 3), bisected_icosahedron(1)}) {
    const Voronoi cells = voronoi_of(points);
    const Eigen::VectorXd land = land_fractions(cells, raster);
    for (Eigen::Index i = 0; i < land.size(); ++i) {
      Points3 corners(3, cells.vertices_on_cell.count(i));
      for (Eigen::Index k = 0; k < corners.cols(); ++k)
        corners.col(k) = cells.vertices.col(cells.vertices_on_cell[i][static_cast<std::size_t>(k)]);
      double sum = 0, area = 0;
      for (int column = 0; column < raster.x.size(); ++column)
        for (int row = 0; row < raster.y.size(); ++row) {
          const double shared = shared_area(
              corners, boxes.meridians[column] * degree, boxes.meridians[column + 1] * degree,
              boxes.parallels[row] * degree, boxes.parallels[row + 1] * degree);
          sum += shared * raster.values(column, row);
          area += shared;
        }
      CHECK(std::abs(area / cells.cell_area[i] - 1) < 1e-12);
      CHECK(std::abs(land[i] - sum / area) < 1e-12);
    }
  }
}

TEST_CASE("the land of all cells is that of the raster") {
  for (const Points3& points : clouds()) {
    const Voronoi cells = voronoi_of(points);
    for (const auto& [columns, rows] : {std::pair{8, 4}, std::pair{90, 45}, std::pair{361, 180}}) {
      const Raster raster = land_raster(columns, rows, noise);
      const double all = areas(lon_lat_boxes(raster)).dot(raster.values.reshaped());
      CHECK(std::abs(land_fractions(cells, raster).dot(cells.cell_area) - all) < 1e-12);
    }
  }
}

TEST_CASE("a raster that ends before the poles and its first meridian reaches both") {
  Raster raster = land_raster(36, 18, noise), part = raster;
  part.x = raster.x.head(30);
  part.y = raster.y.segment(2, 12);
  part.values = raster.values.block(0, 2, 30, 12);
  const LonLatBoxes boxes = lon_lat_boxes(part);
  CHECK(boxes.meridians[30] - boxes.meridians[0] == 360);
  CHECK(boxes.meridians[30] == 0.5 * (part.x[29] + part.x[0] + 360));
  CHECK(boxes.parallels[0] == -90);
  CHECK(boxes.parallels[12] == 90);
  CHECK(areas(boxes).sum() == doctest::Approx(4 * pi).epsilon(1e-14));
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
  const Raster raster = land_raster(144, 600, noise);
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
