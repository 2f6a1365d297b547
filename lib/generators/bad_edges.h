// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "base/vec3.h"
#include "generators/room.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace calotte::generators_detail {

/// A Delaunay edge whose shape relaxation does not mend: an insertion splits it if it is too long,
/// and else a contraction removes it.
struct BadEdge {
  std::int32_t a, b; ///< a < b
  bool too_long;
};

/// The cotangent of the angle at a place, to two others.
template <class Space>
double cotangent(const Space& space, const Vec3& at, const Vec3& a, const Vec3& b) {
  const Vec3 u = space.offset(at, a), v = space.offset(at, b);
  return dot(u, v) / norm(cross(u, v));
}

/// An edge between two triangles, by what a finish limits.
struct EdgeShape {
  double across, beyond; ///< cotangents of the two angles across from it
  double length;         ///< in units of the demanded spacing; 0 if none is demanded

  bool is_long() const {
    constexpr double near_right = 0.19, flat = 0.32, stretched = 1.31;
    return std::min(across, beyond) < near_right || (across + beyond) / 2 < flat ||
           length > stretched;
  }
  bool is_short() const {
    constexpr double narrow = 0.93, tall = 0.84, squeezed = 0.8;
    return std::max(across, beyond) > narrow || (across + beyond) / 2 > tall ||
           (length > 0 && length < squeezed);
  }
};

/// Calls visit(a, b, t, i) for the edges between two triangles, each once: i is its place in
/// triangle t, which it shares with t's neighbour i.
template <class AnyMesh, class Visit>
void for_each_inner_edge(const AnyMesh& mesh, const Visit& visit) {
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.neighbours(i, t) > t)
        visit(mesh.triangles((i + 1) % 3, t), mesh.triangles((i + 2) % 3, t), t, i);
}

/// \param fineness 1/h by site, h the demanded spacing, up to one factor; 0 where none is demanded.
/// \param space has offset(a, b).
template <class AnyMesh, class Space>
std::vector<BadEdge> bad_edges(const AnyMesh& mesh, const Points3& points,
                               const Eigen::VectorXd& fineness, const Space& space) {
  using base_detail::column;
  const auto length = [&](std::int32_t a, std::int32_t b) {
    const bool demanded = fineness[a] > 0 && fineness[b] > 0;
    return demanded ? norm(space.offset(column(points, a), column(points, b))) *
                          (fineness[a] + fineness[b])
                    : 0;
  };
  double sum = 0; // the mean length gives the factor
  std::int64_t count = 0;
  for_each_inner_edge(mesh, [&](std::int32_t a, std::int32_t b, std::int64_t, int) {
    sum += length(a, b);
    count += length(a, b) > 0 ? 1 : 0;
  });
  const double scale = sum > 0 ? static_cast<double>(count) / sum : 0;
  const auto across = [&](std::int64_t t, int i) {
    const auto at = [&](int k) { return column(points, mesh.triangles((i + k) % 3, t)); };
    return cotangent(space, at(0), at(1), at(2));
  };
  std::vector<BadEdge> bad;
  for_each_inner_edge(mesh, [&](std::int32_t a, std::int32_t b, std::int64_t t, int i) {
    const std::int64_t u = mesh.neighbours(i, t);
    const auto back = mesh.neighbours.col(u);
    const int j = back[0] == t ? 0 : back[1] == t ? 1 : 2;
    const EdgeShape shape{across(t, i), across(u, j), scale * length(a, b)};
    if (shape.is_long() || shape.is_short())
      bad.push_back({std::min(a, b), std::max(a, b), shape.is_long()});
  });
  return bad;
}

} // namespace calotte::generators_detail
