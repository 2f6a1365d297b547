// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/raster_field.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/netcdf/netcdf_writer.h"
#include "io/shapes/jigsaw.h"

#include <calotte/write.h>

#include <algorithm>
#include <numbers>
#include <string>

namespace calotte {
namespace {

using namespace io_detail;

void write_netcdf(const std::string& path, const Raster& widths) {
  NetcdfWriter file(path);
  const int lat = file.dimension("lat", widths.y.size()),
            lon = file.dimension("lon", widths.x.size());
  file.attribute({"Conventions", std::string("CF-1.8")});
  const auto axis = [&](const std::string& name, const std::string& of, int dimension) {
    return file.variable(
        name, NetcdfType::float64, {dimension},
        {{"units", "degrees_" + of},
         {"standard_name", std::string(name == "lat" ? "latitude" : "longitude")}});
  };
  const int latitudes = axis("lat", "north", lat), longitudes = axis("lon", "east", lon);
  const int values =
      file.variable("cellWidth", NetcdfType::float64, {lat, lon},
                    {{"units", std::string("km")},
                     {"long_name", std::string("distance of the centres of neighbouring cells")}});
  file.begin();
  const auto put = [&](int variable, const double* from, std::int64_t row) {
    file.put(variable, [=](std::int64_t begin, std::int64_t end, double* out) {
      std::copy(from + begin * row, from + end * row, out);
    });
  };
  put(latitudes, widths.y.data(), 1);
  put(longitudes, widths.x.data(), 1);
  put(values, widths.values.data(), widths.values.rows());
  file.finish();
  file.commit();
}

void write_jigsaw(const std::string& path, const Raster& widths) {
  constexpr double radians = std::numbers::pi / 180;
  JigsawFile grid{.kind = "ellipsoid-grid", .dimensions = 2};
  for (const double longitude : widths.x)
    grid.x_grid.push_back(longitude * radians);
  for (const double latitude : widths.y)
    grid.y_grid.push_back(latitude * radians);
  const DoubleMatrix by_latitude = widths.values.transpose();
  grid.values.assign(by_latitude.data(), by_latitude.data() + by_latitude.size());
  write_jigsaw_grid(path, grid);
}

} // namespace

void write(const std::string& path, const Raster& widths) {
  density_detail::require_widths(widths);
  if (widths.of_plane)
    refuse_path(path, "files of cell widths are written of the sphere; give a raster of it");
  const std::string suffix = suffix_of(path);
  if (suffix == ".nc")
    write_netcdf(path, widths);
  else if (suffix == ".msh")
    write_jigsaw(path, widths);
  else
    refuse_path(path,
                "a raster of cell widths is NetCDF (.nc) or JIGSAW's (.msh); give such a name");
}

} // namespace calotte
