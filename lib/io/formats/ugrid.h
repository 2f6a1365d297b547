// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/mesh_file.h>

#include <string>
#include <vector>

// The UGRID conventions 1.0 for unstructured grids in NetCDF files. They store longitudes and
// latitudes, from which Cartesian coordinates cannot be recovered to the last bit. Calotte
// therefore also writes those of the sites, and names them in the attribute site_coordinates of the
// mesh variable. By this attribute the reader recognises a file of Calotte, and by the dimension of
// the variables whether sites are faces or nodes.

namespace calotte::io_detail {

inline constexpr const char* site_coordinates = "site_coordinates";

/// The names in the attributes of the mesh variable.
struct Topology {
  std::string face_nodes, face_dimension;
  std::vector<std::string> nodes; ///< longitude and latitude, or x and y in a plane
  std::vector<std::string> sites; ///< x, y, z; none in files of other programs
  std::vector<std::string> faces; ///< coordinates of the faces; may be none
  std::string mesh;               ///< the mesh variable
  bool planar = false;            ///< the nodes have projection coordinates
};

/// \throws Error parse.
Topology read_topology(const NetcdfReader& file);

/// Splits an attribute into names.
std::vector<std::string> names_in(const std::string& text);

/// Reads the faces as polygons whose corners are the nodes. They have centres if the file has
/// coordinates of the faces.
/// \throws Error parse.
Polygons read_ugrid_faces(const NetcdfReader& file, const Topology& topology);

} // namespace calotte::io_detail
