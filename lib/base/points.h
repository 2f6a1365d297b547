// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "base/require.h"
#include "base/vec3.h"

#include <calotte/error.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace calotte::base_detail {

/// A reference to a column: columns of a Points3 are triples of doubles, as Vec3 is.
inline const Vec3& column(const Points3& points, std::int64_t i) {
  return *reinterpret_cast<const Vec3*>(points.data() + 3 * i);
}

inline void set_column(Points3& points, std::int64_t i, const Vec3& value) {
  *reinterpret_cast<Vec3*>(points.data() + 3 * i) = value;
}

/// Points in place, with any stride between columns.
using Points3Ref = Eigen::Ref<const Points3>;
using Points2Ref = Eigen::Ref<const Points2>;

inline const Vec3& column(const Points3Ref& points, std::int64_t i) {
  return *reinterpret_cast<const Vec3*>(points.data() + points.outerStride() * i);
}

/// A caller's point of 2 or 3 rows; z = 0 if there are 2.
inline Vec3 point(const PointsRef& points, std::int64_t i) {
  return {points(0, i), points(1, i), points.rows() > 2 ? points(2, i) : 0};
}

/// \throws Error invalid_argument unless a caller's points have the given number of rows.
/// \param columns the shape to give instead, for the message.
/// \param instead what points of the other kind need, for the message, or empty.
inline void require_rows(const PointsRef& points, Eigen::Index rows, const std::string& columns,
                         const std::string& instead) {
  const bool other = points.rows() == 2 || points.rows() == 3;
  require(points.rows() == rows, "the points have {}; give {}{}", counted(points.rows(), "row"),
          columns, other && !instead.empty() ? ", or " + instead : "");
}

/// A caller's directions, in place.
/// \param planar what points of 2 rows need, for the message, or empty.
/// \throws Error invalid_argument unless they have 3 rows.
inline Points3Ref directions_of(const PointsRef& points, const std::string& planar = {}) {
  require_rows(points, 3, "3 x n columns x y z", planar);
  return points;
}

/// A caller's points in the plane, in place: without their z.
/// \throws Error invalid_argument unless they have 2 rows, or 3 of which z is 0; with the index of
///         the first other point.
inline Points2Ref plane_points_of(const PointsRef& points) {
  if (points.rows() != 3) {
    require_rows(points, 2, "2 x n columns x y, or 3 x n with z = 0", {});
    return points;
  }
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (!(points(2, i) == 0))
      refuse_at(i, "point {} of the plane has the z {}; give z = 0, or 2 rows", points(2, i));
  return points.topRows<2>();
}

/// \throws Error not_finite for a caller's point i.
inline void require_finite(const Vec3& point, std::int64_t i) {
  if (!is_finite(point))
    throw Error(ErrorCode::not_finite,
                message("point {} has a coordinate that is NaN or infinite: remove it", i), i);
}

/// \throws Error not_finite, zero_vector for a caller's point i.
inline void require_direction(const Vec3& point, std::int64_t i) {
  require_finite(point, i);
  if (is_zero(point))
    throw Error(ErrorCode::zero_vector,
                message("point {} is the zero vector: remove it, it has no direction", i), i);
}

/// Points of the plane with z = 0.
inline Points3 with_z(const Points2Ref& xy) {
  Points3 points = Points3::Zero(3, xy.cols());
  points.topRows<2>() = xy;
  return points;
}

/// site_of_input if no input is merged: 0 to n - 1.
inline std::vector<std::int32_t> themselves(std::int64_t n) {
  std::vector<std::int32_t> sites(static_cast<std::size_t>(n));
  std::iota(sites.begin(), sites.end(), 0);
  return sites;
}

} // namespace calotte::base_detail
