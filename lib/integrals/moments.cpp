// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/moments.h"

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/points.h"
#include "integrals/kites.h"
#include "integrals/quads.h"
#include "integrals/rows.h"
#include "integrals/slivers.h"

#include <algorithm>

namespace calotte::integrals_detail {
namespace {

/// Sets the rows of a batch; adds triangles that are not clear to the suspects. False if there are
/// such triangles.
bool checked_rows(const Batch& batch, std::size_t first, TriangleRows& rows,
                  std::vector<std::int32_t>& suspects) {
  if (triangle_rows(batch, rows))
    return true;
  for (std::size_t lane = 0; lane < batch.count; ++lane)
    if (!(rows.clearance[lane] > 0))
      suspects.push_back(static_cast<std::int32_t>(first + lane));
  return false;
}

/// Four lanes of the terms of each corner: x, y and z of the first moment, and the energy.
using CornerQuads = std::array<std::array<Quad, 4>, 3>;

/// Adds the terms of up to four triangles to their sites.
/// \param columns of each triangle, for each corner.
CALOTTE_INLINE void add_columns(const CornerQuads& columns,
                                const std::array<std::int32_t, 3>* locals, std::size_t count,
                                CellMoments* moments) {
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t v = 0; v < 3; ++v)
      quad_at(moments + locals[k][v]).value += columns[v][k];
}

/// Adds the terms of all triangles to their sites, in the order of the triangles.
/// \param quads its terms in the four lanes from one on.
template <class Quads>
CALOTTE_INLINE void scatter_by(const Quads& quads, const std::array<std::int32_t, 3>* locals,
                               std::size_t count, CellMoments* moments) {
  static_assert(sizeof(Quad) == sizeof(CellMoments));
  for (std::size_t first = 0; first < count; first += 4) {
    CornerQuads columns = quads(first);
    for (auto& [x, y, z, energy] : columns)
      transpose(x, y, z, energy);
    if (count - first >= 4) // the loop has no conditions then
      add_columns(columns, locals + first, 4, moments);
    else
      add_columns(columns, locals + first, count - first, moments);
  }
}

/// By reference: a vector is not returned in the same way by all machines.
CALOTTE_INLINE const QuadInPlace& quad_of(const Row& row, std::size_t lane) {
  return quad_at(row.data() + lane);
}

CALOTTE_VECTOR_WIDTHS
void scatter(const Batch& batch, const TriangleTerms& terms, CellMoments* moments) {
  scatter_by(
      [&](std::size_t lane) {
        CornerQuads quads;
        for (std::size_t v = 0; v < 3; ++v)
          quads[v] = {quad_of(terms[v].first[0], lane).value,
                      quad_of(terms[v].first[1], lane).value,
                      quad_of(terms[v].first[2], lane).value, quad_of(terms[v].energy, lane).value};
        return quads;
      },
      batch.locals, batch.count, moments);
}

/// As scatter() of uniform_terms(), which need not be stored.
CALOTTE_VECTOR_WIDTHS
void scatter_edges(const Batch& batch, const EdgeRows& edges, CellMoments* moments) {
  scatter_by(
      [&](std::size_t lane) {
        const auto quads_of = [&](const Rows3& rows) {
          return std::array<Quad, 3>{quad_of(rows[0], lane).value, quad_of(rows[1], lane).value,
                                     quad_of(rows[2], lane).value};
        };
        CornerQuads quads;
        const std::array<Quad, 3> pull = quads_of(edges.pull);
        for (std::size_t i = 0; i < 3; ++i) {
          const std::array<Quad, 3> first = pulled<Quad>({quad_of(batch.corner[0][i], lane).value,
                                                          quad_of(batch.corner[1][i], lane).value,
                                                          quad_of(batch.corner[2][i], lane).value},
                                                         pull);
          for (std::size_t v = 0; v < 3; ++v)
            quads[v][i] = first[v];
        }
        const std::array<Quad, 3> energy = sums_at_ends(quads_of(edges.energy));
        for (std::size_t v = 0; v < 3; ++v)
          quads[v][3] = energy[v];
        return quads;
      },
      batch.locals, batch.count, moments);
}

void scatter_mass(const Batch& batch, const TriangleTerms& terms, Array<double>& mass) {
  for (std::size_t lane = 0; lane < batch.count; ++lane)
    for (std::size_t v = 0; v < 3; ++v)
      mass[batch.locals[lane][v]] += terms[v].mass[lane];
}

/// The density at the sites.
Array<double> densities(const Integrand& integrand, const Array<Vec3>& x) {
  Array<double> rho(x.size());
  integrand.density(x.begin(), x.size(), rho.begin());
  return rho;
}

/// The slivers of a batch, of which there are none if all of its triangles are clear; adds their
/// corners to a list.
std::vector<Sliver> slivers_of(const Batch& batch, bool clear, TriangleRows& rows,
                               std::vector<std::int32_t>& corners) {
  std::vector<Sliver> slivers = clear ? std::vector<Sliver>() : resolve_slivers(batch, rows);
  for (const Sliver& sliver : slivers)
    corners.insert(corners.end(), batch.locals[sliver.lane].begin(),
                   batch.locals[sliver.lane].end());
  return slivers;
}

/// Gives sites whose first moment is less than the rounding of its terms, as in a cluster, one of
/// that size along the site: the direction of the sum is arbitrary, or there is none.
void settle_vanishing(const std::vector<std::int32_t>& sites, const Array<Vec3>& x,
                      Array<CellMoments>& moments) {
  constexpr double rounding = 0x1p-50;
  for (const std::int32_t i : sites)
    if (norm(moments[i].first) < rounding)
      moments[i].first = rounding * x[i];
}

} // namespace

void integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
               Array<CellMoments>& moments, Array<double>* mass,
               std::vector<std::int32_t>& suspects) {
  std::fill(moments.begin(), moments.end(), CellMoments{{0, 0, 0}, 0});
  if (mass != nullptr)
    std::fill(mass->begin(), mass->end(), 0.0);
  const Array<double> rho = integrand.at_sites ? densities(integrand, x) : Array<double>();
  TriangleRows rows;
  EdgeRows edges;
  TriangleTerms terms;
  std::vector<std::int32_t> of_slivers;
  // True as long as the shorter way suffices: where one batch needs the longer, most do.
  bool small = integrand.uniform && mass == nullptr;
  for (std::size_t first = 0; first < patch.corners.size(); first += lanes) {
    Batch batch = gather(patch, x, first);
    small = small && small_edge_rows(batch, rows, edges);
    if (small) {
      scatter_edges(batch, edges, moments.begin());
      continue;
    }
    if (integrand.at_sites)
      gather_density(rho, batch);
    const bool clear = checked_rows(batch, first, rows, suspects);
    const std::vector<Sliver> slivers = slivers_of(batch, clear, rows, of_slivers);
    if (integrand.uniform) {
      edge_rows(rows, mass != nullptr, edges);
      if (slivers.empty() && mass == nullptr) {
        scatter_edges(batch, edges, moments.begin());
        continue;
      }
      uniform_terms(batch, edges, slivers, mass != nullptr, terms);
    } else {
      kite_terms(batch, rows, integrand, mass != nullptr, terms);
    }
    scatter(batch, terms, moments.begin());
    if (mass != nullptr)
      scatter_mass(batch, terms, *mass);
  }
  if (integrand.uniform)
    settle_vanishing(of_slivers, x, moments);
}

void find_suspects(const Patch& patch, const Array<Vec3>& x, std::vector<std::int32_t>& suspects) {
  TriangleRows rows;
  for (std::size_t first = 0; first < patch.corners.size(); first += lanes) {
    const Batch batch = gather(patch, x, first);
    checked_rows(batch, first, rows, suspects);
  }
}

Moments mesh_moments(const Mesh& mesh, const Density& density, int rule, int divisions) {
  const Integrand integrand = make_integrand(density, rule, divisions);
  const std::int64_t n = mesh.points.cols();
  constexpr std::int64_t patch_sites = 1 << 14; // consecutive ones
  Array<std::int32_t> owner(n);
  for (std::int64_t i = 0; i < n; ++i)
    owner[i] = static_cast<std::int32_t>(i / patch_sites);
  const Ownership ownership = make_ownership(
      std::move(owner), static_cast<std::int32_t>((n + patch_sites - 1) / patch_sites));
  const std::vector<Patch> patches = make_patches(mesh.triangles, ownership);
  Moments result{Array<double>(n), Array<Vec3>(n), Array<double>(n)};
  std::fill(result.mass.begin(), result.mass.end(), 0.0);
  std::fill(result.first.begin(), result.first.end(), Vec3{0, 0, 0});
  std::fill(result.energy.begin(), result.energy.end(), 0.0);
  for_each_task(std::ssize(patches), [&](std::int64_t k) {
    const Patch& patch = patches[static_cast<std::size_t>(k)];
    const std::int64_t count = std::ssize(patch.sites);
    Array<Vec3> x(count);
    for (std::int64_t i = 0; i < count; ++i)
      x[i] = column(mesh.points, patch.sites[static_cast<std::size_t>(i)]);
    Array<CellMoments> moments(count);
    Array<double> mass(count);
    std::vector<std::int32_t> unused;
    integrate(integrand, patch, x, moments, &mass, unused);
    for (std::int32_t i = 0; i < patch.owned; ++i) {
      const std::int32_t site = patch.sites[static_cast<std::size_t>(i)];
      result.mass[site] = mass[i];
      result.first[site] = moments[i].first;
      result.energy[site] = moments[i].energy;
    }
  });
  return result;
}

} // namespace calotte::integrals_detail
