// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/site_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace calotte::delaunay_detail {
namespace {

struct Extent {
  std::array<double, 3> low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  std::array<double, 3> high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(std::size_t axis, double low_end, double high_end) {
    low[axis] = std::min(low[axis], low_end);
    high[axis] = std::max(high[axis], high_end);
  }
};

/// Rounding moves the middle; the half extents compensate for it. They are rounded up, by the least
/// normal number if they are too small for a relative margin.
SiteBox rounded(const Extent& extent) {
  SiteBox box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = extent.low[axis], high = extent.high[axis];
    const auto middle = static_cast<float>((low + high) / 2);
    const double half = std::max(high - middle, middle - low);
    box.middle[axis] = middle;
    box.half[axis] = static_cast<float>(half * (1 + 0x1p-22) + std::numeric_limits<float>::min());
  }
  return box;
}

SiteBox around_sites(const Array<Vec3>& sites, std::int64_t begin, std::int64_t end) {
  Extent extent;
  for (std::int64_t r = begin; r != end; ++r) {
    extent.add(0, sites[r].x, sites[r].x);
    extent.add(1, sites[r].y, sites[r].y);
    extent.add(2, sites[r].z, sites[r].z);
  }
  return rounded(extent);
}

SiteBox around_boxes(const Array<SiteBox>& boxes, std::int64_t begin, std::int64_t end) {
  Extent extent;
  for (std::int64_t i = begin; i != end; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double middle = boxes[i].middle[axis], half = boxes[i].half[axis];
      extent.add(axis, middle - half, middle + half);
    }
  return rounded(extent);
}

/// Makes a level of boxes. \param around around(begin, end) is the box of items of the level below.
template <class Around> Array<SiteBox> make_level(std::int64_t below, const Around& around) {
  constexpr std::int64_t width = SiteBoxes::width;
  Array<SiteBox> level((below + width - 1) / width);
  for_each_block(level.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      level[i] = around(i * width, std::min((i + 1) * width, below));
  });
  return level;
}

} // namespace

SiteBoxes::SiteBoxes(const Array<Vec3>& sites) {
  levels_.push_back(make_level(sites.size(), [&](std::int64_t begin, std::int64_t end) {
    return around_sites(sites, begin, end);
  }));
  while (levels_.back().size() > width) {
    const Array<SiteBox>& below = levels_.back();
    Array<SiteBox> level = make_level(below.size(), [&](std::int64_t begin, std::int64_t end) {
      return around_boxes(below, begin, end);
    });
    levels_.push_back(std::move(level));
  }
}

} // namespace calotte::delaunay_detail
