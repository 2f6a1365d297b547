// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/types.h>
#include <calotte/voronoi.h>

#include <cstdint>

namespace calotte::detail {

/// A closed triangulation of a surface, without places.
struct Surface {
  std::int64_t sites;
  const Triangles& triangles;  ///< counter-clockwise
  const Triangles& neighbours; ///< the one across from each vertex
};

/// Sets all ids of the tessellation that is dual to a surface: lists, pairs and triples.
/// \pre as many neighbours as triangles; at most 2^29 sites.
/// \throws Error bad_option, where ids are out of range, the neighbours do not fit the triangles,
///         the triangles at a site do not form one ring, or two cells share two edges.
void connect(const Surface& surface, Voronoi& out);

/// Which vertex of a triangle a site is. \pre it is one.
inline int vertex_at(const Triangles& triangles, std::int64_t t, std::int32_t site) {
  return triangles(0, t) == site ? 0 : triangles(1, t) == site ? 1 : 2;
}

} // namespace calotte::detail
