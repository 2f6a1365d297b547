// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/density_kites.h"

#include "base/vector_loops.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

namespace calotte::integrals_detail {
namespace {

/// The number of nodes that are integrated together, an orbit of a rule.
constexpr std::size_t group = 3;

/// Values on the half kites at the edges' first ends, then at their second ends.
using HalfRows = std::array<double, 2 * lanes>;

/// A group of nodes on both half kites of an edge: mirror images, at the same distance from the
/// centre.
struct alignas(64) NodeRows {
  std::array<Row, group> weight;                ///< of the integral
  std::array<Row, group> square;                ///< of the distance to the end
  std::array<std::array<HalfRows, group>, 3> x; ///< in the plane from the first corner on
  std::array<HalfRows, group> rho;
};

/// One edge of each triangle of a batch, with the data across from it.
struct Edge {
  const Rows3 &first, &second; ///< its ends
  const CentreRows& centres;
  const Row &quarter, &cotangent;
};

/// The weights of an edge's ends and of the circumcentre in a node on the first half kite. On the
/// second half kite the ends are swapped.
struct Shares {
  double near, far, centre;

  explicit Shares(const QuadratureRule::Node& node)
      : near(node.a + 0.5 * node.b), far(0.5 * node.b), centre(node.c) {}

  template <class Value>
  CALOTTE_INLINE std::array<Value, 2> operator()(const Value& a, const Value& b,
                                                 const Value& c) const {
    const Value middle = centre * c;
    return {near * a + far * b + middle, far * a + near * b + middle};
  }
};

/// A node p = (node.a a + node.b m + node.c C) on the half kite of an edge ab with the half chord
/// s, K = cot^2 of the angle across, has |p - a|^2 = s^2 ((1 - node.a)^2 + node.c^2 K).
struct NodeSquare {
  double along, across;

  explicit NodeSquare(const QuadratureRule::Node& node)
      : along((1 - node.a) * (1 - node.a)), across(node.c * node.c) {}
  CALOTTE_INLINE double operator()(double s, double k) const { return s * (along + across * k); }
};

/// The position and weight of a lifted node.
struct Lifted {
  double scale;  ///< from the flat triangle to the point where the density is evaluated
  double weight; ///< relative to that of the rule
  double square; ///< of the distance to the end
};

/// Lifts nodes of the flat triangle to the sphere. By Pythagoras from the circumcentre C, |p|^2 = 1
/// - s^2 (1 - node.a^2) - s^2 K (1 - (1 - node.c)^2).
class ChordLift {
public:
  explicit ChordLift(const QuadratureRule::Node& node)
      : along_(1 - node.a * node.a), across_(1 - (1 - node.c) * (1 - node.c)),
        share_(0.5 * node.weight), from_end_(node) {}

  CALOTTE_INLINE Lifted operator()(double s, double cot, double distance) const {
    const double k = cot * cot;
    const double length = std::sqrt(1 - s * (along_ + across_ * k)), inverse = 1 / length;
    const double sunk = 1 - length;
    return {inverse, share_ * s * cot * distance * (inverse * inverse * inverse),
            inverse * (from_end_(s, k) - sunk * sunk)};
  }
  CALOTTE_INLINE static Vec3 moment(const Vec3& p, const Vec3&) { return p; }

private:
  double along_, across_, share_;
  NodeSquare from_end_;
};

/// Leaves nodes in the plane.
class NoLift {
public:
  explicit NoLift(const QuadratureRule::Node& node) : share_(0.5 * node.weight), from_end_(node) {}

  CALOTTE_INLINE Lifted operator()(double s, double cot, double) const {
    return {1, share_ * s * cot, from_end_(s, cot * cot)};
  }
  CALOTTE_INLINE static Vec3 moment(const Vec3& p, const Vec3& end) {
    return {p.x - end.x, p.y - end.y, 1};
  }

private:
  double share_;
  NodeSquare from_end_;
};

ChordLift lift_of(const SphericalTriangles&, const QuadratureRule::Node& node) {
  return ChordLift(node);
}
NoLift lift_of(const FlatTriangles&, const QuadratureRule::Node& node) { return NoLift(node); }

/// Sets the rows of a node of each edge, except the density.
template <class Lift>
CALOTTE_VECTOR_WIDTHS void set_node(const Lift& given_lift, const Shares& given_shares,
                                    const Edge& edge, std::size_t k, NodeRows& nodes) {
  const Lift lift = given_lift; // writing to rows cannot change it
  const Shares shares = given_shares;
  HalfRows &x = nodes.x[0][k], &y = nodes.x[1][k], &z = nodes.x[2][k];
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Lifted lifted =
        lift(edge.quarter[lane], edge.cotangent[lane], edge.centres.distance[lane]);
    nodes.weight[k][lane] = lifted.weight;
    nodes.square[k][lane] = lifted.square;
    const auto [flat, mirrored] =
        shares(at(edge.first, lane), at(edge.second, lane), at(edge.centres.centre, lane));
    const Vec3 p = lifted.scale * flat, q = lifted.scale * mirrored;
    x[lane] = p.x, y[lane] = p.y, z[lane] = p.z;
    x[lanes + lane] = q.x, y[lanes + lane] = q.y, z[lanes + lane] = q.z;
  }
}

using NodeSpan = std::span<double, group * 2 * lanes>;
NodeSpan all(std::array<HalfRows, group>& rows) {
  return NodeSpan(rows[0].data(), NodeSpan::extent);
}

void density_at(const SphericalTriangles&, const Integrand& integrand, const Batch&,
                const Array<Vec3>&, NodeRows& nodes) {
  integrand.density(all(nodes.x[0]), all(nodes.x[1]), all(nodes.x[2]), all(nodes.rho));
}

void density_at(const FlatTriangles&, const Integrand& integrand, const Batch& batch,
                const Array<Vec3>& positions, NodeRows& nodes) {
  std::array<std::array<HalfRows, group>, 3> x{};
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3& origin = positions[batch.locals[std::min(lane, batch.count - 1)][0]];
    for (std::size_t k = 0; k < group; ++k)
      for (const std::size_t i : {lane, lanes + lane}) {
        x[0][k][i] = origin.x + nodes.x[0][k][i];
        x[1][k][i] = origin.y + nodes.x[1][k][i];
      }
  }
  integrand.density(all(x[0]), all(x[1]), all(x[2]), all(nodes.rho));
}

/// Adds the terms of nodes to both ends of an edge.
template <class Lift>
CALOTTE_VECTOR_WIDTHS void add_nodes(const NodeRows& nodes, const Edge& edge, VertexTerms& first,
                                     VertexTerms& second) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto add = [&](const Rows3& corner, std::size_t index, VertexTerms& terms) {
      const Vec3 end = at(corner, lane);
      Vec3 moment = at(terms.first, lane);
      double energy = terms.energy[lane], mass = terms.mass[lane];
      for (std::size_t k = 0; k < group; ++k) {
        const double weight = nodes.weight[k][lane] * nodes.rho[k][index];
        mass += weight;
        energy += weight * nodes.square[k][lane];
        moment = moment + weight * Lift::moment({nodes.x[0][k][index], nodes.x[1][k][index],
                                                 nodes.x[2][k][index]},
                                                end);
      }
      put(moment, terms.first, lane);
      terms.energy[lane] = energy;
      terms.mass[lane] = mass;
    };
    add(edge.first, lane, first);
    add(edge.second, lanes + lane, second);
  }
}

} // namespace

template <class Triangles>
void density_terms(const Triangles& space, const Batch& batch, const TriangleRows& rows,
                   const Integrand& integrand, const Array<Vec3>& x, TriangleTerms& terms) {
  assert(integrand.nodes.size() % group == 0);
  const CentreRows centres = centre_rows(space, batch, rows);
  for (VertexTerms& zero : terms)
    zero = {};
  NodeRows nodes;
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t a = (e + 1) % 3, b = (e + 2) % 3;
    const Edge edge{batch.corner[a], batch.corner[b], centres, rows.quarter[e], rows.cotangent[e]};
    for (std::size_t first = 0; first < integrand.nodes.size(); first += group) {
      for (std::size_t k = 0; k < group; ++k) {
        const QuadratureRule::Node& node = integrand.nodes[first + k];
        set_node(lift_of(space, node), Shares(node), edge, k, nodes);
      }
      density_at(space, integrand, batch, x, nodes);
      add_nodes<decltype(lift_of(space, integrand.nodes[0]))>(nodes, edge, terms[a], terms[b]);
    }
  }
}

template void density_terms(const SphericalTriangles&, const Batch&, const TriangleRows&,
                            const Integrand&, const Array<Vec3>&, TriangleTerms&);
template void density_terms(const FlatTriangles&, const Batch&, const TriangleRows&,
                            const Integrand&, const Array<Vec3>&, TriangleTerms&);

} // namespace calotte::integrals_detail
