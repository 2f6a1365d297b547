// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/c.h>

#include "c/guard.h"
#include "c/mesh.h"
#include "c/recipe.h"

#include <calotte/grid.h>
#include <calotte/write_grid.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace calotte::c_detail {
namespace {

calotte_report make_report(const CvtReport& report) {
  return {0,
          report.converged ? 1 : 0,
          report.well_centred ? 1 : 0,
          report.cells_beyond_limits,
          report.worst_cell,
          std::ssize(report.iterations),
          report.residual,
          report.iterations.empty() ? 0 : report.iterations.back().energy,
          report.seconds,
          report.off_boundary};
}

/// Fills one of the arrays of actions of a caller.
/// \param value of an action.
template <class Item, class Value>
void fill_actions(const Schedule& schedule, std::int64_t capacity, Item* out, Value value) {
  const auto& actions = schedule.actions;
  if (out != nullptr)
    std::transform(actions.begin(), actions.begin() + std::min(std::ssize(actions), capacity), out,
                   value);
}

calotte_schedule filled(const Schedule& schedule, calotte_schedule given) {
  require(given.action_capacity >= 0, "action_capacity is negative; give 0 or more");
  const Recipe& made = schedule.recipe;
  const std::int64_t capacity = given.action_capacity;
  const auto fill = [&](auto* out, auto value) { fill_actions(schedule, capacity, out, value); };
  fill(given.action_kind, [](const CvtAction& action) { return word_of(action.kind).data(); });
  fill(given.action_cells, [](const CvtAction& action) { return action.cells; });
  fill(given.action_times, [](const CvtAction& action) { return std::int64_t{action.times}; });
  fill(given.action_tolerance, [](const CvtAction& action) { return action.tolerance; });
  fill(given.action_iterations,
       [](const CvtAction& action) { return std::int64_t{action.max_iterations}; });
  given.actions = std::ssize(schedule.actions);
  given.cells = made.cells;
  given.implied_cells = schedule.implied_cells;
  given.fixed = made.fixed.cols();
  given.on_boundary = schedule.on_boundary;
  given.start = word_of(made.start.kind).data();
  given.first = word_of(schedule.first).data();
  given.insertion_rounds = made.start.insertion_rounds.value_or(0);
  given.well_centred = *made.stop.well_centred ? 1 : 0;
  given.tolerance = *made.stop.tolerance;
  return given;
}

} // namespace
} // namespace calotte::c_detail

using namespace calotte;
using namespace calotte::c_detail;

calotte_status calotte_make_grid(const calotte_recipe* recipe, calotte_progress progress,
                                 void* progress_data, calotte_mesh** mesh, calotte_report* report,
                                 calotte_error* error) {
  return guarded(error, [&] {
    require_output(mesh);
    if (report != nullptr)
      size_of(report, "calotte_report");
    RunOptions options;
    if (progress != nullptr)
      options.progress = [=](const Progress& now) {
        const CvtReport& so_far = now.run->report;
        return progress(std::ssize(so_far.iterations), so_far.residual, progress_data) != 0
                   ? ProgressReply::stop
                   : ProgressReply::proceed;
      };
    Cvt grid = make_grid(recipe_of(recipe), options);
    hand_over(std::move(grid.mesh), mesh);
    if (report != nullptr)
      fill(report, make_report(grid.report), "calotte_report");
  });
}

calotte_status calotte_plan(const calotte_recipe* recipe, calotte_schedule* schedule,
                            calotte_error* error) {
  return guarded(error, [&] {
    const calotte_schedule given = known_part(schedule, "calotte_schedule");
    fill(schedule, filled(plan(recipe_of(recipe)), given), "calotte_schedule");
  });
}

calotte_status calotte_write_grid(const char* path, const calotte_mesh* mesh,
                                  const calotte_recipe* recipe, double sphere_radius,
                                  calotte_error* error) {
  return guarded(error, [&] {
    require(path != nullptr, "the path is a null pointer; give the name of a file");
    const Mesh& made = mesh_of(mesh);
    const Recipe asked = recipe_of(recipe);
    WriteOptions options;
    options.sphere_radius = sphere_radius;
    write_grid(path, made, asked, plan(asked), options);
  });
}
