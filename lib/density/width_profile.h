// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/widths.h>

#include <algorithm>
#include <vector>

namespace calotte::density_detail {

/// A distance on a sphere, km: half round the largest planets.
constexpr double farthest_on_sphere = 3e5;

/// A profile as straight pieces.
class ProfileCurve {
public:
  /// \param what, unit for messages: "a distance", "km".
  /// \param low, high the range of its numbers.
  /// \throws Error invalid_argument, naming the node.
  ProfileCurve(const WidthProfile& profile, const char* what, double low, double high);

  double operator()(double x) const {
    const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), x,
                                        [](double at, const Node& node) { return at < node.x; });
    if (after == nodes_.begin())
      return nodes_.front().width;
    if (after == nodes_.end())
      return nodes_.back().width;
    const Node& before = *(after - 1);
    return before.width + (after->width - before.width) * ((x - before.x) / (after->x - before.x));
  }

  double least() const;
  /// Whether it nowhere falls away from 0, in either direction.
  bool grows_from_zero() const;

  /// The largest curve below this one whose slope is at most `slope`, per unit of the number.
  ProfileCurve limited(double slope) const;

private:
  struct Node {
    double x, width;
  };

  explicit ProfileCurve(std::vector<Node> nodes) : nodes_(std::move(nodes)) {}

  std::vector<Node> nodes_;
};

} // namespace calotte::density_detail
