// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/cell_width_file.h"
#include "io/shapes/cell_width_mesh.h"
#include "io/shapes/jigsaw.h"

#include <calotte/error.h>

#include <numbers>

namespace calotte::io_detail {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

[[noreturn]] void refuse(const std::string& name, const std::string& problem) {
  throw Error(ErrorCode::parse, name + ": " + problem);
}

void require_count(const JigsawFile& file, std::size_t nodes, const std::string& name) {
  if (file.values.size() != nodes)
    refuse(name, "VALUE has " + std::to_string(file.values.size()) + " widths for " +
                     std::to_string(nodes) + " nodes; give one for each");
}

CellWidth of_grid(const JigsawFile& file, const std::string& name, const Surface& region) {
  require_count(file, file.x_grid.size() * file.y_grid.size(), name);
  Raster raster;
  raster.longitude_name = "COORD=1";
  raster.latitude_name = "COORD=2";
  raster.value_name = "VALUE";
  raster.longitude_fastest = false;
  for (const double longitude : file.x_grid)
    raster.longitudes.push_back(longitude * degrees);
  for (const double latitude : file.y_grid)
    raster.latitudes.push_back(latitude * degrees);
  raster.values = Eigen::Map<const DoubleMatrix>(file.values.data(),
                                                 static_cast<Eigen::Index>(file.y_grid.size()),
                                                 static_cast<Eigen::Index>(file.x_grid.size()))
                      .transpose();
  return checked(std::move(raster), name, region);
}

CellWidth of_mesh(const JigsawFile& file, const std::string& name) {
  require_count(file, static_cast<std::size_t>(file.points.cols()), name);
  const DoubleVector widths = Eigen::Map<const DoubleVector>(
      file.values.data(), static_cast<Eigen::Index>(file.values.size()));
  for (Eigen::Index i = 0; i < widths.size(); ++i)
    if (!(widths[i] > 0))
      refuse(name, "VALUE of point " + std::to_string(i) + " is not positive; correct it");
  try {
    return resampled(directions_of(file, name), widths);
  } catch (const Error& error) {
    if (std::string(error.what()).starts_with(name))
      throw;
    throw Error(error.code(), name + ": " + error.what(), error.index());
  }
}

} // namespace

CellWidth read_cell_width_msh(std::istream& in, const std::string& name, const Surface& region) {
  const JigsawFile file = read_jigsaw(in, name);
  if (file.kind == "ellipsoid-grid")
    return of_grid(file, name, region);
  if (file.kind == "ellipsoid-mesh" || file.kind == "euclidean-mesh")
    return of_mesh(file, name);
  refuse(name, "no cell widths in a file of the kind \"" + file.kind +
                   "\"; give ellipsoid-grid, ellipsoid-mesh or euclidean-mesh");
}

} // namespace calotte::io_detail
