// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "delaunay/delaunay.h"
#include "support/clouds.h"
#include "support/constants.h"
#include "support/densities.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

/// Of the values that are numbers.
ValueRange range_of(const Eigen::VectorXd& values) {
  ValueRange range{HUGE_VAL, 0, -HUGE_VAL};
  std::int64_t count = 0;
  for (const double value : values)
    if (!std::isnan(value)) {
      range.min = std::min(range.min, value);
      range.max = std::max(range.max, value);
      range.mean += value;
      ++count;
    }
  range.mean /= static_cast<double>(count);
  return range;
}

void check_range(const char* what, const Eigen::VectorXd& values, const ValueRange& expected) {
  CAPTURE(what);
  const ValueRange range = range_of(values);
  constexpr double epsilon = 1e-11;
  CHECK(std::abs(range.min - expected.min) <= epsilon * std::abs(expected.max));
  CHECK(std::abs(range.mean - expected.mean) <= epsilon * std::abs(expected.max));
  CHECK(std::abs(range.max - expected.max) <= epsilon * std::abs(expected.max));
}

std::int64_t numbers_in(const Eigen::VectorXd& values) {
  return values.size() - values.array().isNaN().count();
}

/// The ranges of cells and triangles in the summary are those of the lists.
void check_ranges(const CellMeasures& cells, const Quality& quality) {
  check_range("sigma", cells.sigma, quality.sigma);
  check_range("quality", cells.quality, quality.cell_quality);
  check_range("area", cells.area, quality.cell_area);
  CHECK(range_of(cells.largest_angle).max == doctest::Approx(quality.angles.max));
  std::vector<std::int64_t> degrees(quality.degrees.size());
  for (const double degree : cells.degree)
    if (!std::isnan(degree))
      ++degrees.at(static_cast<std::size_t>(degree));
  CHECK(degrees == quality.degrees);
}

double least_of(const Eigen::VectorXd& values) { return range_of(values).min; }

} // namespace

TEST_CASE("the lists have the ranges of quality() on closed meshes") {
  const std::vector<Points3> starts = {bisected_icosahedron(2), spiral_sphere(100),
                                       random_sphere(200, 6), signs_of({1, 1, 1}),
                                       lat_lon_sphere(7, 12, true)};
  for (const Points3& points : starts)
    for (const Density& density : {Density{}, x8()}) {
      CAPTURE(points.cols());
      const Mesh mesh = delaunay(points);
      const CellMeasures cells = cell_measures(mesh, density);
      const Quality quality = calotte::quality(mesh, density);
      check_ranges(cells, quality);
      check_range("triangle quality", cells.triangle_quality, quality.triangle_quality);
      CHECK(cells.triangle_angle.maxCoeff() == doctest::Approx(quality.angles.max));
      CHECK(cells.min_dc_over_h.minCoeff() == doctest::Approx(quality.dc_over_h.min));
      CHECK(cells.max_dc_over_h.maxCoeff() == doctest::Approx(quality.dc_over_h.max));
      CHECK((cells.min_dc_over_h.array() <= cells.max_dc_over_h.array()).all());
      CHECK(cells.area.sum() == doctest::Approx(4 * pi));
      // The residual is the root of the mean of the squared distances, over h.
      const double squares = cells.off_centroid.cwiseProduct(cells.spacing).squaredNorm();
      CHECK(std::sqrt(squares / (4 * pi)) == doctest::Approx(quality.residual).epsilon(1e-9));
      CHECK(cells.prescribed.size() == mesh.points.cols());
    }
}

TEST_CASE("an open mesh has measures of the cells that triangles surround") {
  Points3 points = random_sphere(400, 9);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points(2, i) = std::abs(points(2, i)) + 0.1;
  const Mesh mesh = delaunay(points);
  const CellMeasures cells = cell_measures(mesh);
  check_ranges(cells, open_quality(mesh));
  CHECK(numbers_in(cells.area) == numbers_in(cells.degree));
  CHECK(numbers_in(cells.area) < 400);
  CHECK(numbers_in(cells.spacing) == 400); // also at the boundary
  CHECK(numbers_in(cells.off_centroid) == 0);
  CHECK(cells.min_dc_over_h.size() == 0);
}

TEST_CASE("a mesh that is not Delaunay has measures of its triangles") {
  Mesh mesh = delaunay(spiral_sphere(60));
  mesh.points.col(30) += 0.3 * (mesh.points.col(31) - mesh.points.col(30)); // the ids stay
  mesh.points.col(7) += 0.45 * (mesh.points.col(8) - mesh.points.col(7));
  const CellMeasures cells = cell_measures(mesh);
  CHECK(numbers_in(cells.triangle_angle) == mesh.triangles.cols());
  CHECK(numbers_in(cells.spacing) == 60);
  CHECK(numbers_in(cells.degree) == 60);
}

TEST_CASE("in the plane the lists have the ranges of quality()") {
  const Points3 random = random_sphere(300, 3);
  const Points2 places = (random.topRows<2>().array() + 1) / 2;
  const Mesh open = delaunay(places, rectangle({-0.1, -0.1}, {1.1, 1.2}));
  const CellMeasures cells = cell_measures(open);
  check_ranges(cells, quality(open));
  CHECK(cells.area.sum() == doctest::Approx(1.2 * 1.3));
  const Mesh torus = delaunay(places, Surface::periodic({1.01, 1.02}));
  const Quality whole = quality(torus);
  const CellMeasures of_torus = cell_measures(torus);
  check_ranges(of_torus, whole);
  check_range("triangle quality", of_torus.triangle_quality, whole.triangle_quality);
  CHECK(least_of(of_torus.min_dc_over_h) == doctest::Approx(whole.dc_over_h.min));
  const double squares = of_torus.off_centroid.cwiseProduct(of_torus.spacing).squaredNorm();
  CHECK(std::sqrt(squares / (1.01 * 1.02)) == doctest::Approx(whole.residual).epsilon(1e-9));
}

TEST_CASE("no surface and no density are errors") {
  Mesh mesh = delaunay(spiral_sphere(20));
  const Density no_bump = tanh_bump({0, 0, 0}, 1, 1, 0.5);
  CHECK_THROWS_AS(cell_measures(mesh, no_bump), const Error&);
  Points3 half = random_sphere(20, 2);
  half.row(2) = half.row(2).cwiseAbs();
  CHECK_THROWS_AS(cell_measures(delaunay(half), no_bump), const Error&);
  mesh.triangles(0, 3) = 99;
  CHECK_THROWS_AS(cell_measures(mesh), const Error&);
}

TEST_CASE("a site in no triangle has no measures, and changes no others") {
  const Mesh mesh = delaunay(spiral_sphere(20));
  Mesh more = mesh;
  more.points.conservativeResize(3, 21);
  more.points.col(20) << 0, 0.6, 0.8;
  const CellMeasures alone = cell_measures(more), whole = cell_measures(mesh);
  CHECK(std::isnan(alone.spacing[20]));
  CHECK(std::isnan(alone.off_centroid[20]));
  CHECK(alone.off_centroid.head(20) == whole.off_centroid);
}
