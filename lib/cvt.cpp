// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>

#include "clock.h"
#include "moments.h"
#include "parallel.h"
#include "points.h"
#include "sites.h"
#include "tessellation.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>

namespace calotte {
namespace detail {
namespace {

void require(const CvtOptions& options) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorCode::bad_option, what); };
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    refuse("the tolerance must be positive");
  if (options.max_iterations < 0)
    refuse("the number of iterations must not be negative");
  if (options.bisections < 0)
    refuse("the number of bisections must not be negative");
  if (options.triangle_divisions < 1)
    refuse("triangle_divisions must be at least 1");
  quadrature_rule(options.rule);
  quadrature_rule(options.final_rule);
  evaluate(options.density, Points3(Eigen::Vector3d::UnitZ())); // says what is wrong with it
}

/// What the step of one generator adds to an iteration's sums.
struct SiteStep {
  double energy;
  double square; ///< of the distance moved
  double slope;  ///< square of the gradient
};

/// Refuses a state that no run has left.
void require(const CvtState& state) {
  const auto n = static_cast<std::size_t>(state.points.cols());
  std::vector<std::uint8_t> seen(n, 0);
  bool good = n >= 12 && state.id.size() == n && state.bisections_left >= 0 &&
              state.iterations_of_level >= 0 &&
              ((state.points.colwise().squaredNorm().array() - 1).abs() < 1e-12).all();
  for (std::size_t i = 0; good && i < n; ++i) {
    const std::int32_t id = state.id[i];
    good = id >= 0 && static_cast<std::size_t>(id) < n && seen[static_cast<std::size_t>(id)]++ == 0;
  }
  for (const std::int32_t site : state.site_of_input)
    good = good && site >= 0 && static_cast<std::size_t>(site) < n;
  if (!good)
    throw Error(ErrorCode::bad_option, "the state is not one that a run has left: its points must "
                                       "be unit vectors and its ids a permutation");
}

/// Sums of blocks of sites, added in the order of the blocks: the same for any number of threads.
void add_sums(const Array<SiteStep>& steps, CvtIteration& iteration) {
  const std::int64_t n = steps.size();
  std::vector<SiteStep> sums(static_cast<std::size_t>(block_count(n)));
  std::vector<double> largest(sums.size(), 0);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    SiteStep sum{0, 0, 0};
    double most = 0;
    for (std::int64_t i = begin; i != end; ++i) {
      sum.energy += steps[i].energy;
      sum.square += steps[i].square;
      sum.slope += steps[i].slope;
      most = std::max(most, steps[i].square);
    }
    sums[static_cast<std::size_t>(block)] = sum;
    largest[static_cast<std::size_t>(block)] = most;
  });
  SiteStep total{0, 0, 0};
  for (const SiteStep& sum : sums)
    total = {total.energy + sum.energy, total.square + sum.square, total.slope + sum.slope};
  iteration.energy = total.energy;
  iteration.l2 = std::sqrt(total.square / static_cast<double>(n));
  iteration.linf = std::sqrt(*std::max_element(largest.begin(), largest.end()));
  iteration.gradient = std::sqrt(total.slope);
}

/// Lloyd's step of a generator x: to the constrained centroid M/|M|. False where that is none.
bool lloyd_step(const Vec3& x, const CellMoments& cell, Vec3& centroid, SiteStep& step) {
  const double length = norm(cell.first);
  if (!(length > 0) || !std::isfinite(length))
    return false;
  centroid = (1 / length) * cell.first;
  const Vec3 apart = centroid - x, tangent = cell.first - dot(cell.first, x) * x;
  step = {cell.energy, dot(apart, apart), 4 * dot(tangent, tangent)};
  return true;
}

/// One Lloyd step of all generators, from points to next.
CvtIteration lloyd_iteration(Tessellation& tessellation, const Points3& points,
                             const Integrand& integrand, Points3& next, Array<SiteStep>& steps) {
  Clock::time_point mark = Clock::now();
  std::atomic<bool> failed = false;
  const Tessellation::Effort effort = tessellation.evaluate(
      points, integrand,
      [&](const Patch& patch, const Array<Vec3>& x, const Array<CellMoments>& moments) {
        for (std::int32_t i = 0; i < patch.owned; ++i) {
          const std::int32_t site = patch.sites[static_cast<std::size_t>(i)];
          Vec3 centroid{0, 0, 0};
          if (!lloyd_step(x[i], moments[i], centroid, steps[site]))
            failed.store(true, std::memory_order_relaxed);
          set_column(next, site, centroid);
        }
      });
  if (failed)
    throw Error(ErrorCode::bad_option,
                "the density is infinite or zero over a whole cell: make it positive everywhere");
  CvtIteration iteration;
  iteration.cells = points.cols();
  iteration.flips = effort.flips;
  iteration.rebuilt = effort.rebuilt;
  iteration.seconds_exchange = effort.seconds_exchange;
  iteration.seconds_repair = effort.seconds_repair;
  iteration.seconds_moments = effort.seconds_moments;
  add_sums(steps, iteration);
  tessellation.moved(iteration.linf);
  iteration.seconds = lap(mark);
  return iteration;
}

double residual(const CvtIteration& iteration, Norm norm, std::int64_t n) {
  const double h = std::sqrt(4 * std::numbers::pi / static_cast<double>(n));
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

/// Takes an iteration into the state: its norm, and what follows from it.
void conclude(CvtState& state, const CvtOptions& options, const CvtIteration& iteration) {
  CvtReport& report = state.report;
  const bool final_rule = state.final_rule || options.density.uniform();
  report.iterations.push_back(iteration);
  report.residual = residual(iteration, options.norm, iteration.cells);
  ++state.iterations_of_level;
  // Near the end the finer rule takes over; only with it a run can converge.
  if (options.norm == Norm::none) {
    report.converged = state.iterations_of_level == options.max_iterations;
  } else {
    report.converged = final_rule && report.residual <= options.tolerance;
    state.final_rule = state.final_rule || report.residual <= 10 * options.tolerance;
  }
}

/// Lloyd's steps of one level; true when `stop` ended them.
bool iterate(CvtState& state, const CvtOptions& options, const CvtStop& stop) {
  CvtReport& report = state.report;
  const std::int64_t n = state.points.cols();
  Tessellation tessellation(state.points, options.partition);
  const Integrand coarse =
                      make_integrand(options.density, options.rule, options.triangle_divisions),
                  fine = make_integrand(options.density, options.final_rule,
                                        options.triangle_divisions);
  Points3 next(3, n);
  Array<SiteStep> steps(n);
  bool stopped = false;
  while (!stopped && !report.converged && state.iterations_of_level < options.max_iterations) {
    const double before = report.seconds;
    Clock::time_point mark = Clock::now();
    CvtIteration iteration =
        lloyd_iteration(tessellation, state.points, state.final_rule ? fine : coarse, next, steps);
    if (!options.density.uniform())
      iteration.rule = state.final_rule ? options.final_rule : options.rule;
    state.points.swap(next);
    conclude(state, options, iteration);
    report.seconds = before + lap(mark);
    stopped = stop && stop(state);
  }
  report.regions = tessellation.regions();
  return stopped;
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
  state.report.converged = false;
}

} // namespace
} // namespace detail

Cvt cvt(CvtState state, const CvtOptions& options, const CvtStop& stop) {
  detail::require(options);
  detail::require(state);
  detail::Clock::time_point mark = detail::Clock::now();
  const double before = state.report.seconds;
  while (!detail::iterate(state, options, stop) && state.bisections_left > 0)
    detail::refine(state);
  Cvt result;
  result.mesh = delaunay(detail::in_order(state));
  if (!state.site_of_input.empty())
    result.mesh.site_of_input = state.site_of_input;
  result.report = std::move(state.report);
  result.report.seconds = before + detail::lap(mark);
  return result;
}

Cvt cvt(const Points3& start, const CvtOptions& options, const CvtStop& stop) {
  detail::require(options);
  return cvt(detail::begin(start, options), options, stop);
}

} // namespace calotte
