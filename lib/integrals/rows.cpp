// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/rows.h"

#include "base/elementary.h"
#include "base/triangle.h"

#include <algorithm>
#include <cmath>

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

/// The product of a corner's two sides is positive if its angle is acute. It errs by some 8
/// roundoffs of itself, and stored vectors differ from unit ones by 5: the margin exceeds both, for
/// sides of any length. The same bound holds for the normal's product.
constexpr double margin = 1e-14;

/// \tparam of_edges sets the rows of edges alone, and takes all edges for short.
template <bool of_edges>
CALOTTE_VECTOR_WIDTHS bool compute_triangle_rows(const Batch& batch, TriangleRows& out) {
  constexpr double apart_scale = margin / antipodal;
  std::int64_t unclear = 0;
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3 a = at(batch.corner[0], lane), b = at(batch.corner[1], lane),
               c = at(batch.corner[2], lane);
    const Vec3 ab = b - a, bc = c - b, ac = c - a;
    const Vec3 normal = cross(ab, bc);
    const double scale = 1 / std::sqrt(dot(normal, normal)), height = dot(normal, a);
    const double at_a = dot(ac, ab), at_b = -dot(ab, bc), at_c = dot(bc, ac);
    const double long_a = 0.25 * dot(bc, bc), long_b = 0.25 * dot(ac, ac),
                 long_c = 0.25 * dot(ab, ab);
    put({long_a, long_b, long_c}, out.quarter, lane);
    put({at_a * scale, at_b * scale, at_c * scale}, out.cotangent, lane);
    const double ab_least = at_a < at_b ? at_a : at_b, c_least = at_c < height ? at_c : height;
    double least = ab_least < c_least ? ab_least : c_least;
    if constexpr (!of_edges) {
      put(normal, out.normal, lane);
      out.scale[lane] = scale;
      out.height[lane] = height;
      const double long_ab = long_a > long_b ? long_a : long_b;
      const double apart = apart_scale * (1 - (long_ab > long_c ? long_ab : long_c));
      least = least < apart ? least : apart;
      out.clearance[lane] = least - margin;
    }
    unclear |= least > margin ? 0 : 1;
  }
  return unclear == 0;
}

} // namespace

// A function with versions for several vector widths would be exported, whatever its visibility.
bool triangle_rows(const Batch& batch, TriangleRows& out) {
  return compute_triangle_rows<false>(batch, out);
}

namespace {

// With s = |a-b|/2 the sine of half of the edge's arc, S = s^2, u = s cot(C)/sqrt(1-S) the sine of
// delta and w = u^2, all terms are series in S and w: below this bound, the first omitted term is
// 2^-53 of the leading one.
constexpr double small = 0x1p-13;

CALOTTE_INLINE double inverse_root_series(double z) { // (1 - z)^(-1/2)
  return (1 + z * (1.0 / 2)) + z * z * (3.0 / 8 + z * (5.0 / 16));
}

CALOTTE_INLINE double quarter_arc_sine_series(double z) { // asin(sqrt(z))/sqrt(z)/4
  return (0.25 + z * (0.25 / 6)) + z * z * (0.75 / 40 + z * (1.25 / 112));
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
      pull[e][lane] = tilt * quarter_arc_sine_series(w);
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

CALOTTE_VECTOR_WIDTHS
void terms_of_edges(const Batch& batch, const EdgeRows& edges, TriangleTerms& terms) {
  const auto lanes_of = [](const Rows3& rows, std::size_t lane) {
    return std::array<double, 3>{rows[0][lane], rows[1][lane], rows[2][lane]};
  };
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<double, 3> first = pulled<double>(
          {batch.corner[0][i][lane], batch.corner[1][i][lane], batch.corner[2][i][lane]},
          lanes_of(edges.pull, lane));
      for (std::size_t v = 0; v < 3; ++v)
        terms[v].first[i][lane] = first[v];
    }
    const std::array<double, 3> energy = sums_at_ends(lanes_of(edges.energy, lane));
    for (std::size_t v = 0; v < 3; ++v)
      terms[v].energy[lane] = energy[v];
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

} // namespace

bool small_edge_rows(const Batch& batch, TriangleRows& rows, EdgeRows& edges) {
  return compute_triangle_rows<true>(batch, rows) &&
         small_edges(rows.quarter, rows.cotangent, edges.pull, edges.energy);
}

void edge_rows(const TriangleRows& rows, bool with_area, EdgeRows& edges) {
  const bool all_small = small_edges(rows.quarter, rows.cotangent, edges.pull, edges.energy);
  for (std::size_t e = 0; e < 3; ++e) {
    if (!all_small)
      large_edges(rows.quarter[e], rows.cotangent[e], edges.pull[e], edges.energy[e]);
    if (with_area)
      half_areas(rows.quarter[e], rows.cotangent[e], edges.area[e]);
  }
}

void uniform_terms(const Batch& batch, EdgeRows& edges, const std::vector<Sliver>& slivers,
                   bool with_mass, TriangleTerms& terms) {
  for (const Sliver& sliver : slivers)
    set_edges(sliver, edges);
  terms_of_edges(batch, edges, terms);
  for (const Sliver& sliver : slivers)
    set_first(sliver, terms);
  if (!with_mass)
    return;
  for (std::size_t v = 0; v < 3; ++v)
    for (std::size_t lane = 0; lane < lanes; ++lane)
      terms[v].mass[lane] = edges.area[(v + 1) % 3][lane] + edges.area[(v + 2) % 3][lane];
}

} // namespace calotte::integrals_detail
