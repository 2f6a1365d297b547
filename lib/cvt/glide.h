// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"
#include "cvt/shape.h"
#include "cvt/subdomain.h"
#include "cvt/tessellation.h"

#include <calotte/mesh.h>

#include <cstdint>

namespace calotte::cvt_detail {

/// Moves dislocations (pairs of cells with 5 and 7 neighbours) by glides. A glide is a step of a
/// dislocation along its row of cells. A descent leaves some dislocations just before a glide: a
/// Voronoi edge is then short, or an angle nearly right. The four generators around that edge are
/// moved so that it flips. The generators within some rings then relax to the centroids of their
/// cells; all others stay. The stress that brought the dislocation there carries it on: as a rule
/// the energy is lower afterwards, and the cells around are as regular as others. A penalty for
/// short edges would instead keep generators away from their centroids.
///
/// The result has the same bits for any number of threads and regions.
///
/// \param points the generators, which move.
/// \param input whose integrand gives the cells' moments.
/// \param limits whose least_edge and least_cotangent tell what is short and nearly right.
/// \return number of steps that were tried; 0 if no edge is on the brink.
template <Space S>
std::int64_t glide(Tessellation<S>& tessellation, Points3& points, const LocalInput& input,
                   const ShapeLimits& limits);

} // namespace calotte::cvt_detail
