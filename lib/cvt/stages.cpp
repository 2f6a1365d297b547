// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/stages.h"

#include "cvt/cvt.h"
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

/// A round after a descent of more than 25 evaluations counts for two: where widths are steep, a
/// round takes long and gains less.
int count_of_round(const State& state) {
  constexpr int steep = 25;
  return state.iterations_of_level > steep ? 2 : 1;
}

/// The edges of a round: a twentieth of the dislocations that the density demands while rounds are
/// left, and the difference to the number of cells. Half of them give less energy, but the errors
/// of a model's vorticity, divergence and kinetic energy grow with the number of dislocations. With
/// fewer, cells are sheared, so that the stable step of gravity waves is shorter.
EdgeChanges edge_changes_of(const State& state, const Mesh& mesh, const Density& density,
                            std::int64_t cells) {
  constexpr double share = 0.05; // of the dislocations
  constexpr double most = 0.02;  // of the generators
  const std::int64_t n = mesh.points.cols();
  std::int64_t both = 0;
  if (state.rounds_left > 0)
    both = static_cast<std::int64_t>(
        std::ceil(std::min(share * dislocations(mesh, density), most * static_cast<double>(n))));
  return {both + std::max<std::int64_t>(cells - n, 0), both + std::max<std::int64_t>(n - cells, 0),
          state.fixed};
}

/// Whether the number of generators is far from that of the level's end, as at a start from points
/// that were given: rounds change it first, after descents of a few evaluations.
bool is_far(const State& state, const Surface& surface, const CvtOptions& options) {
  constexpr std::int64_t part = 20, few = 10;
  const std::int64_t cells = cells_of_level(surface, options.cells, state.bisections_left);
  return std::abs(state.points.cols() - cells) > std::max(cells / part, few);
}

/// Whether further rounds may bring the number of generators to that of the level's end. Between
/// generators that stay there may be no edge left to split or to collapse.
bool may_come_nearer(const State& state) {
  constexpr int most = 20;
  return state.idle_rounds < most;
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

std::int64_t cells_of_level(const Surface& surface, std::int64_t cells, int bisections_left) {
  for (int k = 0; k < bisections_left; ++k)
    cells = halved(surface, cells);
  return cells;
}

const CvtIteration& last_accepted(const State& state) {
  const std::vector<CvtIteration>& all = state.report.iterations;
  return *std::find_if(all.rbegin(), all.rend() - 1,
                       [](const CvtIteration& iteration) { return iteration.accepted; });
}

bool creeps(const State& state, const CvtOptions& options) {
  constexpr int with_descent = 1; // glide after which the descent goes on
  constexpr double progress = 0.5;
  // After insertion only dislocations are out of balance; other starts are so everywhere.
  const int window = options.insertion_rounds > 0 ? 6 : 45;
  if (!options.well_centred || options.norm == Norm::none || state.penalty > 0)
    return false;
  if (state.glides > with_descent)
    return true;
  if (state.since_restart <= window)
    return false;
  const std::vector<CvtIteration>& all = state.report.iterations;
  double before = std::numeric_limits<double>::infinity(), now = before;
  for (std::ptrdiff_t k = 1; k <= state.since_restart; ++k) {
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
  if (state.penalty == 0 || state.iterations_of_level < 2 * window)
    return false;
  const auto end = state.report.iterations.end() - window;
  double before = std::numeric_limits<double>::infinity();
  for (auto i = end + window - state.iterations_of_level; i != end; ++i)
    if (i->accepted)
      before = std::min(before, i->shape_excess);
  return last_accepted(state).shape_excess > progress * before;
}

Stage stage_after(const State& state, const CvtOptions& options) {
  constexpr int most_raised = 2;
  const bool inserts = options.insertion_rounds > 0, in_polish = state.penalty > 0;
  // A round may find too few edges for all generators that are missing; then there is another.
  if (inserts && !in_polish &&
      (state.rounds_left > 0 || (state.bisections_left == 0 &&
                                 state.points.cols() != options.cells && may_come_nearer(state))))
    return Stage::insert;
  if (state.bisections_left > 0)
    return Stage::bisect;
  if (options.well_centred && !in_polish)
    return Stage::polish;
  const bool fell_short = in_polish && !state.report.converged;
  if (fell_short && state.raised < most_raised &&
      last_accepted(state).shape_excess < reachable_excess)
    return Stage::raise;
  return Stage::end;
}

bool may_glide(const State& state, const CvtOptions& options) {
  constexpr int most = 4;
  return options.well_centred && state.penalty == 0 && state.report.converged &&
         state.glides < most && stage_after(state, options) == Stage::polish;
}

ShapeLimits limits_of_glide(const State& state) {
  constexpr int within = 3;
  return state.glides < within ? early_glide_limits() : shape_limits;
}

CvtOptions early(const CvtOptions& options) {
  constexpr int most = 75;
  constexpr double tolerance = 1e-3;
  CvtOptions here = options;
  here.tolerance =
      options.norm == Norm::l2_scaled ? std::max(tolerance, options.tolerance) : tolerance;
  here.norm = Norm::l2_scaled;
  here.well_centred = false; // its end by creeping is for the last descent
  here.max_iterations = std::min(options.max_iterations, most);
  return here;
}

CvtOptions options_of_descent(const State& state, const Surface& surface,
                              const CvtOptions& options) {
  constexpr int most_in_polish = 60;
  constexpr double fine = 1e-5;
  CvtOptions here = options;
  if (state.penalty > 0) {
    here.method = Method::lbfgs;
    here.max_iterations = most_in_polish;
    if (is_resolved(state, surface, options.density))
      here.rule = rule_at_sites;
    return here;
  }
  if (options.insertion_rounds == 0 || options.norm == Norm::none)
    return here;
  const Stage next = stage_after(state, options);
  const bool last = next != Stage::insert && next != Stage::bisect,
             fine_level = state.points.cols() >= flat_from;
  if (is_resolved(state, surface, options.density))
    here.rule = rule_at_sites;
  if (here.method == Method::automatic && fine_level && (!last || options.well_centred))
    here.method = Method::lbfgs; // descents are short, and a graph Laplacian takes as long as five
                                 // evaluations to make
  if (last) {
    here.final_rule = options.tolerance < fine ? options.final_rule : options.rule;
    return here;
  }
  constexpr int few = 8;
  here = early(here);
  here.final_rule = here.rule;
  if (next == Stage::insert && is_far(state, surface, options))
    here.max_iterations = std::min(here.max_iterations, few);
  return here;
}

std::vector<CvtLevel> levels_of(const Surface& surface, std::int64_t first, int bisections,
                                const CvtOptions& options) {
  const bool inserts = options.insertion_rounds > 0, counted = options.norm == Norm::none;
  const CvtOptions here = inserts && !counted ? early(options) : options;
  std::vector<CvtLevel> levels;
  for (int left = bisections; left >= 0; --left) {
    levels.push_back({inserts ? cells_of_level(surface, options.cells, left) : first,
                      inserts ? rounds_of_level(left, options) : 0, counted ? 0 : here.tolerance,
                      here.max_iterations});
    if (left > 0)
      first = bisected(surface, first);
  }
  return levels;
}

void begin_descent(State& state) {
  state.memory = {};
  state.iterations_of_level = 0;
  state.since_restart = 0;
  state.final_rule = false;
  state.stuck = false;
  state.report.converged = false;
}

Level begin_level(State& state, const CvtOptions& options, const Mesh& mesh) {
  --state.bisections_left;
  const std::int64_t cells =
      options.insertion_rounds > 0
          ? cells_of_level(mesh.surface, options.cells, state.bisections_left)
          : bisected(mesh.surface, mesh.points.cols());
  Level level = set_bisected(state, mesh, options.density, cells);
  state.rounds_left = rounds_of_level(state.bisections_left, options);
  state.idle_rounds = 0;
  state.site_of_input.clear();
  begin_descent(state);
  return level;
}

Level begin_round(State& state, const CvtOptions& options, const Mesh& mesh) {
  const std::int64_t cells = cells_of_level(mesh.surface, options.cells, state.bisections_left);
  const auto apart = [&] { return std::abs(state.points.cols() - cells); };
  const bool counts = !is_far(state, mesh.surface, options) || !may_come_nearer(state);
  const std::int64_t before = apart();
  Level level = set_split_and_collapsed(state, mesh, options.density,
                                        edge_changes_of(state, mesh, options.density, cells));
  if (before > 0 && apart() >= before && may_come_nearer(state))
    ++state.idle_rounds;
  if (counts)
    state.rounds_left = std::max(state.rounds_left - count_of_round(state), 0);
  state.site_of_input.clear();
  begin_descent(state);
  return level;
}

void begin_polish(State& state) {
  constexpr double factor = 60; // of an excess squared, in units of a cell's energy
  const CvtIteration& last = state.report.iterations.back();
  state.penalty = factor * last.energy / static_cast<double>(last.cells);
  state.demanded_spacing = spacing_of(last);
  state.descended = state.report.converged || state.glides > 0; // which need convergence
  begin_descent(state);
}

void begin_raised(State& state) {
  constexpr double factor = 4;
  state.penalty *= factor;
  ++state.raised;
  begin_descent(state);
}

} // namespace calotte::cvt_detail
