// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <algorithm>
#include <limits>

namespace calotte::density_detail {

/// Of some values; before the first, of none.
struct Bounds {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;

  void add(double value) { add({value, value}); }
  void add(const Bounds& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
  }
};

} // namespace calotte::density_detail
