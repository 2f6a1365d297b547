// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vector_loops.h"
#include "curve/box_tree.h"
#include "domain/room.h"
#include "exact/predicates.h"

#include <algorithm>
#include <cmath>

/// Arcs of great circles and exact decisions on them.
namespace calotte::domain_detail {

/// The shorter arc of a great circle between two unit vectors, which are neither equal nor opposite
/// directions. It contains both ends.
struct Arc {
  Vec3 from, to;
};

/// A direction as a unit vector. A vector whose norm is 1 up to round-off keeps its bits, so that
/// the function is idempotent.
inline Vec3 as_unit(const Vec3& x) {
  constexpr double tolerance = 0x1p-47; // of a square; normalised() errs by less than 2^-49
  const double excess = dot(x, x) - 1;
  return excess >= -tolerance && excess <= tolerance ? x : normalised(x);
}

/// Calls body(part) for an arc of at most a quarter turn, or for the parts of a longer one: lengths
/// and areas lose digits where the ends are nearly opposite. The sum of the ends lies on the arc,
/// as its few digits are exact; it is not the middle if one end is longer by rounding.
/// \param most_cuts maximum number of cuts, for arcs that are half circles by rounding.
template <class Body> void for_each_part(const Arc& arc, const Body& body, int most_cuts = 64) {
  if (!(dot(arc.from, arc.to) < 0) || most_cuts == 0) {
    body(arc);
    return;
  }
  const Vec3 between = normalised(arc.from + arc.to);
  for_each_part({arc.from, between}, body, most_cuts - 1);
  for_each_part({between, arc.to}, body, most_cuts - 1);
}

/// Calls body(part) for the parts of an arc, which is bisected until their chords are at most
/// `longest`.
template <class Body> void for_each_short_part(const Arc& arc, double longest, const Body& body) {
  const Vec3 apart = arc.to - arc.from;
  if (dot(apart, apart) <= longest * longest)
    return body(arc);
  const Vec3 middle = normalised(arc.from + arc.to);
  for_each_short_part({arc.from, middle}, longest, body);
  for_each_short_part({middle, arc.to}, longest, body);
}

/// orientation() of unit vectors: the sign of det(a, b, c) for the stored doubles.
inline int turn(const Vec3& a, const Vec3& b, const Vec3& c) {
  const int sign = orientation_filter(a, b, c);
  return sign != 0 ? sign : orientation(a, b, c);
}

/// True if a direction lies on the arc; exact.
/// \param turning turn(arc.from, arc.to, point), if it is known.
bool on_arc(const Arc& arc, const Vec3& point, int turning);
inline bool on_arc(const Arc& arc, const Vec3& point) {
  return on_arc(arc, point, turn(arc.from, arc.to, point));
}

/// True if the path from one direction to another crosses the arc. The path is an arc, or empty;
/// where it passes through ends of arcs, it keeps to the right of them. The parity of the crossings
/// of a closed polygon is therefore right for any polygon; exact.
/// \pre neither end of the path lies on the arc; they are not opposite.
inline bool crosses(const Vec3& start, const Vec3& end, const Arc& arc) {
  const bool from_left = turn(start, end, arc.from) >= 0, to_left = turn(start, end, arc.to) >= 0;
  if (from_left == to_left)
    return false;
  const int way = from_left ? 1 : -1;
  return turn(arc.from, arc.to, end) == way && turn(arc.from, arc.to, start) == -way;
}

/// True if two arcs have a common point; exact.
bool meet(const Arc& a, const Arc& b);

/// True if two consecutive arcs share more than the end of a, where b begins; exact.
bool fold(const Arc& a, const Arc& b);

/// True if a path to the corner between two arcs arrives from the left of the boundary that the
/// arcs form. The path does not touch the arcs elsewhere. Exact.
/// \pre neither great circle of an arc contains `start`.
bool reaches_from_left(const Vec3& start, const Arc& before, const Arc& after);

/// A box that contains an arc, with a margin for round-off.
Box3 box_of(const Arc& arc);

/// The square of the chord between a unit vector and the nearest point of an arc; rounded.
double square_from(const Arc& arc, const Vec3& p);

/// The point of an arc of at most a quarter turn, or of an arc that is a point, nearest to a unit
/// vector; rounded.
Vec3 nearest_on(const Arc& arc, const Vec3& p);

/// An arc of at most a quarter turn, or a point, prepared for the distances of many unit vectors.
class ArcDistance {
public:
  explicit ArcDistance(const Arc& arc) : arc_(arc) {
    const Vec3 across = cross(arc.from + arc.to, arc.to - arc.from); // without cancellation
    normal_ =
        (1 / norm(across)) * across; // not a number for a point, which has no points beside it
    from_start_ = cross(normal_, arc.from);
    to_end_ = cross(arc.to, normal_);
  }

  /// square_from() of the arc.
  CALOTTE_INLINE double square_from(const Vec3& p) const {
    const double sine = dot(normal_, p), square = std::min(1.0, sine * sine),
                 beside = 2 * square / (1 + std::sqrt(1 - square));
    const Vec3 a = p - arc_.from, b = p - arc_.to;
    const bool is_beside = std::min(dot(from_start_, p), dot(to_end_, p)) >= 0; // without a branch
    return is_beside ? beside : std::min(dot(a, a), dot(b, b));
  }

private:
  Arc arc_;
  Vec3 normal_, from_start_, to_end_; ///< the two point along the arc at its ends, inwards
};

} // namespace calotte::domain_detail
