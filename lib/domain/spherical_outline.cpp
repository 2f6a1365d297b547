// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/spherical_outline.h"

#include "base/double_double.h"
#include "base/first_fault.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/spherical_angles.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace calotte::domain_detail {
namespace {

[[noreturn]] void refuse(const std::string& what, std::int64_t ring) {
  throw Error(ErrorCode::bad_option, "the region: " + what, ring);
}

std::string corner_name(std::int64_t ring, std::int64_t corner) {
  return "ring " + std::to_string(ring) + ", corner " + std::to_string(corner);
}

bool is_direction(const Eigen::Vector3d& x) { return x.allFinite() && !x.isZero(0); }

void append_ring(const Points3& ring, std::int64_t r, std::vector<Arc>& edges) {
  const Eigen::Index corners = ring.cols();
  if (corners < 3)
    refuse("ring " + std::to_string(r) + " has " + std::to_string(corners) +
               (corners == 1 ? " corner" : " corners") +
               " and encloses nothing; give three at least",
           r);
  for (Eigen::Index i = 0; i < corners; ++i)
    if (!is_direction(ring.col(i)))
      refuse(corner_name(r, i) + " is no direction; give finite numbers that are not all 0", r);
  for (Eigen::Index i = 0; i < corners; ++i) {
    const Arc edge{as_unit(column(ring, i)), as_unit(column(ring, (i + 1) % corners))};
    if (same_direction(edge.from, edge.to))
      refuse(corner_name(r, i) + " and the next are one place; leave one of them out", r);
    if (same_direction(edge.from, -edge.to))
      refuse(corner_name(r, i) + " and the next are opposite, so that no arc is the shortest; "
                                 "add a corner between them",
             r);
    edges.push_back(edge);
  }
}

/// The signed area of the triangle between a place and an arc, positive if they run
/// counter-clockwise. It loses digits where the arc comes near the opposite of the place.
///
/// tan(area/2) = det(o,a,b) / ((o+a).(o+b)) (Van Oosterom and Strackee, 1983); the determinant is
/// one of small differences.
double triangle_area(const Vec3& o, const Arc& arc) {
  const Vec3& a = arc.from;
  const Vec3 side = dot(o, a) > 0 ? a - o : a + o;
  return 2 * longitude_of(dot(o + a, o + arc.to), dot(o, cross(side, arc.to - a)));
}

/// Places to sum triangles from: the mean direction of the edges, and the directions of a cube's
/// centres of faces, edges and corners.
std::vector<Vec3> origins(const std::vector<Arc>& edges) {
  Vec3 sum{0, 0, 0};
  for (const Arc& edge : edges)
    sum = sum + norm(edge.to - edge.from) * (edge.from + edge.to);
  std::vector<Vec3> places;
  if (norm(sum) > 0)
    places.push_back(normalised(sum));
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0)
          places.push_back(normalised({1.0 * x, 1.0 * y, 1.0 * z}));
  return places;
}

/// The one whose opposite is farthest from all edges.
Vec3 best_origin(const std::vector<Arc>& edges) {
  Vec3 best{0, 0, 1};
  double farthest = -1;
  for (const Vec3& place : origins(edges)) {
    double nearest = 4;
    for (auto edge = edges.begin(); edge != edges.end() && nearest > farthest; ++edge)
      nearest = std::min(nearest, square_from(*edge, -place));
    if (nearest > farthest) {
      farthest = nearest;
      best = place;
    }
  }
  return best;
}

/// The triangles between an origin and the edges have the region's area as their sum, or 4 pi less
/// where the region contains the origin's opposite.
double area_of(const SideCells& cells) {
  const Vec3 origin = best_origin(cells.arcs());
  DoubleDouble sum;
  for (const Arc& edge : cells.arcs())
    sum = sum + DoubleDouble{triangle_area(origin, edge), 0};
  if (cells.side(-origin) == Side::inside)
    sum = sum + DoubleDouble{4 * std::numbers::pi, 4 * 1.2246467991473532e-16};
  return sum.hi;
}

} // namespace

SphericalOutline::Rings SphericalOutline::rings_of(const Region& region) {
  Rings rings{{}, {0}};
  for (std::size_t r = 0; r < region.rings.size(); ++r) {
    append_ring(region.rings[r], static_cast<std::int64_t>(r), rings.edges);
    rings.begin.push_back(static_cast<std::int32_t>(rings.edges.size()));
  }
  return rings;
}

SphericalOutline::SphericalOutline(const Region& region) : SphericalOutline(rings_of(region)) {}

SphericalOutline::SphericalOutline(Rings rings)
    : ring_begin_(std::move(rings.begin)), tree_(rings.edges),
      cells_(std::move(rings.edges), corner_of(0)) {
  area_ = area_of(cells_);
}

SideCells::Corner SphericalOutline::corner_of(std::size_t ring) const {
  return {ring_begin_[ring + 1] - 1, ring_begin_[ring]};
}

} // namespace calotte::domain_detail
