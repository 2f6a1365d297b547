// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "voronoi/cell_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

// Values that the writer computes by the same functions. MpasMeshConverter has known faults here:
// older versions wrote cellQuality as gridSpacing, and one angle of its triangles comes from a
// wrong formula.

namespace calotte::io_detail {
namespace {

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

/// A fault of MpasMeshConverter, and whether a value does not follow it.
struct Fault {
  std::string text = {};
  std::function<bool(std::int64_t row, double stored)> is_unlike = {};
};

Fault fault_of(const MpasCheck& check, const std::string& variable) {
  const auto angles = [&check](std::int64_t row) { return angles_of_converter(check, row); };
  if (variable == mpas::grid_spacing)
    return {"MpasMeshConverter wrote cellQuality here", [&check](std::int64_t i, double stored) {
              return !(std::abs(stored - quality_at(check.voronoi, i)) <= check.tolerance);
            }};
  if (variable == mpas::triangle_angle_quality)
    return {"MpasMeshConverter has a wrong formula for one of the angles",
            [angles](std::int64_t row, double stored) {
              const auto of = angles(row);
              const auto [least, greatest] = std::minmax_element(of.begin(), of.end());
              return !(std::abs(stored - *least / *greatest) <= 1e-5);
            }};
  if (variable == mpas::obtuse_triangle)
    return {"MpasMeshConverter has a wrong formula for one of the angles",
            [angles](std::int64_t row, double stored) {
              const auto of = angles(row);
              const bool obtuse = *std::max_element(of.begin(), of.end()) > std::acos(0.0);
              return stored != (obtuse ? 1 : 0);
            }};
  return {};
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

/// The place in the tessellation of a row, -1 where the file may have any number.
std::int32_t place_of(const MpasCheck& check, const MpasVariable& variable, std::int64_t row) {
  if (variable.rows == MpasDimension::cells)
    return static_cast<std::int32_t>(row);
  const bool edge = variable.rows == MpasDimension::edges;
  const std::int32_t place = (edge ? check.numbering.edge : check.numbering.vertex)[row];
  if (variable.name == mpas::boundary_vertex) // known where cells are missing
    return place;
  return place >= 0 && (edge ? check.has_weights(place) : check.has_triangle(place)) ? place : -1;
}

void check_values(const MpasCheck& check, const MpasVariable& variable) {
  const Fault fault = fault_of(check, variable.name);
  const int power = radius_power(variable);
  const double factor = radius_factor(variable, check.radius);
  const bool of_angle = variable.name == mpas::obtuse_triangle,
             is_boundary = variable.name == mpas::boundary_vertex;
  const Differences differences = check.deviations.visit_rows<double>(
      variable.name, [&](std::int64_t row, const double* stored, Differences& out) {
        if (is_boundary && check.closed) { // whatever its vertices are
          if (*stored != 0)
            out.note(row, *stored, 0, 1);
          return;
        }
        const std::int32_t place = place_of(check, variable, row);
        if (place < 0 && !std::isfinite(*stored))
          out.note(row, *stored, 0, std::numeric_limits<double>::infinity());
        if (place < 0)
          return;
        if (of_angle && (*stored == 0 || *stored == 1) && is_right(check.voronoi, place))
          return;
        double derived = 0;
        variable.values(check.voronoi, place, place + 1, &derived);
        derived *= factor;
        if (variable.integer && *stored != derived)
          out.note(row, *stored, derived, 1);
        if (!variable.integer)
          out.compare(row, *stored, derived, power != 0 ? std::abs(derived) : 1, check.tolerance);
        if (fault.is_unlike && fault.is_unlike(row, *stored))
          ++out.unlike_fault;
      });
  check.add(variable.name, differences, fault.text);
}

} // namespace

void check_mpas_values(const MpasCheck& check) {
  for (const MpasVariable& variable : mpas_variables()) {
    const bool has_rows =
        variable.rows == MpasDimension::cells ||
        (variable.rows == MpasDimension::edges ? check.has_edges() : check.has_vertices());
    const bool is_known = check.closed && variable.name == mpas::boundary_vertex;
    if (variable.values != nullptr && (has_rows || is_known) && check.has(variable.name))
      check_values(check, variable);
  }
}

} // namespace calotte::io_detail
