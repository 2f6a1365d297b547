// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "generators/room.h"

#include <calotte/density.h>
#include <calotte/domain.h>
#include <calotte/types.h>

#include <cstdint>

namespace calotte::generators_detail {

/// An estimate of the number of dislocations that a mesh needs so that its spacing can follow a
/// density: the integral of |grad h| / h^2, h the spacing. It grows as sqrt(n), and is 0 for
/// uniform density.
double dislocations(const Mesh& mesh, const Density& density);

/// The same in the plane. \pre the density is that of planar_density().
double dislocations(const PlanarMesh& mesh, const Density& density);

/// The number of sites with 8 neighbours or more, or 4 or fewer, not on the hull. An insertion
/// prefers edges at the former, a contraction at the latter.
template <class AnyMesh> std::int64_t count_odd_sites(const AnyMesh& mesh);

/// How many angles of triangles are near a right angle, or below 47 degrees.
std::int64_t count_bad_angles(const Mesh& mesh);
std::int64_t count_bad_angles(const PlanarMesh& mesh);

/// As insert_and_contract().
/// \param mend edges across from such angles come first.
Points3 exchanged(const Mesh& mesh, const Density& density, std::int64_t inserted,
                  std::int64_t contracted, bool mend);
Points2 exchanged(const PlanarMesh& mesh, const PlanarDomain& domain, const Density& density,
                  std::int64_t inserted, std::int64_t contracted, bool mend);

} // namespace calotte::generators_detail
