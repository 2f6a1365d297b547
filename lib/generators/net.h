// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "generators/icosahedron.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

/// Triangulations with 12 points of five neighbours and all others of six.
///
/// Each is an icosahedron whose faces are triangles of one triangular lattice (Thurston, Shapes of
/// polyhedra and triangulations of the sphere, 1998). Its 30 edges define it: each is a vector of
/// the lattice, and the three vectors of a face sum to 0. If all are the same vector (b, c), the
/// points have the symmetry of the icosahedron, and there are 10 (b^2 + b c + c^2) + 2 (Caspar and
/// Klug, 1962). For other numbers of points the vectors differ by one or two steps of the lattice,
/// hardly more for many points than for few.
namespace calotte::generators_detail {

/// The vector x + y w of the triangular lattice, w = exp(i pi/3): an Eisenstein integer.
struct Step {
  std::int64_t x = 0, y = 0;

  bool operator==(const Step&) const = default;
};

/// The product p w^sixths: p turned by sixths of a turn.
inline Step turned(Step p, int sixths) {
  for (; sixths > 0; --sixths)
    p = {-p.y, p.x + p.y};
  return p;
}

/// The squared length of a vector, b^2 + b c + c^2.
inline std::int64_t square(const Step& p) { return p.x * p.x + p.x * p.y + p.y * p.y; }

/// The area between two vectors, in triangles of the lattice; > 0 if q is to the left of p.
inline std::int64_t triangles_between(const Step& p, const Step& q) {
  return p.x * q.y - p.y * q.x;
}

/// The number of points of a regular net.
inline std::int64_t count_of(const Step& p) { return 10 * square(p) + 2; }

/// The vector along each edge of icosahedron(), turned so that all are equal for a regular one: the
/// vectors z of a face's edges in counter-clockwise order make z_0 + w^2 z_1 + w^4 z_2 = 0. A sum
/// of nets is a net.
using Net = std::array<Step, icosahedron_edges>;

/// The net whose vectors are all equal.
Net regular(const Step& step);

/// The edges of a face from its first corner to the second, and to the third.
std::pair<Step, Step> sides(const Net& net, std::size_t face);

/// The number of triangles of a net's triangulation: 2n - 4.
std::int64_t triangles(const Net& net);

/// A net of n points whose vectors differ little; a regular one if there is one.
/// \pre 12 <= n <= 2^30, but not 13.
Net find_net(std::int64_t n);

} // namespace calotte::generators_detail
