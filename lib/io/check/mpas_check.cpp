// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/matrix_memory.h"
#include "base/points.h"
#include "io/cells/model_grid.h"
#include "io/formats/formats.h"
#include "voronoi/geometry.h"
#include "voronoi/stages.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace calotte::io_detail {
namespace {

constexpr double float_digits = 1.2e-7; // relative rounding of two floats

/// As voronoi(mesh), which it takes apart.
Voronoi voronoi_of(Mesh mesh) {
  BegunVoronoi cells = begun(mesh);
  release(mesh.points);
  connect(cells);
  measure(cells.voronoi);
  return std::move(cells.voronoi);
}

double mean_width(const Voronoi& voronoi) {
  return std::sqrt(voronoi.cell_area.sum() / static_cast<double>(voronoi.cell_area.size()));
}

double radius_of(const NetcdfReader& file, const MeshFile& mesh) {
  const double radius = file.number("", "sphere_radius", 0);
  return radius > 0 && std::isfinite(radius) ? radius : mesh.sphere_radius;
}

/// \param density as MeshFile has it; without effect unless it has a value for each cell.
void check_closed(const Voronoi& voronoi, double radius, DoubleVector density,
                  Deviations& deviations) {
  if (density.size() != voronoi.cells.cols())
    release(density);
  const MpasNumbering numbering = numbering_of(voronoi, deviations);
  const double width = mean_width(voronoi);
  const double of_floats = deviations.file().is_float("xCell") ? 4 * float_digits / width : 0;
  const MpasCheck check{
      deviations, voronoi, density, numbering, radius, width, rounding_of_others + of_floats};
  check_mpas_places(check);
  check_mpas_lists(check);
  check_mpas_measures(check);
  check_mpas_weights(check);
  check_mpas_values(check);
  check_mpas_density(check);
}

void check_sphere(MeshFile& file, Deviations& deviations) {
  const double radius = radius_of(deviations.file(), file);
  if (file.mesh->closed())
    check_closed(voronoi_of(std::move(*file.mesh)), radius, std::move(file.density), deviations);
  else
    check_open_mpas(file, radius, deviations);
}

} // namespace

double MpasCheck::rounding(const std::string& variable) const {
  const NetcdfReader& file = deviations.file();
  const double size = voronoi.surface.is_sphere() ? 1
                                                  : std::max(voronoi.surface.period().maxCoeff(),
                                                             voronoi.cells.cwiseAbs().maxCoeff());
  return file.is_float(variable) || file.is_float("xCell") ? float_digits * size : 0;
}

bool MpasCheck::has(const std::string& variable) const {
  const MpasVariable& row = mpas_variable(variable);
  std::vector<std::int64_t> shape;
  for (const MpasDimension dimension : {row.rows, row.columns})
    switch (dimension) {
    case MpasDimension::none:
      break;
    case MpasDimension::cells:
      shape.push_back(voronoi.cells.cols());
      break;
    case MpasDimension::edges:
      shape.push_back(voronoi.cells_on_edge.cols());
      break;
    case MpasDimension::vertices:
      shape.push_back(voronoi.cells_on_vertex.cols());
      break;
    case MpasDimension::two:
      shape.push_back(2);
      break;
    case MpasDimension::degree:
      shape.push_back(3);
      break;
    default:
      shape.push_back(-1);
    }
  return deviations.has(variable, shape);
}

void check_mpas_attributes(Deviations& deviations, bool on_sphere) {
  const NetcdfReader& file = deviations.file();
  const std::string stored = file.text("", "on_a_sphere"), wanted = on_sphere ? "YES" : "NO";
  if (!stored.starts_with(wanted))
    deviations.add("on_a_sphere",
                   "the attribute on_a_sphere is \"" + stored + "\" instead of \"" + wanted + "\"");
  const double radius = file.number("", "sphere_radius", std::numeric_limits<double>::quiet_NaN());
  if (on_sphere && !(radius > 0 && std::isfinite(radius)))
    deviations.add("sphere_radius", "the attribute sphere_radius is missing or not positive; "
                                    "MpasMeshConverter would scale all places with it");
}

void check_mpas(MeshFile file, Deviations& deviations) {
  check_mpas_attributes(deviations, file.sphere() != nullptr);
  try {
    if (file.sphere())
      check_sphere(file, deviations);
    else if (file.plane() && (file.polygons || !file.mesh->surface.is_box()))
      check_open_mpas(file, 1, deviations);
    else if (file.plane())
      check_closed(voronoi_of(std::move(*file.mesh)), 1, std::move(file.density), deviations);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_argument)
      throw;
    deviations.add(mpas::cells_on_vertex, "cellsOnVertex: the vertices have no tessellation: " +
                                              std::string(error.what()));
  }
}

} // namespace calotte::io_detail
