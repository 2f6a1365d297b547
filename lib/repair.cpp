// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include "points.h"
#include "predicates.h"
#include "triangle.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <optional>
#include <utility>

namespace calotte::detail {
namespace {

const Vec3& corner(const Connectivity& mesh, const Points3& points, std::int32_t t, int v) {
  return column(points, mesh.triangles(v, t));
}

/// Index in a triangle of the vertex across from its neighbour.
int index_of(const Connectivity& mesh, std::int32_t triangle, std::int32_t neighbour) {
  return mesh.neighbours(0, triangle) == neighbour   ? 0
         : mesh.neighbours(1, triangle) == neighbour ? 1
                                                     : 2;
}

bool is_overturned(const Connectivity& mesh, const Points3& points, std::int32_t t) {
  return orientation(corner(mesh, points, t, 0), corner(mesh, points, t, 1),
                     corner(mesh, points, t, 2)) <= 0;
}

/// Up to rounding, which 1e-14 exceeds for unit vectors.
bool is_clearly_acute(const Connectivity& mesh, const Points3& points, std::int32_t t, int v) {
  const Vec3& here = corner(mesh, points, t, v);
  return dot(corner(mesh, points, t, next_vertex(v)) - here,
             corner(mesh, points, t, previous_vertex(v)) - here) > 1e-14;
}

bool is_delaunay(const Connectivity& mesh, const Points3& points, const TriangleEdge& edge) {
  const std::int32_t t = edge.triangle, beyond = mesh.neighbours(edge.across, t);
  return in_circle_resolved(View{}, corner(mesh, points, t, 0), corner(mesh, points, t, 1),
                            corner(mesh, points, t, 2),
                            corner(mesh, points, beyond, index_of(mesh, beyond, t))) <= 0;
}

/// Replaces the edge bc of the triangles abc and dcb by ad: they become abd and dca. The four outer
/// edges are to be looked at again.
void flip(Connectivity& mesh, const TriangleEdge& edge, std::vector<TriangleEdge>& pending) {
  const std::int32_t t = edge.triangle, u = mesh.neighbours(edge.across, t);
  const int at = edge.across, ut = index_of(mesh, u, t);
  const std::int32_t a = mesh.triangles(at, t), b = mesh.triangles(next_vertex(at), t),
                     c = mesh.triangles(previous_vertex(at), t), d = mesh.triangles(ut, u);
  const std::int32_t across_b = mesh.neighbours(next_vertex(at), t),
                     across_c = mesh.neighbours(previous_vertex(at), t),
                     beyond_bd = mesh.neighbours(next_vertex(ut), u),
                     beyond_dc = mesh.neighbours(previous_vertex(ut), u);
  // u is d c b: across from c lies bd, across from b lies dc.
  mesh.triangles.col(t) << a, b, d;
  mesh.neighbours.col(t) << beyond_bd, u, across_c;
  mesh.triangles.col(u) << d, c, a;
  mesh.neighbours.col(u) << across_b, t, beyond_dc;
  mesh.neighbours(index_of(mesh, beyond_bd, u), beyond_bd) = t;
  mesh.neighbours(index_of(mesh, across_b, t), across_b) = u;
  for (const TriangleEdge& outer :
       {TriangleEdge{t, 0}, TriangleEdge{t, 2}, TriangleEdge{u, 0}, TriangleEdge{u, 2}})
    pending.push_back(outer);
}

/// Flips until all edges are Delaunay; empty when that takes more than `most` flips.
std::optional<Repair> flip_all(Connectivity& mesh, const Points3& points,
                               std::vector<TriangleEdge> pending, std::int64_t most) {
  Repair result;
  while (!pending.empty()) {
    const TriangleEdge edge = pending.back();
    pending.pop_back();
    if (is_delaunay(mesh, points, edge))
      continue;
    if (++result.flips > most)
      return std::nullopt;
    result.changed.push_back(edge.triangle);
    result.changed.push_back(mesh.neighbours(edge.across, edge.triangle));
    flip(mesh, edge, pending);
  }
  return result;
}

} // namespace

Connectivity triangulate_closed(const Points3& points) {
  Mesh mesh = delaunay(points);
  if (mesh.points.cols() != points.cols() || !mesh.closed())
    throw Error(ErrorCode::too_few_sites,
                "the generators lie within a hemisphere, or two of them have met: spread the start "
                "over the sphere, or take a smoother density");
  return {std::move(mesh.triangles), std::move(mesh.neighbours)};
}

void add_faults(const Connectivity& mesh, const Points3& points, std::int32_t triangle,
                Faults& faults) {
  faults.overturned = faults.overturned || is_overturned(mesh, points, triangle);
  for (int v = 0; v < 3; ++v)
    if (!is_clearly_acute(mesh, points, triangle, v) && !is_delaunay(mesh, points, {triangle, v}))
      faults.edges.push_back({triangle, v});
}

Repair repair(Connectivity& mesh, const Points3& points, const Faults& faults) {
  // A flip costs about as much as three sites of a new triangulation, which is parallel.
  const std::int64_t most = points.cols() / 16;
  if (!faults.overturned)
    if (std::optional<Repair> flipped = flip_all(mesh, points, faults.edges, most))
      return *std::move(flipped);
  mesh = triangulate_closed(points);
  Repair result;
  result.rebuilt = true;
  return result;
}

} // namespace calotte::detail
