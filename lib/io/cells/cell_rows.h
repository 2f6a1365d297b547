// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/raw_mesh.h"
#include "io/cells/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/mesh_file.h>

#include <optional>
#include <string>
#include <vector>

/// Cells that have copies of their corners, as SCRIP, the bounds of the CF conventions and OASIS
/// hold them.
namespace calotte::io_detail {

/// The variables of such cells.
struct CellRows {
  std::string corner_longitude, corner_latitude;
  std::string longitude, latitude; ///< of the centres; empty without
  bool corners_first = false;      ///< the corners' dimension is the first; else the last
};

/// The cells, each with its distinct corners. A corner that has the _FillValue or missing_value of
/// its variable, or is NaN where it has one of these attributes, pads a cell. Corners without a
/// unit have that of the centres. \param centres as many as the cells, or none. \throws Error
/// parse, file.
Polygons read_cell_rows(const NetcdfReader& file, const CellRows& rows, const Points3& centres);

/// The cells of a file of the CF conventions: longitudes and latitudes of one or two dimensions,
/// with bounds of three corners or more. Of several, those on which most variables stand. Or the
/// cells of the one grid of an OASIS file (NAME.clo, NAME.cla). None if the file has no such cells.
/// \throws Error parse, for a file of several OASIS grids.
std::optional<CellRows> cell_rows_of(const NetcdfReader& file);

/// The cells with their centres, and the fields on their one or two dimensions. \throws Error
/// parse, file.
RawMesh read_cells(const NetcdfReader& file, const CellRows& rows, FieldChoice choice);

/// Why a NetCDF file is none of a mesh, what it is instead, and the remedy.
/// \throws Error parse.
[[noreturn]] void refuse_netcdf(const NetcdfReader& file);

} // namespace calotte::io_detail
