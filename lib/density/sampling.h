// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/density.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cstdint>

namespace calotte::density_detail {

/// Draws n independent random points distributed as a density on a surface. Proposals come from the
/// density's envelope (envelope.h); each is accepted with probability rho over the envelope (von
/// Neumann, 1951). The random numbers of a proposal depend only on the seed and the index of the
/// proposal.
///
/// A proposal above the envelope, which only a callable can cause, shows that the points drawn so
/// far follow the wrong distribution. The function then raises the envelope there and draws all
/// points again.
///
/// \pre the density is not uniform on the whole sphere.
/// \throws Error invalid_argument as random_points().
Points3 draw(std::int64_t n, const Density& density, const Surface& surface, std::uint64_t seed);

} // namespace calotte::density_detail
