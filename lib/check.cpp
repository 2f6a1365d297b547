// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/check.h>

#include "parallel.h"
#include "predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace calotte {
namespace {

using detail::Array;
using detail::Vec3;

/// A mesh with its unit vectors, which the predicates' filters work on.
struct Surface {
  const Mesh& mesh;
  Array<Vec3> unit;

  std::int64_t sites() const { return mesh.points.cols(); }
  std::int64_t triangles() const { return mesh.triangles.cols(); }
  std::int32_t vertex(std::int64_t t, int i) const { return mesh.triangles(i % 3, t); }
  std::int32_t neighbour(std::int64_t t, int i) const { return mesh.neighbours(i % 3, t); }

  Vec3 given(std::int32_t site) const {
    return {mesh.points(0, site), mesh.points(1, site), mesh.points(2, site)};
  }

  int orientation(std::int32_t a, std::int32_t b, std::int32_t c) const {
    const int sign = detail::orientation_filter(unit[a], unit[b], unit[c]);
    return sign != 0 ? sign : detail::orientation(given(a), given(b), given(c));
  }

  int in_circle(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
    const int sign = detail::in_circle_filter(unit[a], unit[b], unit[c], unit[d]);
    return sign != 0 ? sign
                     : detail::in_circle_resolved({}, given(a), given(b), given(c), given(d));
  }
};

/// The slot of a vertex in a triangle, 3 where it is none of its vertices.
int slot_of(const Surface& s, std::int64_t t, std::int32_t vertex) {
  int i = 0;
  while (i < 3 && s.vertex(t, i) != vertex)
    ++i;
  return i;
}

std::string triangle_name(const Surface& s, std::int64_t t) {
  return "triangle " + std::to_string(t) + " (" + std::to_string(s.vertex(t, 0)) + ", " +
         std::to_string(s.vertex(t, 1)) + ", " + std::to_string(s.vertex(t, 2)) + ")";
}

/// The edge across from vertex i of triangle t.
std::string edge_name(const Surface& s, std::int64_t t, int i) {
  return "edge (" + std::to_string(s.vertex(t, i + 1)) + ", " + std::to_string(s.vertex(t, i + 2)) +
         ") of " + triangle_name(s, t);
}

/// The first answer of law(0), ..., law(n - 1) that is not empty.
template <class Law> std::string first_failure(std::int64_t n, const Law& law) {
  std::vector<std::string> failures(static_cast<std::size_t>(detail::block_count(n)));
  detail::for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::string& failure = failures[static_cast<std::size_t>(block)];
    for (std::int64_t i = begin; i != end && failure.empty(); ++i)
      failure = law(i);
  });
  const auto found = std::find_if(failures.begin(), failures.end(),
                                  [](const std::string& failure) { return !failure.empty(); });
  return found != failures.end() ? *found : std::string();
}

// ---- The arrays

std::string shape_failure(const Mesh& mesh) {
  if (mesh.triangles.cols() == 0)
    return "the mesh has no triangle";
  if (mesh.neighbours.cols() != mesh.triangles.cols())
    return "the mesh has " + std::to_string(mesh.triangles.cols()) +
           " triangles but neighbours of " + std::to_string(mesh.neighbours.cols());
  const std::int64_t n = mesh.points.cols();
  for (std::size_t i = 0; i < mesh.site_of_input.size(); ++i)
    if (mesh.site_of_input[i] < 0 || mesh.site_of_input[i] >= n)
      return "input " + std::to_string(i) + " is said to be site " +
             std::to_string(mesh.site_of_input[i]) + " of " + std::to_string(n);
  return {};
}

std::string direction_failure(const Mesh& mesh, std::int64_t site) {
  const auto p = mesh.points.col(site);
  const bool good = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]) &&
                    (p[0] != 0 || p[1] != 0 || p[2] != 0);
  return good ? std::string() : "site " + std::to_string(site) + " is not a direction";
}

std::string id_failure(const Surface& s, std::int64_t t) {
  for (int i = 0; i < 3; ++i) {
    if (s.vertex(t, i) < 0 || s.vertex(t, i) >= s.sites())
      return triangle_name(s, t) + " has a vertex outside 0 to " + std::to_string(s.sites() - 1);
    if (s.neighbour(t, i) < -1 || s.neighbour(t, i) >= s.triangles())
      return triangle_name(s, t) + " has the neighbour " + std::to_string(s.neighbour(t, i)) +
             ", outside -1 to " + std::to_string(s.triangles() - 1);
  }
  return {};
}

std::string order_failure(const Surface& s, std::int64_t t) {
  const auto vertices = [&](std::int64_t of) {
    return std::array<std::int32_t, 3>{s.vertex(of, 0), s.vertex(of, 1), s.vertex(of, 2)};
  };
  const std::array<std::int32_t, 3> own = vertices(t);
  if (own[0] == own[1] || own[1] == own[2] || own[2] == own[0])
    return triangle_name(s, t) + " has a vertex twice";
  if (own[0] > own[1] || own[0] > own[2])
    return triangle_name(s, t) + " does not start at its lowest vertex";
  if (t > 0 && vertices(t - 1) == own)
    return triangle_name(s, t) + " is there twice";
  if (t > 0 && vertices(t - 1) > own)
    return triangle_name(s, t) + " is not in the order of the vertices";
  return {};
}

std::string neighbour_failure(const Surface& s, std::int64_t t) {
  for (int i = 0; i < 3; ++i) {
    const std::int32_t other = s.neighbour(t, i);
    if (other < 0)
      continue;
    const int start = slot_of(s, other, s.vertex(t, i + 2));
    if (start == 3 || s.vertex(other, start + 1) != s.vertex(t, i + 1))
      return edge_name(s, t, i) + " is not an edge of its neighbour, " + triangle_name(s, other);
    if (s.neighbour(other, start + 2) != t)
      return edge_name(s, t, i) + ": its neighbour, " + triangle_name(s, other) +
             ", has another there";
  }
  return {};
}

// ---- The stars

/// For each site a triangle at which a walk around it begins, and how many triangles it has.
struct Stars {
  std::vector<std::int32_t>
      first; ///< -1 for none; along a boundary the one that the walk must begin at
  std::vector<std::int32_t> size;
};

Stars make_stars(const Surface& s) {
  Stars stars{std::vector<std::int32_t>(static_cast<std::size_t>(s.sites()), -1),
              std::vector<std::int32_t>(static_cast<std::size_t>(s.sites()), 0)};
  for (std::int32_t t = 0; t < s.triangles(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto vertex = static_cast<std::size_t>(s.vertex(t, i));
      ++stars.size[vertex];
      if (stars.first[vertex] < 0 || s.neighbour(t, i + 2) < 0)
        stars.first[vertex] = t;
    }
  return stars;
}

/// The triangles around a site are one cycle that turns around it once, or one fan of at most half
/// a turn.
///
/// Seen from the centre, the sites across turn left by less than half a turn from one to the next,
/// as all triangles are counter-clockwise. With the first of them ahead, each is in the left half
/// plane or in the right one; the walk has turned around once each time it comes from the right to
/// the left. A fan of at most half a turn has all on the left, the last perhaps behind: the
/// boundary is convex there.
std::string star_failure(const Surface& s, const Stars& stars, std::int32_t site) {
  const std::string name = "site " + std::to_string(site);
  const std::int32_t start = stars.first[static_cast<std::size_t>(site)];
  const std::int32_t size = stars.size[static_cast<std::size_t>(site)];
  if (start < 0)
    return name + " is no vertex of a triangle";
  const std::int32_t ahead = s.vertex(start, slot_of(s, start, site) + 1);
  std::int32_t t = start, walked = 0, turns = 0;
  int way = 1;
  bool reflex = false;
  int side = 1; // of the site across last reached: 1 ahead or left, -1 behind or right
  do {
    const int i = slot_of(s, t, site);
    const std::int32_t across = s.vertex(t, i + 2), next = s.neighbour(t, i + 1);
    way = across == ahead ? 1 : s.orientation(site, ahead, across);
    const int new_side = way > 0 ? 1 : -1;
    turns += side < 0 && new_side > 0;
    reflex = reflex || side < 0;
    side = new_side;
    t = next;
    ++walked;
  } while (t >= 0 && t != start && walked < size);
  if (t < 0 && (reflex || way < 0))
    return "the boundary is not convex at " + name;
  if (walked < size || (t >= 0 && t != start))
    return "the triangles at " + name + " are not a single cycle or fan";
  if (t >= 0 && turns != 1)
    return "the triangles turn " + std::to_string(turns) + " times around " + name;
  return {};
}

// ---- The geometry

std::string orientation_failure(const Surface& s, std::int64_t t) {
  if (s.orientation(s.vertex(t, 0), s.vertex(t, 1), s.vertex(t, 2)) > 0)
    return {};
  return triangle_name(s, t) + " is not counter-clockwise";
}

std::string edge_failure(const Surface& s, std::int64_t t) {
  for (int i = 0; i < 3; ++i) {
    const std::int32_t other = s.neighbour(t, i);
    if (other < t) // none, or seen from there
      continue;
    const std::int32_t across = s.vertex(other, slot_of(s, other, s.vertex(t, i + 2)) + 2);
    if (s.in_circle(s.vertex(t, 0), s.vertex(t, 1), s.vertex(t, 2), across) >= 0)
      return edge_name(s, t, i) + " is not Delaunay: site " + std::to_string(across) +
             " is inside the circumcap";
  }
  return {};
}

std::string euler_failure(const Surface& s, std::int64_t boundary_edges) {
  const std::int64_t edges = (3 * s.triangles() + boundary_edges) / 2;
  const std::int64_t euler = s.sites() - edges + s.triangles();
  const std::int64_t expected = boundary_edges == 0 ? 2 : 1;
  if (euler == expected)
    return {};
  return "Euler's characteristic is " + std::to_string(euler) + " instead of " +
         std::to_string(expected);
}

struct Area {
  double value = 0, error = 0;
};

/// The area of a triangle known to be counter-clockwise, 2 atan2(det, s) with det = a . (b-a) x
/// (c-a) and s = 1 + a.b + b.c + c.a (Oosterom and Strackee, 1983), and a bound on its error.
///
/// The unit vectors' lengths are good to 5 roundoffs u (their directions are free: any move of the
/// sites leaves the sum of the areas as it is). So det errs by 15u and, in its evaluation, by (6
/// sqrt 3 + 2)u times |b-a| |c-a|; s by 60u for the lengths and 21u in its evaluation; the angle by
/// (|s| err(det) + det err(s)) / (det^2 + s^2).
Area triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = b - a, q = c - a;
  const double det = std::max(dot(a, cross(p, q)), 0.0);
  const double s = 1 + dot(a, b) + dot(b, c) + dot(c, a);
  const double det_error = 32 * detail::roundoff * std::sqrt(dot(p, p) * dot(q, q));
  const double s_error = 96 * detail::roundoff;
  const double angle_error = (std::abs(s) * det_error + det * s_error) / (det * det + s * s);
  return {2 * std::atan2(det, s), 2 * std::min(std::numbers::pi, angle_error)};
}

/// Blocks are summed apart, so that the rounding of the sums stays within (block size + blocks) u.
Area sum_areas(const Surface& s) {
  std::vector<Area> sums(static_cast<std::size_t>(detail::block_count(s.triangles())));
  detail::for_each_block(
      s.triangles(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        Area& sum = sums[static_cast<std::size_t>(block)];
        for (std::int64_t t = begin; t != end; ++t) {
          const Area area =
              triangle_area(s.unit[s.vertex(t, 0)], s.unit[s.vertex(t, 1)], s.unit[s.vertex(t, 2)]);
          sum.value += area.value;
          sum.error += area.error;
        }
        sum.error += static_cast<double>(end - begin) * detail::roundoff * sum.value;
      });
  Area total;
  for (const Area& sum : sums) {
    total.value += sum.value;
    total.error += sum.error;
  }
  total.error += static_cast<double>(sums.size()) * detail::roundoff * total.value;
  return total;
}

std::string area_failure(const Area& area) {
  const double missing = 4 * std::numbers::pi - area.value;
  if (std::abs(missing) <= 2 * area.error)
    return {};
  return "the areas sum to " + std::to_string(area.value) + " instead of 4 pi";
}

std::int64_t count_boundary_edges(const Triangles& neighbours) {
  return (neighbours.array() < 0).count();
}

Array<Vec3> unit_vectors(const Points3& points) {
  Array<Vec3> unit(points.cols());
  detail::for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      unit[i] = detail::normalised({points(0, i), points(1, i), points(2, i)});
  });
  return unit;
}

/// The laws in an order in which each may rely on those before it.
std::string first_broken_law(const Mesh& mesh, Check& result) {
  std::string failure = shape_failure(mesh);
  const auto holds = [&](std::int64_t n, const auto& law) {
    failure = first_failure(n, law);
    return failure.empty();
  };
  if (!failure.empty() ||
      !holds(mesh.points.cols(), [&](std::int64_t i) { return direction_failure(mesh, i); }))
    return failure;
  const Surface s{mesh, unit_vectors(mesh.points)};
  const std::int64_t triangles = s.triangles();
  if (!holds(triangles, [&](std::int64_t t) { return id_failure(s, t); }) ||
      !holds(triangles, [&](std::int64_t t) { return order_failure(s, t); }) ||
      !holds(triangles, [&](std::int64_t t) { return neighbour_failure(s, t); }) ||
      !holds(triangles, [&](std::int64_t t) { return orientation_failure(s, t); }))
    return failure;
  const Stars stars = make_stars(s);
  if (!holds(s.sites(),
             [&](std::int64_t i) { return star_failure(s, stars, static_cast<std::int32_t>(i)); }))
    return failure;
  if (failure = euler_failure(s, result.boundary_edges); !failure.empty())
    return failure;
  const Area area = sum_areas(s);
  result.area = area.value;
  if (!holds(triangles, [&](std::int64_t t) { return edge_failure(s, t); }))
    return failure;
  return result.boundary_edges == 0 ? area_failure(area) : std::string();
}

} // namespace

// Why local laws are enough. The triangles are counter-clockwise and turn around each inner site
// once, so the mesh covers the sphere without folds or branch points. Closed, it is a covering of
// the sphere, which is simply connected: each of its parts is one sheet, and Euler's characteristic
// 2 allows one part. Open, it bends at its boundary to the left alone: by Gauss and Bonnet each
// part has the characteristic 1, so there is one; and two places in it over one direction would be
// joined by a shortest path, which is not longer than pi and runs along a great circle: they are
// one place. Such a mesh with Delaunay edges is Delaunay.
Check check(const Mesh& mesh) {
  Check result;
  result.sites = mesh.points.cols();
  result.triangles = mesh.triangles.cols();
  result.boundary_edges = count_boundary_edges(mesh.neighbours);
  result.failure = first_broken_law(mesh, result);
  return result;
}

} // namespace calotte
