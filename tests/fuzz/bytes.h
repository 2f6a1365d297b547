// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <span>

/// Values from the bytes of a fuzzer's input. After the last byte all are 0.
namespace calotte::fuzz {

class Bytes {
public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data, size) {}

  bool empty() const { return data_.empty(); }

  std::uint8_t byte() {
    if (data_.empty())
      return 0;
    const std::uint8_t value = data_.front();
    data_ = data_.subspan(1);
    return value;
  }

  /// An integer from low to high.
  int integer(int low, int high) { return low + byte() % (high - low + 1); }

  /// Any double, or one of few values: predicates tie and over- or underflow at these.
  double number() {
    constexpr std::array<double, 16> odd = {0,
                                            -0.0,
                                            1,
                                            -1,
                                            0.5,
                                            1e-300,
                                            -1e-300,
                                            5e-324,
                                            1e150,
                                            -1e150,
                                            1e-160,
                                            1.0 / 3,
                                            std::numbers::sqrt2,
                                            1 + 0x1p-52,
                                            1 - 0x1p-53,
                                            std::numeric_limits<double>::infinity()};
    const std::uint8_t kind = byte();
    if (kind < 64)
      return odd[kind % odd.size()];
    if (kind < 128)
      return static_cast<double>(static_cast<std::int8_t>(byte())) / 8; // a lattice
    if (kind < 240)
      return static_cast<double>(static_cast<std::int16_t>(byte() | byte() << 8)) / 32768;
    std::uint64_t word = 0;
    for (int i = 0; i < 8; ++i)
      word = word << 8U | byte();
    return std::bit_cast<double>(word);
  }

  /// A column of `rows` numbers; often near to an earlier one, or with a coordinate of it.
  Eigen::VectorXd column(int rows, const Eigen::MatrixXd& before, Eigen::Index count) {
    const std::uint8_t kind = byte();
    Eigen::VectorXd x(rows);
    if (count == 0 || kind < 160) {
      for (double& value : x)
        value = number();
      return x;
    }
    x = before.col(byte() % count);
    double& value = x[byte() % rows];
    if (kind < 192)
      value = std::nextafter(value, number());
    else if (kind < 224)
      value = number();
    else if (kind < 240)
      x = -x;
    else
      x *= 1 + std::ldexp(number(), -40);
    return x;
  }

  /// At most `most` columns, as many as the bytes give.
  Eigen::MatrixXd columns(int rows, Eigen::Index most) {
    Eigen::MatrixXd points(rows, most);
    Eigen::Index count = 0;
    for (; count < most && !empty(); ++count)
      points.col(count) = column(rows, points, count);
    return points.leftCols(count);
  }

private:
  std::span<const std::uint8_t> data_;
};

/// Ends the program, which the fuzzer reports, unless a law holds.
inline void require(bool law) {
  if (!law)
    __builtin_trap();
}

} // namespace calotte::fuzz
