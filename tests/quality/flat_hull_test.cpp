// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"

#include <calotte/delaunay.h>
#include <calotte/quality.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

// Triangles of no width along a straight border do not spoil the measures.

using namespace calotte;

namespace {

/// Turned so that no coordinate of the borders is 0.
Eigen::Matrix3d turned() {
  return (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

/// An octant: rows at equal latitudes from the equator to the pole, from longitude 0 to 90. The
/// borders are great circles, on which rounding leaves no three sites.
Points3 octant(int rows) {
  std::vector<Eigen::Vector3d> points;
  for (int row = 0; row < rows; ++row) {
    const double latitude = std::numbers::pi / 2 * row / rows;
    const int count = rows - row;
    for (int k = 0; k <= count; ++k) {
      const double longitude = std::numbers::pi / 2 * k / count;
      points.emplace_back(std::cos(latitude) * std::cos(longitude),
                          std::cos(latitude) * std::sin(longitude), std::sin(latitude));
    }
  }
  points.emplace_back(0, 0, 1);
  Points3 columns(3, std::ssize(points));
  for (std::size_t i = 0; i < points.size(); ++i)
    columns.col(static_cast<Eigen::Index>(i)) = turned() * points[i];
  return columns;
}

/// Whether all corners are on one of the three borders but for rounding.
bool is_on_border(const Mesh& mesh, Eigen::Index t) {
  for (int axis = 0; axis < 3; ++axis) {
    bool all = true;
    for (const std::int32_t site : mesh.triangles.col(t))
      all = all && std::abs(mesh.points.col(site).dot(turned().col(axis))) < 1e-14;
    if (all)
      return true;
  }
  return false;
}

} // namespace

TEST_CASE("flat triangles of the hull are counted and left out of the measures") {
  std::int64_t found = 0;
  for (const int rows : {6, 17, 40}) {
    CAPTURE(rows);
    const Mesh mesh = delaunay(octant(rows));
    std::int64_t flat = 0;
    std::set<std::int32_t> inner;
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
      flat += is_on_border(mesh, t) ? 1 : 0;
    found += flat;
    const Quality quality = open_quality(mesh);
    CHECK(quality.flat == flat);
    CHECK(quality.triangles == mesh.triangles.cols() - flat);
    CHECK(quality.triangles == rows * rows); // of a triangular net
    CHECK(quality.off_centring.max < 0.5);
    CHECK(quality.angles.min > 20);
    CHECK(quality.spacing.max < 2 * std::numbers::pi / rows);
    CHECK(triangle_quality(mesh).flat == flat);
    const CellMeasures cells = cell_measures(mesh);
    CHECK(cells.spacing.maxCoeff() < 2 * std::numbers::pi / rows);
    REQUIRE(cells.triangle_angle.size() == mesh.triangles.cols());
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
      CHECK(std::isnan(cells.triangle_angle[t]) == is_on_border(mesh, t));
  }
  CHECK(found > 0); // the inputs have such triangles
}

TEST_CASE("thin triangles along a border that are wider than rounding are measured") {
  Points3 points = octant(12);
  const Eigen::Matrix3d axes = turned();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (const Eigen::Vector3d p = axes.transpose() * points.col(i); std::abs(p.y()) < 1e-14)
      points.col(i) += 1e-9 * p.x() * p.z() * axes.col(1); // a border that is bent inwards
  const Mesh mesh = delaunay(points);
  CHECK(open_quality(mesh).triangles >= 12 * 12 + 10);
}
