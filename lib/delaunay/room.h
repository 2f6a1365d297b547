// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "generators/room.h"
#include "mesh/room.h"

/// The triangulation by regions (Jacobsen et al., 2013): points -> sites -> regions -> [ gather,
/// project, triangulate, cull ] for each region -> unite -> mesh. Each arrow is a stage, a function
/// from values to values. The stages are templates over a Chart, SphereChart
/// or PlaneChart.
///
/// In: points of a caller. Out: the Delaunay triangulation in canonical order, the same bits for
/// any number of threads and regions and any order of insertion.
namespace calotte::delaunay_detail {
using namespace generators_detail; // and the rooms below it
using namespace mesh_detail;
} // namespace calotte::delaunay_detail
