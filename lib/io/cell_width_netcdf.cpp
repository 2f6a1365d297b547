// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cell_width_file.h"
#include "io/netcdf_reader.h"

#include <utility>

namespace calotte::io_detail {
namespace {

bool in_metres(const std::string& units) {
  return units == "m" || units == "metre" || units == "metres" || units == "meter" ||
         units == "meters";
}

} // namespace

CellWidth read_cell_width_netcdf(const std::string& path, const std::string& variable) {
  const NetcdfReader file(path);
  Raster raster = read_raster(file, variable);
  if (in_metres(file.text(variable, "units")))
    raster.values /= 1000;
  return checked(std::move(raster), path);
}

} // namespace calotte::io_detail
