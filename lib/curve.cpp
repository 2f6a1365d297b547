// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve.h"

#include <algorithm>

namespace calotte::detail {
namespace {

// Five levels a look-up: for each turn and 5 bits of i and of j, 10 bits of key and the turn below.
constexpr int step = 5;
constexpr unsigned cells = 1U << (2 * step);

struct Tables {
  std::array<std::uint16_t, std::size_t{4} * cells> key_and_turn{};
};

constexpr Tables make_tables() {
  Tables tables;
  for (unsigned turn = 0; turn < 4; ++turn)
    for (unsigned key = 0; key < cells; ++key) {
      unsigned i = 0, j = 0;
      auto below = static_cast<CurveTurn>(turn);
      for (int level = step - 1; level >= 0; --level) {
        const int position = static_cast<int>(key >> (2 * level) & 3U);
        const Quadrant quadrant = curve_quadrant(below, position);
        i = 2 * i + quadrant.i;
        j = 2 * j + quadrant.j;
        below = curve_turn(below, position);
      }
      tables.key_and_turn[turn * cells + (i << step) + j] =
          static_cast<std::uint16_t>(key << 2 | below);
    }
  return tables;
}

constexpr Tables tables = make_tables();

unsigned cell_index(double u) {
  constexpr double half = 1 << (curve_levels - 1);
  return static_cast<unsigned>(std::clamp((u + 1) * half, 0.0, 2 * half - 1));
}

} // namespace

std::uint64_t curve_key(const CubePoint& c) {
  const unsigned i = cell_index(c.u), j = cell_index(c.v);
  auto key = static_cast<std::uint64_t>(c.face);
  unsigned turn = face_turn(c.face);
  for (int level = curve_levels - step; level >= 0; level -= step) {
    const unsigned cell = (i >> level & 31U) << step | (j >> level & 31U);
    const unsigned entry = tables.key_and_turn[turn * cells + cell];
    key = key << (2 * step) | entry >> 2;
    turn = entry & 3U;
  }
  return key;
}

} // namespace calotte::detail
