// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/hilbert.h"

#include <algorithm>

namespace calotte::curve_detail {
namespace {

// A table of five levels: for each turn and 5 bits of i and of j, 10 bits of key and the turn
// below.
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

/// The key of a point, level by level; each step depends on the turn of the step before.
struct KeyDescent {
  unsigned i, j, turn;
  std::uint64_t key;

  explicit KeyDescent(const CubePoint& c)
      : i(cell_index(c.u)), j(cell_index(c.v)), turn(face_turn(c.face)),
        key(static_cast<std::uint64_t>(c.face)) {}

  void go_to(int level) {
    const unsigned cell = (i >> level & 31U) << step | (j >> level & 31U);
    const unsigned entry = tables.key_and_turn[turn * cells + cell];
    key = key << (2 * step) | entry >> 2;
    turn = entry & 3U;
  }
};

} // namespace

std::uint64_t curve_key(const CubePoint& c) {
  KeyDescent descent(c);
  for (int level = curve_levels - step; level >= 0; level -= step)
    descent.go_to(level);
  return descent.key;
}

std::array<std::uint64_t, 4> curve_keys(const std::array<CubePoint, 4>& points) {
  std::array<KeyDescent, 4> descents{KeyDescent(points[0]), KeyDescent(points[1]),
                                     KeyDescent(points[2]), KeyDescent(points[3])};
  for (int level = curve_levels - step; level >= 0; level -= step)
    for (KeyDescent& descent : descents) // the steps of one overlap with those of the others
      descent.go_to(level);
  return {descents[0].key, descents[1].key, descents[2].key, descents[3].key};
}

} // namespace calotte::curve_detail
