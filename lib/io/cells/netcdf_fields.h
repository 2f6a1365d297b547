// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/raw_mesh.h"
#include "io/cells/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <set>
#include <string>
#include <vector>

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

/// Reads the variables that have some dimensions, each once, as fields of cells that are numbered
/// over these, the last one fastest. Their other dimensions may stand anywhere.
/// \param no_fields variables that are neither read nor listed.
/// \param ignored receives the other variables' names.
/// \throws Error parse, file.
void read_fields_on(const NetcdfReader& file, const std::vector<std::string>& dimensions,
                    const std::set<std::string>& no_fields, FieldChoice choice,
                    std::vector<MeshField>& fields, std::vector<std::string>& ignored);

} // namespace calotte::io_detail
