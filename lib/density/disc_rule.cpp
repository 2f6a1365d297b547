// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/disc_rule.h"

#include "base/elementary.h"
#include "base/parallel.h"
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

/// The width that a disc allows at a point. \param reach distance by which the point may be nearer.
double DiscRule::width_at(const Vec3& point, const Disc& disc, double reach) const {
  const double chord = norm(point - disc.centre),
               angle = 2 * base_detail::arc_sine(std::min(1.0, 0.5 * chord));
  return grown(disc.width, angle - disc.radius - reach);
}

/// The least width within a distance of a point.
/// \param last index of the disc that gave the previous width, or -1; set to the one that gives
/// this width.
/// \param least the result where no disc gives less; discs that do not are left out early.
double DiscRule::least_within(const Vec3& point, double reach, std::int32_t& last,
                              double least) const {
  const auto take = [&](std::int32_t item) {
    const Disc& disc = discs_->all[static_cast<std::size_t>(item)];
    if (const double width = width_at(point, disc, reach); width < least) {
      least = width;
      last = item;
    }
  };
  if (last >= 0)
    take(last);
  // Rounding of a bound must not exclude a disc: otherwise the last bit would depend on `last`.
  constexpr double rounding = 1e-12;
  const auto may_demand_less = [&](const DiscBounds& bounds) {
    if (!(bounds.width < least))
      return false;
    const double square = square_from(bounds.centres, point), // the arc of its root c is longer
        away = std::sqrt(square) * (1 + square / 24);         // than c + c^3 / 24
    return grown(bounds.width, away - bounds.radius - reach) * (1 - rounding) < least;
  };
  discs_->tree.visit(may_demand_less, take);
  return least;
}

void DiscRule::evaluate(std::span<const Vec3> points, std::span<double> widths) const {
  std::fill(widths.begin(), widths.end(), Widths::no_demand);
  lower(points, widths);
}

void DiscRule::lower(std::span<const Vec3> points, std::span<double> widths) const {
  std::int32_t last = -1;
  for (std::size_t k = 0; k < points.size(); ++k)
    widths[k] = least_within(points[k], 0, last, widths[k]);
}

Bounds DiscRule::bounds(const Vec3& point, double reach) const {
  std::int32_t last = -1;
  const double here = least_within(point, 0, last);
  return {least_within(point, reach, last), std::isfinite(gradient_) && std::isfinite(reach)
                                                ? here + gradient_ * reach
                                                : Widths::no_demand};
}

/// Most discs of a limited rule are nowhere the least: a narrower one nearby allows less all over
/// them, and so everywhere.
std::shared_ptr<const WidthRule> DiscRule::limited(double gradient, double radius_km) const {
  const DiscRule all(discs_, std::min(gradient * radius_km, gradient_));
  const std::int64_t count = std::ssize(discs_->all);
  std::vector<std::uint8_t> stays(static_cast<std::size_t>(count));
  base_detail::for_each_block(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    constexpr double rounding = 1e-9; // of widths, whose bits must stay
    std::int32_t last = -1;
    for (std::int64_t i = begin; i != end; ++i) {
      const Disc& disc = discs_->all[static_cast<std::size_t>(i)];
      // The least width of another disc at the point of this one that is farthest from it.
      const double farthest = all.least_within(disc.centre, -disc.radius, last);
      stays[static_cast<std::size_t>(i)] = farthest < (1 - rounding) * disc.width ? 0 : 1;
    }
  });
  std::vector<Disc> rest;
  for (std::int64_t i = 0; i < count; ++i)
    if (stays[static_cast<std::size_t>(i)] != 0)
      rest.push_back(discs_->all[static_cast<std::size_t>(i)]);
  return std::shared_ptr<const WidthRule>(
      new DiscRule(DiscRule(std::move(rest)).discs_, all.gradient_));
}

} // namespace calotte::density_detail
