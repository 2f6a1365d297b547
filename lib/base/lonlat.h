// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"

namespace calotte::base_detail {

/// The unit vector at a longitude (any finite value) and a latitude (-90 to 90) in degrees. Laws:
/// exact at multiples of 90 degrees; longitudes that differ by 360 give the same bits, and so do
/// all longitudes at a pole; no coordinate is -0. Only + - * / round here, so that every machine
/// gets the same bits.
Vec3 from_lonlat(double longitude, double latitude);

} // namespace calotte::base_detail
