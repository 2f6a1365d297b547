// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/message.h"
#include "voronoi/spacing_fit.h"

#include <cmath>

namespace calotte::io_detail {
namespace {

/// Checks the maximum of the density. An open mesh may lack the cells of the greatest density.
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
    check.deviations.add(mpas::mesh_density,
                         message("meshDensity: its maximum is {} instead of 1", greatest));
}

/// Compares nominal spacings. They are a sum over all cells, to which a single wrong density
/// contributes little.
void check_nominal_spacing(const MpasCheck& check, double stored, double derived) {
  const NetcdfReader& file = check.deviations.file();
  if (!file.has_variable(mpas::nominal_min_dc))
    return;
  const bool rounded = file.is_float(mpas::nominal_min_dc) || file.is_float("xCell") ||
                       (file.has_variable(mpas::mesh_density) && file.is_float(mpas::mesh_density));
  Differences differences;
  differences.compare(0, stored, derived, derived, rounded ? rounding_of_others : 1e-10);
  check.add(mpas::nominal_min_dc, differences);
}

/// Reports a nominal spacing of an open mesh that is too far from that of its cells. The median of
/// a CVT is within 1% of it, that of independent random sites within 2%.
void check_median(const MpasCheck& check, double stored, double derived, const SpacingFit& fit) {
  constexpr double factor = 1.25;
  if (fit.median > 1 / factor && fit.median < factor)
    return;
  check.deviations.add(
      mpas::nominal_min_dc,
      message("nominalMinDc: {} is stored, but the cells (dcEdge) are {} times as wide as "
              "nominalMinDc meshDensity^(-1/4) (median), so that {} follows; correct it: "
              "MPAS-Atmosphere takes its length of dissipation from it",
              stored, fit.median, derived),
      -1, std::abs(fit.median - 1));
}

/// Reports a density that does not match the cells. After smoothing, 90% of the ratios are within 2
/// to 10% in a CVT, however steep its density, and within 46% for independent random sites.
void check_spread(const MpasCheck& check, const SpacingFit& fit) {
  constexpr double factor = 1.6;
  if (fit.high < factor * fit.low)
    return;
  check.deviations.add(
      mpas::mesh_density,
      message("meshDensity: the cells (dcEdge) are {} to {} times as wide as meshDensity^(-1/4) "
              "says (90% of them), but models scale their diffusion with it; give the density or "
              "the widths of the mesh: calotte convert IN OUT.nc --density or --cell-width",
              fit.low / fit.median, fit.high / fit.median),
      -1, fit.high / fit.low - 1);
}

} // namespace

/// Checks density and nominal spacing. In a closed mesh the spacing follows from the density. In an
/// open one, spacing and density must match the cells.
void check_mpas_density(const MpasCheck& check) {
  check_density(check);
  const bool has_density = check.density.size() == check.voronoi.cells.cols(),
             has_nominal = check.has(mpas::nominal_min_dc);
  if (!has_density && !has_nominal)
    return;
  const double derived = check.radius * nominal_spacing(check.voronoi, check.density);
  double stored = derived;
  if (has_nominal)
    check.deviations.file().rows(mpas::nominal_min_dc, 0, 1, &stored);
  if (check.closed)
    check_nominal_spacing(check, stored, derived);
  const double nominal = check.closed ? derived : stored;
  if (!(derived > 0))
    return;
  if (!(nominal > 0 && std::isfinite(nominal)))
    return check.deviations.add(
        mpas::nominal_min_dc,
        message("nominalMinDc: {} is stored, which is no length; {} follows from the cells",
                nominal, derived));
  const SpacingFit fit = spacing_fit(check.voronoi, check.density, nominal / check.radius);
  if (fit.cells == 0)
    return;
  if (has_nominal && !check.closed)
    check_median(check, nominal, derived, fit);
  check_spread(check, fit);
}

} // namespace calotte::io_detail
