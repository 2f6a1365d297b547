// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"

#include <calotte/c.h>

#include <vector>

using calotte::fuzz::require;

namespace {

/// Positions are located, and values interpolated, or neither output is set.
void look_up(const calotte_mesh* mesh, const Eigen::MatrixXd& positions) {
  calotte_triangulation view;
  calotte_triangulation_init(&view);
  require(calotte_mesh_view(mesh, &view, nullptr) == 0);
  const auto n = static_cast<std::size_t>(positions.cols());
  const std::vector<double> ones(static_cast<std::size_t>(view.sites), 1);
  std::vector<double> weights(3 * n), values(n);
  std::vector<std::int32_t> triangles(n, -2), nearest(n, -2);
  if (calotte_locate(mesh, positions.data(), positions.cols(), triangles.data(), weights.data(),
                     nearest.data(), nullptr) == 0)
    for (std::size_t i = 0; i < n; ++i)
      require(triangles[i] >= -1 && triangles[i] < view.triangles && nearest[i] >= 0 &&
              nearest[i] < view.sites);
  calotte_locator* locator = nullptr;
  if (calotte_locator_make(mesh, &locator, nullptr) == 0) {
    std::vector<std::int32_t> sites(n, -2);
    if (calotte_locator_nearest(locator, positions.data(), positions.cols(), 1, sites.data(),
                                nullptr) == 0)
      require(sites == nearest);
    std::vector<std::int64_t> begin(n + 1);
    if (calotte_locator_within(locator, positions.data(), positions.cols(), 0.5, begin.data(),
                               nullptr, nullptr) == 0) {
      std::vector<std::int32_t> within(static_cast<std::size_t>(begin[n]), -2);
      require(calotte_locator_within(locator, positions.data(), positions.cols(), 0.5, begin.data(),
                                     within.data(), nullptr) == 0);
      for (const std::int32_t site : within)
        require(site >= 0 && site < view.sites);
    }
    calotte_locator_free(locator);
  }
  for (const int natural : {0, 1})
    calotte_interpolate(mesh, ones.data(), positions.data(), positions.cols(), natural,
                        values.data(), nullptr);
}

} // namespace

/// The C functions: each returns a status, and what succeeds has consistent views.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  calotte::fuzz::Bytes bytes(data, size);
  calotte_surface surface;
  calotte_surface_init(&surface);
  surface.kind = bytes.integer(0, 1);
  if (surface.kind == CALOTTE_PLANE) {
    surface.period[0] = bytes.number();
    surface.period[1] = bytes.number();
  }
  const int rows = surface.kind == CALOTTE_PLANE ? 2 : 3;
  const Eigen::MatrixXd points = bytes.columns(rows, 60);
  std::vector<double> areas(static_cast<std::size_t>(points.cols()));
  if (calotte_area_weights(points.data(), points.cols(), &surface, bytes.integer(-1, 5), 0.3,
                           areas.data(), nullptr) == 0)
    for (const double area : areas)
      require(area >= 0);
  calotte_mesh* mesh = nullptr;
  calotte_error error;
  calotte_error_init(&error);
  const calotte_status status =
      calotte_delaunay(points.data(), points.cols(), &surface, &mesh, &error);
  require((status == 0) == (mesh != nullptr));
  if (mesh == nullptr)
    return 0;
  require(calotte_check(mesh, &error) == 0);
  look_up(mesh, bytes.columns(rows, 8));
  calotte_cells* cells = nullptr;
  if (calotte_voronoi(mesh, &cells, &error) == 0) {
    calotte_tessellation tessellation;
    calotte_tessellation_init(&tessellation);
    require(calotte_cells_view(cells, &tessellation, &error) == 0);
  }
  calotte_cells_free(cells);
  calotte_mesh_free(mesh);
  return 0;
}
