// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/sites.h"

#include "base/matrix_memory.h"
#include "curve/hilbert.h"
#include "curve/radix_sort.h"
#include "exact/plane_predicates.h"
#include "exact/predicates.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <unordered_map>

namespace calotte::delaunay_detail {
namespace {

constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();

// ---- What sites are made of: how an input's points are told apart and placed along the curve.

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
bool is_zero(const Vec3& p) { return p.x == 0 && p.y == 0 && p.z == 0; }

[[noreturn]] void refuse_not_finite(std::int64_t i) {
  throw Error(ErrorCode::not_finite,
              "point " + std::to_string(i) + " has a coordinate that is NaN or infinite: remove it",
              i);
}

/// Directions of any norm.
struct Directions {
  const Points3Ref points;

  static constexpr std::int64_t fewest = 4;
  static constexpr const char* distinct = "distinct directions";
  static constexpr const char* domain = "the sphere";
  static constexpr const char* twin = " has the direction of point ";

  const Vec3& at(std::int64_t i) const { return column(points, i); }
  bool is_valid(std::int64_t i) const { return is_finite(at(i)) && !is_zero(at(i)); }
  [[noreturn]] void refuse(std::int64_t i) const {
    if (!is_zero(at(i)))
      refuse_not_finite(i);
    throw Error(
        ErrorCode::zero_vector,
        "point " + std::to_string(i) + " is the zero vector: remove it, it has no direction", i);
  }
  CubePoint square(std::int64_t i) const { return to_cube(at(i)); }
  int compare(std::int64_t i, std::int64_t j) const {
    const Vec3 &p = at(i), &q = at(j);
    const bool equal_bits = p.x == q.x && p.y == q.y && p.z == q.z; // spares exact arithmetic
    return equal_bits ? 0 : compare_directions(p, q);
  }
  bool same(std::int64_t i, std::int64_t j) const { return same_direction(at(i), at(j)); }
  static Vec3 unit(const Vec3& p) { return normalised(p); }
  /// The chord of an angle.
  static double distance(double within) {
    return 2 * std::sin(std::min(within, 3.141592653589793) / 2);
  }
  bool are_within(std::int64_t i, std::int64_t j, double within) const {
    return norm(unit(at(i)) - unit(at(j))) < distance(within);
  }
};

/// Pairs of doubles.
struct Places {
  const Points2Ref points;
  Frame frame;

  static constexpr std::int64_t fewest = 3;
  static constexpr const char* distinct = "distinct places";
  static constexpr const char* domain = "the plane";
  static constexpr const char* twin = " stands where point ";

  Vec3 at(std::int64_t i) const { return {points(0, i), points(1, i), 0}; }
  bool is_valid(std::int64_t i) const { return is_finite(at(i)); }
  [[noreturn]] static void refuse(std::int64_t i) { refuse_not_finite(i); }
  CubePoint square(std::int64_t i) const {
    const Vec3 p = unit(at(i));
    return {0, p.x, p.y};
  }
  int compare(std::int64_t i, std::int64_t j) const {
    return exact_detail::compare({points(0, i), points(1, i)}, {points(0, j), points(1, j)});
  }
  bool same(std::int64_t i, std::int64_t j) const { return compare(i, j) == 0; }
  Vec3 unit(const Vec3& p) const {
    const Vec3 q = frame(p.x, p.y);
    return {std::clamp(q.x, -1.0, 1.0), std::clamp(q.y, -1.0, 1.0), 0};
  }
  double distance(double within) const { return within * frame.scale / frame.half; }
  /// In halves, lest they overflow.
  bool are_within(std::int64_t i, std::int64_t j, double within) const {
    return std::hypot(points(0, i) / 2 - points(0, j) / 2, points(1, i) / 2 - points(1, j) / 2) <
           within / 2;
  }
};

/// Of the finite points.
Frame frame_of(const Points2Ref& points) {
  double largest = 0;
  for (const double x : points.reshaped())
    if (std::isfinite(x))
      largest = std::max(largest, std::abs(x));
  Frame frame;
  if (largest > 0) // so far that neither the scale nor what it scales leaves the doubles' range
    frame.scale = std::ldexp(1.0, -std::clamp(std::ilogb(largest), -1000, 1000));
  Eigen::Array2d low(2, 2), high(-2, -2);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite()) {
      const Eigen::Array2d scaled = frame.scale * points.col(i).array();
      low = low.min(scaled);
      high = high.max(scaled);
    }
  if (largest > 0) {
    Eigen::Array2d centre = (low + high) / 2;
    // The curve passes the middle lines of its square twice: a narrow box around one would be in
    // two halves. It passes once above the horizontal one and along the left edge, so they lie
    // there.
    const Eigen::Array2d extent = high - low;
    if (2 * extent.y() <= extent.x())
      centre.y() = low.y();
    else if (2 * extent.x() <= extent.y())
      centre.x() = low.x() + extent.y() / 2;
    const Eigen::Array2d half = (high - centre).max(centre - low); // the centre is rounded
    frame.centre = {centre.x(), centre.y(), 0};
    frame.half = half.maxCoeff() > 0 ? half.maxCoeff() : 1;
    low = (low - centre) / frame.half;
    high = (high - centre) / frame.half;
    frame.low = {low.x(), low.y()};
    frame.high = {high.x(), high.y()};
  }
  return frame;
}

/// Images of sites, which stand where their rounded points do.
struct Images : Places {
  static bool same(std::int64_t, std::int64_t) { return false; }
};

// ---- Stages

/// Curve keys of all inputs, which it checks.
template <class Input> Array<std::uint64_t> make_keys(const Input& input) {
  const std::int64_t n = input.points.cols();
  Array<std::uint64_t> keys(n);
  std::vector<std::int64_t> offending(static_cast<std::size_t>(block_count(n)), none);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
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
    input.refuse(*first);
  return keys;
}

/// Orders a run of inputs of equal keys: along a curve over the square that their cube points fill,
/// and so on where those keys are equal too. A cluster narrower than a finest cell is a curve like
/// any other then, where walks from site to site are short. Equal cube points end up side by side,
/// ordered by direction, then index.
template <class Input> void order_finely(const Input& input, std::span<std::int32_t> run) {
  CubePoint low = input.square(run.front()), high = low;
  for (const std::int32_t i : run) {
    const CubePoint p = input.square(i);
    low = {p.face, std::min(low.u, p.u), std::min(low.v, p.v)};
    high = {p.face, std::max(high.u, p.u), std::max(high.v, p.v)};
  }
  const double width = std::max(high.u - low.u, high.v - low.v);
  if (width == 0) {
    std::sort(run.begin(), run.end(), [&](std::int32_t a, std::int32_t b) {
      const int order = input.compare(a, b);
      return order != 0 ? order < 0 : a < b;
    });
    return;
  }
  std::vector<KeyedItem> finer;
  finer.reserve(run.size());
  for (const std::int32_t i : run) {
    const CubePoint p = input.square(i);
    const double u = (p.u - low.u) / width, v = (p.v - low.v) / width;
    finer.push_back({curve_key({p.face, 2 * u - 1, 2 * v - 1}), i});
  }
  std::sort(finer.begin(), finer.end(), precedes);
  for (std::size_t i = 0; i < finer.size(); ++i)
    run[i] = finer[i].item;
  for (std::size_t i = 0, last = 0; i < finer.size(); i = last) {
    while (last < finer.size() && finer[last].key == finer[i].key)
      ++last;
    if (last - i > 1)
      order_finely(input, run.subspan(i, last - i));
  }
}

/// For each input the lowest index of the same direction. Equal directions have the same bits on
/// the cube, hence the same key, and stand side by side in a run of equal keys that is in order.
template <class Input>
void link_duplicates(const Input& input, std::span<std::int32_t> run,
                     std::vector<std::int32_t>& lowest) {
  order_finely(input, run);
  for (std::size_t i = 1; i < run.size(); ++i)
    if (input.same(run[i - 1], run[i]))
      lowest[static_cast<std::size_t>(run[i])] = lowest[static_cast<std::size_t>(run[i - 1])];
}

/// Merges each input into an earlier one that stays and is nearer than `within`, if there is one:
/// those that stay are kept in a grid of cubes wider than the distance, rounding included.
template <class Input>
void link_near(const Input& input, double within, std::vector<std::int32_t>& lowest) {
  const double cell = (1 + 1e-9) * input.distance(within) + 0x1p-48;
  std::unordered_multimap<std::uint64_t, std::int32_t> grid;
  const auto cell_of = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
  // Cubes that share a hash cost time alone: distances are compared.
  const auto hash = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    std::uint64_t h = 0;
    for (const std::int64_t index : {i, j, k})
      h = (h ^ h >> 32 ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15U;
    return h;
  };
  const auto lowest_kept = [&](std::int64_t candidate) {
    const Vec3 p = input.unit(input.at(candidate));
    std::int64_t best = none;
    for (std::int64_t i = cell_of(p.x) - 1; i <= cell_of(p.x) + 1; ++i)
      for (std::int64_t j = cell_of(p.y) - 1; j <= cell_of(p.y) + 1; ++j)
        for (std::int64_t k = cell_of(p.z) - 1; k <= cell_of(p.z) + 1; ++k) {
          const auto [first, last] = grid.equal_range(hash(i, j, k));
          for (auto it = first; it != last; ++it)
            if (input.are_within(candidate, it->second, within))
              best = std::min<std::int64_t>(best, it->second);
        }
    return best;
  };
  for (std::int64_t i = 0; i < input.points.cols(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (lowest[index] != i) { // its twin came earlier and knows by now where it went
      lowest[index] = lowest[static_cast<std::size_t>(lowest[index])];
      continue;
    }
    const Vec3 p = input.unit(input.at(i));
    if (const std::int64_t kept = lowest_kept(i); kept != none)
      lowest[index] = static_cast<std::int32_t>(kept);
    else
      grid.emplace(hash(cell_of(p.x), cell_of(p.y), cell_of(p.z)), static_cast<std::int32_t>(i));
  }
}

/// For each input the one that stands for it; empty when each stands for itself.
template <class Input>
std::vector<std::int32_t> link_inputs(const Input& input, Order& order, double merge_within) {
  const std::int64_t n = order.size();
  const Array<std::uint64_t>& keys = order.keys;
  std::vector<std::pair<std::int64_t, std::int64_t>> runs; // of equal keys
  std::vector<std::vector<std::pair<std::int64_t, std::int64_t>>> found(
      static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      if (i + 1 == n || keys[i] != keys[i + 1])
        continue;
      if (i > 0 && keys[i - 1] == keys[i])
        continue;
      std::int64_t last = i + 2;
      while (last != n && keys[last] == keys[i])
        ++last;
      found[static_cast<std::size_t>(block)].emplace_back(i, last);
    }
  });
  for (const auto& list : found)
    runs.insert(runs.end(), list.begin(), list.end());
  if (runs.empty() && merge_within == 0)
    return {};

  std::vector<std::int32_t> lowest(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < lowest.size(); ++i)
    lowest[i] = static_cast<std::int32_t>(i);
  for_each_task(static_cast<std::int64_t>(runs.size()), [&](std::int64_t r) {
    const auto [begin, end] = runs[static_cast<std::size_t>(r)];
    link_duplicates(input, {order.items.begin() + begin, order.items.begin() + end}, lowest);
  });
  if (merge_within > 0)
    link_near(input, merge_within, lowest);
  return lowest;
}

void refuse_duplicates(const std::vector<std::int32_t>& lowest, const char* twin) {
  for (std::size_t i = 0; i < lowest.size(); ++i)
    if (static_cast<std::size_t>(lowest[i]) != i)
      throw Error(ErrorCode::duplicate,
                  "point " + std::to_string(i) + twin + std::to_string(lowest[i]) +
                      ": remove it, or let duplicates be merged",
                  static_cast<std::int64_t>(i));
}

/// Keeps the inputs that stand for themselves and numbers them in the order of the input.
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

template <class Input> Points3 copy_of(const Input& input) {
  const std::int64_t n = input.points.cols();
  Points3 points;
  make_room(points, 3, n);
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
    throw Error(ErrorCode::too_few_sites, "there are " + std::to_string(n) + " " + kind +
                                              ": a triangulation of " + Input::domain +
                                              " needs at least " + std::to_string(Input::fewest));
  if (n > std::int64_t{1} << 30)
    throw Error(ErrorCode::bad_option, "there are " + std::to_string(n) +
                                           " points: 32-bit triangle ids allow 2^30 at most");
}

/// \param all_points the input's points as Sites holds them; called at most once, last of all.
template <class Input, class AllPoints>
Sites make_sites_of(const Input& input, Duplicates duplicates, double merge_within,
                    Monitor* monitor, const AllPoints& all_points) {
  require_count<Input>(input.points.cols(), "points");
  Array<std::uint64_t> keys = make_keys(input);
  step(monitor);
  Order order = order_by_key(std::move(keys));
  step(monitor);
  const std::vector<std::int32_t> lowest = link_inputs(input, order, merge_within);
  if (duplicates == Duplicates::refuse)
    refuse_duplicates(lowest, Input::twin);
  step(monitor);

  Sites sites;
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
      if (rank + ahead < end) // in the input's order they are anywhere
        __builtin_prefetch(&sites.given(sites.id[rank + ahead]));
      sites.unit[rank] = input.unit(sites.given(sites.id[rank]));
    }
  });
  sites.cells = Quadtree(std::move(order.keys), !std::is_same_v<Input, Directions>);
  sites.boxes = SiteBoxes(sites.unit);
  step(monitor);
  return sites;
}

void require_distance(double merge_within, const std::string& kind, const std::string& unit) {
  if (!(merge_within >= 0) || !std::isfinite(merge_within))
    throw Error(ErrorCode::bad_option, "the " + kind + " to merge within is " +
                                           std::to_string(merge_within) + "; give 0" + unit +
                                           " or more");
}

Vec2 place_of(const Image& image, const Vec2& period) {
  return {image.site.x + image.i * period.x, image.site.y + image.j * period.y};
}

} // namespace

Sites make_sites(const Points3Ref& points, Duplicates duplicates, double merge_within,
                 Monitor* monitor) {
  require_distance(merge_within, "angle", " radians");
  const Directions input{points};
  return make_sites_of(input, duplicates, merge_within, monitor, [&] { return copy_of(input); });
}

Sites make_sites(Points3&& points, Duplicates duplicates, double merge_within, Monitor* monitor) {
  require_distance(merge_within, "angle", " radians");
  return make_sites_of(Directions{points}, duplicates, merge_within, monitor,
                       [&] { return std::move(points); });
}

Sites make_planar_sites(const Points2Ref& points, Duplicates duplicates, double merge_within,
                        Monitor* monitor) {
  require_distance(merge_within, "distance", "");
  const Frame frame = frame_of(points);
  const Places input{points, frame};
  Sites sites =
      make_sites_of(input, duplicates, merge_within, monitor, [&] { return copy_of(input); });
  sites.frame = frame;
  return sites;
}

Sites make_sites(std::vector<Image> images, const Vec2& period) {
  Points2 points(2, std::ssize(images));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec2 place = place_of(images[static_cast<std::size_t>(i)], period);
    points.col(i) << place.x, place.y;
  }
  Frame frame = frame_of(points);
  frame.period = period;
  const Images input{{points, frame}};
  Sites sites = make_sites_of(input, Duplicates::merge, 0, nullptr, [&] { return copy_of(input); });
  sites.frame = frame;
  sites.images = std::move(images);
  return sites;
}

} // namespace calotte::delaunay_detail
