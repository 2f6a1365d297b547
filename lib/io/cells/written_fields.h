// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/model_grid.h"
#include "io/cells/netcdf_fields.h"
#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/write.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

/// Fields on their way to NetCDF files.
namespace calotte::io_detail {

/// The mesh variables' names in files that this library writes.
const NetcdfMeshNames& scrip_names();
const NetcdfMeshNames& esmf_names();
const NetcdfMeshNames& exodus_names();
NetcdfMeshNames ugrid_names(bool of_cells);

/// The dimension of a location, -1 where the file has none, and attributes of all its fields.
struct FieldPlace {
  int dimension = -1;
  NetcdfAttributes attributes = {};
};
struct FieldPlaces {
  FieldPlace cells = {}, edges = {}, vertices = {};
};

/// What stands for missing numbers of a field in a file.
enum class Missing {
  where_integer, ///< NaN, and of integers a fill value
  filled         ///< a fill value, which the attributes name in any case
};

/// Announces a field.
/// \param places ids of its location's dimensions, the slowest first. \param others ids of its
///        own. \param attributes besides the field's own.
void add_field(NetcdfGridFile& file, const MeshField& field, const std::vector<int>& places,
               const std::vector<int>& others, NetcdfAttributes attributes, Missing missing);

/// A name that NetCDF takes: no white space, no /, no control characters, and no sign at the start.
std::string netcdf_name(std::string_view name);

/// Whether a NetCDF format holds a field, if it holds those at edges.
bool can_hold(const NetcdfMeshNames& names, const MeshField& field);

/// Announces the options' fields whose location has a dimension, without masks and those that have
/// the name of one of the mesh's variables.
void add_fields(NetcdfGridFile& file, const WriteOptions& options, const FieldPlaces& places,
                const NetcdfMeshNames& names);

/// Gives all fields names that NetCDF takes and that differ.
/// \returns the old and the new name of those that changed.
std::vector<std::array<std::string, 2>> replace_names(std::vector<MeshField>& fields);

} // namespace calotte::io_detail
