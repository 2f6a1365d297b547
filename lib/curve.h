// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "vec3.h"

#include <array>
#include <cmath>
#include <cstdint>

/// A space-filling curve over the sphere: Hilbert's curve on the six faces of a cube, the faces
/// joined end to end (the layout of Google's S2). Cells of the same leading bits are nested squares
/// of a face, so that sites sorted by key are a quadtree with no further storage.
namespace calotte::detail {

inline constexpr int curve_levels = 30; ///< bisections of a face; a cell is then 2^-29 wide

/// A direction by central projection onto the cube [-1,1]^3. The quotients are rounded functions of
/// the exact ratios: multiples of one direction give the same bits.
struct CubePoint {
  int face;
  double u, v;
};

inline CubePoint to_cube(const Vec3& p) {
  const double x = std::abs(p.x), y = std::abs(p.y), z = std::abs(p.z);
  if (x >= y && x >= z) // the faces' axes make the curve continuous from each face to the next
    return p.x > 0 ? CubePoint{0, p.y / p.x, p.z / p.x} : CubePoint{3, p.z / p.x, p.y / p.x};
  if (y >= z)
    return p.y > 0 ? CubePoint{1, -(p.x / p.y), p.z / p.y} : CubePoint{4, p.z / p.y, -(p.x / p.y)};
  return p.z > 0 ? CubePoint{2, -(p.x / p.z), -(p.y / p.z)}
                 : CubePoint{5, -(p.y / p.z), -(p.x / p.z)};
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

/// How a cell's four children are run through: bit 0 exchanges the axes, bit 1 reverses both.
using CurveTurn = std::uint8_t;
struct Quadrant {
  std::uint8_t i, j;
};

/// The position-th quadrant of a cell of that turn.
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

/// Key of the finest cell: 3 bits of face, then two bits a level.
std::uint64_t curve_key(const CubePoint& c);

} // namespace calotte::detail
