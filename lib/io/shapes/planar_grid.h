// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/room.h"

#include <calotte/matrices.h>
#include <calotte/planar_raster.h>

#include <string>

/// Rasters of a plane.
namespace calotte::io_detail {

/// As stored in a file, with the names of its variables there.
struct PlanarGrid {
  DoubleVector x = {}, y = {};
  DoubleMatrix values = {}; ///< x by y
  std::string x_name = "x", y_name = "y", value_name = {};
};

/// The grid with both coordinates ascending.
/// \param law which values are accepted. \param fault what others are.
/// \throws Error parse, "NAME: ..." with the variable and its index: fewer than two coordinates,
///         that are not finite or not sorted; a value that is not accepted.
PlanarGrid ascending(PlanarGrid grid, const std::string& name, bool (*law)(double),
                     const std::string& fault);

/// The same of cell widths.
PlanarCellWidth checked(PlanarGrid grid, const std::string& name);

} // namespace calotte::io_detail
