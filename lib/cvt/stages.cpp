// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/stages.h"

#include "cvt/course.h"
#include "cvt/functional.h"
#include "cvt/insertion.h"
#include "cvt/levels.h"
#include "density/hexagons.h"
#include "integrals/integrand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {
namespace {

/// The spacing at rho = 1 of regular hexagons with the same energy. n times their energy is that of
/// a hexagon times I^2, I the integral of rho^(1/2), and their area at rho = 1 is I/n.
double estimate_spacing(const CvtIteration& iteration) {
  const auto n = static_cast<double>(iteration.cells);
  return hexagon_width(std::sqrt(iteration.energy * n / hexagon_energy) / n);
}

using Kind = CvtAction::Kind;

int count_of_round(const State& state) { return state.memory.iterations > course::steep ? 2 : 1; }

/// The edges that a round splits and collapses: an equal number of each while rounds are left, and
/// in addition the difference to the number of cells at the level's end. Between lines there are
/// cells whose number of sides relaxation does not repair, also where widths are uniform.
EdgeChanges plan_edge_changes(const State& state, const Mesh& mesh, const Density& density) {
  const CvtAction& action = state.action();
  const std::int64_t n = mesh.points.cols();
  std::int64_t both = 0;
  if (state.cursor.times < action.times) {
    both = static_cast<std::int64_t>(
        std::ceil(std::min(course::share_of_dislocations * dislocations(mesh, density),
                           course::share_of_generators * static_cast<double>(n))));
    if (state.has_lines())
      both = std::max(both, count_odd(mesh));
  }
  return {both + std::max<std::int64_t>(action.cells - n, 0),
          both + std::max<std::int64_t>(n - action.cells, 0), state.fixed};
}

std::int64_t missing_cells(const State& state) {
  return std::abs(state.points.cols() - state.action().cells);
}

bool is_far(const State& state) {
  return missing_cells(state) > std::max(state.action().cells / course::far_part, course::far_few);
}

/// Whether further rounds may bring the number of generators to that of the level's end.
bool may_come_nearer(const Cursor& cursor) { return cursor.idle < course::most_idle; }

/// The kind of the action after another; none after the last.
std::optional<Kind> kind_after(const State& state, const Cursor& cursor) {
  const auto next = static_cast<std::size_t>(cursor.action) + 1;
  const std::vector<CvtAction>& actions = state.report.actions;
  return next < actions.size() ? std::optional(actions[next].kind) : std::nullopt;
}

/// Whether a round or a raise at a cursor is due, after the current descent.
bool is_due(const State& state, const Cursor& cursor) {
  const CvtAction& action = state.report.actions[static_cast<std::size_t>(cursor.action)];
  if (action.kind == Kind::insert) // a round may find too few edges for all cells that are missing
    return cursor.times < action.times ||
           (kind_after(state, cursor) == Kind::converge && state.points.cols() != action.cells &&
            may_come_nearer(cursor));
  return action.kind == Kind::raise && !state.report.converged && cursor.times < action.times &&
         (last_accepted(state).shape_excess < reachable_excess || state.has_lines() ||
          state.slides());
}

bool inserts(const State& state) { return has(state, Kind::insert); }

/// Whether an action of a kind may follow another, see stages.h. \param before the kind of the
/// previous action; none for the first.
bool may_follow(std::optional<Kind> before, Kind kind) {
  switch (kind) {
  case Kind::start:
    return !before;
  case Kind::bisect:
  case Kind::insert:
    return before && *before <= Kind::insert;
  case Kind::converge:
    return before == Kind::insert;
  case Kind::polish:
    return before && *before <= Kind::converge;
  case Kind::raise:
    return before && *before >= Kind::polish;
  }
  return false;
}

bool has_good_values(const CvtAction& action, std::int64_t fixed) {
  const bool polishes = action.kind >= Kind::polish;
  return (action.norm == Norm::none || polishes ||
          (action.tolerance > 0 && std::isfinite(action.tolerance))) &&
         action.norm <= Norm::none && action.cells >= std::max<std::int64_t>(fixed, 1) &&
         action.cells <= most_points && action.times >= 0 &&
         action.max_iterations >= (polishes ? 1 : 0);
}

/// Counts one more execution of the action at the cursor.
void count_action(State& state) {
  std::vector<CvtDone>& done = state.report.done;
  done.resize(static_cast<std::size_t>(state.cursor.action) + 1);
  ++done.back().times;
}

void begin_descent(State& state) {
  state.memory = {};
  state.report.converged = false;
}

Level begin_level(State& state, const Density& density, const Mesh& mesh) {
  const std::int64_t cells =
      inserts(state) ? state.action().cells : bisected(mesh.surface, mesh.points.cols());
  return set_bisected(state, mesh, density, cells);
}

/// Begins a round. The descent after the last round of the last level is that of Kind::converge.
Level begin_round(State& state, const Density& density, const Mesh& mesh, int count) {
  Cursor& cursor = state.cursor;
  const std::int64_t before = missing_cells(state);
  const bool counts = !is_far(state) || !may_come_nearer(cursor);
  Level level =
      set_split_and_collapsed(state, mesh, density, plan_edge_changes(state, mesh, density));
  if (before > 0 && missing_cells(state) >= before && may_come_nearer(cursor))
    ++cursor.idle;
  if (counts)
    cursor.times = std::min(cursor.times + count, state.action().times);
  if (!is_due(state, cursor) && kind_after(state, cursor) == Kind::converge) {
    add_done(state);
    cursor = {.action = cursor.action + 1, .glides = cursor.glides};
    count_action(state);
  }
  return level;
}

void begin_polish(State& state) {
  const CvtIteration& last = state.report.iterations.back();
  state.polish = {.penalty = course::penalty * last.energy / static_cast<double>(last.cells),
                  .demanded_spacing = estimate_spacing(last),
                  .descended = state.report.converged ||
                               state.cursor.glides > 0}; // glides begin after convergence
}

void begin_raised(State& state) {
  state.polish.penalty *= course::raise;
  ++state.cursor.times;
}

/// Whether cells of the sphere count as flat and the density as nearly linear between generators.
/// There must be many generators, and the widest cells, whose area is proportional to rho^(-1/2),
/// must be within 15 degrees. Where the density is 0, cells may have any width.
bool is_resolved(const State& state, const Surface& surface, const Density& density) {
  const Eigen::Index n = state.points.cols();
  if (!surface.is_sphere() || n < course::flat_from)
    return false;
  const Eigen::Index stride = (n + course::samples_of_widths - 1) / course::samples_of_widths;
  Points3 samples(3, (n + stride - 1) / stride);
  for (Eigen::Index k = 0; k < samples.cols(); ++k)
    samples.col(k) = state.points.col(k * stride);
  const DoubleVector area = evaluate(density, samples).cwiseSqrt().cwiseInverse();
  const double mean = area.mean() * static_cast<double>(n) / surface.area();
  return std::isfinite(mean) &&
         area.maxCoeff() <= course::widest_linear * course::widest_linear * mean;
}

} // namespace

bool are_actions(const std::vector<CvtAction>& actions, std::int64_t fixed) {
  std::optional<Kind> before;
  for (const CvtAction& action : actions)
    if (!may_follow(std::exchange(before, action.kind), action.kind) ||
        !has_good_values(action, fixed))
      return false;
  return !actions.empty();
}

bool has(const State& state, Kind kind) {
  return std::ranges::find(state.report.actions, kind, &CvtAction::kind) !=
         state.report.actions.end();
}

const CvtIteration& last_accepted(const State& state) {
  const std::vector<CvtIteration>& all = state.report.iterations;
  return *std::find_if(all.rbegin(), all.rend() - 1,
                       [](const CvtIteration& iteration) { return iteration.accepted; });
}

bool creeps(const State& state, const DescentOptions& options) {
  const int window = inserts(state) ? course::creeping_after_insertion : course::creeping;
  if (!options.may_creep || options.norm == Norm::none || state.in_polish())
    return false;
  if (state.cursor.glides > course::glides_with_descent)
    return true;
  if (state.memory.since_restart <= window)
    return false;
  const std::vector<CvtIteration>& all = state.report.iterations;
  double before = std::numeric_limits<double>::infinity(), now = before;
  for (std::ptrdiff_t k = 1; k <= state.memory.since_restart; ++k) {
    const CvtIteration& iteration = *(all.end() - k);
    if (rule_of(iteration) != rule_of(all.back())) // another functional
      break;
    if (iteration.accepted)
      (k <= window ? now : before) =
          std::min(k <= window ? now : before, norm_of(iteration, options.norm));
  }
  return before < std::numeric_limits<double>::infinity() &&
         now > course::creeping_progress * before;
}

bool has_stalled(const State& state) {
  constexpr int window = course::stall;
  if (!state.in_polish() || state.memory.iterations < 2 * window)
    return false;
  const auto end = state.report.iterations.end() - window;
  double before = std::numeric_limits<double>::infinity();
  for (auto i = end + window - state.memory.iterations; i != end; ++i)
    if (i->accepted)
      before = std::min(before, i->shape_excess);
  return last_accepted(state).shape_excess > course::stall_progress * before;
}

std::optional<Cursor> next_cursor(const State& state) {
  Cursor cursor = state.cursor;
  while (!is_due(state, cursor)) {
    const std::optional<Kind> next = kind_after(state, cursor);
    if (!next)
      return std::nullopt;
    cursor = {.action = cursor.action + 1, .glides = cursor.glides};
    if (next == Kind::bisect || next == Kind::polish)
      break;
  }
  return cursor;
}

int bisections_left(const State& state) {
  const std::vector<CvtAction>& actions = state.report.actions;
  return static_cast<int>(
      std::count_if(actions.begin() + state.cursor.action + 1, actions.end(),
                    [](const CvtAction& action) { return action.kind == Kind::bisect; }));
}

int rounds_left(const State& state) {
  if (state.action().kind == Kind::insert)
    return state.action().times - state.cursor.times;
  return kind_after(state, state.cursor) == Kind::insert ? (&state.action() + 1)->times : 0;
}

bool may_glide(const State& state) {
  return !state.in_polish() && state.report.converged &&
         state.cursor.glides < course::most_glides &&
         kind_after(state, state.cursor) == Kind::polish;
}

ShapeLimits limits_of_glide(const State& state) {
  return state.cursor.glides < course::early_glides ? early_glide_limits() : shape_limits;
}

ShapePenalty penalty_of(const State& state, const CvtStop& stop) {
  ShapePenalty penalty;
  penalty.spacing = state.polish.demanded_spacing;
  penalty.limits.least_spacing = stop.least_spacing;
  penalty.limits.most_off_midpoint = stop.most_off_midpoint;
  if (state.fixed > 0)
    penalty.limits.most_spacing = most_spacing_beside_fixed;
  const int raised = state.action().kind == Kind::raise ? state.cursor.times : 0;
  penalty.factors = {state.polish.penalty, state.polish.penalty / std::pow(course::raise, raised)};
  return penalty;
}

DescentOptions make_descent_options(const State& state, const Recipe& recipe,
                                    const Density& density, const Quadrature& quadrature) {
  const CvtAction& action = state.action();
  const bool last = action.kind == Kind::converge, polishes = has(state, Kind::polish);
  DescentOptions here{.method = recipe.method,
                      .norm = action.norm,
                      .tolerance = action.tolerance,
                      .max_iterations = action.max_iterations,
                      .quadrature = quadrature,
                      .may_creep = polishes};
  if (!state.in_polish() && (!inserts(state) || action.norm == Norm::none))
    return here;
  int& rule = here.quadrature.rule;
  if (is_resolved(state, recipe.surface, density))
    rule = rule_at_sites;
  if (state.in_polish()) {
    here.method = Method::lbfgs;
    return here;
  }
  const bool fine_level = state.points.cols() >= course::flat_from;
  if (here.method == Method::automatic && fine_level && (!last || polishes))
    here.method = Method::lbfgs;
  if (last) {
    if (action.tolerance >= course::fine_tolerance)
      here.quadrature.final_rule = quadrature.rule;
    return here;
  }
  here.may_creep = false;
  here.quadrature.final_rule = rule;
  const bool further = action.kind != Kind::insert || is_due(state, state.cursor);
  if (further && is_far(state))
    here.max_iterations = std::min(here.max_iterations, course::evaluations_while_far);
  return here;
}

void add_done(State& state) {
  CvtDone& done = state.report.done.back();
  done.iterations += state.memory.iterations;
  done.cells = state.points.cols();
}

Level begin_action(State& state, const Cursor& cursor, const Surface& surface,
                   const Density& density, std::optional<Connectivity>&& known) {
  const int count = count_of_round(state);
  state.cursor = cursor;
  count_action(state);
  const Kind kind = state.action().kind;
  if (kind == Kind::polish || kind == Kind::raise) { // of the same points
    kind == Kind::polish ? begin_polish(state) : begin_raised(state);
    begin_descent(state);
    return {std::nullopt, std::move(known)};
  }
  begin_descent(state);
  const Mesh mesh = mesh_of_run(state, surface, std::move(known));
  Level level = kind == Kind::bisect ? begin_level(state, density, mesh)
                                     : begin_round(state, density, mesh, count);
  state.site_of_input.clear();
  return level;
}

} // namespace calotte::cvt_detail
