// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace calotte::test {

/// Seeded random numbers for the tests: the same with every standard library, unlike std's
/// distributions.
class Random {
public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [low, high).
  double real(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

  /// Uniform in [low, high], ends included.
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % (static_cast<std::uint64_t>(high - low) + 1));
  }

  /// Uniform on the unit sphere.
  base_detail::Vec3 direction() {
    for (;;) {
      const base_detail::Vec3 p{real(-1, 1), real(-1, 1), real(-1, 1)};
      const double square = dot(p, p);
      if (square > 1e-4 && square < 1)
        return (1 / std::sqrt(square)) * p;
    }
  }

  template <class T> void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i)
      std::swap(items[i - 1], items[static_cast<std::size_t>(engine_() % i)]);
  }

private:
  std::mt19937_64 engine_;
};

} // namespace calotte::test
