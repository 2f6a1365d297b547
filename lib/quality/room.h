// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

/// Measures of the quality of a grid: spacings, angles, areas, quality of cells and triangles,
/// distance from the centroids, energy.
///
/// In: a mesh, closed, open or in a domain. Out: ranges, counts, errors of operators, eigenvalues.
namespace calotte::quality_detail {
using namespace voronoi_detail; // and the rooms below it
}
