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

/// Writes fields to NetCDF files.
namespace calotte::io_detail {

/// The names of mesh variables in files that this library writes.
const NetcdfMeshNames& scrip_names();
const NetcdfMeshNames& esmf_names();
const NetcdfMeshNames& exodus_names();
NetcdfMeshNames ugrid_names(bool of_cells);

/// The dimension of a location in a file, -1 if the file has none, and the attributes of all fields
/// there.
struct FileLocation {
  int dimension = -1;
  NetcdfAttributes attributes = {};
};
struct FileLocations {
  FileLocation cells = {}, edges = {}, vertices = {};
};

/// How missing numbers of a field are stored.
enum class Missing {
  where_needed, ///< a fill value, which the attributes name where a number is missing
  filled        ///< the same, and the attributes name it in any case
};

/// Declares a field.
/// \param of_location ids of the dimensions of its location, the slowest first.
/// \param others ids of its other dimensions.
/// \param attributes in addition to those of the field.
void add_field(NetcdfGridFile& file, const MeshField& field, const std::vector<int>& of_location,
               const std::vector<int>& others, NetcdfAttributes attributes, Missing missing);

/// Converts a name to one that NetCDF accepts: no white space, no /, no control characters, and no
/// sign at the start.
std::string netcdf_name(std::string_view name);

/// Why a format cannot store a field.
enum class FieldFault {
  none,
  no_fields, ///< it stores none
  location,  ///< none there
  several,   ///< not several numbers for each cell, edge or vertex
  name       ///< it has something of its own under that name
};

/// The fault of a field in a NetCDF format. Fields at edges require a format with edges.
FieldFault find_fault(const NetcdfMeshNames& names, const MeshField& field);

/// Declares the fields of the options whose location has a dimension. Skips masks, and fields with
/// the name of a variable of the mesh.
void add_fields(NetcdfGridFile& file, const WriteOptions& options, const FileLocations& locations,
                const NetcdfMeshNames& names);

/// Renames fields so that NetCDF accepts all names and all names differ.
/// \returns the old and the new name of each renamed field.
std::vector<std::array<std::string, 2>> replace_names(std::vector<MeshField>& fields);

} // namespace calotte::io_detail
