// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curve.h"

#include <array>
#include <cstdint>
#include <span>

/// The quadtree that sites sorted by curve key are: a cell is a square of a cube's face and the run
/// of ranks in it. Nothing is stored; a descent bisects the keys.
namespace calotte::detail {

struct Cell {
  std::int64_t begin, end; ///< ranks
  std::uint64_t key;       ///< that of the cell's first finest cell
  std::uint32_t i, j;      ///< place on the face, in cells of this level
  int face, level;
  CurveTurn turn;

  std::int64_t size() const { return end - begin; }
  bool divisible() const { return level < curve_levels; }
};

std::array<Cell, 6> face_cells(std::span<const std::uint64_t> keys);
std::array<Cell, 4> children(const Cell& cell, std::span<const std::uint64_t> keys);

/// A ball that holds the directions of the cell.
struct Ball {
  Vec3 centre; ///< a unit vector
  double radius;
};
Ball bounding_ball(const Cell& cell);

} // namespace calotte::detail
