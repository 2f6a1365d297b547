// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/darts.h"

#include "base/points.h"

#include <algorithm>
#include <cstddef>

namespace calotte::cvt_detail {

Darts::Darts(const Candidates& candidates, const Surface& surface)
    : in_(candidates),
      period_(surface.is_sphere() ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(surface.period())) {
  std::vector<Box3> boxes;
  for (Eigen::Index i = 0; i < in_.points.cols(); ++i) {
    const Vec3& p = column(in_.points, i);
    boxes.push_back({p, p});
  }
  tree_ = BoxTree(boxes, in_.keys);
}

std::vector<std::int64_t> Darts::take(std::int64_t count) const {
  constexpr double first = 0.9, falls = 0.95;
  const auto n = static_cast<std::int64_t>(in_.keys.size());
  std::vector<std::uint8_t> taken(in_.keys.size(), 0);
  std::vector<std::int64_t> chosen;
  count = std::min(count, n);
  for (double share = first; std::ssize(chosen) < count; share *= falls) {
    std::vector<std::uint8_t> near = taken;
    for (const Other& other : others_)
      block(other, share, near);
    for (const std::int64_t i : chosen)
      block({column(in_.points, i), in_.width[i]}, share, near);
    for (std::int64_t i = 0; i < n && std::ssize(chosen) < count; ++i)
      if (near[static_cast<std::size_t>(i)] == 0) {
        chosen.push_back(i);
        taken[static_cast<std::size_t>(i)] = 1;
        block({column(in_.points, i), in_.width[i]}, share, near);
      }
  }
  return chosen;
}

/// Flags the candidates that are nearer to one than a share of both their widths.
void Darts::block(const Other& one, double share, std::vector<std::uint8_t>& near) const {
  const double reach = share * one.width;
  for (const int right : {0, -1, 1})
    for (const int up : {0, -1, 1}) {
      if ((right != 0 && !(period_.x() > 0)) || (up != 0 && !(period_.y() > 0)))
        continue;
      const Vec3 p = one.at + Vec3{right * period_.x(), up * period_.y(), 0};
      tree_.visit([&](const Box3& box) { return square_from(box, p) < reach * reach; },
                  [&](std::int32_t other) {
                    const Vec3 way = column(in_.points, other) - p;
                    const double least = share * std::min(one.width, in_.width[other]);
                    if (dot(way, way) < least * least)
                      near[static_cast<std::size_t>(other)] = 1;
                  });
    }
}

} // namespace calotte::cvt_detail
