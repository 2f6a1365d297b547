// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>

#include "base/clock.h"
#include "base/points.h"
#include "base/require.h"
#include "cvt/descent.h"
#include "cvt/functional.h"
#include "cvt/planar_cells.h"
#include "cvt/signs.h"
#include "delaunay/periodic.h"
#include "delaunay/sites.h"
#include "density/planar_density.h"
#include "integrals/quadrature.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace calotte {
namespace cvt_detail {
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
}

[[noreturn]] void refuse_state() {
  throw Error(
      ErrorCode::bad_option,
      "the state is not one that a run has left: its points must be unit vectors, or places "
      "in the domain, and its ids a permutation");
}

/// Refuses a state that no run has left, whatever its space.
void require_state(const CvtState& state) {
  const auto n = static_cast<std::size_t>(state.points.cols());
  std::vector<std::uint8_t> seen(n, 0);
  bool good = n >= 1 && state.id.size() == n && state.bisections_left >= 0 &&
              state.iterations_of_level >= 0;
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
    refuse_state();
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
template <class World>
bool iterate(const World& world, CvtState& state, const CvtOptions& options, const CvtStop& stop) {
  if (level_ended(state, options)) {
    state.report.converged = state.report.converged || options.norm == Norm::none;
    return false;
  }
  const double before = state.report.seconds;
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<Functional> functional = world.functional(state.points, options);
  Descent descent(state, options, *functional);
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
      state.report.regions = functional->regions();
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

/// \param sites their given points are those of the state: unit columns.
void set_points(CvtState& state, const Sites& sites, const Array<Vec3>& points) {
  const std::int64_t n = sites.size();
  state.points.resize(3, n);
  state.id.resize(static_cast<std::size_t>(n));
  for (std::int64_t r = 0; r < n; ++r) {
    set_column(state.points, r, points[r]);
    state.id[static_cast<std::size_t>(r)] = sites.id[r];
  }
}

/// What a run needs to know of the space that its generators live in.
class OnSphere {
public:
  using Result = Cvt;

  static Density density(const Density& density) {
    evaluate(density, Points3(Eigen::Vector3d::UnitZ())); // says what is wrong with it
    return density;
  }
  static void require_points(const CvtState& state) {
    if (state.points.cols() < 12 ||
        !((state.points.colwise().squaredNorm().array() - 1).abs() < 1e-12).all())
      refuse_state();
  }
  static std::unique_ptr<Functional> functional(const Points3& points, const CvtOptions& options) {
    return make_functional(points, options);
  }
  /// The generators that a bisection leaves of n: n -> 4n - 6.
  static std::int64_t bisected(std::int64_t n) { return 4 * n - 6; }
  static Mesh mesh(Points3&& points) { return delaunay(std::move(points)); }
  static void set_bisected(CvtState& state, Points3&& points) {
    const Sites sites = make_sites(bisect(mesh(std::move(points))), Duplicates::refuse, 0);
    set_points(state, sites, sites.unit);
  }
};

/// The same of a domain in the plane.
class InPlane {
public:
  using Result = PlanarCvt;

  explicit InPlane(const PlanarDomain& domain) : domain_(domain) { require_domain(domain); }

  Density density(const Density& density) const {
    const Density planar = planar_density(density, domain_);
    const Eigen::Vector2d some =
        domain_.periodic() ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(domain_.rings[0].col(0));
    evaluate(planar, Points3(Eigen::Vector3d(some.x(), some.y(), 0)));
    return planar;
  }
  void require_points(const CvtState& state) const {
    if (!state.points.allFinite() || !state.points.row(2).isZero(0) || !all_inside(state.points))
      refuse_state();
  }
  std::unique_ptr<Functional> functional(const Points3& points, const CvtOptions& options) const {
    return make_functional(points, domain_, options);
  }
  /// At most: some midpoints may be outside.
  static std::int64_t bisected(std::int64_t n) { return 4 * n; }
  PlanarMesh mesh(const Points3& points) const {
    const Points2 places = in_domain(points);
    return domain_.periodic() ? delaunay(places, domain_.period) : delaunay(places);
  }
  void set_bisected(CvtState& state, const Points3& points) const {
    set_places(state, make_sites(bisect(mesh(points), domain_), Duplicates::refuse, 0));
  }
  static void set_places(CvtState& state, const Sites& sites) {
    Array<Vec3> points(sites.size());
    for (std::int64_t r = 0; r < sites.size(); ++r)
      points[r] = sites.given(sites.id[r]);
    set_points(state, sites, points);
  }

private:
  bool all_inside(const Points3& points) const {
    try {
      if (!domain_.periodic())
        require_inside(points.topRows<2>(), domain_);
    } catch (const Error&) {
      return false;
    }
    return true;
  }
  Points2 in_domain(const Points3& points) const {
    Points2 places = points.topRows<2>();
    for (Eigen::Index i = 0; domain_.periodic() && i < places.cols(); ++i)
      for (int k = 0; k < 2; ++k)
        places(k, i) = wrapped(places(k, i), domain_.period[k]);
    return places;
  }

  PlanarDomain domain_;
};

/// Refuses bisections to more generators than a mesh can hold, before any work.
template <class World> void require_room(const World& world, const CvtState& state) {
  const std::int64_t n = state.points.cols();
  int most = 0;
  for (std::int64_t cells = world.bisected(n); cells <= most_points; cells = world.bisected(cells))
    ++most;
  if (state.bisections_left > most)
    throw Error(ErrorCode::bad_option,
                std::to_string(state.bisections_left) + " bisections of " + std::to_string(n) +
                    " generators are too many; give at most " + std::to_string(most));
}

CvtState begin(Points3&& start, const CvtOptions& options) {
  Sites sites =
      make_sites(std::move(start), options.partition.duplicates, options.partition.merge_within);
  if (sites.size() < 12)
    throw Error(ErrorCode::too_few_sites, "there are " + std::to_string(sites.size()) +
                                              " distinct generators: give at least 12");
  CvtState state;
  set_points(state, sites, sites.unit);
  state.site_of_input = std::move(sites.site_of_input);
  state.bisections_left = options.bisections;
  return state;
}

/// Cells of generators on one line would do, but no mesh of them.
void require_triangle(const Sites& sites) {
  const auto given = [&](std::int32_t id) { return Vec2{sites.given(id).x, sites.given(id).y}; };
  for (std::int32_t id = 2; id < sites.size(); ++id)
    if (orientation(given(0), given(1), given(id)) != 0)
      return;
  throw Error(ErrorCode::degenerate,
              "all generators lie on one line: add one off it, they span no triangle");
}

CvtState begin(const Points2& start, const CvtOptions& options) {
  Sites sites = make_sites(start, options.partition.duplicates, options.partition.merge_within);
  require_triangle(sites);
  CvtState state;
  InPlane::set_places(state, sites);
  state.site_of_input = std::move(sites.site_of_input);
  state.bisections_left = options.bisections;
  return state;
}

/// The next level's start.
template <class World> void refine(const World& world, CvtState& state) {
  world.set_bisected(state, in_order(state));
  state.site_of_input.clear();
  --state.bisections_left;
  state.iterations_of_level = 0;
  state.final_rule = false;
  state.memory = {};
  state.report.converged = false;
}

template <class World>
typename World::Result run(const World& world, CvtState state, CvtOptions options,
                           const CvtStop& stop) {
  require_options(options);
  options.density = world.density(options.density);
  require_state(state);
  world.require_points(state);
  require_room(world, state);
  Clock::time_point mark = Clock::now();
  const double before = state.report.seconds;
  bool stopped = iterate(world, state, options, stop);
  while (!stopped && state.bisections_left > 0) {
    refine(world, state);
    stopped = iterate(world, state, options, stop);
  }
  typename World::Result result;
  result.mesh = world.mesh(in_order(state));
  if (!state.site_of_input.empty())
    result.mesh.site_of_input = std::move(state.site_of_input);
  result.report = std::move(state.report);
  result.report.converged = result.report.converged && state.bisections_left == 0;
  result.report.seconds = before + lap(mark);
  return result;
}

} // namespace
} // namespace cvt_detail

double norm_of(const CvtIteration& iteration, Norm norm) {
  switch (norm) {
  case Norm::l2:
    return iteration.l2;
  case Norm::linf:
    return iteration.linf;
  case Norm::l2_scaled:
    return iteration.l2 / iteration.spacing;
  case Norm::linf_scaled:
    return iteration.linf / iteration.spacing;
  case Norm::gradient:
    return iteration.gradient;
  default:
    return 0;
  }
}

Cvt cvt(CvtState state, const CvtOptions& options, const CvtStop& stop) {
  return cvt_detail::run(cvt_detail::OnSphere(), std::move(state), options, stop);
}

Cvt cvt(Points3 start, const CvtOptions& options, const CvtStop& stop) {
  cvt_detail::require_options(options);
  cvt_detail::OnSphere::density(options.density);
  return cvt(cvt_detail::begin(std::move(start), options), options, stop);
}

PlanarCvt cvt(CvtState state, const PlanarDomain& domain, const CvtOptions& options,
              const CvtStop& stop) {
  return cvt_detail::run(cvt_detail::InPlane(domain), std::move(state), options, stop);
}

PlanarCvt cvt(const Points2& start, const PlanarDomain& domain, const CvtOptions& options,
              const CvtStop& stop) {
  cvt_detail::require_options(options);
  const cvt_detail::InPlane plane(domain);
  plane.density(options.density);
  cvt_detail::require_inside(start, domain);
  return cvt(cvt_detail::begin(start, options), domain, options, stop);
}

} // namespace calotte
