// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/demanded_spacing.h"

#include "density/hexagons.h"
#include "density/sampling.h"
#include "density/surface_density.h"

#include <cmath>
#include <utility>

namespace calotte::density_detail {

namespace {

/// The mean of the root of a density over a surface. Random points that are distributed as the root
/// give the mean of its inverse, which is 1 / mean. On a surface with a boundary the random points
/// are uniform.
double mean_root(const Density& density, const Surface& surface, std::int64_t samples) {
  if (density.uniform())
    return 1;
  if (surface.is_bounded())
    return evaluate(density, draw(samples, Density{}, surface, 1)).cwiseSqrt().mean();
  const Points3 points = draw(samples, site_density(density), surface, 1);
  return 1 / evaluate(density, points).cwiseSqrt().cwiseInverse().mean();
}

} // namespace

DemandedSpacing::DemandedSpacing(const Surface& surface, const Density& density, double cells,
                                 std::int64_t samples)
    : density_(surface_density(density, surface)),
      integral_(mean_root(density_, surface, samples) * surface.area() / cells) {}

DemandedSpacing::DemandedSpacing(Density&& density, double integral)
    : density_(std::move(density)), integral_(integral) {}

DemandedSpacing DemandedSpacing::of_width(const Surface& surface, const Density& density,
                                          double at_one) {
  return {surface_density(density, surface), hexagon_area(at_one)};
}

double DemandedSpacing::at(const Vec3& x) const {
  const Points3 point = Eigen::Vector3d(x.x, x.y, x.z);
  return std::sqrt(integral_ / std::sqrt(evaluate(density_, point)[0]));
}

} // namespace calotte::density_detail
