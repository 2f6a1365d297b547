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

/// What a JIGSAW .msh file says, in its own units. Sections that are absent are empty; those of
/// other names (TRIA4, POWER, ...) are passed over.
struct JigsawFile {
  /// In lower case: "euclidean-mesh", which is the default of a header without one,
  /// "ellipsoid-mesh", or a grid: "euclidean-grid", "ellipsoid-grid".
  std::string kind;
  int dimensions = 0; ///< NDIMS, 2 or 3
  /// dimensions x n: of an ellipsoid-mesh of 2, longitude and latitude in radians.
  DoubleMatrix points = {};
  std::vector<bool> fixed = {};                        ///< by point: its tag is negative
  std::vector<std::array<std::int32_t, 2>> edges = {}; ///< 0-based columns of points
  int parts = 0;                                       ///< that BOUND tells apart
  Triangles triangles = {};                            ///< 3 x m, 0-based columns of points
  std::optional<std::array<double, 3>> radii = {};     ///< of the ellipsoid
  /// Of a grid; of an ellipsoid-grid longitudes and latitudes in radians.
  std::vector<double> x_grid = {}, y_grid = {};
  /// The first of each point's, or of each node's with y running faster.
  std::vector<double> values = {};
  std::int64_t values_of_each = 1; ///< in the file
  std::vector<double> slopes = {}; ///< likewise, or one: the largest gradients of the values
};

/// \param name stands for the stream in messages.
/// \throws Error parse that names the line: text that is not a number, or not finite; a section of
///         fewer lines than it announces, or given twice; a vertex of a triangle or an edge that is
///         no point.
JigsawFile read_jigsaw(std::istream& in, const std::string& name);
/// The same from a file. \throws Error file.
JigsawFile read_jigsaw(const std::string& path);

/// The radius of the sphere that an ellipsoid is; 1 by default. \throws Error parse, where the
/// radii differ.
double radius_of(const JigsawFile& file, const std::string& name);

/// Writes a grid of values, with slopes and radii if there are any. The file is complete or absent.
/// \throws Error file.
void write_jigsaw_grid(const std::string& path, const JigsawFile& grid);

/// The widths that a file holds, see read_cell_width().
/// \throws Error as these.
Raster widths_of(const JigsawFile& file, const std::string& name, const Surface& surface = {});

/// Throws unless there is a value for each of so many nodes. \throws Error parse.
void require_values(const JigsawFile& file, std::size_t nodes, const std::string& name);

/// Whether the points are x and y of a plane.
bool is_planar_mesh(const JigsawFile& file);

/// The directions of a mesh's points; longitudes and latitudes as of a sphere. \throws Error parse,
/// for a mesh of the plane, and for a latitude beyond a pole.
Points3 directions_of(const JigsawFile& file, const std::string& name);

/// These, or of a planar mesh x y 0. \throws Error as directions_of().
Points3 columns_of(const JigsawFile& file, const std::string& name);

} // namespace calotte::io_detail
