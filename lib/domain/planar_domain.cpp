// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/planar_domain.h"

#include "base/require.h"
#include "domain/outline.h"

#include <string>

namespace calotte {
namespace {

void require_box(const Eigen::Vector2d& period) {
  base_detail::require((period.array() >= 1e-30).all() && (period.array() <= 1e30).all(),
                       "the domain: it has no rings, and the periodic box is " +
                           std::to_string(period.x()) + " x " + std::to_string(period.y()) +
                           "; give rings, or two lengths from 1e-30 to 1e30");
}

} // namespace

Surface rectangle(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper) {
  base_detail::require(
      (lower.array() < upper.array()).all(),
      "the rectangle's lower corner is not below and left of the upper one; give the "
      "lesser coordinates first");
  Points2 ring(2, 4);
  ring << lower.x(), upper.x(), upper.x(), lower.x(), lower.y(), lower.y(), upper.y(), upper.y();
  return Surface::plane().within({ring});
}

void require_domain(const PlanarDomain& domain) {
  if (domain.periodic())
    require_box(domain.period);
  else
    domain_detail::Outline{domain};
}

} // namespace calotte
