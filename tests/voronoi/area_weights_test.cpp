// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/area_weights.h>

#include "support/clouds.h"
#include "support/errors.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/voronoi.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr double pi = std::numbers::pi;

/// Nodes of a part of a grid of longitudes and latitudes, degrees; rows from the south.
Points3 lat_lon_part(double west, double south, double step, int columns, int rows) {
  DoubleMatrix lonlat(2, columns * rows);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      lonlat.col(r * columns + c) << west + c * step, south + r * step;
  return from_lonlat(lonlat);
}

/// The area of the part of a cell that is nearer than `reach` to its point, by counting.
double counted_area(const Points3& points, Eigen::Index i, double reach) {
  const Eigen::Vector3d x = points.col(i).normalized(), across = x.unitOrthogonal(),
                        along = x.cross(across);
  constexpr int rings = 100, rays = 500;
  const Eigen::MatrixX3d units = points.colwise().normalized().transpose();
  double area = 0;
  for (int r = 0; r < rings; ++r) {
    const double radius = (r + 0.5) / rings * reach;
    int inside = 0;
    for (int k = 0; k < rays; ++k) {
      const double turn = 2 * pi * (k + 0.5) / rays;
      const Eigen::Vector3d p = std::cos(radius) * x + std::sin(radius) * (std::cos(turn) * across +
                                                                           std::sin(turn) * along);
      Eigen::Index nearest = 0;
      (units * p).maxCoeff(&nearest);
      inside += nearest == i ? 1 : 0;
    }
    area += inside * (2 * pi / rays) * (reach / rings) * std::sin(radius);
  }
  return area;
}

DoubleVector weights_of(const Points3& points, EdgeCells edge) {
  return area_weights(points, {}, {.edge = edge});
}

} // namespace

TEST_CASE("weights of points around the sphere are the areas of their Voronoi cells") {
  for (const std::vector<Cloud>& clouds : {small_clouds(), large_clouds()})
    for (const Cloud& cloud : clouds)
      if (cloud.closed) {
        CAPTURE(cloud.name);
        const Mesh mesh = delaunay(cloud.points);
        const DoubleVector areas = voronoi(mesh).cell_area, weights = area_weights(cloud.points);
        CHECK(std::abs(weights.sum() - 4 * pi) < 1e-13 * 4 * pi);
        CHECK(weights_of(cloud.points, EdgeCells::hull) == weights);
        std::vector<double> sums(static_cast<std::size_t>(areas.size()));
        for (Eigen::Index i = 0; i < weights.size(); ++i)
          sums[static_cast<std::size_t>(mesh.site_of_input[static_cast<std::size_t>(i)])] +=
              weights[i];
        double difference = 0;
        for (Eigen::Index i = 0; i < areas.size(); ++i)
          difference = std::max(difference, std::abs(sums[static_cast<std::size_t>(i)] - areas[i]));
        CHECK(difference < 1e-13);
      }
}

TEST_CASE("equal points share their cell") {
  const Points3 once = fibonacci_sphere(200);
  Points3 points(3, 203);
  points << once, once.col(5), 2 * once.col(5), once.col(7);
  const DoubleVector whole = area_weights(once), weights = area_weights(points);
  CHECK(std::abs(weights[5] * 3 / whole[5] - 1) < 1e-15);
  CHECK(weights[200] == weights[5]);
  CHECK(weights[201] == weights[5]);
  CHECK(std::abs(weights[202] * 2 / whole[7] - 1) < 1e-15);
  CHECK(weights[0] == whole[0]);
}

TEST_CASE("cells at the edge of a lattice are as large as those inside") {
  for (const auto& [south, step] : {std::pair{20.0, 1.0}, {-80.0, 0.25}, {-4.0, 0.5}}) {
    CAPTURE(south);
    const int columns = 25, rows = 17;
    const Points3 points = lat_lon_part(170, south, step, columns, rows);
    const DoubleVector weights = area_weights(points);
    const double h = step * pi / 180;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const double latitude = (south + r * step) * pi / 180,
                     box = 2 * h * std::cos(latitude) * std::sin(h / 2);
        CAPTURE(r);
        CAPTURE(c);
        CHECK(std::abs(weights[r * columns + c] / box - 1) <
              2e-3 * (1 + std::abs(std::tan(latitude))));
      }
  }
}

TEST_CASE("cells in discs have the areas that counting gives") {
  Random random(3);
  Points3 points(3, 60);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) << 1, random.real(-0.5, 0.5), random.real(-0.5, 0.5);
  for (const double reach : {0.02, 0.1, 0.3, 1.2, pi / 2}) {
    CAPTURE(reach);
    const DoubleVector weights =
        area_weights(points, {}, {.edge = EdgeCells::reach, .reach = reach});
    for (Eigen::Index i = 0; i < points.cols(); i += 7) {
      const double counted = counted_area(points, i, reach);
      CHECK(std::abs(weights[i] - counted) < 0.01 * counted + 1e-4 * reach * reach);
    }
  }
  // Discs that do not meet, and one that covers the half of the sphere around few points.
  const DoubleVector apart =
      area_weights(octahedron(), {}, {.edge = EdgeCells::reach, .reach = 0.5});
  for (const double area : apart)
    CHECK(std::abs(area / (2 * pi * (1 - std::cos(0.5))) - 1) < 1e-15);
}

TEST_CASE("cells of points in a hemisphere end at their hull, or cover the sphere") {
  const Points3 points = lat_lon_part(-20, 30, 1, 40, 20);
  const DoubleVector hull = weights_of(points, EdgeCells::hull),
                     whole = weights_of(points, EdgeCells::whole);
  const Mesh mesh = delaunay(points);
  double covered = 0;
  for (const auto& t : mesh.triangles.colwise()) {
    const Eigen::Vector3d a = mesh.points.col(t[0]), b = mesh.points.col(t[1]),
                          c = mesh.points.col(t[2]);
    covered += 2 * std::atan2((b - a).cross(c - a).dot(a), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  CHECK(std::abs(hull.sum() / covered - 1) < 1e-12);
  CHECK(std::abs(whole.sum() / (4 * pi) - 1) < 1e-12);
  CHECK(hull.minCoeff() > 0);
  // A whole cell at the edge is many times as large as those inside: why it is not the default.
  CHECK(whole.maxCoeff() > 100 * hull.maxCoeff());
}

TEST_CASE("an open band has cells at both edges, and a joint of two lattices has none") {
  const Points3 globe = lat_lon_sphere(90, 180, false);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < globe.cols(); ++i)
    if (std::abs(globe(2, i)) < std::sin(40 * pi / 180))
      kept.push_back(i);
  const Points3 band = globe(Eigen::all, kept);
  const DoubleVector bounded = weights_of(band, EdgeCells::neighbours), whole = area_weights(band);
  CHECK(std::abs(whole.sum() / (4 * pi) - 1) < 1e-13);
  CHECK(whole.maxCoeff() > 5 * whole.minCoeff());
  CHECK(bounded.maxCoeff() < 1.4 * bounded.minCoeff());
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (std::abs(band(2, static_cast<Eigen::Index>(i))) < std::sin(36 * pi / 180))
      CHECK(bounded[static_cast<Eigen::Index>(i)] == whole[static_cast<Eigen::Index>(i)]);

  // A fine grid in a coarse one, four times as wide.
  const Points3 coarse = fibonacci_sphere(2000), fine = fibonacci_sphere(32000);
  std::vector<Eigen::Vector3d> joint;
  for (const auto& p : coarse.colwise())
    if (p[0] < 0.8)
      joint.emplace_back(p);
  for (const auto& p : fine.colwise())
    if (p[0] >= 0.8)
      joint.emplace_back(p);
  Points3 points(3, static_cast<Eigen::Index>(joint.size()));
  for (std::size_t i = 0; i < joint.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = joint[i];
  CHECK(area_weights(points, {}, {.edge = EdgeCells::neighbours, .gap = 8}) ==
        area_weights(points));
}

TEST_CASE("weights in a plane end at the hull, the rings or the neighbours") {
  Points2 points(2, 20 * 15);
  for (int r = 0; r < 15; ++r)
    for (int c = 0; c < 20; ++c)
      points.col(20 * r + c) << 1e5 + 1e3 * c, 1e3 * r;
  const Surface plane = Surface::plane();
  const DoubleVector hull = area_weights(points, plane, {.edge = EdgeCells::hull}),
                     bounded = area_weights(points, plane);
  CHECK(std::abs(hull.sum() / (19e3 * 14e3) - 1) < 1e-12);
  CHECK(std::abs(hull[0] / 0.25e6 - 1) < 1e-12);
  CHECK(std::abs(hull[1] / 0.5e6 - 1) < 1e-12);
  for (const double area : bounded)
    CHECK(std::abs(area / 1e6 - 1) < 1e-12);
  const DoubleVector ringed = area_weights(points, rectangle({99.5e3, -500}, {119.5e3, 14.5e3}));
  CHECK(std::abs(ringed.minCoeff() / 1e6 - 1) < 1e-12);
  CHECK(std::abs(ringed.maxCoeff() / 1e6 - 1) < 1e-12);
  const DoubleVector periodic = area_weights(Points2(points.colwise() - Eigen::Vector2d(1e5, 0)),
                                             Surface::periodic({20e3, 15e3}));
  CHECK(std::abs(periodic.sum() / 3e8 - 1) < 1e-13);
}

TEST_CASE("weights have the same bits for any number of threads, and follow a permutation") {
  const Points3 points = lat_lon_part(0, 50, 0.5, 70, 60);
  const DoubleVector weights = area_weights(points);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(area_weights(points) == weights);
  }
  const DoubleVector reversed = area_weights(Points3(points.rowwise().reverse()));
  CHECK((reversed.reverse() - weights).cwiseAbs().maxCoeff() < 1e-15);
}

TEST_CASE("options of weights are checked") {
  const Points3 points = fibonacci_sphere(50);
  const auto refusal = [&](const AreaWeightOptions& options,
                           const Surface& surface = {}) -> std::string {
    return error_of([&] { area_weights(points, surface, options); }).what();
  };
  CHECK(has(refusal({.edge = EdgeCells::reach}), "the reach of cells is 0; give a positive"));
  CHECK(has(refusal({.edge = EdgeCells::reach, .reach = 2}), "at most pi/2"));
  CHECK(has(refusal({.gap = 0.5}), "the gap is 0.5; give 1 or more"));
  CHECK(has(refusal({.edge = EdgeCells::hull}, circle({1, 0, 0}, 3)), "leave the edge out"));
  CHECK(has(error_of([] {
              area_weights(Points2::Random(2, 9), Surface::plane(), {.edge = EdgeCells::whole});
            }).what(),
            "cells at the hull of points in a plane are unbounded"));
  CHECK(has(
      error_of([] {
        area_weights(Points2::Random(2, 40), Surface::periodic({2, 0}), {.edge = EdgeCells::hull});
      }).what(),
      "a channel has two boundaries"));
  Points2 near(2, 3);
  near << 0, 1e-160, 6e-316, 0, -0.004, 0;
  CHECK(has(error_of([&] {
              area_weights(near, Surface::plane(), {.edge = EdgeCells::reach, .reach = 0.3});
            }).what(),
            "has neighbours so near that their areas are no numbers"));
}
