// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace calotte::test {

/// The columns of the one, then those of the other.
template <class First, class Then>
Eigen::Matrix<double, First::RowsAtCompileTime, Eigen::Dynamic>
joined(const Eigen::MatrixBase<First>& first, const Eigen::MatrixBase<Then>& then) {
  Eigen::Matrix<double, First::RowsAtCompileTime, Eigen::Dynamic> all(first.rows(),
                                                                      first.cols() + then.cols());
  all << first, then;
  return all;
}

} // namespace calotte::test
