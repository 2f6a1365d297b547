// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/clipped_cell.h"

#include "domain/tangent_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace calotte::domain_detail {
namespace {

/// Cuts a cell to a slightly enlarged box: cells along the hull extend far beyond the domain.
std::vector<CellCorner> cut_to_box(std::vector<CellCorner> cell, const Box2& box,
                                   const Vec2& site) {
  const Vec2 margin = 0.01 * (box.high - box.low), low = box.low - site - margin,
             high = box.high - site + margin;
  cell = cut_by_line(cell, {1, 0}, high.x);
  cell = cut_by_line(cell, {-1, 0}, -low.x);
  cell = cut_by_line(cell, {0, 1}, high.y);
  return cut_by_line(cell, {0, -1}, -low.y);
}

/// The bounding box of a polygon, widened by more than rounding and more than the inward offset of
/// Part.
Box2 box_around(const std::vector<CellCorner>& polygon, const Vec2& site) {
  Vec2 low = polygon.front().point, high = low;
  for (const CellCorner& corner : polygon) {
    low = {std::min(low.x, corner.point.x), std::min(low.y, corner.point.y)};
    high = {std::max(high.x, corner.point.x), std::max(high.y, corner.point.y)};
  }
  const double wider =
      1e-7 * (high.x - low.x + high.y - low.y) + 1e-12 * (std::abs(site.x) + std::abs(site.y));
  const Vec2 margin{wider, wider};
  return {low - margin + site, high + margin + site};
}

template <class AnyOutline>
std::vector<Outline::Edge> boundary_near(const AnyOutline& outline, const Box2& box) {
  std::vector<Outline::Edge> boundary;
  outline.for_each_edge_near(box, [&](const Outline::Edge& edge) { boundary.push_back(edge); });
  return boundary;
}

/// The bisector with the generator of a neighbouring cell, seen from this cell's generator. It
/// decides on which side edges of the boundary are, for both cells, so that the cells agree about a
/// boundary along it.
struct Bisector {
  Vec2 beyond;

  bool none() const { return beyond.x == 0 && beyond.y == 0; }
  /// The distance from the bisector times the distance of the generators; positive on the cell's
  /// side.
  double over(const Vec2& p) const { return dot(beyond, 0.5 * beyond - p); }
  /// The position along the cell's side, counter-clockwise, times the distance of the generators.
  double along(const Vec2& p) const { return cross(beyond, p); }
};

/// Adds the part of a boundary's edge inside a cell (Cyrus and Beck, 1978).
void add_boundary(const std::vector<CellCorner>& cell, const Vec2& from, const Vec2& to,
                  std::vector<CellSide>& sides) {
  double first = 0, last = 1;
  for (const CellCorner& corner : cell) {
    const Bisector bisector{corner.beyond};
    const double start = bisector.over(from), end = bisector.over(to);
    if (start < 0 && end < 0)
      return;
    if (start < 0)
      first = std::max(first, start / (start - end));
    else if (end < 0)
      last = std::min(last, start / (start - end));
  }
  if (first < last)
    sides.push_back({from + first * (to - from), last == 1 ? to : from + last * (to - from), true});
}

/// The intersection of a side of a cell with the boundary.
struct Crossing {
  double along;
  Vec2 point;
};

/// A side of a cell between two crossings.
class Part {
public:
  Part(const Bisector& bisector, const Crossing& from, const Crossing& to)
      : bisector_(bisector), middle_(0.5 * (from.point + to.point)),
        along_(from.along + (to.along - from.along) / 2),
        noise_(1e-9 * (norm(from.point) + norm(to.point))) {}

  /// True if the domain contains the part. Its middle decides. If rounding could move the boundary
  /// across the middle, a point farther inside decides, together with the edges between the two
  /// points, which are those that add_boundary() adds to the cell.
  template <class AnyOutline>
  bool inside(const AnyOutline& outline, const Vec2& site,
              const std::vector<Outline::Edge>& boundary) const {
    const double noise =
        noise_ + 1e-14 * std::max(std::abs(site.x) + std::abs(site.y), norm(middle_));
    std::vector<double> depths;
    bool close = false;
    for (const Outline::Edge& edge : boundary)
      if (const std::optional<double> depth = intersect(edge.from - site, edge.to - site)) {
        depths.push_back(*depth);
        close = close || std::abs(*depth) <= noise;
      }
    if (!close)
      return outline.side(site + middle_) == Side::inside;
    std::sort(depths.begin(), depths.end());
    double inward = 2 * noise;
    for (const double depth : depths)
      if (std::abs(depth - inward) < noise)
        inward = depth + 2 * noise;
    const auto between =
        std::count_if(depths.begin(), depths.end(), [&](double d) { return d >= 0 && d < inward; });
    const Vec2 point = middle_ - (inward / norm(bisector_.beyond)) * bisector_.beyond;
    return (outline.side(site + point) == Side::inside) == (between % 2 == 0);
  }

private:
  /// The distance from the middle to an edge on the cell's side, in the normal direction.
  std::optional<double> intersect(const Vec2& from, const Vec2& to) const {
    const double a = bisector_.along(from), b = bisector_.along(to);
    if ((a <= along_) == (b <= along_))
      return std::nullopt;
    const double start = bisector_.over(from), end = bisector_.over(to);
    return (start + (along_ - a) / (b - a) * (end - start)) / norm(bisector_.beyond);
  }

  Bisector bisector_;
  Vec2 middle_;
  double along_;
  double noise_; ///< of cells' corners
};

/// The parts of a cell's side inside the domain. They end at the points where add_boundary() ends
/// the edges that cross the side.
template <class AnyOutline>
void add_inner(const AnyOutline& outline, const Vec2& site,
               const std::vector<Outline::Edge>& boundary, const CellCorner& corner, const Vec2& to,
               std::vector<Crossing>& crossings, std::vector<CellSide>& sides) {
  const Bisector bisector{corner.beyond};
  const Crossing begin{bisector.along(corner.point), corner.point}, end{bisector.along(to), to};
  if (bisector.none() || !(begin.along < end.along)) // along the box, or of no length
    return;
  crossings.assign({begin, end});
  for (const Outline::Edge& edge : boundary) {
    const Vec2 a = edge.from - site, b = edge.to - site;
    const double start = bisector.over(a), share = start / (start - bisector.over(b));
    // A crossing due to rounding is harmless: it only divides a part in two.
    if (!(share > -1e-9 && share < 1 + 1e-9))
      continue;
    const Vec2 point = a + share * (b - a);
    if (const double at = bisector.along(point); at > begin.along && at < end.along)
      crossings.push_back({at, point});
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.along < b.along; });
  for (std::size_t k = 0; k + 1 < crossings.size(); ++k)
    if (const Crossing& p = crossings[k], &q = crossings[k + 1];
        p.along < q.along && Part(bisector, p, q).inside(outline, site, boundary))
      sides.push_back({p.point, q.point, false});
}

/// Finds the nearest point of segments to a given point.
class Nearest {
public:
  explicit Nearest(const Vec2& to) : to_(to) {}

  void look_at(const Vec2& p, const Vec2& q) {
    const Vec2 way = q - p;
    const double length2 = dot(way, way);
    const Vec2 point =
        length2 > 0 ? p + std::clamp(dot(to_ - p, way) / length2, 0.0, 1.0) * way : p;
    if (const double square = dot(point - to_, point - to_); square < least_) {
      least_ = square;
      point_ = point;
    }
  }

  /// The inward direction of an edge, and of a corner that points into the cell.
  template <class AnyOutline>
  std::optional<Vec2> inside(const AnyOutline& outline, const Vec2& site) const {
    const Vec2 onward = point_ - to_;
    const double length = norm(onward), reach = norm(point_) + length;
    for (double share = 1e-9; share < 0.1 && length > 0 && std::isfinite(least_); share *= 8) {
      const Vec2 point = point_ + (share * reach / length) * onward;
      if (outline.side(site + point) == Side::inside)
        return point;
    }
    return std::nullopt;
  }

private:
  Vec2 to_, point_{0, 0};
  double least_ = std::numeric_limits<double>::infinity();
};

} // namespace

bool near_boundary(const Outline& outline, const Vec2& site, double reach) {
  const Box2& box = outline.box();
  if (!(reach < box.high.x - box.low.x)) // infinite or not a number, too
    return true;
  const Vec2 corner = 1.000001 * Vec2{reach, reach};
  bool found = false;
  outline.for_each_edge_near({site - corner, site + corner},
                             [&](const Outline::Edge&) { found = true; });
  return found;
}

bool near_boundary(const Outline& outline, const Vec2& site, const std::vector<CellCorner>& cell) {
  double reach2 = 0;
  for (const CellCorner& corner : cell)
    reach2 = std::max(reach2, dot(corner.point, corner.point));
  return near_boundary(outline, site, std::sqrt(reach2));
}

std::vector<CellCorner> cut_by_line(const std::vector<CellCorner>& polygon, const Vec2& normal,
                                    double offset, const Vec2& beyond) {
  std::vector<CellCorner> part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const CellCorner &a = polygon[k], &b = polygon[k + 1 == polygon.size() ? 0 : k + 1];
    const double over_a = dot(normal, a.point) - offset, over_b = dot(normal, b.point) - offset;
    if (over_a <= 0)
      part.push_back({a.point, over_a == 0 && over_b > 0 ? beyond : a.beyond});
    if ((over_a < 0) != (over_b < 0) && over_a != 0 && over_b != 0)
      part.push_back({a.point + (over_a / (over_a - over_b)) * (b.point - a.point),
                      over_b > 0 ? beyond : a.beyond});
  }
  return part;
}

std::vector<CellCorner> cut_by_bisector(const std::vector<CellCorner>& polygon,
                                        const Vec2& beyond) {
  return cut_by_line(polygon, beyond, dot(beyond, beyond) / 2, beyond);
}

template <class AnyOutline>
std::vector<CellSide> clipped_cell(const AnyOutline& outline, const Vec2& site,
                                   std::vector<CellCorner> cell) {
  cell = cut_to_box(std::move(cell), outline.box(), site);
  std::vector<CellSide> sides;
  if (cell.empty())
    return sides;
  const std::vector<Outline::Edge> boundary = boundary_near(outline, box_around(cell, site));
  for (const Outline::Edge& edge : boundary)
    add_boundary(cell, edge.from - site, edge.to - site, sides);
  std::vector<Crossing> crossings;
  for (std::size_t k = 0; k < cell.size(); ++k)
    add_inner(outline, site, boundary, cell[k], cell[k + 1 == cell.size() ? 0 : k + 1].point,
              crossings, sides);
  return sides;
}

std::vector<CellSide> parts_inside(const Outline& outline, const Vec2& site,
                                   const CellCorner& corner, const Vec2& to) {
  std::vector<Crossing> crossings;
  std::vector<CellSide> parts;
  add_inner(outline, site, boundary_near(outline, box_around({corner, {to, {}}}, site)), corner, to,
            crossings, parts);
  return parts;
}

template <class AnyOutline>
std::optional<Vec2> nearest_inside(const AnyOutline& outline, const Vec2& site,
                                   const std::vector<CellSide>& sides, const Vec2& outside) {
  Nearest nearest(outside);
  for (const CellSide& side : sides)
    if (side.boundary)
      nearest.look_at(side.p, side.q);
  return nearest.inside(outline, site);
}

template <class AnyOutline>
std::optional<Vec2> nearest_inside(const AnyOutline& outline, const Vec2& site,
                                   const Vec2& outside) {
  Nearest nearest(outside);
  const double radius = norm(outside);
  const Vec2 corner{radius, radius}, there = site + outside;
  outline.for_each_edge_near({there - corner, there + corner}, [&](const auto& edge) {
    nearest.look_at(edge.from - site, edge.to - site);
  });
  return nearest.inside(outline, site);
}

template std::vector<CellSide> clipped_cell(const Outline&, const Vec2&, std::vector<CellCorner>);
template std::vector<CellSide> clipped_cell(const TangentOutline&, const Vec2&,
                                            std::vector<CellCorner>);
template std::optional<Vec2> nearest_inside(const Outline&, const Vec2&,
                                            const std::vector<CellSide>&, const Vec2&);
template std::optional<Vec2> nearest_inside(const TangentOutline&, const Vec2&,
                                            const std::vector<CellSide>&, const Vec2&);
template std::optional<Vec2> nearest_inside(const Outline&, const Vec2&, const Vec2&);
template std::optional<Vec2> nearest_inside(const TangentOutline&, const Vec2&, const Vec2&);

} // namespace calotte::domain_detail
