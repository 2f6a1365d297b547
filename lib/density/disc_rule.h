// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "curve/box_tree.h"
#include "density/room.h"
#include "density/width_rules.h"

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

/// Bounds of a group of discs.
struct DiscBounds {
  Box3 centres;
  double radius = 0, width = Widths::no_demand; ///< the largest, the least
};
DiscBounds joined(const DiscBounds& a, const DiscBounds& b);

/// The minimum width of the discs that contain a point; no demand elsewhere. With a limited
/// gradient, widths grow from the discs: the minimum is an additively weighted distance.
class DiscRule : public WidthRule {
public:
  explicit DiscRule(std::vector<Disc> discs);
  void evaluate(std::span<const Vec3> points, std::span<double> widths) const override;
  void lower(std::span<const Vec3> points, std::span<double> widths) const override;
  Bounds bounds(const Vec3& point, double reach) const override;
  /// The limit is exact: the shortest path from a disc is a great circle.
  std::shared_ptr<const WidthRule> limited(double gradient, double radius_km) const override;

private:
  /// The data that copies with other gradients share.
  struct Discs {
    std::vector<Disc> all;
    BoundsTree<DiscBounds> tree;
  };

  DiscRule(std::shared_ptr<const Discs> discs, double gradient)
      : discs_(std::move(discs)), gradient_(gradient) {}
  double grown(double width, double beyond) const;
  double width_at(const Vec3& point, const Disc& disc, double reach = 0) const;
  double least_within(const Vec3& point, double reach, std::int32_t& last,
                      double least = Widths::no_demand) const;

  std::shared_ptr<const Discs> discs_;
  double gradient_; ///< km per radian; infinite without a limit
};

} // namespace calotte::density_detail
