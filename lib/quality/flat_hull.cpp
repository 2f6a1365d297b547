// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/flat_hull.h"

#include "base/points.h"
#include "base/triangle.h"
#include "exact/predicates.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace calotte::quality_detail {
namespace {

/// The coordinates of a direction are exact to 1.1e-16; longitudes and latitudes in degrees leave a
/// few times that.
constexpr double rounding = 1e-14;

/// Whether side i, across from vertex i, is the longest, and as near to the vertex as rounding.
bool is_flat(const Mesh& mesh, std::int32_t t, int i) {
  const Vec3 &p = column(mesh.points, mesh.triangles(i, t)),
             &a = column(mesh.points, mesh.triangles(next_vertex(i), t)),
             &b = column(mesh.points, mesh.triangles(next_vertex(next_vertex(i)), t));
  const Vec3 side = b - a, from_a = p - a, from_b = p - b, normal = cross(a, side);
  const double length = dot(side, side);
  return dot(from_a, from_a) < length && dot(from_b, from_b) < length &&
         std::abs(dot(from_a, normal)) <= rounding * norm(normal);
}

bool is_flat(const Mesh& mesh, std::int32_t t) {
  for (int i = 0; i < 3; ++i)
    if (mesh.neighbours(i, t) < 0 && is_flat(mesh, t, i))
      return true;
  return false;
}

/// Takes a triangle out of the lists of its neighbours. \returns these, -1 for none.
Eigen::Vector3i separate(std::int32_t t, Mesh& mesh) {
  const Eigen::Vector3i around = mesh.neighbours.col(t);
  for (const std::int32_t other : around)
    if (other >= 0)
      for (int i = 0; i < 3; ++i)
        if (mesh.neighbours(i, other) == t)
          mesh.neighbours(i, other) = -1;
  return around;
}

/// Leaves out triangles that no other refers to.
void pack(const std::vector<bool>& removed, WithoutFlatHull& out) {
  Mesh& mesh = out.mesh;
  std::vector<std::int32_t> number(removed.size(), -1);
  out.triangle.clear();
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    if (!removed[static_cast<std::size_t>(t)]) {
      number[static_cast<std::size_t>(t)] = static_cast<std::int32_t>(out.triangle.size());
      out.triangle.push_back(t);
    }
  const auto kept = [&](const Triangles& all) -> Triangles {
    return all(Eigen::all, out.triangle);
  };
  mesh.triangles = kept(mesh.triangles);
  mesh.neighbours = kept(mesh.neighbours);
  for (std::int32_t& id : mesh.neighbours.reshaped())
    if (id >= 0)
      id = number[static_cast<std::size_t>(id)];
}

} // namespace

WithoutFlatHull without_flat_hull(Mesh mesh) {
  WithoutFlatHull out{std::move(mesh), {}};
  const auto triangles = static_cast<std::int32_t>(out.mesh.triangles.cols());
  std::vector<bool> removed(static_cast<std::size_t>(triangles));
  std::vector<std::int32_t> flat;
  for (std::int32_t t = 0; t < triangles; ++t)
    if (is_flat(out.mesh, t))
      flat.push_back(t);
  if (flat.empty()) {
    out.triangle.resize(removed.size());
    std::iota(out.triangle.begin(), out.triangle.end(), 0);
    return out;
  }
  while (!flat.empty()) {
    const std::int32_t t = flat.back();
    flat.pop_back();
    if (removed[static_cast<std::size_t>(t)])
      continue;
    removed[static_cast<std::size_t>(t)] = true;
    for (const std::int32_t other : separate(t, out.mesh))
      if (other >= 0 && is_flat(out.mesh, other))
        flat.push_back(other);
  }
  pack(removed, out);
  return out;
}

} // namespace calotte::quality_detail
