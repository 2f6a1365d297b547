// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/mesh_file.h>

#include <string>
#include <vector>

// The UGRID conventions 1.0 for unstructured grids in NetCDF files. They hold longitudes and
// latitudes, which do not lead back to the last bit of Cartesian coordinates: those of the sites go
// along, and the mesh variable's attribute site_coordinates, which is ours, names them. By it the
// reader knows a file of ours, and by their dimension whether sites are faces or nodes.

namespace calotte::io_detail {

inline constexpr const char* site_coordinates = "site_coordinates";

/// The names that the mesh variable lists.
struct Topology {
  std::string face_nodes, face_dimension;
  std::vector<std::string> nodes; ///< longitude and latitude; in a plane x and y
  std::vector<std::string> sites; ///< x, y, z; none in files of others
  std::vector<std::string> faces; ///< those of the faces; may be none
  std::string mesh;               ///< the variable that lists the names
  bool planar = false;            ///< the nodes have projection coordinates
};

/// \throws Error parse.
Topology topology_of(const NetcdfReader& file);

/// The words of an attribute that lists names.
std::vector<std::string> names_in(const std::string& text);

/// The faces as polygons on the places of their nodes; centres where the file has places of the
/// faces. \throws Error parse.
Polygons read_ugrid_faces(const NetcdfReader& file, const Topology& topology);

} // namespace calotte::io_detail
