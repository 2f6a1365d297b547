// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

CALOTTE_API_BEGIN
namespace calotte {

/// The library's dynamic matrices of doubles: Eigen's, with the option DontAlign. Their memory
/// comes from std::malloc whatever the instruction set that a file is compiled for, so it may be
/// freed on either side of the library's boundary. Eigen's other matrices convert to them, and from
/// them, by a copy.
using DoubleVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::DontAlign>;
/// The same with any number of rows and columns.
using DoubleMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::DontAlign>;

/// 3 x n numbers, three a column.
using Triples = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::DontAlign>;

/// 3 x n, one Cartesian point a column. On the sphere a column is a *direction*: its norm has no
/// effect and must be from 1e-200 to 1e200. Every predicate is evaluated as if x/|x| were exactly
/// on the unit sphere. Zero and non-finite columns are errors; other norms out of range are not
/// detected.
using Points3 = Triples;

/// 2 x n, one Cartesian point x y a column, in any unit of length.
using Points2 = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::DontAlign>;

/// Points that a caller passes, 3 x n on the sphere or 2 x n in the plane, one Cartesian point a
/// column. Functions that take them check the number of rows at run time: Error invalid_argument.
///
/// Matrices of fixed or dynamic rows, aligned or not, their columns and blocks, and Eigen::Map are
/// read in place. Expressions, and matrices whose columns are not contiguous (transposed,
/// row-major), are evaluated into a temporary first. A std::vector<double> or
/// std::span<const double> of n points comes in as
///
///     Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, n)    // x y z, x y z, ...
///     Eigen::Map<const Eigen::MatrixX3d>(values.data(), n, 3).transpose()  // all x, all y, all z
using PointsRef = Eigen::Ref<const DoubleMatrix>;

/// 3 x m 0-based ids, one triangle a column.
using Triangles = Eigen::Matrix<std::int32_t, 3, Eigen::Dynamic, Eigen::DontAlign>;

/// Ids of sites, triangles, cells, edges or vertices.
using Ids = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// 2 x m ids, one pair a column.
using Pairs = Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic, Eigen::DontAlign>;

/// Offsets of lists that are stored one after another.
using Offsets = Eigen::Matrix<std::int64_t, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// n lists in one array, such as the edges of each cell: list i is items[begin[i]] to
/// items[begin[i + 1] - 1].
/// \tparam Items, Begin arrays with data(): vectors of Eigen or of the standard library.
template <class Items, class Begin = Offsets> struct Lists {
  Begin begin = {}; ///< n + 1, ascending from 0; none if there are no lists
  Items items = {}; ///< begin[n] in all

  /// The number of lists.
  std::int64_t size() const { return std::ssize(begin) > 0 ? std::ssize(begin) - 1 : 0; }
  /// The number of items of list i.
  std::int64_t count(std::int64_t i) const { return begin.data()[i + 1] - begin.data()[i]; }
  /// The items of list i. The lists must outlive the span: keep the result of a function before you
  /// walk through one of its lists.
  auto operator[](std::int64_t i) const& {
    return std::span(items.data() + begin.data()[i], length(i));
  }
  /// The items of list i, for writing.
  auto operator[](std::int64_t i) & { return std::span(items.data() + begin.data()[i], length(i)); }
  auto operator[](std::int64_t i) && = delete;
  auto operator[](std::int64_t i) const&& = delete;

private:
  std::size_t length(std::int64_t i) const { return static_cast<std::size_t>(count(i)); }
};

/// Lists of ids.
using IdLists = Lists<Ids>;

} // namespace calotte
CALOTTE_API_END
