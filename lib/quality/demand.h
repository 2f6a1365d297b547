// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/closed_mesh.h"
#include "quality/room.h"

#include <calotte/density.h>
#include <calotte/mesh.h>
#include <calotte/quality.h>

#include <cstdint>

/// The demand of a density on n cells: the spacing at each site, and the minimum energy.
namespace calotte::quality_detail {

/// The integral of rho^(1/2) over the surface. On the sphere it is computed by the 6-point rule on
/// each triangle of the mesh, or on parts of it where the mesh is coarse. In the plane it is
/// computed over the cells: with many cells, few points per cell give an error of 1e-6, as most
/// errors cancel in the sum.
/// \param density as surface_density() gives it.
/// \throws Error invalid_argument as DensityEvaluator.
double root_integral(const ClosedMesh& closed, const Density& density);

/// Sets the energy, its limit and the excess over it.
/// \param root_integral of rho^(1/2) over the domain.
void set_energy(Quality& quality, double energy, double root_integral);

/// 1/h by site, h = sqrt(2 r / (sqrt(3) n)) rho^(-1/4): regular hexagons with these distances
/// between their centres fill the domain.
/// \param points 3 x n, in the form for the density.
/// \param root_integral r, of rho^(1/2) over the domain.
/// \throws Error invalid_argument as DensityEvaluator.
DoubleVector inverse_spacings(const Points3Ref& points, const Density& density,
                              double root_integral);

} // namespace calotte::quality_detail
