// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/kites.h"

#include "base/vector_loops.h"

#include <array>
#include <cmath>
#include <span>

namespace calotte::integrals_detail {
namespace {

/// As many nodes of a rule are integrated together.
constexpr std::size_t group = 3;

/// A value on the half kite of each edge's first end, then on that of the second.
using HalfRows = std::array<double, 2 * lanes>;

/// A group of nodes on both half kites of an edge: mirror images, at the same distance from the
/// centre.
struct alignas(64) NodeRows {
  std::array<Row, group> scale;  ///< 1 over the flat node's length
  std::array<Row, group> weight; ///< of the integral over the sphere
  std::array<Row, group> square; ///< of the distance to the end, on the sphere
};

/// Where the nodes lie on the sphere, and the density there.
struct alignas(64) PlacedNodes {
  std::array<std::array<HalfRows, group>, 3> x;
  std::array<HalfRows, group> rho;
};

/// The circumcentre of the flat triangle, and the plane's distance from the sphere's centre.
struct alignas(64) PlaneRows {
  Rows3 centre;
  Row distance;
};

CALOTTE_VECTOR_WIDTHS
void plane_rows(const TriangleRows& rows, PlaneRows& plane) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double scale = rows.scale[lane], distance = rows.height[lane] * scale;
    plane.distance[lane] = distance;
    put((distance * scale) * at(rows.normal, lane), plane.centre, lane);
  }
}

/// One edge of each triangle, with what lies across.
struct Edges {
  const Rows3 &first, &second; ///< its ends
  const Rows3& centre;         ///< of the flat triangle's circumcircle
  const Row& distance;         ///< of the triangle's plane from the sphere's centre
  const Row &quarter, &cotangent;
  const Row &rho_first, &rho_second, &rho_centre; ///< set for a density at sites
};

/// Edge ab with the half chord s, K = cot^2 of the angle across. The node p = (node.a a + node.b m
/// + node.c C) has |p|^2 = 1 - s^2 (1 - node.a^2) - s^2 K (1 - (1 - node.c)^2), by Pythagoras from
/// the circumcentre C, and |p - a|^2 = s^2 ((1 - node.a)^2 + node.c^2 K).
CALOTTE_VECTOR_WIDTHS
void node_rows(const QuadratureRule::Node& node, const Edges& edges, Row& scale, Row& weight,
               Row& square) {
  const double along = 1 - node.a * node.a, across = 1 - (1 - node.c) * (1 - node.c);
  const double along_a = (1 - node.a) * (1 - node.a), across_a = node.c * node.c;
  const double share = 0.5 * node.weight;
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double s = edges.quarter[lane], cot = edges.cotangent[lane], k = cot * cot;
    const double length = std::sqrt(1 - s * (along + across * k)), inverse = 1 / length;
    const double sunk = 1 - length;
    scale[lane] = inverse;
    weight[lane] = share * s * cot * edges.distance[lane] * (inverse * inverse * inverse);
    square[lane] = inverse * (s * (along_a + across_a * k) - sunk * sunk);
  }
}

/// Shares of an edge's ends and of the circumcentre in a node on the first half kite. On the second
/// the ends change places.
struct Shares {
  double near, far, centre;

  CALOTTE_INLINE std::array<Vec3, 2> places(const Vec3& a, const Vec3& b, const Vec3& c,
                                            double scale) const {
    const Vec3 middle = centre * c;
    return {scale * (near * a + far * b + middle), scale * (far * a + near * b + middle)};
  }
  CALOTTE_INLINE std::array<double, 2> densities(double a, double b, double c) const {
    const double middle = centre * c;
    return {near * a + far * b + middle, far * a + near * b + middle};
  }
};

Shares shares_of(const QuadratureRule::Node& node) {
  return {node.a + 0.5 * node.b, 0.5 * node.b, node.c};
}

/// Places a node of each edge on the sphere, on both half kites.
CALOTTE_VECTOR_WIDTHS
void place_node(const Shares& given, const Edges& edges, const Row& scale, HalfRows& x, HalfRows& y,
                HalfRows& z) {
  const Shares shares = given; // writing to x cannot change it
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto [p, q] = shares.places(at(edges.first, lane), at(edges.second, lane),
                                      at(edges.centre, lane), scale[lane]);
    x[lane] = p.x, y[lane] = p.y, z[lane] = p.z;
    x[lanes + lane] = q.x, y[lanes + lane] = q.y, z[lanes + lane] = q.z;
  }
}

/// The density at the circumcentre, linear on the triangle, between the least and the greatest of
/// the corners. The circumcentre is the sum of (1 - cot B cot C)/2 times corner A.
CALOTTE_VECTOR_WIDTHS
void centre_density(const Batch& batch, const TriangleRows& rows, Row& rho) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double a = batch.rho[0][lane], b = batch.rho[1][lane], c = batch.rho[2][lane];
    const double cot_a = rows.cotangent[0][lane], cot_b = rows.cotangent[1][lane],
                 cot_c = rows.cotangent[2][lane];
    const double sum =
        0.5 * ((1 - cot_b * cot_c) * a + (1 - cot_c * cot_a) * b + (1 - cot_a * cot_b) * c);
    const double ab_low = a < b ? a : b, ab_high = a < b ? b : a;
    const double low = ab_low < c ? ab_low : c, high = ab_high < c ? c : ab_high;
    const double above = sum < low ? low : sum;
    rho[lane] = above > high ? high : above;
  }
}

/// The terms of a vertex in one lane.
struct LaneTerms {
  Vec3 first;
  double energy, mass;

  CALOTTE_INLINE void add(double weight, double square, const Vec3& x) {
    mass += weight;
    energy += weight * square;
    first = first + weight * x;
  }
};

/// Without the mass, rows of masses are neither read nor set.
template <bool with_mass>
CALOTTE_INLINE LaneTerms terms_at(const VertexTerms& rows, std::size_t lane) {
  return {at(rows.first, lane), rows.energy[lane], with_mass ? rows.mass[lane] : 0};
}
template <bool with_mass>
CALOTTE_INLINE void set_terms(const LaneTerms& terms, VertexTerms& rows, std::size_t lane) {
  put(terms.first, rows.first, lane);
  rows.energy[lane] = terms.energy;
  if constexpr (with_mass)
    rows.mass[lane] = terms.mass;
}

/// Terms of the two ends of an edge. Those before are those after, or zero: not to set what is
/// added to next takes less time.
struct EndTerms {
  const VertexTerms &before_first, &before_second;
  VertexTerms &first, &second;
};

/// Adds the terms of placed nodes to both ends of an edge.
template <std::size_t count, bool with_mass>
CALOTTE_VECTOR_WIDTHS void add_placed(const NodeRows& nodes, const PlacedNodes& placed,
                                      const EndTerms& ends) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    LaneTerms a = terms_at<with_mass>(ends.before_first, lane),
              b = terms_at<with_mass>(ends.before_second, lane);
    for (std::size_t k = 0; k < count; ++k) {
      const double weight = nodes.weight[k][lane], square = nodes.square[k][lane];
      const auto place = [&](std::size_t i) {
        return Vec3{placed.x[0][k][i], placed.x[1][k][i], placed.x[2][k][i]};
      };
      a.add(weight * placed.rho[k][lane], square, place(lane));
      b.add(weight * placed.rho[k][lanes + lane], square, place(lanes + lane));
    }
    set_terms<with_mass>(a, ends.first, lane);
    set_terms<with_mass>(b, ends.second, lane);
  }
}

/// The same for a density that is linear on the triangle.
template <std::size_t count, bool with_mass>
CALOTTE_VECTOR_WIDTHS void add_linear(const NodeRows& nodes, const std::array<Shares, count>& given,
                                      const Edges& edges, const EndTerms& ends) {
  const std::array<Shares, count> shares = given; // writing to terms cannot change it
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    LaneTerms a = terms_at<with_mass>(ends.before_first, lane),
              b = terms_at<with_mass>(ends.before_second, lane);
    for (std::size_t k = 0; k < count; ++k) {
      const double weight = nodes.weight[k][lane], square = nodes.square[k][lane];
      const auto [x, mirrored] = shares[k].places(at(edges.first, lane), at(edges.second, lane),
                                                  at(edges.centre, lane), nodes.scale[k][lane]);
      const auto [rho, rho_mirrored] = shares[k].densities(
          edges.rho_first[lane], edges.rho_second[lane], edges.rho_centre[lane]);
      a.add(weight * rho, square, x);
      b.add(weight * rho_mirrored, square, mirrored);
    }
    set_terms<with_mass>(a, ends.first, lane);
    set_terms<with_mass>(b, ends.second, lane);
  }
}

/// Adds the terms of `count` nodes of a rule.
template <std::size_t count, bool with_mass>
void add_nodes(const QuadratureRule::Node* of_rule, const Integrand& integrand, const Edges& edges,
               const EndTerms& ends) {
  std::array<Shares, count> shares;
  NodeRows nodes;
  for (std::size_t k = 0; k < count; ++k) {
    shares[k] = shares_of(of_rule[k]);
    node_rows(of_rule[k], edges, nodes.scale[k], nodes.weight[k], nodes.square[k]);
  }
  if (integrand.at_sites) {
    add_linear<count, with_mass>(nodes, shares, edges, ends);
    return;
  }
  PlacedNodes placed;
  for (std::size_t k = 0; k < count; ++k)
    place_node(shares[k], edges, nodes.scale[k], placed.x[0][k], placed.x[1][k], placed.x[2][k]);
  const auto all = [](auto& of_nodes) { return std::span(of_nodes[0].data(), count * 2 * lanes); };
  integrand.density(all(placed.x[0]), all(placed.x[1]), all(placed.x[2]), all(placed.rho));
  add_placed<count, with_mass>(nodes, placed, ends);
}

template <bool with_mass>
void add_kites(const Batch& batch, const TriangleRows& rows, const Integrand& integrand,
               TriangleTerms& terms) {
  static constexpr VertexTerms zero{};
  PlaneRows plane;
  plane_rows(rows, plane);
  alignas(64) Row rho_centre;
  if (integrand.at_sites)
    centre_density(batch, rows, rho_centre);
  std::array<const VertexTerms*, 3> before{&zero, &zero, &zero};
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t a = (e + 1) % 3, b = (e + 2) % 3;
    const Edges edges{batch.corner[a], batch.corner[b], plane.centre,
                      plane.distance,  rows.quarter[e], rows.cotangent[e],
                      batch.rho[a],    batch.rho[b],    rho_centre};
    for (std::size_t node = 0; node < integrand.nodes.size();) {
      const QuadratureRule::Node* const of_rule = &integrand.nodes[node];
      const EndTerms ends{*before[a], *before[b], terms[a], terms[b]};
      const bool whole = node + group <= integrand.nodes.size();
      if (whole)
        add_nodes<group, with_mass>(of_rule, integrand, edges, ends);
      else
        add_nodes<1, with_mass>(of_rule, integrand, edges, ends);
      before[a] = &terms[a], before[b] = &terms[b];
      node += whole ? group : 1;
    }
  }
}

} // namespace

void kite_terms(const Batch& batch, const TriangleRows& rows, const Integrand& integrand,
                bool with_mass, TriangleTerms& terms) {
  if (with_mass)
    add_kites<true>(batch, rows, integrand, terms);
  else
    add_kites<false>(batch, rows, integrand, terms);
}

} // namespace calotte::integrals_detail
