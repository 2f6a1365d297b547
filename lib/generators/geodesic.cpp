// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/generators.h>

#include "base/points.h"
#include "base/require.h"
#include "generators/icosahedron.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

// A triangulation with 12 points of five neighbours and all others of six is an icosahedron whose
// faces are triangles of one triangular lattice (Thurston, Shapes of polyhedra and triangulations
// of the sphere, 1998). The 30 edges give it: each is a vector of the lattice, and the three of a
// face close. If all are the same vector (b, c), the points have the symmetry of the icosahedron,
// and there are 10 (b^2 + b c + c^2) + 2 (Caspar and Klug, 1962). For other numbers of points the
// vectors differ by one or two steps of the lattice, hardly more for many points than for few: the
// solutions are a lattice in 20 dimensions, and only their number of points is prescribed.
//
// Everything is decided in integers. The places use only + - * / and sqrt.

namespace calotte {
namespace {

using base_detail::require;
using base_detail::require_count;
using base_detail::set_column;
using base_detail::Vec3;
using namespace generators_detail;

// ---- The lattice

/// The vector x + y w of the triangular lattice, w = exp(i pi/3): an Eisenstein integer.
struct Step {
  std::int64_t x = 0, y = 0;

  bool operator==(const Step&) const = default;
};

Step operator+(const Step& p, const Step& q) { return {p.x + q.x, p.y + q.y}; }

/// p w^sixths.
Step turned(Step p, int sixths) {
  for (; sixths > 0; --sixths)
    p = {-p.y, p.x + p.y};
  return p;
}

/// The square of its length, b^2 + b c + c^2.
std::int64_t square(const Step& p) { return p.x * p.x + p.x * p.y + p.y * p.y; }

/// The area between two vectors, in triangles of the lattice; > 0 if q is to the left of p.
std::int64_t triangles_between(const Step& p, const Step& q) { return p.x * q.y - p.y * q.x; }

// ---- Nets

/// The vector along each edge of the icosahedron, turned so that all are equal for a regular one:
/// the vectors z of a face's edges in counter-clockwise order make z_0 + w^2 z_1 + w^4 z_2 = 0. A
/// sum of nets is a net.
using Net = std::array<Step, icosahedron_edges>;

const EdgeMesh& solid() {
  static const EdgeMesh mesh = icosahedron();
  return mesh;
}

std::size_t edge(std::size_t face, std::size_t place) {
  return static_cast<std::size_t>(solid().triangle_edges[face][place % 3]);
}

Net operator+(Net net, const Net& other) {
  for (std::size_t e = 0; e < net.size(); ++e)
    net[e] = net[e] + other[e];
  return net;
}

Net regular(const Step& step) {
  Net net;
  net.fill(step);
  return net;
}

/// A face's edges from its first corner, to the second and to the third.
std::pair<Step, Step> sides(const Net& net, std::size_t face) {
  return {net[edge(face, 2)], turned(net[edge(face, 1)], 1)};
}

/// triangles(p + q) = triangles(p) + mixed(p, q) + triangles(q).
std::int64_t mixed(const Net& p, const Net& q) {
  std::int64_t sum = 0;
  for (std::size_t face = 0; face < solid().triangles.size(); ++face) {
    const auto [a, b] = sides(p, face);
    const auto [c, d] = sides(q, face);
    sum += triangles_between(a, d) + triangles_between(c, b);
  }
  return sum;
}

/// The triangles of the triangulation: 2n - 4.
std::int64_t triangles(const Net& net) { return mixed(net, net) / 2; }

/// 30 times the sum of the squared differences of the edges from their mean.
std::int64_t spread(const Net& net) {
  Step sum;
  std::int64_t squares = 0;
  for (const Step& step : net) {
    sum = sum + step;
    squares += square(step);
  }
  return static_cast<std::int64_t>(net.size()) * squares - square(sum);
}

bool turns_no_face_over(const Net& net) {
  for (std::size_t face = 0; face < solid().triangles.size(); ++face)
    if (const auto [a, b] = sides(net, face); triangles_between(a, b) <= 0)
      return false;
  return true;
}

// ---- Moves: short nets that generate all others

/// The edge after another one, counter-clockwise around a vertex.
std::size_t next_spoke(std::int32_t vertex, std::size_t spoke) {
  for (std::size_t face = 0; face < solid().triangles.size(); ++face)
    for (std::size_t i = 0; i < 3; ++i)
      if (solid().triangles[face][i] == vertex && edge(face, i + 2) == spoke)
        return edge(face, i + 1);
  return spoke;
}

/// The ends of an edge move against each other, and no other vertex moves.
Net move_of_edge(std::size_t e) {
  Net net{};
  net[e] = {1, 1};
  for (const std::int32_t end : solid().edges[e]) {
    std::size_t spoke = e;
    for (int sixths = 5; sixths > 1; --sixths) {
      spoke = next_spoke(end, spoke);
      net[spoke] = turned({1, 0}, sixths);
    }
  }
  return net;
}

/// A row of cells more along a Petrie polygon, the zigzag of ten edges around an axis through two
/// vertices.
/// \param face, place where it begins.
Net move_of_zigzag(std::size_t face, std::size_t place) {
  Net net{};
  int sixths = 0;
  std::size_t e = edge(face, place);
  while (net[e] == Step()) {
    net[e] = turned({1, 0}, sixths);
    const std::size_t next = edge(face, place + (sixths == 0 ? 1 : 2));
    for (std::size_t other = 0; other < solid().triangles.size(); ++other)
      for (std::size_t i = 0; i < 3; ++i)
        if (other != face && edge(other, i) == next) {
          face = other;
          place = i;
          other = solid().triangles.size() - 1;
          break;
        }
    e = next;
    sixths = 1 - sixths;
  }
  return net;
}

/// All moves, and what a search adds up.
struct Moves {
  std::vector<Net> nets;
  std::vector<std::size_t> first; ///< one edge's and one polygon's: the others are rotations
  std::vector<std::int64_t> triangles, with_1, with_w; ///< the latter mixed with regular nets
  std::vector<std::vector<std::int64_t>> mixed;

  void add(const Net& net) {
    if (std::find(nets.begin(), nets.end(), net) == nets.end())
      for (int sixths = 0; sixths < 6; ++sixths) {
        nets.push_back(net);
        for (Step& step : nets.back())
          step = turned(step, sixths);
      }
  }
};

Moves make_moves() {
  Moves moves;
  for (std::size_t e = 0; e < icosahedron_edges; ++e)
    moves.add(move_of_edge(e));
  const std::size_t polygons = moves.nets.size();
  for (std::size_t face = 0; face < solid().triangles.size(); ++face)
    for (std::size_t place = 0; place < 3; ++place)
      moves.add(move_of_zigzag(face, place));
  for (std::size_t sixths = 0; sixths < 6; ++sixths)
    for (const std::size_t begin : {std::size_t{0}, polygons})
      moves.first.push_back(begin + sixths);
  for (const Net& net : moves.nets) {
    moves.triangles.push_back(triangles(net));
    moves.with_1.push_back(calotte::mixed(net, regular({1, 0})));
    moves.with_w.push_back(calotte::mixed(net, regular({0, 1})));
    std::vector<std::int64_t>& row = moves.mixed.emplace_back();
    for (const Net& other : moves.nets)
      row.push_back(calotte::mixed(net, other));
  }
  return moves;
}

// ---- The net of a number of points

std::int64_t count_of(std::int64_t square) { return 10 * square + 2; }

/// The vectors with a length within `reach` of that of a regular net, but for turns by a sixth; the
/// ones whose number of points is nearest to n first.
std::vector<Step> steps_near(std::int64_t n, double reach) {
  const double length = std::sqrt(static_cast<double>(n - 2) / 10);
  const double most = length + reach, least = std::max(length - reach, 0.0);
  std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t>> near;
  for (std::int64_t y = 0; static_cast<double>(y) <= 2 * most; ++y) {
    const auto ordinate = static_cast<double>(y);
    const double rest = least * least - 0.75 * ordinate * ordinate;
    const double from = rest > 0 ? std::sqrt(rest) - ordinate / 2 : 0;
    auto x = std::max<std::int64_t>(static_cast<std::int64_t>(from), 1);
    for (; static_cast<double>(square({x, y})) <= most * most; ++x)
      if (static_cast<double>(square({x, y})) >= least * least)
        near.emplace_back(std::abs(count_of(square({x, y})) - n), y, x);
  }
  std::sort(near.begin(), near.end());
  std::vector<Step> steps;
  steps.reserve(near.size());
  for (const auto& [difference, y, x] : near)
    steps.push_back({x, y});
  return steps;
}

/// The net of least spread among those that the search has found.
struct Best {
  std::int64_t spread = std::numeric_limits<std::int64_t>::max();
  std::optional<Net> net;

  void offer(const Net& other) {
    const std::int64_t its_spread = calotte::spread(other);
    if (its_spread < spread && turns_no_face_over(other)) {
      spread = its_spread;
      net = other;
    }
  }
};

/// Offers the nets of so many triangles that up to three moves away from a regular one make.
void search_around(const Step& step, std::int64_t wanted, const Moves& moves, Best& best) {
  const Net start = regular(step);
  const std::size_t count = moves.nets.size();
  std::vector<std::int64_t> alone(count), second(count);
  for (std::size_t i = 0; i < count; ++i)
    alone[i] = step.x * moves.with_1[i] + step.y * moves.with_w[i] + moves.triangles[i];
  for (const std::size_t f : moves.first) {
    const std::int64_t missing = wanted - triangles(start) - alone[f];
    if (missing == 0)
      best.offer(start + moves.nets[f]);
    for (std::size_t i = 0; i < count; ++i)
      second[i] = alone[i] + moves.mixed[f][i];
    for (std::size_t i = 0; i < count; ++i) {
      if (missing == second[i])
        best.offer(start + moves.nets[f] + moves.nets[i]);
      for (std::size_t j = i; j < count; ++j)
        if (missing - second[i] == second[j] + moves.mixed[i][j])
          best.offer(start + moves.nets[f] + moves.nets[i] + moves.nets[j]);
    }
  }
}

/// \pre n >= 12, but not 13.
Net net_of(std::int64_t n) {
  constexpr std::int64_t good = 18 * icosahedron_edges; // few numbers have a smaller spread
  constexpr double nearest = 0.5;                       // steps: a move is as long
  Best best;
  for (double reach = nearest; !best.net; reach *= 2) {
    const std::vector<Step> steps = steps_near(n, reach);
    if (!steps.empty() && count_of(square(steps.front())) == n)
      return regular(steps.front());
    static const Moves moves = make_moves();
    for (const Step& step : steps)
      if (best.spread > good)
        search_around(step, 2 * n - 4, moves, best);
  }
  return *best.net;
}

// ---- The points of a net

/// A direction from the corners of a spherical triangle. The polynomial is fitted to uniform CVTs
/// of 12 defects.
/// \param u, v, w its barycentric coordinates in the plane of the lattice; their sum is 1.
Vec3 place_at(const Vec3& a, const Vec3& b, const Vec3& c, double u, double v, double w) {
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

  /// Those with slope x + constant > 0.
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

Points3 points_of(const Net& net) {
  const std::array<Vec3, icosahedron_vertices> corners = icosahedron_points();
  const auto corner = [&](std::int32_t vertex) {
    return corners[static_cast<std::size_t>(vertex)];
  };
  Points3 points(3, triangles(net) / 2 + 2);
  std::int64_t next = 0;
  for (const Vec3& at : corners)
    set_column(points, next++, at);
  for (std::size_t e = 0; e < net.size(); ++e) {
    const auto [a, b] = solid().edges[e];
    const std::int64_t parts = std::gcd(net[e].x, net[e].y);
    for (std::int64_t k = 1; k < parts; ++k) {
      const double u = static_cast<double>(k) / static_cast<double>(parts);
      set_column(points, next++, place_at(corner(a), corner(b), Vec3{}, 1 - u, u, 0));
    }
  }
  for (std::size_t face = 0; face < solid().triangles.size(); ++face) {
    const auto [p, q] = sides(net, face);
    const auto& [a, b, c] = solid().triangles[face];
    const std::int64_t area = triangles_between(p, q);
    const auto whole = static_cast<double>(area);
    for_each_inside(p, q, [&, a = a, b = b, c = c](std::int64_t u, std::int64_t v) {
      set_column(points, next++,
                 place_at(corner(a), corner(b), corner(c),
                          static_cast<double>(area - u - v) / whole, static_cast<double>(u) / whole,
                          static_cast<double>(v) / whole));
    });
  }
  return points;
}

bool is_power_of_four(std::int64_t square) {
  while (square % 4 == 0)
    square /= 4;
  return square == 1;
}

} // namespace

Points3 geodesic_sphere(std::int64_t b, std::int64_t c) {
  const std::int64_t most = 1 << 15; // whose square does not overflow
  require(b >= 0 && c >= 0 && b + c > 0 && b < most && c < most &&
              count_of(square({b, c})) <= most_points,
          "the vector is (" + std::to_string(b) + ", " + std::to_string(c) +
              "); give two numbers from 0, not both 0, with at most " +
              std::to_string(most_points) + " points, 10 (b^2 + b c + c^2) + 2");
  return points_of(regular({b, c}));
}

Points3 geodesic_sphere(std::int64_t n) {
  require_count(n, 12, "the number of points");
  require(n != 13, "no triangulation of 13 points has 12 with five neighbours and one with six; "
                   "give another number of points");
  return points_of(net_of(n));
}

std::int64_t geodesic_count(double points) {
  constexpr double fewest = 12, tolerance = 0.005;
  require(points >= fewest && points <= static_cast<double>(most_points),
          "the number of points is " + std::to_string(points) + "; give 12 to " +
              std::to_string(most_points));
  std::int64_t best = 0;
  const double most = std::sqrt(points / 10) + 1;
  for (std::int64_t c = 0; static_cast<double>(c) <= most; ++c) {
    const double rest = (points - 2) / 10 - 0.75 * static_cast<double>(c * c);
    const auto floor =
        static_cast<std::int64_t>((rest > 0 ? std::sqrt(rest) : 0) - static_cast<double>(c) / 2);
    for (std::int64_t b = std::max(floor - 1, c); b <= std::max(floor, c) + 2; ++b) {
      const std::int64_t count = count_of(square({b, c}));
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
