// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curve/room.h"

/// Domains of the plane: polygons with holes and doubly periodic boxes, exact tests of inside and
/// outside, and Voronoi cells clipped by the boundary. Regions of the sphere: polygons of arcs of
/// great circles, and the same tests.
///
/// In: rings of corners and a period. Out: outlines with search grids, and clipped cells.
namespace calotte::domain_detail {
using namespace curve_detail; // and the rooms below it
}
