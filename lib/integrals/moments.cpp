// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/moments.h"

#include "base/parallel.h"
#include "base/points.h"

#include <algorithm>

namespace calotte::integrals_detail {

void integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
               Array<CellMoments>& moments, Array<double>* mass,
               std::vector<std::int32_t>& suspects) {
  sum_kites(SphericalTriangles{}, integrand, patch.corners, x, {moments, mass}, suspects);
}

void find_suspects(const Patch& patch, const Array<Vec3>& x, std::vector<std::int32_t>& suspects) {
  find_suspects(SphericalTriangles{}, patch.corners, x, suspects);
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
