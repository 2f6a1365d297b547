// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "cvt/cells.h"
#include "domain/spherical_outline.h"
#include "integrals/clipped_moments.h"

#include <calotte/cvt.h>

#include <cmath>
#include <memory>
#include <vector>

/// The laws of tessellations of regions of the sphere.
namespace calotte::test::region_laws {

/// The sum of the areas of the cells, as a run has them, clipped by the region.
inline double sum_of_cells(const Surface& region, const Points3& points,
                           const Density& density = {}) {
  const auto& outline = *domain_detail::outline_of<exact_detail::Sphere>(region);
  cvt_detail::Cells<exact_detail::Sphere> cells(region, Boundary::clip, density, points);
  cells.move(points);
  const mesh_detail::Connectivity mesh = cells.triangulate();
  std::vector<std::vector<base_detail::Vec3>> around(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (mesh.triangles(v, t) < points.cols())
        around[static_cast<std::size_t>(mesh.triangles(v, t))].push_back(
            cells.position(mesh.triangles((v + 1) % 3, t)));
  double sum = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    sum += integrals_detail::clipped_area(outline, base_detail::column(points, i),
                                          around[static_cast<std::size_t>(i)]);
  return sum;
}

} // namespace calotte::test::region_laws
