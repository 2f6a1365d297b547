// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/raster_file.h"
#include "io/shapes/room.h"

#include <calotte/cell_width.h>
#include <calotte/planar_raster.h>

#include <iosfwd>
#include <string>

/// Readers of cell widths, one function per format; see read_cell_width().
namespace calotte::io_detail {

/// Brings a raster into the order of CellWidth: latitudes ascending, no longitude repeated.
/// \throws Error parse, "NAME: ..." with the variable and its index, if it does not cover the
///         region, or a width is not positive.
CellWidth checked(Raster raster, const std::string& name, const Surface& region);

/// The factor that converts values of a variable to km, from its attribute `units`.
/// \throws Error parse, naming the variable.
double kilometres_of(const NetcdfReader& file, const std::string& variable);

CellWidth read_cell_width_netcdf(const std::string& path, const Surface& region);
CellWidth read_density_netcdf(const std::string& path, const Surface& region);
CellWidth read_cell_width_msh(std::istream& in, const std::string& name, const Surface& region);
PlanarCellWidth read_planar_cell_width_msh(const std::string& path);
CellWidth read_cell_width_geojson(std::istream& in, const std::string& name,
                                  const PolygonWidths& widths);

} // namespace calotte::io_detail
