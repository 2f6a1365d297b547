// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/repair.h"

#include "base/triangle.h"
#include "mesh/faces.h"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
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
/// \param stays whether an edge is not flipped.
template <Space S, class Stays>
bool flip_all(Connectivity& mesh, const SitePositions<S>& sites, std::vector<TriangleEdge> pending,
              std::int64_t most, const Stays& stays, Repair& result) {
  while (!pending.empty()) {
    const TriangleEdge edge = pending.back();
    pending.pop_back();
    if (is_delaunay(mesh, sites, edge) || stays(edge))
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
  const auto stays = [](const TriangleEdge&) { return false; };
  if (!flip_all(mesh, sites, std::move(pending), most, stays, result))
    return std::nullopt;
  return result;
}

namespace {

/// Puts edges into a mesh.
template <Space S> class Constraints {
public:
  Constraints(Connectivity& mesh, const SitePositions<S>& sites, const std::vector<Ends>& edges)
      : mesh_(mesh), sites_(sites), edges_(edges), triangle_of_(sites.points.size(), -1) {
    for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
      note(t);
  }

  /// Returns the number of edges that are missing.
  std::int64_t put_all() {
    std::int64_t missing = 0;
    for (const Ends& edge : edges_)
      missing += put(edge) ? 0 : 1;
    std::vector<TriangleEdge> pending;
    for (const std::int32_t t : result_.changed)
      for (int v = 0; v < 3; ++v)
        pending.push_back({t, v});
    constexpr std::int64_t any = std::numeric_limits<std::int64_t>::max();
    flip_all(
        mesh_, sites_, std::move(pending), any,
        [&](const TriangleEdge& edge) { return is_constraint(ends_of(edge)); }, result_);
    return missing;
  }

private:
  void note(std::int32_t t) {
    for (int v = 0; v < 3; ++v)
      triangle_of_[static_cast<std::size_t>(mesh_.triangles(v, t))] = t;
  }

  Ends ends_of(const TriangleEdge& edge) const {
    return std::minmax({mesh_.triangles(next_vertex(edge.across), edge.triangle),
                        mesh_.triangles(previous_vertex(edge.across), edge.triangle)});
  }
  bool is_constraint(const Ends& ends) const {
    return std::binary_search(edges_.begin(), edges_.end(), ends);
  }
  /// The side of a site: > 0 to the left of the line from one to another.
  int side(const Ends& line, std::int32_t site) const {
    const auto at = positions_of(sites_, {line.first, line.second, site});
    return sites_.space.orientation(at[0], at[1], at[2]);
  }

  /// The edge between two sites, from the triangle to its left; triangle -1 for none.
  TriangleEdge find(std::int32_t from, std::int32_t to) const {
    TriangleEdge found{-1, 0};
    for_each_corner(from, [&](Corner corner) {
      if (following_site(faces(), corner) == to)
        found = {corner.triangle, previous_vertex(corner.vertex)};
    });
    return found;
  }
  Faces faces() const { return {mesh_.triangles, mesh_.neighbours, std::ssize(sites_.points)}; }
  template <class Body> void for_each_corner(std::int32_t site, const Body& body) const {
    const std::int32_t t = triangle_of_[static_cast<std::size_t>(site)];
    walk_around(faces(), {t, vertex_at(mesh_.triangles, t, site)}, body);
  }

  /// The edges that a line crosses between its ends, each with its right end first; none if it
  /// passes through a site.
  std::optional<std::deque<Ends>> crossed(const Ends& line) const {
    TriangleEdge edge{-1, 0};
    for_each_corner(line.first, [&](Corner corner) {
      if (side(line, following_site(faces(), corner)) < 0 &&
          side(line, preceding_site(faces(), corner)) > 0)
        edge = {corner.triangle, corner.vertex};
    });
    std::deque<Ends> found;
    while (edge.triangle >= 0) {
      const std::int32_t right = mesh_.triangles(next_vertex(edge.across), edge.triangle),
                         left = mesh_.triangles(previous_vertex(edge.across), edge.triangle),
                         beyond = mesh_.neighbours(edge.across, edge.triangle);
      found.emplace_back(right, left);
      if (beyond < 0)
        return std::nullopt;
      const int far = vertex_across(mesh_.neighbours, beyond, edge.triangle);
      const std::int32_t site = mesh_.triangles(far, beyond);
      if (site == line.second)
        return found;
      const int where = side(line, site);
      if (where == 0)
        return std::nullopt;
      edge = {beyond, where > 0 ? next_vertex(far) : previous_vertex(far)};
    }
    return std::nullopt;
  }

  /// Puts one edge; false if that is not possible.
  bool put(const Ends& line) {
    if (find(line.first, line.second).triangle >= 0)
      return true;
    std::optional<std::deque<Ends>> edges = crossed(line);
    if (!edges || std::any_of(edges->begin(), edges->end(), [&](const Ends& edge) {
          return is_constraint(std::minmax({edge.first, edge.second}));
        }))
      return false;
    std::size_t idle = 0; // edges in turn whose triangles form no convex quadrilateral
    while (!edges->empty() && idle <= edges->size()) {
      const Ends ends = edges->front();
      edges->pop_front();
      const TriangleEdge edge = find(ends.first, ends.second);
      const std::optional<Ends> flipped = flip_if_convex(edge);
      idle = flipped ? 0 : idle + 1;
      if (!flipped)
        edges->push_back(ends);
      else if (const int a = side_beside(line, flipped->first),
               b = side_beside(line, flipped->second);
               a * b < 0)
        edges->push_back(a < 0 ? *flipped : Ends{flipped->second, flipped->first});
    }
    return edges->empty();
  }

  /// side(), 0 for an end of the line.
  int side_beside(const Ends& line, std::int32_t site) const {
    return site == line.first || site == line.second ? 0 : side(line, site);
  }

  /// Flips an edge; returns the new one. None if the triangles would be overturned.
  std::optional<Ends> flip_if_convex(const TriangleEdge& edge) {
    const std::int32_t t = edge.triangle, u = mesh_.neighbours(edge.across, t);
    const std::int32_t a = mesh_.triangles(edge.across, t),
                       b = mesh_.triangles(next_vertex(edge.across), t),
                       c = mesh_.triangles(previous_vertex(edge.across), t),
                       d = mesh_.triangles(vertex_across(mesh_.neighbours, u, t), u);
    if (!is_counter_clockwise(sites_, {a, b, d}) || !is_counter_clockwise(sites_, {d, c, a}))
      return std::nullopt;
    std::vector<TriangleEdge> unused;
    flip_and_count(mesh_, edge, unused, result_);
    note(t);
    note(u);
    return Ends{a, d};
  }

  Connectivity& mesh_;
  const SitePositions<S>& sites_;
  const std::vector<Ends>& edges_;
  std::vector<std::int32_t> triangle_of_; ///< one of each site
  Repair result_;
};

} // namespace

template <Space S>
std::int64_t constrain(Connectivity& mesh, const SitePositions<S>& sites,
                       const std::vector<Ends>& edges) {
  return Constraints<S>(mesh, sites, edges).put_all();
}

template std::int64_t constrain(Connectivity&, const SitePositions<Sphere>&,
                                const std::vector<Ends>&);
template std::int64_t constrain(Connectivity&, const SitePositions<Plane>&,
                                const std::vector<Ends>&);

template void add_faults(const Connectivity&, const SitePositions<Sphere>&, std::int32_t, Faults&);
template void add_faults(const Connectivity&, const SitePositions<Plane>&, std::int32_t, Faults&);
template std::optional<Repair> repair(Connectivity&, const SitePositions<Sphere>&, const Faults&);
template std::optional<Repair> repair(Connectivity&, const SitePositions<Plane>&, const Faults&);

} // namespace calotte::cvt_detail
