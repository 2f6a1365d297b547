// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/model_grid.h"
#include "io/cells/netcdf_fields.h"
#include "io/formats/formats.h"

// The grid file of ICON (Zangl et al., Q. J. R. Meteorol. Soc. 141, 2015). Its cells are triangles;
// their corners, its "vertices", are the sites of Calotte. Ids count from 1, and the corners of a
// triangle are the slower dimension.

namespace calotte::io_detail {
namespace {

const NetcdfMeshNames icon_names{.cells = "vertex",
                                 .vertices = "cell",
                                 .variables = {"clon",
                                               "clat",
                                               "vlon",
                                               "vlat",
                                               "elon",
                                               "elat",
                                               "clon_vertices",
                                               "clat_vertices",
                                               "vlon_vertices",
                                               "vlat_vertices",
                                               "elon_vertices",
                                               "elat_vertices",
                                               "vertex_of_cell",
                                               "edge_of_cell",
                                               "vertices_of_vertex",
                                               "cells_of_vertex",
                                               "edges_of_vertex",
                                               "edge_vertices",
                                               "neighbor_cell_index",
                                               "adjacent_cell_of_edge",
                                               "longitude_vertices",
                                               "latitude_vertices",
                                               "lon_cell_centre",
                                               "lat_cell_centre",
                                               "lon_edge_centre",
                                               "lat_edge_centre",
                                               "cartesian_x_vertices",
                                               "cartesian_y_vertices",
                                               "cartesian_z_vertices"}};

} // namespace

bool is_icon(const NetcdfReader& file) {
  return file.has_variable("vertex_of_cell") && file.has_variable("vlon") &&
         file.has_variable("vlat");
}

RawMesh read_icon(const NetcdfReader& file, FieldChoice choice) {
  RawMesh raw{.points = read_lonlats(file, "vlon", "vlat")};
  const std::vector<std::int32_t> ids = file.ints("vertex_of_cell", {3, -1});
  const std::int64_t cells = file.shape_of("vertex_of_cell")[1];
  raw.triangles.resize(3, cells);
  for (int i = 0; i < 3; ++i)
    raw.triangles.row(i) = Eigen::Map<const Eigen::Matrix<std::int32_t, 1, Eigen::Dynamic>>(
                               ids.data() + i * cells, cells)
                               .cwiseMax(0) // an id below 1 becomes -1, which is refused
                               .array() -
                           1;
  read_fields(file, icon_names, choice, raw);
  return raw;
}

} // namespace calotte::io_detail
