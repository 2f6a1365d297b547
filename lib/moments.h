// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "memory.h"
#include "quadrature.h"
#include "vec3.h"

#include <calotte/density.h>
#include <calotte/types.h>

#include <cstdint>
#include <vector>

namespace calotte::detail {

/// Moments of the Voronoi cells of sites x_i, by site. Each site's are summed over its triangles in
/// the order of the mesh, whatever the partition of the work: they are the same bits for any
/// threads and regions.
struct Moments {
  Array<double> mass;   ///< integral of rho over the cell
  Array<Vec3> first;    ///< integral of rho x
  Array<double> energy; ///< integral of rho |x - x_i|^2
};

/// The triangles around each site: those of site i are at begin[i] to begin[i + 1], ascending.
struct Stars {
  Array<std::int32_t> begin;
  Array<std::int32_t> triangles;
};
Stars make_stars(const Mesh& mesh);

/// Exact moments for rho = 1, without quadrature.
///
/// Half a kite is a right spherical triangle: from a site a to the midpoint of an edge ab, an arc
/// theta/2, and on to the circumcentre, a signed arc delta with sin(delta) = |a-b|/|a+b| cot(C), C
/// the angle across. Its area is 2 atan(tan(theta/4) tan(delta/2)), its first moment's part that
/// does not cancel delta/2 (a-b)/|a-b|. Obtuse triangles contribute signed arcs.
///
/// \param mesh closed, of unit columns.
Moments uniform_moments(const Mesh& mesh, const Stars& stars);

/// Moments for any density, by a rule on each half kite: with A, B, C its corners and p the rule's
/// nodes on the flat triangle, integral f = det(A,B,C)/2 sum w f(p/|p|) / |p|^3, which central
/// projection makes exact but for the rule. The signed determinant makes circumcentres outside
/// their triangle right.
///
/// \param divisions each half kite is first cut into divisions^2 similar triangles. >= 1.
Moments quadrature_moments(const Mesh& mesh, const Stars& stars, const Density& density,
                           const QuadratureRule& rule, int divisions = 1);

} // namespace calotte::detail
