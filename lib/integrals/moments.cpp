// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/moments.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "integrals/clipped_moments.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace calotte::integrals_detail {
namespace {

SphericalTriangles triangles_in(const Generators<Sphere>&, const Array<Vec3>&) { return {}; }

FlatTriangles triangles_in(const Generators<Plane>& of, const Array<Vec3>& x) {
  double largest = std::max(of.space.period().x, of.space.period().y);
  for (const Vec3& point : x)
    largest = std::max({largest, std::abs(point.x), std::abs(point.y)});
  return {of.space, largest};
}

/// The sites of a patch whose cells are inside a boundary or cut by it. Its other sites are in the
/// halo, or have no cells.
struct CellsByBoundary {
  std::vector<std::uint8_t> whole; ///< by local number: 1 inside the boundary
  std::vector<std::int32_t> clipped;
};

/// A cell is clipped where the boundary comes within the radii of the circles around it.
template <Space S>
CellsByBoundary by_boundary(const Generators<S>& of, const Patch& patch, const Array<Vec3>& x) {
  std::vector<double> reach2(static_cast<std::size_t>(x.size()), 0);
  for (const Triple& t : patch.corners) {
    const double square = circumradius2(of.space, x[t[0]], x[t[1]], x[t[2]]);
    for (const std::int32_t site : t) {
      double& reach = reach2[static_cast<std::size_t>(site)];
      reach = std::max(reach, square);
    }
  }
  CellsByBoundary cells{std::vector<std::uint8_t>(reach2.size(), 0), {}};
  for (std::int32_t i = 0; i < patch.owned; ++i) {
    const auto own = static_cast<std::size_t>(i);
    if (patch.sites[own] >= of.count)
      continue;
    if (near_boundary(*of.outline, x[i], reach2[own]))
      cells.clipped.push_back(i);
    else
      cells.whole[own] = 1;
  }
  return cells;
}

/// The triangles of whole cells: the density is not evaluated elsewhere.
std::vector<Triple> triangles_of(const CellsByBoundary& cells, const Patch& patch) {
  std::vector<Triple> triangles;
  for (const Triple& t : patch.corners)
    if (std::any_of(t.begin(), t.end(), [&](std::int32_t site) {
          return cells.whole[static_cast<std::size_t>(site)] != 0;
        }))
      triangles.push_back(t);
  return triangles;
}

/// The neighbours of some sites of a patch, each once, in the order of the patch's triangles.
std::vector<std::vector<Vec3>> neighbours_of(const std::vector<std::int32_t>& sites,
                                             const Patch& patch, const Array<Vec3>& x) {
  std::vector<std::int32_t> position(static_cast<std::size_t>(x.size()), -1);
  for (std::size_t k = 0; k < sites.size(); ++k)
    position[static_cast<std::size_t>(sites[k])] = static_cast<std::int32_t>(k);
  std::vector<std::vector<Vec3>> neighbours(sites.size());
  for (const Triple& t : patch.corners)
    for (int v = 0; v < 3; ++v)
      if (const std::int32_t k = position[static_cast<std::size_t>(t[static_cast<std::size_t>(v)])];
          k >= 0) // each neighbour is once the next corner
        neighbours[static_cast<std::size_t>(k)].push_back(
            x[t[static_cast<std::size_t>(next_vertex(v))]]);
  return neighbours;
}

} // namespace

template <Space S>
void integrate(const Integrand& integrand, const Generators<S>& of, const Patch& patch,
               const Array<Vec3>& x, const CellSums& sums, std::vector<std::int32_t>& suspects) {
  assert(sums.mass == nullptr || (S::on_sphere && of.outline == nullptr));
  const auto triangles = triangles_in(of, x);
  if (of.outline == nullptr) {
    sum_kites(triangles, integrand, patch.corners, x, sums, suspects);
    return;
  }
  find_suspects(triangles, patch.corners, x, suspects);
  const CellsByBoundary cells = by_boundary(of, patch, x);
  std::vector<std::int32_t> found; // again
  sum_kites(triangles, integrand, triangles_of(cells, patch), x, sums, found);
  const std::vector<std::vector<Vec3>> neighbours = neighbours_of(cells.clipped, patch, x);
  for (std::size_t k = 0; k < cells.clipped.size(); ++k) {
    const std::int32_t i = cells.clipped[k];
    sums.moments[i] = clipped_moments(integrand, *of.outline, x[i], neighbours[k]);
  }
}

template <Space S>
void find_suspects(const Generators<S>& of, const Patch& patch, const Array<Vec3>& x,
                   std::vector<std::int32_t>& suspects) {
  find_suspects(triangles_in(of, x), patch.corners, x, suspects);
}

template <Space S>
Moments cell_moments(const Generators<S>& of, std::span<const Vec3> sites,
                     const Triangles& triangles, const Integrand& integrand) {
  constexpr std::int64_t patch_sites = 1 << 14; // consecutive ones
  Array<std::int32_t> owner(std::ssize(sites));
  for (std::int64_t i = 0; i < owner.size(); ++i)
    owner[i] = i < of.count ? static_cast<std::int32_t>(i / patch_sites) : -1;
  const Ownership ownership = make_ownership(
      std::move(owner), static_cast<std::int32_t>((of.count + patch_sites - 1) / patch_sites));
  const std::vector<Patch> patches = make_patches(triangles, ownership);
  Moments result{Array<double>(of.count), Array<Vec3>(of.count), Array<double>(of.count)};
  std::fill(result.mass.begin(), result.mass.end(), 0.0);
  std::fill(result.first.begin(), result.first.end(), Vec3{0, 0, 0});
  std::fill(result.energy.begin(), result.energy.end(), 0.0);
  for_each_task(std::ssize(patches), [&](std::int64_t k) {
    const Patch& patch = patches[static_cast<std::size_t>(k)];
    const std::int64_t count = std::ssize(patch.sites);
    Array<Vec3> x(count);
    for (std::int64_t i = 0; i < count; ++i)
      x[i] = sites[static_cast<std::size_t>(patch.sites[static_cast<std::size_t>(i)])];
    Array<CellMoments> moments(count);
    Array<double> mass(count);
    std::vector<std::int32_t> unused;
    integrate(integrand, of, patch, x, {moments, S::on_sphere ? &mass : nullptr}, unused);
    for (std::int32_t i = 0; i < patch.owned; ++i) {
      const std::int32_t site = patch.sites[static_cast<std::size_t>(i)];
      result.mass[site] = S::on_sphere ? mass[i] : moments[i].first.z;
      result.first[site] = moments[i].first;
      result.energy[site] = moments[i].energy;
    }
  });
  return result;
}

Moments mesh_moments(const Mesh& mesh, const Density& density, int rule, int divisions) {
  const std::int64_t n = mesh.points.cols();
  if (n == 0)
    return {};
  return cell_moments(Generators<Sphere>{{}, nullptr, n},
                      {&column(mesh.points, 0), static_cast<std::size_t>(n)}, mesh.triangles,
                      make_integrand(density, rule, divisions));
}

template void integrate(const Integrand&, const Generators<Sphere>&, const Patch&,
                        const Array<Vec3>&, const CellSums&, std::vector<std::int32_t>&);
template void integrate(const Integrand&, const Generators<Plane>&, const Patch&,
                        const Array<Vec3>&, const CellSums&, std::vector<std::int32_t>&);
template void find_suspects(const Generators<Sphere>&, const Patch&, const Array<Vec3>&,
                            std::vector<std::int32_t>&);
template void find_suspects(const Generators<Plane>&, const Patch&, const Array<Vec3>&,
                            std::vector<std::int32_t>&);
template Moments cell_moments(const Generators<Sphere>&, std::span<const Vec3>, const Triangles&,
                              const Integrand&);
template Moments cell_moments(const Generators<Plane>&, std::span<const Vec3>, const Triangles&,
                              const Integrand&);

} // namespace calotte::integrals_detail
