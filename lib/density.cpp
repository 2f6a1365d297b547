// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/density.h>

#include "elementary.h"
#include "predicates.h"

#include <calotte/error.h>

#include <cmath>
#include <string>

namespace calotte {
namespace detail {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_option, what); }

void require(const Bump& bump, std::size_t b) {
  const std::string name = "bump " + std::to_string(b) + " of the density: ";
  if (!bump.centre.allFinite() || bump.centre.isZero(0))
    refuse(name + "the centre has no direction; give a finite, non-zero vector");
  if (!(bump.beta > 0) || !std::isfinite(bump.beta))
    refuse(name + "beta must be a positive angle");
  if (!(bump.alpha > 0) || !std::isfinite(bump.alpha))
    refuse(name + "alpha must be a positive angle");
  if (!(bump.gamma > 0) || !(bump.gamma < 1))
    refuse(name + "gamma must lie between 0 and 1");
  if (!(bump.stretch >= 1) || !std::isfinite(bump.stretch))
    refuse(name + "stretch must be at least 1");
}

/// A bump as its inner loop needs it.
struct Profile {
  Vec3 centre, major; ///< unit vectors; major tangential
  double shrink;      ///< 1 - 1/stretch, by which offsets along major are reduced
  double beta, minus_two_over_alpha, height, gamma;
};

Profile profile_of(const Bump& bump) {
  const Vec3 centre = normalised({bump.centre[0], bump.centre[1], bump.centre[2]});
  Vec3 major{0, 0, 0};
  if (bump.stretch > 1) {
    const Vec3 given{bump.major[0], bump.major[1], bump.major[2]};
    const Vec3 tangent = given - dot(given, centre) * centre;
    if (!(norm(tangent) > 0))
      refuse("the long axis of a stretched bump points along its centre: give another direction");
    major = normalised(tangent);
  }
  return {centre,    major, 1 - 1 / bump.stretch, bump.beta, -2 / bump.alpha, 1 / (1 - bump.gamma),
          bump.gamma};
}

/// rho = gamma + 1 / ((1 - gamma) (1 + exp(-2 (beta - d)/alpha))), which is the tanh of the header,
/// with the angle d = 2 asin(|x - c|/2): acos(x.c) would lose half of the digits near the centre.
CALOTTE_VECTOR_WIDTHS
void add_bump(const Profile& bump, const double* x, std::int64_t count, bool maximum, double* rho) {
  for (std::int64_t j = 0; j < count; ++j) {
    Vec3 apart = Vec3{x[3 * j], x[3 * j + 1], x[3 * j + 2]} - bump.centre;
    apart = apart - (bump.shrink * dot(apart, bump.major)) * bump.major;
    const double half_chord = 0.5 * std::sqrt(dot(apart, apart));
    const double angle = 2 * arc_sine(half_chord < 1 ? half_chord : 1);
    const double value =
        bump.gamma +
        bump.height / (1 + exponential((bump.beta - angle) * bump.minus_two_over_alpha));
    rho[j] = maximum ? (value > rho[j] ? value : rho[j]) : rho[j] + value;
  }
}

} // namespace
} // namespace detail

Density tanh_bump(const Eigen::Vector3d& centre, double beta, double alpha, double gamma) {
  Density density;
  density.kind = Density::Kind::maximum;
  density.bumps.push_back({centre, beta, alpha, gamma});
  return density;
}

Eigen::VectorXd evaluate(const Density& density, const Points3& x) {
  switch (density.kind) {
  case Density::Kind::uniform:
    return Eigen::VectorXd::Ones(x.cols());
  case Density::Kind::callable: {
    if (!density.callable)
      detail::refuse("the density is a callable, but none is given");
    Eigen::VectorXd rho(x.cols());
    density.callable(x, rho);
    if (!(rho.array() >= 0).all()) // NaN included
      detail::refuse("the density is negative or NaN somewhere: make it positive everywhere");
    return rho;
  }
  default:
    break;
  }
  if (density.bumps.empty())
    detail::refuse("the density has no bump: give one, or make it uniform");
  Eigen::VectorXd rho = Eigen::VectorXd::Zero(x.cols());
  for (std::size_t b = 0; b < density.bumps.size(); ++b) {
    detail::require(density.bumps[b], b);
    detail::add_bump(detail::profile_of(density.bumps[b]), x.data(), x.cols(),
                     density.kind == Density::Kind::maximum, rho.data());
  }
  return rho;
}

} // namespace calotte
