// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "cvt/room.h"
#include "exact/space.h"
#include "mesh/connectivity.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {

/// The edge across from a vertex of a triangle.
struct TriangleEdge {
  std::int32_t triangle;
  int across;
};

/// The reasons why a mesh is not the Delaunay triangulation of its points. A mesh without
/// overturned triangles whose edges are all Delaunay is that triangulation (Delaunay, 1934).
struct Faults {
  std::vector<TriangleEdge> edges;      ///< that are not Delaunay, by the exact predicate
  std::vector<std::int32_t> overturned; ///< triangles
  bool none() const { return edges.empty() && overturned.empty(); }
};

/// The positions of a mesh's sites, with their space.
template <Space S> struct SitePositions {
  S space;
  std::span<const Vec3> points; ///< as the space has them; of a periodic plane in the box
};

/// Adds the faults of one triangle, and of its edges across from corners that are not clearly
/// acute. In a periodic plane a triangle with a side as long as half of a period is overturned: its
/// nearest copies are ambiguous, and a triangulation has no such sides.
template <Space S>
void add_faults(const Connectivity& mesh, const SitePositions<S>& sites, std::int32_t triangle,
                Faults& faults);

struct Repair {
  std::int64_t flips = 0;
  std::vector<std::int32_t> changed; ///< triangles that flips made others; may repeat
};

/// Makes the mesh Delaunay by flips. It first flips an edge of each overturned triangle so that
/// both triangles become valid, then the edges that are not Delaunay. Empty if a triangle stays
/// overturned, or if the flips would take longer than a new triangulation; the mesh is then
/// unusable. Flips of overturned triangles may overturn others, which the caller must find.
template <Space S>
std::optional<Repair> repair(Connectivity& mesh, const SitePositions<S>& sites,
                             const Faults& faults);

/// Two sites, the lower one first.
using Ends = std::pair<std::int32_t, std::int32_t>;

/// Puts edges into a mesh by flips, and makes all others Delaunay as far as these allow: a
/// constrained Delaunay triangulation (Chew, Algorithmica 4, 1989; the flips are those of Sloan,
/// Comput. Struct. 47, 1993).
/// \param edges ascending, each once; shorter than a half circle.
/// \pre the mesh is Delaunay, and the stars of the edges' ends are closed.
/// \returns the number of edges that the mesh does not have: they cross others of them, or pass
///          through sites.
template <Space S>
std::int64_t constrain(Connectivity& mesh, const SitePositions<S>& sites,
                       const std::vector<Ends>& edges);

} // namespace calotte::cvt_detail
