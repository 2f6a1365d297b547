// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/monitor.h"
#include "delaunay/room.h"
#include "delaunay/sites.h"
#include "delaunay/triangulate.h"

#include <calotte/mesh.h>

#include <array>
#include <cstdint>
#include <vector>

namespace calotte::delaunay_detail {

using Triple = std::array<std::int32_t, 3>;

/// A triangle whose vertices have different owners, each of whom reports it.
struct Seam {
  Triple sites;
  std::int32_t triangle; ///< its number in the report
  std::int32_t home;     ///< the region that owns its lowest site
  std::int8_t reporters; ///< the number of owners
  std::int8_t own_edges; ///< bit i set where this region owns the lower site of the edge across
                         ///< from vertex i
};

/// The report of one region: its triangles with an owned vertex, each from its lowest site on. The
/// triangles whose lowest site the region owns come first, in the order of their lowest and then
/// their second sites.
struct RegionTriangles {
  Array<Triple> sites;      ///< counter-clockwise
  Array<Triple> neighbours; ///< across from each vertex, as numbers in the report; -1 if not here
  std::int64_t own = 0;     ///< the number of those whose lowest site the region owns
  std::vector<Seam> seams;  ///< ascending by triangle

  /// The number of seams whose lowest site the region owns; over all regions each counts once.
  std::int64_t own_seams() const;
};

/// Reports the certified finite faces of a triangulation.
/// \param owner by rank, to count a seam's owners.
/// \param triangles_of by site: set, for the owned sites, to the number of triangles with that
/// lowest site.
template <class Chart>
RegionTriangles report_triangles(Triangulation<Chart>& triangulation, const Sites& sites,
                                 const Array<std::int32_t>& owner,
                                 Array<std::int32_t>& triangles_of);

/// Unites the reports of the regions to triangles and neighbours in canonical order. Triangles with
/// one owner are written directly at their index. Seam triangles meet in a concurrent hash table,
/// one part per region, which counts their reports.
/// \param triangles_of by site, as report_triangles left it; consumed, as the reports are.
/// \param mesh receives triangles and neighbours.
/// \param monitor if not null, receives two steps per region.
/// \throws Error internal if a seam triangle was not reported by exactly the owners of its
///         vertices.
void unite(std::vector<RegionTriangles>&& reports, Array<std::int32_t>&& triangles_of, Mesh& mesh,
           Monitor* monitor = nullptr);

} // namespace calotte::delaunay_detail
