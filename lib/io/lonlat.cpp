// SPDX-License-Identifier: GPL-3.0-or-later
#include "lonlat.h"

#include <cmath>
#include <utility>

namespace calotte::detail {
namespace {

struct CosSin {
  double cos, sin;
};

/// Of 0 to 45 degrees, by Taylor's series: the next term is below 2^-60.
CosSin octant_cos_sin(double degrees) {
  if (degrees == 45) // equal, whatever the series rounds to
    return {0x1.6a09e667f3bcdp-1, 0x1.6a09e667f3bcdp-1};
  const double x = degrees / 45 * 0x1.921fb54442d18p-1, y = x * x;
  double cosine = 1, sine = 1;
  for (int k = 18; k >= 2; k -= 2) {
    cosine = 1 - y * (1.0 / (k * (k - 1))) * cosine;
    sine = 1 - y * (1.0 / (k * (k + 1))) * sine;
  }
  return {cosine, x * sine};
}

/// std::remainder and std::fmod are exact, and so the reduction to an octant is, but for the last
/// subtraction, which rounds once.
CosSin cos_sin(double degrees) {
  const double turned = std::remainder(degrees, 360.0), angle = std::abs(turned);
  const double rest = std::fmod(angle, 45.0);
  const int octant = static_cast<int>(std::lround((angle - rest) / 45));
  CosSin p = octant_cos_sin(octant % 2 == 0 ? rest : 45 - rest);
  if (octant == 1 || octant == 2)
    std::swap(p.cos, p.sin);
  if (octant >= 2)
    p.cos = -p.cos;
  if (turned < 0)
    p.sin = -p.sin;
  return p;
}

} // namespace

Vec3 from_lonlat(double longitude, double latitude) {
  const CosSin east = cos_sin(longitude), north = cos_sin(latitude);
  // Adding 0 makes -0 into 0, so that equal places are equal bits.
  return {north.cos * east.cos + 0.0, north.cos * east.sin + 0.0, north.sin + 0.0};
}

} // namespace calotte::detail
