// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_error.h"
#include "io/command.h"
#include "io/shapes/cell_width_mesh.h"
#include "io/shapes/jigsaw.h"
#include "io/shapes/raster_file.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

namespace calotte::io_detail {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// One value for each node, y running faster.
Raster make_grid_raster(const JigsawFile& file, const std::string& name, const Surface& surface) {
  require_values(file, file.x_grid.size() * file.y_grid.size(), name);
  const bool of_plane = !surface.is_sphere();
  const double unit = of_plane ? 1 : degrees;
  RasterOfFile stored{.raster = {.x = unit * to_vector(file.x_grid),
                                 .y = unit * to_vector(file.y_grid),
                                 .of_plane = of_plane},
                      .x_name = "COORD=1",
                      .y_name = "COORD=2",
                      .value_name = "VALUE",
                      .x_fastest = false};
  stored.raster.values = Eigen::Map<const DoubleMatrix>(file.values.data(), stored.raster.y.size(),
                                                        stored.raster.x.size())
                             .transpose();
  return covering(std::move(stored), name, density_detail::positive_and_finite, surface);
}

/// One width for each point.
DoubleVector point_widths(const JigsawFile& file, const std::string& name) {
  require_values(file, static_cast<std::size_t>(file.points.cols()), name);
  for (std::size_t i = 0; i < file.values.size(); ++i)
    if (!(file.values[i] > 0))
      fail_file(name, "VALUE of point {} is not positive; correct it", i);
  return to_vector(file.values);
}

Raster make_mesh_raster(const JigsawFile& file, const std::string& name) {
  const DoubleVector widths = point_widths(file, name);
  const Points3 points = make_directions(file, name);
  return named(name, [&] { return resampled(points, widths); });
}

Raster widths_in_plane(const JigsawFile& file, const std::string& name, const Surface& plane) {
  if (is_planar_mesh(file))
    return resampled_in_plane(Points2(file.points), point_widths(file, name));
  if (file.kind == "euclidean-grid")
    return make_grid_raster(file, name, plane);
  fail_file(name,
            "no cell widths of a plane in a file of the kind \"{}\"; give euclidean-grid, or a "
            "euclidean-mesh of NDIMS=2",
            file.kind);
}

} // namespace

Raster make_width_raster(const JigsawFile& file, const std::string& name, const Surface& surface) {
  if (!surface.is_sphere())
    return widths_in_plane(file, name, surface);
  if (file.kind == "ellipsoid-grid")
    return make_grid_raster(file, name, surface);
  if (file.kind == "ellipsoid-mesh" || file.kind == "euclidean-mesh")
    return make_mesh_raster(file, name);
  fail_file(name,
            "no cell widths of the sphere in a file of the kind \"{}\"; give ellipsoid-grid, "
            "ellipsoid-mesh or euclidean-mesh",
            file.kind);
}

} // namespace calotte::io_detail

namespace calotte {

Raster read_jigsaw_widths(const std::string& path, const JigsawSizes& sizes,
                          const Surface& surface) {
  io_detail::JigsawFile file = io_detail::read_jigsaw(path);
  for (double& value : file.values)
    value = std::max(std::min(sizes.scale * value, sizes.most), sizes.least);
  return io_detail::make_width_raster(file, path, surface);
}

} // namespace calotte
