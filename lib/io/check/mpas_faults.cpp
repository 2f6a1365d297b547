// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/points.h"
#include "base/spherical_angles.h"
#include "voronoi/cell_fields.h"

#include <algorithm>
#include <array>
#include <cmath>

// Known faults of MpasMeshConverter: older versions wrote cellQuality as gridSpacing, one angle of
// its triangles comes from a wrong formula, and the angles of its edges from an approximate one.

namespace calotte::io_detail {
namespace {

/// The angles of a triangle as MpasMeshConverter computes them from its sides a, b and c in their
/// order in edgesOnVertex: the second formula has b c where b b belongs.
std::array<double, 3> angles_of_converter(const Voronoi& voronoi, std::int64_t row) {
  const auto side = [&](int j) { return voronoi.dc[voronoi.edges_on_vertex(j, row)]; };
  const double a = side(0), b = side(1), c = side(2);
  const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
  return {angle((b * b + c * c - a * a) / (2 * b * c)),
          angle((a * a + c * c - b * c) / (2 * a * c)),
          angle((a * a + b * b - c * c) / (2 * a * b))};
}

/// Whether the angle of an edge is the rise of the edge over its length, whose cosine has single
/// precision.
bool is_rise(const MpasCheck& check, std::int64_t e, double stored) {
  const Voronoi& voronoi = check.voronoi;
  const auto latitude = [&](int k) {
    const Vec3& p = column(voronoi.vertices, voronoi.vertices_on_edge(k, e));
    return latitude_of(p.x, p.y, p.z);
  };
  const double sign = check.is_flipped(e) ? -1 : 1, rise = sign * (latitude(1) - latitude(0));
  const double formula = std::copysign(std::acos(std::clamp(rise / voronoi.dv[e], -1.0, 1.0)),
                                       sign * std::sin(voronoi.angle[e]));
  return voronoi.surface.is_sphere() && std::abs(std::cos(stored) - std::cos(formula)) <= 1e-5 &&
         std::sin(stored) * std::sin(formula) >= -1e-4;
}

} // namespace

Fault mpas_fault(const MpasCheck& check, const std::string& variable) {
  if (variable == mpas::angle_edge)
    return {"MpasMeshConverter takes the rise of each edge over its length",
            [&](std::int64_t e, double stored) { return is_rise(check, e, stored); }};
  if (variable == mpas::grid_spacing)
    return {"MpasMeshConverter wrote cellQuality here", [&](std::int64_t i, double stored) {
              return std::abs(stored - quality_at(check.voronoi, i)) <= check.tolerance;
            }};
  const char* const wrong = "MpasMeshConverter has a wrong formula for one of the angles";
  if (variable == mpas::triangle_angle_quality)
    return {wrong, [&](std::int64_t v, double stored) {
              if (!check.has_triangle(v))
                return true;
              const auto angles = angles_of_converter(check.voronoi, v);
              const auto [least, greatest] = std::minmax_element(angles.begin(), angles.end());
              return std::abs(stored - *least / *greatest) <= 1e-5;
            }};
  if (variable == mpas::obtuse_triangle)
    return {wrong, [&](std::int64_t v, double stored) {
              if (!check.has_triangle(v) || check.is_right(v))
                return true;
              const auto angles = angles_of_converter(check.voronoi, v);
              const bool obtuse = *std::max_element(angles.begin(), angles.end()) > std::acos(0.0);
              return stored == (obtuse ? 1 : 0);
            }};
  return {};
}

} // namespace calotte::io_detail
