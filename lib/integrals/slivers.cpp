// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/slivers.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

namespace calotte::integrals_detail {
namespace {

/// In bits. The determinant of three stored directions is 0 or at least 2^-159, and is compared
/// with products of lengths of 2^-53 and more.
constexpr mp_bitcnt_t precision = 512;

/// The relative error of a cotangent that is admitted.
constexpr double tolerance = 0x1p-34;

struct PreciseVec3 {
  mpf_class x, y, z;
};

PreciseVec3 operator-(const PreciseVec3& a, const PreciseVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

mpf_class dot(const PreciseVec3& a, const PreciseVec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

PreciseVec3 cross(const PreciseVec3& a, const PreciseVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// x/|x|
PreciseVec3 direction(const Vec3& given) {
  const mpf_class x(given.x, precision), y(given.y, precision), z(given.z, precision);
  const mpf_class length = sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

Vec3 rounded(const PreciseVec3& a) { return {a.x.get_d(), a.y.get_d(), a.z.get_d()}; }

/// True if rows in doubles do not resolve a triangle. Corners lie up to a roundoff above or below
/// the sphere, which tilts the triangle by that over its altitude. The tilt changes the normal's
/// length by its square and, as far as the normal is not upright already, in proportion.
bool is_sliver(const TriangleRows& rows, std::size_t lane) {
  constexpr double roundoff = 0x1p-52;
  const double a = rows.quarter[0][lane], b = rows.quarter[1][lane], c = rows.quarter[2][lane];
  const double longest = 2 * std::sqrt(std::max({a, b, c}));
  const double tilt = roundoff * longest * rows.scale[lane];
  const double circumradius = 4 * std::sqrt(a) * std::sqrt(b) * std::sqrt(c) * rows.scale[lane];
  return tilt * (tilt + circumradius) > tolerance;
}

/// As triangle_rows(). The normal's length is 0 if two directions are equal: then the rows stay.
bool resolve(const Batch& batch, Sliver& sliver, TriangleRows& rows) {
  const std::size_t lane = sliver.lane;
  const PreciseVec3 a = direction(at(batch.corner[0], lane)),
                    b = direction(at(batch.corner[1], lane)),
                    c = direction(at(batch.corner[2], lane));
  const std::array<PreciseVec3, 3> side{b - c, c - a, a - b};
  const PreciseVec3 normal = cross(side[2], side[0]);
  const mpf_class length = sqrt(dot(normal, normal));
  if (length == 0)
    return false;
  for (std::size_t v = 0; v < 3; ++v) {
    const PreciseVec3 &next = side[(v + 1) % 3], &previous = side[(v + 2) % 3];
    rows.quarter[v][lane] = 0.25 * dot(side[v], side[v]).get_d();
    rows.cotangent[v][lane] = -mpf_class(dot(next, previous) / length).get_d();
    sliver.side[v] = rounded(side[v]);
  }
  put(rounded(normal), rows.normal, lane);
  rows.scale[lane] = 1 / length.get_d();
  rows.height[lane] = dot(normal, a).get_d();
  return true;
}

} // namespace

std::vector<Sliver> resolve_slivers(const Batch& batch, TriangleRows& rows) {
  std::vector<Sliver> slivers;
  for (std::size_t lane = 0; lane < batch.count; ++lane)
    if (Sliver sliver{lane, {}};
        !(rows.clearance[lane] > 0) && is_sliver(rows, lane) && resolve(batch, sliver, rows))
      slivers.push_back(sliver);
  return slivers;
}

} // namespace calotte::integrals_detail
