// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/room.h"

#include <calotte/mesh.h>
#include <calotte/raster.h>
#include <calotte/widths.h>

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace calotte::io_detail {

/// The contents of a JIGSAW .msh file, in its own units. Missing sections are empty; sections of
/// other names (TRIA4, POWER, ...) are skipped.
struct JigsawFile {
  /// In lower case: "ellipsoid-mesh", "euclidean-grid", "ellipsoid-grid" or "euclidean-mesh", which
  /// is the default.
  std::string kind;
  int dimensions = 0; ///< NDIMS, 2 or 3
  /// dimensions x n. An ellipsoid-mesh of 2 dimensions has longitudes and latitudes in radians.
  DoubleMatrix points = {};
  std::vector<bool> fixed = {};                        ///< by point: its tag is negative
  std::vector<std::array<std::int32_t, 2>> edges = {}; ///< 0-based columns of points
  int parts = 0;                                       ///< number of parts in BOUND
  Triangles triangles = {};                            ///< 3 x m, 0-based columns of points
  std::optional<std::array<double, 3>> radii = {};     ///< of the ellipsoid
  /// Axes of a grid; an ellipsoid-grid has longitudes and latitudes in radians.
  std::vector<double> x_grid = {}, y_grid = {};
  /// The first value of each point, or of each node, with y running faster.
  std::vector<double> values = {};
  std::int64_t values_of_each = 1; ///< number of values of each point or node in the file
  std::vector<double> slopes = {}; ///< largest gradients: one of each node, or one number
};

/// \param name stands for the stream in messages.
/// \throws Error parse that names the line: text that is not a number, or not finite; a section of
///         fewer lines than it announces, or given twice; a vertex of a triangle or an edge that is
///         no point.
JigsawFile read_jigsaw(std::istream& in, const std::string& name);
/// The same for a file. \throws Error file.
JigsawFile read_jigsaw(const std::string& path);

/// The radius of the ellipsoid, which must be a sphere; 1 by default.
/// \throws Error parse, if its radii differ.
double require_sphere_radius(const JigsawFile& file, const std::string& name);

/// Writes a grid of values, with slopes and radii if there are any. The file is complete or absent.
/// \throws Error file.
void write_jigsaw_grid(const std::string& path, const JigsawFile& grid);

/// The widths in a file, as read_cell_width() returns them.
/// \throws Error as read_cell_width().
Raster make_width_raster(const JigsawFile& file, const std::string& name,
                         const Surface& surface = {});

/// Requires one value for each of so many nodes.
/// \throws Error parse.
void require_values(const JigsawFile& file, std::size_t nodes, const std::string& name);

/// Whether the points are x and y of a plane.
bool is_planar_mesh(const JigsawFile& file);

/// The points of a mesh as directions. Longitudes and latitudes are taken as those of a sphere.
/// \throws Error parse, for a mesh of the plane, and for a latitude beyond a pole.
Points3 make_directions(const JigsawFile& file, const std::string& name);

/// make_directions(), or the points x y 0 of a planar mesh.
/// \throws Error as make_directions().
Points3 make_columns(const JigsawFile& file, const std::string& name);

} // namespace calotte::io_detail
