// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "domain/planar_domain.h"
#include "generators/room.h"
#include "mesh/planar_mesh.h"

#include <calotte/types.h>

/// The points that a bisection or an insertion adds.
namespace calotte::generators_detail {

/// The unit vector of a direction.
Vec3 unit_of_any_norm(const Vec3& a);

/// The midpoint of the shorter arc, the same bits from a to b as from b to a.
Vec3 midpoint(const Vec3& a, const Vec3& b);

/// The middle of the shorter way from one place in a box to another, in the box; for one
/// coordinate.
/// \param length of the box; 0 in a direction without a period.
double middle_in_box(double a, double b, double length);

/// As bisect(). \param domain the rings alone: none if all midpoints stay.
Points2 bisected(const PlanarMesh& mesh, const PlanarDomain& domain);

} // namespace calotte::generators_detail
