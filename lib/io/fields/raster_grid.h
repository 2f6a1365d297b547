// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/fields/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/field_grid.h>

#include <optional>
#include <string>

namespace calotte::io_detail {

/// The coordinate variables of a raster.
struct RasterAxes {
  std::string longitude, latitude; ///< variables, each of the dimension of that name
};

/// Those of a file; none where it is no raster.
std::optional<RasterAxes> raster_axes(const NetcdfReader& file);

/// \throws Error as read_field_grid().
FieldGrid read_raster_grid(const NetcdfReader& file, const RasterAxes& axes, FieldChoice choice);

} // namespace calotte::io_detail
