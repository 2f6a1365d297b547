// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>

#include "clock.h"
#include "counts.h"
#include "descent.h"
#include "functional.h"
#include "sites.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <cmath>
#include <numbers>
#include <string>

namespace calotte {
namespace detail {
namespace {

void require_options(const CvtOptions& options) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorCode::bad_option, what); };
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    refuse("the tolerance is " + std::to_string(options.tolerance) +
           "; give a positive number such as 1e-6");
  if (!(options.relaxation >= 1 && options.relaxation < 2))
    refuse("the relaxation is " + std::to_string(options.relaxation) +
           "; give a number from 1 to below 2");
  if (options.max_iterations < 0)
    refuse("the number of iterations is " + std::to_string(options.max_iterations) +
           "; give 0 or more");
  if (options.bisections < 0)
    refuse("the number of bisections is " + std::to_string(options.bisections) +
           "; give 0 or more");
  if (options.triangle_divisions < 1 || options.triangle_divisions > 100)
    refuse("triangle_divisions is " + std::to_string(options.triangle_divisions) +
           "; give a number from 1 to 100");
  quadrature_rule(options.rule);
  quadrature_rule(options.final_rule);
  evaluate(options.density, Points3(Eigen::Vector3d::UnitZ())); // says what is wrong with it
}

/// Refuses a state that no run has left.
void require_state(const CvtState& state) {
  const auto n = static_cast<std::size_t>(state.points.cols());
  std::vector<std::uint8_t> seen(n, 0);
  bool good = n >= 12 && state.id.size() == n && state.bisections_left >= 0 &&
              state.iterations_of_level >= 0 &&
              ((state.points.colwise().squaredNorm().array() - 1).abs() < 1e-12).all();
  for (std::size_t i = 0; good && i < n; ++i) {
    const std::int32_t id = state.id[i];
    good = id >= 0 && static_cast<std::size_t>(id) < n && seen[static_cast<std::size_t>(id)]++ == 0;
  }
  const CvtMemory& memory = state.memory;
  for (const std::vector<Points3>* list : {&memory.steps, &memory.changes})
    for (const Points3& points : *list)
      good = good && points.cols() == state.points.cols();
  good = good && memory.steps.size() == memory.changes.size() &&
         memory.steps.size() == memory.curvatures.size();
  for (const Points3* points : {&memory.laplacian_at, &memory.before})
    good = good && (points->cols() == 0 || points->cols() == state.points.cols());
  for (const std::int32_t site : state.site_of_input)
    good = good && site >= 0 && static_cast<std::size_t>(site) < n;
  if (!good)
    throw Error(ErrorCode::bad_option, "the state is not one that a run has left: its points must "
                                       "be unit vectors and its ids a permutation");
}

/// Refuses bisections to more generators than a mesh can hold, before any work.
void require_room(const CvtState& state) {
  const std::int64_t n = state.points.cols();
  int most = 0;
  while ((n - 2) << (2 * most + 2) <= most_points - 2)
    ++most;
  if (state.bisections_left > most)
    throw Error(ErrorCode::bad_option,
                std::to_string(state.bisections_left) + " bisections of " + std::to_string(n) +
                    " generators are too many; give at most " + std::to_string(most));
}

/// Takes the evaluation at the state's points into the state: its norm, and what follows from it.
void conclude(CvtState& state, const CvtOptions& options, const CvtIteration& iteration) {
  CvtReport& report = state.report;
  const bool by_final_rule = options.density.uniform() || iteration.rule == options.final_rule;
  report.residual = norm_of(iteration, options.norm);
  // Near the end the finer rule takes over; only with it a run can converge.
  if (options.norm == Norm::none) {
    report.converged = state.iterations_of_level >= options.max_iterations;
  } else {
    report.converged = by_final_rule && report.residual <= options.tolerance;
    state.final_rule = state.final_rule || report.residual <= 10 * options.tolerance;
  }
}

bool level_ended(const CvtState& state, const CvtOptions& options) {
  return state.report.converged || state.iterations_of_level >= options.max_iterations;
}

/// The descent of one level; true when `stop` ended it.
bool iterate(CvtState& state, const CvtOptions& options, const CvtStop& stop) {
  if (level_ended(state, options)) {
    state.report.converged = state.report.converged || options.norm == Norm::none;
    return false;
  }
  const double before = state.report.seconds;
  const Clock::time_point start = Clock::now();
  Functional functional(state.points, options);
  Descent descent(state, options, functional);
  const bool resumed = state.iterations_of_level > 0;
  descent.begin();
  if (resumed)
    descent.step();
  for (;; descent.step()) {
    conclude(state, options, descent.here().iteration);
    const bool ended = level_ended(state, options);
    if (ended)
      state.points = descent.here().centroids;
    Clock::time_point now = start;
    state.report.seconds = before + lap(now);
    const bool stopped = stop && stop(state);
    if (ended || stopped) {
      state.report.regions = functional.regions();
      return stopped;
    }
  }
}

/// The order of the start.
Points3 in_order(const CvtState& state) {
  Points3 points(3, state.points.cols());
  for (Eigen::Index r = 0; r < points.cols(); ++r)
    points.col(state.id[static_cast<std::size_t>(r)]) = state.points.col(r);
  return points;
}

void set_points(CvtState& state, const Sites& sites) {
  const std::int64_t n = sites.size();
  state.points.resize(3, n);
  state.id.resize(static_cast<std::size_t>(n));
  for (std::int64_t r = 0; r < n; ++r) {
    state.points.col(r) << sites.unit[r].x, sites.unit[r].y, sites.unit[r].z;
    state.id[static_cast<std::size_t>(r)] = sites.id[r];
  }
}

CvtState begin(const Points3& start, const CvtOptions& options) {
  Sites sites = make_sites(start, options.partition.duplicates, options.partition.merge_within);
  if (sites.size() < 12)
    throw Error(ErrorCode::too_few_sites, "there are " + std::to_string(sites.size()) +
                                              " distinct generators: give at least 12");
  CvtState state;
  set_points(state, sites);
  state.site_of_input = std::move(sites.site_of_input);
  state.bisections_left = options.bisections;
  return state;
}

/// The next level's start.
void refine(CvtState& state) {
  set_points(state, make_sites(bisect(delaunay(in_order(state))), Duplicates::refuse, 0));
  state.site_of_input.clear();
  --state.bisections_left;
  state.iterations_of_level = 0;
  state.final_rule = false;
  state.memory = {};
  state.report.converged = false;
}

} // namespace
} // namespace detail

double norm_of(const CvtIteration& iteration, Norm norm) {
  const double h = std::sqrt(4 * std::numbers::pi / static_cast<double>(iteration.cells));
  switch (norm) {
  case Norm::l2:
    return iteration.l2;
  case Norm::linf:
    return iteration.linf;
  case Norm::l2_scaled:
    return iteration.l2 / h;
  case Norm::linf_scaled:
    return iteration.linf / h;
  case Norm::gradient:
    return iteration.gradient;
  default:
    return 0;
  }
}

Cvt cvt(CvtState state, const CvtOptions& options, const CvtStop& stop) {
  detail::require_options(options);
  detail::require_state(state);
  detail::require_room(state);
  detail::Clock::time_point mark = detail::Clock::now();
  const double before = state.report.seconds;
  bool stopped = detail::iterate(state, options, stop);
  while (!stopped && state.bisections_left > 0) {
    detail::refine(state);
    stopped = detail::iterate(state, options, stop);
  }
  Cvt result;
  result.mesh = delaunay(detail::in_order(state));
  if (!state.site_of_input.empty())
    result.mesh.site_of_input = state.site_of_input;
  result.report = std::move(state.report);
  result.report.converged = result.report.converged && state.bisections_left == 0;
  result.report.seconds = before + detail::lap(mark);
  return result;
}

Cvt cvt(const Points3& start, const CvtOptions& options, const CvtStop& stop) {
  detail::require_options(options);
  return cvt(detail::begin(start, options), options, stop);
}

} // namespace calotte
