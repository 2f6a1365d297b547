// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "mesh/faces.h"
#include "mesh/room.h"

#include <calotte/matrices.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

namespace calotte::mesh_detail {

/// The corners at each site of a closed mesh, counter-clockwise, starting with the corner whose
/// next vertex is the lowest neighbour: an order that the triangulation alone determines.
using VertexRings = Lists<Array<Corner>, Array<std::int64_t>>;

/// Where the ring of each site starts, for a caller that needs each ring once.
/// \param degrees receives, if given, the numbers of corners.
Array<Corner> ring_starts(const Faces& mesh, Array<std::int64_t>* degrees = nullptr);

/// Sets `ring` to the corners at a site.
/// \param start of the ring.
void gather_ring(const Faces& mesh, Corner start, std::vector<Corner>& ring);

VertexRings make_vertex_rings(const Mesh& mesh);

/// The rings of the first `sites` sites of a mesh, which must be closed; the other rings may be
/// open.
/// \param neighbours as in Mesh.
VertexRings make_vertex_rings(const Triangles& triangles, const Triangles& neighbours,
                              std::int64_t sites);

} // namespace calotte::mesh_detail
