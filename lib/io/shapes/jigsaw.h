// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/room.h"

#include <calotte/types.h>

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

namespace calotte::io_detail {

/// What a JIGSAW .msh file says, in its own units. Sections that are absent are empty; those of
/// other names (EDGE2, POWER, ...) are passed over.
struct JigsawFile {
  std::string kind;   ///< in lower case: "euclidean-mesh", which is the default of a header without
                      ///< one, "ellipsoid-mesh", "ellipsoid-grid"
  int dimensions = 0; ///< NDIMS, 2 or 3
  DoubleMatrix points; ///< dimensions x n: of an ellipsoid-mesh of 2, longitude and latitude in
                       ///< radians
  Triangles triangles; ///< 3 x m, 0-based columns of points
  std::array<double, 3> radii{1, 1, 1}; ///< of the ellipsoid
  std::vector<double> x_grid, y_grid; ///< of an ellipsoid-grid: longitudes and latitudes in radians
  std::vector<double>
      values; ///< the first of each point's, or of each node's with y running faster
};

/// \param name stands for the stream in messages.
/// \throws Error parse that names the line: text that is not a number, or not finite; a section of
///         fewer lines than it announces, or given twice; a vertex of a triangle that is no point.
JigsawFile read_jigsaw(std::istream& in, const std::string& name);

/// The directions of a mesh's points; longitudes and latitudes as of a sphere. \throws Error parse,
/// for a mesh of the plane, and for a latitude beyond a pole.
Points3 directions_of(const JigsawFile& file, const std::string& name);

} // namespace calotte::io_detail
