// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "domain/outline.h"
#include "domain/spherical_outline.h"
#include "exact/space.h"
#include "integrals/integrand.h"
#include "integrals/kites.h"
#include "integrals/room.h"

#include <vector>

/// Moments of single cells that a boundary may clip.
namespace calotte::integrals_detail {

/// The square of the distance from a triangle's corners to its circumcentre.
double circumradius2(const Sphere&, const Vec3& a, const Vec3& b, const Vec3& c);
double circumradius2(const Plane&, const Vec3& a, const Vec3& b, const Vec3& c);

/// Whether the boundary comes within a distance of x. \param square of the distance.
bool near_boundary(const SphericalOutline& outline, const Vec3& x, double square);
bool near_boundary(const Outline& outline, const Vec3& x, double square);

/// The moments of the part of a site's cell inside the boundary.
///
/// The cell is computed in a plane; on the sphere, in the tangent plane at the site, see
/// TangentLift, where bisectors and boundary are straight lines. Its sides are the parts of its
/// Voronoi edges inside the boundary and the parts of the boundary inside the cell. The density may
/// be evaluated outside of the surface, but within the cell.
///
/// Beside a boundary that is not convex, the centroid may lie outside. Then `first` is that of a
/// cell whose centroid is the nearest point of the boundary within the cell, so that a generator at
/// its centroid is inside, as near to the true centroid as possible.
/// \param neighbours of the cell, in any order.
CellMoments clipped_moments(const Integrand& integrand, const SphericalOutline& outline,
                            const Vec3& site, const std::vector<Vec3>& neighbours);
CellMoments clipped_moments(const Integrand& integrand, const Outline& outline, const Vec3& site,
                            const std::vector<Vec3>& neighbours);

/// The area in steradians of the part of a cell inside a region; 0 for a site whose cell does not
/// meet it. \param neighbours of the cell, unit vectors in any order.
double clipped_area(const SphericalOutline& outline, const Vec3& site,
                    const std::vector<Vec3>& neighbours);

} // namespace calotte::integrals_detail
