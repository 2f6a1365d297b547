// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <string>

namespace calotte {

/// Which part of a mesh a field belongs to.
enum class Location {
  cells,    ///< the sites and their cells
  vertices, ///< the triangles, whose circumcentres are the corners of cells
};

/// One number for each cell or vertex of a mesh, in its order.
struct MeshField {
  std::string name;
  std::string long_name = {}, units = {}; ///< attributes in NetCDF files; empty for none
  Location location = Location::cells;
  Eigen::VectorXd values = {}; ///< NaN where a file has its _FillValue
};

} // namespace calotte
