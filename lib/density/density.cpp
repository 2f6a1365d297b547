// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/density.h>

#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "density/density_evaluator.h"
#include "density/surface_density.h"
#include "domain/surface.h"
#include "exact/predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace calotte {
namespace density_detail {
namespace {

Profile make_profile(const DensityBump& bump, std::size_t b) {
  Profile profile = profile_without_centre(bump, b);
  require_of_bump(b, bump.centre.allFinite() && !bump.centre.isZero(0),
                  "the centre has no direction; give a finite, non-zero vector");
  profile.centre = normalised({bump.centre[0], bump.centre[1], bump.centre[2]});
  if (bump.stretch > 1) {
    const Vec3 given{bump.major[0], bump.major[1], bump.major[2]};
    const Vec3 tangent = given - dot(given, profile.centre) * profile.centre;
    if (!(norm(tangent) > 0))
      refuse("the long axis of a stretched bump points along its centre: give another direction");
    profile.major = normalised(tangent);
  }
  return profile;
}

/// The chord from a unit vector to the nearer end of the axis of a bump.
struct Chord {
  double square;
  double side; ///< negative where that end is the antipode of the centre
};

/// For a stretched bump, |x - c| is the reduced length.
CALOTTE_INLINE Chord chord_from(const Profile& bump, const Vec3& x) {
  const double along = dot(x, bump.major), squeeze = bump.shrink * along;
  const Vec3 apart = x - bump.centre - squeeze * bump.major, sum = x + bump.centre;
  const double near = dot(apart, apart), far = dot(sum, sum) + (2 - bump.shrink) * squeeze * along;
  return {far < near ? far : near, far - near};
}

/// The angle between a unit vector and the centre: 2 asin(|x - c|/2) in the near hemisphere and pi
/// - 2 asin(|x + c|/2) in the far one. acos(x.c) would lose half of the digits near the centre, and
/// the first form in the far hemisphere.
CALOTTE_INLINE double angle_of(double arc, double side) {
  return side < 0 ? std::numbers::pi - arc : arc;
}

/// Densities are computed in rows of up to this many points.
constexpr std::size_t row = 64;
using Row = std::array<double, row>;

/// The loops are separate: fused, an iteration would be one long chain of dependent operations, and
/// the processor could overlap few iterations.
CALOTTE_INLINE void bump_row(const Profile& bump, const double* x, const double* y, const double* z,
                             std::size_t count, double* rho) {
  alignas(64) Row square, side, angle;
  CALOTTE_VECTOR_LOOP
  for (std::size_t j = 0; j < count; ++j) {
    const Chord chord = chord_from(bump, {x[j], y[j], z[j]});
    square[j] = chord.square;
    side[j] = chord.side;
  }
  CALOTTE_VECTOR_LOOP
  for (std::size_t j = 0; j < count; ++j)
    angle[j] = angle_of(arc_of_chord(square[j]), side[j]);
  CALOTTE_VECTOR_LOOP
  for (std::size_t j = 0; j < count; ++j)
    rho[j] = value_at(bump, angle[j]);
}

CALOTTE_VECTOR_WIDTHS
void bump_values(const Profile& profile, const double* x, const double* y, const double* z,
                 std::size_t count, double* rho) {
  const Profile bump = profile; // writing to rho cannot change it
  for (std::size_t j = 0; j < count; j += row)
    bump_row(bump, x + j, y + j, z + j, std::min(row, count - j), rho + j);
}

void join(const double* values, std::size_t count, bool maximum, double* rho) {
  for (std::size_t j = 0; j < count; ++j)
    rho[j] = maximum ? std::max(rho[j], values[j]) : rho[j] + values[j];
}

std::vector<Profile> make_profiles(const Density& density) {
  using Kind = Density::Kind;
  const bool bumps = has_bumps(density);
  if (!bumps && !density.uniform() && density.kind != Kind::widths &&
      density.kind != Kind::callable)
    refuse("the density is of an unknown kind; give one of Density::Kind");
  if (bumps && density.bumps.empty())
    refuse("the density has no bump: give one, or make it uniform");
  if (density.kind == Kind::widths && density.widths == nullptr)
    refuse("the density is that of cell widths, but has none; see density_of()");
  if (density.kind == Kind::callable && !density.callable)
    refuse("the density is a callable, but none is given");
  if (density.uniform() && (density.callable || density.widths || !density.bumps.empty()))
    refuse("the density is uniform, but has bumps, widths or a callable; set its kind, too");
  std::vector<Profile> profiles;
  for (std::size_t b = 0; bumps && b < density.bumps.size(); ++b) {
    profiles.push_back(make_profile(density.bumps[b], b));
  }
  return profiles;
}

} // namespace

Profile profile_without_centre(const DensityBump& bump, std::size_t b) {
  require_of_bump(b, bump.beta > 0 && std::isfinite(bump.beta), "beta must be positive");
  require_of_bump(b, bump.alpha > 0 && std::isfinite(bump.alpha), "alpha must be positive");
  require_of_bump(b, bump.gamma > 0 && bump.gamma < 1, "gamma must lie between 0 and 1");
  require_of_bump(b, bump.stretch >= 1 && std::isfinite(bump.stretch),
                  "stretch must be at least 1");
  return {{0, 0, 0},
          {0, 0, 0},
          1 - 1 / bump.stretch,
          bump.beta,
          -2 * std::numbers::log2e / bump.alpha,
          1 / (1 - bump.gamma),
          bump.gamma};
}

DensityEvaluator::DensityEvaluator(const Density& density)
    : density_(density), profiles_(make_profiles(density)) {}

void DensityEvaluator::operator()(std::span<const double> x, std::span<const double> y,
                                  std::span<const double> z, std::span<double> rho) const {
  if (density_.kind == Density::Kind::widths) {
    density_.widths->densities(x.data(), y.data(), z.data(), rho.size(), rho.data());
    return;
  }
  if (density_.kind == Density::Kind::callable) {
    call(x, y, z, rho);
    return;
  }
  if (density_.uniform())
    std::fill(rho.begin(), rho.end(), 1.0);
  constexpr std::size_t most = 512;
  std::array<double, most> values;
  for (std::size_t begin = 0; begin < rho.size(); begin += most) {
    const std::size_t count = std::min(most, rho.size() - begin);
    for (std::size_t b = 0; b < profiles_.size(); ++b) {
      double* const out = b == 0 ? rho.data() + begin : values.data();
      bump_values(profiles_[b], x.data() + begin, y.data() + begin, z.data() + begin, count, out);
      if (b > 0)
        join(out, count, density_.kind == Density::Kind::maximum, rho.data() + begin);
    }
  }
}

void DensityEvaluator::operator()(const Vec3* columns, std::int64_t count, double* rho) const {
  constexpr std::int64_t most = 512;
  std::array<std::array<double, most>, 3> rows;
  for (std::int64_t begin = 0; begin < count; begin += most) {
    const std::int64_t size = std::min(most, count - begin);
    for (std::int64_t j = 0; j < size; ++j) {
      const Vec3& x = columns[begin + j];
      const auto at = static_cast<std::size_t>(j);
      rows[0][at] = x.x, rows[1][at] = x.y, rows[2][at] = x.z;
    }
    const auto block = [&](std::size_t i) {
      return std::span<const double>(rows[i]).first(static_cast<std::size_t>(size));
    };
    (*this)(block(0), block(1), block(2), {rho + begin, static_cast<std::size_t>(size)});
  }
}

Bounds DensityEvaluator::bounds(const Vec3& middle, double reach) const {
  constexpr double slack = 1e-14; // for an angle and for a value: more than the rounding error
  Bounds bounds{0, 0};
  for (const Profile& profile : profiles_) {
    const double change = reach * (profile.shrink > 0 ? std::numbers::sqrt2 : 1) + slack;
    const Chord chord = chord_from(profile, middle);
    const double angle = angle_of(arc_of_chord(chord.square), chord.side);
    const double least = value_at(profile, std::min(std::numbers::pi, angle + change)),
                 greatest = value_at(profile, std::max(0.0, angle - change)) * (1 + slack);
    const bool sum = density_.kind == Density::Kind::sum;
    bounds.least = sum ? bounds.least + least : std::max(bounds.least, least);
    bounds.greatest = sum ? bounds.greatest + greatest : std::max(bounds.greatest, greatest);
  }
  return bounds;
}

void DensityEvaluator::call(std::span<const double> x, std::span<const double> y,
                            std::span<const double> z, std::span<double> rho) const {
  Points3 columns(3, static_cast<Eigen::Index>(x.size()));
  for (std::size_t j = 0; j < x.size(); ++j)
    columns.col(static_cast<Eigen::Index>(j)) << x[j], y[j], z[j];
  DoubleVector values = DoubleVector::Zero(columns.cols());
  density_.callable(columns, values);
  if (values.size() != columns.cols() || !(values.array() >= 0).all() || // NaN included
      !values.allFinite())
    refuse("the density is negative, infinite or NaN somewhere: make it positive everywhere");
  std::copy(values.begin(), values.end(), rho.begin());
}

} // namespace density_detail

Density density_of(std::function<double(const Eigen::Vector3d& x)> rho) {
  if (!rho)
    base_detail::refuse("the function of a density is empty; give one");
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [rho = std::move(rho)](const Eigen::Ref<const Points3>& x,
                                            Eigen::Ref<Eigen::VectorXd> values) {
    for (Eigen::Index j = 0; j < x.cols(); ++j)
      values[j] = rho(x.col(j));
  };
  return density;
}

Density tanh_bump(const Eigen::Vector3d& centre, double beta, double alpha, double gamma) {
  Density density;
  density.kind = Density::Kind::maximum;
  density.bumps.push_back({centre, beta, alpha, gamma});
  return density;
}

Density site_density(const Density& density, const Surface& surface) {
  if (!surface.is_sphere())
    return site_density(density_detail::surface_density(density, surface));
  if (density.uniform())
    return density;
  Density root;
  root.kind = Density::Kind::callable;
  root.callable = [evaluator = std::make_shared<const density_detail::DensityEvaluator>(density)](
                      const Eigen::Ref<const Points3>& points, Eigen::Ref<Eigen::VectorXd> rho) {
    const DoubleVector x = points.row(0), y = points.row(1), z = points.row(2);
    DoubleVector values(x.size());
    (*evaluator)({x.data(), static_cast<std::size_t>(x.size())},
                 {y.data(), static_cast<std::size_t>(y.size())},
                 {z.data(), static_cast<std::size_t>(z.size())},
                 {values.data(), static_cast<std::size_t>(values.size())});
    rho = values.cwiseSqrt();
  };
  return root;
}

DoubleVector evaluate(const Density& density, const PointsRef& points, const Surface& surface) {
  if (!surface.is_sphere())
    return evaluate(density_detail::surface_density(density, surface),
                    base_detail::with_z(base_detail::plane_points_of(points)));
  const base_detail::Points3Ref x = base_detail::directions_of(points);
  const density_detail::DensityEvaluator evaluator(density);
  DoubleVector rho(x.cols());
  base_detail::for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    if (x.outerStride() == 3) {
      evaluator(&base_detail::column(x, begin), end - begin, rho.data() + begin);
      return;
    }
    const Points3 part = x.middleCols(begin, end - begin);
    evaluator(&base_detail::column(part, 0), end - begin, rho.data() + begin);
  });
  return rho;
}

} // namespace calotte
