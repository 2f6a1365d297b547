// SPDX-License-Identifier: GPL-3.0-or-later
#include "cells.h"

#include <algorithm>

namespace calotte::detail {
namespace {

std::int64_t first_not_below(std::span<const std::uint64_t> keys, std::int64_t begin,
                             std::int64_t end, std::uint64_t key) {
  return std::lower_bound(keys.begin() + begin, keys.begin() + end, key) - keys.begin();
}

} // namespace

std::array<Cell, 6> face_cells(std::span<const std::uint64_t> keys) {
  std::array<Cell, 6> faces{};
  std::int64_t begin = 0;
  for (int face = 0; face < 6; ++face) {
    const std::uint64_t key = static_cast<std::uint64_t>(face) << 2 * curve_levels;
    const std::int64_t end = first_not_below(keys, begin, std::ssize(keys),
                                             key + (std::uint64_t{1} << 2 * curve_levels));
    faces[static_cast<std::size_t>(face)] = {begin, end, key, 0, 0, face, 0, face_turn(face)};
    begin = end;
  }
  return faces;
}

std::array<Cell, 4> children(const Cell& cell, std::span<const std::uint64_t> keys) {
  const std::uint64_t width = std::uint64_t{1} << 2 * (curve_levels - cell.level - 1);
  std::array<Cell, 4> out{};
  std::int64_t begin = cell.begin;
  for (int position = 0; position < 4; ++position) {
    const std::uint64_t key = cell.key + static_cast<std::uint64_t>(position) * width;
    const std::int64_t end =
        position == 3 ? cell.end : first_not_below(keys, begin, cell.end, key + width);
    const Quadrant quadrant = curve_quadrant(cell.turn, position);
    out[static_cast<std::size_t>(position)] = {begin,
                                               end,
                                               key,
                                               2 * cell.i + quadrant.i,
                                               2 * cell.j + quadrant.j,
                                               cell.face,
                                               cell.level + 1,
                                               curve_turn(cell.turn, position)};
    begin = end;
  }
  return out;
}

Ball bounding_ball(const Cell& cell) {
  const double width = std::ldexp(2.0, -cell.level);
  const Vec3 middle =
      from_cube({cell.face, (cell.i + 0.5) * width - 1, (cell.j + 0.5) * width - 1});
  // Central projection from the cube onto the unit ball inside it lengthens no distance.
  return {(1 / norm(middle)) * middle, 0.70710679 * width + 0x1p-50};
}

} // namespace calotte::detail
