// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>

#include "base/clock.h"
#include "base/points.h"
#include "base/require.h"
#include "cvt/cvt.h"
#include "cvt/descent.h"
#include "cvt/functional.h"
#include "cvt/inner_mesh.h"
#include "cvt/laplacian.h"
#include "cvt/levels.h"
#include "cvt/stages.h"
#include "cvt/state.h"
#include "density/surface_density.h"
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

void require_options(const CvtOptions& options) {
  const auto refuse = [](const std::string& what) {
    throw Error(ErrorCode::invalid_argument, what);
  };
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    refuse("the tolerance is " + std::to_string(options.tolerance) +
           "; give a positive number such as 1e-6");
  if (options.max_iterations < 0)
    refuse("the number of iterations is " + std::to_string(options.max_iterations) +
           "; give 0 or more");
  if (options.bisections < 0)
    refuse("the number of bisections is " + std::to_string(options.bisections) +
           "; give 0 or more");
  if (options.insertion_rounds < 0 || options.cells < 0)
    refuse("insertion_rounds or cells is negative; give 0 or more");
  if ((options.insertion_rounds > 0) != (options.cells > 0))
    refuse("insertion needs both insertion_rounds and cells; give both or neither");
  if (!(options.least_spacing >= 0 && options.least_spacing <= 0.95))
    refuse("least_spacing is " + std::to_string(options.least_spacing) +
           "; give a share of the demanded spacing, 0 to 0.95");
}

namespace {

bool is_in_actions(const State& state) {
  const Cursor& cursor = state.cursor;
  return cursor.action >= 0 && cursor.action < std::ssize(state.report.actions) &&
         std::ssize(state.report.done) == cursor.action + 1 && cursor.times >= 0 &&
         cursor.idle >= 0 && cursor.glides >= 0;
}

/// Throws for a state that no run can have left, in any space.
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
void conclude(State& state, const CvtOptions& options, const CvtIteration& iteration) {
  CvtReport& report = state.report;
  const bool by_final_rule = options.density.uniform() || rule_of(iteration) == options.final_rule;
  report.residual = norm_of(iteration, options.norm);
  if (state.in_polish()) {
    const bool raised = state.action().kind == CvtAction::Kind::raise;
    report.converged = iteration.shape_excess <= (raised ? accepted_excess : polished_excess);
  } else if (options.norm == Norm::none) {
    report.converged = state.memory.iterations >= options.max_iterations;
  } else {
    // Near the end the finer rule replaces the coarser one; a run converges with the finer only,
    // unless it creeps.
    const bool crept = creeps(state, options);
    report.converged = (by_final_rule && report.residual <= options.tolerance) || crept;
    const double margin = options.rule == rule_at_sites ? 1 : 10;
    state.memory.final_rule =
        state.memory.final_rule || report.residual <= margin * options.tolerance;
  }
}

bool level_ended(const State& state, const CvtOptions& options) {
  return state.report.converged || state.memory.iterations >= options.max_iterations ||
         state.memory.stuck || has_stalled(state);
}

/// A CVT's generators are the centroids of its cells; a polish keeps its own.
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

/// Moves dislocations, and polishes shapes, where they are.
void work_locally(State& state, const CvtOptions& options, RunFunctional& functional,
                  Descent& descent) {
  while (may_glide(state)) {
    if (functional.glide(state.points, limits_of_glide(state)) > 0)
      descent.restart();
    ++state.cursor.glides;
    conclude(state, options, descent.here().iteration);
  }
  const bool at_start =
      state.memory.iterations == 1 && state.action().kind == CvtAction::Kind::polish;
  if (at_start && !state.report.converged && functional.polish(state.points) > 0) {
    descent.restart();
    conclude(state, options, descent.here().iteration);
  }
}

/// How a level ended.
struct Ending {
  bool stopped = false;
  std::optional<Connectivity> mesh; ///< of the state's points; none if they must be triangulated
};

/// The descent of one level.
Ending iterate(const Surface& surface, CvtState& whole, Level&& level, const CvtOptions& options,
               const CvtCallback& callback) {
  State& state = State::of(whole);
  if (!state.in_polish() && options.norm != Norm::none) // the tolerance may be another now
    state.report.converged = state.report.converged &&
                             (state.report.residual <= options.tolerance || creeps(state, options));
  if (level_ended(state, options)) {
    state.report.converged = state.report.converged || options.norm == Norm::none;
    return {};
  }
  const double before = state.report.seconds;
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<RunFunctional> functional =
      make_functional(state.points, surface, options, std::move(level));
  ShapeLimits limits = shape_limits;
  limits.least_spacing = options.least_spacing;
  functional->penalise({state.polish.penalty, state.polish.demanded_spacing, limits});
  functional->hold(fixed_generators(state));
  Descent descent(state, options, *functional);
  const bool resumed = state.memory.iterations > 0;
  descent.begin();
  if (resumed)
    descent.step();
  for (;; descent.step()) {
    conclude(state, options, descent.here().iteration);
    work_locally(state, options, *functional, descent);
    const bool ended = level_ended(state, options);
    if (ended)
      end_descent(state, descent);
    Clock::time_point now = start;
    state.report.seconds = before + lap(now);
    const bool stopped = callback && callback({state.report, state.memory.iterations,
                                               bisections_left(state), rounds_left(state), whole});
    if (ended || stopped) {
      state.report.regions = functional->regions();
      return {stopped, functional->take_mesh(state.points)};
    }
  }
}

/// Throws, before any work, if a run leads to fewer or more generators than a mesh can hold.
/// \param n the number of generators that it begins with, \param fixed of them.
void require_room(const Surface& surface, std::int64_t n, std::int64_t fixed,
                  const CvtOptions& options) {
  const bool inserts = options.insertion_rounds > 0;
  if (inserts && (options.cells < fewest_generators(surface) || options.cells > most_points))
    throw Error(ErrorCode::invalid_argument, "cells is " + std::to_string(options.cells) +
                                                 "; give at least " +
                                                 std::to_string(fewest_generators(surface)) +
                                                 " and at most " + std::to_string(most_points));
  if (inserts && options.cells < fixed)
    throw Error(ErrorCode::invalid_argument,
                "fixed generator " + std::to_string(options.cells) + " is beyond the " +
                    std::to_string(options.cells) +
                    " cells of the result; give more cells or fewer fixed generators",
                options.cells);
  const auto bisections = options.actions.empty()
                              ? options.bisections
                              : static_cast<int>(std::ranges::count(
                                    options.actions, CvtAction::Kind::bisect, &CvtAction::kind));
  int most = 0;
  for (std::int64_t cells = bisected(surface, n); cells <= most_points;
       cells = bisected(surface, cells))
    ++most;
  if (bisections > most)
    throw Error(ErrorCode::invalid_argument,
                std::to_string(bisections) + " bisections of " + std::to_string(n) +
                    " generators are too many; give at most " + std::to_string(most));
  const std::int64_t cells =
      bisected(surface, std::max(n, inserts ? options.cells : 0), bisections);
  if (options.method == Method::lbfgs_laplacian && cells > most_laplacian_rows)
    throw Error(ErrorCode::invalid_argument, std::to_string(cells) +
                                                 " generators are too many for the method "
                                                 "lbfgs_laplacian, which takes at most " +
                                                 std::to_string(most_laplacian_rows) +
                                                 "; give the method lbfgs or lloyd");
}

std::vector<CvtAction> actions_for(const Surface& surface, std::int64_t first, std::int64_t fixed,
                                   const CvtOptions& options) {
  require_room(surface, first, fixed, options);
  return options.actions.empty() ? actions_of(surface, first, options) : options.actions;
}

/// The actions of a state's run, whose ends may be others now.
/// \throws Error invalid_argument for those of another run.
void renew_actions(const Surface& surface, const CvtOptions& options, State& state) {
  std::vector<CvtAction>& theirs = state.report.actions;
  std::vector<CvtAction> ours = actions_for(surface, theirs.front().cells, state.fixed, options);
  const bool counts = options.insertion_rounds > 0;
  const auto same = [&](const CvtAction& a, const CvtAction& b) {
    return a.kind == b.kind && a.times == b.times && (!counts || a.cells == b.cells);
  };
  require(std::ranges::equal(theirs, ours, same),
          "the state is of a run with other actions; give the recipe that it was made with, or no "
          "state");
  theirs = std::move(ours);
}

/// Throws, before any work, for a surface or options that a run refuses.
/// \returns the options with the density in the form that the functional takes.
CvtOptions options_of_run(const Surface& surface, const CvtOptions& options) {
  require_options(options);
  if (!surface.is_sphere())
    require_finite_plane(surface);
  CvtOptions of_run = options;
  of_run.density = checked_surface_density(options.density, surface);
  return of_run;
}

/// \param options as options_of_run() gives them, here and below.
Cvt run(const Surface& surface, CvtState whole, Level&& level, const CvtOptions& options,
        const CvtCallback& callback) {
  State& state = State::of(whole);
  require_points(state, surface);
  Clock::time_point mark = Clock::now();
  const double before = state.report.seconds;
  const auto descend = [&](Level&& start) {
    return iterate(surface, whole, std::move(start), options_of_descent(state, surface, options),
                   callback);
  };
  Ending ending = descend(std::move(level));
  std::optional<Cursor> next = next_of(state);
  for (; !ending.stopped && next; next = next_of(state)) {
    add_done(state);
    ending = descend(begin_action(state, *next, surface, options, std::move(ending.mesh)));
  }
  add_done(state);
  state.memory = {};
  Cvt result;
  result.mesh = inner_mesh(mesh_of_run(state, surface, std::move(ending.mesh)), options.boundary);
  if (!state.site_of_input.empty())
    result.mesh.site_of_input = std::move(state.site_of_input);
  result.report = std::move(state.report);
  if (!next) // the others were left out
    result.report.done.resize(result.report.actions.size());
  result.report.well_centred = !next && state.in_polish() && result.report.converged;
  result.report.converged =
      !next && (options.well_centred ? state.polish.descended : result.report.converged);
  result.report.seconds = before + lap(mark);
  return result;
}

Cvt run(const Surface& surface, Begun&& begun, const CvtOptions& options,
        const CvtCallback& callback) {
  const State& state = begun.state;
  CvtReport& report = begun.state.report;
  report.actions = actions_for(surface, state.points.cols(), state.fixed, options);
  report.done = {{.times = 1}};
  return run(surface, State::wrapped(std::move(begun.state)), std::move(begun.level), options,
             callback);
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

Cvt cvt(const PointsRef& start, const Surface& surface, const CvtOptions& options,
        const CvtCallback& callback) {
  const CvtOptions of_run = cvt_detail::options_of_run(surface, options);
  return cvt_detail::run(surface, cvt_detail::begin(start, surface, of_run), of_run, callback);
}

template <>
Cvt cvt(Points3&& start, const Surface& surface, const CvtOptions& options,
        const CvtCallback& callback) {
  if (!surface.is_whole_sphere())
    return cvt(PointsRef(start), surface, options, callback);
  const CvtOptions of_run = cvt_detail::options_of_run(surface, options);
  return cvt_detail::run(surface, cvt_detail::begin(std::move(start), of_run), of_run, callback);
}

Cvt cvt(CvtState state, const Surface& surface, const CvtOptions& options,
        const CvtCallback& callback) {
  using namespace cvt_detail;
  const CvtOptions of_run = options_of_run(surface, options);
  require_state(State::of(state));
  renew_actions(surface, of_run, State::of(state));
  return run(surface, std::move(state), {}, of_run, callback);
}

} // namespace calotte
