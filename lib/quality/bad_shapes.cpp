// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "base/triangle.h"
#include "mesh/connectivity.h"
#include "quality/parts.h"
#include "quality/room.h"
#include "quality/sides.h"

#include <calotte/quality.h>

#include <cstdint>

namespace calotte {
namespace quality_detail {
namespace {

struct BadPart {
  BadShapes counts;

  void join(const BadPart& other) {
    counts.obtuse += other.counts.obtuse;
    counts.short_edges += other.counts.short_edges;
  }
};

/// The cotangent of the flat angle of a triangle at one of its vertices.
double cotangent(const Mesh& mesh, std::int64_t t, int v) {
  const auto at = [&](int k) -> const Vec3& { return column(mesh.points, mesh.triangles(k, t)); };
  const Vec3 a = at(next_vertex(v)) - at(v), b = at(previous_vertex(v)) - at(v);
  return dot(a, b) / norm(cross(a, b));
}

/// Counts the triangle, and the edges that no triangle before it has. The Voronoi edge across from
/// acute angles is at least (cot A + cot B) / 2 times the Delaunay edge, as asin(x) >= x >= atan(x)
/// in the formulas of Shape: only what that leaves open is measured.
void add_triangle(BadPart& part, const Mesh& mesh, std::int64_t t) {
  constexpr double margin = 1 + 1e-9; // of rounding
  bool acute = true;
  for (int v = 0; v < 3; ++v) {
    const double here = cotangent(mesh, t, v);
    acute = acute && here > 0;
    const std::int64_t other = mesh.neighbours(v, t);
    if (other < t)
      continue;
    const int w = mesh_detail::vertex_across(mesh.neighbours, other, t);
    const double there = cotangent(mesh, other, w);
    if (!(here > 0 && there > 0 && (here + there) / 2 > margin * short_voronoi_edge))
      part.counts.short_edges +=
          is_short(edge_of(make_shape(mesh, t), v, make_shape(mesh, other), w));
  }
  part.counts.obtuse += !acute && is_obtuse(make_shape(mesh, t));
}

} // namespace
} // namespace quality_detail

BadShapes count_bad_shapes(const Mesh& mesh) {
  using namespace quality_detail;
  if (!mesh.surface.is_sphere() || !mesh.closed()) {
    const Quality found = mesh.surface.is_sphere() ? open_quality(mesh) : quality(mesh);
    return {found.obtuse, found.short_edges};
  }
  return join_blocks<BadPart>(mesh.triangles.cols(),
                              [&](BadPart& part, std::int64_t t) { add_triangle(part, mesh, t); })
      .counts;
}

} // namespace calotte
