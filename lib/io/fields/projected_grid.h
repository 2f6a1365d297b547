// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/fields/room.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/projection.h"

#include <calotte/field_grid.h>

#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

/// Rasters whose boxes are polygons of the sphere: those in the plane of a map projection, and
/// those with two-dimensional longitudes and latitudes.
namespace calotte::io_detail {

/// The variables of a raster's nodes, and the grid mapping of its projection.
struct ProjectedAxes {
  std::string x, y, mapping;
};

/// The axes of the first variable with a grid mapping other than latitude_longitude; none without
/// one, and none if that mapping is not read but the file has two-dimensional coordinates.
std::optional<ProjectedAxes> projected_axes(const NetcdfReader& file);

/// A raster in the plane of a projection, of which any rows can be read. Its cells are polygons of
/// the sphere: corners half way between nodes, geodetic latitudes taken as those of the sphere.
///
/// It refers to the file.
class ProjectedRaster {
public:
  /// \throws Error as read_field_grid().
  ProjectedRaster(const NetcdfReader& file, const ProjectedAxes& axes);

  std::int64_t columns() const { return std::ssize(x_) - 1; }
  std::int64_t rows() const { return std::ssize(y_) - 1; }

  /// Reads the cells of rows first to first + count - 1, and their fields.
  /// \param only names of the fields that are read. Default: all.
  /// \throws Error as read_field_grid().
  FieldGrid read(std::int64_t first, std::int64_t count, FieldChoice choice,
                 const std::vector<FieldIndex>& choices,
                 const std::optional<std::vector<std::string>>& only = {}) const;

private:
  const NetcdfReader& file_;
  ProjectedAxes axes_;
  Projection projection_;
  std::vector<double> x_, y_; ///< sides of the boxes, in the unit of the projection
};

/// A longitude and a latitude on the same two dimensions, which the attribute coordinates of a
/// variable names (CF conventions, 5.2), of cells without bounds; none without them. Cells with
/// bounds are those of a mesh file.
std::optional<RasterAxes> curvilinear_axes(const NetcdfReader& file);

/// The cells around the centres that two-dimensional longitudes and latitudes give: a corner is the
/// mean of the four centres around it; at a side of the raster the last step goes on, but columns
/// that follow each other round the sphere are joined, and rows round a pole end there.
/// \throws Error as read_field_grid().
FieldGrid read_curvilinear_grid(const NetcdfReader& file, const RasterAxes& axes,
                                FieldChoice choice, const std::vector<FieldIndex>& choices);

} // namespace calotte::io_detail
