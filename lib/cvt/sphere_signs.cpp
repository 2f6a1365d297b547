// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "base/triangle.h"
#include "cvt/signs.h"
#include "delaunay/delaunay.h"
#include "exact/predicates.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <utility>

namespace calotte::cvt_detail {

bool SphereSigns::is_counter_clockwise(const Corners& triangle) const {
  return orientation(column(*points_, triangle[0]), column(*points_, triangle[1]),
                     column(*points_, triangle[2])) > 0;
}

/// Rounding is below 1e-14 for unit vectors.
bool SphereSigns::is_clearly_acute(const Corners& triangle, int v) const {
  const auto at = [&](int i) -> const Vec3& {
    return column(*points_, triangle[static_cast<std::size_t>(i)]);
  };
  const Vec3& here = at(v);
  return dot(at(next_vertex(v)) - here, at(previous_vertex(v)) - here) > 1e-14;
}

bool SphereSigns::circle_holds(const Corners& triangle, int, std::int32_t d) const {
  return in_circle_resolved(View{}, column(*points_, triangle[0]), column(*points_, triangle[1]),
                            column(*points_, triangle[2]), column(*points_, d)) > 0;
}

Connectivity closed_connectivity(Mesh&& mesh, std::int64_t n) {
  if (mesh.points.cols() != n || !mesh.closed())
    throw Error(ErrorCode::too_few_sites,
                "the generators lie within a hemisphere, or two of them have met: spread the start "
                "over the sphere, or take a smoother density");
  return {std::move(mesh.triangles), std::move(mesh.neighbours)};
}

Connectivity SphereSigns::triangulate() const {
  return closed_connectivity(spherical_delaunay(*points_), points_->cols());
}

} // namespace calotte::cvt_detail
