// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "voronoi/cell_fields.h"
#include "voronoi/spacing_fit.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace calotte::io_detail {
namespace {

/// An open mesh may have lost the cells of the greatest density.
void check_density(const MpasCheck& check) {
  if (!check.has(mpas::mesh_density))
    return;
  const Differences outside = check.deviations.visit_rows<double>(
      mpas::mesh_density, [](std::int64_t i, const double* stored, Differences& out) {
        if (!(*stored >= 0 && *stored <= 1 + rounding_of_others))
          out.note(i, *stored, 1, std::isfinite(*stored) ? std::abs(*stored - 1) : 1);
      });
  check.add(mpas::mesh_density, outside);
  const double greatest = check.density.size() > 0 ? check.density.maxCoeff() : 1;
  if (check.closed && outside.count == 0 && std::abs(greatest - 1) > rounding_of_others)
    check.deviations.add(mpas::mesh_density, "meshDensity: its maximum is " +
                                                 std::to_string(greatest) + " instead of 1");
}

double nominal_length(const MpasCheck& check) {
  return check.radius * nominal_spacing(check.voronoi, check.density);
}

/// A sum over all cells, to which a wrong density of a single one contributes little.
void check_nominal_spacing(const MpasCheck& check) {
  if (!check.has(mpas::nominal_min_dc))
    return;
  const NetcdfReader& file = check.deviations.file();
  const bool rounded = file.is_float(mpas::nominal_min_dc) || file.is_float("xCell") ||
                       (file.has_variable(mpas::mesh_density) && file.is_float(mpas::mesh_density));
  const double tolerance = rounded ? rounding_of_others : 1e-10;
  const double derived = nominal_length(check);
  check.add(mpas::nominal_min_dc,
            check.deviations.visit_rows<double>(
                mpas::nominal_min_dc, [&](std::int64_t, const double* stored, Differences& out) {
                  out.compare(0, *stored, derived, derived, tolerance);
                }));
}

/// The number in the file.
double stored_nominal(const MpasCheck& check) {
  double stored = 0;
  check.deviations.file().rows(mpas::nominal_min_dc, 0, 1, &stored);
  return stored;
}

std::string shown(double value) {
  std::ostringstream text;
  text.precision(5);
  text << value;
  return text.str();
}

/// Where the nominal spacing of an open mesh is too far from that of its cells. A CVT's median is
/// within 1% of it, that of independent random sites within 2%.
void check_median(const MpasCheck& check, double stored, const SpacingFit& fit) {
  constexpr double factor = 1.25;
  if (fit.median > 1 / factor && fit.median < factor)
    return;
  check.deviations.add(mpas::nominal_min_dc,
                       "nominalMinDc: " + shown(stored) +
                           " is stored, but the cells (dcEdge) are " + shown(fit.median) +
                           " times as wide as nominalMinDc meshDensity^(-1/4) (median), so that " +
                           shown(nominal_length(check)) +
                           " follows; correct it: MPAS-Atmosphere takes its length "
                           "of dissipation from it",
                       -1, std::abs(fit.median - 1));
}

/// Where the density does not follow the cells. After smoothing 90% of the ratios lie within 2 to
/// 10% in a CVT, however steep its density, and within 46% for independent random sites.
void check_spread(const MpasCheck& check, const SpacingFit& fit) {
  constexpr double factor = 1.6;
  if (fit.high < factor * fit.low)
    return;
  check.deviations.add(mpas::mesh_density,
                       "meshDensity: the cells (dcEdge) are " + shown(fit.low / fit.median) +
                           " to " + shown(fit.high / fit.median) +
                           " times as wide as meshDensity^(-1/4) says (90% of them), but models "
                           "scale their diffusion with it; give the density or the widths of the "
                           "mesh: calotte convert IN OUT.nc --density or --cell-width",
                       -1, fit.high / fit.low - 1);
}

/// The nominal spacing and the density against the spacing of the cells. That of a closed mesh is
/// known to follow from the density.
void check_spacing(const MpasCheck& check) {
  const bool has_density = check.density.size() == check.voronoi.cells.cols();
  const bool has_nominal = check.deviations.file().has_variable(mpas::nominal_min_dc);
  const bool compares = has_nominal && !check.closed && check.has(mpas::nominal_min_dc);
  const double derived = nominal_length(check),
               nominal = compares ? stored_nominal(check) : derived;
  if ((!has_density && !has_nominal) || !(derived > 0))
    return;
  if (!(nominal > 0 && std::isfinite(nominal)))
    return check.deviations.add(mpas::nominal_min_dc, "nominalMinDc: " + shown(nominal) +
                                                          " is stored, which is no length; " +
                                                          shown(derived) +
                                                          " follows from the cells");
  const SpacingFit fit = spacing_fit(check.voronoi, check.density, nominal / check.radius);
  if (fit.cells == 0)
    return;
  if (compares)
    check_median(check, nominal, fit);
  check_spread(check, fit);
}

} // namespace

void check_mpas_density(const MpasCheck& check) {
  check_density(check);
  if (check.closed)
    check_nominal_spacing(check);
  check_spacing(check);
}

} // namespace calotte::io_detail
