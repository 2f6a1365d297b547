// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats.h"
#include "io/netcdf_reader.h"
#include "mesh/adjacency.h"

#include "base/points.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>

namespace calotte::io_detail {
namespace {

bool on_plane(const NetcdfReader& file) { return file.text("", "on_a_sphere").starts_with("NO"); }

/// One row of coordinates of the cells a call, which all have the same length.
Points3 places_of_cells(const NetcdfReader& file) {
  Points3 places;
  for (int row = 0; row < 3; ++row) {
    const std::string name = std::string(1, "xyz"[row]) + "Cell";
    const std::vector<double> values =
        file.doubles(name, {row == 0 ? std::int64_t{-1} : std::int64_t{places.cols()}});
    if (row == 0)
      places.resize(3, std::ssize(values));
    places.row(row) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), std::ssize(values));
  }
  return places;
}

Triangles cells_on_vertices(const NetcdfReader& file, std::int64_t cells) {
  const std::vector<std::int32_t> ids = file.ints("cellsOnVertex", {-1, 3});
  const auto wrong = std::find_if(ids.begin(), ids.end(),
                                  [cells](std::int32_t id) { return id < 1 || id > cells; });
  if (wrong != ids.end()) {
    const std::string where = "cellsOnVertex has cell " + std::to_string(*wrong) + " at vertex " +
                              std::to_string((wrong - ids.begin()) / 3 + 1) + " (both 1-based), ";
    file.fail(*wrong == 0
                  ? where + "so the mesh ends there; give one that covers the sphere"
                  : where + "but there are " + std::to_string(cells) + "; make the file again");
  }
  return Eigen::Map<const Triangles>(ids.data(), 3, std::ssize(ids) / 3).array() - 1;
}

double period_of(const NetcdfReader& file, const std::string& name) {
  const double period = file.number("", name, 0);
  if (!(period > 0 && std::isfinite(period)))
    file.fail(name + " is missing or not positive; only doubly periodic planes are read");
  return period;
}

/// Into [0, period); what is there keeps its bits.
double wrapped(double x, double period) {
  const double inside = x - period * std::floor(x / period);
  return inside >= 0 && inside < period ? inside : 0;
}

} // namespace

bool is_mpas(const NetcdfReader& file) {
  return file.has_variable("xCell") && file.has_variable("yCell") && file.has_variable("zCell");
}

Points3 read_mpas_sites(const NetcdfReader& file) {
  if (on_plane(file))
    throw Error(ErrorCode::bad_option, file.path() + " holds a mesh of the plane, not of the "
                                                     "sphere; read it with read_planar_mesh");
  return places_of_cells(file);
}

Soup read_mpas(const NetcdfReader& file) {
  Points3 sites = read_mpas_sites(file);
  Triangles triangles = cells_on_vertices(file, sites.cols());
  return {std::move(sites), std::move(triangles)};
}

PlanarMesh read_planar_mpas(const NetcdfReader& file) {
  if (!on_plane(file))
    throw Error(ErrorCode::bad_option, file.path() + " holds a mesh of the sphere, not of the "
                                                     "plane; read it with read_mesh");
  PlanarMesh mesh;
  mesh.period = {period_of(file, "x_period"), period_of(file, "y_period")};
  const Points3 places = places_of_cells(file);
  if (!places.allFinite())
    file.fail("a coordinate of the cells is NaN or infinite; make the file again");
  mesh.points = places.topRows<2>();
  for (int row = 0; row < 2; ++row)
    for (double& x : mesh.points.row(row))
      x = wrapped(x, mesh.period[row]);
  mesh.triangles = cells_on_vertices(file, mesh.points.cols());
  mesh.neighbours = neighbours_of(mesh.triangles, mesh.points.cols());
  mesh.site_of_input = themselves(mesh.points.cols());
  return mesh;
}

} // namespace calotte::io_detail
