// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
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
  /// The mesh of the generators, then of the hull of a bounded plane, see far_hull(). Generators
  /// are unit vectors; in a periodic plane they are inside the box.
  Mesh mesh;
  std::int64_t generators = 0;
};

/// A closed mesh of the sphere. Rings of its surface have no effect.
/// \pre closed, of unit columns; there is a point.
ClosedMesh closed_on_sphere(Mesh mesh);

/// A closed mesh made of the points of a mesh of the plane. \pre there is a point; the plane is
/// finite.
/// \throws Error duplicate with the index of a point that equals an earlier one.
ClosedMesh closed_in_plane(const Mesh& mesh);

/// Moments of the cells.
/// \param density as surface_density() gives it; \param rule, divisions see make_integrand().
Moments moments_of(const ClosedMesh& closed, const Density& density, int rule = 6,
                   int divisions = 1);

/// The offset from generator i to the centroid of its cell.
Vec3 off_centroid(const ClosedMesh& closed, const Moments& moments, std::int64_t i);

/// \throws Error invalid_argument with the index if cell i has no centroid.
void require_centroid(const ClosedMesh& closed, const Moments& moments, std::int64_t i);

/// Flags the triangles of the domain: the domain contains the circumcentre, and no corner is a
/// point of the hull. Empty if all triangles are flagged.
/// \param triangles of the generators, and of the hull.
Array<std::uint8_t> triangles_inside(const ClosedMesh& closed, const Triangles& triangles);

/// Flags the generators inside whose cells the boundary does not cut. Empty without a boundary.
Array<std::uint8_t> unclipped_cells(const ClosedMesh& closed, const VertexRings& rings);

} // namespace calotte::quality_detail
