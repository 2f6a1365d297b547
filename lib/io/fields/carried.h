// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/fields/room.h"
#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/mesh.h>

#include <string>
#include <vector>

namespace calotte::io_detail {

/// A variable that goes from file to file as it is.
struct Carried {
  std::string name;
  NetcdfType type;
  std::vector<FieldDimension> dimensions; ///< the slowest first
  NetcdfAttributes attributes;
  std::string bytes;                ///< as classic files have them
  std::vector<std::string> of = {}; ///< fields that name it as their coordinate
};

/// What a file says of the dimensions that its fields have besides those of places, such as times
/// and levels: variables of these dimensions alone, names of times as text, and what these or the
/// fields name as bounds, as a coordinate or in formula_terms. (CF conventions 1.11, 4.3.3, 5.7 and
/// 7.1.)
/// \throws Error parse, file.
std::vector<Carried> carried_with(const NetcdfReader& file, const std::vector<MeshField>& fields);

} // namespace calotte::io_detail
