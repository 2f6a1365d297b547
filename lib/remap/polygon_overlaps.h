// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "curve/box_tree.h"
#include "curve/curve_squares.h"
#include "curve/hilbert.h"
#include "exact/space.h"
#include "remap/room.h"
#include "remap/weight_rows.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

/// The areas that polygons share with others. A tree of boxes finds pairs, which are clipped by
/// half-spaces (Sutherland and Hodgman, Comm. ACM 17, 1974).
namespace calotte::remap_detail {

using curve_detail::Box3;
using curve_detail::BoxTree;

inline Vec3 normalised_in(const exact_detail::Sphere&, const Vec3& x) { return (1 / norm(x)) * x; }
inline Vec3 normalised_in(const exact_detail::Plane&, const Vec3& x) { return x; }

/// A convex part of a polygon, whose area counts with a sign.
struct SignedPart {
  std::vector<Vec3> corners;
  double sign = 1;
};

/// The corners of a polygon in the space, counter-clockwise; in a periodic plane, the copies
/// nearest to the first corner.
template <Space S>
void set_corners(const S& space, const Polygons& polygons, std::int64_t i,
                 std::vector<Vec3>& corners) {
  corners.clear();
  for (const std::int32_t id : polygons.ids[i]) {
    const Vec3& corner = column(polygons.corners, id);
    corners.push_back(
        corners.empty() || S::on_sphere ? corner : corners[0] + space.offset(corners[0], corner));
  }
}

/// The area of a polygon: the sum of the triangles from its first corner.
template <Space S> double area_of(const S& space, std::span<const Vec3> corners) {
  double sum = 0;
  for (std::size_t k = 2; k < corners.size(); ++k)
    sum += space.area(corners[0], corners[k - 1], corners[k]);
  return sum;
}

/// Whether a polygon turns right at no corner, up to rounding.
template <Space S> bool is_convex(const S&, std::span<const Vec3> corners) {
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % n], &c = corners[(k + 2) % n];
    const double turn = S::area_term(a, b, c), rounding = 1e-14 * (norm(b - a) + norm(c - b));
    if (turn < -rounding)
      return false;
  }
  return true;
}

/// The convex parts of a polygon: a convex polygon itself; for a concave one the triangles from its
/// first corner, with the sign -1 if they run clockwise.
template <Space S>
void set_parts(const S& space, const std::vector<Vec3>& corners, std::vector<SignedPart>& parts) {
  parts.clear();
  if (corners.size() < 3)
    return;
  if (is_convex(space, corners)) {
    parts.push_back({corners, 1});
    return;
  }
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Vec3 &a = corners[0], &b = corners[k - 1], &c = corners[k];
    if (S::area_term(a, b, c) > 0)
      parts.push_back({{a, b, c}, 1});
    else
      parts.push_back({{a, c, b}, -1});
  }
}

/// Whether a side is longer than rounding. A shorter side, between corners of cocircular sites, has
/// an arbitrary direction. Without it a convex polygon is larger by less than the square of its
/// length.
template <Space S> bool has_direction(const Vec3& from, const Vec3& to) {
  constexpr double rounding = 1e-13;
  const Vec3 way = to - from;
  const double size = S::on_sphere ? 1 : std::max(std::abs(from.x), std::abs(from.y));
  return dot(way, way) > rounding * rounding * size * size;
}

/// The area that convex polygons share.
template <Space S> class Clipper {
public:
  explicit Clipper(const S& space) : space_(space) {}

  double operator()(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    now_ = a;
    for (std::size_t k = 0; k < b.size() && !now_.empty(); ++k) {
      const Vec3 &from = b[k], &to = b[(k + 1) % b.size()];
      if (has_direction<S>(from, to))
        cut(from, to);
    }
    return std::max(area_of(space_, now_), 0.0);
  }

private:
  /// Keeps the part to the left of a side.
  void cut(const Vec3& from, const Vec3& to) {
    next_.clear();
    const std::size_t n = now_.size();
    double before = S::area_term(from, to, now_[n - 1]);
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 &p = now_[k == 0 ? n - 1 : k - 1], &q = now_[k];
      const double after = S::area_term(from, to, q);
      if ((before > 0 && after < 0) || (before < 0 && after > 0))
        next_.push_back(normalised_in(space_, p + before / (before - after) * (q - p)));
      if (after >= 0)
        next_.push_back(q);
      before = after;
    }
    std::swap(now_, next_);
  }

  const S& space_;
  std::vector<Vec3> now_, next_;
};

/// Bounds of a polygon on the sphere or in the plane: its arcs bulge beyond its corners by less
/// than half of the square of its diameter.
template <Space S> Box3 bounds_of(const std::vector<Vec3>& corners) {
  Box3 box;
  double reach = 0;
  for (const Vec3& corner : corners) {
    box = joined(box, {corner, corner});
    reach = std::max(reach, dot(corner - corners[0], corner - corners[0]));
  }
  constexpr double rounding = 1e-14;
  const double diameter = S::on_sphere ? 4 * reach : 0, // squared
      bulge = (diameter < 1 ? 0.5 * diameter : 2) + rounding;
  const Vec3 more = S::on_sphere ? Vec3{bulge, bulge, bulge} : Vec3{0, 0, 0};
  return {box.low - more, box.high + more};
}

/// Finds the polygons that may share an area with others.
template <Space S> class PolygonOverlaps {
public:
  PolygonOverlaps(const S& space, const Polygons& source)
      : space_(space), source_(source), convex_(static_cast<std::size_t>(source.size())) {
    const std::int64_t n = source.size();
    std::vector<Box3> bounds(static_cast<std::size_t>(n));
    std::vector<std::uint64_t> keys(static_cast<std::size_t>(n));
    const curve_detail::CurveSquares<S> squares(source.corners);
    for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      std::vector<Vec3> corners;
      for (std::int64_t i = begin; i < end; ++i) {
        set_corners(space, source, i, corners);
        if (corners.empty())
          continue;
        bounds[static_cast<std::size_t>(i)] = bounds_of<S>(corners);
        keys[static_cast<std::size_t>(i)] = curve_detail::curve_key(squares(corners[0]));
        convex_[static_cast<std::size_t>(i)] = is_convex(space, corners);
      }
    });
    tree_ = BoxTree(bounds, keys);
  }

  const S& space() const { return space_; }
  const Polygons& source() const { return source_; }
  const BoxTree& tree() const { return tree_; }
  bool is_convex_source(std::int32_t i) const { return convex_[static_cast<std::size_t>(i)] != 0; }

private:
  S space_;
  const Polygons& source_;
  std::vector<std::uint8_t> convex_;
  BoxTree tree_;
};

/// Computes the areas that polygons, one after the other, share with the polygons of a source.
template <Space S> class PolygonRow {
public:
  explicit PolygonRow(const PolygonOverlaps<S>& overlaps)
      : overlaps_(overlaps), clip_(overlaps.space()) {}

  /// Sets the shared areas, sorted by the polygon of the source, without those below rounding.
  void set(const Polygons& target, std::int64_t i, WeightRow& out) {
    out.clear();
    set_corners(overlaps_.space(), target, i, corners_);
    if (corners_.size() < 3)
      return;
    for_each_shift([&](const Vec3& shift) { add_copies(shift, out); });
    sort_by_column(out);
    merge_columns(out);
  }

  /// The lowest polygon of the source that contains a point; -1 if there is none.
  std::int32_t find_containing(const Vec3& point) {
    std::int32_t lowest = -1;
    for_each_shift([&](const Vec3& shift) {
      const Vec3 moved = S::on_sphere ? point : point + shift;
      overlaps_.tree().visit(
          [&](const Box3& box) {
            return overlap(box, {moved, moved});
          },
          [&](std::int32_t other) {
            if ((lowest < 0 || other < lowest) && contains(other, moved))
              lowest = other;
          });
    });
    return lowest;
  }

private:
  /// Calls body(shift) for the copies in the periods around the box.
  template <class Body> void for_each_shift(const Body& body) const {
    if constexpr (S::on_sphere) {
      body(Vec3{0, 0, 0});
    } else {
      const Vec2 period = overlaps_.space().period();
      const int x = period.x > 0 ? 1 : 0, y = period.y > 0 ? 1 : 0;
      for (int k = -x; k <= x; ++k)
        for (int l = -y; l <= y; ++l)
          body(Vec3{k * period.x, l * period.y, 0});
    }
  }

  /// Whether a polygon contains a point, by the signs of the convex parts that contain it.
  bool contains(std::int32_t polygon, const Vec3& point) {
    constexpr double rounding = 1e-14;
    set_corners(overlaps_.space(), overlaps_.source(), polygon, others_);
    set_parts(overlaps_.space(), others_, other_parts_);
    double sum = 0;
    for (const SignedPart& part : other_parts_) {
      bool inside = true;
      for (std::size_t k = 0; k < part.corners.size() && inside; ++k) {
        const Vec3 &from = part.corners[k], &to = part.corners[(k + 1) % part.corners.size()];
        inside = !has_direction<S>(from, to) ||
                 S::area_term(from, to, point) >= -rounding * norm(to - from);
      }
      sum += inside ? part.sign : 0;
    }
    return sum > 0;
  }

  /// Adds the areas that the polygon shares when it is shifted.
  void add_copies(const Vec3& shift, WeightRow& out) {
    moved_.clear();
    for (const Vec3& corner : corners_)
      moved_.push_back(S::on_sphere ? corner : corner + shift);
    set_parts(overlaps_.space(), moved_, parts_);
    const double whole = area_of(overlaps_.space(), moved_);
    const Box3 box = bounds_of<S>(moved_);
    size_ = S::on_sphere ? 1 : std::max(greatest(box.low), greatest(box.high));
    overlaps_.tree().visit([&](const Box3& other) { return overlap(box, other); },
                           [&](std::int32_t other) { add(other, whole, out); });
  }

  void add(std::int32_t other, double whole, WeightRow& out) {
    set_corners(overlaps_.space(), overlaps_.source(), other, others_);
    const double least = std::min(whole, area_of(overlaps_.space(), others_)),
                 area = shared_area(overlaps_.is_convex_source(other));
    constexpr double rounding = 0x1p-50; // of coordinates
    if (area > rounding * size_ * std::sqrt(std::max(least, 0.0)))
      out.push_back({other, area});
  }

  double shared_area(bool convex_other) {
    if (convex_other && parts_.size() == 1)
      return clip_(parts_[0].corners, others_);
    set_parts(overlaps_.space(), others_, other_parts_);
    double area = 0;
    for (const SignedPart& own : parts_)
      for (const SignedPart& part : other_parts_)
        area += own.sign * part.sign * clip_(own.corners, part.corners);
    return area;
  }

  static double greatest(const Vec3& x) { return std::max(std::abs(x.x), std::abs(x.y)); }

  const PolygonOverlaps<S>& overlaps_;
  Clipper<S> clip_;
  std::vector<Vec3> corners_, moved_, others_;
  double size_ = 1; ///< of coordinates
  std::vector<SignedPart> parts_, other_parts_;
};

} // namespace calotte::remap_detail
