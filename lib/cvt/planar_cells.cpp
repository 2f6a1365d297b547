// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/planar_cells.h"

#include "base/parallel.h"
#include "base/points.h"
#include "delaunay/periodic.h"
#include "domain/clipped_cell.h"
#include "domain/planar_domain.h"
#include "integrals/planar_moments.h"

#include <algorithm>
#include <cmath>

namespace calotte::cvt_detail {
namespace {

/// Three places far outside a box. No place inside the box is nearer to one of them than to any
/// other place inside.
std::array<Vec3, 3> hull_around(const Box2& box) {
  const Vec2 extent{box.high.x - box.low.x, box.high.y - box.low.y};
  const double x = box.low.x + extent.x / 2, y = box.low.y + extent.y / 2,
               far = 8 * (extent.x + extent.y);
  return {Vec3{x, y + far, 0}, Vec3{x - 0.75 * far, y - far / 2, 0},
          Vec3{x + 0.75 * far, y - far / 2, 0}};
}

} // namespace

void require_inside(const Points2Ref& places, const PlanarDomain& domain) {
  if (domain.periodic())
    return require_in_box(places, domain.period);
  domain_detail::require_inside(places, Outline(domain));
}

PlanarCells::PlanarCells(const PlanarDomain& domain)
    : period_{domain.period.x(), domain.period.y()}, area_(domain.period.prod()), hull_{} {
  if (domain.periodic()) {
    require_domain(domain);
    return;
  }
  outline_ = std::make_shared<const Outline>(domain);
  period_ = {0, 0};
  area_ = outline_->area();
  hull_ = hull_around(outline_->box());
}

Array<Vec3> PlanarCells::places_of(const Points3& points) const {
  const std::int64_t n = points.cols();
  Array<Vec3> places(n + (outline_ ? std::ssize(hull_) : 0));
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3& x = column(points, i);
      places[i] = outline_ ? x : Vec3{wrapped(x.x, period_.x), wrapped(x.y, period_.y), 0};
    }
  });
  if (outline_)
    std::copy(hull_.begin(), hull_.end(), places.begin() + n);
  return places;
}

void PlanarCells::move(const Points3& points) {
  generators_ = points.cols();
  places_ = places_of(points);
}

Sites PlanarCells::sites() const {
  Points2 points(2, generators_);
  for_each_block(generators_, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      points.col(i) << places_[i].x, places_[i].y;
  });
  return make_planar_sites(points, Duplicates::merge, 0);
}

double PlanarCells::spacing() const { return std::sqrt(area_ / static_cast<double>(generators_)); }

bool PlanarCells::has_centre(std::int32_t a, std::int32_t b, std::int32_t c) const {
  if (!outline_)
    return true;
  const Vec3 u = offset(places_[a], places_[b]), v = offset(places_[a], places_[c]);
  const Vec2 centre = circumcentre({u.x, u.y}, {v.x, v.y});
  return outline_->side({places_[a].x + centre.x, places_[a].y + centre.y}) != Side::outside;
}

void PlanarCells::integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
                            Array<CellMoments>& moments,
                            std::vector<std::int32_t>& suspects) const {
  integrals_detail::integrate(integrand, {outline_.get(), period_, generators_}, patch, x, moments,
                              suspects);
}

void PlanarCells::find_suspects(const Patch& patch, const Array<Vec3>& x,
                                std::vector<std::int32_t>& suspects) const {
  integrals_detail::find_suspects({outline_.get(), period_, generators_}, patch, x, suspects);
}

/// Lloyd's map M/m and dE/dx = -2 M, M about the generator.
PlanarCells::Pull PlanarCells::pull(const Vec3& x, const CellMoments& cell) {
  const double mass = cell.first.z;
  return {x + Vec3{cell.first.x / mass, cell.first.y / mass, 0},
          {-2 * cell.first.x, -2 * cell.first.y, 0},
          mass > 0 ? mass : std::nan("")};
}

Vec3 PlanarCells::centroid(const Vec3& x, const Vec3& gradient, double mass) {
  return x - (0.5 / mass) * gradient;
}

void PlanarCells::retract(const Points3& x, double step, const Points3& d, Points3& to) const {
  to.resize(3, x.cols());
  for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3& from = column(x, i);
      const Vec3 there = from + step * column(d, i);
      set_column(to, i, there);
      if (!outline_ || outline_->side({there.x, there.y}) != Side::outside)
        continue;
      const Vec2 inside =
          nearest_inside(*outline_, {from.x, from.y}, {there.x - from.x, there.y - from.y})
              .value_or(Vec2{0, 0});
      set_column(to, i, from + Vec3{inside.x, inside.y, 0});
    }
  });
}

Laplacian PlanarCells::laplacian(const Connectivity& mesh, const Density& density) const {
  return graph_laplacian({places_, generators_, period_, outline_.get(), area_}, mesh, density);
}

} // namespace calotte::cvt_detail
