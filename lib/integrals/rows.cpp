// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/rows.h"

#include "base/elementary.h"
#include "base/triangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte::integrals_detail {

namespace {

/// Gathers four corners at a time. A column of x is read with the double that follows it.
/// \param triangle the triangle of a lane.
template <class Triangle>
CALOTTE_INLINE void gather_by(const Triangle& triangle, const Vec3* x,
                              std::array<Rows3, 3>& corner) {
  for (std::size_t lane = 0; lane < lanes; lane += 4)
    for (std::size_t v = 0; v < 3; ++v) {
      const auto at = [&](std::size_t k) { return x + triangle(lane + k)[v]; };
      Quad unused;
      put_columns({at(0), at(1), at(2), at(3)}, lane, corner[v], unused);
    }
}

CALOTTE_VECTOR_WIDTHS
void gather_corners(const std::array<std::int32_t, 3>* locals, std::size_t count, const Vec3* x,
                    std::array<Rows3, 3>& corner) {
  if (count == lanes)
    gather_by([&](std::size_t lane) { return locals[lane]; }, x, corner);
  else
    gather_by([&](std::size_t lane) { return locals[std::min(lane, count - 1)]; }, x, corner);
}

} // namespace

Batch gather(const Patch& patch, const Array<Vec3>& x, std::size_t first) {
  Batch batch;
  batch.count = std::min(lanes, patch.corners.size() - first);
  batch.locals = patch.corners.data() + first;
  gather_corners(batch.locals, batch.count, x.begin(), batch.corner);
  return batch;
}

void gather_density(const Array<double>& rho, Batch& batch) {
  for (std::size_t lane = 0; lane < lanes; ++lane)
    for (std::size_t v = 0; v < 3; ++v)
      batch.rho[v][lane] = rho[batch.locals[std::min(lane, batch.count - 1)][v]];
}

namespace {

// The product of a corner's two sides is positive if its angle is acute. It errs by some 8
// roundoffs of itself, and stored vectors differ from unit ones by 5: 1e-14 exceeds both, for sides
// of any length. The same bound holds for the normal's product.
CALOTTE_VECTOR_WIDTHS
bool compute_triangle_rows(const Batch& batch, TriangleRows& out) {
  constexpr double margin = 1e-14, apart_scale = margin / antipodal;
  std::int64_t unclear = 0;
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3 a = at(batch.corner[0], lane), b = at(batch.corner[1], lane),
               c = at(batch.corner[2], lane);
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const Vec3 normal = cross(ab, bc);
    const double scale = 1 / std::sqrt(dot(normal, normal));
    const double at_a = -dot(ca, ab), at_b = -dot(ab, bc), at_c = -dot(bc, ca);
    out.quarter[0][lane] = 0.25 * dot(bc, bc);
    out.quarter[1][lane] = 0.25 * dot(ca, ca);
    out.quarter[2][lane] = 0.25 * dot(ab, ab);
    out.cotangent[0][lane] = at_a * scale;
    out.cotangent[1][lane] = at_b * scale;
    out.cotangent[2][lane] = at_c * scale;
    put(normal, out.normal, lane);
    out.scale[lane] = scale;
    const double height = dot(normal, a);
    out.height[lane] = height;
    const double ab_least = at_a < at_b ? at_a : at_b, c_least = at_c < height ? at_c : height;
    const double least = ab_least < c_least ? ab_least : c_least;
    const double long_a = out.quarter[0][lane], long_b = out.quarter[1][lane],
                 long_c = out.quarter[2][lane];
    const double long_ab = long_a > long_b ? long_a : long_b;
    const double apart = apart_scale * (1 - (long_ab > long_c ? long_ab : long_c));
    const double clearance = (least < apart ? least : apart) - margin;
    out.clearance[lane] = clearance;
    unclear |= clearance > 0 ? 0 : 1;
  }
  return unclear == 0;
}

} // namespace

// A function with versions for several vector widths would be exported, whatever its visibility.
bool triangle_rows(const Batch& batch, TriangleRows& out) {
  return compute_triangle_rows(batch, out);
}

namespace {

/// The contribution of each edge, named by the vertex across, to both of its ends.
struct alignas(64) EdgeRows {
  Rows3 pull; ///< delta / (2 |a-b|): the first moment's part is that times (a - b) for a
  Rows3 energy, area;
};

// With s = |a-b|/2 the sine of half of the edge's arc, S = s^2, u = s cot(C)/sqrt(1-S) the sine of
// delta and w = u^2, all terms are series in S and w: below this bound, the first omitted term is
// 2^-53 of the leading one.
constexpr double small = 0x1p-13;

CALOTTE_INLINE double inverse_root_series(double z) { // (1 - z)^(-1/2)
  return (1 + z * (1.0 / 2)) + z * z * (3.0 / 8 + z * (5.0 / 16));
}

CALOTTE_INLINE double arc_sine_series(double z) { // asin(sqrt(z))/sqrt(z)
  return (1 + z * (1.0 / 6)) + z * z * (3.0 / 40 + z * (5.0 / 112));
}

/// (4 atan(p q) - delta s)/(s u), p and q the tangents of half of both arcs: the energy of half a
/// kite over s u. Its terms without S or w cancel.
CALOTTE_INLINE double energy_series(double s, double w) {
  const double w2 = w * w, s2 = s * s;
  const double w1 = (1.0 / 12 + w * (1.0 / 20)) + w2 * (15.0 / 448 + w * (7.0 / 288));
  const double s_1 = (1.0 / 4 + w * (1.0 / 24)) + w2 * (1.0 / 64 + w * (1.0 / 128));
  const double s_2 = (1.0 / 8 + w * (1.0 / 64)) + w2 * (3.0 / 640);
  const double s_3 = (5.0 / 64 + w * (1.0 / 128)) + s * (7.0 / 128);
  return (w * w1 + s * s_1) + s2 * (s_2 + s * s_3);
}

/// Pull and energy by their series. True where these hold for all lanes.
CALOTTE_VECTOR_WIDTHS
bool small_edges(const Rows3& quarter, const Rows3& cotangent, Rows3& pull, Rows3& energy) {
  std::int64_t beyond = 0;
  for (std::size_t e = 0; e < 3; ++e) {
    CALOTTE_VECTOR_LOOP
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double s = quarter[e][lane], tilt = cotangent[e][lane] * inverse_root_series(s);
      const double w = s * tilt * tilt;
      pull[e][lane] = 0.25 * tilt * arc_sine_series(w);
      energy[e][lane] = s * tilt * energy_series(s, w);
      const double larger = s > w ? s : w;
      beyond |= larger <= small ? 0 : 1;
    }
  }
  return beyond == 0;
}

CALOTTE_INLINE HalfEdge half_edge(double quarter, double cotangent) {
  const double sine = std::sqrt(quarter), cosine = std::sqrt(1 - quarter);
  // Rounding can pass 1 where the circumcap is a hemisphere.
  const double raw = sine / cosine * cotangent, low = raw < -1 ? -1 : raw;
  const double sine_of_arc = low > 1 ? 1 : low;
  return {sine, cosine, arc_sine(sine_of_arc),
          sine_of_arc / (1 + std::sqrt(1 - sine_of_arc * sine_of_arc))};
}

CALOTTE_INLINE double half_area(const HalfEdge& half) {
  return 2 * arc_tangent(half.sine / (1 + half.cosine) * half.tangent);
}

/// atan(sqrt(z))/sqrt(z) - 1 for 0 <= z <= 1/16, by its series.
CALOTTE_INLINE double arc_tangent_excess(double z) {
  return -z *
         (1.0 / 3 -
          z * (1.0 / 5 -
               z * (1.0 / 7 -
                    z * (1.0 / 9 -
                         z * (1.0 / 11 -
                              z * (1.0 / 13 -
                                   z * (1.0 / 15 -
                                        z * (1.0 / 17 -
                                             z * (1.0 / 19 -
                                                  z * (1.0 / 21 -
                                                       z * (1.0 / 23 - z * (1.0 / 25))))))))))));
}

/// Energy of half a kite: with c = 1/(1 + p^2), s = 2 p c. Where the arc is small, the series of
/// atan(p q) and atan(q) are subtracted term by term.
CALOTTE_INLINE double half_energy(const HalfEdge& half) {
  const double p = half.sine / (1 + half.cosine);
  const double q = half.tangent;
  const double c = 1 / (1 + p * p);
  const bool low = q * q < 1.0 / 16;
  const double z = low ? q * q : 0;
  const double by_series =
      p * q * (p * p * c + arc_tangent_excess(z * p * p) - c * arc_tangent_excess(z));
  const double direct = arc_tangent(p * q) - 0.5 * half.arc * p * c;
  return 4 * (low ? by_series : direct);
}

/// Replaces the results of small_edges() by the closed forms in lanes where the series are not
/// valid. The choice for a lane depends on that lane alone.
CALOTTE_VECTOR_WIDTHS
void large_edges(const Row& quarter, const Row& cotangent, Row& pull, Row& energy) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double s = quarter[lane], tilt = cotangent[lane] * inverse_root_series(s);
    const HalfEdge half = half_edge(s, cotangent[lane]);
    const double direct = 0.25 * half.arc / half.sine, direct_energy = half_energy(half);
    const double w = s * tilt * tilt, larger = s > w ? s : w;
    const bool beyond = !(larger <= small);
    pull[lane] = beyond ? direct : pull[lane];
    energy[lane] = beyond ? direct_energy : energy[lane];
  }
}

CALOTTE_VECTOR_WIDTHS
void half_areas(const Row& quarter, const Row& cotangent, Row& area) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    area[lane] = half_area(half_edge(quarter[lane], cotangent[lane]));
  }
}

/// A vertex is an end of the two edges that are named by the others.
CALOTTE_VECTOR_WIDTHS
void terms_of_edges(const Batch& batch, const EdgeRows& edges, VertexTerms& terms) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3 a = at(batch.corner[0], lane), b = at(batch.corner[1], lane),
               c = at(batch.corner[2], lane);
    const Vec3 of_a = edges.pull[0][lane] * (b - c), of_b = edges.pull[1][lane] * (c - a),
               of_c = edges.pull[2][lane] * (a - b);
    put(of_c - of_b, terms.first[0], lane);
    put(of_a - of_c, terms.first[1], lane);
    put(of_b - of_a, terms.first[2], lane);
    const double ea = edges.energy[0][lane], eb = edges.energy[1][lane], ec = edges.energy[2][lane];
    terms.energy[0][lane] = eb + ec;
    terms.energy[1][lane] = ec + ea;
    terms.energy[2][lane] = ea + eb;
  }
}

void set_edges(const Sliver& sliver, EdgeRows& edges) {
  for (std::size_t e = 0; e < 3; ++e) {
    edges.energy[e][sliver.lane] = half_energy(sliver.half[e]);
    edges.area[e][sliver.lane] = half_area(sliver.half[e]);
  }
}

void set_first(const Sliver& sliver, VertexTerms& terms) {
  std::array<Vec3, 3> part;
  for (std::size_t e = 0; e < 3; ++e)
    part[e] = (0.5 * sliver.half[e].arc) * sliver.side[e];
  for (std::size_t v = 0; v < 3; ++v)
    put(part[(v + 2) % 3] - part[(v + 1) % 3], terms.first[v], sliver.lane);
}

} // namespace

void uniform_terms(const Batch& batch, const TriangleRows& rows, const std::vector<Sliver>& slivers,
                   bool with_mass, VertexTerms& terms) {
  EdgeRows edges;
  const bool all_small = small_edges(rows.quarter, rows.cotangent, edges.pull, edges.energy);
  for (std::size_t e = 0; e < 3; ++e) {
    if (!all_small)
      large_edges(rows.quarter[e], rows.cotangent[e], edges.pull[e], edges.energy[e]);
    if (with_mass)
      half_areas(rows.quarter[e], rows.cotangent[e], edges.area[e]);
  }
  for (const Sliver& sliver : slivers)
    set_edges(sliver, edges);
  terms_of_edges(batch, edges, terms);
  for (const Sliver& sliver : slivers)
    set_first(sliver, terms);
  if (!with_mass)
    return;
  for (std::size_t v = 0; v < 3; ++v)
    for (std::size_t lane = 0; lane < lanes; ++lane)
      terms.mass[v][lane] = edges.area[(v + 1) % 3][lane] + edges.area[(v + 2) % 3][lane];
}

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

/// Edge ab with the half chord s, K = cot^2 of the angle across. The node p = (node.a a + node.b m
/// + node.c C) has |p|^2 = 1 - s^2 (1 - node.a^2) - s^2 K (1 - (1 - node.c)^2), by Pythagoras from
/// the circumcentre C, and |p - a|^2 = s^2 ((1 - node.a)^2 + node.c^2 K).
CALOTTE_VECTOR_WIDTHS
void node_rows(const QuadratureRule::Node& node, const Row& distance, const Row& quarter,
               const Row& cotangent, Row& scale, Row& weight, Row& square) {
  const double along = 1 - node.a * node.a, across = 1 - (1 - node.c) * (1 - node.c);
  const double along_a = (1 - node.a) * (1 - node.a), across_a = node.c * node.c;
  const double share = 0.5 * node.weight;
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double s = quarter[lane], cot = cotangent[lane], k = cot * cot;
    const double length = std::sqrt(1 - s * (along + across * k)), inverse = 1 / length;
    const double sunk = 1 - length;
    scale[lane] = inverse;
    weight[lane] = share * s * cot * distance[lane] * (inverse * inverse * inverse);
    square[lane] = inverse * (s * (along_a + across_a * k) - sunk * sunk);
  }
}

/// Shares of an edge's ends and of the circumcentre in a node on the first half kite. On the second
/// the ends change places.
struct Shares {
  double near, far, centre;

  explicit Shares(const QuadratureRule::Node& node)
      : near(node.a + 0.5 * node.b), far(0.5 * node.b), centre(node.c) {}

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

/// Places a node of each edge on the sphere, on both half kites.
CALOTTE_VECTOR_WIDTHS
void place_node(const Shares& given, const Rows3& first, const Rows3& second, const Rows3& centre,
                const Row& scale, HalfRows& x, HalfRows& y, HalfRows& z) {
  const Shares shares = given; // writing to x cannot change it
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto [p, q] =
        shares.places(at(first, lane), at(second, lane), at(centre, lane), scale[lane]);
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

/// The terms of one end of an edge.
struct EndRows {
  Rows3& first;
  Row &energy, &mass;
};

/// The terms of a vertex in one lane.
struct EndTerms {
  Vec3 first;
  double energy, mass;

  CALOTTE_INLINE void add(double weight, double square, const Vec3& x) {
    mass += weight;
    energy += weight * square;
    first = first + weight * x;
  }
};

CALOTTE_INLINE EndTerms terms_at(const EndRows& rows, std::size_t lane) {
  return {at(rows.first, lane), rows.energy[lane], rows.mass[lane]};
}
CALOTTE_INLINE void store(const EndTerms& terms, const EndRows& rows, std::size_t lane) {
  put(terms.first, rows.first, lane);
  rows.energy[lane] = terms.energy;
  rows.mass[lane] = terms.mass;
}

/// Adds the terms of `count` placed nodes to both ends of an edge.
template <std::size_t count>
CALOTTE_VECTOR_WIDTHS void add_placed(const NodeRows& nodes, const PlacedNodes& placed,
                                      const EndRows& first, const EndRows& second) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    EndTerms a = terms_at(first, lane), b = terms_at(second, lane);
    for (std::size_t k = 0; k < count; ++k) {
      const double weight = nodes.weight[k][lane], square = nodes.square[k][lane];
      const auto place = [&](std::size_t i) {
        return Vec3{placed.x[0][k][i], placed.x[1][k][i], placed.x[2][k][i]};
      };
      a.add(weight * placed.rho[k][lane], square, place(lane));
      b.add(weight * placed.rho[k][lanes + lane], square, place(lanes + lane));
    }
    store(a, first, lane);
    store(b, second, lane);
  }
}

/// The same for a density that is linear on the triangle.
template <std::size_t count>
CALOTTE_VECTOR_WIDTHS void
add_linear(const NodeRows& nodes, const Shares* given, const Rows3& corner_a, const Rows3& corner_b,
           const Rows3& centre, const Row& rho_a, const Row& rho_b, const Row& rho_centre,
           const EndRows& first, const EndRows& second) {
  const auto shares = [&]<std::size_t... k>(std::index_sequence<k...>) {
    return std::array<Shares, count>{given[k]...};
  }
  (std::make_index_sequence<count>());
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    EndTerms a = terms_at(first, lane), b = terms_at(second, lane);
    for (std::size_t k = 0; k < count; ++k) {
      const double weight = nodes.weight[k][lane], square = nodes.square[k][lane];
      const auto [x, mirrored] = shares[k].places(at(corner_a, lane), at(corner_b, lane),
                                                  at(centre, lane), nodes.scale[k][lane]);
      const auto [rho, rho_mirrored] =
          shares[k].densities(rho_a[lane], rho_b[lane], rho_centre[lane]);
      a.add(weight * rho, square, x);
      b.add(weight * rho_mirrored, square, mirrored);
    }
    store(a, first, lane);
    store(b, second, lane);
  }
}

/// Adds the terms of a group of nodes of one edge, of which there are `count`.
template <std::size_t count>
void add_group(const Batch& batch, const TriangleRows& rows, const PlaneRows& plane,
               const Row& rho_centre, std::size_t edge, const Integrand& integrand,
               const QuadratureRule::Node* of_rule, VertexTerms& terms) {
  const std::size_t a = (edge + 1) % 3, b = (edge + 2) % 3;
  const EndRows first{terms.first[a], terms.energy[a], terms.mass[a]},
      second{terms.first[b], terms.energy[b], terms.mass[b]};
  const auto shares = [&]<std::size_t... k>(std::index_sequence<k...>) {
    return std::array<Shares, count>{Shares(of_rule[k])...};
  }
  (std::make_index_sequence<count>());
  NodeRows nodes;
  for (std::size_t k = 0; k < count; ++k)
    node_rows(of_rule[k], plane.distance, rows.quarter[edge], rows.cotangent[edge], nodes.scale[k],
              nodes.weight[k], nodes.square[k]);
  if (integrand.at_sites) {
    add_linear<count>(nodes, shares.data(), batch.corner[a], batch.corner[b], plane.centre,
                      batch.rho[a], batch.rho[b], rho_centre, first, second);
    return;
  }
  PlacedNodes placed;
  for (std::size_t k = 0; k < count; ++k) {
    place_node(shares[k], batch.corner[a], batch.corner[b], plane.centre, nodes.scale[k],
               placed.x[0][k], placed.x[1][k], placed.x[2][k]);
#ifdef EACH
    integrand.density(placed.x[0][k], placed.x[1][k], placed.x[2][k], placed.rho[k]);
  }
#else
  }
  const auto all = [](auto& of_nodes) { return std::span(of_nodes[0].data(), count * 2 * lanes); };
  integrand.density(all(placed.x[0]), all(placed.x[1]), all(placed.x[2]), all(placed.rho));
#endif
  add_placed<count>(nodes, placed, first, second);
}

} // namespace

void kite_terms(const Batch& batch, const TriangleRows& rows, const Integrand& integrand,
                VertexTerms& terms) {
  terms = {};
  PlaneRows plane;
  plane_rows(rows, plane);
  alignas(64) Row rho_centre;
  if (integrand.at_sites)
    centre_density(batch, rows, rho_centre);
  for (std::size_t e = 0; e < 3; ++e) {
    std::size_t node = 0;
    for (; node + group <= integrand.nodes.size(); node += group)
      add_group<group>(batch, rows, plane, rho_centre, e, integrand, &integrand.nodes[node], terms);
    for (; node < integrand.nodes.size(); ++node)
      add_group<1>(batch, rows, plane, rho_centre, e, integrand, &integrand.nodes[node], terms);
  }
}

} // namespace calotte::integrals_detail
