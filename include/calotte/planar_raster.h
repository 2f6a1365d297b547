// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>

#include <Eigen/Core>

CALOTTE_API_BEGIN
namespace calotte {

/// A density of the plane at the nodes of a grid, which may be irregular. Between nodes it is
/// bilinear. Outside the grid it has the value of the nearest point of the grid.
struct PlanarRaster {
  Eigen::VectorXd x;       ///< nx >= 2, finite and ascending, in the unit of the domain
  Eigen::VectorXd y;       ///< ny >= 2, finite and ascending, in the unit of the domain
  Eigen::MatrixXd density; ///< nx x ny, finite and >= 0; only ratios matter
};

/// The density of a raster, a callable for planar domains.
/// \throws Error bad_option if shapes, coordinates or values violate the conditions above.
Density density_of(const PlanarRaster& raster);

} // namespace calotte
CALOTTE_API_END
