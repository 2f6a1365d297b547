// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/descent.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/vector_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace calotte::cvt_detail {
namespace {

constexpr std::size_t most_pairs = 10;
constexpr int most_trials = 3;
constexpr double rule_error =
    1e-7; ///< of the energy by quadrature; for smaller differences the slopes decide
constexpr double rounding = 1e-13;  ///< relative, of the energy
constexpr int laplacian_lasts = 60; ///< evaluations, once edges have flipped
constexpr double near_enough =
    0.05; ///< rms distance from the centroids over h; below it the Laplacian is used

double scaled_l2(const CvtIteration& iteration) { return iteration.l2 / iteration.spacing; }

} // namespace

Descent::Descent(State& state, const CvtOptions& options, Functional& functional)
    : state_(state), options_(options), functional_(functional), density_(options.density) {}

/// Far from an optimum edges flip in every step, and no Laplacian stays valid.
Method Descent::method() const {
  if (options_.method != Method::automatic)
    return options_.method;
  return scaled_l2(here_.iteration) > near_enough ? Method::lbfgs : Method::lbfgs_laplacian;
}

void Descent::evaluate(const Points3& points, Evaluation& out) {
  functional_.evaluate(points, state_.final_rule, options_.method != Method::lloyd, out);
  state_.report.iterations.push_back(out.iteration);
  ++state_.iterations_of_level;
  ++state_.memory.since_laplacian;
  state_.memory.flipped = state_.memory.flipped || out.iteration.flips > 0 || out.iteration.rebuilt;
}

void Descent::begin() {
  if (state_.iterations_of_level == 0) {
    evaluate(state_.points, here_);
    return;
  }
  const bool final_rule = state_.report.iterations.back().rule == options_.final_rule;
  functional_.evaluate(state_.points, final_rule, options_.method != Method::lloyd, here_);
  if (state_.memory.laplacian_at.cols() > 0)
    laplacian_.emplace(functional_.laplacian(state_.memory.laplacian_at));
}

void Descent::step() {
  const bool other_rule = !options_.density.uniform() && state_.final_rule &&
                          here_.iteration.rule != options_.final_rule;
  if (options_.method == Method::lloyd && options_.relaxation == 1)
    lloyd_step();
  else if (other_rule) // another functional, whose energies do not compare
    evaluate(state_.points, here_);
  else if (options_.method == Method::lloyd)
    relaxed_step();
  else if (options_.method == Method::nesterov)
    nesterov_step();
  else
    quasi_newton_step();
}

/// Moves the state to the points that have been evaluated last.
void Descent::accept(Points3&& points) {
  state_.points = std::move(points);
  std::swap(here_, there_);
}

void Descent::lloyd_step() {
  std::swap(state_.points, here_.centroids);
  evaluate(state_.points, here_);
}

void Descent::relaxed_step() {
  const Points3 move = difference(here_.centroids, state_.points);
  step_or_lloyd(functional_.retract(state_.points, options_.relaxation, move));
}

/// Moves to the points unless their energy is higher; otherwise takes Lloyd's step and returns
/// false.
bool Descent::step_or_lloyd(Points3&& next) {
  evaluate(next, there_);
  const bool lower = there_.iteration.energy <= here_.iteration.energy * (1 + rounding);
  if (!lower) {
    state_.report.iterations.back().accepted = false;
    next = here_.centroids;
    evaluate(next, there_);
  }
  accept(std::move(next));
  return lower;
}

/// Nesterov's sequence (1983) over Lloyd's map. It restarts when the step reverses its direction
/// (O'Donoghue and Candes, 2015) or raises the energy.
void Descent::nesterov_step() {
  Memory& memory = state_.memory;
  Points3 next = here_.centroids;
  double share = 0;
  if (memory.before.cols() == next.cols()) {
    const double momentum = (1 + std::sqrt(1 + 4 * memory.momentum * memory.momentum)) / 2;
    const Points3 move = difference(next, memory.before);
    const bool onward = inner(difference(next, state_.points), move) >= 0;
    share = onward ? (memory.momentum - 1) / momentum : 0;
    memory.momentum = onward ? momentum : 1;
    if (share > 0)
      next = functional_.retract(next, share, move);
  }
  memory.before = here_.centroids;
  if (share == 0)
    lloyd_step();
  else if (!step_or_lloyd(std::move(next)))
    memory.momentum = 1;
}

// ---- L-BFGS (Nocedal, 1980; Liu and Nocedal, 1989); on the sphere of ambient vectors, projected
// to the tangent planes where they are used

void Descent::forget() {
  Memory& memory = state_.memory;
  memory.steps.clear();
  memory.changes.clear();
  memory.curvatures.clear();
  memory.stride = 1;
}

void Descent::make_laplacian() {
  Memory& memory = state_.memory;
  if (laplacian_ && !(memory.since_laplacian >= laplacian_lasts && memory.flipped))
    return;
  memory.laplacian_at = state_.points;
  memory.since_laplacian = 0;
  memory.flipped = false;
  laplacian_.emplace(functional_.laplacian(memory.laplacian_at));
  forget();
}

/// Multiplies by the initial inverse of the second derivative: that of the graph Laplacian, whose
/// scale is right; or of twice the masses, times a factor with which it agrees with the last step
/// and the change of the gradient along it.
void Descent::precondition(Points3& vectors) {
  if (method() == Method::lbfgs_laplacian) {
    vectors = laplacian_->solve(std::move(vectors));
    return;
  }
  const Memory& memory = state_.memory;
  double factor = 1;
  if (!memory.steps.empty()) {
    Points3 change = expanded(memory.changes.back());
    functional_.make_tangential(change, state_.points);
    divide_by_masses(change);
    factor = memory.curvatures.back() / inner(memory.changes.back(), change);
  }
  divide_by_masses(vectors);
  multiply(vectors, factor);
}

/// Divides each vector by twice its cell's mass.
void Descent::divide_by_masses(Points3& vectors) const {
  for_each_block(vectors.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      set_column(vectors, i, (0.5 / here_.mass[i]) * column(vectors, i));
  });
}

/// Minus the inverse of the approximate second derivative, times the gradient.
Points3 Descent::direction() {
  const Memory& memory = state_.memory;
  const std::size_t pairs = memory.steps.size();
  Points3 d = here_.gradient;
  std::vector<double> shares(pairs);
  double product = pairs == 0 ? 0 : inner(memory.steps.back(), d); // of d with the next vector
  for (std::size_t k = pairs; k-- > 0;) {
    shares[k] = product / memory.curvatures[k];
    if (k > 0)
      product = inner_of_sum(d, -shares[k], memory.changes[k], memory.steps[k - 1]);
    else
      add(d, -shares[k], memory.changes[k]);
  }
  functional_.make_tangential(d, state_.points);
  precondition(d);
  functional_.make_tangential(d, state_.points);
  product = pairs == 0 ? 0 : inner(memory.changes.front(), d);
  for (std::size_t k = 0; k < pairs; ++k) {
    const double share = shares[k] - product / memory.curvatures[k];
    if (k + 1 < pairs)
      product = inner_of_sum(d, share, memory.steps[k], memory.changes[k + 1]);
    else
      add(d, share, memory.steps[k]);
  }
  functional_.make_tangential(d, state_.points);
  multiply(d, -1);
  return d;
}

/// The step that limits the motion of each generator to half of its cell's width, the root of mass
/// over density.
double Descent::longest_step(const Points3& direction) const {
  std::vector<double> most(static_cast<std::size_t>(block_count(direction.cols())), 0);
  for_each_block(direction.cols(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    constexpr std::int64_t batch = 64;
    std::array<std::array<double, batch>, 3> x;
    std::array<double, batch> rho;
    double& here = most[static_cast<std::size_t>(block)];
    for (std::int64_t first = begin; first < end; first += batch) {
      const auto count = static_cast<std::size_t>(std::min(batch, end - first));
      for (std::size_t j = 0; j < count; ++j)
        for (std::size_t c = 0; c < 3; ++c)
          x[c][j] =
              state_.points(static_cast<Eigen::Index>(c), first + static_cast<std::int64_t>(j));
      const auto row = [&](auto& values) { return std::span(values).first(count); };
      density_(row(x[0]), row(x[1]), row(x[2]), row(rho));
      for (std::size_t j = 0; j < count; ++j) {
        const std::int64_t i = first + static_cast<std::int64_t>(j);
        const Vec3& d = column(direction, i);
        here = std::max(here, dot(d, d) * rho[j] / here_.mass[i]);
      }
    }
  });
  return 0.5 / std::sqrt(*std::max_element(most.begin(), most.end()));
}

/// Line search. It accepts a trial if its energy is lower and it is not far beyond the minimum, or,
/// if the energies differ by less than quadrature resolves, if the slopes satisfy conditions like
/// the approximate Wolfe conditions of Hager and Zhang (2005). The next trial follows from the
/// secant of the slopes. Returns false if no trial is accepted.
///
/// The first trial is the full step, but for a while after a search that has shortened it: where
/// edges flip in steep widths, every full step would be rejected.
/// \param points set to the accepted ones.
bool Descent::search(const Points3& direction, double slope, Points3& points) {
  constexpr double growth = 1.4;
  Memory& memory = state_.memory;
  double step = std::min(memory.stride, longest_step(direction));
  for (int trial = 0; trial < most_trials; ++trial) {
    points = functional_.retract(state_.points, step, direction);
    evaluate(points, there_);
    Points3 onward = direction;
    functional_.make_tangential(onward, points);
    const double slope_there = inner(onward, there_.gradient);
    const double rise = there_.value() / here_.value() - 1;
    const bool lower =
        rise <= rounding && (slope_there <= -0.9 * slope || trial + 1 == most_trials);
    const bool below_rule = !options_.density.uniform() && std::abs(rise) <= rule_error &&
                            std::abs(slope_there) <= -0.5 * slope;
    if (lower || below_rule) {
      memory.stride = std::min(1.0, trial == 0 ? growth * memory.stride : step);
      return true;
    }
    state_.report.iterations.back().accepted = false;
    const double secant = step * slope / (slope - slope_there);
    step = secant > 0.1 * step ? std::min(secant, 4 * step) : 0.1 * step;
  }
  return false;
}

/// Stores the step from the state's points to `points`, which have been evaluated, as an L-BFGS
/// pair.
void Descent::remember(const Points3& points) {
  Points3 before = here_.gradient;
  functional_.make_tangential(before, points);
  Points3 step = difference(points, state_.points), change = difference(there_.gradient, before);
  const double curvature = inner(step, change);
  const double square = inner(step, step), square_of_change = inner(change, change);
  if (!(curvature > 1e-14 * std::sqrt(square * square_of_change))) {
    forget();
    return;
  }
  Memory& memory = state_.memory;
  if (memory.steps.size() == most_pairs) {
    memory.steps.erase(memory.steps.begin());
    memory.changes.erase(memory.changes.begin());
    memory.curvatures.erase(memory.curvatures.begin());
  }
  memory.steps.push_back(compacted(step, square));
  memory.changes.push_back(compacted(change, square_of_change));
  memory.curvatures.push_back(curvature);
}

void Descent::quasi_newton_step() {
  Clock::time_point mark = Clock::now();
  if (method() == Method::lbfgs_laplacian)
    make_laplacian();
  const Points3 d = direction();
  const double slope = inner(d, here_.gradient), seconds = lap(mark);
  const std::size_t first = state_.report.iterations.size();
  Points3 points;
  if (slope < 0 && search(d, slope, points)) {
    remember(points);
  } else if (state_.penalty > 0) { // a Lloyd step may raise the penalty
    state_.stuck = state_.memory.steps.empty();
    forget();
    return;
  } else { // Lloyd's step always descends; the coarser rule's energy may have misled the search
    forget();
    state_.final_rule = state_.final_rule || options_.norm != Norm::none;
    points = here_.centroids;
    evaluate(points, there_);
    // A density that is linear between the generators moves with them.
    const bool rose = there_.iteration.energy > (1 + rule_error) * here_.iteration.energy;
    if (here_.iteration.rule == rule_at_sites && rose) {
      state_.report.iterations.back().accepted = false;
      state_.stuck = options_.final_rule == rule_at_sites || options_.norm == Norm::none;
      return;
    }
  }
  state_.report.iterations[first].seconds_solver = seconds;
  accept(std::move(points));
}

} // namespace calotte::cvt_detail
