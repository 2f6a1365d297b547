// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/functional.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/vector_loops.h"
#include "cvt/cells.h"
#include "cvt/glide.h"
#include "cvt/polish.h"
#include "cvt/shape.h"
#include "cvt/tessellation.h"
#include "exact/space.h"
#include "integrals/quads.h"
#include "integrals/rows.h"

#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace calotte::cvt_detail {
namespace {

/// The terms of one generator in an evaluation's sums.
struct SiteTerms {
  double energy;
  double square; ///< of its distance from its centroid
  double slope;  ///< of its gradient, squared
};

/// Sums over blocks of sites, added in the order of the blocks: the same for any number of threads.
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

/// The input and output of a kernel for up to `lanes` consecutive generators of a patch.
struct alignas(64) SiteRows {
  Rows3 x, first;
  Row energy;   ///< NaN if a cell has no mass
  Rows3 effect; ///< the gradient, or without one the centroid
  Row mass;     ///< with the gradient
  Row square, slope;
};

/// \param x followed by one more double.
/// \param site the site of a lane.
template <class Site>
CALOTTE_INLINE void gather_by(const Site& site, const Vec3* x, const CellMoments* moments,
                              SiteRows& rows) {
  for (std::size_t first = 0; first < lanes; first += 4) {
    const std::size_t a = site(first), b = site(first + 1), c = site(first + 2),
                      d = site(first + 3);
    Quad last;
    put_columns({x + a, x + b, x + c, x + d}, first, rows.x, last);
    put_columns({moments + a, moments + b, moments + c, moments + d}, first, rows.first, last);
    quad_at(rows.energy.data() + first).value = last;
  }
}

CALOTTE_VECTOR_WIDTHS
void gather_sites(const Vec3* x, const CellMoments* moments, std::size_t count, SiteRows& rows) {
  if (count == lanes)
    gather_by([](std::size_t lane) { return lane; }, x, moments, rows);
  else
    gather_by([&](std::size_t lane) { return std::min(lane, count - 1); }, x, moments, rows);
}

template <Space S, bool with_gradient> CALOTTE_VECTOR_WIDTHS void evaluate_rows(SiteRows& rows) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3 x = at(rows.x, lane);
    const Pull pull = Cells<S>::pull(x, {at(rows.first, lane), rows.energy[lane]});
    const double mass = std::abs(pull.mass);
    const bool valid = mass > 0 && mass <= std::numeric_limits<double>::max();
    rows.energy[lane] = valid ? rows.energy[lane] : std::numeric_limits<double>::quiet_NaN();
    const Vec3 apart = pull.centroid - x;
    if constexpr (with_gradient) {
      put(pull.gradient, rows.effect, lane);
      rows.mass[lane] = pull.mass;
    } else {
      put(pull.centroid, rows.effect, lane);
    }
    rows.square[lane] = dot(apart, apart);
    rows.slope[lane] = dot(pull.gradient, pull.gradient);
  }
}

void put_site(const SiteRows& rows, std::size_t lane, std::int32_t site, bool fixed,
              bool with_gradient, Evaluation& out, SiteTerms& terms) {
  terms = {rows.energy[lane], fixed ? 0 : rows.square[lane], fixed ? 0 : rows.slope[lane]};
  if (with_gradient) {
    set_column(out.gradient, site, fixed ? Vec3{0, 0, 0} : at(rows.effect, lane));
    out.mass[site] = rows.mass[lane];
  } else {
    set_column(out.centroids, site, fixed ? at(rows.x, lane) : at(rows.effect, lane));
  }
}

/// Evaluates a patch's own generators. Its other sites may include those of a plane's hull, which
/// come last.
/// \param x the positions of the patch's sites.
template <Space S>
CALOTTE_ALL_INSTRUCTIONS void
evaluate_sites(const Patch& patch, const Points3& points, const Array<Vec3>& x,
               const Array<CellMoments>& moments, const std::vector<std::uint8_t>& fixed,
               bool with_gradient, Evaluation& out, Array<SiteTerms>& terms) {
  std::span<const std::int32_t> sites(patch.sites.data(), static_cast<std::size_t>(patch.owned));
  while (!sites.empty() && sites.back() >= points.cols())
    sites = sites.first(sites.size() - 1);
  SiteRows rows;
  std::array<Vec3, lanes + 1> generators;
  for (std::size_t first = 0; first < sites.size(); first += lanes) {
    const auto part = sites.subspan(first, std::min(lanes, sites.size() - first));
    if (Cells<S>::positions_wrap)
      for (std::size_t lane = 0; lane < part.size(); ++lane)
        generators[lane] = column(points, part[lane]);
    gather_sites(Cells<S>::positions_wrap ? generators.data() : x.begin() + first,
                 moments.begin() + first, part.size(), rows);
    if (with_gradient)
      evaluate_rows<S, true>(rows);
    else
      evaluate_rows<S, false>(rows);
    for (std::size_t lane = 0; lane < part.size(); ++lane) {
      const std::int32_t site = part[lane];
      put_site(rows, lane, site, !fixed.empty() && fixed[static_cast<std::size_t>(site)] != 0,
               with_gradient, out, terms[site]);
    }
  }
}

void make_room(Evaluation& out, Eigen::Index n, bool with_gradient) {
  if (!with_gradient) {
    if (out.centroids.cols() != n)
      out.centroids.resize(3, n);
  } else if (out.mass.size() != n) {
    out.gradient.resize(3, n);
    out.mass = Array<double>(n);
  }
}

/// Counts the generators away from their centroids.
void count_off_centroid(const Array<SiteTerms>& terms, const DoubleVector& inverse_spacing,
                        CvtIteration& iteration) {
  constexpr double least = 0.01;
  double most = 0;
  for (std::int64_t i = 0; i < terms.size(); ++i) {
    const double square = terms[i].square * inverse_spacing[i] * inverse_spacing[i];
    iteration.off_centroid += square > least * least;
    most = std::max(most, square);
  }
  iteration.largest_offset = std::sqrt(most);
}

template <Space S> class FunctionalOver final : public RunFunctional {
public:
  FunctionalOver(Cells<S> cells, const Points3& points, const Density& density,
                 const Execution& execution, Level&& level)
      : tessellation_(std::move(cells), points, execution.decomposition, std::move(level)),
        density_(density),
        coarse_(make_integrand(density, execution.quadrature.rule, execution.quadrature.divisions)),
        fine_(make_integrand(density, execution.quadrature.final_rule,
                             execution.quadrature.divisions)),
        rule_(density.uniform() ? 0 : execution.quadrature.rule),
        final_rule_(density.uniform() ? 0 : execution.quadrature.final_rule) {}

  void evaluate(const Points3& points, bool final_rule, bool with_gradient,
                Evaluation& out) override;

  void set_centroids(const Points3& points, const Evaluation& at, Points3& to) const override;

  void penalise(const ShapePenalty& penalty) override { penalty_ = penalty; }
  void pin(std::vector<std::uint8_t> fixed) override { fixed_ = std::move(fixed); }
  void end_along(std::vector<std::int32_t> along) override {
    tessellation_.end_along(std::move(along));
  }
  std::int64_t glide(Points3& points, const ShapeLimits& limits) override {
    return cvt_detail::glide(tessellation_, points, {density_, coarse_, fixed_, false}, limits);
  }
  std::int64_t polish(Points3& points, int raised) override;
  std::vector<CvtRegion> regions() const override { return tessellation_.regions(); }
  void retract(const Points3& x, double step, const Points3& d, Points3& to) const override;
  void make_tangential(Points3& vectors, const Points3& x, base_detail::Part part) const override;
  Laplacian laplacian(const Points3& points) override;
  std::optional<Connectivity> take_mesh(const Points3& points) override;

private:
  Effort integrate(const Points3& points, const Integrand& integrand, bool with_gradient,
                   Evaluation& out);
  void add_penalty(const Points3& points, Evaluation& out);
  bool is_fixed(std::int64_t site) const {
    return !fixed_.empty() && fixed_[static_cast<std::size_t>(site)] != 0;
  }
  void pin(Rows& weights) const;
  LocalInput local_input() const { return {density_, coarse_, fixed_}; }

  Tessellation<S> tessellation_;
  Density density_;
  Integrand coarse_, fine_;
  int rule_, final_rule_; ///< their numbers of points, 0 where none is used
  ShapePenalty penalty_;
  std::vector<std::uint8_t> fixed_; ///< by generator, or empty
  Array<SiteTerms> terms_;          ///< of the last evaluation
};

/// Frees the memory of `out` before sorting and triangulating, which need most of the memory.
template <Space S>
Effort FunctionalOver<S>::integrate(const Points3& points, const Integrand& integrand,
                                    bool with_gradient, Evaluation& out) {
  Effort effort;
  tessellation_.move(points);
  if (tessellation_.drifted()) {
    out = {};
    terms_ = {};
    tessellation_.divide();
  }
  const auto receive = [&](const Patch& patch, const Array<Vec3>& x,
                           const Array<CellMoments>& moments) {
    evaluate_sites<S>(patch, points, x, moments, fixed_, with_gradient, out, terms_);
  };
  const auto set_room = [&](bool room) {
    if (!room) {
      out = {};
      terms_ = {};
      return;
    }
    make_room(out, points.cols(), with_gradient);
    if (terms_.size() != points.cols())
      terms_ = Array<SiteTerms>(points.cols());
  };
  tessellation_.integrate_repaired(integrand, set_room, receive, effort);
  return effort;
}

template <Space S>
void FunctionalOver<S>::evaluate(const Points3& points, bool final_rule, bool with_gradient,
                                 Evaluation& out) {
  Clock::time_point mark = Clock::now();
  const Effort effort = integrate(points, final_rule ? fine_ : coarse_, with_gradient, out);
  CvtIteration& iteration = out.iteration = {};
  iteration.cells = points.cols();
  iteration.spacing = tessellation_.cells().spacing();
  const int rule = final_rule ? final_rule_ : rule_;
  iteration.linear_density = rule == rule_at_sites;
  iteration.rule = iteration.linear_density ? 0 : rule;
  iteration.flips = effort.flips;
  iteration.rebuilt = effort.rebuilt;
  iteration.seconds_exchange = effort.seconds_exchange;
  iteration.seconds_repair = effort.seconds_repair;
  iteration.seconds_moments = effort.seconds_moments;
  add_sums(terms_, iteration);
  if (!std::isfinite(iteration.energy))
    throw Error(ErrorCode::invalid_argument,
                "the density is zero over a whole cell, or beyond 1e150: "
                "make it positive everywhere, and smaller");
  if (penalty_.factors.shapes > 0)
    add_penalty(points, out);
  iteration.seconds = restart_clock(mark);
}

template <Space S>
void FunctionalOver<S>::set_centroids(const Points3& points, const Evaluation& at,
                                      Points3& to) const {
  if (to.cols() != points.cols())
    to.resize(3, points.cols());
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3& x = column(points, i);
      set_column(to, i,
                 is_fixed(i) ? x : Cells<S>::centroid(x, column(at.gradient, i), at.mass[i]));
    }
  });
}

template <Space S> std::int64_t FunctionalOver<S>::polish(Points3& points, int raised) {
  const auto pins = [&] {
    return raised == 0 ? fixed_
                       : released(tessellation_, points, local_input(), penalty_,
                                  raised < 3 ? pinned_on_line : pinned_at_end);
  };
  if (raised > 1)
    cvt_detail::glide(tessellation_, points, {density_, coarse_, pins(), false}, penalty_.limits);
  return cvt_detail::polish(tessellation_, points, {density_, coarse_, pins()}, penalty_);
}

template <Space S> void FunctionalOver<S>::add_penalty(const Points3& points, Evaluation& out) {
  const DoubleVector inverse_spacing =
      calotte::evaluate(density_, points).cwiseSqrt().cwiseSqrt() / penalty_.spacing;
  const ShapeInput<S> input{tessellation_.positioned(), inverse_spacing, penalty_.limits, fixed_};
  out.shapes = add_shape_terms(input, distorted(input), penalty_.factors, out.gradient);
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    make_tangential(out.gradient, points, {begin, end});
  });
  count_off_centroid(terms_, inverse_spacing, out.iteration);
  out.penalty = out.shapes.value;
  out.iteration.shape_excess = out.shapes.worst;
}

template <Space S>
void FunctionalOver<S>::retract(const Points3& x, double step, const Points3& d,
                                Points3& to) const {
  tessellation_.cells().retract(x, step, d, to);
  if (!fixed_.empty())
    for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i != end; ++i)
        if (is_fixed(i))
          to.col(i) = x.col(i);
    });
}

template <Space S>
void FunctionalOver<S>::make_tangential(Points3& vectors, const Points3& x,
                                        base_detail::Part part) const {
  tessellation_.cells().make_tangential(vectors, x, part);
  for (std::int64_t i = part.begin; !fixed_.empty() && i != part.end; ++i)
    if (is_fixed(i))
      vectors.col(i).setZero();
}

/// Removes the couplings of fixed generators, as for a Dirichlet condition.
template <Space S> void FunctionalOver<S>::pin(Rows& weights) const {
  if (fixed_.empty())
    return;
  for_each_block(weights.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      for (Element& element : weights[i])
        if (is_fixed(i) || is_fixed(element.column))
          element.value = 0;
  });
}

/// The mesh is that of the last evaluation; at other points it may not be Delaunay.
template <Space S> Laplacian FunctionalOver<S>::laplacian(const Points3& points) {
  Effort unused;
  tessellation_.move(points);
  const Cells<S>& cells = tessellation_.cells();
  Laplacian matrix = tessellation_.find_faults(unused).none()
                         ? cells.laplacian(tessellation_.mesh(), density_)
                         : cells.laplacian(cells.triangulate(), density_);
  pin(matrix.weights);
  return matrix;
}

template <Space S> std::optional<Connectivity> FunctionalOver<S>::take_mesh(const Points3& points) {
  std::optional<Connectivity> mesh = tessellation_.take_mesh(points);
  return tessellation_.cells().has_hull() ? std::nullopt : std::move(mesh);
}

} // namespace

std::unique_ptr<RunFunctional> make_functional(const Points3& points, const Surface& surface,
                                               const Density& density, const Execution& execution,
                                               Boundary boundary, Level&& level) {
  return in_space_of(surface, [&]<class S>(const S&) -> std::unique_ptr<RunFunctional> {
    return std::make_unique<FunctionalOver<S>>(Cells<S>(surface, boundary, density, points), points,
                                               density, execution, std::move(level));
  });
}

} // namespace calotte::cvt_detail
