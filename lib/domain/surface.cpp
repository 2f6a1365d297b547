// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/surface.h"

#include "base/first_fault.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "domain/outline.h"
#include "domain/spherical_outline.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>

namespace calotte {

/// The first query makes the data that queries need.
struct Surface::Bounds {
  explicit Bounds(Rings given) : rings(std::move(given)) {}

  const domain_detail::SphericalOutline& on_sphere() const {
    std::call_once(once,
                   [this] { base_detail::in_isolation([this] { spherical.emplace(rings); }); });
    return *spherical;
  }
  const domain_detail::Outline& in_plane() const {
    std::call_once(once, [this] { base_detail::in_isolation([this] { planar.emplace(rings); }); });
    return *planar;
  }

  Rings rings;
  mutable std::once_flag once;
  mutable std::optional<domain_detail::SphericalOutline> spherical;
  mutable std::optional<domain_detail::Outline> planar;
};

Surface domain_detail::UncheckedSurface::of_sphere(Surface::Rings rings) {
  Surface surface;
  if (!rings.empty())
    surface.bounds_ = std::make_shared<Surface::Bounds>(std::move(rings));
  return surface;
}

Surface domain_detail::UncheckedSurface::of_plane(Surface::Rings rings,
                                                  const Eigen::Vector2d& period) {
  Surface surface = of_sphere(std::move(rings));
  surface.sphere_ = false;
  if (!surface.bounds_)
    surface.period_ = period;
  return surface;
}

const domain_detail::SphericalOutline*
domain_detail::UncheckedSurface::outline_on_sphere(const Surface& surface) {
  return surface.bounds_ ? &surface.bounds_->on_sphere() : nullptr;
}

const domain_detail::Outline*
domain_detail::UncheckedSurface::outline_in_plane(const Surface& surface) {
  return surface.bounds_ ? &surface.bounds_->in_plane() : nullptr;
}

Surface Surface::plane() { return domain_detail::UncheckedSurface::of_plane({}, {0, 0}); }

Surface Surface::periodic(const Eigen::Vector2d& period) {
  const auto good = [](double side) { return side == 0 || (side >= 1e-30 && side <= 1e30); };
  base_detail::require(good(period.x()) && good(period.y()) && period.maxCoeff() > 0,
                       "the period is {} x {}; give two lengths from 1e-30 to 1e30, or one and 0",
                       period.x(), period.y());
  return domain_detail::UncheckedSurface::of_plane({}, period);
}

Surface Surface::within(Rings rings) const {
  base_detail::require(!bounds_ && period_.isZero(0),
                       "rings bound the whole sphere or the whole plane only; give one of these");
  base_detail::require(!rings.empty(), "there are no rings; give one or more");
  for (std::size_t k = 0; sphere_ && k < rings.size(); ++k)
    base_detail::require(rings[k].rows() == 3,
                         "ring {}: it has {} rows; give 3, the coordinates x y z of a direction", k,
                         rings[k].rows());
  Surface part = *this;
  const auto bounds = std::make_shared<Bounds>(std::move(rings));
  if (sphere_)
    bounds->on_sphere();
  else
    bounds->in_plane();
  part.bounds_ = bounds;
  return part;
}

const Surface::Rings& Surface::rings() const {
  static const Rings none;
  return bounds_ ? bounds_->rings : none;
}

double Surface::area() const {
  if (bounds_)
    return sphere_ ? bounds_->on_sphere().area() : bounds_->in_plane().area();
  if (sphere_)
    return 4 * std::numbers::pi;
  return is_box() ? period_.prod() : std::numeric_limits<double>::infinity();
}

bool Surface::contains(const Eigen::Vector3d& point) const {
  using domain_detail::Side;
  if (!point.allFinite() || (sphere_ && point.isZero(0)))
    return false;
  if (bounds_)
    return (sphere_ ? bounds_->on_sphere().side({point.x(), point.y(), point.z()})
                    : bounds_->in_plane().side({point.x(), point.y()})) != Side::outside;
  for (int k = 0; k < 2; ++k)
    if (period_[k] > 0 && !(point[k] >= 0 && point[k] < period_[k]))
      return false;
  return true;
}

bool Surface::equals(const Surface& other) const {
  const auto same = [](const DoubleMatrix& a, const DoubleMatrix& b) {
    return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
  };
  return sphere_ == other.sphere_ && period_ == other.period_ &&
         (bounds_ == other.bounds_ || std::ranges::equal(rings(), other.rings(), same));
}

namespace domain_detail {

namespace {

void require_in_box(const Points3Ref& points, const Eigen::Vector2d& period) {
  FirstFault outside;
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      for (int k = 0; k < 2; ++k)
        if (period[k] > 0 && points.col(i).allFinite() &&
            (points(k, i) < 0 || points(k, i) >= period[k]))
          outside.at(i);
  });
  outside.refuse("point",
                 "is outside the periodic box, which starts at 0 0: add or subtract periods");
}

} // namespace

void require_inside(const Points3Ref& points, const Surface& surface, std::int64_t fixed) {
  if (!surface.is_bounded())
    return require_in_box(points, surface.period());
  FirstFault outside;
  in_space_of(surface, [&]<class S>(const S&) {
    const OutlineOf<S>& outline = *outline_of<S>(surface);
    for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i != end; ++i)
        if (points.col(i).allFinite() && side_of<S>(&outline, column(points, i)) == Side::outside)
          outside.at(i);
    });
  });
  if (!surface.is_sphere())
    outside.refuse("point", "is outside of the domain; leave it out, or move it inside");
  outside.refuse(outside.index() < fixed ? "fixed generator" : "generator",
                 "is outside the region; give points inside it, or a larger region");
}

void require_finite_plane(const Surface& surface) {
  const Eigen::Vector2d& period = surface.period();
  const bool good = (period.array() >= 1e-30).all() && (period.array() <= 1e30).all();
  require(surface.is_bounded() || good,
          "the domain: it has no rings, and the periodic box is {} x {}; "
          "give rings, or two lengths from 1e-30 to 1e30",
          period.x(), period.y());
}

void require_sphere(const Surface& surface, const std::string& what) {
  require(surface.is_sphere(),
          "{} for the sphere, and the surface is a plane; give one of the sphere", what);
}

void require_plane(const Surface& surface, const std::string& what) {
  require(!surface.is_sphere(),
          "{} for the plane, and the surface is one of the sphere; give one of the plane", what);
}

} // namespace domain_detail
} // namespace calotte
