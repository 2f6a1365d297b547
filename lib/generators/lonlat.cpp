// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/generators.h>

#include "base/lonlat.h"
#include "base/message.h"
#include "base/points.h"
#include "base/require.h"

#include <calotte/error.h>

#include <cmath>

namespace calotte {
namespace {

using base_detail::message, base_detail::refuse_at;

void require_lonlat(double longitude, double latitude, Eigen::Index i) {
  if (!std::isfinite(longitude) || !std::isfinite(latitude))
    throw Error(ErrorCode::not_finite,
                message("point {}: longitude or latitude is not finite; remove or correct it", i),
                i);
  if (std::abs(latitude) > 90)
    refuse_at(i, "point {}: the latitude is not within -90 to 90 degrees; give longitude, then "
                 "latitude");
}

} // namespace

Points3 from_lonlat(const PointsRef& lonlat) {
  base_detail::require(lonlat.rows() == 2, "longitudes and latitudes must have 2 rows");
  Points3 points(3, lonlat.cols());
  for (Eigen::Index i = 0; i < lonlat.cols(); ++i) {
    require_lonlat(lonlat(0, i), lonlat(1, i), i);
    const base_detail::Vec3 p = base_detail::from_lonlat(lonlat(0, i), lonlat(1, i));
    points.col(i) << p.x, p.y, p.z;
  }
  return points;
}

Points2 to_lonlat(const PointsRef& points) {
  base_detail::require(points.rows() == 3, "points on the sphere must have 3 rows");
  Points2 lonlat(2, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const base_detail::LonLat at =
        base_detail::lonlat_of({points(0, i), points(1, i), points(2, i)});
    lonlat.col(i) << at.longitude, at.latitude;
  }
  return lonlat;
}

} // namespace calotte
