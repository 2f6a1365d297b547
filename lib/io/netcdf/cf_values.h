// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/room.h"

#include <cstdint>
#include <string>
#include <vector>

namespace calotte::io_detail {

/// Reads all numbers of a variable and interprets them by its attributes (CF conventions 1.11, 2.5
/// and 8.1; NetCDF Users' Guide, attribute conventions):
/// - scale_factor and add_offset unpack them. _Unsigned makes them unsigned.
/// - They are NaN where they are missing: equal to _FillValue or to one of missing_value, or
///   outside of valid_min, valid_max or valid_range. Without _FillValue, the fill value of the C
///   library is missing, too, except for bytes. Limits and missing values refer to stored numbers.
/// \param shape -1 for any size of a dimension.
/// \throws Error parse, file.
std::vector<double> cf_values(const NetcdfReader& file, const std::string& variable,
                              const std::vector<std::int64_t>& shape);

/// The same of a part, as NetcdfReader::part().
std::vector<double> cf_part(const NetcdfReader& file, const std::string& variable,
                            const std::vector<std::int64_t>& start,
                            const std::vector<std::int64_t>& count);

/// Whether a variable's numbers are packed. \pre it exists.
bool is_packed(const NetcdfReader& file, const std::string& variable);

} // namespace calotte::io_detail
