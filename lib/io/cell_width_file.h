// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/cell_width.h>

#include <iosfwd>
#include <string>
#include <vector>

/// Readers of cell widths, one function per format; see read_cell_width().
namespace calotte::io_detail {

/// A raster as stored in a file, with the names of its variables there.
struct Raster {
  std::vector<double> longitudes, latitudes; ///< degrees
  Eigen::MatrixXd widths;                    ///< longitudes x latitudes, km
  std::string longitude_name, latitude_name, width_name;
  bool longitude_fastest = true; ///< in the file: how messages give a width's index
};

/// Brings a raster into the order of CellWidth: latitudes ascending, no longitude repeated.
/// \throws Error parse, "NAME: ..." with the variable and its index, if it does not cover the
///         sphere, or a width is not positive.
CellWidth checked(Raster raster, const std::string& name);

CellWidth read_cell_width_netcdf(const std::string& path, const std::string& variable);
CellWidth read_cell_width_msh(std::istream& in, const std::string& name);
CellWidth read_cell_width_geojson(std::istream& in, const std::string& name,
                                  const PolygonWidths& widths);

} // namespace calotte::io_detail
