// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "base/vector_loops.h"
#include "curve/room.h"

#include <array>
#include <cmath>
#include <cstdint>

/// A space-filling curve over the sphere: Hilbert's curve on the six faces of a cube, the faces
/// joined end to end (the layout of Google's S2). Cells of the same leading bits are nested squares
/// of a face, so that sites sorted by key are a quadtree with no further storage.
namespace calotte::curve_detail {

inline constexpr int curve_levels = 30; ///< bisections of a face; a cell is then 2^-29 wide
inline constexpr int key_bits = 3 + 2 * curve_levels; ///< the face, then two bits a level

/// A direction by central projection onto the cube [-1,1]^3. The quotients are rounded functions of
/// the exact ratios: multiples of one direction give the same bits.
struct CubePoint {
  int face;
  double u, v;
};

CALOTTE_INLINE CubePoint to_cube(const Vec3& p) {
  // The axes of the faces make the curve continuous from each face to the next. The code has no
  // branches: those would be mispredicted for sites in random order, and prevent vector code.
  const double along_x = std::abs(p.x), along_y = std::abs(p.y), along_z = std::abs(p.z);
  const double yz = along_y >= along_z ? along_y : along_z;
  const bool is_x = along_x >= yz, is_y = along_y >= along_z;
  const double largest = is_x ? p.x : is_y ? p.y : p.z;
  const double first = is_x ? p.y : -p.x, second = is_x || is_y ? p.z : -p.y;
  const bool forward = largest > 0;
  const int face = (is_x ? 0 : is_y ? 1 : 2) + (forward ? 0 : 3);
  return {face, (forward ? first : second) / largest, (forward ? second : first) / largest};
}

/// The point of the cube's surface; inverse of to_cube up to scale.
inline Vec3 from_cube(const CubePoint& c) {
  switch (c.face) {
  case 0:
    return {1, c.u, c.v};
  case 1:
    return {-c.u, 1, c.v};
  case 2:
    return {-c.u, -c.v, 1};
  case 3:
    return {-1, -c.v, -c.u};
  case 4:
    return {c.v, -1, -c.u};
  default:
    return {c.v, c.u, -1};
  }
}

/// The order of the four children of a cell: bit 0 exchanges the axes, bit 1 reverses both.
using CurveTurn = std::uint8_t;
struct Quadrant {
  std::uint8_t i, j;
};

/// The position-th quadrant of a cell with that turn.
constexpr Quadrant curve_quadrant(CurveTurn turn, int position) {
  std::uint8_t i = position >= 2, j = position == 1 || position == 2;
  if (turn & 2) {
    i ^= 1;
    j ^= 1;
  }
  return turn & 1 ? Quadrant{j, i} : Quadrant{i, j};
}

/// The turn of that child.
constexpr CurveTurn curve_turn(CurveTurn turn, int position) {
  return static_cast<CurveTurn>(turn ^ (position == 0 ? 1 : position == 3 ? 3 : 0));
}

/// On odd faces the axes are exchanged, so that the curve passes from face to face without a jump.
constexpr CurveTurn face_turn(int face) { return face & 1; }

/// Key of the finest cell, of key_bits bits.
std::uint64_t curve_key(const CubePoint& c);

/// The keys of four points, in about the time of one.
std::array<std::uint64_t, 4> curve_keys(const std::array<CubePoint, 4>& points);

/// Sets the keys of consecutive vectors, those of to_cube(), in vector code.
/// \param count number of vectors and of keys, >= 0.
/// \return false if a vector is zero, not finite, or so long that the sum of its coordinates
/// overflows: its key is then meaningless.
bool set_curve_keys(const Vec3* points, std::int64_t count, std::uint64_t* keys);

/// Calls body(i, key of square(i)) for begin <= i < end.
template <class Square, class Body>
void for_each_curve_key(std::int64_t begin, std::int64_t end, const Square& square,
                        const Body& body) {
  for (; end - begin >= 4; begin += 4) {
    const std::array<std::uint64_t, 4> keys =
        curve_keys({square(begin), square(begin + 1), square(begin + 2), square(begin + 3)});
    for (std::int64_t k = 0; k < 4; ++k)
      body(begin + k, keys[static_cast<std::size_t>(k)]);
  }
  for (; begin != end; ++begin)
    body(begin, curve_key(square(begin)));
}

} // namespace calotte::curve_detail
