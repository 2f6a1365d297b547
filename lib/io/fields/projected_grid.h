// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/fields/room.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/field_grid.h>

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
/// one.
std::optional<ProjectedAxes> projected_axes(const NetcdfReader& file);

/// The cells between nodes of the projection as polygons of the sphere: corners half way between
/// nodes, geodetic latitudes taken as those of the sphere.
/// \throws Error as read_field_grid().
FieldGrid read_projected_grid(const NetcdfReader& file, const ProjectedAxes& axes,
                              FieldChoice choice, const std::vector<FieldIndex>& choices);

/// A longitude and a latitude on the same two dimensions, which the attribute coordinates of a
/// variable names (CF conventions, 5.2), of cells without bounds; none without them. Cells with
/// bounds are those of a mesh file.
std::optional<RasterAxes> curvilinear_axes(const NetcdfReader& file);

/// The cells around the centres that two-dimensional longitudes and latitudes give: a corner is the
/// mean of the four centres around it; at a side of the raster the last step goes on, but columns
/// that follow each other round the sphere are joined.
/// \throws Error as read_field_grid().
FieldGrid read_curvilinear_grid(const NetcdfReader& file, const RasterAxes& axes,
                                FieldChoice choice, const std::vector<FieldIndex>& choices);

} // namespace calotte::io_detail
