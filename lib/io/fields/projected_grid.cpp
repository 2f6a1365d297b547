// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/fields/projected_grid.h"

#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/points.h"
#include "io/bytes/file_error.h"
#include "io/cells/netcdf_fields.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/cf_values.h"

#include <calotte/read.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <sstream>
#include <utility>

namespace calotte::io_detail {
namespace {

using base_detail::column;
using base_detail::Vec3;

/// Whether a dimension's variable is an axis of a projection, by its standard_name, its axis or its
/// name.
bool is_axis(const NetcdfReader& file, const std::string& name, char letter) {
  if (!file.is_numeric(name) || file.dimensions_of(name) != std::vector<std::string>{name})
    return false;
  const bool is_x = letter == 'x';
  const std::string standard = file.text(name, "standard_name"), axis = file.text(name, "axis");
  return standard == (is_x ? "projection_x_coordinate" : "projection_y_coordinate") ||
         standard == (is_x ? "grid_longitude" : "grid_latitude") || axis == (is_x ? "X" : "Y") ||
         (standard.empty() && axis.empty() && (name == (is_x ? "x" : "y")));
}

std::string find_axis(const NetcdfReader& file, const std::vector<std::string>& dimensions,
                      char letter) {
  const auto found = std::ranges::find_if(dimensions, [&](const std::string& name) {
    return file.has_variable(name) && is_axis(file, name, letter);
  });
  return found == dimensions.end() ? "" : *found;
}

/// The metres in the unit of an axis; 1 for degrees.
double metres_of(const NetcdfReader& file, const std::string& axis) {
  const std::string unit = file.text(axis, "units");
  if (unit.empty() || unit.starts_with("deg"))
    return 1;
  return 1000 * named(file.path() + ": " + axis, [&] { return kilometres_in(unit); });
}

/// The sides of the boxes of nodes, in metres or degrees.
std::vector<double> read_sides(const NetcdfReader& file, const std::string& axis,
                               const Projection& projection) {
  std::vector<double> nodes = cf_values(file, axis, {-1});
  const std::size_t n = nodes.size();
  if (n < 2)
    file.fail("{} has {} values; give two nodes or more", axis, n);
  const std::string unit = file.text(axis, "units");
  if (!projection.of_degrees() && unit.starts_with("deg"))
    file.fail("{} has the unit {}, which is no length; give m or km", axis, unit);
  if (!projection.of_degrees())
    scale(nodes, metres_of(file, axis));
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(nodes[i]) ||
        (i > 1 && !((nodes[i] - nodes[i - 1]) * (nodes[1] - nodes[0]) > 0)) ||
        (i == 1 && nodes[0] == nodes[1]))
      file.fail("{}[{}] does not ascend or descend as those before do; sort them", axis, i);
  std::vector<double> sides(n + 1);
  for (std::size_t i = 1; i < n; ++i)
    sides[i] = (nodes[i - 1] + nodes[i]) / 2;
  sides[0] = nodes[0] - (sides[1] - nodes[0]);
  sides[n] = nodes[n - 1] + (nodes[n - 1] - sides[n - 1]);
  return sides;
}

/// The corners of all boxes, a row of x for each y.
Points3 corners_of(const NetcdfReader& file, const Projection& projection,
                   std::span<const double> x, std::span<const double> y) {
  const std::int64_t wide = std::ssize(x);
  Points3 corners(3, wide * std::ssize(y));
  base_detail::for_each_block(
      corners.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i != end; ++i) {
          const auto [lon, lat] = projection.lonlat(x[static_cast<std::size_t>(i % wide)],
                                                    y[static_cast<std::size_t>(i / wide)]);
          base_detail::set_column(corners, i,
                                  std::isfinite(lon) && std::abs(lat) <= 90
                                      ? base_detail::from_lonlat(lon, lat)
                                      : Vec3{0, 0, 0});
        }
      });
  for (std::int64_t i = 0; i < corners.cols(); ++i)
    if (corners.col(i).isZero(0))
      file.fail("the corner at x {}, y {} is outside of what the projection shows; leave these "
                "cells out",
                x[static_cast<std::size_t>(i % wide)], y[static_cast<std::size_t>(i / wide)]);
  return corners;
}

/// The corners of each box, counter-clockwise seen from outside.
IdLists boxes_of(std::int64_t columns, std::int64_t rows, const Points3& corners) {
  const std::int64_t count = columns * rows;
  IdLists ids{Offsets::LinSpaced(count + 1, 0, 4 * count), Ids(4 * count)};
  base_detail::for_each_block(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const auto first = static_cast<std::int32_t>(i / columns * (columns + 1) + i % columns),
                 above = static_cast<std::int32_t>(first + columns + 1);
      std::array<std::int32_t, 4> box{first, first + 1, above + 1, above};
      const Vec3 &a = column(corners, box[0]), &b = column(corners, box[2]);
      if (dot(cross(column(corners, box[1]) - a, b - a), a) +
              dot(cross(b - a, column(corners, box[3]) - a), a) <
          0)
        std::swap(box[1], box[3]);
      std::ranges::copy(box, ids.items.data() + 4 * i);
    }
  });
  return ids;
}

void require_few(const NetcdfReader& file, std::int64_t columns, std::int64_t rows) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max() / 4;
  if (rows > most / columns - 1 || columns > most)
    file.fail("{} x {} cells are more than {}; give a part of them, or coarser ones", columns, rows,
              most);
}

FieldGrid grid_of(const NetcdfReader& file, Points3&& corners, std::int64_t columns,
                  std::int64_t rows) {
  FieldGrid grid{.name = file.path()};
  IdLists ids = boxes_of(columns, rows, corners);
  grid.mesh.polygons =
      Polygons{.corners = std::move(corners), .ids = std::move(ids), .centres = Points3(3, 0)};
  return grid;
}

// ---- Two-dimensional coordinates

/// The centres of cells, a row after the other.
struct Centres {
  std::vector<Vec3> points;
  std::int64_t rows, columns;
  bool closed = false; ///< whether the first column follows the last

  const Vec3& inside(std::int64_t j, std::int64_t i) const {
    return points[static_cast<std::size_t>(j * columns + i)];
  }
  /// Also one column and one row outside, where the last step goes on.
  Vec3 at(std::int64_t j, std::int64_t i) const {
    if (j < 0 || j >= rows)
      return 2.0 * at(j < 0 ? 0 : rows - 1, i) - at(j < 0 ? 1 : rows - 2, i);
    if (i >= 0 && i < columns)
      return inside(j, i);
    if (closed)
      return inside(j, i < 0 ? columns - 1 : 0);
    return 2.0 * inside(j, i < 0 ? 0 : columns - 1) - inside(j, i < 0 ? 1 : columns - 2);
  }
  /// The largest distance of two columns, over that of the first two in the same row.
  /// Rows at a pole do not count.
  double apart(std::int64_t a, std::int64_t b) const {
    double largest = 0;
    for (std::int64_t j = 0; j < rows; ++j)
      if (const double step = norm(inside(j, 1) - inside(j, 0)); step > 1e-12)
        largest = std::max(largest, norm(inside(j, a) - inside(j, b)) / step);
    return largest;
  }
};

Centres read_centres(const NetcdfReader& file, const RasterAxes& axes) {
  const std::vector<std::string> dimensions = file.dimensions_of(axes.longitude);
  Centres centres{{}, file.dimension(dimensions[0]), file.dimension(dimensions[1])};
  if (centres.rows < 2 || centres.columns < 2)
    file.fail("{} is {} x {}; give two rows and columns or more", axes.longitude, centres.rows,
              centres.columns);
  require_few(file, centres.columns, centres.rows);
  const auto read = [&](const std::string& name) {
    std::vector<double> values = cf_values(file, name, {centres.rows, centres.columns});
    scale(values, degrees_per_unit(file, name));
    return values;
  };
  const std::vector<double> lon = read(axes.longitude), lat = read(axes.latitude);
  for (std::size_t k = 0; k < lon.size(); ++k) {
    if (!(std::isfinite(lon[k]) && std::abs(lat[k]) <= 90))
      file.fail("{}[{}, {}] and {} there are no longitude and latitude; give those of all cells",
                axes.longitude, k / static_cast<std::size_t>(centres.columns),
                k % static_cast<std::size_t>(centres.columns), axes.latitude);
    centres.points.push_back(base_detail::from_lonlat(lon[k], lat[k]));
  }
  for (const std::int64_t last : {centres.columns - 1, centres.columns - 2})
    if (last > 0 && centres.apart(0, last) < 1e-3)
      file.fail("column {} of {} repeats column 0; leave such columns out, as by ncks -d", last,
                axes.longitude);
  centres.closed = centres.columns > 2 && centres.apart(0, centres.columns - 1) < 1.5;
  return centres;
}

/// Moves the corners of the first or the last row to a pole if all are beyond it, as those half a
/// step from rows of latitudes may be.
void end_at_pole(const Centres& centres, bool last, Points3& corners) {
  const std::int64_t wide = centres.columns + 1, inner = last ? centres.rows - 2 : 1;
  auto side = corners.middleCols(last ? centres.rows * wide : 0, wide);
  for (std::int64_t i = 0; i < wide; ++i) {
    const Vec3 beside = centres.at(inner, i - 1) + centres.at(inner, i);
    if (beside.x * side(0, i) + beside.y * side(1, i) > 1e-12)
      return;
  }
  for (std::int64_t i = 0; i < wide; ++i)
    side.col(i) << 0, 0, std::copysign(1.0, side(2, i));
}

/// Refuses cells that cover some places twice, which their areas show where they cover the sphere.
void require_no_overlap(const NetcdfReader& file, const Polygons& cells) {
  const double spheres = areas(cells).sum() / (4 * std::numbers::pi);
  if (spheres > 1 + 1e-6)
    file.fail("its cells cover {} times the sphere; leave out the rows and columns that repeat, as "
              "by ncks -d",
              spheres);
}

Points3 corners_between(const NetcdfReader& file, const Centres& centres) {
  const std::int64_t wide = centres.columns + 1;
  Points3 corners(3, wide * (centres.rows + 1));
  base_detail::for_each_block(corners.cols(), [&](std::int64_t, std::int64_t begin,
                                                  std::int64_t end) {
    for (std::int64_t k = begin; k != end; ++k) {
      const std::int64_t j = k / wide, i = k % wide;
      const Vec3 sum =
          centres.at(j - 1, i - 1) + centres.at(j - 1, i) + centres.at(j, i - 1) + centres.at(j, i);
      base_detail::set_column(corners, k, norm(sum) > 1e-9 ? (1 / norm(sum)) * sum : Vec3{0, 0, 0});
    }
  });
  if (centres.closed)
    for (const bool last : {false, true})
      end_at_pole(centres, last, corners);
  for (std::int64_t k = 0; k < corners.cols(); ++k)
    if (corners.col(k).isZero(0))
      file.fail("the cells beside row {} and column {} are opposite each other; give a raster of "
                "narrower cells",
                k / wide, k % wide);
  return corners;
}

} // namespace

std::optional<ProjectedAxes> projected_axes(const NetcdfReader& file) {
  for (const std::string& name : file.variable_names()) {
    const std::string text = file.text(name, "grid_mapping"),
                      mapping = text.substr(0, text.find_first_of(": "));
    if (mapping.empty() || !file.has_variable(mapping) ||
        file.text(mapping, "grid_mapping_name").empty() ||
        file.text(mapping, "grid_mapping_name") == "latitude_longitude")
      continue;
    const std::vector<std::string> dimensions = file.dimensions_of(name);
    ProjectedAxes axes{find_axis(file, dimensions, 'x'), find_axis(file, dimensions, 'y'), mapping};
    if (axes.x.empty() || axes.y.empty())
      continue;
    if (!Projection::reads(file.text(mapping, "grid_mapping_name")) && curvilinear_axes(file))
      return std::nullopt;
    return axes;
  }
  return std::nullopt;
}

ProjectedRaster::ProjectedRaster(const NetcdfReader& file, const ProjectedAxes& axes)
    : file_(file), axes_(axes), projection_(file, axes.mapping, metres_of(file, axes.x)),
      x_(read_sides(file, axes.x, projection_)), y_(read_sides(file, axes.y, projection_)) {
  if (projection_.of_degrees() && std::abs(x_.back() - x_.front()) > 360 * (1 + 1e-9))
    file.fail("{} goes round more than once, by {} degrees; leave out the columns that repeat",
              axes.x, std::abs(x_.back() - x_.front()));
}

FieldGrid ProjectedRaster::read(std::int64_t first, std::int64_t count, FieldChoice choice,
                                const std::vector<FieldIndex>& choices,
                                const std::optional<std::vector<std::string>>& only) const {
  require_few(file_, columns(), count);
  const auto y =
      std::span(y_).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count) + 1);
  FieldGrid grid = grid_of(file_, corners_of(file_, projection_, x_, y), columns(), count);
  std::set<std::string> no_fields{axes_.x, axes_.y, axes_.mapping};
  for (const std::string& name : file_.variable_names())
    if (is_longitude(file_, name) || is_latitude(file_, name))
      no_fields.insert(name);
  read_fields_on(file_,
                 {.dimensions = {axes_.y, axes_.x},
                  .no_fields = no_fields,
                  .only = only,
                  .choice = choice,
                  .choices = choices,
                  .rows = {{first, count}}},
                 grid.fields, grid.ignored);
  return grid;
}

std::optional<RasterAxes> curvilinear_axes(const NetcdfReader& file) {
  for (const std::string& field : file.variable_names()) {
    std::istringstream words(file.text(field, "coordinates"));
    RasterAxes axes;
    for (std::string name; words >> name;)
      if (file.has_variable(name) && file.dimensions_of(name).size() == 2 &&
          file.dimensions_of(name)[0] != file.dimensions_of(name)[1] &&
          !file.has_variable(file.text(name, "bounds"))) {
        if (is_longitude(file, name))
          axes.longitude = name;
        else if (is_latitude(file, name))
          axes.latitude = name;
      }
    if (!axes.longitude.empty() && !axes.latitude.empty() &&
        file.dimensions_of(axes.longitude) == file.dimensions_of(axes.latitude))
      return axes;
  }
  return std::nullopt;
}

FieldGrid read_curvilinear_grid(const NetcdfReader& file, const RasterAxes& axes,
                                FieldChoice choice, const std::vector<FieldIndex>& choices) {
  const Centres centres = read_centres(file, axes);
  FieldGrid grid = grid_of(file, corners_between(file, centres), centres.columns, centres.rows);
  require_no_overlap(file, *grid.mesh.polygons);
  read_fields_on(file,
                 {.dimensions = file.dimensions_of(axes.longitude),
                  .no_fields = {axes.longitude, axes.latitude},
                  .choice = choice,
                  .choices = choices},
                 grid.fields, grid.ignored);
  return grid;
}

} // namespace calotte::io_detail
