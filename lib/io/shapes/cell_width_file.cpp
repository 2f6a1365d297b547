// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/cell_width_file.h"

#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/command.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <cmath>
#include <utility>

namespace calotte {
namespace io_detail {

CellWidth checked(Raster raster, const std::string& name, const Surface& region) {
  raster = ordered(
      std::move(raster), name,
      {[](double width) { return width > 0 && std::isfinite(width); }, "positive and finite"},
      region);
  return {vector_of(raster.longitudes), vector_of(raster.latitudes), std::move(raster.values)};
}

} // namespace io_detail

CellWidth read_cell_width(const std::string& path, const PolygonWidths& polygons,
                          const Surface& region) {
  const std::string suffix = io_detail::suffix_of(path);
  if (suffix == ".nc")
    return io_detail::read_cell_width_netcdf(path, region);
  if (holds_rules(path))
    return sampled_on(read_width_rules(path, {}, polygons.radius_km), region);
  io_detail::refuse_foreign(path);
  if (suffix != ".msh" && suffix != ".geojson" && suffix != ".json")
    throw Error(ErrorCode::invalid_argument,
                path + ": unknown suffix of a file of cell widths; give .nc, .msh, "
                       ".geojson or .toml");
  std::ifstream in = io_detail::open_input(path);
  return suffix == ".msh" ? io_detail::read_cell_width_msh(in, path, region)
                          : io_detail::read_cell_width_geojson(in, path, polygons);
}

CellWidth read_density_raster(const std::string& path, const Surface& region) {
  CellWidth raster = io_detail::read_density_netcdf(path, region);
  const auto width_of = [](double density) { return 1 / std::sqrt(std::sqrt(density)); };
  raster.widths = raster.widths.unaryExpr(width_of);
  raster.widths /= raster.widths.minCoeff();
  return raster;
}

} // namespace calotte
