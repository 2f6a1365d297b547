// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/vec3.h"
#include "integrals/integrand.h"
#include "integrals/room.h"
#include "integrals/rows.h"

#include <cstdint>
#include <span>
#include <vector>

namespace calotte::integrals_detail {

/// Moments of the Voronoi cell of a site x_i.
struct CellMoments {
  Vec3 first;    ///< integral of rho x; in the plane of rho (x - x_i), rho (y - y_i) and rho
  double energy; ///< integral of rho |x - x_i|^2
};

/// The output of sums over triangles, by local number of a site.
struct CellSums {
  Array<CellMoments>& moments;
  Array<double>* mass = nullptr; ///< integral of rho, if not null; on the sphere alone
};

/// Sums the kites of triangles over their sites, in the order of the triangles.
///
/// Uniform density: half a kite is a right triangle, see half_edge.h, from a site a to the midpoint
/// of an edge ab, an arc theta/2, and on to the circumcentre, a signed arc delta with sin(delta) =
/// |a-b|/|a+b| cot(C), C the angle across. Its first moment's part that does not cancel is delta/2
/// (a-b)/|a-b|, its area 2 atan(tan(theta/4) tan(delta/2)), its energy twice that less delta
/// sin(theta/2). Obtuse triangles contribute signed arcs. Triangles that the stored corners do not
/// resolve are integrated from their directions without rounding, see slivers.h.
///
/// Other densities are integrated on the flat triangle. Its plane is at the distance D from the
/// centre and touches the sphere of radius D in the circumcentre. By central projection, integral f
/// = D integral of f(p/|p|)/|p|^3 over the half kite, exact except for the rule. The rule is
/// accurate where cells are small compared with the changes of the density, and their circumcaps
/// small compared with a hemisphere.
///
/// In the plane the same formulas hold without curvature.
/// \param suspects triangles, by their position, that are not clearly acute and counter-clockwise
///        are added.
void sum_kites(const SphericalTriangles& sphere, const Integrand& integrand,
               std::span<const Triple> triangles, const Array<Vec3>& x, const CellSums& sums,
               std::vector<std::int32_t>& suspects);
void sum_kites(const FlatTriangles& plane, const Integrand& integrand,
               std::span<const Triple> triangles, const Array<Vec3>& x, const CellSums& sums,
               std::vector<std::int32_t>& suspects);

/// Finds the suspects only.
void find_suspects(const SphericalTriangles& sphere, std::span<const Triple> triangles,
                   const Array<Vec3>& x, std::vector<std::int32_t>& suspects);
void find_suspects(const FlatTriangles& plane, std::span<const Triple> triangles,
                   const Array<Vec3>& x, std::vector<std::int32_t>& suspects);

} // namespace calotte::integrals_detail
