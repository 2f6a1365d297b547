// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/spherical_outline.h"
#include "integrals/integrand.h"
#include "integrals/moments.h"
#include "integrals/patches.h"
#include "integrals/room.h"

#include <cstdint>
#include <vector>

namespace calotte::integrals_detail {

/// A region of the sphere for the integration over cells.
struct RegionField {
  const SphericalOutline* outline;
  std::int64_t generators; ///< sites from this number on are the hull's, and have no cells
};

/// Moments of the Voronoi cells of a patch's own sites in a region, by local number; those of its
/// halo are not whole. Cells that the boundary does not reach are those of moments.h.
///
/// A clipped cell is computed in the plane that touches the sphere at its site, where bisectors and
/// boundary are straight lines, see TangentLift in fans.h. Its sides are the parts of its Voronoi
/// edges inside the region and the parts of the boundary inside the cell. Uniform density is
/// integrated in closed form, other densities by the integrand's rule over triangles with a corner
/// in the site, signed by their orientation.
///
/// Where the centroid of a clipped cell lies outside the region, `first` is that of a cell whose
/// centroid is the nearest place of the boundary within the cell, see planar_moments.h.
void integrate(const Integrand& integrand, const RegionField& field, const Patch& patch,
               const Array<Vec3>& x, Array<CellMoments>& moments,
               std::vector<std::int32_t>& suspects);

/// The area in steradians of the part of a cell inside a region; 0 for a site whose cell does not
/// meet it. \param neighbours of the cell, unit vectors in any order.
double clipped_area(const SphericalOutline& outline, const Vec3& site,
                    const std::vector<Vec3>& neighbours);

} // namespace calotte::integrals_detail
