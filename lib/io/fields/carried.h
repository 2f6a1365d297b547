// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/fields/room.h"
#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/mesh.h>

#include <string>
#include <vector>

namespace calotte::io_detail {

/// A variable that is copied from file to file.
struct Carried {
  std::string name;
  NetcdfType type;
  std::vector<FieldDimension> dimensions; ///< the slowest first
  NetcdfAttributes attributes;
  std::string bytes;                ///< in big-endian order
  std::vector<std::string> of = {}; ///< fields that name it as a coordinate
};

/// The variables that describe the dimensions of fields besides those of their cells, such as times
/// and levels: variables on these dimensions alone, names of times as text, and the variables that
/// these or the fields name as bounds, as a coordinate or in formula_terms (CF conventions 1.11,
/// 4.3.3, 5.7 and 7.1).
/// \throws Error parse, file.
std::vector<Carried> carried_with(const NetcdfReader& file, const std::vector<MeshField>& fields);

} // namespace calotte::io_detail
