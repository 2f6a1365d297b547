// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/hilbert.h"

#include "base/vector_loops.h"

#include <algorithm>
#include <limits>

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

/// 0 for NaN.
CALOTTE_INLINE std::int32_t cell_index(double u) {
  constexpr double half = 1 << (curve_levels - 1), last = 2 * half - 1;
  const double at = (u + 1) * half, low = at > 0 ? at : 0;
  return static_cast<std::int32_t>(low < last ? low : last);
}

/// The key of a point, level by level; each step depends on the turn of the step before.
struct KeyDescent {
  unsigned i, j, turn;
  std::uint64_t key;

  KeyDescent(int face, std::int32_t i_of_cell, std::int32_t j_of_cell)
      : i(static_cast<unsigned>(i_of_cell)), j(static_cast<unsigned>(j_of_cell)),
        turn(face_turn(face)), key(static_cast<std::uint64_t>(face)) {}
  explicit KeyDescent(const CubePoint& c) : KeyDescent(c.face, cell_index(c.u), cell_index(c.v)) {}

  void go_to(int level) {
    const unsigned cell = (i >> level & 31U) << step | (j >> level & 31U);
    const unsigned entry = tables.key_and_turn[turn * cells + cell];
    key = key << (2 * step) | entry >> 2;
    turn = entry & 3U;
  }
};

std::array<std::uint64_t, 4> keys_of(std::array<KeyDescent, 4> descents) {
  for (int level = curve_levels - step; level >= 0; level -= step)
    for (KeyDescent& descent : descents) // the steps of one overlap with those of the others
      descent.go_to(level);
  return {descents[0].key, descents[1].key, descents[2].key, descents[3].key};
}

/// The finest cells of some vectors.
struct CellRows {
  static constexpr std::int64_t most = 64;
  std::array<std::int32_t, most> face, i, j;
};

/// \return the number of vectors without a direction.
CALOTTE_VECTOR_WIDTHS
std::int64_t set_cells(const Vec3* points, std::int64_t count, CellRows& rows) {
  std::int64_t invalid = 0;
  CALOTTE_VECTOR_LOOP
  for (std::int64_t k = 0; k < count; ++k) {
    const Vec3& p = points[k];
    const CubePoint c = to_cube(p);
    // Very large coordinates, whose sum overflows, count as invalid, too.
    const double sum = std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
    const bool valid =
        std::abs(c.u) <= 1 && std::abs(c.v) <= 1 && sum <= std::numeric_limits<double>::max();
    invalid += valid ? 0 : 1;
    const auto at = static_cast<std::size_t>(k);
    rows.face[at] = c.face;
    rows.i[at] = cell_index(c.u);
    rows.j[at] = cell_index(c.v);
  }
  return invalid;
}

} // namespace

std::uint64_t curve_key(const CubePoint& c) {
  KeyDescent descent(c);
  for (int level = curve_levels - step; level >= 0; level -= step)
    descent.go_to(level);
  return descent.key;
}

std::array<std::uint64_t, 4> curve_keys(const std::array<CubePoint, 4>& points) {
  return keys_of(
      {KeyDescent(points[0]), KeyDescent(points[1]), KeyDescent(points[2]), KeyDescent(points[3])});
}

bool set_curve_keys(const Vec3* points, std::int64_t count, std::uint64_t* keys) {
  CellRows rows;
  std::int64_t invalid = 0;
  for (std::int64_t first = 0; first < count; first += CellRows::most) {
    const std::int64_t part = std::min(CellRows::most, count - first);
    invalid += set_cells(points + first, part, rows);
    const auto descent = [&](std::int64_t k) {
      const auto at = static_cast<std::size_t>(std::min(k, part - 1));
      return KeyDescent(rows.face[at], rows.i[at], rows.j[at]);
    };
    for (std::int64_t k = 0; k < part; k += 4) {
      const auto four = keys_of({descent(k), descent(k + 1), descent(k + 2), descent(k + 3)});
      std::copy_n(four.begin(), std::min<std::int64_t>(4, part - k), keys + first + k);
    }
  }
  return invalid == 0;
}

} // namespace calotte::curve_detail
