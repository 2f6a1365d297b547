// SPDX-License-Identifier: GPL-3.0-or-later
#include "generators/midpoints.h"

#include <algorithm>
#include <cmath>

namespace calotte::generators_detail {
namespace {

/// Adds the smaller two first: the sum is the same for any order of the coordinates.
double symmetric_sum(double a, double b, double c) {
  const double largest = std::max({a, b, c});
  if (largest == a)
    return (b + c) + a;
  return largest == b ? (a + c) + b : (a + b) + c;
}

/// The direction of a vector whose square neither overflows nor underflows.
Vec3 unit(const Vec3& a) {
  const double length = std::sqrt(symmetric_sum(a.x * a.x, a.y * a.y, a.z * a.z));
  return {a.x / length, a.y / length, a.z / length};
}

} // namespace

Vec3 unit_of_any_norm(const Vec3& a) {
  const double largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  if (largest > 0x1p-400 && largest < 0x1p400)
    return unit(a);
  const double scale = largest < 1 ? 0x1p600 : 0x1p-600;
  return unit(scale * a);
}

Vec3 midpoint(const Vec3& a, const Vec3& b) {
  return unit(unit_of_any_norm(a) + unit_of_any_norm(b));
}

double middle_in_box(double a, double b, double length) {
  const double middle = a / 2 + b / 2;
  if (!(length > 0) || std::abs(a - b) <= length / 2)
    return middle;
  const double across = middle < length / 2 ? middle + length / 2 : middle - length / 2;
  return across < length ? across : 0;
}

} // namespace calotte::generators_detail
