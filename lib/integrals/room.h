// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

/// Integrals over Voronoi cells: quadrature rules, the patch of the mesh that a region reads, and
/// masses, first moments and energies of its cells in rows of vector code.
///
/// In: a region's triangles, positions and a density. Out: the moments of the cells that it owns.
namespace calotte::integrals_detail {
using namespace density_detail; // and the rooms below it
}
