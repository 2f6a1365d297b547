// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

// Tolerances for the values of a file, relative to those of the writer.

namespace calotte::io_detail {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// A value that differs from the derived one.
struct Entry {
  std::int64_t row, column, at; ///< at: its index in the variable
  double stored, derived;
  std::int32_t edge; ///< of a weight; -1 in the padding
};

/// The tolerance of a value, as a multiple of a scale. With a period, values that differ by whole
/// periods are equal. Without tolerance, the value must be the derived one. With an infinite one,
/// any number is accepted.
struct Closeness {
  double scale = 1, tolerance = 0, period = 0;
};
constexpr Closeness any_number{1, std::numeric_limits<double>::infinity()};

void compare(Entry entry, const Closeness& within, Differences& out) {
  if (within.tolerance == 0)
    return out.note(entry.at, entry.stored, entry.derived, 1);
  if (!std::isfinite(entry.stored))
    return out.note(entry.at, entry.stored, entry.derived, std::numeric_limits<double>::infinity());
  if (within.period > 0) {
    const double turns = std::round((entry.stored - entry.derived) / within.period);
    if (std::abs(turns) <= 2) // a larger difference is an error
      entry.derived += within.period * turns;
  }
  out.compare(entry.at, entry.stored, entry.derived, within.scale, within.tolerance);
}

/// \param derived values of the rows.
/// \param closeness_of(entry) may replace the derived value by an alternative that is also correct.
/// \param all whether to compare equal values, too: the derived one may be wrong until it is
///        replaced.
template <class T, class ClosenessOf>
void compare(MpasRows rows, const T* derived, const ClosenessOf& closeness_of, bool all,
             Differences& out) {
  for (std::int64_t row = rows.begin; row < rows.end; ++row) {
    for (std::int64_t k = 0; k < std::max(rows.width, rows.stored_width); ++k) {
      const double stored = k < rows.stored_width ? rows.stored[k] : 0,
                   wanted = k < rows.width ? static_cast<double>(derived[k]) : 0;
      if (stored == wanted && !all)
        continue;
      Entry entry{row,    k,      row * rows.stored_width + std::min(k, rows.stored_width - 1),
                  stored, wanted, rows.edges != nullptr && k < rows.width ? rows.edges[k] - 1 : -1};
      const Closeness within = closeness_of(entry);
      if (entry.stored != entry.derived)
        compare(entry, within, out);
    }
    rows.stored += rows.stored_width;
    derived += rows.width;
    rows.edges += rows.edges != nullptr ? rows.width : 0;
  }
}

template <class ClosenessOf> MpasRule rule(const ClosenessOf& closeness_of, bool all = false) {
  return [closeness_of, all](const MpasRows& rows, Differences& out) {
    if (rows.ints != nullptr)
      compare(rows, rows.ints, closeness_of, all, out);
    else
      compare(rows, rows.doubles, closeness_of, all, out);
  };
}

// ---- Coordinates

/// The distance of a vertex from its cells.
double circumradius(const Voronoi& voronoi, std::int64_t v) {
  const std::int32_t cell = voronoi.cells_on_vertex.col(v).maxCoeff(); // a cell that is not missing
  const Vec3 apart = column(voronoi.vertices, v) - column(voronoi.cells, cell);
  if (voronoi.surface.is_sphere())
    return norm(apart);
  const auto nearest = [](double way, double period) {
    return period > 0 ? std::remainder(way, period) : way;
  };
  return norm(Vec3{nearest(apart.x, voronoi.surface.period()[0]),
                   nearest(apart.y, voronoi.surface.period()[1]), 0});
}

/// \param reach(row) scale of the error of its coordinates.
template <class Reach>
void add_coordinate_rules(const MpasCheck& check, const MpasKind& kind, const Points3& points,
                          const Reach& reach, std::map<std::string, MpasRule>& rules) {
  // Near the poles, a latitude that is computed as the arc sine of z has half the digits of a
  // double.
  constexpr double arc_sine_rounding = 2e-8;
  const double exact = rounding_of_others * check.width + arc_sine_rounding,
               of_latitude = exact + turn * check.rounding(kind.latitude()),
               of_longitude = exact + turn * check.rounding(kind.longitude());
  rules[kind.latitude()] = rule([=](const Entry&) { return Closeness{1, of_latitude}; });
  rules[kind.longitude()] = rule([=, &points](const Entry& entry) {
    const double across = norm(Vec3{points(0, entry.row), points(1, entry.row), 0});
    return Closeness{1, of_longitude / across, turn}; // any longitude at a pole
  });
  for (int k = 0; k < 3; ++k) {
    const double period = k < 2 ? check.voronoi.surface.period()[k] : 0.0,
                 rounding = check.rounding(kind.axis(k));
    rules[kind.axis(k)] = rule([=, &check](const Entry& entry) {
      const double scale = reach(entry.row);
      return Closeness{check.radius * scale, rounding_of_others + rounding / scale, period};
    });
  }
}

// ---- Edges

/// The angle depends on the direction of east at the edge, which is singular at a pole, and on the
/// normal, which depends on its cells.
MpasRule angle_rule(const MpasCheck& check) {
  const double digits = 0x1p-50 + 2 * check.rounding(mpas::angle_edge); // of both cells
  return rule(
      [&check, digits](Entry& entry) {
        const Voronoi& voronoi = check.voronoi;
        entry.derived += check.is_flipped(entry.row) ? std::numbers::pi : 0;
        const double across =
                         norm(Vec3{voronoi.edges(0, entry.row), voronoi.edges(1, entry.row), 0}),
                     of_east = voronoi.surface.is_sphere() ? 1 / across : 0,
                     free = digits * (of_east + 1 / voronoi.dc[entry.row]);
        return Closeness{1, rounding_of_others + free, turn};
      },
      check.flipped.size() > 0);
}

Closeness of_weight(const MpasCheck& check, Entry& entry) {
  if (!check.has_weights(entry.row))
    return any_number;
  if (entry.edge < 0)
    return {};
  if (check.is_flipped(entry.row) != check.is_flipped(entry.edge))
    entry.derived = -entry.derived;
  const Voronoi& voronoi = check.voronoi;
  return {(voronoi.dv[entry.edge] + voronoi.dc[entry.edge]) / voronoi.dc[entry.row],
          check.tolerance};
}

// ---- Triangles

Closeness of_triangle(const MpasCheck& check, std::int64_t v) {
  return {check.radius * check.radius * check.voronoi.kites.col(v).cwiseAbs().sum(),
          check.tolerance};
}

/// If cells are missing, the kites in a file may be those of the mesh that it was cut from, and the
/// area of a triangle is their sum. Other programs give missing cells no kites.
MpasRule triangle_rule(const MpasCheck& check) {
  const NetcdfReader& file = check.deviations.file();
  const std::vector<std::int64_t> shape{check.voronoi.cells_on_vertex.cols(), 3};
  std::vector<double> kites;
  if (!check.closed && file.has_variable(mpas::kite_areas_on_vertex) &&
      file.shape_of(mpas::kite_areas_on_vertex) == shape)
    kites = file.doubles(mpas::kite_areas_on_vertex, shape);
  return rule([&check, kites](Entry& entry) {
    if (!kites.empty() && !check.has_triangle(entry.row)) {
      const double* const of_row = kites.data() + 3 * entry.row;
      const double sum = of_row[0] + of_row[1] + of_row[2];
      if (std::abs(entry.stored - sum) <= std::abs(entry.stored - entry.derived))
        entry.derived = sum;
    }
    return of_triangle(check, entry.row);
  });
}

// ---- Values that the table has a function for

Closeness of_value(const MpasCheck& check, const MpasVariable& variable, const Entry& entry) {
  if (variable.name != mpas::boundary_vertex && // also known if cells are missing
      ((variable.rows == MpasDimension::edges && !check.has_weights(entry.row)) ||
       (variable.rows == MpasDimension::vertices && !check.has_triangle(entry.row))))
    return any_number;
  if (variable.name == mpas::obtuse_triangle && (entry.stored == 0 || entry.stored == 1) &&
      check.is_right(entry.row))
    return any_number;
  if (variable.integer)
    return {};
  return {radius_power(variable) != 0 ? std::abs(entry.derived) : 1, check.tolerance};
}

} // namespace

bool MpasCheck::is_right(std::int64_t v) const {
  std::array<double, 3> sides{};
  for (int j = 0; j < 3; ++j)
    sides[static_cast<std::size_t>(j)] = voronoi.dc[voronoi.edges_on_vertex(j, v)];
  std::sort(sides.begin(), sides.end());
  const auto [a, b, c] = sides;
  return std::abs(a * a + b * b - c * c) <= rounding_of_others * c * c;
}

std::map<std::string, MpasRule> mpas_rules(const MpasCheck& check) {
  const Voronoi& voronoi = check.voronoi;
  std::map<std::string, MpasRule> rules;
  add_coordinate_rules(
      check, mpas_cell, voronoi.cells, [](std::int64_t) { return 1.0; }, rules);
  add_coordinate_rules(
      check, mpas_edge, voronoi.edges, [&](std::int64_t e) { return voronoi.dc[e]; }, rules);
  add_coordinate_rules(
      check, mpas_vertex, voronoi.vertices,
      [&](std::int64_t v) { return circumradius(voronoi, v); }, rules);
  for (const MpasVariable& variable : mpas_variables())
    if (variable.values != nullptr)
      rules[variable.name] =
          rule([&](const Entry& entry) { return of_value(check, variable, entry); });
    else
      rules.try_emplace(variable.name, rule([](const Entry&) { return Closeness{}; }));
  rules[mpas::dc_edge] = rules[mpas::dv_edge] = rule([&](const Entry& entry) {
    return Closeness{check.radius * voronoi.dc[entry.row], check.tolerance};
  });
  rules[mpas::angle_edge] = angle_rule(check);
  rules[mpas::edges_on_edge] = rule(
      [&](const Entry& entry) { return check.has_weights(entry.row) ? Closeness{} : any_number; });
  rules[mpas::weights_on_edge] =
      rule([&](Entry& entry) { return of_weight(check, entry); }, check.flipped.size() > 0);
  rules[mpas::area_triangle] = triangle_rule(check);
  rules[mpas::kite_areas_on_vertex] = rule([&](const Entry& entry) {
    return voronoi.cells_on_vertex(entry.column, entry.row) < 0 ? any_number
                                                                : of_triangle(check, entry.row);
  });
  return rules;
}

} // namespace calotte::io_detail
