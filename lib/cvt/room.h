// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

/// The iteration to a centroidal Voronoi tessellation: mesh -> [ exchange, integrate, repair ] for
/// each region -> step -> converged? Its methods are steps over one functional of the generators.
/// Between descents, edges are split and contracted, and dislocations moved.
///
/// In: a start, a density and options. Out: converged generators with their mesh, and a report.
namespace calotte::cvt_detail {
using namespace voronoi_detail; // and the rooms below it
}
