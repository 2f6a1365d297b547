// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/raw_mesh.h"
#include "io/cells/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
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

/// Whether a name or an attribute says that a variable at edges is a component along their normals
/// or tangents.
bool is_along_edges(const std::string& name, const std::string& long_name,
                    const std::string& standard_name);

/// Reads the numeric variables at cells, edges or vertices into the fields of the raw mesh. Lists
/// all other variables that do not describe the mesh as ignored. A variable on another dimension of
/// the mesh, such as the edges of a cell, is not a field, because its order may differ in another
/// file.
/// \throws Error parse, file.
void read_fields(const NetcdfReader& file, const NetcdfMeshNames& names, FieldChoice choice,
                 RawMesh& raw);

/// Which variables read_fields_on() takes, and what of them.
struct FieldsOn {
  /// Those of the cells, which are numbered over them, the last one fastest.
  std::vector<std::string> dimensions;
  std::set<std::string> no_fields = {};              ///< variables that are neither read nor listed
  std::optional<std::vector<std::string>> only = {}; ///< names of the fields that are read
  FieldChoice choice = FieldChoice::all;
  /// Indices for those fields that have such a dimension. Of dimensions before those of the cells
  /// only that index is read.
  std::vector<FieldIndex> choices = {};
  /// The first row, by the first of the dimensions, and their number: other cells are left out.
  std::optional<std::pair<std::int64_t, std::int64_t>> rows = {};
};

/// Reads the variables that have all dimensions of cells, each once, as fields. Other dimensions
/// may be in any position.
/// \param ignored receives the names of the other variables.
/// \param not_scalars receives, if it is given, the fields with several numbers for each cell that
///        FieldChoice::scalars leaves out, without values; they are not among the ignored.
/// \throws Error parse, file; invalid_argument as find_indices(), and for a choice that belongs to
///         no field.
void read_fields_on(const NetcdfReader& file, const FieldsOn& on, std::vector<MeshField>& fields,
                    std::vector<std::string>& ignored,
                    std::vector<MeshField>* not_scalars = nullptr);

/// Reads a variable as a field of cells at chosen indices.
/// \param of_cells the index of the dimension of the cells among those of the variable.
/// \throws Error parse, file; invalid_argument as field_at(), and unless one number is left for
///         each cell.
MeshField read_field_at(const NetcdfReader& file, const std::string& name, std::size_t of_cells,
                        const std::vector<FieldIndex>& choices);

} // namespace calotte::io_detail
