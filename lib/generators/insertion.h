// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/spherical_outline.h"
#include "generators/room.h"

#include <calotte/density.h>
#include <calotte/domain.h>
#include <calotte/types.h>

#include <cstdint>

namespace calotte::generators_detail {

/// An estimate of the number of dislocations that a mesh needs so that its spacing can follow a
/// density: the integral of |grad h| / h^2, h the spacing. It grows as sqrt(n), and is 0 for
/// uniform density.
double dislocations(const Mesh& mesh, const Density& density);

/// The same in the plane. \pre the density is that of planar_density().
double dislocations(const PlanarMesh& mesh, const Density& density);

/// As insert_and_contract().
/// \param mend takes up to the smaller of the two numbers of such edges of each kind, far from each
///        other, and further edges only for the difference of the numbers; without such edges as
///        ever.
Points3 exchanged(const Mesh& mesh, const Density& density, std::int64_t inserted,
                  std::int64_t contracted, bool mend);
/// The same where midpoints must lie in a region.
Points3 exchanged(const Mesh& mesh, const SphericalOutline& outline, const Density& density,
                  std::int64_t inserted, std::int64_t contracted, bool mend);
Points2 exchanged(const PlanarMesh& mesh, const PlanarDomain& domain, const Density& density,
                  std::int64_t inserted, std::int64_t contracted, bool mend);

} // namespace calotte::generators_detail
