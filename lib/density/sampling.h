// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/density.h>
#include <calotte/domain.h>
#include <calotte/types.h>

#include <cstdint>

namespace calotte::density_detail {

/// n independent points distributed as a density that is not uniform: proposals from its envelope
/// (envelope.h), each accepted with probability rho over the envelope (von Neumann, 1951). The
/// numbers behind a proposal depend on the seed and its place in the sequence alone.
///
/// A proposal above its envelope, which only a callable's can be, shows that what was drawn so far
/// follows the wrong distribution: it is thrown away, the envelope raised there, and all drawn
/// anew.
///
/// \throws Error bad_option as random_sphere(n, density, seed).
Points3 draw(std::int64_t n, const Density& density, std::uint64_t seed);

/// The same in a domain of the plane. \param density uniform, or a callable of places (x, y, 0).
/// \throws Error bad_option as random_places(n, domain, density, seed).
Points2 draw(std::int64_t n, const Density& density, const PlanarDomain& domain,
             std::uint64_t seed);

} // namespace calotte::density_detail
