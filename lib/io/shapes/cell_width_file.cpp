// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/cell_width_file.h"

#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/command.h"
#include "io/shapes/jigsaw.h"

#include <calotte/read.h>

#include <fstream>
#include <string>

namespace calotte {

Raster read_cell_width(const std::string& path, const PolygonWidths& polygons,
                       const Surface& surface) {
  using namespace io_detail;
  if (has_rules(path))
    return named(path, [&, widths = read_widths(path, polygons, surface)] {
      return sampled(widths, surface);
    });
  const std::string suffix = suffix_of(path);
  if (suffix == ".nc")
    return read_raster(path, {.quantity = RasterQuantity::cell_width, .surface = surface});
  const bool polygonal = has_geometries(path);
  if (!polygonal)
    refuse_foreign(path);
  if (suffix != ".msh" && !polygonal)
    refuse_path(path, "unknown suffix of a file of cell widths; give .nc, .msh, .geojson, "
                      ".shp or .toml");
  if (polygonal && !surface.is_sphere())
    refuse_path(path, "no file of cell widths in the plane; give NetCDF cellWidth(y, x) (.nc), "
                      "JIGSAW's spacings (.msh), or rules (.toml)");
  if (!polygonal)
    return make_width_raster(read_jigsaw(path), path, surface);
  std::ifstream in = open_geometries(path);
  return read_cell_width_geojson(in, path, polygons);
}

} // namespace calotte
