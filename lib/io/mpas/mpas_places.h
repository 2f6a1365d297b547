// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas/mpas.h"
#include "io/mpas/room.h"

#include <calotte/mesh.h>

/// The variables of places in MPAS files, and the measures that are computed with the places of
/// vertices and edges. Unless the mesh is whole, its places are computed here and not stored. The
/// mesh must outlive the sink's use of them.
namespace calotte::io_detail {

/// x, y and z: a factor times the points, which must outlive the sink's use of them.
void put_coordinates(const MpasSink& sink, const MpasKind& kind, const Points3& points,
                     double factor);

/// Places and numbers.
void put_cells(const MpasSink& sink, const MpasMesh& mesh);

/// The same, and areaTriangle and kiteAreasOnVertex. Sets the kites.
void put_vertices(const MpasSink& sink, const MpasMesh& mesh);

/// The same, and dcEdge, dvEdge and angleEdge, after put_vertices(). Sets dc and dv.
void put_edges(const MpasSink& sink, const MpasMesh& mesh);

} // namespace calotte::io_detail
