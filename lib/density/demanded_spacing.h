// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/room.h"

#include <calotte/density.h>
#include <calotte/surface.h>

#include <cstdint>

namespace calotte::density_detail {

/// The spacing, the square root of a cell's area, that a density demands of a number of cells of a
/// surface: h = (I / (n rho^(1/2)))^(1/2), I the integral of rho^(1/2) over the surface.
class DemandedSpacing {
public:
  /// \param surface of finite area.
  /// \param samples random points for the integral.
  DemandedSpacing(const Surface& surface, const Density& density, double cells,
                  std::int64_t samples = 4096);

  /// That of cells with a width where the density is 1.
  static DemandedSpacing of_width(const Surface& surface, const Density& density, double at_one);

  /// The spacing at x: radians, in a plane its unit. Infinite where the density is 0.
  double at(const Vec3& x) const;

private:
  DemandedSpacing(Density&& density, double integral);

  Density density_; ///< at points with z = 0 of a plane
  double integral_; ///< of rho^(1/2) over the surface, divided by the number of cells
};

} // namespace calotte::density_detail
