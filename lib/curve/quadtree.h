// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "curve/hilbert.h"
#include "curve/room.h"

#include <array>
#include <cstdint>

namespace calotte::curve_detail {

/// The face of the cells of a plane, which are squares of [-1,1]^2. Their keys are those of face 0.
inline constexpr int plane_face = 6;

/// A square of a cube's face or of the plane, and the run of ranks in it.
struct QuadtreeCell {
  std::int64_t begin, end; ///< ranks
  std::uint64_t key;       ///< that of the cell's first finest cell
  std::uint32_t i, j;      ///< column and row on the face, in cells of this level
  int face, level;
  CurveTurn turn;

  std::int64_t size() const { return end - begin; }
  bool divisible() const { return level < curve_levels; }
};

/// The quadtree that sites sorted by curve key form. A directory stores where the cells of one
/// level begin, with a few sites per cell for an even distribution; below that level, a descent
/// bisects the keys.
class Quadtree {
public:
  Quadtree() = default;
  /// \param keys ascending.
  /// \param planar true for the keys of a plane.
  explicit Quadtree(Array<std::uint64_t> keys, bool planar = false);

  const Array<std::uint64_t>& keys() const { return keys_; }
  std::int64_t size() const { return keys_.size(); }
  std::array<QuadtreeCell, 6> faces() const; ///< in a plane all but the first are empty
  std::array<QuadtreeCell, 4> children(const QuadtreeCell& cell) const;

private:
  std::int64_t first_rank(std::uint64_t key, int level, std::int64_t begin, std::int64_t end) const;

  Array<std::uint64_t> keys_;
  bool planar_ = false;
  int level_ = 0;               ///< of the directory
  Array<std::int32_t> first_{}; ///< by cell of that level, and the number of all
};

/// A ball that contains the directions of the cell, or in a plane its square.
struct Ball {
  Vec3 centre; ///< a unit vector, or z = 0
  double radius;
};
Ball bounding_ball(const QuadtreeCell& cell);

} // namespace calotte::curve_detail
