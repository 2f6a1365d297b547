// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/voronoi.h>

namespace calotte::voronoi_detail {

/// Sets all places, lengths, angles and areas of a tessellation from its cells and ids.
///
/// A triangle's circumcentre lies, from the middle of its edge ab, a signed arc delta away, towards
/// the third vertex c: tan(delta) = |a-b| cos(C)|a-c||b-c| / (2 h), h the height of the centre's
/// parallelepiped a . (b-a) x (c-a); in the plane delta = |a-b| cot(C)/2. All three edges share the
/// height, so that its rounding moves the centre, but leaves the sum of the kites. Half a kite,
/// with theta the arc ab, has the signed area 2 atan(tan(theta/4) tan(delta/2)); in the plane |a-b|
/// delta/4. A Voronoi edge is as long as the sum of both its deltas, which keeps more digits than
/// the distance of two close circumcentres.
///
/// Of three sites that are one but for rounding, the deltas are 0.
void measure(Voronoi& out);

/// The same in two stages, for callers that use the results of the first beside the second:
/// vertices, their areas and kites; then edges and the areas of cells.
void measure_vertices(Voronoi& out);
void measure_edges_and_cells(Voronoi& out);

} // namespace calotte::voronoi_detail
