// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/room.h"

#include <cstdint>
#include <string>
#include <vector>

namespace calotte::io_detail {

/// All numbers of a variable as its attributes say what they mean: unpacked by scale_factor and
/// add_offset, unsigned where _Unsigned says so, and NaN where they are missing: equal to
/// _FillValue or one of missing_value, beyond valid_min, valid_max or valid_range, or, without
/// _FillValue, equal to the value that the C library fills in, which bytes do not have. Limits and
/// missing values are those of the stored numbers. (CF conventions 1.11, 2.5 and 8.1; NetCDF Users'
/// Guide, attribute conventions.)
/// \param shape -1 for any size of a dimension. \throws Error parse, file.
std::vector<double> cf_values(const NetcdfReader& file, const std::string& variable,
                              const std::vector<std::int64_t>& shape);

/// Whether a variable's numbers are packed. \pre it exists.
bool is_packed(const NetcdfReader& file, const std::string& variable);

} // namespace calotte::io_detail
