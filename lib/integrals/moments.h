// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/vec3.h"
#include "domain/surface.h"
#include "exact/space.h"
#include "integrals/integrand.h"
#include "integrals/kites.h"
#include "integrals/patches.h"
#include "integrals/room.h"

#include <calotte/density.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <span>
#include <vector>

namespace calotte::integrals_detail {

/// The generators of the cells of a surface.
template <Space S> struct Generators {
  S space;
  const OutlineOf<S>* outline = nullptr; ///< the boundary, which clips the cells; null without one
  std::int64_t count = 0; ///< number of generators; later sites close the mesh and have no cells
};

/// Computes the moments of the cells of a patch's own sites, by local number; those of its halo are
/// incomplete. Each is summed over the site's triangles in the patch's order: the same bits for any
/// partition. See sum_kites(), and clipped_moments() for cells that the boundary reaches.
///
/// \param x by local number: unit vectors, or positions with z = 0, in a periodic box inside it.
/// \param sums with masses only on the sphere without a boundary.
/// \param suspects triangles of the patch, by index in its list, that are not clearly acute and
///        counter-clockwise, are added. Without suspects the mesh is Delaunay: the angles across
///        each edge sum to less than pi.
template <Space S>
void integrate(const Integrand& integrand, const Generators<S>& of, const Patch& patch,
               const Array<Vec3>& x, const CellSums& sums, std::vector<std::int32_t>& suspects);

/// Finds the suspects only.
template <Space S>
void find_suspects(const Generators<S>& of, const Patch& patch, const Array<Vec3>& x,
                   std::vector<std::int32_t>& suspects);

/// The constrained centroid M/|M| of a cell, or in the plane the centroid x + M/m.
/// \param first of the moments of the cell of x.
template <Space S> CALOTTE_INLINE Vec3 centroid_of(const Vec3& x, const Vec3& first) {
  if constexpr (S::on_sphere)
    return (1 / norm(first)) * first;
  else
    return x + Vec3{first.x / first.z, first.y / first.z, 0};
}

/// Moments of all cells, by generator; 0 for one without a cell.
struct Moments {
  Array<double> mass;   ///< integral of rho over the cell
  Array<Vec3> first;    ///< see CellMoments
  Array<double> energy; ///< integral of rho |x - x_i|^2
};

/// \param sites of a closed mesh, the generators first; see integrate().
/// \param of not a region of the sphere.
template <Space S>
Moments cell_moments(const Generators<S>& of, std::span<const Vec3> sites,
                     const Triangles& triangles, const Integrand& integrand);

/// The moments of a mesh of the sphere. \param mesh closed, of unit columns.
Moments mesh_moments(const Mesh& mesh, const Density& density, int rule = 6, int divisions = 1);

} // namespace calotte::integrals_detail
