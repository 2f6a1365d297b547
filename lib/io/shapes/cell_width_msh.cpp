// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_error.h"
#include "io/command.h"
#include "io/shapes/cell_width_file.h"
#include "io/shapes/cell_width_mesh.h"
#include "io/shapes/jigsaw.h"
#include "io/shapes/planar_grid.h"

#include <calotte/error.h>

#include <algorithm>
#include <numbers>

namespace calotte::io_detail {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

CellWidth of_grid(const JigsawFile& file, const std::string& name, const Surface& region) {
  require_values(file, file.x_grid.size() * file.y_grid.size(), name);
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

/// One width for each point.
DoubleVector widths_of_points(const JigsawFile& file, const std::string& name) {
  require_values(file, static_cast<std::size_t>(file.points.cols()), name);
  for (std::size_t i = 0; i < file.values.size(); ++i)
    if (!(file.values[i] > 0))
      fail_file(name, "VALUE of point " + std::to_string(i) + " is not positive; correct it");
  return vector_of(file.values);
}

CellWidth of_mesh(const JigsawFile& file, const std::string& name) {
  const DoubleVector widths = widths_of_points(file, name);
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
  return widths_of(read_jigsaw(in, name), name, region);
}

CellWidth widths_of(const JigsawFile& file, const std::string& name, const Surface& region) {
  if (file.kind == "ellipsoid-grid")
    return of_grid(file, name, region);
  if (file.kind == "ellipsoid-mesh" || file.kind == "euclidean-mesh")
    return of_mesh(file, name);
  fail_file(name, "no cell widths of the sphere in a file of the kind \"" + file.kind +
                      "\"; give ellipsoid-grid, ellipsoid-mesh or euclidean-mesh");
}

PlanarCellWidth read_planar_cell_width_msh(const std::string& path) {
  return planar_widths_of(read_jigsaw(path), path);
}

PlanarCellWidth planar_widths_of(const JigsawFile& file, const std::string& path) {
  if (file.kind == "euclidean-mesh" && file.dimensions == 2)
    return resampled_in_plane(Points2(file.points), widths_of_points(file, path));
  if (file.kind != "euclidean-grid")
    fail_file(path, "no cell widths of a plane in a file of the kind \"" + file.kind +
                        "\"; give euclidean-grid, or a euclidean-mesh of NDIMS=2");
  const auto nx = std::ssize(file.x_grid), ny = std::ssize(file.y_grid);
  require_values(file, file.x_grid.size() * file.y_grid.size(), path);
  return checked({.x = vector_of(file.x_grid),
                  .y = vector_of(file.y_grid),
                  .values = Eigen::Map<const DoubleMatrix>(file.values.data(), ny, nx).transpose(),
                  .x_name = "COORD=1",
                  .y_name = "COORD=2",
                  .value_name = "VALUE"},
                 path);
}

} // namespace calotte::io_detail

namespace calotte {
namespace {

io_detail::JigsawFile read_sized(const std::string& path, const JigsawSizes& sizes) {
  io_detail::JigsawFile file = io_detail::read_jigsaw(path);
  for (double& value : file.values)
    value = std::max(std::min(sizes.scale * value, sizes.most), sizes.least);
  return file;
}

} // namespace

CellWidth read_jigsaw_widths(const std::string& path, const JigsawSizes& sizes) {
  return io_detail::widths_of(read_sized(path, sizes), path);
}

PlanarCellWidth read_planar_jigsaw_widths(const std::string& path, const JigsawSizes& sizes) {
  return io_detail::planar_widths_of(read_sized(path, sizes), path);
}

} // namespace calotte
