// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/raw_mesh.h"
#include "io/cells/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <set>
#include <string>
#include <vector>

namespace calotte::io_detail {

/// The names of a format for the parts of a mesh, and of the variables that describe the mesh.
struct NetcdfMeshNames {
  std::string cells, vertices;     ///< dimensions; empty for none
  std::set<std::string> variables; ///< variables of the mesh, which are not fields
  std::string edges = {};          ///< a dimension; empty for none
  /// Variables of ids of cells. Other formats number cells differently, so that these are neither
  /// read nor written.
  std::set<std::string> lists = {};
  std::set<std::string> derived = {}; ///< computed by writers; they may be read as fields
};

/// Reads the numeric variables at cells, edges or vertices into the fields of the raw mesh. Lists
/// all other variables that do not describe the mesh as ignored. A variable on another dimension of
/// the mesh, such as the edges of a cell, is not a field, because its order may differ in another
/// file.
/// \throws Error parse, file.
void read_fields(const NetcdfReader& file, const NetcdfMeshNames& names, FieldChoice choice,
                 RawMesh& raw);

/// Reads the variables that have some dimensions, each once, as fields of cells. Cells are numbered
/// over these dimensions, the last one fastest. Other dimensions may be in any position.
/// \param no_fields variables that are neither read nor listed.
/// \param ignored receives the names of the other variables.
/// \throws Error parse, file.
void read_fields_on(const NetcdfReader& file, const std::vector<std::string>& dimensions,
                    const std::set<std::string>& no_fields, FieldChoice choice,
                    std::vector<MeshField>& fields, std::vector<std::string>& ignored);

} // namespace calotte::io_detail
