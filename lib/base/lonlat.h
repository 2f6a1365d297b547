// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"

#include <cstdint>

namespace calotte::base_detail {

/// The unit vector at a longitude (any finite value) and a latitude (-90 to 90) in degrees. It is
/// exact at multiples of 90 degrees. Longitudes that differ by 360 give the same bits, and so do
/// all longitudes at a pole. No coordinate is -0. Only + - * / round here, so that every machine
/// gives the same bits.
Vec3 from_lonlat(double longitude, double latitude);

/// The same for n pairs of longitude and latitude.
void from_lonlats(const double* longitudes, const double* latitudes, std::int64_t n, Vec3* out);

/// A longitude and a latitude, degrees.
struct LonLat {
  double longitude, latitude;
};

/// The longitude from -180 to 180, 0 at the poles, and the latitude of a direction of any norm,
/// within about 1e-15 of 360; the same bits on every machine. Loops over radians call
/// longitude_of() and latitude_of(), of which these are the bits.
LonLat lonlat_of(const Vec3& direction);

/// The same with a longitude from 0 to below 360. No angle is -0.
LonLat eastern_lonlat_of(const Vec3& direction);

/// The angle reduced by whole turns to -180 to 180 degrees. Exact.
double turned_back(double degrees);

} // namespace calotte::base_detail
