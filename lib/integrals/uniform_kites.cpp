// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/uniform_kites.h"

#include "base/vector_loops.h"
#include "integrals/half_edge.h"

#include <cstddef>
#include <cstdint>

namespace calotte::integrals_detail {
namespace {

/// The contribution of each edge, named by the vertex across, to both of its ends.
struct alignas(64) EdgeRows {
  Rows3 pull, energy; ///< see EdgeTerms
  Rows3 area;
};

/// Sets pull and energy by their series. True if the series are valid in all lanes.
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

/// Sums the terms of edges at vertices: each vertex is an end of the two edges that are named by
/// the other vertices.
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

/// Sets the terms of flat triangles. Half a kite with the legs s and s cot has the area s^2 cot/2,
/// the first moment area times the mean of its corners, and the energy area times s^2 (3 +
/// cot^2)/6.
CALOTTE_VECTOR_WIDTHS
void flat_terms(const Batch& batch, const TriangleRows& rows, const Rows3& centres,
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
      const Vec3 middle = 0.5 * (at_a + at_b), sum = middle + at(centres, lane);
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

} // namespace

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

void uniform_terms(const FlatTriangles& plane, const Batch& batch, const TriangleRows& rows,
                   const std::vector<Sliver>&, bool, TriangleTerms& terms) {
  flat_terms(batch, rows, centre_rows(plane, batch, rows).centre, terms);
}

} // namespace calotte::integrals_detail
