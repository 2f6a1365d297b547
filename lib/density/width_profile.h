// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/bounds.h"
#include "density/raster_field.h"
#include "density/room.h"

#include <calotte/widths.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace calotte::density_detail {

/// The largest distance on a sphere, km: half of the circumference of the largest planets.
constexpr double farthest_on_sphere = 3e5;

/// A profile of widths or of shares, as a piecewise linear function.
class ProfileCurve {
public:
  /// \param what its numbers are, for messages: "a distance".
  /// \param low, high the range of its numbers.
  /// \param value what its values are, for messages, and their law.
  /// \throws Error invalid_argument, naming the node.
  ProfileCurve(const WidthProfile& profile, const char* what, double low, double high,
               const char* value = "width", const ValueLaw& law = positive_and_finite);

  /// The same profile between two numbers, and no demand beyond them.
  ProfileCurve within(double low, double high) const;

  double operator()(double x) const {
    if (x < low_ || x > high_)
      return Widths::no_demand;
    const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), x,
                                        [](double at, const Node& node) { return at < node.x; });
    if (after == nodes_.begin())
      return nodes_.front().width + low_slope_ * (nodes_.front().x - x);
    if (after == nodes_.end())
      return nodes_.back().width + high_slope_ * (x - nodes_.back().x);
    const Node& before = *(after - 1);
    return before.width + (after->width - before.width) * ((x - before.x) / (after->x - before.x));
  }

  /// The bounds of its values between two numbers, which may be infinite.
  Bounds bounds(double low, double high) const;
  /// The largest size of a number at which the value may be less than a width, or more than that.
  double farthest_below(double width) const;
  /// Whether its values nowhere decrease away from 0, in either direction.
  bool grows_from_zero() const;

  /// The largest curve below this one whose slope is at most `slope`, per unit of the number.
  ProfileCurve limited(double slope) const;

private:
  struct Node {
    double x, width;
  };

  explicit ProfileCurve(std::vector<Node> nodes) : nodes_(std::move(nodes)) {}

  /// The nodes in the range with a demand, and nodes at the ends of that range.
  std::vector<Node> demanded() const;

  std::vector<Node> nodes_;
  double low_ = -std::numeric_limits<double>::infinity(),
         high_ = std::numeric_limits<double>::infinity(); ///< beyond, there is no demand
  double low_slope_ = 0, high_slope_ = 0;                 ///< beyond the nodes, away from them
};

} // namespace calotte::density_detail
