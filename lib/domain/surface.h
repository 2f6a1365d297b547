// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/outline.h"
#include "domain/room.h"
#include "domain/spherical_outline.h"
#include "exact/space.h"

#include <calotte/surface.h>

#include <cstdint>
#include <string>
#include <type_traits>

namespace calotte::domain_detail {

/// Makes surfaces without a check.
struct UncheckedSurface {
  static Surface of_sphere(Surface::Rings rings);
  /// \param period has no effect if there are rings.
  static Surface of_plane(Surface::Rings rings, const Eigen::Vector2d& period);
  /// See outline_of().
  static const SphericalOutline* outline_on_sphere(const Surface& surface);
  static const Outline* outline_in_plane(const Surface& surface);
};

/// The boundary of a surface in a space.
template <Space S> using OutlineOf = std::conditional_t<S::on_sphere, SphericalOutline, Outline>;

/// The boundary of a surface, prepared for queries; null without one. It lives as long as the
/// surface and its copies.
/// \pre the surface lies in the space.
/// \throws Error as Surface::within(), for a surface made without a check.
template <Space S> const OutlineOf<S>* outline_of(const Surface& surface) {
  if constexpr (S::on_sphere)
    return UncheckedSurface::outline_on_sphere(surface);
  else
    return UncheckedSurface::outline_in_plane(surface);
}

/// The side of a point; always inside on a surface without a boundary.
template <Space S> Side side_of(const OutlineOf<S>* outline, const Vec3& x) {
  if (outline == nullptr)
    return Side::inside;
  if constexpr (S::on_sphere)
    return outline->side(x);
  else
    return outline->side({x.x, x.y});
}

/// \param fixed number of fixed generators, which come first, for the message.
/// \throws Error invalid_argument with the index of the first point outside the surface: beyond its
///         boundary, or outside the box of a plane that is periodic.
void require_inside(const Points3Ref& points, const Surface& surface, std::int64_t fixed = 0);

/// \pre the surface is a plane.
/// \throws Error invalid_argument for a plane without an end: neither bounded nor a periodic box.
void require_finite_plane(const Surface& surface);

/// \param what is for the sphere alone, for the message: "a limited area is".
/// \throws Error invalid_argument for a plane.
void require_sphere(const Surface& surface, const std::string& what);
/// \param what is for the plane alone, for the message: "a lattice is".
/// \throws Error invalid_argument for the sphere.
void require_plane(const Surface& surface, const std::string& what);

} // namespace calotte::domain_detail
