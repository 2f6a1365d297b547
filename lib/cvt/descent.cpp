// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/descent.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/vector_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace calotte::cvt_detail {
namespace {

using base_detail::CompactField;
using base_detail::Part;

constexpr int most_trials = 3;
constexpr double rule_error =
    1e-7; ///< of the energy by quadrature; for smaller differences the slopes decide
constexpr double rounding = 1e-13;  ///< relative, of the energy
constexpr int laplacian_lasts = 60; ///< evaluations, once edges have flipped
constexpr double near_enough =
    0.05; ///< rms distance from the centroids over h; below it the Laplacian is used

/// The number of generators from which on memory is limited.
constexpr std::int64_t short_memory_from = 1'000'000;

/// The number of L-BFGS pairs. With three, descents take some percent more evaluations where edges
/// flip, and no more elsewhere. In a large run each pair takes 24 bytes a generator.
std::size_t most_pairs(std::int64_t generators) { return generators < short_memory_from ? 10 : 3; }

double scaled_l2(const CvtIteration& iteration) { return iteration.l2 / iteration.spacing; }

} // namespace

Descent::Descent(State& state, const DescentOptions& options, const Density& density,
                 Functional& functional)
    : state_(state), options_(options), functional_(functional), density_(density),
      uniform_(density.uniform()) {}

/// Far from an optimum edges flip in every step, and no Laplacian stays valid.
Method Descent::method() const {
  if (options_.method != Method::automatic)
    return options_.method;
  const CvtIteration& here = here_.iteration;
  return scaled_l2(here) > near_enough || here.cells > most_laplacian_rows
             ? Method::lbfgs
             : Method::lbfgs_laplacian;
}

/// Lloyd's method needs no gradient, the others no centroids.
bool Descent::uses_gradients() const { return options_.method != Method::lloyd; }

void Descent::evaluate(const Points3& points, Evaluation& out) {
  functional_.evaluate(points, state_.memory.final_rule, uses_gradients(), out);
  state_.report.iterations.push_back(out.iteration);
  ++state_.memory.iterations;
  ++state_.memory.since_restart;
  ++state_.memory.since_laplacian;
  state_.memory.flipped = state_.memory.flipped || out.iteration.flips > 0 || out.iteration.rebuilt;
}

void Descent::begin() {
  if (state_.memory.iterations == 0) {
    evaluate(state_.points, here_);
    return;
  }
  const bool final_rule =
      rule_of(state_.report.iterations.back()) == options_.quadrature.final_rule;
  functional_.evaluate(state_.points, final_rule, uses_gradients(), here_);
  const Memory& memory = state_.memory;
  for (std::size_t k = 0; k < memory.steps.size(); ++k)
    products_.push_back(
        sums_over_blocks(state_.points.cols(), k, [&](Part part, std::span<double> sums) {
          inner_of_each(std::span(memory.steps).first(k), memory.changes[k], part, sums);
        }));
  if (memory.laplacian_at.cols() > 0)
    laplacian_.emplace(functional_.laplacian(memory.laplacian_at));
}

void Descent::step() {
  const bool other_rule = !uniform_ && state_.memory.final_rule &&
                          rule_of(here_.iteration) != options_.quadrature.final_rule;
  if (options_.method == Method::lloyd)
    lloyd_step();
  else if (other_rule) // another functional, whose energies do not compare
    evaluate(state_.points, here_);
  else
    quasi_newton_step();
}

void Descent::restart() {
  forget();
  state_.memory.flipped = true;
  state_.memory.since_restart = 0;
  evaluate(state_.points, here_);
}

void Descent::end_at_centroids() {
  if (uses_gradients())
    functional_.set_centroids(state_.points, here_, state_.points);
  else
    std::swap(state_.points, here_.centroids);
}

/// Moves the state to the trial, which has been evaluated last.
void Descent::accept() {
  state_.points.swap(trial_);
  std::swap(here_, there_);
}

void Descent::lloyd_step() {
  std::swap(state_.points, here_.centroids);
  evaluate(state_.points, here_);
}

// ---- L-BFGS (Nocedal, 1980; Liu and Nocedal, 1989). On the sphere its vectors are ambient, and
// are projected to the tangent planes where they are used

void Descent::forget() {
  Memory& memory = state_.memory;
  memory.steps.clear();
  memory.changes.clear();
  memory.curvatures.clear();
  memory.stride = 1;
  products_.clear();
}

void Descent::make_laplacian() {
  Memory& memory = state_.memory;
  if (laplacian_ && !(memory.since_laplacian >= laplacian_lasts && memory.flipped))
    return;
  memory.laplacian_at = state_.points;
  memory.since_laplacian = 0;
  memory.flipped = false;
  forget();
  laplacian_.reset(); // its memory serves the next
  laplacian_.emplace(functional_.laplacian(memory.laplacian_at));
}

/// Multiplies by the initial inverse Hessian. This is the inverse of the graph Laplacian, whose
/// scale is right; or that of twice the masses, times a factor with which it agrees with the last
/// step and the change of the gradient along it.
void Descent::precondition(Points3& vectors) {
  if (method() == Method::lbfgs_laplacian) {
    laplacian_->solve(vectors);
    return;
  }
  const Memory& memory = state_.memory;
  const double factor =
      memory.steps.empty()
          ? 1
          : memory.curvatures.back() / (0.5 * square_over(memory.changes.back(), here_.mass));
  divide_by_masses(vectors);
  multiply(vectors, factor);
}

/// Divides each vector by twice its cell's mass.
void Descent::divide_by_masses(Points3& vectors) const {
  for_each_block(vectors.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      set_column(vectors, i, (0.5 / std::abs(here_.mass[i])) * column(vectors, i));
  });
}

/// Sets the direction: minus the approximate inverse Hessian times the gradient. It is Nocedal's
/// recursion with all inner products of pairs stored, so that it reads each pair four times in all
/// and writes only the result.
Descent::Line Descent::set_direction() {
  const Memory& memory = state_.memory;
  const std::size_t pairs = memory.steps.size();
  const std::int64_t n = state_.points.cols();
  if (direction_.cols() != n)
    direction_.resize(3, n);
  std::vector<double> shares = inner_of_each(memory.steps, here_.gradient);
  for (std::size_t k = pairs; k-- > 0;) {
    for (std::size_t j = k + 1; j < pairs; ++j)
      shares[k] += shares[j] * products_[j][k];
    shares[k] /= -memory.curvatures[k];
  }
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    set_sum(direction_, 1, here_.gradient, shares, memory.changes, {begin, end});
    functional_.make_tangential(direction_, state_.points, {begin, end});
  });
  precondition(direction_);
  const std::vector<double> slopes =
      sums_over_blocks(n, pairs, [&](Part part, std::span<double> sums) {
        functional_.make_tangential(direction_, state_.points, part);
        inner_of_each(memory.changes, direction_, part, sums);
      });
  for (std::size_t k = 0; k < pairs; ++k) {
    double slope = slopes[k];
    for (std::size_t j = 0; j < k; ++j)
      slope -= shares[j] * products_[k][j];
    shares[k] += slope / memory.curvatures[k];
  }
  std::vector<double> most(static_cast<std::size_t>(block_count(n)));
  std::vector<double> lines(most.size());
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    const Part part{begin, end};
    set_sum(direction_, -1, direction_, shares, memory.steps, part);
    functional_.make_tangential(direction_, state_.points, part);
    lines[static_cast<std::size_t>(block)] = inner(direction_, here_.gradient, part);
    most[static_cast<std::size_t>(block)] = greatest_motion(part);
  });
  return {std::accumulate(lines.begin(), lines.end(), 0.0),
          0.5 / *std::max_element(most.begin(), most.end())};
}

/// The greatest motion of a generator along the direction, over the width of its cell, the root of
/// mass over density.
double Descent::greatest_motion(Part part) const {
  constexpr std::int64_t batch = 64;
  std::array<std::array<double, batch>, 3> x;
  std::array<double, batch> rho;
  double most = 0;
  for (std::int64_t first = part.begin; first < part.end; first += batch) {
    const auto count = static_cast<std::size_t>(std::min(batch, part.end - first));
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t c = 0; c < 3; ++c)
        x[c][j] = state_.points(static_cast<Eigen::Index>(c), first + static_cast<std::int64_t>(j));
    const auto row = [&](auto& values) { return std::span(values).first(count); };
    density_(row(x[0]), row(x[1]), row(x[2]), row(rho));
    for (std::size_t j = 0; j < count; ++j) {
      const std::int64_t i = first + static_cast<std::int64_t>(j);
      const Vec3& d = column(direction_, i);
      most = std::max(most, dot(d, d) * rho[j] / std::abs(here_.mass[i]));
    }
  }
  return std::sqrt(most);
}

/// Line search. It accepts a trial that has a lower energy and is not far beyond the minimum. Where
/// the energies differ by less than quadrature resolves, it accepts a trial whose slopes satisfy
/// conditions like the approximate Wolfe conditions of Hager and Zhang (2005). The secant of the
/// slopes gives the next trial. Returns false if no trial is accepted.
///
/// The first trial is the full step. After a search that has shortened the step it is shorter for a
/// while: where edges flip in steep widths, every full step would be rejected.
///
/// If it returns true, the trial is the accepted one.
bool Descent::search(const Line& line) {
  constexpr double growth = 1.4;
  Memory& memory = state_.memory;
  double step = std::min(memory.stride, line.longest);
  const double slope = line.slope;
  for (int trial = 0; trial < most_trials; ++trial) {
    functional_.retract(state_.points, step, direction_, trial_);
    evaluate(trial_, there_);
    const double slope_there = inner(direction_, there_.gradient); // which is tangential there
    const double rise = there_.value() / here_.value() - 1;
    const bool lower =
        rise <= rounding && (slope_there <= -0.9 * slope || trial + 1 == most_trials);
    const bool below_rule =
        !uniform_ && std::abs(rise) <= rule_error && std::abs(slope_there) <= -0.5 * slope;
    if (lower || below_rule) {
      memory.stride = std::min(1.0, trial == 0 ? growth * memory.stride : step);
      return true;
    }
    state_.report.iterations.back().accepted = false;
    const double secant = step * slope / (slope - slope_there);
    step = std::isfinite(rise) && secant > 0.1 * step ? std::min(secant, 4 * step) : 0.1 * step;
  }
  return false;
}

/// Stores the step from the state's points to the trial as an L-BFGS pair. It replaces the oldest
/// pair if there are enough.
void Descent::remember() {
  Memory& memory = state_.memory;
  CompactField step, change;
  if (memory.steps.size() == most_pairs(trial_.cols())) {
    step = std::move(memory.steps.front());
    change = std::move(memory.changes.front());
    memory.steps.erase(memory.steps.begin());
    memory.changes.erase(memory.changes.begin());
    memory.curvatures.erase(memory.curvatures.begin());
    products_.erase(products_.begin());
    for (std::vector<double>& products : products_)
      if (!products.empty())
        products.erase(products.begin());
  }
  const CvtIteration& here = here_.iteration;
  const std::int64_t n = here.cells;
  prepare(step, here.l2, n);
  prepare(change, here.gradient / std::sqrt(static_cast<double>(n)), n);
  const std::size_t pairs = memory.steps.size();
  std::vector<double> products =
      sums_over_blocks(n, pairs + 3, [&](Part part, std::span<double> sums) {
        set_difference(trial_, state_.points, step, part);
        set_difference(there_.gradient, here_.gradient, change, part);
        inner_of_each(memory.steps, change, part, sums.first(pairs));
        sums[pairs] = inner(step, step, part);
        sums[pairs + 1] = inner(change, change, part);
        sums[pairs + 2] = inner(step, change, part);
      });
  const double curvature = products[pairs + 2];
  if (!(curvature > 1e-14 * std::sqrt(products[pairs] * products[pairs + 1]))) {
    forget();
    return;
  }
  products.resize(pairs);
  products_.push_back(std::move(products));
  memory.steps.push_back(std::move(step));
  memory.changes.push_back(std::move(change));
  memory.curvatures.push_back(curvature);
}

void Descent::quasi_newton_step() {
  Clock::time_point mark = Clock::now();
  if (method() == Method::lbfgs_laplacian)
    make_laplacian();
  const Line line = set_direction();
  const double seconds = restart_clock(mark);
  const std::size_t first = state_.report.iterations.size();
  if (line.slope < 0 && search(line)) {
    remember();
  } else if (state_.polish.penalty > 0) { // a Lloyd step may raise the penalty
    state_.memory.stuck = state_.memory.steps.empty();
    forget();
    return;
  } else { // Lloyd's step always descends; the coarser rule's energy may have misled the search
    forget();
    state_.memory.final_rule = state_.memory.final_rule || options_.norm != Norm::none;
    functional_.set_centroids(state_.points, here_, trial_);
    evaluate(trial_, there_);
    // A density that is linear between the generators moves with them.
    const bool rose = there_.iteration.energy > (1 + rule_error) * here_.iteration.energy;
    if (here_.iteration.linear_density && rose) {
      state_.report.iterations.back().accepted = false;
      state_.memory.stuck =
          options_.quadrature.final_rule == rule_at_sites || options_.norm == Norm::none;
      return;
    }
  }
  state_.report.iterations[first].seconds_solver = seconds;
  accept();
}

} // namespace calotte::cvt_detail
