// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/cells.h"
#include "cvt/functional.h"
#include "cvt/laplacian.h"
#include "cvt/multigrid.h"
#include "cvt/state.h"
#include "support/constants.h"
#include "support/densities.h"

#include <calotte/generators.h>
#include <calotte/grid.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::cvt_detail;

namespace {

/// Generators along a space-filling curve, near an optimum of the energy.
Points3 near_optimum(const Density& density, std::int64_t cells) {
  Points3 points;
  const auto keep = [&](const Progress& now) {
    points = State::of(now.run->state).points;
    return ProgressReply::proceed;
  };
  make_grid({.cells = cells,
             .resolution = density,
             .start = {.kind = CvtStart::Kind::continuation},
             .stop = {.tolerance = 1e-2}},
            {.progress = keep});
  return points;
}

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

SparseMatrix eigen_matrix(const Laplacian& laplacian) {
  const Rows& rows = laplacian.weights;
  std::vector<Eigen::Triplet<double>> elements;
  for (std::int32_t i = 0; i != rows.size(); ++i) {
    const double root = 1 / laplacian.scale[i];
    elements.emplace_back(i, i, root * root);
    for (const auto& [j, value] : rows[i])
      elements.emplace_back(i, j, -value * root / laplacian.scale[j]);
  }
  SparseMatrix matrix(rows.size(), rows.size());
  matrix.setFromTriplets(elements.begin(), elements.end());
  return matrix;
}

Points3 solved_by(Multigrid& multigrid, Points3 right) {
  multigrid.solve(right);
  return right;
}

Laplacian laplacian_of(const Points3& points, const Density& density) {
  Cells<Sphere> cells(Surface::sphere());
  cells.move(points);
  return cells.laplacian(cells.triangulate(), density);
}

/// A tangential field: smooth ones, and noise.
Points3 field(const Points3& x, int kind) {
  Points3 v = kind == 0 ? random_sphere(x.cols(), 5) : Points3(3, x.cols());
  for (Eigen::Index i = 0; kind > 0 && i < x.cols(); ++i)
    v.col(i) << std::sin(kind * x(1, i)), x(0, i) * x(2, i), std::cos(kind * x(0, i));
  make_tangential(v, x, {0, v.cols()});
  return v;
}

/// The energy's second derivative along a field, from gradients a little apart.
double curvature(Functional& functional, const Points3& x, const Points3& v) {
  const double h = std::sqrt(4 * pi / static_cast<double>(x.cols())), step = 1e-4 * h;
  const auto slope = [&](double there) {
    const Points3 points = retract(x, there, v);
    Evaluation evaluation;
    functional.evaluate(points, true, true, evaluation);
    make_tangential(evaluation.gradient, x, {0, x.cols()});
    return inner(evaluation.gradient, v);
  };
  return (slope(step) - slope(-step)) / (2 * step);
}

} // namespace

TEST_CASE("the graph Laplacian is symmetric, and almost zero on a constant") {
  for (const Density& density : {Density{}, x8()}) {
    const SparseMatrix matrix = eigen_matrix(laplacian_of(near_optimum(density, 642), density));
    const SparseMatrix transposed = matrix.transpose();
    CHECK((matrix - transposed).norm() < 1e-6 * matrix.norm()); // single precision
    const Eigen::VectorXd sums = matrix * Eigen::VectorXd::Ones(matrix.cols());
    CHECK((sums.array() > 0).all());
    CHECK((sums.array() < 0.2 * matrix.diagonal().array()).all());
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (SparseMatrix::InnerIterator entry(matrix, i); entry; ++entry)
        CHECK((entry.col() == i) == (entry.value() > 0));
  }
}

TEST_CASE("the graph Laplacian's elements are those of its formula, for triangles of any size") {
  for (const std::int64_t n : {642, 40962}) {
    const Points3 x = near_optimum(Density{}, n);
    Cells<Sphere> cells(Surface::sphere());
    cells.move(x);
    const Connectivity mesh = cells.triangulate();
    std::vector<Eigen::Triplet<double>> elements;
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
      for (int v = 0; v < 3; ++v) {
        const std::int32_t i = mesh.triangles(v, t), j = mesh.triangles((v + 1) % 3, t);
        const Eigen::Vector3d a = x.col(i), b = x.col(j), c = x.col(mesh.triangles((v + 2) % 3, t));
        const double length = (a - b).norm(),
                     cotangent = (a - c).dot(b - c) / (a - c).cross(b - c).norm();
        const double delta = std::asin(length * cotangent / (a + b).norm());
        const double weight =
            2 * (length * length * delta / 4 - delta * delta * delta / 3) / length;
        elements.emplace_back(i, j, -weight);
        elements.emplace_back(j, i, -weight);
      }
    SparseMatrix exact(x.cols(), x.cols());
    exact.setFromTriplets(elements.begin(), elements.end());
    const SparseMatrix matrix = eigen_matrix(cells.laplacian(mesh, Density{}));
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (SparseMatrix::InnerIterator entry(matrix, i); entry; ++entry)
        if (entry.col() != i)
          REQUIRE(entry.value() == doctest::Approx(exact.coeff(i, entry.col())).epsilon(1e-5));
  }
}

TEST_CASE("the graph Laplacian is near the energy's second derivative") {
  for (const Density& density : {Density{}, x8()}) {
    const Points3 x = near_optimum(density, 2562);
    const auto functional = make_functional(x, Surface::sphere(), density, {});
    const SparseMatrix matrix = eigen_matrix(laplacian_of(x, density));
    for (int kind = 0; kind < 12; kind += 3) {
      const Points3 v = field(x, kind);
      const double exact = curvature(*functional, x, v),
                   approximate = (v * matrix).cwiseProduct(v).sum();
      CAPTURE(kind);
      CHECK(exact > 0.2 * approximate);
      CHECK(exact < 1.2 * approximate);
    }
  }
}

TEST_CASE("the multigrid cycle is symmetric, positive, and contracts for any size") {
  for (const std::int64_t cells : {642, 2562, 10242}) {
    for (const Density& density : {Density{}, x8()}) {
      CAPTURE(cells);
      const Points3 x = near_optimum(density, cells);
      const SparseMatrix matrix = eigen_matrix(laplacian_of(x, density));
      Multigrid multigrid(laplacian_of(x, density));
      const Points3 a = random_sphere(x.cols(), 1), b = random_sphere(x.cols(), 2);
      const Points3 from_a = solved_by(multigrid, a), from_b = solved_by(multigrid, b);
      CHECK(inner(a, from_b) ==
            doctest::Approx(inner(b, from_a)).epsilon(1e-5)); // single precision
      CHECK(inner(a, from_a) > 0);
      Points3 solution = Points3::Zero(3, x.cols());
      double before = 0, after = 0;
      for (int k = 0; k < 12; ++k) {
        const Points3 residual = b - solution * matrix;
        before = after;
        after = std::sqrt(inner(residual, residual));
        solution += solved_by(multigrid, residual);
      }
      CHECK(after < 0.7 * before);
    }
  }
}

TEST_CASE("under 300 rows the cycle is exact in single precision") {
  const Points3 x = near_optimum(Density{}, 162), right = random_sphere(162, 3);
  const SparseMatrix matrix = eigen_matrix(laplacian_of(x, Density{}));
  Multigrid multigrid(laplacian_of(x, Density{}));
  CHECK((solved_by(multigrid, right) * matrix - right).norm() < 1e-4 * right.norm());
  CHECK(solved_by(multigrid, Points3::Zero(3, 162)).isZero(0));
}

TEST_CASE("the cycle does not depend on the units of the matrix and the right side") {
  const Points3 x = near_optimum(x8(), 2562), right = random_sphere(x.cols(), 4);
  Multigrid multigrid(laplacian_of(x, x8()));
  const Points3 solved = solved_by(multigrid, right);
  for (const double unit : {0x1p-400, 0x1p400}) { // beyond single precision
    Laplacian matrix = laplacian_of(x, x8());
    for (double& scale : matrix.scale)
      scale /= std::sqrt(unit);
    Multigrid scaled(std::move(matrix));
    CHECK((solved_by(scaled, right) * unit - solved).norm() < 1e-5 * solved.norm());
    CHECK((solved_by(multigrid, unit * right) / unit - solved).norm() < 1e-5 * solved.norm());
  }
}

TEST_CASE("fields and cycles are the same bits for any number of threads") {
  const Points3 x = near_optimum(Density{}, 40962);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Multigrid multigrid(laplacian_of(x, Density{}));
    const Points3 solved = solved_by(multigrid, random_sphere(x.cols(), 1));
    return std::pair(inner(solved, x), solved);
  };
  const auto one = with(1), four = with(4);
  CHECK(one.first == four.first);
  CHECK((one.second == four.second));
}
