// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/room.h"

#include <calotte/mesh.h>

namespace calotte::domain_detail {

/// A ring without the loops in which it crosses or touches itself, as simplified coasts do. Of the
/// two ways from one arc to another that it meets, the one with fewer corners is left out, until no
/// arcs meet. A ring of which a tenth of the corners would go at once is returned as it is.
/// \param ring 3 x corners.
/// \throws Error as rings_of().
Points3 without_loops(const Points3& ring);

} // namespace calotte::domain_detail
