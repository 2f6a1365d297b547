// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas_check.h"

#include "base/points.h"
#include "io/formats.h"
#include "io/model_grid.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace calotte::io_detail {
namespace {

constexpr double float_digits = 1.2e-7; // relative rounding of two floats

/// With the density of the file, if it has one for each cell that is not negative anywhere.
CellFields fields_with(const Voronoi& voronoi, const Eigen::VectorXd& density) {
  CellFields fields = cell_fields(voronoi);
  if (density.size() == fields.density.size())
    fields.density = density;
  return fields;
}

double mean_width(const Voronoi& voronoi) {
  return std::sqrt(voronoi.cell_area.sum() / static_cast<double>(voronoi.cell_area.size()));
}

double radius_of(const NetcdfReader& file, const MeshFile& mesh) {
  const double radius = file.number("", "sphere_radius", 0);
  return radius > 0 && std::isfinite(radius) ? radius : mesh.sphere_radius;
}

void check_closed(const Voronoi& voronoi, double radius, const MeshFile& file,
                  Deviations& deviations) {
  const MpasNumbering numbering = numbering_of(voronoi, deviations);
  const CellFields fields = fields_with(voronoi, file.density);
  const double width = mean_width(voronoi);
  const double of_floats = deviations.file().is_float("xCell") ? 4 * float_digits / width : 0;
  const MpasCheck check{
      deviations, voronoi, fields, numbering, radius, width, rounding_of_others + of_floats};
  check_mpas_places(check);
  check_mpas_lists(check);
  check_mpas_measures(check);
  check_mpas_weights(check);
  check_mpas_quality(check);
}

void check_sphere(const MeshFile& file, Deviations& deviations) {
  if (file.mesh->closed())
    check_closed(voronoi(*file.mesh), radius_of(deviations.file(), file), file, deviations);
  else
    check_open_mpas(file, radius_of(deviations.file(), file), deviations);
}

} // namespace

double MpasCheck::rounding(const std::string& variable) const {
  const NetcdfReader& file = deviations.file();
  const double size =
      voronoi.on_sphere ? 1
                        : std::max(voronoi.period.maxCoeff(), voronoi.cells.cwiseAbs().maxCoeff());
  return file.is_float(variable) || file.is_float("xCell") ? float_digits * size : 0;
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

void check_mpas(const MeshFile& file, Deviations& deviations) {
  check_mpas_attributes(deviations, file.mesh.has_value());
  try {
    if (file.mesh)
      check_sphere(file, deviations);
    else if (file.plane && file.plane->period.minCoeff() == 0)
      check_open_mpas(file, 1, deviations);
    else if (file.plane)
      check_closed(voronoi(*file.plane), 1, file, deviations);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_option)
      throw;
    deviations.add("cellsOnVertex", "cellsOnVertex: the vertices have no tessellation: " +
                                        std::string(error.what()));
  }
}

} // namespace calotte::io_detail
