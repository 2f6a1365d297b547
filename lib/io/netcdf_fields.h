// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats.h"
#include "io/netcdf_reader.h"
#include "io/room.h"

#include <set>
#include <string>

namespace calotte::io_detail {

/// What a format calls the parts of a mesh, and the variables that describe the mesh itself.
struct NetcdfMeshNames {
  std::string cells, vertices;     ///< dimensions; empty for none
  std::set<std::string> variables; ///< that are not fields
};

/// Reads all variables with one number for each cell or vertex into the soup's fields, and lists
/// all others that do not describe the mesh as ignored. \throws Error parse, file.
void read_fields(const NetcdfReader& file, const NetcdfMeshNames& names, Soup& soup);

/// The values of a variable, NaN where it has its _FillValue. \throws Error parse, file.
Eigen::VectorXd values_with_fill(const NetcdfReader& file, const std::string& name);

} // namespace calotte::io_detail
