// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curve/quadtree.h"
#include "delaunay/room.h"

#include <cstdint>
#include <vector>

namespace calotte::delaunay_detail {

/// Of so few sites a descent looks at each.
constexpr std::int64_t leaf_size = 16;

/// Cells of like size that together hold all sites, in the order of the curve: the tasks of a
/// descent.
std::vector<QuadtreeCell> task_cells(const Quadtree& tree);

/// The numbers of all centres.
std::vector<std::int32_t> all_of(const std::vector<Vec3>& centres);

/// The nearest centre of each of some directions sorted along the curve, ties to the lowest.
Array<std::int32_t> owners(const Quadtree& tree, const Array<Vec3>& unit,
                           const std::vector<Vec3>& centres);

} // namespace calotte::delaunay_detail
