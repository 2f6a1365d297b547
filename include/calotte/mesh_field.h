// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/types.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace calotte {

/// Which part of a mesh a field belongs to.
enum class Location {
  cells, ///< the sites and their cells
  /// The pairs of sites that share an edge of a closed mesh, in the order of Voronoi: sorted by
  /// their lower site, then by their higher one.
  edges,
  /// The triangles, whose circumcentres are the corners of cells. Of cells that are not Voronoi
  /// cells: their corners.
  vertices,
};

/// A dimension of a field besides that of its location, such as levels or times.
struct FieldDimension {
  std::string name;       ///< of the dimension
  std::int64_t size = 1;  ///< >= 1
  bool unlimited = false; ///< in a file, such as the times of a model's history
};

/// Numbers for each cell, edge or vertex of a mesh, in its order.
struct MeshField {
  std::string name;                    ///< of the variable
  std::string long_name = {};          ///< attribute in NetCDF files; empty for none
  std::string units = {};              ///< attribute in NetCDF files; empty for none
  Location location = Location::cells; ///< what has the numbers
  /// count() numbers for the first cell, edge or vertex, then for the next; those of one in the
  /// order of `dimensions`, of which the last is the fastest. NaN where a file has its _FillValue.
  DoubleVector values = {};
  std::vector<FieldDimension> dimensions = {}; ///< none for one number for each
  /// How many of the dimensions come before the location's in a file: 1 for (Time, nCells, levels).
  int leading = 0;
  bool integer = false; ///< all are 32-bit integers, and NetCDF files store them as such
  bool single = false;  ///< NetCDF files store them as 32-bit floats; not of integers
  /// At edges: components along the edge's normal, from the lower to the higher site, or along its
  /// tangent. They change their sign where a numbering exchanges the two sites.
  bool directed = false;
  /// Other attributes of text in NetCDF files, each a name and its text, that hold for the numbers
  /// on any grid, such as standard_name and cell_methods.
  std::vector<std::array<std::string, 2>> attributes = {};

  /// Numbers for each cell, edge or vertex: the product of the dimensions' sizes.
  std::int64_t count() const {
    std::int64_t product = 1;
    for (const FieldDimension& dimension : dimensions)
      product *= dimension.size;
    return product;
  }
};

} // namespace calotte
