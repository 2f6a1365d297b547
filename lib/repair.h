// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/types.h>

#include <cstdint>
#include <span>
#include <vector>

namespace calotte::detail {

/// A closed mesh without its points, which move.
struct Connectivity {
  Triangles triangles;  ///< counter-clockwise, in any order
  Triangles neighbours; ///< as Mesh's
};

/// The edge across from a vertex of a triangle.
struct TriangleEdge {
  std::int32_t triangle;
  int across;
};

/// What keeps a mesh from being the Delaunay triangulation of its points. A mesh without overturned
/// triangles whose edges are all Delaunay is (Delaunay, 1934).
struct Faults {
  std::vector<TriangleEdge> edges; ///< that are not Delaunay, by the exact predicate
  bool overturned = false;         ///< some triangle is
  bool none() const { return edges.empty() && !overturned; }
};

/// Adds the faults of one triangle, and of its edges across from corners that are not clearly
/// acute.
void add_faults(const Connectivity& mesh, const Points3& points, std::int32_t triangle,
                Faults& faults);

/// \throws Error too_few_sites, when two points have met or a hemisphere is empty.
Connectivity triangulate_closed(const Points3& points);

struct Repair {
  std::int64_t flips = 0;
  bool rebuilt = false;              ///< all triangles are new
  std::vector<std::int32_t> changed; ///< else those that flips made others; may repeat
};

/// Makes the mesh Delaunay: flips from the faulty edges on until all are, or triangulates the
/// points anew where a triangle is overturned or the flips would take longer.
/// \throws Error as triangulate_closed().
Repair repair(Connectivity& mesh, const Points3& points, const Faults& faults);

} // namespace calotte::detail
