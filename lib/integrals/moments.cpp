// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/moments.h"

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/points.h"
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

/// Adds the terms of up to four triangles to their sites.
/// \param columns of each triangle, for each corner.
CALOTTE_INLINE void add_columns(const std::array<std::array<Quad, 4>, 3>& columns,
                                const std::array<std::int32_t, 3>* locals, std::size_t count,
                                CellMoments* moments) {
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t v = 0; v < 3; ++v)
      quad_at(moments + locals[k][v]).value += columns[v][k];
}

/// Adds each triangle's terms to its sites, in the order of the triangles.
CALOTTE_VECTOR_WIDTHS
void scatter(const std::array<std::int32_t, 3>* locals, std::size_t count, const VertexTerms& terms,
             CellMoments* moments) {
  static_assert(sizeof(Quad) == sizeof(CellMoments));
  for (std::size_t first = 0; first < count; first += 4) {
    std::array<std::array<Quad, 4>, 3> columns;
    for (std::size_t v = 0; v < 3; ++v) {
      Quad a = quad_at(terms.first[v][0].data() + first).value,
           b = quad_at(terms.first[v][1].data() + first).value,
           c = quad_at(terms.first[v][2].data() + first).value,
           d = quad_at(terms.energy[v].data() + first).value;
      transpose(a, b, c, d);
      columns[v] = {a, b, c, d};
    }
    if (count - first >= 4) // the loop has no conditions then
      add_columns(columns, locals + first, 4, moments);
    else
      add_columns(columns, locals + first, count - first, moments);
  }
}

void scatter_mass(const Batch& batch, const VertexTerms& terms, Array<double>& mass) {
  for (std::size_t lane = 0; lane < batch.count; ++lane)
    for (std::size_t v = 0; v < 3; ++v)
      mass[batch.locals[lane][v]] += terms.mass[v][lane];
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
  VertexTerms terms;
  std::vector<std::int32_t> of_slivers;
  for (std::size_t first = 0; first < patch.corners.size(); first += lanes) {
    Batch batch = gather(patch, x, first);
    if (integrand.at_sites)
      gather_density(rho, batch);
    const bool clear = checked_rows(batch, first, rows, suspects);
    const std::vector<Sliver> slivers = slivers_of(batch, clear, rows, of_slivers);
    if (integrand.uniform)
      uniform_terms(batch, rows, slivers, mass != nullptr, terms);
    else
      kite_terms(batch, rows, integrand, terms);
    scatter(batch.locals, batch.count, terms, moments.begin());
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
