// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/stages.h"

#include "cvt/functional.h"
#include "cvt/insertion.h"
#include "cvt/levels.h"
#include "density/hexagons.h"
#include "integrals/integrand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace calotte::cvt_detail {
namespace {

/// The spacing at rho = 1 of regular hexagons with the same energy. n times their energy is that of
/// a hexagon times I^2, I the integral of rho^(1/2), and their area at rho = 1 is I/n.
double spacing_of(const CvtIteration& iteration) {
  const auto n = static_cast<double>(iteration.cells);
  return hexagon_width(std::sqrt(iteration.energy * n / hexagon_energy) / n);
}

using Kind = CvtAction::Kind;

/// A round after a descent of more than 25 evaluations counts for two: where widths are steep, a
/// round takes long and gains less.
int count_of_round(const State& state) {
  constexpr int steep = 25;
  return state.memory.iterations > steep ? 2 : 1;
}

/// The edges of a round: a twentieth of the dislocations that the density demands while rounds are
/// left, and the difference to the number of cells. Half of them give less energy, but the errors
/// of a model's vorticity, divergence and kinetic energy grow with the number of dislocations. With
/// fewer, cells are sheared, so that the stable step of gravity waves is shorter.
EdgeChanges edge_changes_of(const State& state, const Mesh& mesh, const Density& density) {
  constexpr double share = 0.05; // of the dislocations
  constexpr double most = 0.02;  // of the generators
  const CvtAction& action = state.action();
  const std::int64_t n = mesh.points.cols();
  std::int64_t both = 0;
  if (state.cursor.times < action.times)
    both = static_cast<std::int64_t>(
        std::ceil(std::min(share * dislocations(mesh, density), most * static_cast<double>(n))));
  return {both + std::max<std::int64_t>(action.cells - n, 0),
          both + std::max<std::int64_t>(n - action.cells, 0), state.fixed};
}

std::int64_t missing_cells(const State& state) {
  return std::abs(state.points.cols() - state.action().cells);
}

/// Whether the number of generators is far from that of the level's end, as at a start from points
/// that were given: rounds change it first, after descents of a few evaluations.
bool is_far(const State& state) {
  constexpr std::int64_t part = 20, few = 10;
  return missing_cells(state) > std::max(state.action().cells / part, few);
}

/// Whether further rounds may bring the number of generators to that of the level's end. Between
/// generators that stay there may be no edge left to split or to collapse.
bool may_come_nearer(const Cursor& cursor) {
  constexpr int most = 20;
  return cursor.idle < most;
}

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
         last_accepted(state).shape_excess < reachable_excess;
}

bool inserts(const State& state) {
  return std::ranges::any_of(state.report.actions,
                             [](const CvtAction& action) { return action.kind == Kind::insert; });
}

/// Coarser levels, where rounds are cheap, have more of them.
int rounds_of_level(int bisections_left, const CvtOptions& options) {
  constexpr int most = 14;
  return std::min(options.insertion_rounds * (bisections_left + 1),
                  std::max(options.insertion_rounds, most));
}

/// The number of generators at the end of a level of a run with insertion.
std::int64_t cells_of_level(const Surface& surface, std::int64_t cells, int bisections_left) {
  for (int k = 0; k < bisections_left; ++k)
    cells = halved(surface, cells);
  return cells;
}

/// The end of all descents of a run with insertion but the last.
void set_early(CvtAction& action) {
  constexpr int most = 75;
  constexpr double tolerance = 1e-3;
  action.tolerance =
      action.norm == Norm::l2_scaled ? std::max(tolerance, action.tolerance) : tolerance;
  action.norm = Norm::l2_scaled;
  action.max_iterations = std::min(action.max_iterations, most);
}

/// One time more of the action at the cursor.
void count_action(State& state) {
  std::vector<CvtDone>& done = state.report.done;
  done.resize(static_cast<std::size_t>(state.cursor.action) + 1);
  ++done.back().times;
}

void begin_descent(State& state) {
  state.memory = {};
  state.report.converged = false;
}

Level begin_level(State& state, const CvtOptions& options, const Mesh& mesh) {
  const std::int64_t cells =
      inserts(state) ? state.action().cells : bisected(mesh.surface, mesh.points.cols());
  return set_bisected(state, mesh, options.density, cells);
}

/// The descent of the last round of a run's last level is that of Kind::converge.
Level begin_round(State& state, const CvtOptions& options, const Mesh& mesh, int count) {
  Cursor& cursor = state.cursor;
  const std::int64_t before = missing_cells(state);
  const bool counts = !is_far(state) || !may_come_nearer(cursor);
  Level level = set_split_and_collapsed(state, mesh, options.density,
                                        edge_changes_of(state, mesh, options.density));
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
  constexpr double factor = 60; // of an excess squared, in units of a cell's energy
  const CvtIteration& last = state.report.iterations.back();
  state.polish = {.penalty = factor * last.energy / static_cast<double>(last.cells),
                  .demanded_spacing = spacing_of(last),
                  .descended =
                      state.report.converged || state.cursor.glides > 0}; // which need convergence
}

void begin_raised(State& state) {
  constexpr double factor = 4;
  state.polish.penalty *= factor;
  ++state.cursor.times;
}

constexpr std::int64_t flat_from = 2000; // generators

/// Whether cells of the sphere are flat, and a density nearly linear between generators: there are
/// many, and the widest cells, whose area goes as rho^(-1/2), are within 15 degrees. Where the
/// density is 0, cells are of any width.
bool is_resolved(const State& state, const Surface& surface, const Density& density) {
  constexpr Eigen::Index most_samples = 4096;
  constexpr double widest = 0.25;
  const Eigen::Index n = state.points.cols();
  if (!surface.is_sphere() || n < flat_from)
    return false;
  const Eigen::Index stride = (n + most_samples - 1) / most_samples;
  Points3 samples(3, (n + stride - 1) / stride);
  for (Eigen::Index k = 0; k < samples.cols(); ++k)
    samples.col(k) = state.points.col(k * stride);
  const DoubleVector area = evaluate(density, samples).cwiseSqrt().cwiseInverse();
  const double mean = area.mean() * static_cast<double>(n) / surface.area();
  return std::isfinite(mean) && area.maxCoeff() <= widest * widest * mean;
}

} // namespace

const CvtIteration& last_accepted(const State& state) {
  const std::vector<CvtIteration>& all = state.report.iterations;
  return *std::find_if(all.rbegin(), all.rend() - 1,
                       [](const CvtIteration& iteration) { return iteration.accepted; });
}

bool creeps(const State& state, const CvtOptions& options) {
  constexpr int with_descent = 1; // glide after which the descent goes on
  constexpr double progress = 0.5;
  // After insertion only dislocations are out of balance; other starts are so everywhere.
  const int window = inserts(state) ? 6 : 45;
  if (!options.well_centred || options.norm == Norm::none || state.in_polish())
    return false;
  if (state.cursor.glides > with_descent)
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
  return before < std::numeric_limits<double>::infinity() && now > progress * before;
}

bool has_stalled(const State& state) {
  constexpr int window = 10;
  constexpr double progress = 0.95;
  if (!state.in_polish() || state.memory.iterations < 2 * window)
    return false;
  const auto end = state.report.iterations.end() - window;
  double before = std::numeric_limits<double>::infinity();
  for (auto i = end + window - state.memory.iterations; i != end; ++i)
    if (i->accepted)
      before = std::min(before, i->shape_excess);
  return last_accepted(state).shape_excess > progress * before;
}

std::vector<CvtAction> actions_of(const Surface& surface, std::int64_t first,
                                  const CvtOptions& options) {
  constexpr int most_in_polish = 60, most_raised = 2;
  const bool inserts = options.insertion_rounds > 0, counted = options.norm == Norm::none;
  const CvtAction last{.norm = options.norm,
                       .tolerance = counted ? 0 : options.tolerance,
                       .max_iterations = options.max_iterations};
  CvtAction early = last;
  if (inserts && !counted)
    set_early(early);
  std::vector<CvtAction> actions;
  const auto add = [&](Kind kind, CvtAction action, std::int64_t cells, int times = 1) {
    action.kind = kind;
    action.cells = cells;
    action.times = times;
    actions.push_back(action);
  };
  for (int left = options.bisections; left >= 0; --left) {
    const std::int64_t cells = inserts ? cells_of_level(surface, options.cells, left) : first;
    add(left == options.bisections ? Kind::start : Kind::bisect, early, cells);
    if (inserts)
      add(Kind::insert, early, cells, rounds_of_level(left, options));
    if (left > 0)
      first = bisected(surface, first);
  }
  const std::int64_t cells = actions.back().cells;
  if (inserts)
    add(Kind::converge, last, cells);
  if (options.well_centred) {
    const CvtAction polish{.norm = options.norm, .tolerance = 0, .max_iterations = most_in_polish};
    add(Kind::polish, polish, cells);
    add(Kind::raise, polish, cells, most_raised);
  }
  return actions;
}

std::optional<Cursor> next_of(const State& state) {
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
  constexpr int most = 4;
  return !state.in_polish() && state.report.converged && state.cursor.glides < most &&
         kind_after(state, state.cursor) == Kind::polish;
}

ShapeLimits limits_of_glide(const State& state) {
  constexpr int within = 3;
  return state.cursor.glides < within ? early_glide_limits() : shape_limits;
}

CvtOptions options_of_descent(const State& state, const Surface& surface,
                              const CvtOptions& options) {
  constexpr double fine = 1e-5;
  const CvtAction& action = state.action();
  CvtOptions here = options;
  here.norm = action.norm;
  here.tolerance = action.tolerance;
  here.max_iterations = action.max_iterations;
  if (!state.in_polish() && (!inserts(state) || action.norm == Norm::none))
    return here;
  if (is_resolved(state, surface, options.density))
    here.rule = rule_at_sites;
  if (state.in_polish()) {
    here.method = Method::lbfgs;
    return here;
  }
  const bool last = action.kind == Kind::converge, fine_level = state.points.cols() >= flat_from;
  if (here.method == Method::automatic && fine_level && (!last || options.well_centred))
    here.method = Method::lbfgs; // descents are short, and a graph Laplacian takes as long as five
                                 // evaluations to make
  if (last) {
    here.final_rule = action.tolerance < fine ? options.final_rule : options.rule;
    return here;
  }
  here.well_centred = false; // its end by creeping is for the last descent
  here.final_rule = here.rule;
  constexpr int few = 8;
  const bool further = action.kind != Kind::insert || is_due(state, state.cursor);
  if (further && is_far(state))
    here.max_iterations = std::min(here.max_iterations, few);
  return here;
}

void add_done(State& state) {
  CvtDone& done = state.report.done.back();
  done.iterations += state.memory.iterations;
  done.cells = state.points.cols();
}

Level begin_action(State& state, const Cursor& cursor, const Surface& surface,
                   const CvtOptions& options, std::optional<Connectivity>&& known) {
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
  Level level = kind == Kind::bisect ? begin_level(state, options, mesh)
                                     : begin_round(state, options, mesh, count);
  state.site_of_input.clear();
  return level;
}

} // namespace calotte::cvt_detail
