// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/darts.h"

#include "base/points.h"

#include <algorithm>
#include <cstddef>
#include <limits>

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
  // The squares of the shares at which others are; those beyond the first share do not count.
  std::vector<double> square(in_.keys.size(), std::numeric_limits<double>::infinity());
  for (const Other& other : others_)
    approach(other, first, square);
  std::vector<std::int64_t> chosen;
  count = std::min(count, n);
  for (double share = first; std::ssize(chosen) < count; share *= falls)
    for (std::int64_t i = 0; i < n && std::ssize(chosen) < count; ++i)
      if (double& least = square[static_cast<std::size_t>(i)]; least >= share * share) {
        chosen.push_back(i);
        approach({column(in_.points, i), in_.width[i]}, first, square);
        least = -1; // taken
      }
  return chosen;
}

/// Lowers the squares of candidates to those of their distances from one, over the smaller width of
/// both, up to a share.
void Darts::approach(const Other& one, double share, std::vector<double>& square) const {
  const double reach = share * one.width;
  for (const int right : {0, -1, 1})
    for (const int up : {0, -1, 1}) {
      if ((right != 0 && !(period_.x() > 0)) || (up != 0 && !(period_.y() > 0)))
        continue;
      const Vec3 p = one.at + Vec3{right * period_.x(), up * period_.y(), 0};
      tree_.visit([&](const Box3& box) { return square_from(box, p) < reach * reach; },
                  [&](std::int32_t other) {
                    const Vec3 way = column(in_.points, other) - p;
                    const double width = std::min(one.width, in_.width[other]);
                    double& least = square[static_cast<std::size_t>(other)];
                    least = std::min(least, dot(way, way) / (width * width));
                  });
    }
}

} // namespace calotte::cvt_detail
