// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/region_cells.h"

#include "base/parallel.h"
#include "base/points.h"
#include "domain/clipped_cell.h"
#include "domain/tangent_shore.h"
#include "integrals/region_moments.h"

#include <calotte/generators.h>

#include <cmath>
#include <vector>

namespace calotte::cvt_detail {
Points3 hull_around(const SphericalOutline& outline) {
  constexpr int level = 1; // 42 directions
  constexpr double distance = 0.5;
  const Points3 directions = bisected_icosahedron(level);
  std::vector<Eigen::Index> far;
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    bool near = outline.side(column(directions, i)) != Side::outside;
    outline.for_each_edge_near(column(directions, i), distance,
                               [&](const SphericalOutline::Edge&) { near = true; });
    if (!near)
      far.push_back(i);
  }
  return directions(Eigen::all, far);
}

RegionCells::RegionCells(const Region& region)
    : outline_(std::make_shared<const SphericalOutline>(region)), hull_(hull_around(*outline_)) {}

void RegionCells::move(const Points3& points) {
  generators_ = points.cols();
  places_.resize(3, generators_ + hull_.cols());
  for_each_block(generators_, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    places_.middleCols(begin, end - begin) = points.middleCols(begin, end - begin);
  });
  places_.rightCols(hull_.cols()) = hull_;
}

Sites RegionCells::sites() const {
  return make_sites(Points3(places_.leftCols(generators_)), Duplicates::merge, 0);
}

double RegionCells::spacing() const {
  return std::sqrt(outline_->area() / static_cast<double>(generators_));
}

bool RegionCells::has_circumcentre(std::int32_t a, std::int32_t b, std::int32_t c) const {
  const Vec3 normal = cross(place(b) - place(a), place(c) - place(a));
  return outline_->side(normal) != Side::outside;
}

void RegionCells::integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
                            Array<CellMoments>& moments,
                            std::vector<std::int32_t>& suspects) const {
  integrals_detail::integrate(integrand, {outline_.get(), generators_}, patch, x, moments,
                              suspects);
}

Points3 RegionCells::retract(const Points3& x, double step, const Points3& d) const {
  Points3 result = SphericalCells::retract(x, step, d);
  for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      if (outline_->side(column(result, i)) == Side::inside)
        continue;
      const TangentPlane plane(column(x, i));
      const TangentShore shore(*outline_, plane);
      const Vec2 to = plane.projected(column(result, i));
      const Vec3 inside = plane.lifted(nearest_inside(shore, Vec2{0, 0}, to).value_or(Vec2{0, 0}));
      set_column(result, i, (1 / norm(inside)) * inside);
    }
  });
  return result;
}

SparseMatrix RegionCells::laplacian(const Connectivity& mesh, const Density& density) const {
  return graph_laplacian(places_, generators_, outline_->area(), mesh, density);
}

} // namespace calotte::cvt_detail
