// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/disc_rule.h"

#include "base/elementary.h"
#include "curve/hilbert.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace calotte::density_detail {

DiscBounds joined(const DiscBounds& a, const DiscBounds& b) {
  return {joined(a.centres, b.centres), std::max(a.radius, b.radius), std::min(a.width, b.width)};
}

DiscRule::DiscRule(std::vector<Disc> discs) : gradient_(std::numeric_limits<double>::infinity()) {
  std::vector<DiscBounds> bounds;
  std::vector<std::uint64_t> keys;
  for (const Disc& disc : discs) {
    bounds.push_back({{disc.centre, disc.centre}, disc.radius, disc.width});
    keys.push_back(curve_key(to_cube(disc.centre)));
  }
  BoundsTree<DiscBounds> tree(bounds, keys);
  discs_ = std::make_shared<const Discs>(Discs{std::move(discs), std::move(tree)});
}

/// The width at a distance beyond a disc.
double DiscRule::grown(double width, double beyond) const {
  return beyond > 0 ? width + gradient_ * beyond : width;
}

double DiscRule::width_at(const Vec3& place, const Disc& disc) const {
  const double chord = norm(place - disc.centre),
               angle = 2 * base_detail::arc_sine(std::min(1.0, 0.5 * chord));
  return grown(disc.width, angle - disc.radius);
}

void DiscRule::evaluate(std::span<const Vec3> places, std::span<double> widths) const {
  const std::vector<Disc>& discs = discs_->all;
  std::int32_t last = -1; // decided the place before
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vec3& p = places[k];
    double least = Widths::no_demand;
    const auto take = [&](std::int32_t item) {
      if (const double width = width_at(p, discs[static_cast<std::size_t>(item)]); width < least) {
        least = width;
        last = item;
      }
    };
    if (last >= 0)
      take(last);
    // Rounding of a bound must not leave out a disc: else the last bit depends on where one begins.
    constexpr double rounding = 1e-12;
    const auto may_demand_less = [&](const DiscBounds& bounds) {
      if (!(bounds.width < least))
        return false;
      const double square = square_from(bounds.centres, p), // the arc of its root c is longer than
          away = std::sqrt(square) * (1 + square / 24);     // c + c^3 / 24
      return grown(bounds.width, away - bounds.radius) * (1 - rounding) < least;
    };
    discs_->tree.visit(may_demand_less, take);
    widths[k] = least;
  }
}

double DiscRule::least() const {
  double least = Widths::no_demand;
  for (const Disc& disc : discs_->all)
    least = std::min(least, disc.width);
  return least;
}

std::shared_ptr<const WidthRule> DiscRule::limited(double gradient, double radius_km) const {
  return std::shared_ptr<const WidthRule>(
      new DiscRule(discs_, std::min(gradient * radius_km, gradient_)));
}

} // namespace calotte::density_detail
