// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/kites.h"

#include "base/vector_loops.h"
#include "integrals/half_edge.h"
#include "integrals/quads.h"
#include "integrals/slivers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace calotte::integrals_detail {
namespace {

/// What triangles add to the moments of one of their corners.
struct alignas(64) VertexTerms {
  Rows3 first;
  Row energy, mass;
};
using TriangleTerms = std::array<VertexTerms, 3>;

// ---- Uniform density

/// The contribution of each edge, named by the vertex across, to both of its ends.
struct alignas(64) EdgeRows {
  Rows3 pull, energy; ///< see EdgeTerms
  Rows3 area;
};

/// Pull and energy by their series. True where these hold for all lanes.
CALOTTE_VECTOR_WIDTHS
bool short_edges(const Rows3& quarter, const Rows3& cotangent, Rows3& pull, Rows3& energy) {
  std::int64_t beyond = 0;
  for (std::size_t e = 0; e < 3; ++e) {
    CALOTTE_VECTOR_LOOP
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const ShortEdge edge(quarter[e][lane], cotangent[e][lane]);
      const EdgeTerms terms = edge.terms();
      pull[e][lane] = terms.pull;
      energy[e][lane] = terms.energy;
      beyond |= edge.is_short() ? 0 : 1;
    }
  }
  return beyond == 0;
}

/// Replaces the results of short_edges() by the closed forms in lanes where the series are not
/// valid. The choice for a lane depends on that lane alone.
CALOTTE_VECTOR_WIDTHS
void long_edges(const Row& quarter, const Row& cotangent, Row& pull, Row& energy) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const EdgeTerms terms = edge_terms(half_edge(quarter[lane], cotangent[lane]));
    const bool series = ShortEdge(quarter[lane], cotangent[lane]).is_short();
    pull[lane] = series ? pull[lane] : terms.pull;
    energy[lane] = series ? energy[lane] : terms.energy;
  }
}

CALOTTE_VECTOR_WIDTHS
void half_areas(const Row& quarter, const Row& cotangent, Row& area) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    area[lane] = half_area(half_edge(quarter[lane], cotangent[lane]));
  }
}

/// Sums of edges at vertices: each is an end of the two edges that are named by the others.
CALOTTE_VECTOR_WIDTHS
void terms_of_edges(const Batch& batch, const EdgeRows& edges, TriangleTerms& terms) {
  for (std::size_t v = 0; v < 3; ++v) {
    const std::size_t n = (v + 1) % 3, p = (v + 2) % 3;
    CALOTTE_VECTOR_LOOP
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Vec3 to_next = at(batch.corner[v], lane) - at(batch.corner[n], lane),
                 to_previous = at(batch.corner[p], lane) - at(batch.corner[v], lane);
      put(edges.pull[p][lane] * to_next - edges.pull[n][lane] * to_previous, terms[v].first, lane);
      terms[v].energy[lane] = edges.energy[n][lane] + edges.energy[p][lane];
    }
  }
}

void set_edges(const Sliver& sliver, EdgeRows& edges) {
  for (std::size_t e = 0; e < 3; ++e) {
    edges.energy[e][sliver.lane] = half_energy(sliver.half[e]);
    edges.area[e][sliver.lane] = half_area(sliver.half[e]);
  }
}

void set_first(const Sliver& sliver, TriangleTerms& terms) {
  std::array<Vec3, 3> part;
  for (std::size_t e = 0; e < 3; ++e)
    part[e] = (0.5 * sliver.half[e].arc) * sliver.side[e];
  for (std::size_t v = 0; v < 3; ++v)
    put(part[(v + 2) % 3] - part[(v + 1) % 3], terms[v].first, sliver.lane);
}

/// \param slivers of the batch: their sides and halves take the place of the rows.
/// \param with_mass otherwise the masses are not set.
void uniform_terms(const SphericalTriangles&, const Batch& batch, const TriangleRows& rows,
                   const std::vector<Sliver>& slivers, bool with_mass, TriangleTerms& terms) {
  EdgeRows edges;
  const bool all_short = short_edges(rows.quarter, rows.cotangent, edges.pull, edges.energy);
  for (std::size_t e = 0; e < 3; ++e) {
    if (!all_short)
      long_edges(rows.quarter[e], rows.cotangent[e], edges.pull[e], edges.energy[e]);
    if (with_mass)
      half_areas(rows.quarter[e], rows.cotangent[e], edges.area[e]);
  }
  for (const Sliver& sliver : slivers)
    set_edges(sliver, edges);
  terms_of_edges(batch, edges, terms);
  for (const Sliver& sliver : slivers)
    set_first(sliver, terms);
  for (std::size_t v = 0; with_mass && v < 3; ++v)
    for (std::size_t lane = 0; lane < lanes; ++lane)
      terms[v].mass[lane] = edges.area[(v + 1) % 3][lane] + edges.area[(v + 2) % 3][lane];
}

/// The circumcentre of the flat triangle, and the plane's distance from the sphere's centre.
struct alignas(64) PlaneRows {
  Rows3 centre;
  Row distance;
};

/// Half a kite with the legs s and s cot: its area is s^2 cot/2, its first moment that times the
/// mean of its corners, and its energy that times s^2 (3 + cot^2)/6.
CALOTTE_VECTOR_WIDTHS
void flat_terms(const Batch& batch, const TriangleRows& rows, const PlaneRows& plane,
                TriangleTerms& terms) {
  for (VertexTerms& zero : terms)
    zero = {};
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t a = (e + 1) % 3, b = (e + 2) % 3;
    CALOTTE_VECTOR_LOOP
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double square = rows.quarter[e][lane], cot = rows.cotangent[e][lane];
      const double area = 0.5 * square * cot, energy = area / 6 * square * (3 + cot * cot);
      const Vec3 at_a = at(batch.corner[a], lane), at_b = at(batch.corner[b], lane);
      const Vec3 middle = 0.5 * (at_a + at_b), sum = middle + at(plane.centre, lane);
      const auto moment = [&](const Vec3& end) {
        return Vec3{area / 3 * (sum.x - 2 * end.x), area / 3 * (sum.y - 2 * end.y), area};
      };
      put(at(terms[a].first, lane) + moment(at_a), terms[a].first, lane);
      put(at(terms[b].first, lane) + moment(at_b), terms[b].first, lane);
      terms[a].energy[lane] += energy;
      terms[b].energy[lane] += energy;
    }
  }
}

// ---- Other densities

/// As many nodes of a rule are integrated together.
constexpr std::size_t group = 3;

/// A value on the half kite of each edge's first end, then on that of the second.
using HalfRows = std::array<double, 2 * lanes>;

/// A group of nodes on both half kites of an edge: mirror images, at the same distance from the
/// centre.
struct alignas(64) NodeRows {
  std::array<Row, group> weight;                ///< of the integral
  std::array<Row, group> square;                ///< of the distance to the end
  std::array<std::array<HalfRows, group>, 3> x; ///< in the plane from the first corner on
  std::array<HalfRows, group> rho;
};

/// One edge of each triangle, with what lies across.
struct Edge {
  const Rows3 &first, &second; ///< its ends
  const PlaneRows& plane;
  const Row &quarter, &cotangent;
  const Row &rho_first, &rho_second, &rho_centre; ///< set for a density at sites
};

/// Shares of an edge's ends and of the circumcentre in a node on the first half kite. On the second
/// the ends change places.
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

/// How a node counts.
struct Lifted {
  double scale;  ///< from the flat triangle to where the density is asked for
  double weight; ///< over that of the rule
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

CALOTTE_VECTOR_WIDTHS
void plane_rows(const SphericalTriangles&, const Batch&, const TriangleRows& rows,
                PlaneRows& plane) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double scale = rows.scale[lane], distance = rows.height[lane] * scale;
    plane.distance[lane] = distance;
    put((distance * scale) * at(rows.normal, lane), plane.centre, lane);
  }
}

/// From the middle of the first edge, at right angles to it.
CALOTTE_VECTOR_WIDTHS
void plane_rows(const FlatTriangles&, const Batch& batch, const TriangleRows& rows,
                PlaneRows& plane) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3 b = at(batch.corner[1], lane); // the first corner is 0
    const double cot = rows.cotangent[2][lane];
    plane.distance[lane] = 0;
    put({0.5 * (b.x - cot * b.y), 0.5 * (b.y + cot * b.x), 0}, plane.centre, lane);
  }
}

/// Sets the rows of a node of each edge, but for the density.
template <class Lift>
CALOTTE_VECTOR_WIDTHS void place_node(const Lift& given_lift, const Shares& given_shares,
                                      const Edge& edge, std::size_t k, NodeRows& nodes) {
  const Lift lift = given_lift; // writing to rows cannot change it
  const Shares shares = given_shares;
  HalfRows &x = nodes.x[0][k], &y = nodes.x[1][k], &z = nodes.x[2][k];
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Lifted lifted = lift(edge.quarter[lane], edge.cotangent[lane], edge.plane.distance[lane]);
    nodes.weight[k][lane] = lifted.weight;
    nodes.square[k][lane] = lifted.square;
    const auto [flat, mirrored] =
        shares(at(edge.first, lane), at(edge.second, lane), at(edge.plane.centre, lane));
    const Vec3 p = lifted.scale * flat, q = lifted.scale * mirrored;
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

/// A density that is linear on the triangle, at a node of each edge.
CALOTTE_VECTOR_WIDTHS
void linear_density(const Shares& given, const Edge& edge, HalfRows& rho) {
  const Shares shares = given; // writing to rho cannot change it
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto [first, second] =
        shares(edge.rho_first[lane], edge.rho_second[lane], edge.rho_centre[lane]);
    rho[lane] = first;
    rho[lanes + lane] = second;
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
                const Array<Vec3>& places, NodeRows& nodes) {
  std::array<std::array<HalfRows, group>, 3> x{};
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3& origin = places[batch.locals[std::min(lane, batch.count - 1)][0]];
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
    const auto add = [&](const Rows3& corner, std::size_t place, VertexTerms& terms) {
      const Vec3 end = at(corner, lane);
      Vec3 moment = at(terms.first, lane);
      double energy = terms.energy[lane], mass = terms.mass[lane];
      for (std::size_t k = 0; k < group; ++k) {
        const double weight = nodes.weight[k][lane] * nodes.rho[k][place];
        mass += weight;
        energy += weight * nodes.square[k][lane];
        moment = moment + weight * Lift::moment({nodes.x[0][k][place], nodes.x[1][k][place],
                                                 nodes.x[2][k][place]},
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

/// Terms for any density: the integral over half kites by the integrand's nodes.
template <class Surface>
void kite_terms(const Surface& surface, const Batch& batch, const TriangleRows& rows,
                const Integrand& integrand, const Array<Vec3>& x, TriangleTerms& terms) {
  PlaneRows plane;
  plane_rows(surface, batch, rows, plane);
  alignas(64) Row rho_centre;
  if (integrand.at_sites)
    centre_density(batch, rows, rho_centre);
  for (VertexTerms& zero : terms)
    zero = {};
  NodeRows nodes;
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t a = (e + 1) % 3, b = (e + 2) % 3;
    const Edge edge{batch.corner[a],   batch.corner[b], plane,        rows.quarter[e],
                    rows.cotangent[e], batch.rho[a],    batch.rho[b], rho_centre};
    for (std::size_t first = 0; first < integrand.nodes.size(); first += group) {
      for (std::size_t k = 0; k < group; ++k) {
        QuadratureRule::Node node =
            integrand.nodes[std::min(first + k, integrand.nodes.size() - 1)];
        if (first + k >= integrand.nodes.size())
          node.weight = 0;
        place_node(lift_of(surface, node), Shares(node), edge, k, nodes);
        if (integrand.at_sites)
          linear_density(Shares(node), edge, nodes.rho[k]);
      }
      if (!integrand.at_sites)
        density_at(surface, integrand, batch, x, nodes);
      add_nodes<decltype(lift_of(surface, integrand.nodes[0]))>(nodes, edge, terms[a], terms[b]);
    }
  }
}

void uniform_terms(const FlatTriangles& surface, const Batch& batch, const TriangleRows& rows,
                   const std::vector<Sliver>&, bool, TriangleTerms& terms) {
  PlaneRows plane;
  plane_rows(surface, batch, rows, plane);
  flat_terms(batch, rows, plane, terms);
}

// ---- Sums

/// Four lanes of the terms of each corner: x, y and z of the first moment, and the energy.
using CornerQuads = std::array<std::array<Quad, 4>, 3>;

/// Adds the terms of up to four triangles to their sites.
/// \param columns of each triangle, for each corner.
CALOTTE_INLINE void add_columns(const CornerQuads& columns, const Triple* locals, std::size_t count,
                                CellMoments* moments) {
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t v = 0; v < 3; ++v)
      quad_at(moments + locals[k][v]).value += columns[v][k];
}

/// Adds the terms of triangles to their sites, in the order of the triangles.
CALOTTE_VECTOR_WIDTHS
void scatter(const Batch& batch, const TriangleTerms& terms, CellMoments* moments) {
  static_assert(sizeof(Quad) == sizeof(CellMoments));
  for (std::size_t first = 0; first < batch.count; first += 4) {
    CornerQuads columns;
    for (std::size_t v = 0; v < 3; ++v) {
      auto& [x, y, z, energy] = columns[v];
      x = quad_at(terms[v].first[0].data() + first).value;
      y = quad_at(terms[v].first[1].data() + first).value;
      z = quad_at(terms[v].first[2].data() + first).value;
      energy = quad_at(terms[v].energy.data() + first).value;
      transpose(x, y, z, energy);
    }
    if (batch.count - first >= 4) // the loop has no conditions then
      add_columns(columns, batch.locals + first, 4, moments);
    else
      add_columns(columns, batch.locals + first, batch.count - first, moments);
  }
}

void scatter_mass(const Batch& batch, const TriangleTerms& terms, Array<double>& mass) {
  for (std::size_t lane = 0; lane < batch.count; ++lane)
    for (std::size_t v = 0; v < 3; ++v)
      mass[batch.locals[lane][v]] += terms[v].mass[lane];
}

/// Adds triangles that are not clear to the suspects.
void add_suspects(const Batch& batch, const TriangleRows& rows, std::size_t first,
                  std::vector<std::int32_t>& suspects) {
  for (std::size_t lane = 0; lane < batch.count; ++lane)
    if (!(rows.clearance[lane] > 0))
      suspects.push_back(static_cast<std::int32_t>(first + lane));
}

std::vector<Sliver> slivers_of(const SphericalTriangles&, const Batch& batch, TriangleRows& rows) {
  return resolve_slivers(batch, rows);
}
std::vector<Sliver> slivers_of(const FlatTriangles&, const Batch&, TriangleRows&) { return {}; }

/// Gives sites whose first moment is less than the rounding of its terms, as in a cluster, one of
/// that size along the site: the direction of the sum is arbitrary, or there is none.
void settle_vanishing(const std::vector<std::int32_t>& sites, const Array<Vec3>& x,
                      Array<CellMoments>& moments) {
  constexpr double rounding = 0x1p-50;
  for (const std::int32_t i : sites)
    if (norm(moments[i].first) < rounding)
      moments[i].first = rounding * x[i];
}

/// The density at the sites.
Array<double> densities(const Integrand& integrand, const Array<Vec3>& x) {
  Array<double> rho(x.size());
  integrand.density(x.begin(), x.size(), rho.begin());
  return rho;
}

template <class Surface>
void sum_batches(const Surface& surface, const Integrand& integrand,
                 std::span<const Triple> triangles, const Array<Vec3>& x, const CellSums& sums,
                 std::vector<std::int32_t>& suspects) {
  std::fill(sums.moments.begin(), sums.moments.end(), CellMoments{{0, 0, 0}, 0});
  if (sums.mass != nullptr)
    std::fill(sums.mass->begin(), sums.mass->end(), 0.0);
  const Array<double> rho = integrand.at_sites ? densities(integrand, x) : Array<double>();
  TriangleRows rows;
  TriangleTerms terms;
  std::vector<std::int32_t> of_slivers;
  for (std::size_t first = 0; first < triangles.size(); first += lanes) {
    Batch batch = gather(surface, triangles, x, first);
    std::vector<Sliver> slivers;
    if (!triangle_rows(surface, batch, rows)) {
      add_suspects(batch, rows, first, suspects);
      slivers = slivers_of(surface, batch, rows);
    }
    for (const Sliver& sliver : slivers)
      of_slivers.insert(of_slivers.end(), batch.locals[sliver.lane].begin(),
                        batch.locals[sliver.lane].end());
    if (integrand.at_sites)
      gather_density(rho, batch);
    if (integrand.uniform)
      uniform_terms(surface, batch, rows, slivers, sums.mass != nullptr, terms);
    else
      kite_terms(surface, batch, rows, integrand, x, terms);
    scatter(batch, terms, sums.moments.begin());
    if (sums.mass != nullptr)
      scatter_mass(batch, terms, *sums.mass);
  }
  if (integrand.uniform)
    settle_vanishing(of_slivers, x, sums.moments);
}

template <class Surface>
void find(const Surface& surface, std::span<const Triple> triangles, const Array<Vec3>& x,
          std::vector<std::int32_t>& suspects) {
  TriangleRows rows;
  for (std::size_t first = 0; first < triangles.size(); first += lanes) {
    const Batch batch = gather(surface, triangles, x, first);
    if (!triangle_rows(surface, batch, rows))
      add_suspects(batch, rows, first, suspects);
  }
}

} // namespace

void sum_kites(const SphericalTriangles& sphere, const Integrand& integrand,
               std::span<const Triple> triangles, const Array<Vec3>& x, const CellSums& sums,
               std::vector<std::int32_t>& suspects) {
  sum_batches(sphere, integrand, triangles, x, sums, suspects);
}

void sum_kites(const FlatTriangles& plane, const Integrand& integrand,
               std::span<const Triple> triangles, const Array<Vec3>& x, const CellSums& sums,
               std::vector<std::int32_t>& suspects) {
  sum_batches(plane, integrand, triangles, x, sums, suspects);
}

void find_suspects(const SphericalTriangles& sphere, std::span<const Triple> triangles,
                   const Array<Vec3>& x, std::vector<std::int32_t>& suspects) {
  find(sphere, triangles, x, suspects);
}

void find_suspects(const FlatTriangles& plane, std::span<const Triple> triangles,
                   const Array<Vec3>& x, std::vector<std::int32_t>& suspects) {
  find(plane, triangles, x, suspects);
}

} // namespace calotte::integrals_detail
