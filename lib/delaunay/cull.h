// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/plane_chart.h"
#include "delaunay/regions.h"
#include "delaunay/room.h"
#include "delaunay/sphere_chart.h"
#include "delaunay/triangulate.h"

/// The stages gather and cull, for the charts SphereChart and PlaneChart.
namespace calotte::delaunay_detail {

struct CullCounts {
  std::int64_t by_cull = 0, by_query = 0, inserted = 0;
  bool hull = false; ///< a face was met that no closed mesh has, so that no other region helps
};

/// The members of region k.
template <class Chart>
std::vector<Member> gather(const Sites& sites, const Regions& regions, std::int32_t k);

/// Certifies every triangle with an owned vertex. The paper's cull test (Jacobsen et al., 2013, Eq.
/// 1 and Sect. 3.2) shows that the circumcap lies where the region has all sites. If it fails, a
/// query searches the circumcap for sites; those found are inserted, and the test repeats. Where
/// many triangles fail it, they are first tested in patches (see patches.h). These faces, and no
/// others, are marked as certified. In the plane an infinite face at an owned site is certified,
/// too: no site lies beyond its edge of the hull.
///
/// \return true if all owned sites have closed stars, within reasonable effort. False if the focus
///         lies in one of their circumcaps, as with a few sites, or if all sites are in a
///         hemisphere; in the plane only if the effort is exceeded.
template <class Chart>
bool certify(Triangulation<Chart>& triangulation, const Sites& sites, const Regions& regions,
             std::int32_t k, CullCounts& counts);

/// Marks every finite face as certified. \pre the triangulation has all sites.
template <class Chart> void certify_all(Triangulation<Chart>& triangulation);

} // namespace calotte::delaunay_detail
