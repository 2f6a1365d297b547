// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "domain/arcs.h"
#include "domain/room.h"
#include "domain/surface.h"

/// Points that move along a boundary.
namespace calotte::domain_detail {

/// The unit vector to the left of an edge of a boundary.
template <Space S> Vec3 left_of(const Arc& edge);

/// A point of the boundary as it is given by rounding, moved inside by some roundoffs if it lies
/// outside.
/// \param left unit vector from the point into the surface.
template <Space S> Vec3 pushed_inside(const OutlineOf<S>& outline, const Vec3& x, const Vec3& left);

/// The direction of the boundary at a point of it, a unit vector with the surface to its left: the
/// mean over the edges within a distance. The zero vector where these turn by more than 60 degrees:
/// a point that moves along the boundary stays at such a corner.
/// \param reach radians, in a plane its unit; > 0.
template <Space S> Vec3 along_boundary(const OutlineOf<S>& outline, const Vec3& x, double reach);

/// Where a point of the boundary is after a motion along it: the point nearest to x + way of the
/// edges that lead in the same direction, not outside by rounding. It is x if there is none within
/// the length of the way.
template <Space S>
Vec3 slid_on_boundary(const OutlineOf<S>& outline, const Vec3& x, const Vec3& way, double reach);

extern template Vec3 left_of<Sphere>(const Arc&);
extern template Vec3 left_of<Plane>(const Arc&);
extern template Vec3 pushed_inside<Sphere>(const SphericalOutline&, const Vec3&, const Vec3&);
extern template Vec3 pushed_inside<Plane>(const Outline&, const Vec3&, const Vec3&);
extern template Vec3 along_boundary<Sphere>(const SphericalOutline&, const Vec3&, double);
extern template Vec3 along_boundary<Plane>(const Outline&, const Vec3&, double);
extern template Vec3 slid_on_boundary<Sphere>(const SphericalOutline&, const Vec3&, const Vec3&,
                                              double);
extern template Vec3 slid_on_boundary<Plane>(const Outline&, const Vec3&, const Vec3&, double);

} // namespace calotte::domain_detail
