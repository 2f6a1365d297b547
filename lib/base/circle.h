// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vector_loops.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace calotte::base_detail {

/// A point of the unit circle.
struct CosSin {
  double cos, sin;
};

/// The cosine and sine of part pi/4, 0 to 1. No branch prevents vector code in a loop around it.
CALOTTE_INLINE CosSin cos_sin_of_part(double part) {
  const double x = part * 0x1.921fb54442d18p-1, y = x * x;
  double cosine = 1, sine = 1; // Taylor's series: the next term is below 2^-60
  for (int k = 18; k >= 2; k -= 2) {
    cosine = 1 - y * (1.0 / (k * (k - 1))) * cosine;
    sine = 1 - y * (1.0 / (k * (k + 1))) * sine;
  }
  constexpr double middle = 0x1.6a09e667f3bcdp-1; // at 1: equal, whatever the series rounds to
  return {part == 1 ? middle : cosine, part == 1 ? middle : x * sine};
}

/// The cosine and sine of (octant + part) pi/4; in an odd octant, `part` is measured from its far
/// end. Points of equal part are mirror images to the last bit, so that lattices have the symmetry
/// of the circle, and multiples of pi/2 are exact. The function uses only + - *, each rounded once,
/// so that every machine gives the same bits; sin and cos differ between builds of a C library.
/// \param octant 0 to 7.
/// \param part 0 to 1.
inline CosSin cos_sin_of_octant(int octant, double part) {
  CosSin p = cos_sin_of_part(part);
  if (octant % 2 == 1)
    std::swap(p.cos, p.sin);
  if (octant / 2 % 2 == 1)
    p = {-p.sin, p.cos};
  return octant >= 4 ? CosSin{-p.cos, -p.sin} : p;
}

/// Cosine and sine of an angle from 0 to pi.
inline CosSin cos_sin_of_angle(double angle) {
  constexpr double octant_width = 0.25 * std::numbers::pi;
  const int octant = std::min(3, static_cast<int>(angle / octant_width));
  const double begin = octant * octant_width;
  const double from_end = octant % 2 == 0 ? angle - begin : begin + octant_width - angle;
  return cos_sin_of_octant(octant, std::clamp(from_end / octant_width, 0.0, 1.0));
}

} // namespace calotte::base_detail
