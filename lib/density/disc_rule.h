// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "curve/box_tree.h"
#include "density/room.h"
#include "density/width_rules.h"

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace calotte::density_detail {

/// A disc on the sphere, and the width inside it.
struct Disc {
  Vec3 centre;   ///< unit vector
  double radius; ///< radians
  double width;  ///< km
};

/// Bounds of a group of discs, whose widths grow by a gradient.
struct DiscBounds {
  Box3 centres;
  double radius = 0, width = Widths::no_demand; ///< the largest, the least
  /// The least of the widths that their growth implies at the centres. With a limited gradient
  /// it bounds the widths more tightly than the radius.
  double at_centre = Widths::no_demand;
};
DiscBounds joined(const DiscBounds& a, const DiscBounds& b);

/// The minimum width of the discs that contain a point; no demand elsewhere. With a limited
/// gradient, widths grow from the discs: the minimum is an additively weighted distance.
class DiscRule : public WidthRule {
public:
  /// \param gradient km per radian; infinite without a limit.
  explicit DiscRule(std::vector<Disc> discs,
                    double gradient = std::numeric_limits<double>::infinity());
  void evaluate(std::span<const Vec3> points, std::span<double> widths) const override;
  void lower(std::span<const Vec3> points, std::span<double> widths) const override;
  Bounds bounds(const Vec3& point, double reach) const override;
  /// The limit is exact: the shortest path from a disc is a great circle.
  std::shared_ptr<const WidthRule> limited(double gradient, double radius_km) const override;

private:
  double least_width(const Vec3& point, double reach, double least = Widths::no_demand) const;

  std::vector<Disc> discs_;
  double gradient_;
  BoundsTree<DiscBounds> tree_;
};

} // namespace calotte::density_detail
