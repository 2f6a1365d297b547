// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/generators.h>

#include "base/points.h"
#include "base/require.h"
#include "generators/net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace calotte {
namespace {

using base_detail::require;
using base_detail::require_count;
using base_detail::set_column;
using base_detail::Vec3;
using namespace generators_detail;

/// A direction from the corners of a spherical triangle. The polynomial is fitted to uniform CVTs
/// of 12 defects.
/// \param u, v, w its barycentric coordinates in the plane of the lattice; their sum is 1.
Vec3 point_at(const Vec3& a, const Vec3& b, const Vec3& c, double u, double v, double w) {
  const auto weight = [](double t) { return t * (1 + t * (0.21 * t - 0.36)); };
  const Vec3 p = weight(u) * a + weight(v) * b + weight(w) * c;
  const double length = norm(p);
  return {p.x / length, p.y / length, p.z / length};
}

std::int64_t ceiling(std::int64_t a, std::int64_t b) { return a / b + (a % b > 0 ? 1 : 0); }

/// A range of integers x.
struct Row {
  std::int64_t from = std::numeric_limits<std::int64_t>::min(), to = -(from + 1);
  bool empty = false;

  /// Restricts the range to x with slope x + constant > 0.
  void bound(std::int64_t slope, std::int64_t constant) {
    if (slope > 0)
      from = std::max(from, ceiling(1 - constant, slope));
    else if (slope < 0)
      to = std::min(to, -ceiling(1 - constant, -slope));
    else
      empty = empty || constant <= 0;
  }
};

/// Calls visit(u, v) for the lattice's points inside a face: u and v are their coordinates at the
/// corners to which p and q lead, in units of 1/triangles_between(p, q).
template <class Visit> void for_each_inside(const Step& p, const Step& q, const Visit& visit) {
  const std::int64_t area = triangles_between(p, q);
  const auto [least, most] = std::minmax({std::int64_t{0}, p.y, q.y});
  for (std::int64_t y = least; y <= most; ++y) {
    Row row;
    row.bound(q.y, -y * q.x);                     // u > 0
    row.bound(-p.y, y * p.x);                     // v > 0
    row.bound(p.y - q.y, area + y * (q.x - p.x)); // u + v < area
    for (std::int64_t x = row.from; !row.empty && x <= row.to; ++x)
      visit(triangles_between({x, y}, q), triangles_between(p, {x, y}));
  }
}

Points3 make_points(const Net& net) {
  const std::array<Vec3, icosahedron_vertices> corners = icosahedron_points();
  const auto corner = [&](std::int32_t vertex) {
    return corners[static_cast<std::size_t>(vertex)];
  };
  const EdgeMesh solid = icosahedron();
  Points3 points(3, triangles(net) / 2 + 2);
  std::int64_t next = 0;
  for (const Vec3& at : corners)
    set_column(points, next++, at);
  for (std::size_t e = 0; e < net.size(); ++e) {
    const auto [a, b] = solid.edges[e];
    const std::int64_t parts = std::gcd(net[e].x, net[e].y);
    for (std::int64_t k = 1; k < parts; ++k) {
      const double u = static_cast<double>(k) / static_cast<double>(parts);
      set_column(points, next++, point_at(corner(a), corner(b), Vec3{}, 1 - u, u, 0));
    }
  }
  for (std::size_t face = 0; face < solid.triangles.size(); ++face) {
    const auto [p, q] = sides(net, face);
    const auto& [a, b, c] = solid.triangles[face];
    const std::int64_t area = triangles_between(p, q);
    const auto whole = static_cast<double>(area);
    for_each_inside(p, q, [&, a = a, b = b, c = c](std::int64_t u, std::int64_t v) {
      set_column(points, next++,
                 point_at(corner(a), corner(b), corner(c),
                          static_cast<double>(area - u - v) / whole, static_cast<double>(u) / whole,
                          static_cast<double>(v) / whole));
    });
  }
  return points;
}

/// Whether a bisected icosahedron has 10 `square` + 2 points.
bool is_power_of_four(std::int64_t square) {
  while (square % 4 == 0)
    square /= 4;
  return square == 1;
}

} // namespace

Points3 geodesic_sphere(std::int64_t b, std::int64_t c) {
  const std::int64_t most = 1 << 15; // whose square does not overflow
  require(b >= 0 && c >= 0 && b < most && c < most && b + c > 0 && count_of({b, c}) <= most_points,
          "the vector is ({}, {}); give two numbers from 0, not both 0, with at most {} points, "
          "10 (b^2 + b c + c^2) + 2",
          b, c, most_points);
  return make_points(regular({b, c}));
}

Points3 geodesic_sphere(std::int64_t n) {
  require_count(n, 12, "the number of points");
  require(n != 13, "no triangulation of 13 points has 12 with five neighbours and one with six; "
                   "give another number of points");
  return make_points(find_net(n));
}

std::int64_t geodesic_count(double points) {
  constexpr double fewest = 12, tolerance = 0.005;
  require(points >= fewest && points <= static_cast<double>(most_points),
          "the number of points is {}; give 12 to {}", points, most_points);
  std::int64_t best = 0;
  const double most = std::sqrt(points / 10) + 1;
  for (std::int64_t c = 0; static_cast<double>(c) <= most; ++c) {
    const double rest = (points - 2) / 10 - 0.75 * static_cast<double>(c * c);
    const auto floor =
        static_cast<std::int64_t>((rest > 0 ? std::sqrt(rest) : 0) - static_cast<double>(c) / 2);
    for (std::int64_t b = std::max(floor - 1, c); b <= std::max(floor, c) + 2; ++b) {
      const std::int64_t count = count_of({b, c});
      if (count > most_points || b == 0)
        continue;
      const double difference = std::abs(static_cast<double>(count) - points),
                   least = std::abs(static_cast<double>(best) - points);
      if (is_power_of_four(square({b, c})) && difference < tolerance * points)
        return count;
      if (best == 0 || difference < least || (difference == least && count > best))
        best = count;
    }
  }
  return std::abs(static_cast<double>(best) - points) < tolerance * points ? best
                                                                           : std::llround(points);
}

} // namespace calotte
