// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/surface_density.h"

#include "base/points.h"
#include "base/require.h"
#include "density/density_evaluator.h"
#include "exact/space.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace calotte::density_detail {
namespace {

/// The profiles of a density's bumps in a plane. \pre the density has bumps.
std::vector<Profile> planar_profiles(const Density& density) {
  require(!density.bumps.empty(), "the density has no bump: give one, or make it uniform");
  std::vector<Profile> profiles;
  for (std::size_t b = 0; b < density.bumps.size(); ++b) {
    const DensityBump& bump = density.bumps[b];
    Profile profile = profile_without_centre(bump, b);
    require_of_bump(b, bump.centre.head<2>().allFinite(), "the centre is not finite; give a place");
    profile.centre = {bump.centre.x(), bump.centre.y(), 0};
    const double length = bump.major.head<2>().norm();
    require_of_bump(b, bump.stretch == 1 || (length > 0 && std::isfinite(length)),
                    "the long axis has no direction in the plane; give one");
    if (bump.stretch > 1)
      profile.major = {bump.major.x() / length, bump.major.y() / length, 0};
    profiles.push_back(profile);
  }
  return profiles;
}

double distance_from(const Profile& bump, const Vec3& x, const Plane& plane) {
  const Vec3 apart = plane.offset(bump.centre, x);
  const double squeeze = bump.shrink * (apart.x * bump.major.x + apart.y * bump.major.y);
  const Vec2 reduced{apart.x - squeeze * bump.major.x, apart.y - squeeze * bump.major.y};
  return std::sqrt(reduced.x * reduced.x + reduced.y * reduced.y);
}

Density::Callable bump_values(const Density& density, const Plane& plane) {
  return [profiles = planar_profiles(density), plane, sum = density.kind == Density::Kind::sum](
             const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const Vec3 point{x(0, i), x(1, i), 0};
      double value = 0;
      for (const Profile& bump : profiles) {
        const double here = value_at(bump, distance_from(bump, point, plane));
        value = sum ? value + here : std::max(value, here);
      }
      rho[i] = value;
    }
  };
}

/// Evaluates a callable at copies of points inside the box.
Density::Callable in_box(Density::Callable callable, const Plane& plane) {
  return [callable = std::move(callable), plane](const Eigen::Ref<const Points3>& x,
                                                 Eigen::Ref<Eigen::VectorXd> rho) {
    Points3 inside = x;
    for (Eigen::Index i = 0; i < inside.cols(); ++i)
      set_column(inside, i, plane.wrapped(column(inside, i)));
    callable(inside, rho);
  };
}

} // namespace

Density surface_density(const Density& density, const Surface& surface) {
  if (surface.is_sphere() || density.uniform())
    return density;
  const bool bumps = has_bumps(density);
  const Density::Callable given = make_callable(density);
  if (!bumps && (!given || surface.period().isZero(0))) // none is rejected at its use
    return density;
  Density planar;
  planar.kind = Density::Kind::callable;
  const Plane plane(surface.period());
  planar.callable = bumps ? bump_values(density, plane) : in_box(given, plane);
  return planar;
}

Density::Callable make_callable(const Density& density) {
  if (density.kind == Density::Kind::callable)
    return density.callable;
  if (density.kind != Density::Kind::widths || density.widths == nullptr)
    return {};
  return [widths = density.widths](const Eigen::Ref<const Points3>& x,
                                   Eigen::Ref<Eigen::VectorXd> rho) { widths->densities(x, rho); };
}

Density checked_surface_density(const Density& density, const Surface& surface) {
  Density of_surface = surface_density(density, surface);
  Eigen::Vector3d some = Eigen::Vector3d::UnitZ();
  if (!surface.is_sphere()) {
    some.setZero();
    if (surface.is_bounded())
      some.head<2>() = surface.rings()[0].col(0);
  }
  evaluate(of_surface, Points3(some)); // throws if the density is ill-formed
  return of_surface;
}

} // namespace calotte::density_detail
