// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/repair.h"

#include "base/triangle.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace calotte::cvt_detail {
namespace {

using Corners = std::array<std::int32_t, 3>; ///< of a triangle

Corners corners_of(const Connectivity& mesh, std::int32_t t) {
  return {mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
}

/// The positions of a triangle's corners; in a periodic plane, of the copies nearest to the first
/// corner.
template <Space S>
std::array<typename S::Position, 3> positions_of(const SitePositions<S>& sites,
                                                 const Corners& corners) {
  const auto at = [&](std::size_t v) -> const Vec3& {
    return sites.points[static_cast<std::size_t>(corners[v])];
  };
  const typename S::Position first = sites.space.position(at(0));
  return {first, sites.space.near(at(1), first), sites.space.near(at(2), first)};
}

template <Space S>
bool is_counter_clockwise(const SitePositions<S>& sites, const Corners& corners) {
  const auto [a, b, c] = positions_of(sites, corners);
  return sites.space.is_short(b, c) && sites.space.orientation(a, b, c) > 0;
}

/// Whether an edge is Delaunay: the circumcircle of its triangle does not contain the far corner of
/// the triangle across. The library's rule resolves ties.
template <Space S>
bool is_delaunay(const Connectivity& mesh, const SitePositions<S>& sites,
                 const TriangleEdge& edge) {
  const std::int32_t t = edge.triangle, beyond = mesh.neighbours(edge.across, t);
  if (beyond < 0)
    return true;
  const auto corner = positions_of(sites, corners_of(mesh, t));
  const std::int32_t far = mesh.triangles(vertex_across(mesh.neighbours, beyond, t), beyond);
  return sites.space.in_circle_resolved(
             corner[0], corner[1], corner[2],
             sites.space.near(sites.points[static_cast<std::size_t>(far)],
                              corner[static_cast<std::size_t>(next_vertex(edge.across))])) <= 0;
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

/// Flips an edge of an overturned triangle if that makes both triangles valid, as where a site has
/// moved across the opposite edge. False if there is no such edge.
template <Space S>
bool turn_back(Connectivity& mesh, const SitePositions<S>& sites, std::int32_t t,
               std::vector<TriangleEdge>& pending, Repair& result) {
  const Corners corners = corners_of(mesh, t);
  if (is_counter_clockwise(sites, corners)) // by a flip of another triangle
    return true;
  for (int v = 0; v < 3; ++v) {
    const std::int32_t u = mesh.neighbours(v, t);
    if (u < 0)
      continue;
    const std::int32_t a = mesh.triangles(v, t), b = mesh.triangles(next_vertex(v), t),
                       c = mesh.triangles(previous_vertex(v), t),
                       d = mesh.triangles(vertex_across(mesh.neighbours, u, t), u);
    if (a != d && is_counter_clockwise(sites, {a, b, d}) &&
        is_counter_clockwise(sites, {d, c, a})) {
      flip_and_count(mesh, {t, v}, pending, result);
      return true;
    }
  }
  return false;
}

/// Flips until all edges are Delaunay; false if that takes more than `most` flips.
template <Space S>
bool flip_all(Connectivity& mesh, const SitePositions<S>& sites, std::vector<TriangleEdge> pending,
              std::int64_t most, Repair& result) {
  while (!pending.empty()) {
    const TriangleEdge edge = pending.back();
    pending.pop_back();
    if (is_delaunay(mesh, sites, edge))
      continue;
    if (result.flips >= most)
      return false;
    flip_and_count(mesh, edge, pending, result);
  }
  return true;
}

} // namespace

template <Space S>
void add_faults(const Connectivity& mesh, const SitePositions<S>& sites, std::int32_t triangle,
                Faults& faults) {
  const Corners corners = corners_of(mesh, triangle);
  if (!is_counter_clockwise(sites, corners))
    faults.overturned.push_back(triangle);
  // In a triangle with a long side, other copies may be nearer. It counts as overturned in any
  // case.
  const auto at = positions_of(sites, corners);
  for (int v = 0; v < 3; ++v)
    if (!sites.space.is_clearly_acute(at[static_cast<std::size_t>(v)],
                                      at[static_cast<std::size_t>(next_vertex(v))],
                                      at[static_cast<std::size_t>(previous_vertex(v))]) &&
        !is_delaunay(mesh, sites, {triangle, v}))
      faults.edges.push_back({triangle, v});
}

template <Space S>
std::optional<Repair> repair(Connectivity& mesh, const SitePositions<S>& sites,
                             const Faults& faults) {
  // A flip costs about as much as three sites of a new triangulation, which runs in parallel.
  const std::int64_t most = std::max<std::int64_t>(std::ssize(sites.points) / 16, 64);
  Repair result;
  std::vector<TriangleEdge> pending = faults.edges;
  for (const std::int32_t t : faults.overturned)
    if (!turn_back(mesh, sites, t, pending, result))
      return std::nullopt;
  if (!flip_all(mesh, sites, std::move(pending), most, result))
    return std::nullopt;
  return result;
}

template void add_faults(const Connectivity&, const SitePositions<Sphere>&, std::int32_t, Faults&);
template void add_faults(const Connectivity&, const SitePositions<Plane>&, std::int32_t, Faults&);
template std::optional<Repair> repair(Connectivity&, const SitePositions<Sphere>&, const Faults&);
template std::optional<Repair> repair(Connectivity&, const SitePositions<Plane>&, const Faults&);

} // namespace calotte::cvt_detail
