// SPDX-License-Identifier: GPL-3.0-or-later
#include "stars.h"

#include "parallel.h"

#include <atomic>

namespace calotte::detail {
namespace {

/// The corner at the same site in the triangle that follows counter-clockwise.
Corner next_around(const Mesh& mesh, Corner corner) {
  const std::int32_t t = triangle_of(corner);
  const int v = vertex_of(corner);
  const std::int32_t beyond = mesh.neighbours(next_vertex(v), t), site = mesh.triangles(v, t);
  const int there = mesh.triangles(0, beyond) == site   ? 0
                    : mesh.triangles(1, beyond) == site ? 1
                                                        : 2;
  return 4 * beyond + there;
}

/// For each site some corner at it: which one may vary, as the stars' order does not depend on it.
Array<Corner> some_corners(const Mesh& mesh) {
  Array<Corner> corner(mesh.points.cols());
  for_each_block(mesh.triangles.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      for (int v = 0; v < 3; ++v)
        std::atomic_ref(corner[mesh.triangles(v, t)])
            .store(static_cast<Corner>(4 * t + v), std::memory_order_relaxed);
  });
  return corner;
}

template <class Body>
void for_each_corner_around(const Mesh& mesh, Corner first, const Body& body) {
  Corner corner = first;
  do {
    body(corner);
    corner = next_around(mesh, corner);
  } while (corner != first);
}

std::int32_t following_site(const Mesh& mesh, Corner corner) {
  return mesh.triangles(next_vertex(vertex_of(corner)), triangle_of(corner));
}

} // namespace

Stars make_stars(const Mesh& mesh) {
  const std::int64_t n = mesh.points.cols();
  Array<Corner> first = some_corners(mesh);
  Stars stars{Array<std::int32_t>(n + 1), Array<Corner>(3 * mesh.triangles.cols())};
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      std::int32_t count = 0;
      Corner lowest = first[i];
      for_each_corner_around(mesh, first[i], [&](Corner corner) {
        ++count;
        if (following_site(mesh, corner) < following_site(mesh, lowest))
          lowest = corner;
      });
      stars.begin[i] = count;
      first[i] = lowest;
    }
  });
  stars.begin[n] = 0;
  exclusive_scan(std::span(stars.begin.begin(), stars.begin.end()));
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      std::int64_t place = stars.begin[i];
      for_each_corner_around(mesh, first[i],
                             [&](Corner corner) { stars.corners[place++] = corner; });
    }
  });
  return stars;
}

} // namespace calotte::detail
