// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/room.h"

#include <calotte/matrices.h>

#include <optional>
#include <string>
#include <vector>

/// Which variables are longitudes and latitudes, by their names and attributes, and in degrees.
/// (CF conventions 1.11, 4.1 and 4.2.)
namespace calotte::io_detail {

/// Whether the name (lon or longitude), the standard_name or the units say so.
bool is_longitude(const NetcdfReader& file, const std::string& variable);
bool is_latitude(const NetcdfReader& file, const std::string& variable);

/// The variables of a raster's nodes, each of one dimension.
struct RasterAxes {
  std::string longitude, latitude;
};

/// The axes of a file, where each axis has one dimension of its own name. None if the file is no
/// raster.
std::optional<RasterAxes> raster_axes(const NetcdfReader& file);

/// The axes on two dimensions of a variable. None if it has no such dimensions.
std::optional<RasterAxes> variable_axes(const NetcdfReader& file, const std::string& variable);

/// The factor from a variable's unit to degrees: 1 without a unit, or for one that starts with
/// "deg"; 180 / pi for one that starts with "rad". \throws Error parse, for others.
double degrees_per_unit(const NetcdfReader& file, const std::string& variable);

/// Reads all numbers of an axis, see cf_values(), and converts them to degrees.
/// \throws Error parse, file.
std::vector<double> read_degrees_of_axis(const NetcdfReader& file, const std::string& axis);

void scale(std::vector<double>& values, double factor);

} // namespace calotte::io_detail
