// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "base/require.h"
#include "cvt/laplacian.h"
#include "cvt/levels.h"
#include "cvt/shape.h"
#include "domain/surface.h"
#include "generators/boundary.h"
#include "grids/schedule.h"
#include "grids/start.h"
#include "grids/walls.h"

#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/limited_area.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace calotte {
namespace grids_detail {
namespace {

using base_detail::require;

constexpr double tolerance_well_centred = 1e-4, tolerance_pure = 1e-6;
constexpr int usual_rounds = 1, rounds_beside_fixed = 3;
constexpr int most_bisections = 13, most_rounds = 100;

bool chooses_bisections(CvtStart::Kind kind) {
  return kind == CvtStart::Kind::multilevel || kind == CvtStart::Kind::continuation;
}

bool draws(CvtStart::Kind kind) {
  return kind == CvtStart::Kind::multilevel || kind == CvtStart::Kind::density ||
         kind == CvtStart::Kind::random;
}

/// Refuses values of a recipe that are out of range by themselves.
void require_values(const Recipe& recipe) {
  const bool plane = !recipe.surface.is_sphere();
  if (recipe.cells != 0) // before any work; the least number follows below
    base_detail::require_count(recipe.cells, 1, "the number of cells");
  require(!plane || recipe.surface.is_bounded() || recipe.surface.is_box(),
          "a grid does not fill a plane that has no end; give rings, or two periods");
  const std::optional<int>& bisections = recipe.start.bisections;
  require(!bisections || (*bisections >= 0 && *bisections <= most_bisections),
          "the number of bisections is {}; give 0 to 13", bisections.value_or(0));
  const int rounds = recipe.start.insertion_rounds.value_or(1);
  require(rounds >= 1 && rounds <= most_rounds,
          "the number of rounds of insertion is {}; give 1 to {}", rounds, most_rounds);
  require(recipe.stop.iterations.value_or(1) >= 1, "the number of iterations is {}; give 1 or more",
          recipe.stop.iterations.value_or(1));
  const CvtStop& stop = recipe.stop;
  require(stop.norm != Norm::none,
          "the norm none tests nothing; give a number of iterations instead");
  const double tolerance = stop.tolerance.value_or(1);
  require(tolerance > 0 && std::isfinite(tolerance),
          "the tolerance is {}; give a positive number such as 1e-6", tolerance);
  require(stop.max_iterations >= 0, "the number of iterations is {}; give 0 or more",
          stop.max_iterations);
  require(cvt_detail::is_least_spacing(stop.least_spacing),
          "least_spacing is {}; give a share of the demanded spacing, 0 to 0.95",
          stop.least_spacing);
  require(cvt_detail::is_most_off_midpoint(stop.most_off_midpoint),
          "most_off_midpoint is {}; give a share of an edge's length, above 0 and at most 1",
          stop.most_off_midpoint);
}

/// \throws Error with the index of a fixed generator that is no point of the surface's kind.
void require_fixed_points(const Recipe& recipe) {
  for (Eigen::Index i = 0; i < recipe.fixed.cols(); ++i) {
    if (!recipe.fixed.col(i).allFinite())
      throw Error(
          ErrorCode::not_finite,
          base_detail::message("fixed generator {} is not finite; give finite coordinates", i), i);
    if (recipe.surface.is_sphere() && recipe.fixed.col(i).isZero(0))
      throw Error(ErrorCode::zero_vector,
                  base_detail::message("fixed generator {} is 0 0 0; give a direction", i), i);
  }
}

/// Sets the density, and the widths that give it. Constant widths give a uniform density.
/// \throws Error invalid_argument for an ill-formed density, even if the start does not use it.
void take_resolution(Schedule& schedule) {
  const Recipe& recipe = schedule.recipe;
  if (const auto* const widths = std::get_if<Widths>(&recipe.resolution)) {
    schedule.widths = width_field(widths->on_sphere(recipe.radius_km), recipe.surface);
    schedule.density = density_of(*schedule.widths);
  } else {
    schedule.density = std::get<Density>(recipe.resolution);
  }
  if (recipe.surface.is_sphere())
    evaluate(schedule.density, bisected_icosahedron(0));
  else
    site_density(schedule.density, recipe.surface);
}

/// The run of a limited area covers the rings around it, too.
void take_limited_area(Recipe& recipe) {
  if (!recipe.limited_area)
    return;
  require(recipe.surface.is_sphere() && recipe.surface.is_bounded(),
          "a limited area is a part of the sphere; give the rings that bound it");
  const auto* const widths = std::get_if<Widths>(&recipe.resolution);
  require(widths != nullptr, "a limited area requires cell widths, from which the rings around the "
                             "region follow; give them");
  recipe.surface = with_rings(recipe.surface, widths->on_sphere(recipe.radius_km));
}

/// \param uniform the density.
void choose_start(Recipe& recipe, bool uniform) {
  CvtStart& start = recipe.start;
  const bool plane = !recipe.surface.is_sphere(),
             follows = recipe.surface.is_sphere() && recipe.surface.is_bounded(),
             beside = recipe.fixed.cols() > 0 || !recipe.lines.empty(),
             ends = recipe.boundary == Boundary::generators;
  if (start.kind == CvtStart::Kind::automatic && start.points.cols() > 0)
    start.kind = CvtStart::Kind::points;
  if (start.kind == CvtStart::Kind::automatic) {
    if ((plane || follows || beside || ends || !uniform) && !recipe.stop.iterations &&
        !start.bisections)
      start.kind = CvtStart::Kind::multilevel;
    else
      start.kind =
          plane || follows || beside ? CvtStart::Kind::density : CvtStart::Kind::continuation;
  }
  const bool given = start.kind == CvtStart::Kind::points;
  require(given == (start.points.cols() > 0),
          given ? "the start has no points; give some, or another kind of start"
                : "the start has points and another kind; give one of them");
  require(!given || recipe.cells == 0,
          "the start is given by its points; leave the number of cells out");
  const std::string name = "the start " + std::string(word_of(start.kind));
  const bool anywhere = draws(start.kind) || given;
  require(anywhere || !follows,
          name + " applies to the whole sphere only; give multilevel, density or random");
  require(anywhere || !beside,
          name + " does not leave room for fixed points; give multilevel, density or random");
  const bool in_plane = start.kind == CvtStart::Kind::hexagonal;
  require(!plane || anywhere || in_plane,
          name + " applies to the sphere only; give multilevel, density, random or hexagonal");
  require(plane || !in_plane,
          "the start hexagonal applies to the plane only; give a surface of the plane");
  require(!start.bisections || !chooses_bisections(start.kind),
          name + " chooses the bisections; leave them out");
  require(!start.insertion_rounds || start.kind == CvtStart::Kind::multilevel,
          "rounds of insertion apply to the start multilevel only; leave them out");
  if (start.kind == CvtStart::Kind::multilevel &&
      !start.insertion_rounds) // generators on the boundary do not count
    start.insertion_rounds = beside ? rounds_beside_fixed : usual_rounds;
}

// ---- The number of cells

/// A number of cells that widths imply, within what a grid can have.
/// \param where " in the region", or "".
double within_range(double implied, double least, bool plane, const std::string& where = "") {
  const double cells = std::round(implied);
  require(cells >= least && cells <= double(most_points),
          "the widths require {} cells{}, but a grid has {} to {}; give {}{}", implied, where,
          least, most_points,
          plane           ? cells < least ? "narrower ones" : "wider ones"
          : cells < least ? "narrower ones (widths are km, not metres)"
                          : "wider ones (in a file its attribute units tells km from m)",
          where.empty()   ? ""
          : cells < least ? " or a larger region"
                          : " or a smaller region");
  return cells;
}

/// The number of cells that a uniform width or bisections can reach, near one that widths imply.
std::int64_t reachable(const Schedule& schedule, double implied) {
  if (schedule.density.uniform())
    return geodesic_count(implied);
  const auto cells = static_cast<std::int64_t>(implied);
  std::int64_t parts = 1; // of a coarse grid's cell
  while (schedule.recipe.start.kind == CvtStart::Kind::continuation &&
         (cells - 2) / (4 * parts) >= fewest_graded - 2)
    parts *= 4;
  return (cells - 2 + parts / 2) / parts * parts + 2;
}

/// The number of cells including generators on the boundary, if any, which have half a cell each.
double with_boundary(const Schedule& schedule, double implied) {
  const Recipe& recipe = schedule.recipe;
  double cells = implied;
  for (int k = 0; k < 3 && recipe.boundary == Boundary::generators; ++k)
    cells = implied +
            static_cast<double>(generators_detail::all_boundary_points(
                                    recipe.surface, static_cast<std::int64_t>(std::max(cells, 4.0)),
                                    schedule.density)
                                    .points.cols() /
                                2);
  return std::min(cells, double(most_points));
}

/// The number of cells for the widths in a part of the sphere.
/// \param implied number by the widths, without the half cells of generators on the boundary.
double cells_in_part(const Schedule& schedule, const Surface& asked, double implied) {
  const Recipe& recipe = schedule.recipe;
  constexpr double fewest = 40;
  implied = within_range(implied, fewest, false, " in the region");
  if (recipe.limited_area) { // whose rings lie around the cells inside
    const double inside = implied_cells(*schedule.widths, asked, recipe.radius_km);
    require(inside >= 1,
            "the region has room for {} cells only, without those of the rings; give smaller "
            "widths or a larger region",
            inside);
  }
  return with_boundary(schedule, implied);
}

/// Sets the number of cells where it follows from widths. \returns the number that they imply.
double take_cells(Schedule& schedule, const Surface& asked) {
  Recipe& recipe = schedule.recipe;
  const bool counts = recipe.cells == 0 && recipe.start.kind != CvtStart::Kind::points;
  require(!counts || schedule.widths,
          "there is no number of cells; give one, or cell widths, or the points of the start");
  if (!schedule.widths)
    return 0;
  const double implied = implied_cells(*schedule.widths, recipe.surface, recipe.radius_km);
  if (!counts)
    return implied;
  if (schedule.widths->of_plane()) {
    recipe.cells = static_cast<std::int64_t>(with_boundary(
        schedule, within_range(implied, double(fewest_generators(recipe.surface)), true)));
    return implied;
  }
  if (!recipe.surface.is_bounded()) {
    recipe.cells = reachable(
        schedule, within_range(implied, double(fewest_generators(recipe.surface)), false));
    return implied;
  }
  recipe.cells = static_cast<std::int64_t>(cells_in_part(schedule, asked, implied));
  return static_cast<double>(recipe.cells);
}

/// Replaces a box that has walls by a wider one, and the number of its cells.
void take_walls(Schedule& schedule) {
  Recipe& recipe = schedule.recipe;
  if (!recipe.walls.x && !recipe.walls.y)
    return;
  require(recipe.surface.is_box(), "walls end a periodic box; give two periods");
  require(!recipe.walls.x || !recipe.walls.y,
          "walls in x and y leave no period; give a rectangle, whose sides clip the cells");
  require(recipe.start.kind != CvtStart::Kind::points,
          "walls need points beyond them, too; give a number of cells instead of points");
  WallsRun run = run_between_walls(recipe.surface, recipe.walls, schedule.density, recipe.cells);
  recipe.surface = std::move(run.box);
  schedule.density = std::move(run.density);
  const int bisections =
      chooses_bisections(recipe.start.kind) ? 0 : recipe.start.bisections.value_or(0);
  const std::int64_t parts = std::int64_t{1} << (2 * bisections); // of a cell of the start
  recipe.cells = std::max((run.cells + parts / 2) / parts, std::int64_t{3}) * parts;
}

Points3 joined(const Points3& a, const Points3& b) {
  Points3 all(3, a.cols() + b.cols());
  all << a, b;
  return all;
}

/// Generators on the boundary, for Boundary::generators.
generators_detail::BoundaryPoints on_boundary(const Schedule& schedule) {
  const Recipe& recipe = schedule.recipe;
  if (recipe.boundary != Boundary::generators)
    return {Points3(3, 0), {}};
  require(recipe.surface.is_bounded(),
          "a mesh ends at generators in a bounded surface only; give the rings that bound it");
  require(recipe.start.kind != CvtStart::Kind::points,
          "a mesh that ends at generators does not take points of the start; give a number of "
          "cells, or fixed points on the boundary");
  return generators_detail::limited_boundary_points(recipe.surface, recipe.cells, schedule.density);
}

/// Puts generators on lines and on the boundary after the other fixed ones.
void take_curves(Schedule& schedule) {
  Recipe& recipe = schedule.recipe;
  const auto [boundary, next] = on_boundary(schedule);
  if (!recipe.lines.empty()) {
    require(recipe.start.kind != CvtStart::Kind::points,
            "generators on lines follow from a number of cells; give one, and no points of the "
            "start");
    const LinePoints lines = line_points(recipe.lines, recipe.surface, recipe.cells,
                                         schedule.density, joined(recipe.fixed, boundary));
    recipe.fixed = joined(recipe.fixed, lines.points);
    recipe.lines = {};
    schedule.on_lines = lines.points.cols();
    schedule.line_ends = lines.ends;
    schedule.from_lines = lines.farthest;
  }
  const auto before = static_cast<std::int32_t>(recipe.fixed.cols());
  recipe.fixed = joined(recipe.fixed, boundary);
  schedule.on_boundary = boundary.cols();
  if (!next.empty())
    schedule.next_on_boundary.assign(static_cast<std::size_t>(before), -1);
  for (const std::int32_t after : next)
    schedule.next_on_boundary.push_back(before + after);
}

void require_free(const Recipe& recipe) {
  if (recipe.start.kind == CvtStart::Kind::points)
    return;
  if (recipe.cells >= 1 && recipe.fixed.cols() >= recipe.cells)
    throw Error(ErrorCode::invalid_argument,
                base_detail::message("fixed point {} leaves no free one of the {} cells; give more "
                                     "cells or fewer fixed points",
                                     recipe.cells - 1, recipe.cells),
                recipe.cells - 1);
  base_detail::require_count(recipe.cells, fewest_generators(recipe.surface),
                             "the number of cells");
}

// ---- The descents

void choose_stop(Recipe& recipe) {
  CvtStop& stop = recipe.stop;
  const bool multilevel = recipe.start.kind == CvtStart::Kind::multilevel;
  stop.well_centred = stop.well_centred.value_or(multilevel && !stop.iterations);
  stop.tolerance =
      stop.tolerance.value_or(*stop.well_centred ? tolerance_well_centred : tolerance_pure);
}

FirstLevel first_level(const Schedule& schedule) {
  const Recipe& recipe = schedule.recipe;
  const CvtStart& start = recipe.start;
  const std::int64_t fixed = recipe.fixed.cols();
  if (start.kind == CvtStart::Kind::points)
    return {start.kind, fixed + start.points.cols(), start.bisections.value_or(0)};
  if (start.kind == CvtStart::Kind::continuation)
    return first_of_continuation(recipe.cells, schedule.density.uniform());
  if (start.kind == CvtStart::Kind::multilevel)
    return first_of_multilevel(recipe.cells, recipe.surface, schedule.density, fixed,
                               schedule.on_boundary);
  return first_of_kind(start.kind, recipe.cells, start.bisections.value_or(0), recipe.surface,
                       fixed);
}

/// Refuses, before any work, fewer generators than a mesh needs, or more than the mesh or the
/// method allows.
void require_room(const Recipe& recipe, const FirstLevel& first) {
  if (const std::int64_t fewest = fewest_generators(recipe.surface); first.cells < fewest)
    throw Error(
        ErrorCode::too_few_sites,
        base_detail::message("there are {} generators: give at least {}", first.cells, fewest));
  std::int64_t cells = recipe.cells; // which rounds of insertion lead to
  if (!recipe.start.insertion_rounds) {
    const auto cells_after = [&](int bisections) {
      return bisected(recipe.surface, first.cells, bisections);
    };
    int most = 0;
    while (most < most_bisections && cells_after(most + 1) <= most_points)
      ++most;
    require(first.bisections <= most,
            "{} bisections of {} generators are too many; give at most {}", first.bisections,
            first.cells, most);
    cells = cells_after(first.bisections);
  }
  require(recipe.method != Method::lbfgs_laplacian || cells <= cvt_detail::most_laplacian_rows,
          "{} generators are too many for the method lbfgs_laplacian, which takes at most {}; give "
          "the method lbfgs or lloyd",
          cells, cvt_detail::most_laplacian_rows);
}

} // namespace
} // namespace grids_detail

Schedule plan(Recipe recipe) {
  using namespace grids_detail;
  require_values(recipe);
  require_fixed_points(recipe);
  Schedule schedule;
  Recipe& all = schedule.recipe;
  all = std::move(recipe);
  const Surface asked = all.surface;
  const bool counts = all.cells == 0;
  take_limited_area(all);
  take_resolution(schedule);
  choose_start(all, schedule.density.uniform());
  schedule.implied_cells = take_cells(schedule, asked);
  take_walls(schedule);
  take_curves(schedule);
  if (counts && all.start.kind != CvtStart::Kind::points && all.fixed.cols() > schedule.on_boundary)
    all.cells = cells_beside(all.fixed, all.cells, schedule.density, all.surface);
  require_free(all);
  domain_detail::require_inside(all.fixed, all.surface, all.fixed.cols());
  choose_stop(all);
  all.limited_area = false;
  all.walls = {};
  all.resolution = schedule.density;
  const FirstLevel first = first_level(schedule);
  schedule.first = first.kind;
  require_room(all, first);
  schedule.actions = actions_of(all, first, schedule.on_lines, schedule.on_boundary);
  return schedule;
}

} // namespace calotte
