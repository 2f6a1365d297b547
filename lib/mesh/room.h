// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curve/room.h"

/// The structure of a mesh: its edges, the triangles around each vertex, neighbours rebuilt from
/// triangles alone, its numbering, its rotation, and the proof that it is the Delaunay
/// triangulation of its points.
///
/// In: points and triangles. Out: adjacency, the same mesh in another numbering, or the first law
/// that does not hold.
namespace calotte::mesh_detail {
using namespace curve_detail; // and the rooms below it
}
