// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/points.h"
#include "base/spherical_angles.h"
#include "io/mpas/mpas.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace calotte::io_detail {
namespace {

// ---- Places

/// Cells, edges or vertices.
struct Kind {
  const MpasKind& names;
  const Points3& points;                     ///< of the tessellation
  const Array<std::int32_t>* numbers;        ///< by row of the file: the column; null for the same
  std::string rule;                          ///< what the places are
  std::function<double(std::int64_t)> reach; ///< of a column: the scale of its place's error

  std::int32_t column_of(std::int64_t row) const {
    return numbers ? (*numbers)[row] : static_cast<std::int32_t>(row);
  }
};

/// Visits the rows of the file that are known in the tessellation.
/// \param compare(row, column, stored, differences)
template <class T, class Compare>
void check_kind(const MpasCheck& check, const Kind& kind, const std::string& variable,
                const std::string& rule, const Compare& compare) {
  if (!check.has(variable))
    return;
  check.deviations.add(
      variable,
      check.deviations.visit_rows<T>(variable,
                                     [&](std::int64_t row, const T* stored, Differences& out) {
                                       const std::int32_t i = kind.column_of(row);
                                       if (i >= 0)
                                         compare(row, i, *stored, out);
                                     }),
      rule);
}

/// x, y and z.
void check_coordinates(const MpasCheck& check, const Kind& kind) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = kind.names.axis(axis);
    const double period = axis < 2 ? check.voronoi.surface.period()[axis] : 0.0;
    const double rounding = check.deviations.file().has_variable(name) ? check.rounding(name) : 0.0;
    check_kind<double>(check, kind, name, kind.rule,
                       [&](std::int64_t row, std::int32_t i, double stored, Differences& out) {
                         double derived = check.radius * kind.points(axis, i);
                         if (period > 0) // the nearest copy
                           derived += period * std::round((stored - derived) / period);
                         const double reach = check.radius * kind.reach(i);
                         out.compare(row, stored, derived, reach,
                                     rounding_of_others + rounding * check.radius / reach);
                       });
  }
}

/// Near the poles a latitude that is the arc sine of z has half of a double's digits.
constexpr double arc_sine_rounding = 2e-8;

void check_angles(const MpasCheck& check, const Kind& kind) {
  const bool on_sphere = check.voronoi.surface.is_sphere();
  const auto tolerance = [&](const std::string& name) {
    return rounding_of_others * check.width + arc_sine_rounding +
           (check.deviations.file().has_variable(name) ? 2 * std::numbers::pi * check.rounding(name)
                                                       : 0);
  };
  const std::string latitude = kind.names.latitude(), longitude = kind.names.longitude();
  const double of_latitude = tolerance(latitude), of_longitude = tolerance(longitude);
  check_kind<double>(
      check, kind, latitude, on_sphere ? "the latitude of x, y and z" : "0, as in a plane",
      [&](std::int64_t row, std::int32_t i, double stored, Differences& out) {
        const Vec3& p = column(kind.points, i);
        out.compare(row, stored, on_sphere ? latitude_of(p.x, p.y, p.z) : 0, 1, of_latitude);
      });
  check_kind<double>(
      check, kind, longitude, on_sphere ? "the longitude of x, y and z" : "0, as in a plane",
      [&](std::int64_t row, std::int32_t i, double stored, Differences& out) {
        const Vec3& p = column(kind.points, i);
        const double east = on_sphere ? longitude_of(p.x, p.y) : 0;
        const double derived =
            east + 2 * std::numbers::pi * std::round((stored - east) / (2 * std::numbers::pi));
        out.compare(row, stored, derived, 1,
                    of_longitude / std::hypot(p.x, p.y)); // infinite at a pole
      });
}

void check_numbers(const MpasCheck& check, const Kind& kind) {
  check_kind<std::int32_t>(
      check, kind, kind.names.numbers(), mpas_variable(kind.names.numbers()).rule,
      [](std::int64_t row, std::int32_t, std::int32_t stored, Differences& out) {
        out.compare(row, stored, static_cast<std::int32_t>(row + 1));
      });
}

void check_places(const MpasCheck& check, const Kind& kind) {
  check_angles(check, kind);
  check_coordinates(check, kind);
  check_numbers(check, kind);
}

/// The distance of a vertex from its cells.
double circumradius(const Voronoi& voronoi, std::int64_t v) {
  const std::int32_t cell = voronoi.cells_on_vertex.col(v).maxCoeff(); // one that is there
  const Vec3 apart = column(voronoi.vertices, v) - column(voronoi.cells, cell);
  if (voronoi.surface.is_sphere())
    return norm(apart);
  const auto nearest = [](double way, double period) {
    return period > 0 ? std::remainder(way, period) : way;
  };
  return std::hypot(nearest(apart.x, voronoi.surface.period()[0]),
                    nearest(apart.y, voronoi.surface.period()[1]));
}

// ---- Lengths, areas and angles

/// Visits the edges, or vertices, of a variable.
template <class Compare>
void check_rows(const MpasCheck& check, const Array<std::int32_t>& numbers,
                const std::string& variable, const Compare& compare) {
  if (!check.has(variable))
    return;
  check.add(variable, check.deviations.visit_rows<double>(
                          variable, [&](std::int64_t row, const double* stored, Differences& out) {
                            if (numbers[row] >= 0)
                              compare(row, numbers[row], stored, out);
                          }));
}

void check_lengths(const MpasCheck& check) {
  const Voronoi& voronoi = check.voronoi;
  const auto compare = [&](const std::string& name, const DoubleVector& lengths) {
    check_rows(check, check.numbering.edge, name,
               [&](std::int64_t row, std::int32_t e, const double* stored, Differences& out) {
                 out.compare(row, *stored, check.radius * lengths[e], check.radius * voronoi.dc[e],
                             check.tolerance);
               });
  };
  compare(mpas::dc_edge, voronoi.dc);
  compare(mpas::dv_edge, voronoi.dv);
}

/// The formula of MpasMeshConverter, the rise of the edge over its length, is an approximation.
double angle_of_converter(const Voronoi& voronoi, std::int32_t e, bool reversed, double exact) {
  const Vec3& right = column(voronoi.vertices, voronoi.vertices_on_edge(0, e));
  const Vec3& left = column(voronoi.vertices, voronoi.vertices_on_edge(1, e));
  const double rise = latitude_of(left.x, left.y, left.z) - latitude_of(right.x, right.y, right.z);
  const double cosine = std::clamp((reversed ? -rise : rise) / voronoi.dv[e], -1.0, 1.0);
  return std::copysign(std::acos(cosine), std::remainder(exact, 2 * std::numbers::pi));
}

/// Whether a stored angle follows that formula, whose cosine has single precision.
bool is_angle_of_converter(const Voronoi& voronoi, std::int32_t e, bool reversed, double stored,
                           double exact) {
  const double formula = angle_of_converter(voronoi, e, reversed, exact);
  return voronoi.surface.is_sphere() && std::abs(std::cos(stored) - std::cos(formula)) <= 1e-5 &&
         std::sin(stored) * std::sin(formula) >= -1e-4;
}

void check_edge_angles(const MpasCheck& check) {
  const Voronoi& voronoi = check.voronoi;
  if (!check.has(mpas::angle_edge))
    return;
  const double digits = 0x1p-50 + check.rounding(mpas::angle_edge);
  const Differences differences = check.deviations.visit_rows<double>(
      mpas::angle_edge, [&](std::int64_t row, const double* stored, Differences& out) {
        const std::int32_t e = check.numbering.edge[row];
        if (e < 0)
          return;
        const bool reversed = check.numbering.reversed[e];
        const double exact = voronoi.angle[e] + (reversed ? std::numbers::pi : 0);
        const double derived =
            exact + 2 * std::numbers::pi * std::round((*stored - exact) / (2 * std::numbers::pi));
        const double across = std::hypot(voronoi.edges(0, e), voronoi.edges(1, e));
        // East turns by the edge's place, infinitely fast at a pole; the normal by that of its
        // cells.
        const double free =
            digits * ((voronoi.surface.is_sphere() ? 1 / across : 0) + 1 / voronoi.dc[e]);
        out.compare(row, *stored, derived, 1, rounding_of_others + free);
        if (!is_angle_of_converter(voronoi, e, reversed, *stored, exact))
          ++out.unlike_fault;
      });
  check.add(mpas::angle_edge, differences,
            "MpasMeshConverter takes the rise of each edge over its length");
}

/// By row: the area of a triangle of which cells are missing, if its kites have those of the mesh
/// that the file was cut from; empty for a closed mesh. Other programs give missing cells none.
std::vector<double> sums_of_kites(const MpasCheck& check) {
  const std::int64_t vertices = check.voronoi.vertex_area.size();
  if (check.closed || !check.has(mpas::kite_areas_on_vertex))
    return {};
  const std::vector<double> kites =
      check.deviations.file().doubles(mpas::kite_areas_on_vertex, {-1, 3});
  std::vector<double> sums(static_cast<std::size_t>(vertices));
  for (std::size_t v = 0; v < sums.size(); ++v)
    sums[v] = kites[3 * v] + kites[3 * v + 1] + kites[3 * v + 2];
  return sums;
}

void check_triangles(const MpasCheck& check, const std::function<double(std::int32_t)>& scale) {
  const std::vector<double> sums = sums_of_kites(check);
  check_rows(check, check.numbering.vertex, mpas::area_triangle,
             [&](std::int64_t row, std::int32_t t, const double* stored, Differences& out) {
               double area = check.radius * check.radius * check.voronoi.vertex_area[t];
               if (!sums.empty() && !check.has_triangle(t) &&
                   std::abs(*stored - sums[static_cast<std::size_t>(row)]) <=
                       std::abs(*stored - area))
                 area = sums[static_cast<std::size_t>(row)];
               out.compare(row, *stored, area, scale(t), check.tolerance);
             });
}

void check_triangle_areas(const MpasCheck& check) {
  const Voronoi& voronoi = check.voronoi;
  const double factor = check.radius * check.radius;
  const auto scale = [&](std::int32_t t) { return factor * voronoi.kites.col(t).cwiseAbs().sum(); };
  check_triangles(check, scale);
  check_rows(check, check.numbering.vertex, mpas::kite_areas_on_vertex,
             [&](std::int64_t row, std::int32_t t, const double* stored, Differences& out) {
               const int start = check.numbering.vertex_start[row];
               for (int j = 0; start >= 0 && j < 3; ++j)
                 if (const int k = (start + j) % 3;
                     voronoi.cells_on_vertex(k, t) >= 0 || !std::isfinite(stored[j]))
                   out.compare(3 * row + j, stored[j], factor * voronoi.kites(k, t), scale(t),
                               check.tolerance);
             });
}

} // namespace

void check_mpas_places(const MpasCheck& check) {
  const Voronoi& voronoi = check.voronoi;
  const bool on_sphere = voronoi.surface.is_sphere();
  check_places(check, {mpas_cell, voronoi.cells, nullptr,
                       on_sphere ? "on the sphere of sphere_radius" : "in the plane",
                       [](std::int64_t) { return 1.0; }});
  if (check.has_edges())
    check_places(check, {mpas_edge, voronoi.edges, &check.numbering.edge,
                         "the middle between the cells of each edge",
                         [&](std::int64_t e) { return voronoi.dc[e]; }});
  if (check.has_vertices())
    check_places(check, {mpas_vertex, voronoi.vertices, &check.numbering.vertex,
                         "the circumcentre of the cells around each vertex",
                         [&](std::int64_t v) { return circumradius(voronoi, v); }});
}

void check_mpas_measures(const MpasCheck& check) {
  if (check.has_edges()) {
    check_lengths(check);
    check_edge_angles(check);
  }
  if (check.has_vertices())
    check_triangle_areas(check);
}

} // namespace calotte::io_detail
