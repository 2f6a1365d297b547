// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "base/points.h"
#include "io/bytes/file_error.h"
#include "io/command.h"
#include "io/shapes/jigsaw.h"

#include <calotte/widths.h>

#include <algorithm>
#include <numbers>
#include <string>

namespace calotte {
namespace {

using namespace io_detail;

/// The slope of a file.
/// \throws Error parse, unless it is one positive number.
double require_slope(const JigsawFile& file, const std::string& path) {
  if (file.slopes.empty())
    fail_file(path, "no SLOPE section; give the largest gradient, SLOPE=1;1 and the number");
  const auto [least, most] = std::minmax_element(file.slopes.begin(), file.slopes.end());
  if (*least != *most)
    fail_file(path, "SLOPE differs between nodes; give one number");
  if (!(*least > 0))
    fail_file(path, "SLOPE is not positive; correct it");
  return *least;
}

/// The limited values at the nodes of the file, with y running faster.
std::vector<double> limited_on_sphere(const JigsawFile& file, const std::string& path,
                                      double radius) {
  const Raster limited =
      limit_gradient(make_width_raster(file, path), require_slope(file, path), {}, radius);
  constexpr double degrees = 180 / std::numbers::pi;
  const auto ny = std::ssize(file.y_grid);
  Points3 nodes(3, std::ssize(file.x_grid) * ny);
  for (Eigen::Index k = 0; k < nodes.cols(); ++k)
    base_detail::set_column(
        nodes, k,
        base_detail::from_lonlat(
            file.x_grid[static_cast<std::size_t>(k / ny)] * degrees,
            std::clamp(file.y_grid[static_cast<std::size_t>(k % ny)] * degrees, -90.0, 90.0)));
  const DoubleVector values = evaluate(limited, nodes);
  return {values.begin(), values.end()};
}

std::vector<double> limited_in_plane(const JigsawFile& file, const std::string& path) {
  const Surface plane = Surface::plane();
  Raster limited =
      limit_gradient(make_width_raster(file, path, plane), require_slope(file, path), plane);
  if (file.x_grid.front() > file.x_grid.back()) // restore the order of the file
    limited.values.colwise().reverseInPlace();
  if (file.y_grid.front() > file.y_grid.back())
    limited.values.rowwise().reverseInPlace();
  const DoubleMatrix by_y = limited.values.transpose();
  return {by_y.data(), by_y.data() + by_y.size()};
}

} // namespace

void limit_jigsaw_values(const std::string& path, double radius) {
  JigsawFile file = read_jigsaw(path);
  if (file.values_of_each > 1)
    fail_file(path, "VALUE has several numbers for each node; give one, the width");
  std::vector<double> values;
  if (file.kind == "ellipsoid-grid")
    values = limited_on_sphere(file, path, file.radii ? require_sphere_radius(file, path) : radius);
  else if (file.kind == "euclidean-grid")
    values = limited_in_plane(file, path);
  else
    fail_file(path, "values of the kind \"{}\"; give a grid: ellipsoid-grid or euclidean-grid",
              file.kind);
  for (std::size_t i = 0; i < values.size(); ++i) // rounding must not raise a value
    file.values[i] = std::min(file.values[i], values[i]);
  write_jigsaw_grid(path, file);
}

} // namespace calotte
