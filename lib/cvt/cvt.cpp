// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>

#include "base/clock.h"
#include "base/points.h"
#include "base/require.h"
#include "cvt/course.h"
#include "cvt/cvt.h"
#include "cvt/descent.h"
#include "cvt/functional.h"
#include "cvt/inner_mesh.h"
#include "cvt/laplacian.h"
#include "cvt/levels.h"
#include "cvt/stages.h"
#include "cvt/state.h"
#include "density/surface_density.h"
#include "domain/arcs.h"
#include "domain/surface.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace calotte {
namespace cvt_detail {

namespace {

bool is_in_actions(const State& state) {
  const Cursor& cursor = state.cursor;
  return cursor.action >= 0 && cursor.action < std::ssize(state.report.actions) &&
         std::ssize(state.report.done) == cursor.action + 1 && cursor.times >= 0 &&
         cursor.idle >= 0 && cursor.glides >= 0;
}

/// Refuses a state that no run can have left, in any space.
void require_state(const State& state) {
  const auto n = static_cast<std::size_t>(state.points.cols());
  std::vector<std::uint8_t> seen(n, 0);
  bool good = n >= 1 && state.id.size() == n && state.fixed >= 0 &&
              state.fixed <= state.points.cols() && is_in_actions(state) &&
              std::isfinite(state.polish.penalty) && state.polish.penalty >= 0 &&
              std::isfinite(state.polish.demanded_spacing) && state.polish.demanded_spacing > 0;
  for (std::size_t i = 0; good && i < n; ++i) {
    const std::int32_t id = state.id[i];
    good = id >= 0 && static_cast<std::size_t>(id) < n && seen[static_cast<std::size_t>(id)]++ == 0;
  }
  const Memory& memory = state.memory;
  for (const auto* list : {&memory.steps, &memory.changes})
    for (const base_detail::CompactField& field : *list)
      good = good && field.values.cols() == state.points.cols() && std::isfinite(field.scale);
  good = good && memory.steps.size() == memory.changes.size() &&
         memory.steps.size() == memory.curvatures.size();
  const Eigen::Index rows = memory.laplacian_at.cols();
  good = good && (rows == 0 || rows == state.points.cols());
  good = good && memory.stride > 0 && memory.stride <= 1 && memory.iterations >= 0;
  for (const std::int32_t site : state.site_of_input)
    good = good && site >= 0 && static_cast<std::size_t>(site) < n;
  if (!good)
    refuse_state();
}

/// Updates the state with the evaluation at its points: the norm, convergence and the rule.
void conclude(State& state, const DescentOptions& options, const Evaluation& here) {
  const CvtIteration& iteration = here.iteration;
  CvtReport& report = state.report;
  const int rule = rule_of(iteration);
  const bool by_final_rule = rule == 0 || rule == options.quadrature.final_rule;
  report.residual = norm_of(iteration, options.norm);
  if (state.in_polish()) {
    const bool raised = state.action().kind == CvtAction::Kind::raise;
    report.converged = iteration.shape_excess <= (raised ? accepted_excess : polished_excess) &&
                       (here.shapes.off_midpoint == 0 ||
                        state.memory.since_restart >= course::evaluations_for_midpoints);
  } else if (options.norm == Norm::none) {
    report.converged = state.memory.iterations >= options.max_iterations;
  } else {
    // Near the end the finer rule replaces the coarser one; a run converges with the finer only,
    // unless it creeps.
    report.converged =
        (by_final_rule && report.residual <= options.tolerance) || creeps(state, options);
    const double margin = options.quadrature.rule == rule_at_sites ? 1 : 10;
    state.memory.final_rule =
        state.memory.final_rule || report.residual <= margin * options.tolerance;
  }
}

bool level_ended(const State& state, const DescentOptions& options) {
  return state.report.converged || state.memory.iterations >= options.max_iterations ||
         state.memory.stuck || has_stalled(state);
}

/// Moves the generators of a CVT to the centroids of their cells. Those of a polish stay.
void end_descent(State& state, Descent& descent) {
  if (!state.in_polish()) {
    descent.end_at_centroids();
    return;
  }
  const ShapeTerms& shapes = descent.here().shapes;
  CvtReport& report = state.report;
  report.converged = shapes.worst <= accepted_excess;
  report.cells_beyond_limits = shapes.generators;
  report.worst_cell =
      report.converged ? -1 : state.id[static_cast<std::size_t>(shapes.worst_generator)];
}

/// Moves dislocations or polishes shapes, in subdomains.
void work_locally(State& state, const DescentOptions& options, RunFunctional& functional,
                  Descent& descent) {
  while (may_glide(state)) {
    if (functional.glide(state.points, limits_of_glide(state)) > 0)
      descent.restart();
    ++state.cursor.glides;
    conclude(state, options, descent.here());
  }
  const int raised = state.action().kind == CvtAction::Kind::raise ? state.cursor.times : 0;
  const bool at_start =
      state.in_polish() && state.memory.iterations == 1 && (raised == 0 || state.has_lines());
  if (at_start && !state.report.converged && functional.polish(state.points, raised) > 0) {
    descent.restart();
    conclude(state, options, descent.here());
  }
}

/// The end of a level.
struct Ending {
  bool stopped = false;
  std::optional<Connectivity> mesh; ///< of the state's points; none if they must be triangulated
};

/// The data that the descents of a run read.
struct Run {
  const Schedule& schedule;
  const Execution& execution;
  Density density; ///< as the functional takes it
};

/// The descent of the action at the cursor.
Ending iterate(const Run& run, CvtState& whole, Level&& level, const CvtCallback& callback) {
  State& state = State::of(whole);
  const Recipe& recipe = run.schedule.recipe;
  const DescentOptions options =
      make_descent_options(state, recipe, run.density, run.execution.quadrature);
  if (!state.in_polish() && options.norm != Norm::none) // the tolerance may have changed
    state.report.converged = state.report.converged &&
                             (state.report.residual <= options.tolerance || creeps(state, options));
  if (level_ended(state, options)) {
    state.report.converged = state.report.converged || options.norm == Norm::none;
    return {};
  }
  const double before = state.report.seconds;
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<RunFunctional> functional = make_functional(
      state.points, recipe.surface, run.density, {run.execution.decomposition, options.quadrature},
      recipe.boundary, std::move(level));
  functional->penalise(penalty_of(state, recipe.stop));
  functional->pin(fixed_generators(state));
  functional->end_along(boundary_order(state, run.schedule.next_on_boundary));
  Descent descent(state, options, run.density, *functional);
  const bool resumed = state.memory.iterations > 0;
  descent.begin();
  if (resumed)
    descent.step();
  for (;; descent.step()) {
    conclude(state, options, descent.here());
    work_locally(state, options, *functional, descent);
    const bool ended = level_ended(state, options);
    if (ended)
      end_descent(state, descent);
    Clock::time_point now = start;
    state.report.seconds = before + restart_clock(now);
    const bool stopped = callback && callback({state.report, state.memory.iterations,
                                               bisections_left(state), rounds_left(state), whole});
    if (ended || stopped) {
      state.report.regions = functional->regions();
      return {stopped, functional->take_mesh(state.points)};
    }
  }
}

/// Replaces the actions of a state's run by those of the schedule: the ends of their descents may
/// have changed.
/// \throws Error invalid_argument for the actions of another run.
void renew_actions(const Schedule& schedule, State& state) {
  const auto same = [](const CvtAction& a, const CvtAction& b) {
    return a.kind == b.kind && a.times == b.times && a.cells == b.cells;
  };
  require(std::ranges::equal(state.report.actions, schedule.actions, same),
          "the state is of a run with other actions; give the recipe that it was made with, or no "
          "state");
  require(state.fixed == schedule.recipe.fixed.cols(),
          "the state is of a run with {} fixed generators, not {}; give the recipe that it was "
          "made with, or no state",
          state.fixed, schedule.recipe.fixed.cols());
  state.report.actions = schedule.actions;
}

/// Prepares a run. It refuses an invalid surface or density before any work.
Run make_run(const Schedule& schedule, const Execution& execution) {
  const Surface& surface = schedule.recipe.surface;
  if (!surface.is_sphere())
    require_finite_plane(surface);
  return {schedule, execution, checked_surface_density(schedule.density, surface)};
}

/// Reports how far the generators on lines are from where the recipe has them.
void measure_moves(State& state, const Recipe& recipe, const Density& density) {
  for (std::size_t r = 0; r < state.id.size(); ++r) {
    const std::int32_t id = state.id[r];
    if (!state.on_lines.contain(id))
      continue;
    const Vec3 here = column(state.points, static_cast<std::int64_t>(r)),
               before = recipe.surface.is_sphere()
                            ? domain_detail::as_unit(column(recipe.fixed, id))
                            : Vec3(column(recipe.fixed, id));
    const double move = norm(here - before);
    if (!(move > 0))
      continue;
    ++state.report.moved_on_lines;
    const double width = state.polish.demanded_spacing /
                         std::sqrt(std::sqrt(evaluate(density, recipe.fixed.col(id))[0]));
    state.report.farthest_move = std::max(state.report.farthest_move, move / width);
  }
}

Cvt executed(const Run& run, CvtState whole, Level&& level, const CvtCallback& callback) {
  State& state = State::of(whole);
  const Recipe& recipe = run.schedule.recipe;
  const std::int64_t end = recipe.fixed.cols() - run.schedule.on_boundary,
                     first = end - run.schedule.on_lines;
  state.on_lines = {first, first + run.schedule.line_ends, end};
  require_points(state, recipe.surface);
  Clock::time_point mark = Clock::now();
  const double before = state.report.seconds;
  Ending ending = iterate(run, whole, std::move(level), callback);
  std::optional<Cursor> next = next_cursor(state);
  for (; !ending.stopped && next; next = next_cursor(state)) {
    add_done(state);
    Level begun = begin_action(state, *next, recipe.surface, run.density, std::move(ending.mesh));
    ending = iterate(run, whole, std::move(begun), callback);
  }
  add_done(state);
  measure_moves(state, recipe, run.density);
  state.memory = {};
  Cvt result;
  const std::vector<std::int32_t>& boundary = run.schedule.next_on_boundary;
  result.mesh = boundary.empty()
                    ? inner_mesh(mesh_of_run(state, recipe.surface, std::move(ending.mesh)))
                    : mesh_to_boundary(in_order(state), recipe.surface, boundary);
  if (!state.site_of_input.empty())
    result.mesh.site_of_input = std::move(state.site_of_input);
  const bool polishes = has(state, CvtAction::Kind::polish);
  result.report = std::move(state.report);
  CvtReport& report = result.report;
  if (!next) // the remaining actions were skipped
    report.done.resize(report.actions.size());
  report.well_centred = !next && state.in_polish() && report.converged;
  report.converged = !next && (polishes ? state.polish.descended : report.converged);
  report.seconds = before + restart_clock(mark);
  return result;
}

} // namespace
} // namespace cvt_detail

double norm_of(const CvtIteration& iteration, Norm norm) {
  switch (norm) {
  case Norm::l2:
    return iteration.l2;
  case Norm::linf:
    return iteration.linf;
  case Norm::l2_scaled:
    return iteration.l2 / iteration.spacing;
  case Norm::linf_scaled:
    return iteration.linf / iteration.spacing;
  default:
    return 0;
  }
}

Cvt cvt(Points3 start, const Schedule& schedule, const cvt_detail::Execution& execution,
        const CvtCallback& callback) {
  using namespace cvt_detail;
  const auto run = make_run(schedule, execution);
  Begun begun = begin(std::move(start), schedule.recipe);
  begun.state.report.actions = schedule.actions;
  begun.state.report.done = {{.times = 1}};
  return executed(run, State::wrapped(std::move(begun.state)), std::move(begun.level), callback);
}

Cvt cvt(CvtState state, const Schedule& schedule, const cvt_detail::Execution& execution,
        const CvtCallback& callback) {
  using namespace cvt_detail;
  const auto run = make_run(schedule, execution);
  require_state(State::of(state));
  renew_actions(schedule, State::of(state));
  return executed(run, std::move(state), {}, callback);
}

} // namespace calotte
