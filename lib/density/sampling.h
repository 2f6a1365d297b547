// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"
#include "domain/planar_domain.h"
#include "domain/spherical_outline.h"

#include <calotte/density.h>
#include <calotte/types.h>

#include <cstdint>

namespace calotte::density_detail {

/// n independent points distributed as a density that is not uniform: proposals from its envelope
/// (envelope.h), each accepted with probability rho over the envelope (von Neumann, 1951). The
/// random numbers of a proposal depend only on the seed and the index of the proposal.
///
/// A proposal above the envelope, which only a callable can cause, shows that the points drawn so
/// far follow the wrong distribution. The function then raises the envelope there and draws all
/// points again.
///
/// \throws Error invalid_argument as random_sphere(n, density, seed).
Points3 draw(std::int64_t n, const Density& density, std::uint64_t seed);

/// The same in a region of the sphere, also for uniform density.
Points3 draw(std::int64_t n, const Density& density, const SphericalOutline& outline,
             std::uint64_t seed);

/// The same in a domain of the plane. \param density uniform, or a callable of places (x, y, 0).
/// \throws Error invalid_argument as random_points().
Points2 draw(std::int64_t n, const Density& density, const PlanarDomain& domain,
             std::uint64_t seed);

} // namespace calotte::density_detail
