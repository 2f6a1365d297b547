// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/room.h"
#include "integrals/room.h"

/// The Voronoi tessellation that is dual to a mesh, with the data of a staggered C-grid: edges,
/// kites, lengths, areas, angles, tangential weights, and fields on the cells.
///
/// In: a closed mesh, or one of a bounded surface. Out: flat arrays of connectivity and
/// measures.
namespace calotte::voronoi_detail {
using namespace delaunay_detail; // and the rooms below it
using namespace integrals_detail;
} // namespace calotte::voronoi_detail
