// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "exact/room.h"

/// Orders of traversal: Hilbert's curve on the faces of a cube, the quadtree of sorted curve keys,
/// a parallel radix sort, and the order in which a pass over a large mesh visits its triangles.
///
/// In: unit vectors, or points of the plane. Out: keys, permutations, and runs of sorted ranks.
namespace calotte::curve_detail {
using namespace exact_detail; // and the rooms below it
}
