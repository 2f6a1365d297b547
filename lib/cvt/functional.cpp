// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/functional.h"

#include "base/clock.h"
#include "base/matrix_memory.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/vector_loops.h"
#include "cvt/planar_cells.h"
#include "cvt/region_cells.h"
#include "cvt/shape.h"
#include "cvt/spherical_cells.h"
#include "cvt/tessellation.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte::cvt_detail {
namespace {

/// What one generator adds to an evaluation's sums.
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

/// Evaluates one generator; the energy is NaN if its cell has no mass.
template <class Cells>
void evaluate_site(const Vec3& x, const CellMoments& cell, std::int32_t site, bool fixed,
                   bool with_gradient, Evaluation& out, SiteTerms& terms) {
  typename Cells::Pull pull = Cells::pull(x, cell);
  if (!(std::abs(pull.mass) > 0) || !std::isfinite(pull.mass)) {
    terms = {std::nan(""), 0, 0};
    return;
  }
  if (fixed) {
    pull.centroid = x;
    pull.gradient = {0, 0, 0};
  }
  const Vec3 apart = pull.centroid - x;
  terms = {cell.energy, dot(apart, apart), dot(pull.gradient, pull.gradient)};
  if (with_gradient) {
    set_column(out.gradient, site, pull.gradient);
    out.mass[site] = pull.mass;
  } else {
    set_column(out.centroids, site, pull.centroid);
  }
}

/// Evaluates a patch's own generators; its other sites hold a plane's hull.
template <class Cells>
CALOTTE_ALL_INSTRUCTIONS void
evaluate_sites(const Patch& patch, const Points3& points, const Array<CellMoments>& moments,
               const std::vector<std::uint8_t>& fixed, bool with_gradient, Evaluation& out,
               Array<SiteTerms>& terms) {
  for (std::int32_t i = 0; i < patch.owned; ++i)
    if (const std::int32_t site = patch.sites[static_cast<std::size_t>(i)]; site < points.cols())
      evaluate_site<Cells>(column(points, site), moments[i], site,
                           !fixed.empty() && fixed[static_cast<std::size_t>(site)] != 0,
                           with_gradient, out, terms[site]);
}

void make_room(Evaluation& out, Eigen::Index n, bool with_gradient) {
  using base_detail::make_room;
  if (!with_gradient) {
    if (out.centroids.cols() != n)
      make_room(out.centroids, 3, n);
  } else if (out.mass.size() != n) {
    make_room(out.gradient, 3, n);
    out.mass = Array<double>(n);
  }
}

/// Counts the generators away from their centroids.
void count_displaced(const Array<SiteTerms>& terms, const Eigen::VectorXd& inverse_spacing,
                     CvtIteration& iteration) {
  constexpr double least = 0.01;
  double most = 0;
  for (std::int64_t i = 0; i < terms.size(); ++i) {
    const double square = terms[i].square * inverse_spacing[i] * inverse_spacing[i];
    iteration.displaced += square > least * least;
    most = std::max(most, square);
  }
  iteration.displacement = std::sqrt(most);
}

template <class Cells> class FunctionalOver final : public Functional {
public:
  FunctionalOver(Cells cells, const Points3& points, const CvtOptions& options, Level&& level)
      : tessellation_(std::move(cells), points, options.partition, std::move(level)),
        density_(options.density),
        coarse_(make_integrand(options.density, options.rule, options.triangle_divisions)),
        fine_(make_integrand(options.density, options.final_rule, options.triangle_divisions)),
        rule_(options.density.uniform() ? 0 : options.rule),
        final_rule_(options.density.uniform() ? 0 : options.final_rule) {}

  void evaluate(const Points3& points, bool final_rule, bool with_gradient,
                Evaluation& out) override;

  void set_centroids(const Points3& points, const Evaluation& at, Points3& to) const override;

  void penalise_shapes(double factor, double spacing) override {
    penalty_ = factor;
    demanded_spacing_ = spacing;
  }
  void hold(std::vector<std::uint8_t> fixed) override { fixed_ = std::move(fixed); }
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
  void hold(Rows& weights) const;

  Tessellation<Cells> tessellation_;
  Density density_;
  Integrand coarse_, fine_;
  int rule_, final_rule_;           ///< their numbers of points, 0 where none is used
  double penalty_ = 0;              ///< factor of the penalty of shape.h
  double demanded_spacing_ = 1;     ///< at rho = 1
  std::vector<std::uint8_t> fixed_; ///< by generator, or empty
  Array<SiteTerms> terms_;          ///< of the last evaluation
};

/// Frees the memory of `out` before sorting and triangulating, which need most of the memory.
template <class Cells>
Effort FunctionalOver<Cells>::integrate(const Points3& points, const Integrand& integrand,
                                        bool with_gradient, Evaluation& out) {
  Effort effort;
  tessellation_.move(points);
  if (tessellation_.drifted()) {
    out = {};
    terms_ = {};
    tessellation_.divide();
  }
  bool turned = false; // a second time, flips have not sufficed
  const auto mend = [&](const Faults& faults) {
    if (faults.none())
      return;
    const bool again = turned && !faults.overturned.empty();
    turned = turned || !faults.overturned.empty();
    if (!again && tessellation_.mend(faults, effort))
      return;
    out = {};
    terms_ = {};
    tessellation_.rebuild(effort);
  };
  const auto receive = [&](const Patch& patch, const Array<Vec3>&,
                           const Array<CellMoments>& moments) {
    evaluate_sites<Cells>(patch, points, moments, fixed_, with_gradient, out, terms_);
  };
  const auto integrate_all = [&] {
    make_room(out, points.cols(), with_gradient);
    if (terms_.size() != points.cols())
      terms_ = Array<SiteTerms>(points.cols());
    return tessellation_.integrate(integrand, receive, effort);
  };
  if (tessellation_.restless())
    mend(tessellation_.find_faults(effort));
  // After a repair few faults are left, and none after a new triangulation.
  for (Faults faults = integrate_all(); !faults.none(); faults = integrate_all())
    mend(faults);
  tessellation_.settle(effort);
  return effort;
}

template <class Cells>
void FunctionalOver<Cells>::evaluate(const Points3& points, bool final_rule, bool with_gradient,
                                     Evaluation& out) {
  Clock::time_point mark = Clock::now();
  const Effort effort = integrate(points, final_rule ? fine_ : coarse_, with_gradient, out);
  CvtIteration& iteration = out.iteration = {};
  iteration.cells = points.cols();
  iteration.spacing = tessellation_.cells().spacing();
  iteration.rule = final_rule ? final_rule_ : rule_;
  iteration.flips = effort.flips;
  iteration.rebuilt = effort.rebuilt;
  iteration.seconds_exchange = effort.seconds_exchange;
  iteration.seconds_repair = effort.seconds_repair;
  iteration.seconds_moments = effort.seconds_moments;
  add_sums(terms_, iteration);
  if (!std::isfinite(iteration.energy))
    throw Error(ErrorCode::bad_option, "the density is zero over a whole cell, or beyond 1e150: "
                                       "make it positive everywhere, and smaller");
  if (penalty_ > 0)
    add_penalty(points, out);
  iteration.seconds = lap(mark);
}

template <class Cells>
void FunctionalOver<Cells>::set_centroids(const Points3& points, const Evaluation& at,
                                          Points3& to) const {
  if (to.cols() != points.cols())
    base_detail::make_room(to, 3, points.cols());
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3& x = column(points, i);
      set_column(to, i, is_fixed(i) ? x : Cells::centroid(x, column(at.gradient, i), at.mass[i]));
    }
  });
}

template <class Cells>
void FunctionalOver<Cells>::add_penalty(const Points3& points, Evaluation& out) {
  const Eigen::VectorXd inverse_spacing =
      calotte::evaluate(density_, points).cwiseSqrt().cwiseSqrt() / demanded_spacing_;
  const ShapeTerms terms = add_shape_terms(tessellation_.cells(), tessellation_.mesh(),
                                           tessellation_.distorted(inverse_spacing),
                                           inverse_spacing, penalty_, out.gradient);
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    make_tangential(out.gradient, points, {begin, end});
  });
  count_displaced(terms_, inverse_spacing, out.iteration);
  out.penalty = penalty_ * terms.value;
  out.iteration.misshapen = terms.worst;
}

template <class Cells>
void FunctionalOver<Cells>::retract(const Points3& x, double step, const Points3& d,
                                    Points3& to) const {
  tessellation_.cells().retract(x, step, d, to);
  if (!fixed_.empty())
    for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i != end; ++i)
        if (is_fixed(i))
          to.col(i) = x.col(i);
    });
}

template <class Cells>
void FunctionalOver<Cells>::make_tangential(Points3& vectors, const Points3& x,
                                            base_detail::Part part) const {
  tessellation_.cells().make_tangential(vectors, x, part);
  for (std::int64_t i = part.begin; !fixed_.empty() && i != part.end; ++i)
    if (is_fixed(i))
      vectors.col(i).setZero();
}

/// Removes the couplings of fixed generators: those of a boundary condition.
template <class Cells> void FunctionalOver<Cells>::hold(Rows& weights) const {
  if (fixed_.empty())
    return;
  for_each_block(weights.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      for (std::int32_t k = weights.begin[i]; k != weights.begin[i + 1]; ++k)
        if (is_fixed(i) || is_fixed(weights.column[k]))
          weights.value[k] = 0;
  });
}

/// The mesh is that of the last evaluation; at other points it may not be Delaunay.
template <class Cells> Laplacian FunctionalOver<Cells>::laplacian(const Points3& points) {
  Effort unused;
  tessellation_.move(points);
  const Cells& cells = tessellation_.cells();
  Laplacian matrix = tessellation_.find_faults(unused).none()
                         ? cells.laplacian(tessellation_.mesh(), density_)
                         : cells.laplacian(cells.signs().triangulate(), density_);
  hold(matrix.weights);
  return matrix;
}

template <class Cells>
std::optional<Connectivity> FunctionalOver<Cells>::take_mesh(const Points3& points) {
  std::optional<Connectivity> mesh = tessellation_.take_mesh(points);
  return tessellation_.cells().has_hull() ? std::nullopt : std::move(mesh);
}

} // namespace

std::unique_ptr<Functional> make_functional(const Points3& points, const CvtOptions& options,
                                            Level&& level) {
  return std::make_unique<FunctionalOver<SphericalCells>>(SphericalCells(), points, options,
                                                          std::move(level));
}

std::unique_ptr<Functional> make_functional(const Points3& points, const PlanarDomain& domain,
                                            const CvtOptions& options, Level&& level) {
  return std::make_unique<FunctionalOver<PlanarCells>>(PlanarCells(domain), points, options,
                                                       std::move(level));
}

std::unique_ptr<Functional> make_functional(const Points3& points,
                                            std::shared_ptr<const SphericalOutline> outline,
                                            const CvtOptions& options) {
  RegionCells cells(std::move(outline), options.boundary, options.density, points);
  return std::make_unique<FunctionalOver<RegionCells>>(std::move(cells), points, options, Level());
}

} // namespace calotte::cvt_detail
