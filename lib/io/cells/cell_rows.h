// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/raw_mesh.h"
#include "io/cells/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/mesh_file.h>

#include <optional>
#include <string>
#include <vector>

/// Cells that have their own copies of their corners, as in SCRIP, in the bounds of the CF
/// conventions and in OASIS.
namespace calotte::io_detail {

/// The variables of such cells.
struct CellRows {
  std::string corner_longitude, corner_latitude;
  std::string longitude, latitude; ///< names of the centres; empty without
  bool corners_first = false;      ///< whether the dimension of corners is the first, not the last
};

/// Reads the cells, each with its distinct corners. A corner with the _FillValue or missing_value
/// of its variable is padding; so is NaN, if the variable has one of these attributes. Corners
/// without a unit have that of the centres.
/// \param centres one for each cell, or none.
/// \throws Error parse, file.
Polygons read_cell_rows(const NetcdfReader& file, const CellRows& rows, const Points3& centres);

/// Finds the variables of cells in a file of the CF conventions: longitudes and latitudes of one or
/// two dimensions, with bounds of three corners or more. Of several, chooses those whose dimensions
/// most variables have. Also finds the one grid of an OASIS file (NAME.clo, NAME.cla). None if the
/// file has no such cells.
/// \throws Error parse, for a file of several OASIS grids.
std::optional<CellRows> find_cell_rows(const NetcdfReader& file);

/// Reads the cells, their centres, and the fields on their one or two dimensions.
/// \throws Error parse, file.
RawMesh read_cells(const NetcdfReader& file, const CellRows& rows, FieldChoice choice);

/// Refuses a NetCDF file that is not a mesh. The message says what it is instead, and the remedy.
/// \throws Error parse, always.
[[noreturn]] void refuse_netcdf(const NetcdfReader& file);

} // namespace calotte::io_detail
