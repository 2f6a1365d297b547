// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "integrals/moments.h"
#include "quality/parts.h"
#include "quality/room.h"

#include <calotte/density.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cstdint>

namespace calotte::quality_detail {

/// The generators of a surface in a mesh in which all of them have closed stars.
struct ClosedMesh {
  Surface surface; ///< the whole sphere, or a plane whose boundary clips the cells
  /// Of the generators, which are unit vectors, or in a periodic box inside it, and after them the
  /// hull of a bounded plane, see far_hull().
  Mesh mesh;
  std::int64_t generators = 0;
};

/// The mesh itself; rings of its surface have no effect.
/// \pre closed, of unit columns; there is a point.
ClosedMesh closed_on_sphere(Mesh mesh);

/// A new mesh of the points. \pre there is a point; the plane is finite.
/// \throws Error duplicate with the index of a point that equals an earlier one.
ClosedMesh closed_in_plane(const Mesh& mesh);

/// Moments of the cells.
/// \param density as surface_density() gives it; \param rule, divisions see make_integrand().
Moments moments_of(const ClosedMesh& closed, const Density& density, int rule = 6,
                   int divisions = 1);

/// From generator i to the centroid of its cell.
Vec3 off_centroid(const ClosedMesh& closed, const Moments& moments, std::int64_t i);

/// \throws Error invalid_argument with the index if cell i has no centroid.
void require_centroid(const ClosedMesh& closed, const Moments& moments, std::int64_t i);

/// For each triangle 1 if it is one of the domain's, otherwise 0: its circumcentre is in it, and
/// none of its corners is a point of the hull. Empty if all are.
/// \param triangles of the generators, and of the hull.
Array<std::uint8_t> triangles_inside(const ClosedMesh& closed, const Triangles& triangles);

/// For each generator 1 if it is inside and the boundary passes through no interior of its cell,
/// otherwise 0. Empty if there is no boundary.
Array<std::uint8_t> unclipped_cells(const ClosedMesh& closed, const VertexRings& rings);

} // namespace calotte::quality_detail
