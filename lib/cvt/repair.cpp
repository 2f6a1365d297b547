// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/repair.h"

#include "base/triangle.h"

#include <optional>
#include <utility>

namespace calotte::cvt_detail {
namespace {

Corners corners_of(const Connectivity& mesh, std::int32_t t) {
  return {mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
}

template <class Signs>
bool is_delaunay(const Connectivity& mesh, const Signs& signs, const TriangleEdge& edge) {
  const std::int32_t t = edge.triangle, beyond = mesh.neighbours(edge.across, t);
  return beyond < 0 ||
         !signs.circle_holds(corners_of(mesh, t), edge.across,
                             mesh.triangles(vertex_across(mesh.neighbours, beyond, t), beyond));
}

/// Replaces the edge bc of the triangles abc and dcb by ad, which gives abd and dca. The four outer
/// edges must then be tested again.
void flip(Connectivity& mesh, const TriangleEdge& edge, std::vector<TriangleEdge>& pending) {
  const std::int32_t t = edge.triangle, u = mesh.neighbours(edge.across, t);
  const int at = edge.across, ut = vertex_across(mesh.neighbours, u, t);
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
  if (beyond_bd >= 0)
    mesh.neighbours(vertex_across(mesh.neighbours, beyond_bd, u), beyond_bd) = t;
  if (across_b >= 0)
    mesh.neighbours(vertex_across(mesh.neighbours, across_b, t), across_b) = u;
  for (const TriangleEdge& outer :
       {TriangleEdge{t, 0}, TriangleEdge{t, 2}, TriangleEdge{u, 0}, TriangleEdge{u, 2}})
    pending.push_back(outer);
}

void flip_and_count(Connectivity& mesh, const TriangleEdge& edge,
                    std::vector<TriangleEdge>& pending, Repair& result) {
  ++result.flips;
  result.changed.push_back(edge.triangle);
  result.changed.push_back(mesh.neighbours(edge.across, edge.triangle));
  flip(mesh, edge, pending);
}

/// Flips an edge of an overturned triangle such that both triangles are valid, as where a site has
/// moved across the opposite edge. False if there is none.
template <class Signs>
bool turn_back(Connectivity& mesh, const Signs& signs, std::int32_t t,
               std::vector<TriangleEdge>& pending, Repair& result) {
  const Corners corners = corners_of(mesh, t);
  if (signs.is_counter_clockwise(corners)) // by a flip of another triangle
    return true;
  for (int v = 0; v < 3; ++v) {
    const std::int32_t u = mesh.neighbours(v, t);
    if (u < 0)
      continue;
    const std::int32_t a = mesh.triangles(v, t), b = mesh.triangles(next_vertex(v), t),
                       c = mesh.triangles(previous_vertex(v), t),
                       d = mesh.triangles(vertex_across(mesh.neighbours, u, t), u);
    if (a != d && signs.is_counter_clockwise({a, b, d}) && signs.is_counter_clockwise({d, c, a})) {
      flip_and_count(mesh, {t, v}, pending, result);
      return true;
    }
  }
  return false;
}

/// Flips until all edges are Delaunay; false if that takes more than `most` flips.
template <class Signs>
bool flip_all(Connectivity& mesh, const Signs& signs, std::vector<TriangleEdge> pending,
              std::int64_t most, Repair& result) {
  while (!pending.empty()) {
    const TriangleEdge edge = pending.back();
    pending.pop_back();
    if (is_delaunay(mesh, signs, edge))
      continue;
    if (result.flips >= most)
      return false;
    flip_and_count(mesh, edge, pending, result);
  }
  return true;
}

} // namespace

template <class Signs>
void add_faults(const Connectivity& mesh, const Signs& signs, std::int32_t triangle,
                Faults& faults) {
  const Corners corners = corners_of(mesh, triangle);
  if (!signs.is_counter_clockwise(corners))
    faults.overturned.push_back(triangle);
  for (int v = 0; v < 3; ++v)
    if (!signs.is_clearly_acute(corners, v) && !is_delaunay(mesh, signs, {triangle, v}))
      faults.edges.push_back({triangle, v});
}

template <class Signs>
std::optional<Repair> repair(Connectivity& mesh, const Signs& signs, const Faults& faults) {
  // A flip costs about as much as three sites of a new triangulation, which runs in parallel.
  const std::int64_t most = signs.sites() / 16;
  Repair result;
  std::vector<TriangleEdge> pending = faults.edges;
  for (const std::int32_t t : faults.overturned)
    if (!turn_back(mesh, signs, t, pending, result))
      return std::nullopt;
  if (!flip_all(mesh, signs, std::move(pending), most, result))
    return std::nullopt;
  return result;
}

template void add_faults(const Connectivity&, const SphereSigns&, std::int32_t, Faults&);
template void add_faults(const Connectivity&, const PlaneSigns&, std::int32_t, Faults&);
template std::optional<Repair> repair(Connectivity&, const SphereSigns&, const Faults&);
template std::optional<Repair> repair(Connectivity&, const PlaneSigns&, const Faults&);

} // namespace calotte::cvt_detail
