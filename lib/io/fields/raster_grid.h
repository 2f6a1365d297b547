// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/fields/room.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/field_grid.h>

#include <vector>

namespace calotte::io_detail {

/// \throws Error as read_field_grid().
FieldGrid read_raster_grid(const NetcdfReader& file, const RasterAxes& axes, FieldChoice choice,
                           const std::vector<FieldIndex>& choices);

} // namespace calotte::io_detail
