// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace calotte::base_detail {

/// A hash of the words so far and one more; its high bits are the good ones (Fibonacci hashing).
inline std::uint64_t hash_with(std::uint64_t hash, std::uint64_t word) {
  return (hash ^ hash >> 32 ^ word) * 0x9e3779b97f4a7c15;
}

/// SplitMix64 (Steele, Lea and Flood, 2014). Its state is a counter, so that a stream can be
/// entered anywhere.
class SplitMix {
public:
  /// \param skipped number of values of the stream to skip.
  explicit SplitMix(std::uint64_t seed, std::uint64_t skipped = 0)
      : state_(seed + skipped * step) {}

  /// Uniform in [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  /// Uniform in [-1, 1), a multiple of 2^-52.
  double signed_unit() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1; }

private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15;

  std::uint64_t next() {
    std::uint64_t z = state_ += step;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

} // namespace calotte::base_detail
