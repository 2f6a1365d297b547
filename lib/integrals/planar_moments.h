// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/outline.h"
#include "exact/space.h"
#include "integrals/integrand.h"
#include "integrals/moments.h"
#include "integrals/patches.h"
#include "integrals/room.h"

#include <cstdint>
#include <vector>

namespace calotte::integrals_detail {

/// A domain for the integration over cells.
struct PlanarField {
  const Outline* outline; ///< or none, of a periodic box
  Plane plane;
  std::int64_t generators; ///< sites from this number on are the hull's, and have no cells
};

/// Moments of the Voronoi cells of a patch's own sites in a planar domain, by local number; those
/// of its halo are not whole. They are seen from the cell's site x_i: `first` holds the integrals
/// of rho (x - x_i), rho (y - y_i) and rho, `energy` that of rho |x - x_i|^2. Each is summed over
/// the site's triangles in the patch's order: the same bits for any partition.
///
/// A cell is a sum of triangles with a corner in its site, signed by their orientation: on each
/// side of its boundary stands one. Polynomials are integrated over these in closed form, which is
/// all that uniform density needs; other densities by the integrand's rule. Of a cell that the
/// domain's boundary clips, the sides are the parts of its Voronoi edges inside the domain and the
/// parts of the boundary inside the cell, whatever pieces these bound. There a density may be asked
/// for outside of the domain, but within the cell.
///
/// Where the centroid of a clipped cell lies outside of a domain that is not convex, `first` is
/// that of a cell whose centroid is the nearest place of the boundary within the cell, so that a
/// generator at its centroid is inside, and rests where it can come no nearer to the true one.
///
/// \param x by local number: places with z = 0; of a periodic box, inside it.
/// \param suspects see integrate() in moments.h.
void integrate(const Integrand& integrand, const PlanarField& field, const Patch& patch,
               const Array<Vec3>& x, Array<CellMoments>& moments,
               std::vector<std::int32_t>& suspects);

/// Finds the suspects only.
void find_suspects(const PlanarField& field, const Patch& patch, const Array<Vec3>& x,
                   std::vector<std::int32_t>& suspects);

} // namespace calotte::integrals_detail
