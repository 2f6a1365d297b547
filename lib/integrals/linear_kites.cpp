// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/linear_kites.h"

#include "base/vector_loops.h"

#include <array>
#include <cstddef>

namespace calotte::integrals_detail {
namespace {

/// The barycentric coordinates of the circumcentre, (1 - cot B cot C)/2 for corner A, and the
/// density there.
struct alignas(64) CentreShares {
  Rows3 corner;
  Row rho;
};

/// The coefficients of the corners in the first moment of each vertex.
using MomentRows = std::array<Rows3, 3>; ///< [vertex][corner]

CALOTTE_VECTOR_WIDTHS
void centre_shares(const Batch& batch, const TriangleRows& rows, CentreShares& out) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double a = batch.rho[0][lane], b = batch.rho[1][lane], c = batch.rho[2][lane];
    const double cot_a = rows.cotangent[0][lane], cot_b = rows.cotangent[1][lane],
                 cot_c = rows.cotangent[2][lane];
    const double of_a = 0.5 * (1 - cot_b * cot_c), of_b = 0.5 * (1 - cot_c * cot_a),
                 of_c = 0.5 * (1 - cot_a * cot_b);
    const double sum = of_a * a + of_b * b + of_c * c;
    const double ab_low = a < b ? a : b, ab_high = a < b ? b : a;
    const double low = ab_low < c ? ab_low : c, high = ab_high < c ? c : ab_high;
    const double above = sum < low ? low : sum;
    out.corner[0][lane] = of_a, out.corner[1][lane] = of_b, out.corner[2][lane] = of_c;
    out.rho[lane] = above > high ? high : above;
  }
}

/// Integrals over the half kite with the corners a, the middle m of an edge ab, and the
/// circumcentre C: |a - m|^2 = square, |C - m|^2 = K square. The integral of three barycentric
/// coordinates is 2 area i! j! k!/(i + j + k + 2)!.
struct HalfKite {
  double mass, energy, of_a, of_middle, of_centre;

  CALOTTE_INLINE HalfKite(double square, double cot, double a, double m, double c) {
    const double area = 0.5 * square * cot, sum = a + m + c, part = area / 12;
    mass = area / 3 * sum;
    energy = area * square * (0.1 * (a + 2 * (m + c)) + cot * cot / 30 * (a + m + 3 * c));
    of_a = part * (sum + a);
    of_middle = part * (sum + m);
    of_centre = part * (sum + c);
  }
};

/// Adds the half kites of the edge across from vertex e.
CALOTTE_VECTOR_WIDTHS
void add_edge(const Batch& batch, const TriangleRows& rows, const CentreShares& centre,
              std::size_t e, MomentRows& moments, TriangleTerms& terms) {
  const std::size_t a = (e + 1) % 3, b = (e + 2) % 3;
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double square = rows.quarter[e][lane], cot = rows.cotangent[e][lane];
    const double rho_a = batch.rho[a][lane], rho_b = batch.rho[b][lane], rho_c = centre.rho[lane],
                 rho_m = 0.5 * (rho_a + rho_b);
    const double of_a = centre.corner[a][lane], of_b = centre.corner[b][lane],
                 of_e = centre.corner[e][lane];
    const auto add = [&](std::size_t near, std::size_t far, const HalfKite& half, double of_near,
                         double of_far) {
      moments[near][near][lane] += half.of_a + 0.5 * half.of_middle + half.of_centre * of_near;
      moments[near][far][lane] += 0.5 * half.of_middle + half.of_centre * of_far;
      moments[near][e][lane] += half.of_centre * of_e;
      terms[near].energy[lane] += half.energy;
      terms[near].mass[lane] += half.mass;
    };
    add(a, b, HalfKite(square, cot, rho_a, rho_m, rho_c), of_a, of_b);
    add(b, a, HalfKite(square, cot, rho_b, rho_m, rho_c), of_b, of_a);
  }
}

CALOTTE_VECTOR_WIDTHS
void set_first(const SphericalTriangles&, const Batch& batch, const MomentRows& moments,
               TriangleTerms& terms) {
  for (std::size_t v = 0; v < 3; ++v) {
    CALOTTE_VECTOR_LOOP
    for (std::size_t lane = 0; lane < lanes; ++lane)
      put(moments[v][0][lane] * at(batch.corner[0], lane) +
              moments[v][1][lane] * at(batch.corner[1], lane) +
              moments[v][2][lane] * at(batch.corner[2], lane),
          terms[v].first, lane);
  }
}

/// The first moments in the plane, relative to the vertex, with the mass.
CALOTTE_VECTOR_WIDTHS
void set_first(const FlatTriangles&, const Batch& batch, const MomentRows& moments,
               TriangleTerms& terms) {
  for (std::size_t v = 0; v < 3; ++v) {
    const std::size_t n = (v + 1) % 3, p = (v + 2) % 3;
    CALOTTE_VECTOR_LOOP
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Vec3 from = at(batch.corner[v], lane);
      const Vec3 first = moments[v][n][lane] * (at(batch.corner[n], lane) - from) +
                         moments[v][p][lane] * (at(batch.corner[p], lane) - from);
      put({first.x, first.y, terms[v].mass[lane]}, terms[v].first, lane);
    }
  }
}

} // namespace

template <class Triangles>
void linear_terms(const Triangles& space, const Batch& batch, const TriangleRows& rows,
                  TriangleTerms& terms) {
  CentreShares centre;
  centre_shares(batch, rows, centre);
  MomentRows moments{};
  for (VertexTerms& zero : terms)
    zero = {};
  for (std::size_t e = 0; e < 3; ++e)
    add_edge(batch, rows, centre, e, moments, terms);
  set_first(space, batch, moments, terms);
}

template void linear_terms(const SphericalTriangles&, const Batch&, const TriangleRows&,
                           TriangleTerms&);
template void linear_terms(const FlatTriangles&, const Batch&, const TriangleRows&, TriangleTerms&);

} // namespace calotte::integrals_detail
