// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "integrals/room.h"
#include "integrals/rows.h"

#include <vector>

namespace calotte::integrals_detail {

/// Computes the rows of slivers again, from the directions of their corners without rounding:
/// triangles of three sites close together, of two beside each other and one far away, or of two
/// that are nearly antipodal. Their circumcentres follow from the last digits of the directions:
/// with those of the stored corners, the cells of a cluster would overlap.
/// \return the slivers of the batch.
std::vector<Sliver> resolve_slivers(const Batch& batch, TriangleRows& rows);

} // namespace calotte::integrals_detail
