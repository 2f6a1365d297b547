// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"

#include "base/circle.h"

#include <cmath>

namespace calotte::base_detail {
namespace {

/// std::remainder and std::fmod are exact, and so is the reduction to an octant, except for the
/// last subtraction, which rounds once.
CosSin cos_sin(double degrees) {
  const double turned = std::remainder(degrees, 360.0), angle = std::abs(turned);
  const double rest = std::fmod(angle, 45.0);
  const int octant = static_cast<int>(std::lround((angle - rest) / 45));
  CosSin p = cos_sin_of_octant(octant, (octant % 2 == 0 ? rest : 45 - rest) / 45);
  if (turned < 0)
    p.sin = -p.sin;
  return p;
}

} // namespace

Vec3 from_lonlat(double longitude, double latitude) {
  const CosSin east = cos_sin(longitude), north = cos_sin(latitude);
  // Adding 0 turns -0 into 0, so that equal places have equal bits.
  return {north.cos * east.cos + 0.0, north.cos * east.sin + 0.0, north.sin + 0.0};
}

} // namespace calotte::base_detail
