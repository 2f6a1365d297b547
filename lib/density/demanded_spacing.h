// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/room.h"

#include <calotte/density.h>
#include <calotte/surface.h>

#include <cstdint>

namespace calotte::density_detail {

/// The spacing, the square root of a cell's area, that a density demands of a number of cells in a
/// region: h = (I / (n rho^(1/2)))^(1/2), I the integral of rho^(1/2) over the region.
class DemandedSpacing {
public:
  /// \param surface a region of the sphere. \param density which must outlive this.
  /// \param samples random places for the integral.
  DemandedSpacing(const Surface& surface, const Density& density, double cells,
                  std::int64_t samples = 4096);

  /// Radians; infinite where the density is 0.
  double at(const Vec3& x) const;

private:
  const Density* density_;
  double integral_; ///< I / n
};

} // namespace calotte::density_detail
