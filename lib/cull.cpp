// SPDX-License-Identifier: GPL-3.0-or-later
#include "cull.h"

#include "cells.h"

#include <algorithm>
#include <cmath>

namespace calotte::detail {
namespace {

using Face = CapTriangulation::Face;
using Vertex = CapTriangulation::Vertex;

bool has_owned_vertex(Face face) {
  return face->vertex(0)->owned || face->vertex(1)->owned || face->vertex(2)->owned;
}

/// Radius of a ball around the centre that the region covers.
double inner_radius(const Vec3& centre, const std::vector<HalfSpace>& covered) {
  double radius = 2;
  for (const HalfSpace& h : covered)
    radius = std::min(radius, h.offset - dot(centre, h.normal));
  return radius;
}

/// Distance of x to the covered part's rim, if not far inside: then a lower bound.
double depth_of(const Vec3& x, const Vec3& centre, double inner,
                const std::vector<HalfSpace>& covered) {
  double depth = inner - norm(x - centre);
  if (depth > inner / 4)
    return depth;
  depth = 2;
  for (const HalfSpace& h : covered)
    depth = std::min(depth, h.offset - dot(x, h.normal));
  return depth;
}

// ---- The cull test

/// Error of a triangle's normal (b - a) x (c - a), for each unit of its longest side: a difference
/// of unit vectors errs by 10 roundoffs and its own rounding, the cross product by two such times a
/// side.
constexpr double normal_error = 50 * roundoff;

/// A triangle's plane and circumcap, in doubles.
struct Circumcap {
  Vec3 normal;  ///< (b - a) x (c - a), not normalised
  double area;  ///< its norm
  double sine;  ///< of the cap's radius, the circumradius of the flat triangle
  double error; ///< of the normal's direction, radians
  bool below_hemisphere;
};

Circumcap circumcap(Face face) {
  const Vec3 &a = face->vertex(0)->place.unit, &b = face->vertex(1)->place.unit,
             &c = face->vertex(2)->place.unit;
  const Vec3 ab = b - a, ac = c - a, bc = c - b;
  const double ab2 = dot(ab, ab), ac2 = dot(ac, ac), bc2 = dot(bc, bc);
  const Vec3& normal = face->circle.normal;
  const double area = norm(face->circle.normal);
  const double longest = std::sqrt(std::max({ab2, ac2, bc2}));
  const double error = normal_error * longest / area;
  return {normal, area, std::sqrt(ab2 * ac2 * bc2) / (2 * area), error, dot(normal, a) > 0};
}

/// Whether a ball around an owned vertex that holds the circumcap is covered. Its radius is the
/// chord of the cap's diameter, 2 sin r, and sin r = |ab||ac||bc| / (2 |q|), q = ab x ac. Most
/// triangles pass, so it is written without roots or quotients; a relative error of 1e-3 in q moves
/// it by less than the 2% set aside.
bool is_within_depth(Face face) {
  const Vertex a = face->vertex(0), b = face->vertex(1), c = face->vertex(2);
  const float depth = std::max({a->depth, b->depth, c->depth}); // 0 where not owned
  const Vec3 ab = b->place.unit - a->place.unit, ac = c->place.unit - a->place.unit,
             bc = c->place.unit - b->place.unit;
  const double ab2 = dot(ab, ab), ac2 = dot(ac, ac), bc2 = dot(bc, bc);
  const Vec3& normal = face->circle.normal;
  const double area2 = dot(normal, normal);
  constexpr double most_error = 1e-3, error = normal_error / most_error;
  return dot(normal, a->place.unit) > 0 && area2 > error * error * std::max({ab2, ac2, bc2}) &&
         1.04 * ab2 * ac2 * bc2 < static_cast<double>(depth) * depth * area2;
}

/// Whether the cap lies in all half-spaces: its highest point over each is cos(angle - r), the
/// angle from the cap's centre to the normal, or 1 when the cap holds the normal.
bool is_covered(const Circumcap& cap, const std::vector<HalfSpace>& covered) {
  if (!cap.below_hemisphere || !(cap.error < 1e-3) || cap.sine > 0.9)
    return false;
  const Vec3 centre = (1 / cap.area) * cap.normal;
  const double cosine = std::sqrt(1 - cap.sine * cap.sine);
  // The cap's centre errs by the normal's error e, and sin r by 1.6 e relative: by e for the
  // normal's length, by e/5 for each side, 10 roundoffs long. That moves r by 1.6 e tan r < 3.4 e.
  const double margin = 8 * cap.error + 1e-14;
  return std::all_of(covered.begin(), covered.end(), [&](const HalfSpace& h) {
    const double height = dot(centre, h.normal);
    if (height >= cosine)
      return false;
    // Near -1, the root makes 1e-8 of a rounding in the height: it must not come out too small.
    const double across = std::sqrt(1 - height * height + 1e-14);
    return height * cosine + cap.sine * across + margin <= h.offset;
  });
}

// ---- Queries

/// Sites of the whole set in conflict with a face, found from the nearest cells on: at most a few,
/// since each changes the triangulation around it.
class ConflictQuery {
public:
  ConflictQuery(CapTriangulation& triangulation, const Sites& sites)
      : triangulation_(triangulation), sites_(sites) {}

  /// Cells and sites looked at so far.
  std::int64_t looks() const { return looks_; }

  const std::vector<std::int32_t>& run(Face face) {
    face_ = face;
    found_.clear();
    const std::int8_t infinite = face->infinite;
    const Sphere& space = triangulation_.space();
    for (int i = 0; i < 3; ++i)
      corner_[static_cast<std::size_t>(i)] =
          i == infinite ? normalised(space.view().focus) : face->vertex(i)->place.unit;
    normal_ = cross(corner_[1] - corner_[0], corner_[2] - corner_[0]);
    const double longest = std::max({norm(corner_[1] - corner_[0]), norm(corner_[2] - corner_[0]),
                                     norm(corner_[2] - corner_[1])});
    normal_error_ = normal_error * longest;
    const double area = norm(normal_);
    cap_centre_ = area > 0 ? (1 / area) * normal_ : corner_[0];
    cap_radius_ = area > 0 ? norm(corner_[0] - cap_centre_) + 2 * normal_error_ / area + 1e-14 : 2;
    near_ = infinite < 0 ? corner_[0] : corner_[static_cast<std::size_t>(infinite == 0)];
    for (const Cell& cell : by_distance(sites_.cells.faces()))
      descend(cell);
    return found_;
  }

private:
  static constexpr std::size_t enough = 8;
  static constexpr std::int64_t leaf_size = 8;

  /// No site of the ball lies in the circumcap, whatever the rounding: the cap's centre and the
  /// chord of its radius err by the normal's error each. Of a triangle so thin that this says
  /// little, the ball must be below the plane: over the vertex a and any x of the ball, (x - a).q
  /// errs by |x - a| times the error and 12 roundoffs of |q|.
  bool is_outside(const Ball& ball) const {
    if (norm(ball.centre - cap_centre_) > cap_radius_ + ball.radius)
      return true;
    const Vec3 apart = ball.centre - corner_[0];
    const double area = norm(normal_), reach = norm(apart) + ball.radius;
    const double error = normal_error_ * reach + 16 * roundoff * (1 + reach) * area;
    return dot(apart, normal_) + ball.radius * area < -error;
  }

  template <std::size_t count>
  std::array<Cell, count> by_distance(std::array<Cell, count> cells) const {
    std::array<std::pair<double, std::size_t>, count> order;
    for (std::size_t c = 0; c < count; ++c) {
      const Ball ball = bounding_ball(cells[c]);
      order[c] = {norm(ball.centre - near_), c};
    }
    std::sort(order.begin(), order.end());
    std::array<Cell, count> sorted;
    for (std::size_t c = 0; c < count; ++c)
      sorted[c] = cells[order[c].second];
    return sorted;
  }

  void descend(const Cell& cell) {
    ++looks_;
    if (cell.size() == 0 || found_.size() >= enough || is_outside(bounding_ball(cell)))
      return;
    if (cell.size() <= leaf_size || !cell.divisible()) {
      for (std::int64_t r = cell.begin; r != cell.end && found_.size() < enough; ++r, ++looks_)
        if (is_in_conflict(r))
          found_.push_back(static_cast<std::int32_t>(r));
    } else {
      for (const Cell& child : by_distance(sites_.cells.children(cell)))
        descend(child);
    }
  }

  bool is_in_conflict(std::int64_t rank) {
    for (int i = 0; i < 3; ++i)
      if (i != face_->infinite && face_->vertex(i)->place.site == sites_.id[rank])
        return false;
    Sphere& space = triangulation_.space();
    return space.has_place(rank) && triangulation_.conflicts(face_, space.place(rank));
  }

  CapTriangulation& triangulation_;
  const Sites& sites_;
  Face face_;
  std::array<Vec3, 3> corner_{};
  Vec3 normal_{}, cap_centre_{}, near_{};
  double normal_error_ = 0, cap_radius_ = 0; ///< the latter a chord, and rounded up
  std::vector<std::int32_t> found_;
  std::int64_t looks_ = 0;
};

/// Faces with an owned vertex that the cull test does not certify.
std::vector<Face> uncertified_faces(CapTriangulation& triangulation,
                                    const std::vector<HalfSpace>& covered, CullCounts& counts) {
  std::vector<Face> uncertified;
  triangulation.for_each_face([&](Face face) {
    if (face->certified || !has_owned_vertex(face))
      return;
    if (CapTriangulation::is_infinite(face)) {
      uncertified.push_back(face);
      return;
    }
    if (is_within_depth(face) || is_covered(circumcap(face), covered)) {
      face->certified = true;
      ++counts.by_cull;
    } else {
      uncertified.push_back(face);
    }
  });
  return uncertified;
}

/// Whether the triangle is one of a closed mesh: finite, and its circumcap below a hemisphere.
/// Empty caps beyond that are the far side of sites that a hemisphere holds.
bool is_counter_clockwise(Face face, const Sites& sites) {
  if (CapTriangulation::is_infinite(face))
    return false;
  const auto given = [&](int i) { return sites.given(face->vertex(i)->place.site); };
  return orientation(given(0), given(1), given(2)) > 0;
}

/// Undecided predicates and insertions for each member, beyond which the set as a whole is cheaper:
/// a cap's lattices need a few, clusters that are hard to certify thousands.
constexpr std::int64_t effort = 16;

/// Looks of queries that cost as much as one of those. Where most sites stand along a great circle,
/// each triangle's circumcap runs past all of them, and the queries' looks grow with the square of
/// their number.
constexpr std::int64_t looks_an_effort = 4;

} // namespace

std::vector<Member> gather(const Sites& sites, const Regions& regions, std::int32_t k) {
  const auto region = static_cast<std::size_t>(k);
  const std::vector<HalfSpace>& covered = regions.covered[region];
  const Vec3& centre = regions.centres[region];
  const double inner = inner_radius(centre, covered);
  std::vector<Member> members;
  std::size_t count = 0;
  for (const Run& run : regions.members[region])
    count += static_cast<std::size_t>(run.end - run.begin);
  members.reserve(count);
  for (const Run& run : regions.members[region])
    for (std::int32_t r = run.begin; r != run.end; ++r) {
      const bool owned = regions.owner[r] == k;
      const double depth = owned ? depth_of(sites.unit[r], centre, inner, covered) : 0;
      // Rounded down, by more than the rounding of half-spaces: 1e-14.
      members.push_back({r, static_cast<float>(std::max(0.999999 * depth - 1e-14, 0.0)), owned});
    }
  return members;
}

bool certify(CapTriangulation& triangulation, const Sites& sites, const Regions& regions,
             std::int32_t k, CullCounts& counts) {
  const std::vector<HalfSpace>& covered = regions.covered[static_cast<std::size_t>(k)];
  ConflictQuery query(triangulation, sites);
  const std::int64_t patience = effort * (std::ssize(triangulation.members()) + 1000);
  for (;;) {
    std::vector<std::int32_t> missing;
    for (const Face face : uncertified_faces(triangulation, covered, counts)) {
      const std::vector<std::int32_t>& found = query.run(face);
      if (counts.inserted + triangulation.space().counts().filtered +
              query.looks() / looks_an_effort >
          patience)
        return false;
      missing.insert(missing.end(), found.begin(), found.end());
      if (!found.empty())
        continue;
      if (!is_counter_clockwise(face, sites))
        return false;
      face->certified = true;
      ++counts.by_query;
    }
    if (missing.empty())
      return true;
    std::sort(missing.begin(), missing.end());
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    for (const std::int32_t rank : missing)
      triangulation.insert({rank, 0, false});
    counts.inserted += std::ssize(missing);
  }
}

void certify_all(CapTriangulation& triangulation) {
  triangulation.for_each_face(
      [](Face face) { face->certified = !CapTriangulation::is_infinite(face); });
}

} // namespace calotte::detail
