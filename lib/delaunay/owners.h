// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curve/quadtree.h"
#include "delaunay/room.h"

#include <cstdint>
#include <vector>

namespace calotte::delaunay_detail {

/// Below this number of sites a descent tests each site.
constexpr std::int64_t leaf_size = 16;

/// Cells of similar size that together contain all sites, in curve order: the tasks of a descent.
std::vector<QuadtreeCell> task_cells(const Quadtree& tree);

/// The indices of all centres.
std::vector<std::int32_t> all_of(const std::vector<Vec3>& centres);

/// The nearest centre of each of several directions sorted along the curve; a tie goes to the
/// lowest index.
Array<std::int32_t> owners(const Quadtree& tree, const Array<Vec3>& unit,
                           const std::vector<Vec3>& centres);

} // namespace calotte::delaunay_detail
