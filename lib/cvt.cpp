// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>

#include "clock.h"
#include "moments.h"
#include "parallel.h"
#include "repair.h"
#include "sites.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>

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
  if (options.triangle_divisions < 1)
    refuse("triangle_divisions must be at least 1");
  quadrature_rule(options.rule);
  quadrature_rule(options.final_rule);
  evaluate(options.density, Points3(Eigen::Vector3d::UnitZ())); // says what is wrong with it
}

/// A tessellation in the making: a mesh whose sites are numbered along the curve, which keeps what
/// an iteration reads together.
struct Tessellation {
  Mesh mesh;
  Stars stars;
  Pulls pulls;
};

Tessellation tessellate(const Points3& points) {
  Tessellation result;
  result.mesh = delaunay(points);
  if (result.mesh.points.cols() != points.cols() || !result.mesh.closed())
    throw Error(ErrorCode::bad_option, "the start lies within a hemisphere, or two of its points "
                                       "are nearer than rounding: spread it over the sphere");
  result.stars = make_stars(result.mesh);
  result.pulls = edge_pulls(result.mesh);
  return result;
}

/// Sums of blocks of sites, added in the order of the blocks: the same for any number of threads.
template <class Term> double sum_by_blocks(std::int64_t n, const Term& term) {
  std::vector<double> sums(static_cast<std::size_t>(block_count(n)), 0);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    double sum = 0;
    for (std::int64_t i = begin; i != end; ++i)
      sum += term(i);
    sums[static_cast<std::size_t>(block)] = sum;
  });
  double total = 0;
  for (const double sum : sums)
    total += sum;
  return total;
}

/// First moments and energy of the tessellation's cells.
struct Functional {
  Array<Vec3> first;
  double energy = 0;
};

Functional evaluate_functional(const Tessellation& t, const CvtOptions& options, int rule) {
  const std::int64_t n = t.mesh.points.cols();
  Functional result;
  if (options.density.uniform()) {
    result.first = uniform_first_moments(t.mesh, t.stars, t.pulls);
    result.energy = t.pulls.energy;
  } else {
    Moments moments = quadrature_moments(t.mesh, t.stars, options.density, quadrature_rule(rule),
                                         options.triangle_divisions);
    result.energy = sum_by_blocks(n, [&](std::int64_t i) { return moments.energy[i]; });
    result.first = std::move(moments.first);
  }
  return result;
}

/// Moves every generator to its constrained centroid; the norms of the move.
void move(Points3& points, const Array<Vec3>& first, CvtIteration& iteration) {
  const std::int64_t n = points.cols();
  std::vector<double> largest(static_cast<std::size_t>(block_count(n)), 0);
  std::vector<double> squares(largest.size(), 0);
  std::vector<std::uint8_t> failed(largest.size(), 0);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    const auto b = static_cast<std::size_t>(block);
    for (std::int64_t i = begin; i != end; ++i) {
      const double length = norm(first[i]);
      if (!(length > 0) || !std::isfinite(length)) {
        failed[b] = 1;
        continue;
      }
      const Vec3 centroid = (1 / length) * first[i];
      const Vec3 step = centroid - column(points, i);
      const double square = dot(step, step);
      squares[b] += square;
      largest[b] = std::max(largest[b], square);
      points.col(i) << centroid.x, centroid.y, centroid.z;
    }
  });
  double sum = 0, most = 0;
  for (std::size_t b = 0; b < largest.size(); ++b) {
    if (failed[b] != 0)
      throw Error(ErrorCode::bad_option,
                  "the density is infinite or zero over a whole cell: make it positive everywhere");
    sum += squares[b];
    most = std::max(most, largest[b]);
  }
  iteration.l2 = std::sqrt(sum / static_cast<double>(n));
  iteration.linf = std::sqrt(most);
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
  default:
    return iteration.linf / h;
  }
}

void iterate(Tessellation& t, const CvtOptions& options, CvtReport& report,
             const std::function<bool(const CvtReport&)>& stop) {
  const std::int64_t n = t.mesh.points.cols();
  int rule = options.rule;
  for (int k = 0; k < options.max_iterations && !report.converged; ++k) {
    CvtIteration iteration;
    Clock::time_point mark = Clock::now();
    const Functional functional = evaluate_functional(t, options, rule);
    iteration.energy = functional.energy;
    move(t.mesh.points, functional.first, iteration);
    t.pulls = edge_pulls(t.mesh);
    iteration.seconds_moments = lap(mark);
    const Repair repaired = repair(t.mesh, t.stars, t.pulls);
    iteration.flips = repaired.flips;
    iteration.rebuilt = repaired.rebuilt;
    iteration.seconds_repair = lap(mark);
    report.iterations.push_back(iteration);
    report.residual = residual(iteration, options.norm, n);
    // Near the end the finer rule takes over; only with it a run can converge.
    report.converged = rule == options.final_rule || options.density.uniform()
                           ? report.residual <= options.tolerance
                           : false;
    if (report.residual <= 10 * options.tolerance)
      rule = options.final_rule;
    if (stop && stop(report))
      return;
  }
}

} // namespace
} // namespace detail

Cvt cvt(const Points3& start, const CvtOptions& options,
        const std::function<bool(const CvtReport&)>& stop) {
  detail::Clock::time_point mark = detail::Clock::now();
  detail::require(options);
  const detail::Sites sites = detail::make_sites(start, Duplicates::merge, 0);
  const std::int64_t n = sites.size();
  if (n < 12)
    throw Error(ErrorCode::too_few_sites,
                "there are " + std::to_string(n) + " distinct generators: give at least 12");
  Points3 points(3, n);
  for (std::int64_t r = 0; r < n; ++r)
    points.col(r) << sites.unit[r].x, sites.unit[r].y, sites.unit[r].z;
  detail::Tessellation tessellation = detail::tessellate(points);
  Cvt result;
  detail::iterate(tessellation, options, result.report, stop);
  for (std::int64_t r = 0; r < n; ++r)
    points.col(sites.id[r]) = tessellation.mesh.points.col(r);
  result.mesh = delaunay(points);
  result.mesh.site_of_input = sites.site_of_input;
  result.report.seconds = detail::lap(mark);
  return result;
}

} // namespace calotte
