// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/far_side.h"

#include "base/message.h"
#include "base/points.h"
#include "base/require.h"
#include "base/triangle.h"
#include "exact/predicates.h"
#include "mesh/adjacency.h"
#include "mesh/canonical_order.h"
#include "mesh/faces.h"

#include <calotte/check.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace calotte::voronoi_detail {
namespace {

[[noreturn]] void refuse_boundary(std::int64_t site, const std::string& problem) {
  refuse(message("the mesh is open, and its boundary is not the hull of its sites: {}; "
                 "use the cells of its file, or triangulate the points anew",
                 problem),
         site);
}

/// The sites of the boundary, in the direction with the mesh to the left.
std::vector<std::int32_t> trace_boundary(const Mesh& mesh) {
  const std::int64_t n = mesh.points.cols();
  std::vector<std::int32_t> following(static_cast<std::size_t>(n), -1);
  std::int32_t first = -1;
  std::size_t edges = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (mesh.neighbours(v, t) < 0) {
        first = mesh.triangles(next_vertex(v), t);
        auto& end = following[static_cast<std::size_t>(first)];
        if (end >= 0)
          refuse_boundary(first, message("it touches itself at site {}", first));
        end = mesh.triangles(previous_vertex(v), t);
        ++edges;
      }
  if (edges == 0)
    refuse_boundary(-1, "it has no triangles");
  std::vector<std::int32_t> ring;
  for (std::int32_t site = first; ring.size() < edges;) {
    ring.push_back(site);
    site = following[static_cast<std::size_t>(site)];
    if (site == first)
      break;
    if (site < 0)
      refuse_boundary(ring.back(), message("it does not close at site {}", ring.back()));
  }
  if (ring.size() != edges)
    refuse_boundary(first, "it has several parts");
  return ring;
}

void require_convex(const Mesh& mesh, const std::vector<std::int32_t>& ring) {
  const std::size_t k = ring.size();
  if (mesh.triangles.cols() + static_cast<std::int64_t>(k) - 2 != 2 * mesh.points.cols() - 4)
    refuse_boundary(-1, "some sites are in no triangle");
  for (std::size_t i = 0; i < k; ++i) {
    const std::int32_t site = ring[(i + 1) % k];
    if (exact_detail::orientation(column(mesh.points, ring[i]), column(mesh.points, site),
                                  column(mesh.points, ring[(i + 2) % k])) < 0)
      refuse_boundary(site, message("it turns to the inside at site {}", site));
  }
}

/// Triangulates a polygon, by indices in its ring: it is halved until triangles are left. From that
/// triangulation, few flips are needed.
void halve(std::int32_t from, std::int32_t to, Triangles& out, Eigen::Index& count) {
  if (to - from < 2)
    return;
  const std::int32_t middle = from + (to - from) / 2;
  out.col(count++) << from, middle, to;
  halve(from, middle, out, count);
  halve(middle, to, out, count);
}

/// The triangles of a polygon and their neighbours.
struct Polygon {
  const Points3& points;
  const std::vector<std::int32_t>& ring;
  Triangles triangles, neighbours; ///< indices in the ring

  const Vec3& point(int v, Eigen::Index t) const {
    return column(points, ring[static_cast<std::size_t>(triangles(v % 3, t))]);
  }

  /// Whether the vertex across from an edge is beyond the triangle's plane.
  bool is_reflex(Eigen::Index t, int v) const {
    const std::int32_t u = neighbours(v, t);
    if (u < 0)
      return false;
    const int w = opposite(u, t);
    return exact_detail::in_circle_resolved({}, point(0, t), point(1, t), point(2, t),
                                            point(w, u)) > 0;
  }

  /// The vertex of a triangle across from another.
  int opposite(Eigen::Index u, Eigen::Index t) const {
    return neighbours(0, u) == t ? 0 : neighbours(1, u) == t ? 1 : 2;
  }

  void replace(std::int32_t neighbour, Eigen::Index before, Eigen::Index after) {
    if (neighbour >= 0)
      neighbours(opposite(neighbour, before), neighbour) = static_cast<std::int32_t>(after);
  }

  /// Exchanges the diagonal across from v: (p, q, r) and s become (p, q, s) and (p, s, r).
  void flip(Eigen::Index t, int v) {
    const std::int32_t u = neighbours(v, t);
    const int w = opposite(u, t);
    const std::int32_t p = triangles(v, t), q = triangles(next_vertex(v), t),
                       r = triangles(previous_vertex(v), t), s = triangles(w, u);
    const std::int32_t across_q = neighbours(next_vertex(v), t),
                       across_r = neighbours(previous_vertex(v), t),
                       beyond_sq = neighbours(next_vertex(w), u),
                       beyond_rs = neighbours(previous_vertex(w), u);
    triangles.col(t) << p, q, s;
    neighbours.col(t) << beyond_sq, u, across_r;
    triangles.col(u) << p, s, r;
    neighbours.col(u) << beyond_rs, across_q, static_cast<std::int32_t>(t);
    replace(beyond_sq, u, t);
    replace(across_q, t, u);
  }
};

/// Flips until no edge is reflex.
void make_convex(Polygon& polygon) {
  std::vector<std::int32_t> waiting(static_cast<std::size_t>(polygon.triangles.cols()));
  for (std::size_t t = 0; t < waiting.size(); ++t)
    waiting[t] = static_cast<std::int32_t>(t);
  while (!waiting.empty()) {
    const std::int32_t t = waiting.back();
    waiting.pop_back();
    for (int v = 0; v < 3; ++v)
      if (polygon.is_reflex(t, v)) {
        const std::int32_t u = polygon.neighbours(v, t);
        polygon.flip(t, v);
        waiting.push_back(u);
        waiting.push_back(t);
        break;
      }
  }
}

/// The triangles of the far side.
Triangles far_triangles(const Points3& points, std::vector<std::int32_t> ring) {
  std::reverse(ring.begin(), ring.end()); // the far side to the left
  const auto k = static_cast<std::int32_t>(ring.size());
  Polygon polygon{points, ring, Triangles(3, k - 2), {}};
  Eigen::Index count = 0;
  halve(0, k - 1, polygon.triangles, count);
  polygon.neighbours = neighbours_of(polygon.triangles, k);
  make_convex(polygon);
  for (Eigen::Index t = 0; t < polygon.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      polygon.triangles(v, t) = ring[static_cast<std::size_t>(polygon.triangles(v, t))];
  return std::move(polygon.triangles);
}

} // namespace

Mesh triangulate_hull(const Mesh& mesh) {
  if (const CheckReport found = check_surface(mesh); !found.passed())
    refuse_boundary(-1, found.failure);
  std::vector<std::int32_t> ring = trace_boundary(mesh);
  require_convex(mesh, ring);
  const Triangles far = far_triangles(mesh.points, std::move(ring));
  Mesh hull{mesh.points, Triangles(3, mesh.triangles.cols() + far.cols()), {}, mesh.site_of_input};
  hull.triangles << mesh.triangles, far;
  hull.neighbours = neighbours_of(hull.triangles, mesh.points.cols());
  make_canonical(hull.triangles, hull.neighbours);
  return hull;
}

void measure_far(const Mesh& hull, std::int64_t triangle, Voronoi& out) {
  std::array<Vec3, 3> corner;
  for (int v = 0; v < 3; ++v)
    corner[static_cast<std::size_t>(v)] = column(out.cells, out.cells_on_vertex(v, triangle));
  const auto& [a, b, c] = corner;
  const double height = 2 * std::abs(dot(cross(b - a, c - a), a));
  std::array<double, 3> half{}; // of the edge across from each vertex
  for (int v = 0; v < 3; ++v) {
    const Vec3 &p = corner[static_cast<std::size_t>(v)],
               &q = corner[static_cast<std::size_t>(next_vertex(v))],
               &r = corner[static_cast<std::size_t>(previous_vertex(v))];
    const double length = norm(r - q), sine = length * dot(q - p, r - p);
    const double rise =
        length / (2 + norm(q + r)) * (std::sqrt(sine * sine + height * height) + height);
    half[static_cast<std::size_t>(v)] =
        2 * (is_far(hull, hull.neighbours(v, triangle)) ? std::atan2(-sine, rise)
                                                        : std::atan2(rise, sine));
  }
  for (int v = 0; v < 3; ++v)
    out.kites(v, triangle) = half[static_cast<std::size_t>(next_vertex(v))] +
                             half[static_cast<std::size_t>(previous_vertex(v))];
  out.vertex_area[triangle] = out.kites.col(triangle).sum();
}

bool is_far(const Mesh& hull, std::int64_t triangle) {
  return exact_detail::orientation(column(hull.points, hull.triangles(0, triangle)),
                                   column(hull.points, hull.triangles(1, triangle)),
                                   column(hull.points, hull.triangles(2, triangle))) < 0;
}

} // namespace calotte::voronoi_detail
