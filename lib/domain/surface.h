// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/planar_domain.h"
#include "domain/region.h"
#include "domain/room.h"

#include <calotte/surface.h>

#include <string>

namespace calotte::domain_detail {

/// Makes surfaces without a check.
struct UncheckedSurface {
  static Surface of_sphere(Surface::Rings rings);
  /// \param period without effect if there are rings.
  static Surface of_plane(Surface::Rings rings, const Eigen::Vector2d& period);
};

/// The part of the sphere. \pre the surface is on the sphere.
Region region_of(const Surface& surface);

/// \param what is for the sphere alone, for the message: "a limited area is".
/// \throws Error invalid_argument for a plane.
void require_sphere(const Surface& surface, const std::string& what);

/// \throws Error invalid_argument for the sphere.
void require_plane(const Surface& surface, const std::string& what);

/// The part of the sphere, or of the plane, for a function that knows this kind of surface alone.
/// \param what is of that kind, for the message: "a lattice is".
/// \throws Error invalid_argument for a surface of the other kind.
Region part_of_sphere(const Surface& surface, const std::string& what);
PlanarDomain part_of_plane(const Surface& surface, const std::string& what);

/// The part of the plane. A plane without an end, or with one period, has no rings and no box.
/// \pre the surface is a plane.
PlanarDomain domain_of(const Surface& surface);

} // namespace calotte::domain_detail
