// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/raw_mesh.h"
#include "io/cells/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <set>
#include <string>

namespace calotte::io_detail {

/// What a format calls the parts of a mesh, and the variables that describe the mesh itself.
struct NetcdfMeshNames {
  std::string cells, vertices;     ///< dimensions; empty for none
  std::set<std::string> variables; ///< that are not fields
  std::string edges = {};          ///< a dimension; empty for none
  /// Variables that refer to cells by number, which other formats number otherwise: neither read
  /// nor written.
  std::set<std::string> lists = {};
  std::set<std::string> derived = {}; ///< that writers make themselves; they may be read as fields
};

/// Reads the variables with numbers for each cell, edge or vertex into the raw mesh's fields, and
/// lists all others that do not describe the mesh as ignored. A dimension of the mesh's own
/// variables, such as the edges of a cell, whose order another file would not keep, makes no field.
/// \throws Error parse, file.
void read_fields(const NetcdfReader& file, const NetcdfMeshNames& names, FieldChoice choice,
                 RawMesh& raw);

/// Reads a field's values, see cf_values(), and attributes.
/// \param places which of the variable's dimensions stand for places, the slowest first; the field
///        has a value for each of the others, in the order of the file, at each place.
/// \pre its name, location, dimensions and `leading` are set. \throws Error parse, file.
void read_values(const NetcdfReader& file, const std::vector<std::size_t>& places,
                 MeshField& field);

} // namespace calotte::io_detail
