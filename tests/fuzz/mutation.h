// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// Mutations that know the structure of an input, for LLVMFuzzerCustomMutator. Each makes a random
/// change of its own or, every other time, one of libFuzzer's.
namespace calotte::fuzz {

using Random = std::minstd_rand;

inline std::size_t below(Random& random, std::size_t count) { return random() % count; }

/// Writes bytes over others or between them, at a multiple of `step`; returns the new size.
inline std::size_t place(const std::vector<std::uint8_t>& bytes, std::uint8_t* data,
                         std::size_t size, std::size_t most, std::size_t step, Random& random) {
  const std::size_t at = below(random, size / step + 1) * step;
  const bool between = below(random, 2) == 0;
  const std::size_t end = between ? size + bytes.size() : std::max(size, at + bytes.size());
  if (end > most)
    return size;
  if (between)
    std::memmove(data + at + bytes.size(), data + at, size - at);
  std::copy(bytes.begin(), bytes.end(), data + at);
  return end;
}

/// A number as Bytes::number() reads it: near a tie of lattice numbers, denormal, huge, or tiny.
inline void put_number(std::vector<std::uint8_t>& out, Random& random) {
  constexpr std::array<double, 6> lattice = {0, 1, -1, 0.5, 0.25, -0.75};
  double value = lattice[below(random, lattice.size())];
  switch (below(random, 5)) {
  case 0:
    value = std::nextafter(value, below(random, 2) == 0 ? 2 : -2);
    break;
  case 1:
    value = std::ldexp(1 + value, -1074 + static_cast<int>(below(random, 60))); // denormal
    break;
  case 2:
    value = std::ldexp(1 + value, static_cast<int>(below(random, 2000)) - 1000); // huge ratios
    break;
  case 3:
    value += std::ldexp(1, -static_cast<int>(below(random, 60))); // a cluster
    break;
  default:
    break;
  }
  out.push_back(255);
  const auto word = std::bit_cast<std::uint64_t>(value);
  for (int shift = 56; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(word >> static_cast<unsigned>(shift)));
}

/// A point as Bytes::column() reads it: of numbers, or sharing coordinates with an earlier one.
inline std::size_t mutate_points(std::uint8_t* data, std::size_t size, std::size_t most,
                                 unsigned seed) {
  Random random(seed + 1);
  if (below(random, 2) == 0)
    return LLVMFuzzerMutate(data, size, most);
  std::vector<std::uint8_t> point{static_cast<std::uint8_t>(below(random, 256))};
  const bool shares = point.front() >= 160;
  if (shares)
    for (int i = 0; i < 2; ++i) // which point and which coordinate
      point.push_back(static_cast<std::uint8_t>(below(random, 256)));
  for (int i = 0; i < (shares ? 1 : 3); ++i)
    put_number(point, random);
  return place(point, data, size, most, 1, random);
}

/// Of a NetCDF file: a number of its header becomes an odd one, or a name, or a copy of other
/// parts.
inline std::size_t mutate_netcdf(std::uint8_t* data, std::size_t size, std::size_t most,
                                 unsigned seed) {
  Random random(seed + 1);
  constexpr std::size_t word = 4;
  if (size < 8 * word || below(random, 2) == 0)
    return LLVMFuzzerMutate(data, size, most);
  constexpr std::array<std::uint32_t, 18> odd = {
      0,  1,  2,  3,  4,  5,          6,          7,          8,
      10, 11, 12, 13, 16, 0x7fffffff, 0x80000000, 0xffffffff, 0x40000000};
  const auto bytes_of = [](std::uint32_t value) {
    return std::vector<std::uint8_t>{
        static_cast<std::uint8_t>(value >> 24U), static_cast<std::uint8_t>(value >> 16U),
        static_cast<std::uint8_t>(value >> 8U), static_cast<std::uint8_t>(value)};
  };
  const std::size_t at = below(random, size / word - 3) * word;
  switch (below(random, 4)) {
  case 0:
    return place(bytes_of(odd[below(random, odd.size())]), data, size, most, word, random);
  case 1: { // a number a little other than it is
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < word; ++i)
      value = value << 8U | data[at + i];
    const std::vector<std::uint8_t> near =
        bytes_of(value + static_cast<std::uint32_t>(below(random, 9)) - 4);
    std::copy(near.begin(), near.end(), data + at);
    return size;
  }
  case 2: { // names that the readers know
    constexpr std::array<const char*, 8> names = {
        "nCells", "xCell", "Mesh2", "cf_role", "start_index", "cellsOnVertex", "units", "radians"};
    const std::string name = names[below(random, names.size())];
    std::vector<std::uint8_t> bytes = bytes_of(static_cast<std::uint32_t>(name.size()));
    bytes.insert(bytes.end(), name.begin(), name.end());
    bytes.resize((bytes.size() + word - 1) / word * word);
    return place(bytes, data, size, most, word, random);
  }
  default: {
    const std::size_t count = std::min(size - at, (1 + below(random, 16)) * word);
    return place({data + at, data + at + count}, data, size, most, word, random);
  }
  }
}

} // namespace calotte::fuzz
