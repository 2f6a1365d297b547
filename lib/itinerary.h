// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curve.h"
#include "order.h"

#include <calotte/types.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace calotte::detail {

/// The order in which a pass over a mesh visits its triangles: as they are numbered, or patch by
/// patch.
///
/// Triangles are numbered by their lowest sites. Where the sites come in no order, neighbours are
/// far apart in memory, and a pass over a large mesh in that order waits for memory most of the
/// time. A patch, its sites and its triangles are small enough to stay in cache.
class Itinerary {
public:
  /// As they are numbered.
  explicit Itinerary(std::int64_t triangles) : size_(triangles) {}

  /// By patches of some thousand sites, which are cells of a grid.
  /// \param square(t) where triangle t is, on the cube or on its first face.
  /// \param faces of the cube that are used.
  template <class Square>
  Itinerary(std::int64_t triangles, std::int64_t sites, int faces, const Square& square)
      : size_(triangles), triangles_(triangles) {
    const auto side = static_cast<std::int64_t>(
        std::ceil(std::sqrt(static_cast<double>(sites) / (faces * patch))));
    const auto cell = [&](double u) {
      return std::clamp(static_cast<std::int64_t>((u + 1) / 2 * static_cast<double>(side)),
                        std::int64_t{0}, side - 1);
    };
    distribute(
        triangles, faces * side * side,
        [&](std::int64_t t) {
          const CubePoint p = square(t);
          return (p.face * side + cell(p.v)) * side + cell(p.u);
        },
        [&](std::int64_t t, std::int32_t place) {
          triangles_[place] = static_cast<std::int32_t>(t);
        });
  }

  std::int64_t size() const { return size_; }
  std::int64_t operator[](std::int64_t i) const {
    return triangles_.size() > 0 ? triangles_[i] : i;
  }

private:
  static constexpr double patch = 4096; ///< sites

  std::int64_t size_;
  Array<std::int32_t> triangles_; ///< empty: as they are numbered
};

/// Whether most triangles of a mesh that is too large for caches have their neighbours far away:
/// those across from their lowest sites, as those around these are beside them in any order.
inline bool are_scattered(const Triangles& neighbours) {
  constexpr std::int64_t fewest = 1 << 20, far = 1 << 15, stride = 61;
  if (neighbours.cols() < fewest)
    return false;
  std::int64_t near = 0, all = 0;
  for (std::int64_t t = 0; t < neighbours.cols(); t += stride, ++all)
    near += std::abs(neighbours(0, t) - t) < far;
  return 2 * near < all;
}

} // namespace calotte::detail
