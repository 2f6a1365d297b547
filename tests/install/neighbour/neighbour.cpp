// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbour.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <utility>
#include <vector>

namespace neighbour {
namespace {

template <class Points> Points with_more(Points points, Eigen::Index more) {
  const Eigen::Index n = points.cols();
  points.conservativeResize(Eigen::NoChange, n + more);
  points.rightCols(more) = points.leftCols(more).eval();
  return points;
}

template <class Values> void append_to(Values& values, double value) {
  values.conservativeResize(values.size() + 1);
  values[values.size() - 1] = value;
}

} // namespace

bool can_run() {
#ifdef __AVX2__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

bool aligns_otherwise() { return EIGEN_DEFAULT_ALIGN_BYTES > 16 && !EIGEN_MALLOC_ALREADY_ALIGNED; }

calotte::Points3 extended(calotte::Points3 points, Eigen::Index more) {
  return with_more(std::move(points), more);
}

Eigen::Matrix3Xd extended(Eigen::Matrix3Xd points, Eigen::Index more) {
  return with_more(std::move(points), more);
}

void append(calotte::DoubleVector& values, double value) { append_to(values, value); }

void append(Eigen::VectorXd& values, double value) { append_to(values, value); }

calotte::DoubleVector ascending(Eigen::Index n) {
  return calotte::DoubleVector::LinSpaced(n, 1, static_cast<double>(n));
}

double sum(calotte::Mesh mesh) {
  mesh.triangles.resize(3, mesh.triangles.cols() + 1);
  mesh.neighbours = calotte::Triangles();
  return mesh.points.sum();
}

Eigen::VectorXd product(calotte::Weights weights, Eigen::VectorXd values) {
  weights *= 2;
  weights.prune(0.0);
  return weights * values / 2;
}

double error_of_solutions(Eigen::Index n) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
  std::vector<Eigen::Triplet<double>> elements;
  for (Eigen::Index i = 0; i != n; ++i) {
    matrix(i, i) = 4;
    matrix(i, (i + 1) % n) = matrix((i + 1) % n, i) = -1;
  }
  for (Eigen::Index i = 0; i != n; ++i)
    for (Eigen::Index j = 0; j != n; ++j)
      if (matrix(i, j) != 0)
        elements.emplace_back(static_cast<int>(i), static_cast<int>(j), matrix(i, j));
  Eigen::SparseMatrix<double> sparse(n, n);
  sparse.setFromTriplets(elements.begin(), elements.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(sparse);
  const Eigen::VectorXd right = matrix * Eigen::VectorXd::Ones(n);
  const Eigen::VectorXd one = matrix.ldlt().solve(right), other = factors.solve(right);
  return std::max((one.array() - 1).abs().maxCoeff(), (other.array() - 1).abs().maxCoeff());
}

} // namespace neighbour
