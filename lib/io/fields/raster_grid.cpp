// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/fields/raster_grid.h"

#include "io/cells/netcdf_fields.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/cf_values.h"
#include "io/shapes/raster_file.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace calotte::io_detail {
namespace {

/// Reads the sides of boxes from a variable of bounds, in the order of the nodes; none without one.
/// \throws Error parse, if there are gaps.
DoubleVector read_sides(const NetcdfReader& file, const std::string& axis,
                        const DoubleVector& nodes) {
  const std::string name = file.text(axis, "bounds");
  if (name.empty() || !file.has_variable(name))
    return {};
  std::vector<double> bounds = cf_values(file, name, {nodes.size(), 2});
  scale(bounds, degrees_per_unit(file, file.text(name, "units").empty() ? axis : name));
  const Eigen::Index n = nodes.size();
  const double sign = n > 1 && nodes[1] < nodes[0] ? -1 : 1;
  DoubleVector sides(n + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    double &first = bounds[static_cast<std::size_t>(2 * i)],
           &second = bounds[static_cast<std::size_t>(2 * i + 1)];
    if (sign * first > sign * second)
      std::swap(first, second);
    constexpr double rounding = 1e-4; // degrees, in single precision
    if (i > 0 && !(std::abs(first - sides[i]) < rounding))
      file.fail("{}[{}] does not begin where the one before ends; give bounds without gaps, or "
                "remove them",
                name, i);
    if (i == 0)
      sides[0] = first;
    sides[i + 1] = second;
  }
  return sides;
}

LonLatBoxes read_boxes(const NetcdfReader& file, const RasterAxes& axes) {
  const DoubleVector longitudes = to_vector(read_degrees_of_axis(file, axes.longitude)),
                     latitudes = to_vector(read_degrees_of_axis(file, axes.latitude)),
                     meridians = read_sides(file, axes.longitude, longitudes),
                     parallels = read_sides(file, axes.latitude, latitudes);
  try {
    LonLatBoxes boxes =
        meridians.size() > 0 && parallels.size() > 0
            ? LonLatBoxes{longitudes, latitudes, meridians, parallels.cwiseMin(90).cwiseMax(-90)}
            : lon_lat_boxes(longitudes, latitudes);
    require_boxes(boxes);
    return boxes;
  } catch (const Error& error) {
    file.fail(error.what());
  }
}

} // namespace

FieldGrid read_raster_grid(const NetcdfReader& file, const RasterAxes& axes, FieldChoice choice,
                           const std::vector<FieldIndex>& choices) {
  FieldGrid grid{.name = file.path()};
  grid.boxes = read_boxes(file, axes);
  read_fields_on(file,
                 {.dimensions = {axes.latitude, axes.longitude},
                  .no_fields = {axes.latitude, axes.longitude},
                  .choice = choice,
                  .choices = choices},
                 grid.fields, grid.ignored);
  return grid;
}

} // namespace calotte::io_detail
