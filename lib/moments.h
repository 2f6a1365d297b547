// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "memory.h"
#include "quadrature.h"
#include "stars.h"
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

/// For each edge of each triangle, named by the vertex e across from it, the signed arc delta from
/// the edge's midpoint to the circumcentre over twice the edge's length: at [4 t + e]. The first
/// moment of a uniform cell is the sum over its edges ab, from both triangles, of that times (a -
/// b). The two together are negative exactly when the edge is not Delaunay. At [4 t + 3] stands the
/// triangle's normal times its corner: positive when it runs counter-clockwise, up to rounding.
struct Pulls {
  Array<double> values;
  double energy = 0; ///< of all cells, for rho = 1

  double operator[](std::int64_t i) const { return values[i]; }
};
Pulls edge_pulls(const Mesh& mesh);

/// First moments for rho = 1 from the pulls, by site.
Array<Vec3> uniform_first_moments(const Mesh& mesh, const Stars& stars, const Pulls& pulls);

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
