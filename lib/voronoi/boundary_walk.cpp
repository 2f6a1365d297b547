// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/boundary_walk.h"

#include "base/points.h"
#include "exact/space.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace calotte::voronoi_detail {
namespace {

/// The next cell along an edge of the boundary; none at the end of the edge.
struct Step {
  std::int32_t cell = -1;
  double share = 2; ///< position along the edge, 0 to 1, where its cell begins
  double gain = 0;  ///< progress in the direction of the edge
};

/// The point of the surface at a point of a chord between two of its points.
Vec3 on_surface(const Sphere&, const Vec3& x) { return normalised(x); }
Vec3 on_surface(const Plane&, const Vec3& x) { return x; }

/// How much the difference of half the squares of two distances errs where sites do not have
/// exactly the norm 1.
double norm_error(const Sphere&) { return 0x1p-51; }
double norm_error(const Plane&) { return 0; }

template <Space S> class Walk {
public:
  Walk(const Points3& sites, const Neighbours& neighbours)
      : sites_(sites), neighbours_(neighbours) {}

  /// Goes from a cell at one point to the cell at another. Calls cross(cell, next, point).
  template <class Cross>
  std::int32_t go(std::int32_t cell, const Vec3& from, const Vec3& to, const Cross& cross) const {
    double share = 0;
    for (Eigen::Index steps = 0; steps <= sites_.cols(); ++steps) {
      const Step step = step_from(cell, from, to);
      if (step.cell < 0)
        return cell;
      share = std::max(share, step.share);
      cross(cell, step.cell, share == 1 ? to : on_surface(S(), from + share * (to - from)));
      cell = step.cell;
    }
    throw Error(ErrorCode::internal, "the walk along the domain's boundary has no end");
  }

  /// Whether two consecutive vertices are equal up to rounding.
  bool near(const BoundaryVertex& a, const BoundaryVertex& b) const {
    const double rounding =
        0x1p-50 * (std::abs(a.point.x) + std::abs(a.point.y) + std::abs(a.point.z));
    return norm(b.point - a.point) <= rounding + relative * norm(a.point - site(a.after));
  }

  /// The crossings at a point where several cells meet: the path from one cell to another through
  /// the fewest cells on the domain's side. None if rounding has changed their order.
  std::optional<std::vector<BoundaryVertex>> around(const Vec3& point, std::int32_t from,
                                                    std::int32_t to) const {
    std::vector<BoundaryVertex> path;
    if (from == to)
      path.push_back({point, from, from});
    for (std::int32_t cell = from; cell != to;) {
      const std::int32_t next = towards(point, cell, to);
      if (next < 0)
        return std::nullopt;
      path.push_back({point, cell, next});
      cell = next;
    }
    return path;
  }

  const Vec3& site(std::int32_t i) const { return column(sites_, i); }

private:
  static constexpr double relative = 0x1p-44; ///< error of an offset or product

  /// The angle, turning right, from the direction of one site to that of another, seen from a
  /// point; 0 to 2 pi.
  double turn(const Vec3& point, std::int32_t from, std::int32_t to) const {
    const Vec3 up = S::up(point);
    const auto tangent = [&](const Vec3& way) { return way - dot(way, up) * up; };
    const Vec3 a = tangent(site(from) - point), b = tangent(site(to) - point);
    const double angle = -std::atan2(dot(up, cross(a, b)), dot(a, b));
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
  }

  /// The neighbour to which a path around a point goes from a cell, clockwise: the cell `last`, or
  /// else of the neighbours that are equally near to the point the one next to `last`; -1 for none.
  std::int32_t towards(const Vec3& point, std::int32_t cell, std::int32_t last) const {
    const double all = turn(point, cell, last);
    std::int32_t farthest = -1;
    double most = 0;
    for (const std::int32_t other : neighbours_[cell]) {
      if (other == last)
        return last;
      const double part = turn(point, cell, other);
      if (over(cell, other, point) == 0 && part < all && part > most) {
        farthest = other;
        most = part;
      }
    }
    return farthest;
  }

  /// Half the difference of squared distances, positive if a is nearer; 0 if rounding could decide.
  double over(std::int32_t a, std::int32_t b, const Vec3& point) const {
    if (a > b) // the same value for both
      return -over(b, a, point);
    const Vec3 way = site(b) - site(a), there = point - site(a);
    const double value = dot(way, 0.5 * way - there),
                 error = relative * norm(way) * (norm(way) + norm(there)) + norm_error(S());
    return std::abs(value) > error ? value : 0;
  }

  Step step_from(std::int32_t cell, const Vec3& from, const Vec3& to) const {
    const Vec3 along = to - from, left = cross(S::up(from), along);
    Step first;
    for (const std::int32_t other : neighbours_[cell]) {
      const Vec3 way = site(other) - site(cell);
      const double start = over(cell, other, from), end = over(cell, other, to);
      const bool tie = start == 0 && end == 0;
      if (tie ? !(dot(left, way) > 0) : !(end < 0 && start > end))
        continue;
      const Step step{other, start > 0 ? start / (start - end) : 0, tie ? 0 : dot(along, way)};
      if (step.share < first.share || (step.share == first.share && step.gain > first.gain))
        first = step;
    }
    return first;
  }

  const Points3& sites_;
  const Neighbours& neighbours_;
};

/// Appends a vertex; a corner where cells meet is one vertex.
template <class Walk>
void append(const Walk& walk, const BoundaryVertex& vertex, std::vector<BoundaryVertex>& ring) {
  const bool again = !ring.empty() && walk.near(ring.back(), vertex);
  if (again && !ring.back().crossing())
    ring.back().after = vertex.after;
  else if (!again || vertex.crossing())
    ring.push_back(vertex);
}

/// Removes the last vertex if the ring ends where it starts.
template <class Walk> void close(const Walk& walk, std::vector<BoundaryVertex>& ring) {
  if (ring.size() < 2 || !walk.near(ring.back(), ring.front()))
    return;
  if (!ring.front().crossing())
    ring.erase(ring.begin());
  else if (!ring.back().crossing())
    ring.pop_back();
}

/// Removes cells outside of the domain where the boundary runs through a vertex of cells.
template <class Walk>
std::vector<BoundaryVertex> straightened(const Walk& walk, std::vector<BoundaryVertex> ring) {
  const auto follows = [&](std::size_t k) {
    return walk.near(ring[k == 0 ? ring.size() - 1 : k - 1], ring[k]);
  };
  std::size_t first = 0;
  while (first < ring.size() && follows(first))
    ++first;
  if (first == ring.size())
    return ring;
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first), ring.end());
  std::vector<BoundaryVertex> out;
  for (std::size_t k = 0, end = 0; k < ring.size(); k = end) {
    for (end = k + 1; end < ring.size() && follows(end);)
      ++end;
    const auto path = end == k + 1
                          ? std::nullopt
                          : walk.around(ring[k].point, ring[k].before, ring[end - 1].after);
    if (path)
      out.insert(out.end(), path->begin(), path->end());
    else
      out.insert(out.end(), ring.begin() + static_cast<std::ptrdiff_t>(k),
                 ring.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return out;
}

/// Walks along a ring once. \param cell the cell at the first corner; set to the one at the end.
template <class Walk>
std::vector<BoundaryVertex> walk_once(const Walk& walk, const std::vector<Vec3>& corners,
                                      std::int32_t& cell) {
  std::vector<BoundaryVertex> ring;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    append(walk, {corners[k], cell, cell}, ring);
    cell = walk.go(cell, corners[k], corners[k + 1 == corners.size() ? 0 : k + 1],
                   [&](std::int32_t before, std::int32_t after, const Vec3& point) {
                     append(walk, {point, before, after}, ring);
                   });
  }
  close(walk, ring);
  return ring;
}

/// Walks along a ring. Where several cells meet at the first corner, a first round finds the cell
/// in which the walk ends.
template <class Walk>
std::vector<BoundaryVertex> walk_ring(const Walk& walk, const std::vector<Vec3>& corners) {
  constexpr int most_rounds = 4;
  const auto ignore = [](std::int32_t, std::int32_t, const Vec3&) {};
  std::int32_t cell = walk.go(0, walk.site(0), corners.front(), ignore);
  for (int round = 0; round < most_rounds; ++round) {
    const std::int32_t start = cell;
    std::vector<BoundaryVertex> ring = walk_once(walk, corners, cell);
    if (cell == start)
      return straightened(walk, std::move(ring));
  }
  throw Error(ErrorCode::internal, "the walk along the domain's boundary does not return");
}

} // namespace

template <Space S>
std::vector<std::vector<BoundaryVertex>>
walk_boundary(const OutlineOf<S>& outline, const Points3& sites, const Neighbours& neighbours) {
  const Walk<S> walk(sites, neighbours);
  std::vector<std::vector<BoundaryVertex>> rings;
  for (const std::vector<Vec3>& corners : outline.rings())
    rings.push_back(walk_ring(walk, corners));
  return rings;
}

template std::vector<std::vector<BoundaryVertex>>
walk_boundary<Sphere>(const SphericalOutline&, const Points3&, const Neighbours&);
template std::vector<std::vector<BoundaryVertex>>
walk_boundary<Plane>(const Outline&, const Points3&, const Neighbours&);

} // namespace calotte::voronoi_detail
