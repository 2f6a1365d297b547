// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/read.h>

#include "base/message.h"
#include "domain/spherical_area.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/command.h"
#include "io/shapes/coast_file.h"
#include "io/shapes/geojson_areas.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <system_error>
#include <vector>

namespace calotte {
namespace io_detail {

void add_land(const std::vector<WrittenRing>& rings, Coast& coast) {
  constexpr double sphere = 4 * std::numbers::pi;
  double left = 0; // area to the left of the rings, counted once for each ring
  for (const WrittenRing& ring : rings)
    if (ring.corners.size() > 2) {
      left += area_to_the_left(arcs_of(ring));
      coast.rings.push_back(corners_of({ring})[0]);
    }
  coast.area += left - sphere * std::floor(left / sphere);
}

namespace {

/// Throws if a file of GSHHG is missing, and names the package that contains it.
void require_gshhg(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename();
  std::error_code error;
  if (!name.starts_with("binned_GSHHS_") || std::filesystem::exists(path, error))
    return;
  const bool high = name.starts_with("binned_GSHHS_h"), full = name.starts_with("binned_GSHHS_f");
  fail_read(path, message("No such file; it comes with Debian's package gmt-gshhg-{}, in "
                          "/usr/share/gmt-gshhg; install it, or give other polygons of land",
                          high   ? "high"
                          : full ? "full"
                                 : "low"));
}

} // namespace
} // namespace io_detail

Coast read_coast(const std::string& path) {
  using namespace io_detail;
  require_gshhg(path);
  if (is_netcdf_file(path)) {
    const NetcdfReader file(path);
    for (const char* const variable : {"N_bins_in_360_longitude_range", "Id_of_GSHHS_ID"})
      file.require_variable(
          variable, "land is polygons of GeoJSON or a shapefile, or a binned file of GSHHG such as "
                    "binned_GSHHS_l.nc; give one, or give it as a raster");
    return read_gshhg(file);
  }
  std::ifstream in = open_geometries(path);
  Coast coast;
  for (const GeoArea& area : read_areas(in, path))
    add_land(area.rings, coast);
  return coast;
}

Coast read_coasts(const std::vector<std::string>& paths) {
  Coast all;
  for (const std::string& path : paths) {
    const Coast coast = read_coast(path);
    all.area += coast.area;
    all.rings.insert(all.rings.end(), coast.rings.begin(), coast.rings.end());
  }
  return all;
}

} // namespace calotte
