// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/quadtree.h"

#include "base/parallel.h"

#include <algorithm>

namespace calotte::curve_detail {
namespace {

/// Number of key bits below the cells of a level.
constexpr int bits_below(int level) { return 2 * (curve_levels - level); }

} // namespace

Quadtree::Quadtree(Array<std::uint64_t> keys, bool planar)
    : keys_(std::move(keys)), planar_(planar) {
  constexpr std::int64_t sites_a_cell = 4;
  const std::int64_t faces = planar ? 1 : 6;
  const std::int64_t n = keys_.size();
  while (faces << 2 * (level_ + 1) <= n / sites_a_cell)
    ++level_;
  const std::int64_t cells = faces << 2 * level_;
  first_ = Array<std::int32_t>(cells + 1);
  const auto cell_of = [&](std::int64_t rank) {
    return static_cast<std::int64_t>(keys_[rank] >> bits_below(level_));
  };
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::int64_t cell = begin == 0 ? -1 : cell_of(begin - 1);
    for (std::int64_t rank = begin; rank != end; ++rank)
      while (cell < cell_of(rank))
        first_[++cell] = static_cast<std::int32_t>(rank);
  });
  std::fill(first_.begin() + (n == 0 ? 0 : cell_of(n - 1) + 1), first_.end(),
            static_cast<std::int32_t>(n));
}

/// The first rank in [begin, end) with that key or a higher one.
/// \param key key of a cell of the level.
std::int64_t Quadtree::first_rank(std::uint64_t key, int level, std::int64_t begin,
                                  std::int64_t end) const {
  if (level <= level_)
    return first_[static_cast<std::int64_t>(key >> bits_below(level_))];
  return std::lower_bound(keys_.begin() + begin, keys_.begin() + end, key) - keys_.begin();
}

std::array<QuadtreeCell, 6> Quadtree::faces() const {
  std::array<QuadtreeCell, 6> faces{};
  std::int64_t begin = 0;
  for (int face = 0; face < 6; ++face) {
    const std::uint64_t key = static_cast<std::uint64_t>(face) << bits_below(0);
    const std::int64_t end =
        planar_ ? size() : first_rank(key + (std::uint64_t{1} << bits_below(0)), 0, begin, size());
    faces[static_cast<std::size_t>(face)] = {
        begin, end, key, 0, 0, planar_ ? plane_face : face, 0, face_turn(face)};
    begin = end;
  }
  return faces;
}

std::array<QuadtreeCell, 4> Quadtree::children(const QuadtreeCell& cell) const {
  const int level = cell.level + 1;
  const std::uint64_t width = std::uint64_t{1} << bits_below(level);
  std::array<QuadtreeCell, 4> out{};
  std::int64_t begin = cell.begin;
  for (int position = 0; position < 4; ++position) {
    const std::uint64_t key = cell.key + static_cast<std::uint64_t>(position) * width;
    const std::int64_t end =
        position == 3 ? cell.end : first_rank(key + width, level, begin, cell.end);
    const Quadrant quadrant = curve_quadrant(cell.turn, position);
    out[static_cast<std::size_t>(position)] = {begin,
                                               end,
                                               key,
                                               2 * cell.i + quadrant.i,
                                               2 * cell.j + quadrant.j,
                                               cell.face,
                                               level,
                                               curve_turn(cell.turn, position)};
    begin = end;
  }
  return out;
}

Ball bounding_ball(const QuadtreeCell& cell) {
  const double width = std::ldexp(2.0, -cell.level);
  const double u = (cell.i + 0.5) * width - 1, v = (cell.j + 0.5) * width - 1;
  if (cell.face == plane_face)
    return {{u, v, 0}, 0.70710679 * width + 0x1p-50};
  const Vec3 middle = from_cube({cell.face, u, v});
  // The central projection from the cube onto its inscribed unit ball does not increase distances.
  return {(1 / norm(middle)) * middle, 0.70710679 * width + 0x1p-50};
}

} // namespace calotte::curve_detail
