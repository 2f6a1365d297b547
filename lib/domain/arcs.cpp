// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/arcs.h"

#include <cmath>

namespace calotte::domain_detail {

bool on_arc(const Arc& arc, const Vec3& point, int turning) {
  return turning == 0 && (same_direction(arc.from, point) || same_direction(arc.to, point) ||
                          between(View{}, arc.from, point, arc.to));
}

bool meet(const Arc& a, const Arc& b) {
  const int b_from = turn(a.from, a.to, b.from), b_to = turn(a.from, a.to, b.to);
  if (b_from * b_to > 0)
    return false;
  const int a_from = turn(b.from, b.to, a.from), a_to = turn(b.from, b.to, a.to);
  // Opposite signs alone would hold for the arc on the other side of the sphere, too.
  if (b_from != 0 && b_to == -b_from && a_from == -b_from && a_to == b_from)
    return true;
  return on_arc(a, b.from, b_from) || on_arc(a, b.to, b_to) || on_arc(b, a.from, a_from) ||
         on_arc(b, a.to, a_to);
}

bool fold(const Arc& a, const Arc& b) { return on_arc(a, b.to) || on_arc(b, a.from); }

bool reaches_from_left(const Vec3& start, const Arc& before, const Arc& after) {
  const bool left_of_before = turn(before.from, before.to, start) > 0,
             left_of_after = turn(after.from, after.to, start) > 0;
  return turn(before.from, before.to, after.to) < 0 ? left_of_before || left_of_after
                                                    : left_of_before && left_of_after;
}

// An arc of the chord c bulges by 1 - sqrt(1 - c^2/4) <= c^2/4 beyond its chord.
Box3 box_of(const Arc& arc) {
  const Vec3 chord = arc.to - arc.from;
  const double bulge = 0.25 * dot(chord, chord) + 1e-14;
  const Vec3 margin{bulge, bulge, bulge};
  const Box3 ends = joined({arc.from, arc.from}, {arc.to, arc.to});
  return {ends.low - margin, ends.high + margin};
}

Vec3 nearest_on(const Arc& arc, const Vec3& p) {
  const Vec3 across = cross(arc.from + arc.to, arc.to - arc.from), // without cancellation
      normal = (1 / norm(across)) * across;                        // not a number for a point
  if (dot(cross(normal, arc.from), p) > 0 && dot(cross(arc.to, normal), p) > 0)
    return normalised(p - dot(normal, p) * normal);
  const Vec3 a = p - arc.from, b = p - arc.to;
  return dot(a, a) <= dot(b, b) ? arc.from : arc.to;
}

double square_from(const Arc& arc, const Vec3& p) {
  double least = 4;
  for_each_part(
      arc, [&](const Arc& part) { least = std::min(least, ArcDistance(part).square_from(p)); });
  return least;
}

} // namespace calotte::domain_detail
