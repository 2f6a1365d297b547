// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/closed_mesh.h"

#include "base/points.h"
#include "base/require.h"
#include "delaunay/far_hull.h"
#include "domain/clipped_cell.h"
#include "domain/surface.h"
#include "exact/space.h"

#include <calotte/delaunay.h>
#include <calotte/quality.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace calotte {
namespace quality_detail {
namespace {

/// The boundary and the generators in a bounded plane.
class Domain {
public:
  Domain(const ClosedMesh& closed, const Outline& outline)
      : points_(&closed.mesh.points), outline_(&outline), generators_(closed.generators) {}

  bool has_triangle(const Triangles& triangles, std::int64_t t) const {
    return triangles.col(t).maxCoeff() < generators_ &&
           outline_->side(at(triangles(0, t)) + centre_of(triangles, t, 0)) != Side::outside;
  }

  bool has_cell(const Triangles& triangles, const VertexRings& rings, std::int64_t site) const {
    const Vec2 here = at(site);
    if (outline_->side(here) == Side::outside)
      return false;
    std::vector<CellCorner> cell;
    for (const Corner corner : rings[site])
      cell.push_back({centre_of(triangles, corner.triangle, corner.vertex),
                      at(triangles(previous_vertex(corner.vertex), corner.triangle)) - here});
    if (!near_boundary(*outline_, here, cell))
      return true;
    const std::vector<CellSide> sides = clipped_cell(*outline_, here, std::move(cell));
    return std::none_of(sides.begin(), sides.end(),
                        [](const CellSide& side) { return side.boundary; });
  }

private:
  Vec2 at(std::int64_t site) const { return {(*points_)(0, site), (*points_)(1, site)}; }
  /// The circumcentre, relative to a corner.
  Vec2 centre_of(const Triangles& triangles, std::int64_t t, int v) const {
    const Vec2 here = at(triangles(v, t));
    return circumcentre(at(triangles(next_vertex(v), t)) - here,
                        at(triangles(previous_vertex(v), t)) - here);
  }

  const Points3* points_;
  const Outline* outline_;
  std::int64_t generators_;
};

/// Flags: 1 where has(domain, i), for 0 <= i < n. Empty without a boundary of the plane.
template <class Has>
Array<std::uint8_t> flags(const ClosedMesh& closed, std::int64_t n, const Has& has) {
  if (closed.surface.is_sphere() || !closed.surface.is_bounded())
    return {};
  const Domain domain(closed, *outline_of<Plane>(closed.surface));
  Array<std::uint8_t> out(n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      out[i] = has(domain, i) ? 1 : 0;
  });
  return out;
}

Points3 sites_of(const Mesh& mesh, const Plane& plane) {
  const Outline* const outline = outline_of<Plane>(mesh.surface);
  const Points3 hull = outline != nullptr ? far_hull(*outline) : Points3(3, 0);
  Points3 points(3, mesh.points.cols() + hull.cols());
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    set_column(points, i, plane.wrapped(column(mesh.points, i)));
  points.rightCols(hull.cols()) = hull;
  return points;
}

} // namespace

ClosedMesh closed_on_sphere(Mesh mesh) {
  const std::int64_t n = mesh.points.cols();
  return {Surface::sphere(), std::move(mesh), n};
}

ClosedMesh closed_in_plane(const Mesh& mesh) {
  DelaunayOptions options;
  options.duplicates = Duplicates::refuse;
  return {mesh.surface,
          delaunay(sites_of(mesh, in_space<Plane>(mesh.surface)), unbounded(mesh.surface), options),
          mesh.points.cols()};
}

Moments moments_of(const ClosedMesh& closed, const Density& density, int rule, int divisions) {
  const Mesh& mesh = closed.mesh;
  return in_space_of(closed.surface, [&]<Space S>(const S& space) {
    return cell_moments(Generators<S>{space, outline_of<S>(closed.surface), closed.generators},
                        {&column(mesh.points, 0), static_cast<std::size_t>(mesh.points.cols())},
                        mesh.triangles, make_integrand(density, rule, divisions));
  });
}

Vec3 off_centroid(const ClosedMesh& closed, const Moments& moments, std::int64_t i) {
  const Vec3 x = column(closed.mesh.points, i), first = moments.first[i];
  return (closed.surface.is_sphere() ? integrals_detail::centroid_of<Sphere>(x, first)
                                     : integrals_detail::centroid_of<Plane>(x, first)) -
         x;
}

void require_centroid(const ClosedMesh& closed, const Moments& moments, std::int64_t i) {
  const double size = closed.surface.is_sphere() ? norm(moments.first[i]) : moments.mass[i];
  if (!(size > 0 && std::isfinite(size)))
    refuse_at(i, "the density is zero over the whole cell of site {}, or beyond 1e150: make it "
                 "positive everywhere, and smaller");
}

Array<std::uint8_t> triangles_inside(const ClosedMesh& closed, const Triangles& triangles) {
  return flags(closed, triangles.cols(), [&](const Domain& domain, std::int64_t t) {
    return domain.has_triangle(triangles, t);
  });
}

Array<std::uint8_t> unclipped_cells(const ClosedMesh& closed, const VertexRings& rings) {
  return flags(closed, closed.generators, [&](const Domain& domain, std::int64_t i) {
    return domain.has_cell(closed.mesh.triangles, rings, i);
  });
}

} // namespace quality_detail

std::vector<bool> clipped_cells(const Mesh& mesh) {
  using namespace quality_detail;
  const Surface& surface = mesh.surface;
  std::vector<bool> clipped(static_cast<std::size_t>(mesh.points.cols()));
  if (surface.is_whole_sphere())
    return clipped;
  require(!surface.is_sphere(),
          "the mesh is one of a region of the sphere, whose cells this does not know; give one of "
          "the plane or of the whole sphere");
  require_finite_plane(surface);
  if (!surface.is_bounded() || clipped.empty())
    return clipped;
  const ClosedMesh closed = closed_in_plane(mesh);
  const Array<std::uint8_t> whole = unclipped_cells(
      closed, make_vertex_rings(closed.mesh.triangles, closed.mesh.neighbours, closed.generators));
  for (std::size_t i = 0; i < clipped.size(); ++i)
    clipped[i] = whole[static_cast<std::int64_t>(i)] == 0;
  return clipped;
}

} // namespace calotte
