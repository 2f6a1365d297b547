// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/room.h"

#include <calotte/mesh.h>

namespace calotte::domain_detail {

/// A ring without the loops in which it crosses or touches itself, as simplified coasts do. Where
/// two arcs meet, the part of the ring between them with fewer corners is removed, until no arcs
/// meet. If that would remove a tenth of the corners at once, the ring is returned unchanged.
/// \param ring 3 x corners.
/// \throws Error as rings_of().
Points3 without_loops(const Points3& ring);

} // namespace calotte::domain_detail
