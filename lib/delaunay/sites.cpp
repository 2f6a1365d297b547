// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/sites.h"

#include "base/message.h"
#include "base/require.h"
#include "curve/hilbert.h"
#include "curve/radix_sort.h"
#include "delaunay/duplicates.h"
#include "delaunay/site_inputs.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>

namespace calotte::delaunay_detail {
namespace {

/// Sets the curve keys of all inputs and checks them.
template <class Input> void set_keys(const Input& input, Array<std::uint64_t>& keys) {
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  const std::int64_t n = input.points.cols();
  std::vector<std::int64_t> offending(static_cast<std::size_t>(block_count(n)), none);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    if constexpr (std::is_same_v<Input, Directions>)
      if (input.points.outerStride() == 3 &&
          set_curve_keys(&input.at(begin), end - begin, keys.begin() + begin))
        return;
    std::int64_t& first = offending[static_cast<std::size_t>(block)];
    const auto square = [&](std::int64_t i) {
      if (input.is_valid(i))
        return input.square(i);
      first = std::min(first, i);
      return CubePoint{0, 0, 0};
    };
    for_each_curve_key(begin, end, square,
                       [&](std::int64_t i, std::uint64_t key) { keys[i] = key; });
  });
  const auto first = std::min_element(offending.begin(), offending.end());
  if (first != offending.end() && *first != none)
    input.require_valid(*first);
}

void refuse_duplicates(const std::vector<std::int32_t>& lowest, const char* twin) {
  for (std::size_t i = 0; i < lowest.size(); ++i)
    if (static_cast<std::size_t>(lowest[i]) != i)
      throw Error(ErrorCode::duplicate,
                  message("point {} {} point {}: remove it, or let duplicates be merged", i, twin,
                          lowest[i]),
                  static_cast<std::int64_t>(i));
}

/// Keeps the inputs that represent themselves and numbers them in input order.
template <class Input>
void keep_distinct(const Input& input, const std::vector<std::int32_t>& lowest, Order& order,
                   Sites& sites) {
  std::int32_t kept = 0;
  for (std::size_t i = 0; i < lowest.size(); ++i)
    sites.site_of_input[i] = static_cast<std::size_t>(lowest[i]) == i
                                 ? kept++
                                 : sites.site_of_input[static_cast<std::size_t>(lowest[i])];
  sites.points.resize(3, kept);
  for (std::size_t i = 0; i < lowest.size(); ++i)
    if (static_cast<std::size_t>(lowest[i]) == i)
      set_column(sites.points, sites.site_of_input[i], input.at(static_cast<std::int64_t>(i)));
  Order distinct{Array<std::uint64_t>(kept), Array<std::int32_t>(kept)};
  std::int64_t next = 0;
  for (std::int64_t k = 0; k < order.size(); ++k) {
    const auto i = static_cast<std::size_t>(order.items[k]);
    if (lowest[i] != order.items[k])
      continue;
    distinct.keys[next] = order.keys[k];
    distinct.items[next++] = sites.site_of_input[i];
  }
  order = std::move(distinct);
}

template <class Input> Points3 copy_points(const Input& input) {
  const std::int64_t n = input.points.cols();
  Points3 points;
  points.resize(3, n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      set_column(points, i, input.at(i));
  });
  return points;
}

void number_all(std::vector<std::int32_t>& site_of_input) {
  for_each_block(std::ssize(site_of_input),
                 [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                   std::iota(site_of_input.begin() + begin, site_of_input.begin() + end,
                             static_cast<std::int32_t>(begin));
                 });
}

template <class Input> void require_count(std::int64_t n, const char* kind) {
  if (n < Input::fewest)
    throw Error(ErrorCode::too_few_sites,
                message("there are {} {}: a triangulation of {} needs at least {}", n, kind,
                        Input::domain, Input::fewest));
  require(n <= most_points, "there are {} points: 32-bit triangle ids allow 2^30 at most", n);
}

/// Makes the sites of an input. \param all_points returns the input's points in the form of Sites;
///         called at most once, after the last read of the input's points.
template <class Input, class AllPoints>
Sites make_input_sites(const Input& input, Duplicates duplicates, double merge_within,
                       Monitor* monitor, const AllPoints& all_points) {
  require_count<Input>(input.points.cols(), "points");
  Sites sites;
  Array<std::uint64_t> keys(input.points.cols());
  set_keys(input, keys);
  step(monitor);
  Order order = order_by_key(std::move(keys));
  step(monitor);
  const std::vector<std::int32_t> lowest = link_inputs(input, order, merge_within);
  if (duplicates == Duplicates::refuse)
    refuse_duplicates(lowest, Input::twin);
  step(monitor);

  sites.site_of_input.resize(static_cast<std::size_t>(input.points.cols()));
  if (lowest.empty()) {
    sites.points = all_points();
    number_all(sites.site_of_input);
  } else {
    keep_distinct(input, lowest, order, sites);
  }
  const std::int64_t n = order.size();
  require_count<Input>(n, Input::distinct);
  sites.id = std::move(order.items);
  sites.unit = Array<Vec3>(n);
  constexpr std::int64_t ahead = 24;
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t rank = begin; rank != end; ++rank) {
      if (rank + ahead < end) // in input order, at random addresses
        __builtin_prefetch(&sites.given(sites.id[rank + ahead]));
      sites.unit[rank] = input.unit(sites.given(sites.id[rank]));
    }
  });
  sites.cells = Quadtree(std::move(order.keys), !std::is_same_v<Input, Directions>);
  sites.boxes = SiteBoxes(sites.unit);
  step(monitor);
  return sites;
}

bool is_distance(double within) { return within >= 0 && std::isfinite(within); }

void require_angle(double within) {
  require(is_distance(within), "the angle to merge within is {}; give 0 radians or more", within);
}

Vec2 rounded_point(const Image& image, const Vec2& period) {
  return {image.site.x + image.i * period.x, image.site.y + image.j * period.y};
}

} // namespace

Sites make_sites(const Points3Ref& points, Duplicates duplicates, double merge_within,
                 Monitor* monitor) {
  require_angle(merge_within);
  const Directions input{points};
  return make_input_sites(input, duplicates, merge_within, monitor,
                          [&] { return copy_points(input); });
}

Sites make_sites(Points3&& points, Duplicates duplicates, double merge_within, Monitor* monitor) {
  require_angle(merge_within);
  return make_input_sites(Directions{points}, duplicates, merge_within, monitor,
                          [&] { return std::move(points); });
}

Sites make_planar_sites(const Points2Ref& points, Duplicates duplicates, double merge_within,
                        Monitor* monitor) {
  require(is_distance(merge_within), "the distance to merge within is {}; give 0 or more",
          merge_within);
  const Frame frame = frame_of(points);
  const PlanePoints input{points, frame};
  Sites sites = make_input_sites(input, duplicates, merge_within, monitor,
                                 [&] { return copy_points(input); });
  sites.frame = frame;
  return sites;
}

Sites make_sites(std::vector<Image> images, const Vec2& period) {
  Points2 points(2, std::ssize(images));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec2 point = rounded_point(images[static_cast<std::size_t>(i)], period);
    points.col(i) << point.x, point.y;
  }
  Frame frame = frame_of(points);
  frame.period = period;
  const Images input{{points, frame}};
  Sites sites =
      make_input_sites(input, Duplicates::merge, 0, nullptr, [&] { return copy_points(input); });
  sites.frame = frame;
  sites.images = std::move(images);
  return sites;
}

} // namespace calotte::delaunay_detail
