// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "base/vec3.h"
#include "integrals/integrand.h"
#include "integrals/kites.h"
#include "integrals/patches.h"
#include "integrals/room.h"

#include <calotte/density.h>
#include <calotte/types.h>

#include <cstdint>
#include <vector>

namespace calotte::integrals_detail {

/// Moments of the cells of a patch's sites, by local number; those of its halo are not whole. Each
/// is summed over the site's triangles in the patch's order: the same bits for any partition. See
/// sum_kites().
///
/// \param x by local number: unit vectors.
/// \param mass if not null, by local number: set to the integral of rho.
/// \param suspects triangles of the patch, by place in its list, that are not clearly acute and
///        counter-clockwise, are added. Where none is, the mesh is Delaunay: the angles across
///        each edge sum to less than two right ones.
void integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
               Array<CellMoments>& moments, Array<double>* mass,
               std::vector<std::int32_t>& suspects);

/// Finds the suspects only.
void find_suspects(const Patch& patch, const Array<Vec3>& x, std::vector<std::int32_t>& suspects);

/// Moments of all cells of a mesh, by site; 0 for a site without a cell.
struct Moments {
  Array<double> mass;   ///< integral of rho over the cell
  Array<Vec3> first;    ///< integral of rho x
  Array<double> energy; ///< integral of rho |x - x_i|^2
};

/// \param mesh closed, of unit columns.
Moments mesh_moments(const Mesh& mesh, const Density& density, int rule = 6, int divisions = 1);

} // namespace calotte::integrals_detail
