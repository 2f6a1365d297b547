// SPDX-License-Identifier: GPL-3.0-or-later
#include "functional.h"

#include "clock.h"
#include "parallel.h"
#include "points.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>

namespace calotte::detail {
namespace {

/// Sums of blocks of sites, added in the order of the blocks: the same for any number of threads.
void add_sums(const Array<SiteTerms>& terms, CvtIteration& iteration) {
  const std::int64_t n = terms.size();
  std::vector<SiteTerms> sums(static_cast<std::size_t>(block_count(n)));
  std::vector<double> largest(sums.size(), 0);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    SiteTerms sum{0, 0, 0};
    double most = 0;
    for (std::int64_t i = begin; i != end; ++i) {
      sum.energy += terms[i].energy;
      sum.square += terms[i].square;
      sum.slope += terms[i].slope;
      most = std::max(most, terms[i].square);
    }
    sums[static_cast<std::size_t>(block)] = sum;
    largest[static_cast<std::size_t>(block)] = most;
  });
  SiteTerms total{0, 0, 0};
  for (const SiteTerms& sum : sums)
    total = {total.energy + sum.energy, total.square + sum.square, total.slope + sum.slope};
  iteration.energy = total.energy;
  iteration.l2 = std::sqrt(total.square / static_cast<double>(n));
  iteration.linf = std::sqrt(*std::max_element(largest.begin(), largest.end()));
  iteration.gradient = std::sqrt(total.slope);
}

/// Evaluates one generator; where its cell has no centroid, the energy is NaN.
void evaluate_site(const Vec3& x, const CellMoments& cell, std::int32_t site, bool with_gradient,
                   Evaluation& out) {
  const double length = norm(cell.first);
  if (!(length > 0) || !std::isfinite(length)) {
    out.terms[site] = {std::nan(""), 0, 0};
    return;
  }
  const Vec3 centroid = (1 / length) * cell.first;
  const Vec3 apart = centroid - x, tangent = cell.first - dot(cell.first, x) * x;
  set_column(out.centroids, site, centroid);
  out.terms[site] = {cell.energy, dot(apart, apart), 4 * dot(tangent, tangent)};
  if (with_gradient) {
    set_column(out.gradient, site, -2 * tangent);
    out.mass[site] = length;
  }
}

void make_room(Evaluation& out, Eigen::Index n, bool with_gradient) {
  if (out.terms.size() != n) {
    out.centroids.resize(3, n);
    out.terms = Array<SiteTerms>(n);
  }
  if (with_gradient && out.mass.size() != n) {
    out.gradient.resize(3, n);
    out.mass = Array<double>(n);
  }
}

} // namespace

Functional::Functional(const Points3& points, const CvtOptions& options)
    : tessellation_(points, options.partition),
      coarse_(make_integrand(options.density, options.rule, options.triangle_divisions)),
      fine_(make_integrand(options.density, options.final_rule, options.triangle_divisions)),
      rule_(options.density.uniform() ? 0 : options.rule),
      final_rule_(options.density.uniform() ? 0 : options.final_rule) {}

void Functional::evaluate(const Points3& points, bool final_rule, bool with_gradient,
                          Evaluation& out) {
  Clock::time_point mark = Clock::now();
  make_room(out, points.cols(), with_gradient);
  const Tessellation::Effort effort = tessellation_.evaluate(
      points, final_rule ? fine_ : coarse_,
      [&](const Patch& patch, const Array<Vec3>& x, const Array<CellMoments>& moments) {
        for (std::int32_t i = 0; i < patch.owned; ++i)
          evaluate_site(x[i], moments[i], patch.sites[static_cast<std::size_t>(i)], with_gradient,
                        out);
      });
  CvtIteration& iteration = out.iteration = {};
  iteration.cells = points.cols();
  iteration.rule = final_rule ? final_rule_ : rule_;
  iteration.flips = effort.flips;
  iteration.rebuilt = effort.rebuilt;
  iteration.seconds_exchange = effort.seconds_exchange;
  iteration.seconds_repair = effort.seconds_repair;
  iteration.seconds_moments = effort.seconds_moments;
  add_sums(out.terms, iteration);
  if (!std::isfinite(iteration.energy))
    throw Error(ErrorCode::bad_option, "the density is zero over a whole cell, or beyond 1e150: "
                                       "make it positive everywhere, and smaller");
  iteration.seconds = lap(mark);
}

} // namespace calotte::detail
