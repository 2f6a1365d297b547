// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <algorithm>
#include <limits>

namespace calotte::density_detail {

/// The bounds of the values added so far. Without values, `least` exceeds `greatest`.
struct Bounds {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;

  void add(double value) { add({value, value}); }
  void add(const Bounds& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
  }
};

} // namespace calotte::density_detail
