// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "exact/room.h"

namespace calotte::exact_detail {

/// A vector of numbers with more digits than a double has: DoubleDouble, or GMP's.
template <class Number> struct Vec3Of { Number x, y, z; };

template <class Number> Vec3Of<Number> operator+(const Vec3Of<Number>& a, const Vec3Of<Number>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Number> Vec3Of<Number> operator-(const Vec3Of<Number>& a, const Vec3Of<Number>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Number> Number dot(const Vec3Of<Number>& a, const Vec3Of<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Number> Vec3Of<Number> cross(const Vec3Of<Number>& a, const Vec3Of<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace calotte::exact_detail
