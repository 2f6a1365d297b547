// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas/mpas.h"
#include "io/mpas/room.h"

#include <calotte/mesh.h>

/// The coordinate variables in MPAS files, and the measures that are computed together with the
/// coordinates of vertices and edges. Unless the mesh is whole, coordinates of vertices and edges
/// are computed here and not stored. The mesh must outlive its use by the sink.
namespace calotte::io_detail {

/// Puts x, y and z: a factor times the points. The points must outlive their use by the sink.
void put_coordinates(const MpasSink& sink, const MpasKind& kind, const Points3& points,
                     double factor);

/// Puts the coordinates and numbers of the cells.
void put_cells(const MpasSink& sink, const MpasMesh& mesh);

/// The same for vertices, with areaTriangle and kiteAreasOnVertex. Sets the kites.
void put_vertices(const MpasSink& sink, const MpasMesh& mesh);

/// The same for edges, with dcEdge, dvEdge and angleEdge. Requires that put_vertices() was called.
/// Sets dc and dv.
void put_edges(const MpasSink& sink, const MpasMesh& mesh);

} // namespace calotte::io_detail
