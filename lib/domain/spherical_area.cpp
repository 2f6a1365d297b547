// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/spherical_area.h"

#include "base/double_double.h"
#include "base/spherical_triangle.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace calotte::domain_detail {
namespace {

constexpr DoubleDouble sphere{4 * std::numbers::pi, 4 * 1.2246467991473532e-16};

/// Candidate origins for sums of triangles: the mean direction of the arcs, and the directions of a
/// cube's faces, edges and corners.
std::vector<Vec3> origins(std::span<const Arc> arcs) {
  Vec3 sum{0, 0, 0};
  for (const Arc& arc : arcs)
    sum = sum + norm(arc.to - arc.from) * (arc.from + arc.to);
  std::vector<Vec3> points;
  if (norm(sum) > 0)
    points.push_back(normalised(sum));
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double z : {-1.0, 0.0, 1.0})
        if (x != 0 || y != 0 || z != 0)
          points.push_back(normalised({x, y, z}));
  return points;
}

/// The origin whose opposite is farthest from all arcs.
Vec3 best_origin(std::span<const Arc> arcs) {
  Vec3 best{0, 0, 1};
  double farthest = -1;
  for (const Vec3& point : origins(arcs)) {
    double nearest = 4;
    for (auto arc = arcs.begin(); arc != arcs.end() && nearest > farthest; ++arc)
      nearest = std::min(nearest, square_from(*arc, -point));
    if (nearest > farthest) {
      farthest = nearest;
      best = point;
    }
  }
  return best;
}

/// The sum of the triangles between an origin and arcs; see area_seen_from().
DoubleDouble sum_from(const Vec3& origin, std::span<const Arc> arcs) {
  DoubleDouble sum;
  for (const Arc& arc : arcs)
    for_each_part(arc, [&](const Arc& part) {
      sum = sum + DoubleDouble{triangle_area(origin, part.from, part.to), 0};
    });
  return sum;
}

} // namespace

double area_inside(const SideCells& cells) {
  const Vec3 origin = best_origin(cells.arcs());
  const DoubleDouble sum = sum_from(origin, cells.arcs());
  return cells.side(-origin) == Side::inside ? (sum + sphere).hi : sum.hi;
}

double area_seen_from(const Vec3& origin, std::span<const Arc> arcs) {
  return sum_from(origin, arcs).hi;
}

double area_to_the_left(std::span<const Arc> arcs) {
  DoubleDouble sum = sum_from(best_origin(arcs), arcs);
  while (sum.hi < 0)
    sum = sum + sphere;
  while (sum.hi >= sphere.hi)
    sum = sum - sphere;
  return sum.hi;
}

} // namespace calotte::domain_detail
