// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/message.h"
#include "voronoi/geometry.h"
#include "voronoi/stages.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace calotte::io_detail {
namespace {

constexpr double float_digits = 1.2e-7; // relative rounding of two floats

double mean_width(const Voronoi& voronoi) {
  return std::sqrt(voronoi.cell_area.sum() / static_cast<double>(voronoi.cell_area.size()));
}

double stored_radius(const NetcdfReader& file, const MeshFile& mesh) {
  const double radius = file.number("", "sphere_radius", 0);
  return radius > 0 && std::isfinite(radius) ? radius : mesh.sphere_radius;
}

/// Checks a closed mesh, whose tessellation is voronoi(mesh) with other numbers.
/// \param density as in MeshFile; ignored unless it has a value for each cell.
void check_closed(Mesh mesh, double radius, DoubleVector density, Deviations& deviations) {
  BegunVoronoi cells = begun(mesh);
  mesh.points.resize(3, 0);
  connect(cells);
  Voronoi& voronoi = cells.voronoi;
  if (density.size() != voronoi.cells.cols())
    density = {};
  MpasCheck check{deviations, voronoi, std::move(density), radius};
  take_numbering(find_numbering(voronoi, deviations), check);
  measure(voronoi);
  check.set_width(mean_width(voronoi));
  compare_mpas(check);
  check_mpas_density(check);
}

void check_attributes(Deviations& deviations, bool on_sphere) {
  const NetcdfReader& file = deviations.file();
  const std::string stored = file.text("", "on_a_sphere"), wanted = on_sphere ? "YES" : "NO";
  if (!stored.starts_with(wanted))
    deviations.add("on_a_sphere", message("the attribute on_a_sphere is \"{}\" instead of \"{}\"",
                                          stored, wanted));
  const double radius = file.number("", "sphere_radius", std::numeric_limits<double>::quiet_NaN());
  if (on_sphere && !(radius > 0 && std::isfinite(radius)))
    deviations.add("sphere_radius", "the attribute sphere_radius is missing or not positive; "
                                    "MpasMeshConverter would scale all places with it");
}

} // namespace

void MpasCheck::set_width(double mean) {
  width = mean;
  double least = mean;
  for (const double length : voronoi.dc)
    if (length > 0) // not for lack of a cell
      least = std::min(least, length);
  if (deviations.file().is_float("xCell"))
    tolerance += 4 * float_digits / least;
}

double MpasCheck::rounding(const std::string& variable) const {
  const NetcdfReader& file = deviations.file();
  if (!file.has_variable(variable) || !(file.is_float(variable) || file.is_float("xCell")))
    return 0;
  return float_digits *
         (voronoi.surface.is_sphere()
              ? 1
              : std::max(voronoi.surface.period().maxCoeff(), voronoi.cells.cwiseAbs().maxCoeff()));
}

std::int64_t MpasCheck::rows(MpasDimension dimension) const {
  switch (dimension) {
  case MpasDimension::cells:
    return voronoi.cells.cols();
  case MpasDimension::edges:
    return voronoi.cells_on_edge.cols();
  case MpasDimension::vertices:
    return voronoi.cells_on_vertex.cols();
  case MpasDimension::two:
    return 2;
  case MpasDimension::degree:
    return 3;
  default:
    return -1; // any
  }
}

bool MpasCheck::has(const std::string& variable) const {
  const MpasVariable& row = mpas_variable(variable);
  std::vector<std::int64_t> shape;
  for (const MpasDimension dimension : {row.rows, row.columns})
    if (dimension != MpasDimension::none)
      shape.push_back(rows(dimension));
  return deviations.has(variable, shape);
}

void check_mpas(MeshFile file, Deviations& deviations) {
  const bool on_sphere = file.sphere() != nullptr;
  check_attributes(deviations, on_sphere);
  if (!on_sphere && !file.plane())
    return;
  const double radius = on_sphere ? stored_radius(deviations.file(), file) : 1;
  const bool closed =
      on_sphere ? file.mesh->closed() : !file.polygons && file.mesh->surface.is_box();
  try {
    if (closed)
      check_closed(*std::move(file.mesh), radius, std::move(file.density), deviations);
    else
      check_open_mpas(file, radius, deviations);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_argument)
      throw;
    deviations.add(mpas::cells_on_vertex,
                   message("cellsOnVertex: the vertices have no tessellation: {}", error.what()));
  }
}

} // namespace calotte::io_detail
