// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/width_profile.h"

#include "base/require.h"

#include <algorithm>
#include <cmath>

namespace calotte::density_detail {
namespace {

/// The straight pieces deviate from the cubic by less than 1e-6 of its height.
constexpr int pieces_of_cubic = 1024;

/// Limits how fast widths grow from each node to the next ones.
template <class Node>
std::vector<Node> limited_forwards(const std::vector<Node>& nodes, double slope) {
  std::vector<Node> out{nodes.front()};
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    const Node &from = nodes[k - 1], &to = nodes[k];
    const Node last = out.back(); // at the position of `from`, below it or on it
    const double length = to.x - from.x, reached = last.width + slope * length;
    if (reached <= to.width) {
      out.push_back({to.x, reached});
      continue;
    }
    // The steepest line meets the given piece here.
    const double gap = from.width - last.width, rise = (to.width - from.width) / length;
    if (const double meets = gap > 0 ? gap / (slope - rise) : 0; meets > 0 && meets < length)
      out.push_back({from.x + meets, last.width + slope * meets});
    out.push_back(to);
  }
  return out;
}

template <class Node> std::vector<Node> mirrored(const std::vector<Node>& nodes) {
  std::vector<Node> out;
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
    out.push_back({-node->x, node->width});
  return out;
}

} // namespace

ProfileCurve::ProfileCurve(const WidthProfile& profile, const char* what, double low, double high,
                           const char* value, const ValueLaw& law) {
  const auto& given = profile.nodes;
  require(!given.empty(), "a profile of {} has no node; give one or more", what);
  for (std::size_t k = 0; k < given.size(); ++k) {
    const double x = given[k][0], width = given[k][1];
    require(x >= low && x <= high,
            "node {} of a profile of {} is at {}, outside {} to {}; correct it", k, what, x, low,
            high);
    require(k == 0 || x > given[k - 1][0],
            "node {} of a profile of {} is not above the one before; sort them", k, what);
    require(law.holds(width),
            "node {} of a profile of {} has the {} {}, which is not {}; correct it", k, what, value,
            width, law.name);
  }
  nodes_.push_back({given[0][0], given[0][1]});
  for (std::size_t k = 1; k < given.size(); ++k) {
    const auto &from = given[k - 1], &to = given[k];
    const int pieces = profile.smooth ? pieces_of_cubic : 1;
    for (int piece = 1; piece < pieces; ++piece) {
      const double t = static_cast<double>(piece) / pieces;
      nodes_.push_back(
          {from[0] + t * (to[0] - from[0]), from[1] + t * t * (3 - 2 * t) * (to[1] - from[1])});
    }
    nodes_.push_back({to[0], to[1]});
  }
}

ProfileCurve ProfileCurve::within(double low, double high) const {
  ProfileCurve part = *this;
  part.low_ = low;
  part.high_ = high;
  return part;
}

std::vector<ProfileCurve::Node> ProfileCurve::demanded() const {
  std::vector<Node> nodes;
  if (std::isfinite(low_))
    nodes.push_back({low_, (*this)(low_)});
  for (const Node& node : nodes_)
    if (node.x > low_ && node.x < high_)
      nodes.push_back(node);
  if (std::isfinite(high_))
    nodes.push_back({high_, (*this)(high_)});
  return nodes;
}

Bounds ProfileCurve::bounds(double low, double high) const {
  Bounds bounds;
  if (low < low_ || high > high_)
    bounds.add(Widths::no_demand);
  const double first = std::max(low, low_), last = std::min(high, high_);
  if (!(first <= last))
    return bounds;
  // Beyond the nodes, at infinity, a slope of 0 leaves the width as it is.
  const auto width_at = [&](double x) {
    if (std::isfinite(x))
      return (*this)(x);
    const bool before = x < 0;
    if ((before ? low_slope_ : high_slope_) > 0)
      return Widths::no_demand;
    return before ? nodes_.front().width : nodes_.back().width;
  };
  bounds.add(width_at(first));
  bounds.add(width_at(last));
  auto node = std::lower_bound(nodes_.begin(), nodes_.end(), first,
                               [](const Node& one, double x) { return one.x < x; });
  for (; node != nodes_.end() && node->x <= last; ++node)
    bounds.add(node->width);
  return bounds;
}

double ProfileCurve::farthest_below(double width) const {
  constexpr double rounding = 1e-9;
  double farthest = 0;
  const auto add_end = [&](const Node& end, double slope) {
    if (end.width < width)
      farthest = std::max(farthest, std::abs(end.x) + (width - end.width) / slope);
  };
  add_end(nodes_.front(), low_slope_);
  add_end(nodes_.back(), high_slope_);
  for (std::size_t k = 1; k < nodes_.size(); ++k)
    if (std::min(nodes_[k - 1].width, nodes_[k].width) < width)
      farthest = std::max({farthest, std::abs(nodes_[k - 1].x), std::abs(nodes_[k].x)});
  return std::min(farthest, std::max(-low_, high_)) * (1 + rounding);
}

bool ProfileCurve::grows_from_zero() const {
  const std::vector<Node> nodes = demanded();
  return std::adjacent_find(nodes.begin(), nodes.end(), [](const Node& from, const Node& to) {
           return (to.x > 0 && to.width < from.width) || (from.x < 0 && to.width > from.width);
         }) == nodes.end();
}

ProfileCurve ProfileCurve::limited(double slope) const {
  // The constant ends take part: from them the width may grow beyond the last node.
  std::vector<Node> nodes = demanded();
  double most = 0, least = Widths::no_demand;
  for (const Node& node : nodes) {
    most = std::max(most, node.width);
    least = std::min(least, node.width);
  }
  const double reach = (most - least) / slope;
  const bool begins = std::isfinite(low_) || low_slope_ > 0,
             ends = std::isfinite(high_) || high_slope_ > 0; // without a constant
  if (reach > 0 && !begins)
    nodes.insert(nodes.begin(), {nodes.front().x - reach, nodes.front().width});
  if (reach > 0 && !ends)
    nodes.push_back({nodes.back().x + reach, nodes.back().width});
  ProfileCurve result(mirrored(limited_forwards(mirrored(limited_forwards(nodes, slope)), slope)));
  // Where there is no demand, or the profile has a slope, the width grows without bound.
  const auto growth = [slope](double own) { return own > 0 ? std::min(own, slope) : slope; };
  if (begins)
    result.low_slope_ = growth(low_slope_);
  if (ends)
    result.high_slope_ = growth(high_slope_);
  return result;
}

} // namespace calotte::density_detail
