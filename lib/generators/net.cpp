// SPDX-License-Identifier: GPL-3.0-or-later
#include "generators/net.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

// The nets form a lattice in 20 dimensions. Only the number of points is prescribed. All decisions
// are made in integers.

namespace calotte::generators_detail {
namespace {

const EdgeMesh& solid() {
  static const EdgeMesh mesh = icosahedron();
  return mesh;
}

std::size_t edge(std::size_t face, std::size_t index) {
  return static_cast<std::size_t>(solid().triangle_edges[face][index % 3]);
}

Step operator+(const Step& p, const Step& q) { return {p.x + q.x, p.y + q.y}; }

Net operator+(Net net, const Net& other) {
  for (std::size_t e = 0; e < net.size(); ++e)
    net[e] = net[e] + other[e];
  return net;
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

/// The edge after a given one, counter-clockwise around a vertex.
std::size_t next_spoke(std::int32_t vertex, std::size_t spoke) {
  for (std::size_t face = 0; face < solid().triangles.size(); ++face)
    for (std::size_t i = 0; i < 3; ++i)
      if (solid().triangles[face][i] == vertex && edge(face, i + 2) == spoke)
        return edge(face, i + 1);
  return spoke;
}

/// The move of the two ends of an edge in opposite directions; no other vertex moves.
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

/// An edge of a face.
struct Side {
  std::size_t face, index;

  std::size_t edge() const { return generators_detail::edge(face, index); }
};

/// The same edge in the other face.
Side across(const Side& side) {
  for (std::size_t face = 0; face < solid().triangles.size(); ++face)
    for (std::size_t index = 0; index < 3; ++index)
      if (const Side other{face, index}; face != side.face && other.edge() == side.edge())
        return other;
  return side;
}

/// The move that adds a row of cells along a Petrie polygon, the zigzag of ten edges around an axis
/// through two vertices.
/// \param side where the zigzag begins.
Net move_of_zigzag(Side side) {
  Net net{};
  for (int sixths = 0; net[side.edge()] == Step(); sixths = 1 - sixths) {
    net[side.edge()] = turned({1, 0}, sixths);
    side = across({side.face, side.index + (sixths == 0 ? 1 : 2)});
  }
  return net;
}

/// All moves, and their terms that a search sums.
struct Moves {
  std::vector<Net> nets;
  std::vector<std::size_t> first; ///< of an edge and of a polygon: others are rotations
  /// The number of triangles, and the mixed terms with regular nets.
  std::vector<std::int64_t> triangles, with_1, with_w;
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
    for (std::size_t index = 0; index < 3; ++index)
      moves.add(move_of_zigzag({face, index}));
  for (std::size_t sixths = 0; sixths < 6; ++sixths)
    for (const std::size_t begin : {std::size_t{0}, polygons})
      moves.first.push_back(begin + sixths);
  for (const Net& net : moves.nets) {
    moves.triangles.push_back(triangles(net));
    moves.with_1.push_back(generators_detail::mixed(net, regular({1, 0})));
    moves.with_w.push_back(generators_detail::mixed(net, regular({0, 1})));
    std::vector<std::int64_t>& row = moves.mixed.emplace_back();
    for (const Net& other : moves.nets)
      row.push_back(generators_detail::mixed(net, other));
  }
  return moves;
}

// ---- The net of a number of points

/// Vectors with a length within `reach` of that of a regular net of n points, up to turns by a
/// sixth. Those whose number of points is nearest to n come first.
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
        near.emplace_back(std::abs(count_of({x, y}) - n), y, x);
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
    const std::int64_t its_spread = generators_detail::spread(other);
    if (its_spread < spread && turns_no_face_over(other)) {
      spread = its_spread;
      net = other;
    }
  }
};

/// Searches for nets with the wanted number of triangles that are up to three moves away from a
/// regular net.
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

} // namespace

Net regular(const Step& step) {
  Net net;
  net.fill(step);
  return net;
}

std::pair<Step, Step> sides(const Net& net, std::size_t face) {
  return {net[edge(face, 2)], turned(net[edge(face, 1)], 1)};
}

std::int64_t triangles(const Net& net) { return mixed(net, net) / 2; }

Net find_net(std::int64_t n) {
  constexpr std::int64_t good =
      18 * icosahedron_edges;     // hardly any n has only nets of a larger spread
  constexpr double nearest = 0.5; // steps of the lattice
  Best best;
  for (double reach = nearest; !best.net; reach *= 2) {
    const std::vector<Step> steps = steps_near(n, reach);
    if (!steps.empty() && count_of(steps.front()) == n)
      return regular(steps.front());
    static const Moves moves = make_moves();
    for (const Step& step : steps)
      if (best.spread > good)
        search_around(step, 2 * n - 4, moves, best);
  }
  return *best.net;
}

} // namespace calotte::generators_detail
