// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/points.h"
#include "io/cells/triangle_quality.h"
#include "voronoi/cell_fields.h"
#include "voronoi/spacing_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

// Density and quality. MpasMeshConverter has known faults here: older versions wrote cellQuality
// as gridSpacing, and one angle of its triangles comes from a wrong formula.

namespace calotte::io_detail {
namespace {

// ---- Density

/// An open mesh may have lost the cells of the greatest density.
void check_density(const MpasCheck& check) {
  const std::int64_t cells = check.voronoi.cells.cols();
  if (!check.deviations.has("meshDensity", {cells}))
    return;
  const Differences outside = check.deviations.visit_rows<double>(
      "meshDensity", [](std::int64_t i, const double* stored, Differences& out) {
        if (!(*stored >= 0 && *stored <= 1 + rounding_of_others))
          out.note(i, *stored, 1, std::isfinite(*stored) ? std::abs(*stored - 1) : 1);
      });
  check.deviations.add("meshDensity", outside, "numbers from 0 to 1");
  const double greatest = check.density.size() > 0 ? check.density.maxCoeff() : 1;
  if (check.closed && outside.count == 0 && std::abs(greatest - 1) > rounding_of_others)
    check.deviations.add("meshDensity", "meshDensity: its maximum is " + std::to_string(greatest) +
                                            " instead of 1");
}

double nominal_length(const MpasCheck& check) {
  return check.radius * nominal_spacing(check.voronoi, check.density);
}

/// A sum over all cells, to which a wrong density of a single one contributes little.
void check_nominal_spacing(const MpasCheck& check) {
  if (!check.deviations.has("nominalMinDc", {}))
    return;
  const NetcdfReader& file = check.deviations.file();
  const bool rounded = file.is_float("nominalMinDc") || file.is_float("xCell") ||
                       (file.has_variable("meshDensity") && file.is_float("meshDensity"));
  const double tolerance = rounded ? rounding_of_others : 1e-10;
  const double derived = nominal_length(check);
  check.deviations.add("nominalMinDc",
                       check.deviations.visit_rows<double>(
                           "nominalMinDc",
                           [&](std::int64_t, const double* stored, Differences& out) {
                             out.compare(0, *stored, derived, derived, tolerance);
                           }),
                       "the nominal distance of cells where meshDensity is 1, which follows from "
                       "meshDensity and the areas");
}

/// The number in the file.
double stored_nominal(const MpasCheck& check) {
  double stored = 0;
  check.deviations.file().rows("nominalMinDc", 0, 1, &stored);
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
  check.deviations.add("nominalMinDc",
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
  check.deviations.add("meshDensity",
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
  const bool has_nominal = check.deviations.file().has_variable("nominalMinDc");
  const bool compares = has_nominal && !check.closed && check.deviations.has("nominalMinDc", {});
  const double derived = nominal_length(check),
               nominal = compares ? stored_nominal(check) : derived;
  if ((!has_density && !has_nominal) || !(derived > 0))
    return;
  if (!(nominal > 0 && std::isfinite(nominal)))
    return check.deviations.add("nominalMinDc", "nominalMinDc: " + shown(nominal) +
                                                    " is stored, which is no length; " +
                                                    shown(derived) + " follows from the cells");
  const SpacingFit fit = spacing_fit(check.voronoi, check.density, nominal / check.radius);
  if (fit.cells == 0)
    return;
  if (compares)
    check_median(check, nominal, fit);
  check_spread(check, fit);
}

// ---- Cells

void check_cell_quality(const MpasCheck& check) {
  const std::int64_t cells = check.voronoi.cells.cols();
  if (check.deviations.has("cellQuality", {cells}))
    check.deviations.add("cellQuality",
                         check.deviations.visit_rows<double>(
                             "cellQuality",
                             [&](std::int64_t i, const double* stored, Differences& out) {
                               out.compare(i, *stored, quality_at(check.voronoi, i), 1,
                                           check.tolerance);
                             }),
                         "the shortest over the longest edge of each cell");
  if (!check.deviations.has("gridSpacing", {cells}))
    return;
  const Differences differences = check.deviations.visit_rows<double>(
      "gridSpacing", [&](std::int64_t i, const double* stored, Differences& out) {
        const double derived = check.radius * spacing_at(check.voronoi, i);
        out.compare(i, *stored, derived, derived, check.tolerance);
        if (!(std::abs(*stored - quality_at(check.voronoi, i)) <= check.tolerance))
          ++out.unlike_fault;
      });
  check.deviations.add("gridSpacing", differences,
                       "the mean distance of each cell from its neighbours",
                       "MpasMeshConverter wrote cellQuality here");
}

// ---- Triangles

/// The angles of a triangle as MpasMeshConverter computes them from its sides in their order in
/// edgesOnVertex: the second formula has b c where b b belongs.
std::array<double, 3> angles_of_converter(double a, double b, double c) {
  const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
  return {angle((b * b + c * c - a * a) / (2 * b * c)),
          angle((a * a + c * c - b * c) / (2 * a * c)),
          angle((a * a + b * b - c * c) / (2 * a * b))};
}

/// Its angles from the sides on, in the order of the file.
std::array<double, 3> angles_of_converter(const MpasCheck& check, std::int64_t row) {
  const Voronoi& voronoi = check.voronoi;
  const int start = std::max<int>(check.numbering.vertex_start[row], 0);
  const auto side = [&](int j) {
    return voronoi.dc[voronoi.edges_on_vertex((start + j) % 3, check.numbering.vertex[row])];
  };
  return angles_of_converter(side(0), side(1), side(2));
}

/// The vertex of the tessellation, -1 where the file's has no triangle: any number may stand there.
std::int32_t triangle_of(const MpasCheck& check, std::int64_t row, double stored,
                         Differences& differences) {
  const std::int32_t t = check.numbering.vertex[row];
  if (t >= 0 && check.has_triangle(t))
    return t;
  if (!std::isfinite(stored))
    differences.note(row, stored, 0, std::numeric_limits<double>::infinity());
  return -1;
}

void check_side_quality(const MpasCheck& check) {
  check.deviations.add(
      "triangleQuality",
      check.deviations.visit_rows<double>(
          "triangleQuality",
          [&](std::int64_t row, const double* stored, Differences& out) {
            if (const std::int32_t t = triangle_of(check, row, *stored, out); t >= 0)
              out.compare(row, *stored, side_quality(check.voronoi, t), 1, check.tolerance);
          }),
      "the shortest over the longest side of each triangle");
}

void check_angle_quality(const MpasCheck& check) {
  const Differences differences = check.deviations.visit_rows<double>(
      "triangleAngleQuality", [&](std::int64_t row, const double* stored, Differences& out) {
        const std::int32_t t = triangle_of(check, row, *stored, out);
        if (t < 0)
          return;
        double derived = 0;
        fill_angle_qualities(check.voronoi, t, t + 1, &derived);
        out.compare(row, *stored, derived, 1, check.tolerance);
        const auto angles = angles_of_converter(check, row);
        const auto [least, greatest] = std::minmax_element(angles.begin(), angles.end());
        if (!(std::abs(*stored - *least / *greatest) <= 1e-5))
          ++out.unlike_fault;
      });
  check.deviations.add("triangleAngleQuality", differences,
                       "the smallest over the largest angle of each triangle",
                       "MpasMeshConverter has a wrong formula for one of the angles");
}

/// Whether an angle is a right one but for the precision of others.
bool is_right(const Voronoi& voronoi, std::int32_t t) {
  std::array<double, 3> sides{};
  for (int j = 0; j < 3; ++j)
    sides[static_cast<std::size_t>(j)] = voronoi.dc[voronoi.edges_on_vertex(j, t)];
  std::sort(sides.begin(), sides.end());
  const auto [a, b, c] = sides;
  return std::abs(a * a + b * b - c * c) <= rounding_of_others * c * c;
}

void check_obtuse(const MpasCheck& check) {
  const Differences differences = check.deviations.visit_rows<std::int32_t>(
      "obtuseTriangle", [&](std::int64_t row, const std::int32_t* stored, Differences& out) {
        const std::int32_t t = triangle_of(check, row, *stored, out);
        if (t < 0)
          return;
        const bool flag = *stored == 0 || *stored == 1;
        const std::int32_t derived = is_obtuse(check.voronoi, t) ? 1 : 0;
        if (flag && is_right(check.voronoi, t))
          return;
        out.compare(row, *stored, derived);
        const auto angles = angles_of_converter(check, row);
        const bool of_converter = *std::max_element(angles.begin(), angles.end()) > std::acos(0.0);
        if (!flag || of_converter != (*stored == 1))
          ++out.unlike_fault;
      });
  check.deviations.add("obtuseTriangle", differences,
                       "1 where the triangle has an obtuse angle, and 0 elsewhere",
                       "MpasMeshConverter has a wrong formula for one of the angles");
}

} // namespace

void check_mpas_quality(const MpasCheck& check) {
  check_density(check);
  if (check.closed)
    check_nominal_spacing(check);
  check_spacing(check);
  check_cell_quality(check);
  if (!check.has_vertices())
    return;
  const std::vector<std::int64_t> shape{check.voronoi.cells_on_vertex.cols()};
  if (check.deviations.has("triangleQuality", shape))
    check_side_quality(check);
  if (check.deviations.has("triangleAngleQuality", shape))
    check_angle_quality(check);
  if (check.deviations.has("obtuseTriangle", shape))
    check_obtuse(check);
}

} // namespace calotte::io_detail
