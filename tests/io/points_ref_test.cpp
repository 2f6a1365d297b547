// SPDX-License-Identifier: GPL-3.0-or-later
// Points come in from a caller's matrix of any kind; the number of rows is checked at run time.
#include "delaunay/delaunay.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/laws.h"

#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/widths.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <functional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Call {
  std::string name;
  std::function<void(const PointsRef&)> call;
};

Raster wide_cells() {
  Eigen::VectorXd longitudes(4), latitudes(3);
  longitudes << -180, -90, 0, 90;
  latitudes << -90, 0, 90;
  return {longitudes, latitudes, Eigen::MatrixXd::Constant(4, 3, 100)};
}

std::vector<Call> calls_on_sphere() {
  return {{"delaunay", [](const PointsRef& x) { delaunay(x); }},
          {"evaluate a density",
           [](const PointsRef& x) {
             evaluate(tanh_bump({0, 0, 1}, 0.5, 0.2, 0.1), x);
           }},
          {"evaluate a uniform density", [](const PointsRef& x) { evaluate(Density(), x); }},
          {"evaluate cell widths", [](const PointsRef& x) { evaluate(wide_cells(), x); }},
          {"given centres", [](const PointsRef& x) {
             DelaunayOptions options;
             options.decomposition.given_centres = x;
             delaunay(random_sphere(100), {}, options);
           }}};
}

Surface unit_square() { return rectangle({0, 0}, {1, 1}); }

std::vector<Call> calls_in_plane() {
  return {{"delaunay in the plane", [](const PointsRef& x) { delaunay(x, Surface::plane()); }},
          {"delaunay in a box",
           [](const PointsRef& x) {
             delaunay(x, Surface::periodic({1, 1}));
           }},
          {"a domain's rings", [](const PointsRef& x) { Surface::plane().within({x}); }}};
}

void check_refused(const Call& call, Eigen::Index rows, Eigen::Index columns) {
  CAPTURE(call.name);
  CAPTURE(rows);
  const Eigen::MatrixXd points = Eigen::MatrixXd::Constant(rows, columns, 0.5);
  const Error error = error_of([&] { call.call(points); });
  CHECK(error.code() == ErrorCode::invalid_argument);
  const std::string what = error.what();
  CHECK(what.find(std::to_string(rows) + (rows == 1 ? " row;" : " rows;")) != what.npos);
  CHECK(what.find("; give ") != what.npos);
  CHECK(what.find('\n') == what.npos);
}

bool identical_planes(const Mesh& a, const Mesh& b) {
  return identical(a, b) && a.surface == b.surface;
}

/// Calls `check` with the same points as matrices of all kinds.
template <class Points, class Check> void for_each_kind(const Points& points, const Check& check) {
  const Eigen::Index rows = points.rows(), n = points.cols();
  const Eigen::MatrixXd dynamic = points;
  const RowMajor row_major = points;
  const Eigen::MatrixXd transposed = points.transpose();
  Eigen::MatrixXd framed = Eigen::MatrixXd::Constant(rows + 2, n + 3, 7);
  framed.block(1, 2, rows, n) = points;
  std::vector<double> values(points.data(), points.data() + points.size());
  const std::span<const double> span(values);

  check("dynamic", dynamic);
  check("row-major", row_major);
  check("transposed", transposed.transpose());
  check("a block", framed.block(1, 2, rows, n));
  check("columns", framed.middleRows(1, rows).middleCols(2, n));
  check("an expression", 1.0 * dynamic);
  check("a Map of a vector", Eigen::Map<const Points>(values.data(), rows, n));
  check("a Map of a span", Eigen::Map<const Eigen::MatrixXd>(span.data(), rows, n));
  check("a Map of separate coordinates",
        Eigen::Map<const Eigen::MatrixXd>(transposed.data(), n, rows).transpose());
}

} // namespace

TEST_CASE("points of another number of rows are refused, not read past their end") {
  for (const Eigen::Index columns : {1, 50})
    for (const Eigen::Index rows : {1, 2, 4})
      for (const Call& call : calls_on_sphere())
        check_refused(call, rows, columns);
  for (const Eigen::Index columns : {1, 50})
    for (const Eigen::Index rows : {1, 4})
      for (const Call& call : calls_in_plane())
        check_refused(call, rows, columns);
}

TEST_CASE("in the plane a third row that is not 0 is refused") {
  const Eigen::MatrixXd above = Eigen::MatrixXd::Constant(3, 9, 0.5);
  for (const Call& call : calls_in_plane()) {
    CAPTURE(call.name);
    CHECK(code_of([&] { call.call(above); }) == ErrorCode::invalid_argument);
  }
}

TEST_CASE("a matrix of another number of rows that is handed over is refused, too") {
  const auto code = [](const auto& act) { return code_of(act); };
  CHECK(code([] { delaunay(Eigen::MatrixXd(2, 1000)); }) == ErrorCode::invalid_argument);
  CHECK(code([] { delaunay(Points2(2, 1000)); }) == ErrorCode::invalid_argument);
  CHECK(code([] { delaunay(Eigen::MatrixXd::Ones(3, 1000), Surface::plane()); }) ==
        ErrorCode::invalid_argument);
  CHECK(code([] { delaunay(Points3::Ones(3, 1000), Surface::plane()); }) ==
        ErrorCode::invalid_argument);
}

TEST_CASE("the message names the rows and the remedy") {
  const Eigen::MatrixXd two(2, 9), three = Eigen::MatrixXd::Constant(3, 9, 0.5), none;
  CHECK(message_of([&] { delaunay(two); }) ==
        "the points have 2 rows; give 3 x n columns x y z, or call triangulate() with a surface of "
        "the plane");
  CHECK(message_of([&] { delaunay(none); }) == "the points have 0 rows; give 3 x n columns x y z");
  CHECK(message_of([&] { delaunay(three, Surface::plane()); }) ==
        "point 0 of the plane has the z 0.5; give z = 0, or 2 rows");
  CHECK(message_of([&] { make_grid({.surface = unit_square(), .start = {.points = three}}); }) ==
        "point 0 of the plane has the z 0.5; give z = 0, or 2 rows");
}

TEST_CASE("empty matrices are refused, or give nothing") {
  const auto code = [](const auto& act) { return code_of(act); };
  CHECK(code([] { delaunay(Eigen::MatrixXd()); }) == ErrorCode::invalid_argument);
  CHECK(code([] { delaunay(Eigen::MatrixXd(0, 9)); }) == ErrorCode::invalid_argument);
  CHECK(code([] { delaunay(Eigen::MatrixXd(3, 0)); }) == ErrorCode::too_few_sites);
  CHECK(code([] { delaunay(Points3()); }) == ErrorCode::too_few_sites);
  CHECK(code([] { delaunay(Eigen::MatrixXd(2, 0), Surface::plane()); }) ==
        ErrorCode::too_few_sites);
  CHECK(evaluate(Density(), Eigen::MatrixXd(3, 0)).size() == 0);
  CHECK(evaluate(Density(), Eigen::MatrixXd(2, 0), unit_square()).size() == 0);
  CHECK(evaluate(wide_cells(), Eigen::MatrixXd(3, 0)).size() == 0);
}

TEST_CASE("matrices of any options are read in place, and take results") {
  const auto read = [](const PointsRef& x) { return x.data(); };
  const Points3 points = random_sphere(9, 3);
  const Eigen::Matrix3Xd aligned = points;
  const Eigen::MatrixXd dynamic = points;
  const Eigen::Matrix<double, 3, 9> fixed = points;
  CHECK(read(points) == points.data());
  CHECK(read(aligned) == aligned.data());
  CHECK(read(dynamic) == dynamic.data());
  CHECK(read(fixed) == fixed.data());
  CHECK(read(points.middleCols(2, 4)) == points.col(2).data());
  CHECK(read(aligned.col(5)) == aligned.col(5).data());
  CHECK(read(Eigen::Map<const Eigen::Matrix3Xd>(points.data(), 3, 9)) == points.data());

  Density density;
  density.kind = Density::Kind::callable;
  const double* last = nullptr;
  density.callable = [&](const Eigen::Ref<const Eigen::Matrix3Xd>& x,
                         Eigen::Ref<DoubleVector> rho) {
    last = x.data();
    rho = x.row(2).array().abs() + 1;
  };
  DoubleVector rho(9);
  density.callable(points, rho);
  CHECK(last == points.data());
  CHECK(rho == DoubleVector(points.row(2).cwiseAbs().array() + 1));

  Eigen::VectorXd values = evaluate(density, aligned);
  CHECK(values == evaluate(density, points));
  values = evaluate(wide_cells(), fixed);
  const Mesh mesh = delaunay(random_sphere(50, 3));
  CHECK_NOTHROW(interpolated_density(mesh, Eigen::VectorXd::Ones(50)));
}

TEST_CASE("any kind of matrix gives the same mesh of the sphere") {
  const Points3 points = random_sphere(5000, 3);
  const Mesh mesh = delaunay(points);
  const Eigen::VectorXd rho = evaluate(tanh_bump({0, 0, 1}, 0.5, 0.2, 0.1), points),
                        widths = evaluate(wide_cells(), points);
  for_each_kind(points, [&](const char* kind, const auto& other) {
    CAPTURE(kind);
    CHECK(identical(delaunay(other), mesh));
    CHECK(evaluate(tanh_bump({0, 0, 1}, 0.5, 0.2, 0.1), other) == rho);
    CHECK(evaluate(wide_cells(), other) == widths);
  });
}

TEST_CASE("any kind of matrix gives the same mesh of the plane") {
  const Surface box = Surface::periodic({1, 1});
  const Points2 points = random_points(5000, unit_square(), {}, 3).topRows<2>();
  const Mesh mesh = delaunay(points, Surface::plane()), periodic = delaunay(points, box);
  const Density bump = tanh_bump({0.5, 0.5, 0}, 0.2, 0.1, 0.1);
  const Eigen::VectorXd rho = evaluate(bump, points, box);
  for_each_kind(points, [&](const char* kind, const auto& other) {
    CAPTURE(kind);
    CHECK(identical_planes(delaunay(other, Surface::plane()), mesh));
    CHECK(identical_planes(delaunay(other, box), periodic));
    CHECK(evaluate(bump, other, box) == rho);
  });
}

TEST_CASE("centres of regions are 3 x k, in the plane 2 x k or 3 x k") {
  const Points3 points = random_sphere(2000, 3);
  DelaunayOptions options;
  options.decomposition.given_centres = Eigen::MatrixXd(random_sphere(9, 4));
  const Triangulation sphere = triangulate(points, {}, options);
  CHECK(identical(sphere.mesh, delaunay(points)));
  CHECK(sphere.report.regions == 9);
  const Points2 planar = random_points(2000, unit_square(), {}, 3).topRows<2>();
  for (const Eigen::Index rows : {2, 3}) {
    Eigen::MatrixXd centres = Eigen::MatrixXd::Constant(rows, 9, 5);
    centres.topRows(2) = random_points(9, unit_square(), {}, 4).topRows<2>();
    options.decomposition.given_centres = centres;
    const Triangulation plane = triangulate(planar, Surface::plane(), options);
    CHECK(identical_planes(plane.mesh, delaunay(planar, Surface::plane())));
    CHECK(plane.report.regions == 9);
  }
}

TEST_CASE("columns of contiguous coordinates are read in place") {
  const Points3 fixed = random_sphere(20, 3);
  CHECK(PointsRef(fixed).data() == fixed.data());
  const Eigen::MatrixXd dynamic = fixed;
  CHECK(PointsRef(dynamic).data() == dynamic.data());
  CHECK(PointsRef(dynamic.middleCols(3, 5)).data() == dynamic.data() + 9);
  CHECK(PointsRef(dynamic.topRows(2)).data() == dynamic.data());
  const std::vector<double> values(60, 1);
  CHECK(PointsRef(Eigen::Map<const Points3>(values.data(), 3, 20)).data() == values.data());
}

TEST_CASE("points that are handed over become the mesh's") {
  Points3 points = random_sphere(5000, 3);
  const double* data = points.data();
  const Mesh mesh = delaunay(std::move(points));
  CHECK(mesh.points.data() == data);
}

TEST_CASE("points of 2 or 3 rows are written, others are refused before there is a file") {
  Eigen::MatrixXd points(3, 2);
  points << 1, 4, 2, 5, 3, 6;
  std::ostringstream out;
  write_points(out, points);
  write_points(out, points.topRows(2));
  CHECK(out.str() == "1 2 3\n4 5 6\n1 2\n4 5\n");
  const test::Scratch scratch;
  const std::string path = scratch / "points.txt";
  for (const Eigen::Index rows : {0, 1, 4}) {
    const Eigen::MatrixXd other = Eigen::MatrixXd::Zero(rows, 5);
    CHECK(code_of([&] { write_points(path, other); }) == ErrorCode::invalid_argument);
    CHECK(code_of([&] { write_points(out, other); }) == ErrorCode::invalid_argument);
    CHECK(scratch.files() == 0);
  }
}
