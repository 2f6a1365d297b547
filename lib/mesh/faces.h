// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/triangle.h"
#include "mesh/room.h"

#include <calotte/mesh.h>

#include <cstdint>

/// A mesh without its points, and the walk around a site.
namespace calotte::mesh_detail {

/// A mesh's arrays.
struct Faces {
  const Triangles& triangle_ids;  ///< counter-clockwise
  const Triangles& neighbour_ids; ///< the one across from each vertex, -1 where there is none
  std::int64_t site_count;

  std::int64_t sites() const { return site_count; }
  std::int64_t triangles() const { return triangle_ids.cols(); }
  std::int32_t vertex(std::int64_t t, int i) const { return triangle_ids(i % 3, t); }
  std::int32_t neighbour(std::int64_t t, int i) const { return neighbour_ids(i % 3, t); }
};

inline Faces faces_of(const Mesh& mesh) {
  return {mesh.triangles, mesh.neighbours, mesh.points.cols()};
}

/// The slot of a vertex in a triangle, 3 where it is none of its vertices; without branches, which
/// would be mispredicted.
inline int slot_of(const Faces& s, std::int64_t t, std::int32_t vertex) {
  const int first = s.vertex(t, 0) == vertex, second = s.vertex(t, 1) == vertex,
            third = s.vertex(t, 2) == vertex;
  return first + second + third == 1 ? second + 2 * third : 3;
}

/// The index of a site among the vertices of a triangle.
/// \pre it is one of them.
inline int vertex_at(const Triangles& triangles, std::int64_t t, std::int32_t site) {
  return triangles(0, t) == site ? 0 : triangles(1, t) == site ? 1 : 2;
}

/// A vertex of a triangle. It is aligned for std::atomic_ref.
struct alignas(8) Corner {
  std::int32_t triangle; ///< -1 for no corner
  int vertex;
};

inline constexpr Corner no_corner{-1, 0};

inline bool exists(Corner corner) { return corner.triangle >= 0; }

inline std::int32_t site_at(const Faces& s, Corner corner) {
  return s.triangle_ids(corner.vertex, corner.triangle);
}
/// The sites at the other ends of the triangle's edges at a corner, counter-clockwise.
inline std::int32_t following_site(const Faces& s, Corner corner) {
  return s.triangle_ids(next_vertex(corner.vertex), corner.triangle);
}
inline std::int32_t preceding_site(const Faces& s, Corner corner) {
  return s.triangle_ids(previous_vertex(corner.vertex), corner.triangle);
}

/// The corner at the same site in the next triangle counter-clockwise; none beyond an open edge.
/// \pre neighbours are -1 or triangles.
inline Corner next_around(const Faces& s, Corner corner) {
  const std::int32_t beyond = s.neighbour_ids(next_vertex(corner.vertex), corner.triangle);
  if (beyond < 0)
    return no_corner;
  return {beyond, vertex_at(s.triangle_ids, beyond, site_at(s, corner))};
}

/// The same clockwise.
inline Corner previous_around(const Faces& s, Corner corner) {
  const std::int32_t beyond = s.neighbour_ids(previous_vertex(corner.vertex), corner.triangle);
  if (beyond < 0)
    return no_corner;
  return {beyond, vertex_at(s.triangle_ids, beyond, site_at(s, corner))};
}

/// The same as next_around(); none, too, if the next triangle does not match. The way back is
/// checked as well, so that no two corners have the same next one, and a walk returns to its start.
/// \pre the vertices are sites, three in each triangle.
inline Corner fitting_next(const Faces& s, Corner corner) {
  if (s.neighbour_ids(next_vertex(corner.vertex), corner.triangle) >= s.triangles())
    return no_corner;
  const Corner next = next_around(s, corner);
  const bool fits = exists(next) && site_at(s, next) == site_at(s, corner) &&
                    following_site(s, next) == preceding_site(s, corner) &&
                    s.neighbour_ids(previous_vertex(next.vertex), next.triangle) == corner.triangle;
  return fits ? next : no_corner;
}

/// Calls body(corner) for the corners at a site, from a given one on.
/// \return the corner that has no next one, or none if the walk returns to the first.
/// \pre no two corners have the same next one; otherwise the walk might not return.
template <class Next, class Body>
Corner walk_around(Corner first, const Next& next, const Body& body) {
  Corner corner = first;
  do {
    body(corner);
    const Corner following = next(corner);
    if (!exists(following))
      return corner;
    corner = following;
  } while (corner.triangle != first.triangle);
  return no_corner;
}

/// The same in a mesh.
/// \pre neighbours are -1 or match the triangles.
template <class Body> Corner walk_around(const Faces& s, Corner first, const Body& body) {
  return walk_around(
      first, [&](Corner corner) { return next_around(s, corner); }, body);
}

/// Calls body(corner) for the corners at a site, from a given one on in both directions; twice for
/// the given one where there is a boundary.
/// \return the last corner before the boundary counter-clockwise, or none.
/// \pre neighbours are -1 or match the triangles.
template <class Body> Corner walk_both_ways(const Faces& s, Corner first, const Body& body) {
  const Corner last = walk_around(s, first, body);
  if (exists(last))
    walk_around(
        first, [&](Corner corner) { return previous_around(s, corner); }, body);
  return last;
}

} // namespace calotte::mesh_detail
