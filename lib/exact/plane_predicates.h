// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "exact/room.h"

#include <cstdint>

/// The exact signs on which every topological decision in the plane rests. A site is the pair of
/// its doubles, of any size; CGAL's filtered exact predicates decide.
namespace calotte::exact_detail {

/// A Cartesian pair. Column j of a Points2 is a Vec2.
struct Vec2 {
  double x, y;
};

/// 1 when a, b, c run counter-clockwise, -1 clockwise, 0 on one line.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// 1 when d is inside the circumcircle of a, b, c counter-clockwise, 0 on it.
int in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// The order of sites by their distance from p: -1 when a is nearer than b.
int compare_distances(const Vec2& p, const Vec2& a, const Vec2& b);

/// The order of sites by (x, y), lexicographically: -1 when a comes first.
inline int compare(const Vec2& a, const Vec2& b) {
  if (a.x != b.x)
    return a.x < b.x ? -1 : 1;
  return a.y < b.y ? -1 : a.y > b.y;
}

/// For p on the line through a and b: true if it lies strictly between them.
inline bool between(const Vec2& a, const Vec2& p, const Vec2& b) {
  return compare(a, p) * compare(p, b) > 0;
}

/// The sign of in_circle if that is exactly 0, for four distinct sites on a circle.
///
/// Each site's lift onto the paraboloid grows by its own eps, the largest for the site that comes
/// first in compare(). To first order the determinant changes by the orientation of the other
/// three, which do not lie on one line. The rule does not depend on region, thread, index or order.
int in_circle_tie(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// A copy of a site of a doubly periodic box: at x + i times the period's x, y + j times its y.
struct Image {
  Vec2 site;
  int i, j;
};

/// The predicates above for copies. They are exact in the sums, and as fast if all are copies in
/// one box. A period of 0, with i and j 0, means a plane without period. The sites decide ties; the
/// shifts of the copies decide only between copies of one site. If circles are small compared with
/// the box, the mesh is therefore as periodic as the sites.
int orientation(const Vec2& period, const Image& a, const Image& b, const Image& c);
int compare_distances(const Vec2& period, const Image& p, const Image& a, const Image& b);
bool between(const Vec2& period, const Image& a, const Image& p, const Image& b);
int in_circle(const Vec2& period, const Image& a, const Image& b, const Image& c, const Image& d);
int in_circle_tie(const Vec2& period, const Image& a, const Image& b, const Image& c,
                  const Image& d);

} // namespace calotte::exact_detail
