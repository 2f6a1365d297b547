// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>

#include <Eigen/Core>

CALOTTE_API_BEGIN
namespace calotte {

/// A density of the plane at the nodes of a grid that need not be regular. Between nodes it is
/// bilinear; beyond the grid it is that of the grid's nearest place.
struct PlanarRaster {
  Eigen::VectorXd x;       ///< nx >= 2, ascending, in the domain's unit
  Eigen::VectorXd y;       ///< ny >= 2, ascending
  Eigen::MatrixXd density; ///< nx x ny, finite and >= 0
};

/// A callable. \throws Error bad_option where shapes, coordinates or values are not as said above.
Density density_of(const PlanarRaster& raster);

} // namespace calotte
CALOTTE_API_END
