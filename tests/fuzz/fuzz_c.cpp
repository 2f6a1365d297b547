// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"

#include <calotte/c.h>

using calotte::fuzz::require;

/// The C functions: each returns a status, and what succeeds has consistent views.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  calotte::fuzz::Bytes bytes(data, size);
  const bool plane = bytes.integer(0, 1) == 1;
  const double period_x = bytes.number(), period_y = bytes.number();
  const Eigen::MatrixXd points = bytes.columns(plane ? 2 : 3, 60);
  calotte_mesh* mesh = nullptr;
  calotte_error error;
  const calotte_status status = plane
                                    ? calotte_delaunay_in_plane(points.data(), points.cols(),
                                                                period_x, period_y, &mesh, &error)
                                    : calotte_delaunay(points.data(), points.cols(), &mesh, &error);
  require((status == 0) == (mesh != nullptr));
  if (mesh == nullptr)
    return 0;
  calotte_triangulation view;
  calotte_mesh_view(mesh, &view);
  require(calotte_check(mesh, &error) == 0);
  calotte_cells* cells = nullptr;
  if (calotte_voronoi(mesh, &cells, &error) == 0) {
    calotte_tessellation tessellation;
    calotte_cells_view(cells, &tessellation);
  }
  calotte_cells_free(cells);
  calotte_mesh_free(mesh);
  return 0;
}
