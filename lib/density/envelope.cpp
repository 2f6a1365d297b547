// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/envelope.h"

#include "base/elementary.h"
#include "base/message.h"
#include "base/parallel.h"
#include "base/require.h"
#include "density/surface_density.h"
#include "domain/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace calotte::density_detail {
namespace {

constexpr double smallest_side = 0x1p-40; // far above sizes whose halves round
constexpr std::size_t lattice = 8;        ///< points along a box
constexpr int first_depth = 6, last_depth = 9;

/// The square of the distance of a box from the disc's centre.
double least_square(const Box& box) {
  const double x = std::max({0.0, box.x, -(box.x + box.side)}),
               y = std::max({0.0, box.y, -(box.y + box.side)});
  return x * x + y * y;
}

/// False only if all corners of the box lie on one side of the edge, so that the edge misses the
/// box. A close miss may count as a hit. \pre the edge's bounding box meets the box.
bool crosses(const Outline::Edge& edge, const Box2& box) {
  const double dx = edge.to.x - edge.from.x, dy = edge.to.y - edge.from.y;
  int left = 0, right = 0;
  for (const double x : {box.low.x, box.high.x})
    for (const double y : {box.low.y, box.high.y}) {
      const double along = dx * (y - edge.from.y), across = dy * (x - edge.from.x);
      const double error = 1e-14 * (std::abs(along) + std::abs(across));
      left += along - across > error;
      right += along - across < -error;
    }
  return left < 4 && right < 4;
}

bool contains(const Box& box, const Witness& witness) {
  return witness.x >= box.x && witness.x < box.x + box.side && witness.y >= box.y &&
         witness.y < box.y + box.side;
}

/// A cap that contains the points of a box.
struct Around {
  Vec3 middle;
  double reach;
};

/// The disc is convex. If the box's middle is moved to the nearest point of the disc, every point
/// of the disc in the box is still within half a diagonal of it.
Around around_box(const Box& box) {
  const auto [x, y] = Hemispheres::nearest(box.x + 0.5 * box.side, box.y + 0.5 * box.side);
  const double half_chord = std::min(1.0, std::sqrt(0.5) * box.side);
  return {on_sphere(x, y, box.south), 2 * arc_sine(half_chord)};
}

} // namespace

Vec3 on_sphere(double x, double y, bool south) {
  const double square = x * x + y * y, scale = std::sqrt(std::max(0.0, 2 - square));
  return {x * scale, y * scale, south ? square - 1 : 1 - square};
}

Shown Hemispheres::shown(const Box& box) {
  return least_square(box) < 1 ? Shown::whole : Shown::none;
}

std::array<double, 2> Hemispheres::nearest(double x, double y) {
  const double length = std::sqrt(x * x + y * y);
  return length > 1 ? std::array{x / length, y / length} : std::array{x, y};
}

Bounds Hemispheres::bounds(const DensityEvaluator& density, const Box& box) {
  const Around around = around_box(box);
  return density.bounds(around.middle, around.reach);
}

Shown RegionMap::shown(const Box& box) const {
  const Shown shown = Hemispheres::shown(box);
  if (shown == Shown::none)
    return shown;
  const Around around = around_box(box);
  bool crossed = false;
  outline_->for_each_edge_near(around.middle, around.reach,
                               [&](const SphericalOutline::Edge&) { crossed = true; });
  if (crossed)
    return Shown::part;
  return outline_->side(around.middle) == Side::outside ? Shown::none : shown;
}

namespace {

Surface bounded(const Surface& surface) {
  require_finite_plane(surface);
  return surface.is_bounded() ? surface : rectangle({0, 0}, surface.period());
}

} // namespace

PlanarMap::PlanarMap(const Surface& surface)
    : bounded_(bounded(surface)), outline_(outline_of<Plane>(bounded_)),
      periodic_(!surface.is_bounded()) {
  const auto& [low, high] = outline_->box();
  half_extent_ = {(high.x - low.x) / 2, (high.y - low.y) / 2};
  middle_ = {low.x + half_extent_.x, low.y + half_extent_.y};
  half_ = std::max(half_extent_.x, half_extent_.y);
}

Shown PlanarMap::shown(const Box& box) const {
  const Vec3 low = point(box.x, box.y, false),
             high = point(box.x + box.side, box.y + box.side, false);
  const Box2 own{{low.x, low.y}, {high.x, high.y}};
  bool crossed = false;
  outline_->for_each_edge_near(
      own, [&](const Outline::Edge& edge) { crossed = crossed || crosses(edge, own); });
  if (crossed)
    return Shown::part;
  return outline_->side(own.low) == Side::outside ? Shown::none : Shown::whole;
}

bool PlanarMap::contains(double, double, const Vec3& point) const {
  const Side side = outline_->side({point.x, point.y});
  const Box2& box = outline_->box();
  return side == Side::inside ||
         (periodic_ && side == Side::boundary && point.x < box.high.x && point.y < box.high.y);
}

std::array<double, 2> PlanarMap::nearest(double x, double y) const {
  const double u = half_extent_.x / half_, v = half_extent_.y / half_;
  return {std::clamp(x, -u, u), std::clamp(y, -v, v)};
}

template <class Map>
void EnvelopeOf<Map>::add_quarters(const Box& box, std::vector<Box>& out) const {
  const double half = 0.5 * box.side;
  for (const double y : {box.y, box.y + half})
    for (const double x : {box.x, box.x + half}) {
      const Box quarter{x, y, half, box.south, {}};
      if (map_.shown(quarter) != Shown::none)
        out.push_back(quarter);
    }
}

template <class Map>
EnvelopeOf<Map>::EnvelopeOf(const Density& density, Map map)
    : map_(std::move(map)), density_(density),
      sampled_(!(density.uniform() || has_bumps(density)) || !map_.is_certain(density)) {
  const auto is_zero = [](const Box& box) { return !(box.bounds.greatest > 0); };
  int depth = sampled_ ? first_depth : 0;
  cover(depth);
  while (std::all_of(boxes_.begin(), boxes_.end(), is_zero)) {
    if (depth++ == last_depth)
      refuse(message("the density is zero at each of {} points spread over the {}: "
                     "make it positive somewhere",
                     boxes_.size() * lattice * lattice, Map::name));
    cover(depth);
  }
  refine();
  finish();
}

/// Starts from the whole map, halved `depth` times.
template <class Map> void EnvelopeOf<Map>::cover(int depth) {
  boxes_ = map_.squares();
  for (; depth > 0; --depth) {
    std::vector<Box> quarters;
    for (const Box& box : boxes_)
      add_quarters(box, quarters);
    boxes_ = std::move(quarters);
  }
  bound(boxes_);
}

/// Halves the boxes with the largest effect until the integrals of both bounds are close, or until
/// there are too many boxes. In the latter case, as at a long thin ridge, more proposals are
/// rejected.
template <class Map> void EnvelopeOf<Map>::refine() {
  const std::size_t most = boxes_.size() + (1 << 16);
  while (boxes_.size() < most) {
    double least = 0, greatest = 0;
    for (const Box& box : boxes_) {
      least += box.bounds.least * box.area();
      greatest += box.bounds.greatest * box.area();
    }
    const double mean_excess = (greatest - least) / static_cast<double>(boxes_.size());
    const auto stays = [&](const Box& box) {
      return (box.bounds.greatest - box.bounds.least) * box.area() <= 0.5 * mean_excess ||
             box.side <= smallest_side;
    };
    const auto rest = std::stable_partition(boxes_.begin(), boxes_.end(), stays);
    if (greatest <= 2 * least || rest == boxes_.end())
      return;
    std::vector<Box> quarters;
    for (auto box = rest; box != boxes_.end(); ++box)
      add_quarters(*box, quarters);
    bound(quarters);
    boxes_.erase(rest, boxes_.end());
    boxes_.insert(boxes_.end(), quarters.begin(), quarters.end());
  }
}

template <class Map> void EnvelopeOf<Map>::finish() {
  double mass = 0, area = 0;
  for (const Box& box : boxes_) {
    mass += box.bounds.greatest * box.area();
    area += box.area();
  }
  const double floor = sampled_ ? mass / area / 16 : 0;
  double sum = 0;
  mass_before_.clear();
  for (Box& box : boxes_) {
    box.bounds.greatest = std::max(box.bounds.greatest, floor);
    mass_before_.push_back(sum += box.bounds.greatest * box.area());
  }
}

template <class Map> std::int64_t EnvelopeOf<Map>::choose(double unit) const {
  const auto found =
      std::upper_bound(mass_before_.begin(), mass_before_.end() - 1, unit * mass_before_.back());
  return found - mass_before_.begin();
}

template <class Map> void EnvelopeOf<Map>::raise(const std::vector<Witness>& witnesses) {
  constexpr int halvings = 4;
  std::vector<Box> siblings;
  for (const Witness& witness : witnesses) {
    Box& box = boxes_[static_cast<std::size_t>(witness.box)];
    for (int h = 0; h < halvings && box.side > smallest_side; ++h) {
      std::vector<Box> quarters;
      add_quarters(box, quarters);
      for (const Box& quarter : quarters)
        if (contains(quarter, witness))
          box = quarter;
        else
          siblings.push_back(quarter);
    }
    // Both bounds become equal, so that the box is not halved again.
    box.bounds.greatest = std::max(2 * witness.rho, box.bounds.greatest);
    box.bounds.least = box.bounds.greatest;
  }
  bound(siblings);
  boxes_.insert(boxes_.end(), siblings.begin(), siblings.end());
  refine();
  finish();
}

template <class Map> void EnvelopeOf<Map>::bound(std::vector<Box>& boxes) const {
  const auto n = std::ssize(boxes);
  constexpr std::int64_t batch = 64; // boxes of a task
  for_each_task((n + batch - 1) / batch, [&](std::int64_t task) {
    for (std::int64_t b = task * batch; b < std::min(n, (task + 1) * batch); ++b) {
      Box& box = boxes[static_cast<std::size_t>(b)];
      box.bounds = sampled_ ? sampled_bounds(box) : map_.bounds(density_, box);
      if (map_.shown(box) == Shown::part)
        box.bounds.least = 0;
    }
  });
}

/// Samples the density in the box and a quarter of a side around it, and adds a margin.
template <class Map> Bounds EnvelopeOf<Map>::sampled_bounds(const Box& box) const {
  constexpr double step = 1.5 / lattice, margin = 1.25;
  std::array<std::array<double, lattice * lattice>, 4> rows;
  auto& [x, y, z, rho] = rows;
  for (std::size_t i = 0; i < rho.size(); ++i) {
    const std::size_t row = i / lattice, column = i % lattice;
    const auto [u, v] =
        map_.nearest(box.x + box.side * (step * (static_cast<double>(column) + 0.5) - 0.25),
                     box.y + box.side * (step * (static_cast<double>(row) + 0.5) - 0.25));
    const Vec3 p = map_.point(u, v, box.south);
    x[i] = p.x;
    y[i] = p.y;
    z[i] = p.z;
  }
  density_(x, y, z, rho);
  const auto [least, greatest] = std::minmax_element(rho.begin(), rho.end());
  return {*least, margin * *greatest};
}

template class EnvelopeOf<Hemispheres>;
template class EnvelopeOf<RegionMap>;
template class EnvelopeOf<PlanarMap>;

} // namespace calotte::density_detail
