// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"

#include "base/circle.h"
#include "base/spherical_angles.h"
#include "base/vector_loops.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calotte::base_detail {
namespace {

/// Whole turns beyond these angles need std::remainder, which is slow.
constexpr double near = 540;

/// \param degrees below `near` in size.
CALOTTE_INLINE double turned_near(double degrees) {
  const double size = std::abs(degrees);
  return size <= 180 ? degrees : degrees - std::copysign(360.0, degrees); // exact
}

/// The reduction to an octant is exact but for one subtraction, which rounds once.
/// \param turned from -180 to 180 degrees.
CALOTTE_INLINE CosSin cos_sin(double turned) {
  const double angle = std::abs(turned);
  double octant = static_cast<double>(static_cast<int>(angle * (1.0 / 45)));
  octant -= 45 * octant > angle ? 1.0 : 0.0; // the product was rounded
  octant += angle - 45 * octant >= 45 ? 1.0 : 0.0;
  const double rest = angle - 45 * octant;
  const bool odd = octant == 1 || octant == 3;
  const CosSin p = cos_sin_of_part((odd ? 45 - rest : rest) / 45);
  const double c = odd ? p.sin : p.cos, s = odd ? p.cos : p.sin;
  const bool second = octant == 2 || octant == 3; // quarter of the circle
  const double cosine = octant == 4 ? -c
                        : second    ? -s
                                    : c,
               sine = octant == 4 ? -s
                      : second    ? c
                                  : s;
  return {cosine, turned < 0 ? -sine : sine};
}

/// Adding 0 turns -0 into 0, so that equal directions have equal bits.
CALOTTE_INLINE Vec3 unit_vector(const CosSin& east, const CosSin& north) {
  return {north.cos * east.cos + 0.0, north.cos * east.sin + 0.0, north.sin + 0.0};
}

CALOTTE_VECTOR_WIDTHS
void set_near(const double* longitudes, const double* latitudes, std::int64_t n, Vec3* out) {
  CALOTTE_VECTOR_LOOP
  for (std::int64_t i = 0; i < n; ++i)
    out[i] = unit_vector(cos_sin(turned_near(longitudes[i])), cos_sin(latitudes[i]));
}

/// The vector, scaled by a power of two if the squares of its coordinates would overflow or
/// underflow.
Vec3 of_moderate_norm(const Vec3& a) {
  const double size = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  if (size > 1e-100 && size < 1e100)
    return a;
  int exponent = 0;
  std::frexp(size, &exponent);
  return {std::ldexp(a.x, -exponent), std::ldexp(a.y, -exponent), std::ldexp(a.z, -exponent)};
}

} // namespace

LonLat lonlat_of(const Vec3& direction) {
  constexpr double degrees = 180 / std::numbers::pi;
  const Vec3 east = of_moderate_norm({direction.x, direction.y, 0}),
             p = of_moderate_norm(direction);
  const bool pole = direction.x == 0 && direction.y == 0;
  return {pole ? 0 : longitude_of(east.x, east.y) * degrees, latitude_of(p.x, p.y, p.z) * degrees};
}

LonLat eastern_lonlat_of(const Vec3& direction) {
  const LonLat at = lonlat_of(direction);
  return {eastern(at.longitude, 360), at.latitude + 0.0};
}

double turned_back(double degrees) {
  return std::abs(degrees) < near ? turned_near(degrees) : std::remainder(degrees, 360.0);
}

Vec3 from_lonlat(double longitude, double latitude) {
  return unit_vector(cos_sin(turned_back(longitude)), cos_sin(latitude));
}

void from_lonlats(const double* longitudes, const double* latitudes, std::int64_t n, Vec3* out) {
  bool all_near = true;
  for (std::int64_t i = 0; i < n; ++i)
    all_near &= std::abs(longitudes[i]) < near;
  if (all_near)
    return set_near(longitudes, latitudes, n, out);
  for (std::int64_t i = 0; i < n; ++i)
    out[i] = from_lonlat(longitudes[i], latitudes[i]);
}

} // namespace calotte::base_detail
