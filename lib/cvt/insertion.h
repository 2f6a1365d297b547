// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"
#include "density/demanded_spacing.h"
#include "domain/surface.h"

#include <calotte/density.h>
#include <calotte/mesh.h>

#include <cstdint>

namespace calotte::cvt_detail {

/// An estimate of the number of dislocations that a mesh needs so that its spacing can follow a
/// density: the integral of |grad h| / h^2, h the spacing. It grows as sqrt(n), and is 0 for
/// uniform density.
/// \pre here and below, the density is that of surface_density().
double dislocations(const Mesh& mesh, const Density& density);

/// The number of sites with 8 or more sides, or 4 or fewer, which relaxation does not repair.
std::int64_t count_odd(const Mesh& mesh);

/// The options of a split and collapse of edges.
struct EdgeChanges {
  std::int64_t splits = 0, collapses = 0; ///< numbers of edges
  /// The first points of the mesh, which keep their bits. No edge between two of them is
  /// contracted; one to another point is contracted to the fixed one. An edge between two of them
  /// is not split if it is a full gap, see is_full_gap().
  std::int64_t fixed = 0;
};

/// Does what split_and_collapse() does.
Points3 split_and_collapsed(const Mesh& mesh, const Density& density, const EdgeChanges& changes);

/// Whether the gap between two fixed generators needs no further generator: the boundary is nearer
/// to their midpoint than a fifth of their distance, or they are about as near to each other as the
/// density demands. A free generator would stay between them, in a cell far too small.
/// \param outline null without a boundary.
template <Space S>
bool is_full_gap(const OutlineOf<S>* outline, const DemandedSpacing& spacing, const S& space,
                 const Vec3& a, const Vec3& b);
extern template bool is_full_gap<Sphere>(const OutlineOf<Sphere>*, const DemandedSpacing&,
                                         const Sphere&, const Vec3&, const Vec3&);
extern template bool is_full_gap<Plane>(const OutlineOf<Plane>*, const DemandedSpacing&,
                                        const Plane&, const Vec3&, const Vec3&);

} // namespace calotte::cvt_detail
