// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <type_traits>
#include <utility>
#include <vector>

namespace calotte::python {

namespace py = pybind11;

/// Doubles of a caller, row after row; copied only if they are of another type or layout.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The rows of an n x k array as the columns of a k x n matrix, in place.
/// \pre points is alive and two-dimensional; the Python side checks shapes.
inline Eigen::Map<const Eigen::MatrixXd> columns(const Doubles& points) {
  return {points.data(), points.shape(1), points.shape(0)};
}

/// The same of several arrays; z is 0 where they have two columns.
inline std::vector<Points3> lines_of(const std::vector<Doubles>& lines) {
  std::vector<Points3> all;
  for (const Doubles& line : lines) {
    const auto given = columns(line);
    all.emplace_back(Points3::Zero(3, given.cols())).topRows(given.rows()) = given;
  }
  return all;
}

/// An array over the memory of a matrix, which `owner` keeps alive: columns become rows, n x k, and
/// a vector n numbers.
template <class Matrix> py::array array_over(const Matrix& matrix, py::handle owner) {
  using Scalar = typename Matrix::Scalar;
  if constexpr (Matrix::ColsAtCompileTime == 1)
    return py::array_t<Scalar>({matrix.size()}, matrix.data(), owner);
  else
    return py::array_t<Scalar>({matrix.cols(), matrix.rows()}, matrix.data(), owner);
}

template <class Scalar> py::array array_over(const std::vector<Scalar>& values, py::handle owner) {
  return py::array_t<Scalar>({static_cast<py::ssize_t>(values.size())}, values.data(), owner);
}

/// A read-only array over memory of `owner`.
template <class Values> py::array view(const Values& values, py::handle owner) {
  py::array array = array_over(values, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// An array that takes the memory over.
template <class Values> py::array handed_over(Values&& values) {
  using Plain = std::remove_cvref_t<Values>;
  auto* kept = new Plain(std::forward<Values>(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<Plain*>(p); });
  return array_over(*kept, owner);
}

/// An array that takes points of a surface over: n x 3, in a plane n x 2.
inline py::array handed_over_on(const Surface& surface, Points3&& points) {
  return surface.is_sphere() ? handed_over(std::move(points))
                             : handed_over(Points2(points.topRows<2>()));
}

} // namespace calotte::python
