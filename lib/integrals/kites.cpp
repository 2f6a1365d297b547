// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/kites.h"

#include "base/vector_loops.h"
#include "integrals/density_kites.h"
#include "integrals/linear_kites.h"
#include "integrals/quads.h"
#include "integrals/slivers.h"
#include "integrals/terms.h"
#include "integrals/uniform_kites.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace calotte::integrals_detail {
namespace {

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

/// Adds triangles without a positive clearance to the suspects.
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

/// Replaces first moments that are smaller than the rounding of their terms, as in a cluster, by a
/// moment of that size along the site: the direction of the sum is arbitrary, or there is none.
void set_vanishing(const std::vector<std::int32_t>& sites, const Array<Vec3>& x,
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
    if (integrand.uniform) {
      uniform_terms(surface, batch, rows, slivers, sums.mass != nullptr, terms);
    } else if (integrand.at_sites) {
      gather_density(rho, batch);
      linear_terms(surface, batch, rows, terms);
    } else {
      density_terms(surface, batch, rows, integrand, x, terms);
    }
    scatter(batch, terms, sums.moments.begin());
    if (sums.mass != nullptr)
      scatter_mass(batch, terms, *sums.mass);
  }
  if (integrand.uniform)
    set_vanishing(of_slivers, x, sums.moments);
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
