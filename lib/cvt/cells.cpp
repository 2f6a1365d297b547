// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/cells.h"

#include "base/points.h"
#include "base/triangle.h"
#include "base/vector_field.h"
#include "cvt/hull.h"
#include "delaunay/delaunay.h"
#include "delaunay/far_hull.h"
#include "domain/clipped_cell.h"
#include "domain/tangent_outline.h"
#include "integrals/clipped_moments.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace calotte::cvt_detail {
namespace {

/// The connectivity of a mesh, which must have n sites.
template <Space S> Connectivity extract_connectivity(Mesh&& mesh, std::int64_t n) {
  if (mesh.points.cols() != n || (S::on_sphere && !mesh.closed()))
    throw Error(ErrorCode::too_few_sites,
                S::on_sphere
                    ? "the generators lie within a hemisphere, or two of them have met: spread the "
                      "start over the sphere, or take a smoother density"
                    : "two generators have met: spread the start over the domain, or take a "
                      "smoother density");
  return {std::move(mesh.triangles), std::move(mesh.neighbours)};
}

Eigen::Map<const Points3> columns(std::span<const Vec3> points) {
  return {&points.front().x, 3, std::ssize(points)};
}

} // namespace

template <Space S>
Cells<S>::Cells(const Surface& surface, Boundary boundary)
    : surface_(surface), space_(in_space<S>(surface)), outline_(outline_of<S>(surface_)),
      boundary_(boundary), hull_(3, 0) {
  if (outline_ != nullptr)
    hull_ = far_hull(*outline_);
}

template <Space S>
Cells<S>::Cells(const Surface& surface, Boundary boundary, const Density& density,
                const Points3& start)
    : Cells(surface, boundary) {
  if constexpr (S::on_sphere) {
    if (outline_ == nullptr)
      return;
    const Eigen::Index far = hull_.cols();
    const Points3 rows = hull_rows(surface, density, start.cols());
    hull_.conservativeResize(3, far + rows.cols());
    hull_.rightCols(rows.cols()) = rows;
    do
      move(start);
    while (drop_intruders(far));
  }
}

/// Removes the points of the hull from index `far` on whose cells meet the region. False if there
/// are none.
template <Space S> bool Cells<S>::drop_intruders([[maybe_unused]] Eigen::Index far) {
  if constexpr (S::on_sphere) {
    const Connectivity mesh = triangulate();
    std::vector<std::vector<Vec3>> neighbours(static_cast<std::size_t>(hull_.cols()));
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
      for (int v = 0; v < 3; ++v)
        if (const std::int64_t k = mesh.triangles(v, t) - generators_; k >= 0)
          neighbours[static_cast<std::size_t>(k)].push_back(
              position(mesh.triangles(next_vertex(v), t)));
    std::vector<std::uint8_t> stays(neighbours.size(), 1);
    for_each_block(hull_.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t k = std::max<std::int64_t>(begin, far); k < end; ++k)
        stays[static_cast<std::size_t>(k)] =
            clipped_area(*outline_, column(hull_, k), neighbours[static_cast<std::size_t>(k)]) == 0;
    });
    std::vector<Eigen::Index> kept;
    for (Eigen::Index k = 0; k < hull_.cols(); ++k)
      if (stays[static_cast<std::size_t>(k)] != 0)
        kept.push_back(k);
    if (std::ssize(kept) == hull_.cols())
      return false;
    hull_ = Points3(hull_(Eigen::all, kept));
    return true;
  }
  return false;
}

template <Space S> void Cells<S>::move(const Points3& points) {
  generators_ = points.cols();
  if (S::on_sphere && outline_ == nullptr) {
    sites_ = {&column(points, 0), static_cast<std::size_t>(generators_)};
    return;
  }
  if (copies_.size() != generators_ + hull_.cols())
    copies_ = Array<Vec3>(generators_ + hull_.cols());
  for_each_block(generators_, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      copies_[i] = space_.wrapped(column(points, i));
  });
  for (Eigen::Index k = 0; k < hull_.cols(); ++k)
    copies_[generators_ + k] = column(hull_, k);
  sites_ = {copies_.begin(), static_cast<std::size_t>(copies_.size())};
}

template <Space S> Sites Cells<S>::sites() const {
  const auto points = columns(sites_.first(static_cast<std::size_t>(generators_)));
  if constexpr (S::on_sphere)
    return make_sites(Points3Ref(points), Duplicates::merge, 0);
  else
    return make_planar_sites(points.template topRows<2>(), Duplicates::merge, 0);
}

template <Space S> Connectivity Cells<S>::triangulate() const {
  return extract_connectivity<S>(delaunay(columns(sites_), unbounded(surface_)), site_count());
}

template <Space S> Connectivity Cells<S>::triangulate(Sites&& sites, Regions&& regions) const {
  if (S::on_sphere && outline_ == nullptr)
    return extract_connectivity<S>(
        delaunay_detail::spherical_mesh(std::move(sites), std::move(regions)), site_count());
  return triangulate();
}

template <Space S> double Cells<S>::spacing() const {
  return std::sqrt(surface_.area() / static_cast<double>(generators_));
}

template <Space S> bool Cells<S>::has_centre(const Vec3& a, const Vec3& b, const Vec3& c) const {
  if (outline_ == nullptr)
    return true;
  const auto has = [&](const Vec3& x) { return side_of<S>(outline_, x) != Side::outside; };
  if (boundary_ == Boundary::generators) {
    constexpr double near = 0.8; // on the way to a corner: a triangle may lie across a narrow land
    const Vec3 centre = (1.0 / 3) * (a + b + c);
    const auto on_way = [&](const Vec3& corner) {
      return has((1 - near) * centre + near * corner);
    };
    return has(centre) && on_way(a) && on_way(b) && on_way(c);
  }
  if constexpr (S::on_sphere) {
    return has(cross(b - a, c - a));
  } else {
    const Vec3 u = offset(a, b), v = offset(a, c);
    const Vec2 centre = circumcentre({u.x, u.y}, {v.x, v.y});
    return has({a.x + centre.x, a.y + centre.y, 0});
  }
}

template <Space S>
void Cells<S>::integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
                         Array<CellMoments>& moments, std::vector<std::int32_t>& suspects) const {
  integrals_detail::integrate(integrand, generators(), patch, x, {moments}, suspects);
}

template <Space S>
void Cells<S>::find_suspects(const Patch& patch, const Array<Vec3>& x,
                             std::vector<std::int32_t>& suspects) const {
  integrals_detail::find_suspects(generators(), patch, x, suspects);
}

/// On the sphere M = (M.x) x - gradient/2, with |M.x| = sqrt(|M|^2 - |gradient/2|^2).
template <Space S> Vec3 Cells<S>::centroid(const Vec3& x, const Vec3& gradient, double mass) {
  if constexpr (S::on_sphere) {
    const double square = mass * mass - dot(gradient, gradient) / 4;
    const Vec3 first = std::copysign(std::sqrt(std::max(square, 0.0)), mass) * x - 0.5 * gradient;
    return (1 / norm(first)) * first;
  } else {
    return x - (0.5 / mass) * gradient;
  }
}

template <Space S>
void Cells<S>::retract(const Points3& x, double step, const Points3& d, Points3& to) const {
  if constexpr (S::on_sphere) {
    base_detail::retract(x, step, d, to);
  } else {
    to.resize(3, x.cols());
    for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i != end; ++i)
        set_column(to, i, column(x, i) + step * column(d, i));
    });
  }
  if (outline_ != nullptr)
    enter(x, to);
}

/// Moves generators that have left the surface to the nearest point inside. \param x where they
/// were before.
template <Space S> void Cells<S>::enter(const Points3& x, Points3& to) const {
  for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3 &from = column(x, i), &there = column(to, i);
      if (there.x == from.x && there.y == from.y &&
          there.z == from.z) // as fixed ones on the boundary, where the sign needs many digits
        continue;
      if constexpr (S::on_sphere) {
        if (outline_->side(there) == Side::inside)
          continue;
        const TangentPlane plane(from);
        const Vec3 inside = plane.lifted(
            nearest_inside(TangentOutline(*outline_, plane), Vec2{0, 0}, plane.projected(there))
                .value_or(Vec2{0, 0}));
        set_column(to, i, (1 / norm(inside)) * inside);
      } else {
        if (outline_->side({there.x, there.y}) != Side::outside)
          continue;
        const Vec2 inside =
            nearest_inside(*outline_, {from.x, from.y}, {there.x - from.x, there.y - from.y})
                .value_or(Vec2{0, 0});
        set_column(to, i, from + Vec3{inside.x, inside.y, 0});
      }
    }
  });
}

template <Space S>
void Cells<S>::make_tangential(Points3& vectors, const Points3& x, base_detail::Part part) {
  if constexpr (S::on_sphere) // in the plane all motions are
    base_detail::make_tangential(vectors, x, part);
}

template <Space S>
Laplacian Cells<S>::laplacian(const Connectivity& mesh, const Density& density) const {
  return graph_laplacian(ClippedSites<S>{positions(), generators_, outline_, surface_.area()}, mesh,
                         density);
}

template class Cells<Sphere>;
template class Cells<Plane>;

} // namespace calotte::cvt_detail
