// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/flat_hull.h"

#include "base/points.h"
#include "base/triangle.h"
#include "exact/predicates.h"
#include "mesh/submesh.h"

#include <cmath>
#include <utility>

namespace calotte::quality_detail {
namespace {

/// The coordinates of a direction are exact to 1.1e-16; longitudes and latitudes in degrees leave a
/// few times that.
constexpr double rounding = 1e-14;

/// Whether side i, across from vertex i, is the longest, and its distance from the vertex is at
/// most rounding.
bool is_flat(const Mesh& mesh, std::int32_t t, int i) {
  const Vec3 &p = column(mesh.points, mesh.triangles(i, t)),
             &a = column(mesh.points, mesh.triangles(next_vertex(i), t)),
             &b = column(mesh.points, mesh.triangles(next_vertex(next_vertex(i)), t));
  const Vec3 side = b - a, from_a = p - a, from_b = p - b, normal = cross(a, side);
  const double length = dot(side, side);
  return dot(from_a, from_a) < length && dot(from_b, from_b) < length &&
         std::abs(dot(from_a, normal)) <= rounding * norm(normal);
}

bool is_flat(const Mesh& mesh, std::int32_t t, const std::vector<bool>& removed) {
  for (int i = 0; i < 3; ++i) {
    const std::int32_t beyond = mesh.neighbours(i, t);
    if ((beyond < 0 || removed[static_cast<std::size_t>(beyond)]) && is_flat(mesh, t, i))
      return true;
  }
  return false;
}

} // namespace

WithoutFlatHull without_flat_hull(Mesh mesh) {
  const auto triangles = static_cast<std::int32_t>(mesh.triangles.cols());
  std::vector<bool> removed(static_cast<std::size_t>(triangles));
  std::vector<std::int32_t> suspects = base_detail::themselves(triangles);
  while (!suspects.empty()) {
    const std::int32_t t = suspects.back();
    suspects.pop_back();
    if (removed[static_cast<std::size_t>(t)] || !is_flat(mesh, t, removed))
      continue;
    removed[static_cast<std::size_t>(t)] = true;
    for (const std::int32_t other : mesh.neighbours.col(t))
      if (other >= 0)
        suspects.push_back(other);
  }
  WithoutFlatHull out{std::move(mesh), base_detail::themselves(triangles)};
  std::erase_if(out.triangle, [&](std::int32_t t) { return removed[static_cast<std::size_t>(t)]; });
  if (std::ssize(out.triangle) < triangles) { // the sites of removed triangles stay
    mesh_detail::Submesh part =
        mesh_detail::extract(out.mesh.triangles, out.mesh.neighbours, out.triangle);
    out.mesh.triangles = Triangles(out.mesh.triangles(Eigen::all, out.triangle));
    out.mesh.neighbours = std::move(part.faces.neighbours);
  }
  return out;
}

} // namespace calotte::quality_detail
