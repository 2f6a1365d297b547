// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curve/hilbert.h"
#include "curve/radix_sort.h"
#include "curve/room.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace calotte::curve_detail {

/// The order in which a pass over a mesh visits its triangles: as they are numbered, or patch by
/// patch.
///
/// Triangles are numbered by their lowest sites. If the sites come in random order, neighbours are
/// far apart in memory, and a pass over a large mesh in that order is bound by memory latency. A
/// patch, with its sites and its triangles, fits in cache.
class Traversal {
public:
  /// Visits triangles in the order of their numbers.
  Traversal() = default;

  /// Visits triangles by patches of some thousand sites: cells of a grid on each face.
  /// \param square(t) position of triangle t: a face, below `faces`, and u and v in [-1, 1].
  /// \pre fewer than 2^31 triangles.
  template <class Square>
  Traversal(std::int64_t triangles, std::int64_t sites, int faces, const Square& square)
      : triangles_(triangles) {
    const auto side = static_cast<std::int64_t>(
        std::ceil(std::sqrt(static_cast<double>(sites) / (faces * patch))));
    const auto cells = static_cast<double>(side);
    const auto cell = [&](double u) {
      return static_cast<std::int64_t>(std::clamp((u + 1) / 2 * cells, 0.0, cells - 1));
    };
    distribute(
        triangles, faces * side * side,
        [&](std::int64_t t) {
          const CubePoint p = square(t);
          return (p.face * side + cell(p.v)) * side + cell(p.u);
        },
        [&](std::int64_t t, std::int32_t index) {
          triangles_[index] = static_cast<std::int32_t>(t);
        });
  }

  /// The i-th triangle visited.
  std::int64_t operator[](std::int64_t i) const {
    return triangles_.size() > 0 ? triangles_[i] : i;
  }

private:
  static constexpr double patch = 4096; ///< sites

  Array<std::int32_t> triangles_; ///< empty: in the order of their numbers
};

/// True if the triangles of a large mesh are so far from their neighbours in memory that a pass
/// gains from visiting them by patches. Tests the neighbour across from each lowest site only: the
/// other two neighbours share that site, so they have numbers near that of the triangle in any
/// order.
inline bool are_scattered(const Triangles& neighbours) {
  // Below a million triangles, a traversal costs as much as it saves. Above, a sample decides.
  constexpr std::int64_t fewest = 1 << 20, far = 1 << 15, stride = 61;
  if (neighbours.cols() < fewest)
    return false;
  std::int64_t near = 0, all = 0;
  for (std::int64_t t = 0; t < neighbours.cols(); t += stride, ++all)
    near += std::abs(neighbours(0, t) - t) < far;
  return 2 * near < all;
}

} // namespace calotte::curve_detail
