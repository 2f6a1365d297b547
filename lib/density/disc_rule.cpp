// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/disc_rule.h"

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/vector_loops.h"
#include "curve/hilbert.h"
#include "density/least_of_items.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace calotte::density_detail {

DiscBounds joined(const DiscBounds& a, const DiscBounds& b) {
  return {joined(a.centres, b.centres), std::max(a.radius, b.radius), std::min(a.width, b.width),
          std::min(a.at_centre, b.at_centre)};
}

namespace {

// Rounding of a bound must not exclude a disc: otherwise the last bit would depend on the points
// that are evaluated together.
constexpr double rounding = 1e-12;

/// The width at an angle from the centre of a disc.
/// \param gradient km per radian.
/// \param reach by how much the point may be nearer.
CALOTTE_INLINE double width_of(const Disc& disc, double gradient, double angle, double reach = 0) {
  const double beyond = angle - disc.radius - reach;
  return beyond > 0 ? disc.width + gradient * beyond : disc.width;
}

CALOTTE_INLINE double angle_of(double chord) {
  return 2 * base_detail::arc_sine(std::min(1.0, 0.5 * chord));
}

/// A lower bound of the widths of some discs at points that are at least a chord away from their
/// centres, and nearer by an angle of up to `reach`; infinite if it is not less than a limit.
double least_of(const DiscBounds& discs, double gradient, double chord, double reach,
                double limit) {
  if (!(discs.width < limit)) // which rounding cannot change
    return Widths::no_demand;
  const double angle = chord * (1 + chord * chord / 24); // at most that of the chord
  // Not raised to the least width: nearer discs come first also where all have it.
  return (1 - rounding) * (std::isfinite(gradient)
                               ? discs.at_centre + gradient * (angle - reach)
                               : width_of({{}, discs.radius, discs.width}, gradient, angle, reach));
}

CALOTTE_VECTOR_WIDTHS
void set_width_bounds(const Disc& disc, double gradient, const PointRow& middles,
                      const RowValues& reaches, RowValues& least, RowValues& greatest) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < row_size; ++k) {
    const double chord = norm(Vec3{middles.x[k], middles.y[k], middles.z[k]} - disc.centre);
    const double nearest = std::max(0.0, chord - reaches[k]), farthest = chord + reaches[k];
    least[k] = std::max(disc.width, (1 - rounding) * width_of(disc, gradient, angle_of(nearest)));
    const double most = width_of(disc, gradient, angle_of(farthest));
    greatest[k] = most > disc.width ? (1 + rounding) * most : most;
  }
}

CALOTTE_VECTOR_WIDTHS
void lower_widths(const Disc& disc, double gradient, const PointRow& points, RowValues& widths) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < row_size; ++k) {
    const double chord = norm(Vec3{points.x[k], points.y[k], points.z[k]} - disc.centre);
    widths[k] = std::min(widths[k], width_of(disc, gradient, angle_of(chord)));
  }
}

/// The widths that discs allow, see lower_to_least().
class DiscWidths {
public:
  using Item = Disc;
  DiscWidths(const std::vector<Disc>& discs, const BoundsTree<DiscBounds>& tree, double gradient)
      : discs_(discs), tree_(tree), gradient_(gradient) {}

  const BoundsTree<DiscBounds>& tree() const { return tree_; }
  double least(const DiscBounds& discs, const Ball& ball, double limit) const {
    const double chord = std::sqrt(square_from(discs.centres, ball.middle)) - ball.reach;
    return least_of(discs, gradient_, std::max(0.0, chord), 0, limit);
  }
  const Disc& item(std::int32_t k) const { return discs_[static_cast<std::size_t>(k)]; }
  void set_bounds(const Disc& disc, const PointRow& middles, const RowValues& reaches,
                  RowValues& least, RowValues& greatest) const {
    set_width_bounds(disc, gradient_, middles, reaches, least, greatest);
  }
  void lower(const Disc& disc, const PointRow& points, RowValues& widths) const {
    lower_widths(disc, gradient_, points, widths);
  }
  double bound(double width) const { return width; }

private:
  const std::vector<Disc>& discs_;
  const BoundsTree<DiscBounds>& tree_;
  double gradient_;
};

/// The bounds of one disc.
DiscBounds bounds_of(const Disc& disc, double gradient) {
  const double growth = std::isfinite(gradient) ? gradient * disc.radius : 0;
  return {{disc.centre, disc.centre},
          disc.radius,
          disc.width,
          disc.width - growth - rounding * (disc.width + growth)};
}

BoundsTree<DiscBounds> tree_of(const std::vector<Disc>& discs, double gradient) {
  std::vector<DiscBounds> bounds;
  std::vector<std::uint64_t> keys;
  for (const Disc& disc : discs) {
    bounds.push_back(bounds_of(disc, gradient));
    keys.push_back(curve_key(to_cube(disc.centre)));
  }
  return {bounds, keys};
}

} // namespace

DiscRule::DiscRule(std::vector<Disc> discs, double gradient)
    : discs_(std::move(discs)), gradient_(gradient), tree_(tree_of(discs_, gradient)) {}

/// The least width within a distance of a point, in radians. With a negative distance, it is the
/// least width that one disc allows all over the opposite distance.
/// \param least the result where no disc gives less.
double DiscRule::least_width(const Vec3& point, double reach, double least) const {
  tree_.visit_nearest(
      [&](const DiscBounds& discs) {
        return least_of(discs, gradient_, std::sqrt(square_from(discs.centres, point)), reach,
                        least);
      },
      least,
      [&](std::int32_t item) {
        const Disc& disc = discs_[static_cast<std::size_t>(item)];
        least =
            std::min(least, width_of(disc, gradient_, angle_of(norm(point - disc.centre)), reach));
      });
  return least;
}

void DiscRule::evaluate(std::span<const Vec3> points, std::span<double> widths) const {
  std::fill(widths.begin(), widths.end(), Widths::no_demand);
  lower(points, widths);
}

void DiscRule::lower(std::span<const Vec3> points, std::span<double> widths) const {
  lower_to_least(DiscWidths(discs_, tree_, gradient_), points, widths);
}

Bounds DiscRule::bounds(const Vec3& point, double reach) const {
  return {least_width(point, reach), std::isfinite(gradient_) && std::isfinite(reach)
                                         ? least_width(point, 0) + gradient_ * reach
                                         : Widths::no_demand};
}

/// Most discs of a limited rule are nowhere the least: a narrower one nearby allows less all over
/// them, and so everywhere.
std::shared_ptr<const WidthRule> DiscRule::limited(double gradient, double radius_km) const {
  const DiscRule all(discs_, std::min(gradient * radius_km, gradient_));
  const std::int64_t count = std::ssize(discs_);
  std::vector<std::uint8_t> stays(static_cast<std::size_t>(count));
  base_detail::for_each_block(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    constexpr double margin = 1e-9; // of widths, whose bits must stay
    for (std::int64_t i = begin; i != end; ++i) {
      const Disc& disc = discs_[static_cast<std::size_t>(i)];
      // The least width of another disc at the point of this one that is farthest from it.
      const double own = (1 - margin) * disc.width,
                   farthest = all.least_width(disc.centre, -disc.radius, own);
      stays[static_cast<std::size_t>(i)] = farthest < own ? 0 : 1;
    }
  });
  std::vector<Disc> rest;
  for (std::int64_t i = 0; i < count; ++i)
    if (stays[static_cast<std::size_t>(i)] != 0)
      rest.push_back(discs_[static_cast<std::size_t>(i)]);
  return std::make_shared<DiscRule>(std::move(rest), all.gradient_);
}

} // namespace calotte::density_detail
