// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/demanded_spacing.h"

#include "density/sampling.h"

#include <cmath>

namespace calotte::density_detail {

DemandedSpacing::DemandedSpacing(const Surface& surface, const Density& density, double cells,
                                 std::int64_t samples)
    : density_(&density) {
  const Points3 places = draw(samples, Density{}, surface, 1);
  const double mean = evaluate(density, places).cwiseSqrt().mean();
  integral_ = mean * surface.area() / cells;
}

double DemandedSpacing::at(const Vec3& x) const {
  const Points3 place = Eigen::Vector3d(x.x, x.y, x.z);
  return std::sqrt(integral_ / std::sqrt(evaluate(*density_, place)[0]));
}

} // namespace calotte::density_detail
