// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/width_rules.h"

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "density/line_distance.h"
#include "density/raster_bounds.h"
#include "density/raster_field.h"
#include "density/width_profile.h"
#include "domain/near_boundary.h"
#include "domain/surface.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>

namespace calotte {
namespace density_detail {
namespace {

using Rule = std::shared_ptr<const WidthRule>;

constexpr double degrees = 180 / std::numbers::pi;

// ---- Rules

class ConstantRule : public WidthRule {
public:
  explicit ConstantRule(double width) : WidthRule(RuleSpace::any), width_(width) {
    require(width > 0, "the cell width {} is not a positive number; give km, in a plane its unit",
            width);
  }
  void evaluate(std::span<const Vec3>, std::span<double> widths) const override {
    std::fill(widths.begin(), widths.end(), width_);
  }
  Bounds bounds(const Vec3&, double) const override { return {width_, width_}; }

private:
  double width_;
};

RuleSpace space_of(const Raster& raster) {
  return raster.of_plane ? RuleSpace::plane : RuleSpace::sphere;
}

/// A given raster, which is prepared when it is first evaluated.
class RasterRule : public WidthRule {
public:
  explicit RasterRule(Raster raster) : WidthRule(space_of(raster)), raster_(std::move(raster)) {
    require_widths(raster_);
  }
  void evaluate(std::span<const Vec3> points, std::span<double> widths) const override {
    evaluate_block(*field(), points, widths);
  }
  Bounds bounds(const Vec3& point, double reach) const override {
    if (!std::isfinite(reach))
      return {raster_.values.minCoeff(), raster_.values.maxCoeff()};
    std::call_once(bounded_, [&] { bounds_.emplace(*field()); });
    return bounds_->within(point, reach);
  }
  const Raster* raster() const override { return &raster_; }
  const RasterField* field() const override {
    std::call_once(once_, [&] { tbb::this_task_arena::isolate([&] { field_.emplace(raster_); }); });
    return &*field_;
  }
  /// The limit is computed at the raster's own nodes.
  Rule limited(double gradient, double radius_km) const override {
    return raster_.of_plane
               ? nullptr
               : std::make_shared<RasterRule>(limit_gradient(raster_, gradient, {}, radius_km));
  }

private:
  Raster raster_;
  mutable std::once_flag once_, bounded_;
  mutable std::optional<RasterField> field_;
  mutable std::optional<RasterBounds> bounds_;
};

/// The raster of a function of the values.
template <class Of> Raster mapped(Raster raster, const Of& of) {
  raster.values = raster.values.unaryExpr(of);
  return raster;
}

/// A rule that interpolates the values of a raster; no demand next to a node without one.
class FieldRule : public WidthRule {
public:
  explicit FieldRule(const Raster& raster)
      : WidthRule(space_of(raster)),
        field_(mapped(raster, [](double width) { return Widths::is_demand(width) ? width : 1; })),
        silent_(mapped(raster, [](double width) { return Widths::is_demand(width) ? 0.0 : 1.0; })),
        bounds_(field_, [&](std::int64_t i, std::int64_t j) {
          return silent_.value(i, j) > 0 ? Widths::no_demand : field_.value(i, j);
        }) {}
  void evaluate(std::span<const Vec3> points, std::span<double> widths) const override {
    constexpr double rounding = 1e-9; // at a node the weights of the others may differ from 0
    std::vector<double> silent(widths.size());
    evaluate_block(field_, points, widths);
    evaluate_block(silent_, points, silent);
    for (std::size_t k = 0; k < widths.size(); ++k)
      widths[k] = silent[k] > rounding ? Widths::no_demand : widths[k];
  }
  Bounds bounds(const Vec3& point, double reach) const override {
    return bounds_.within(point, reach);
  }
  const RasterField* field() const override { return &field_; }

private:
  RasterField field_, silent_; ///< the widths, and 1 at nodes without one
  RasterBounds bounds_;        ///< infinite at nodes without one
};

class LatitudeRule : public WidthRule {
public:
  explicit LatitudeRule(ProfileCurve curve) : curve_(std::move(curve)) {}
  void evaluate(std::span<const Vec3> points, std::span<double> widths) const override {
    for (std::size_t k = 0; k < points.size(); ++k)
      widths[k] = curve_(latitude_of(points[k]));
  }
  Bounds bounds(const Vec3& point, double reach) const override {
    const double latitude = latitude_of(point);
    return curve_.bounds(latitude - reach * degrees, latitude + reach * degrees);
  }
  /// The limit is exact: the shortest path to another latitude runs along a meridian.
  Rule limited(double gradient, double radius_km) const override {
    return std::make_shared<LatitudeRule>(curve_.limited(gradient * radius_km / degrees));
  }

private:
  /// Degrees.
  static double latitude_of(const Vec3& p) {
    // Uses the one of two forms that keeps its digits.
    const double ring = std::sqrt(p.x * p.x + p.y * p.y);
    return degrees * (ring > std::abs(p.z)
                          ? base_detail::arc_sine(p.z)
                          : std::copysign(std::numbers::pi / 2 - base_detail::arc_sine(ring), p.z));
  }

  ProfileCurve curve_;
};

/// A curve by the distance from lines, which is negative where a point is behind them.
/// \tparam Of widths or shares.
template <class Of> class DistanceRule : public Of {
public:
  using IsBehind = std::function<bool(const Vec3&)>;

  /// \param is_behind null if no point is behind the lines.
  DistanceRule(std::shared_ptr<const LineDistance> distance, IsBehind is_behind, ProfileCurve curve,
               double radius_km)
      : Of(distance->on_sphere() ? RuleSpace::sphere : RuleSpace::plane),
        distance_(std::move(distance)), is_behind_(std::move(is_behind)), curve_(std::move(curve)),
        unit_(distance_->on_sphere() ? radius_km : 1) {}
  void evaluate(std::span<const Vec3> points, std::span<double> values) const override {
    evaluate_up_to(std::numeric_limits<double>::infinity(), points, values);
  }
  /// The distance changes by at most the length of a path.
  Bounds bounds(const Vec3& point, double reach) const override {
    const double number = number_of(point, (*distance_)(point));
    return curve_.bounds(number - reach * unit_, number + reach * unit_);
  }

protected:
  const ProfileCurve& curve() const { return curve_; }
  /// Beyond a number of the curve, the values may be those of larger numbers.
  void evaluate_up_to(double farthest, std::span<const Vec3> points,
                      std::span<double> values) const {
    (*distance_)(points, values, farthest / unit_);
    for (std::size_t k = 0; k < points.size(); ++k)
      values[k] = curve_(number_of(points[k], values[k]));
  }
  std::shared_ptr<const LineDistance> distance_;
  IsBehind is_behind_;

private:
  double number_of(const Vec3& point, double distance) const {
    return is_behind_ && is_behind_(point) ? -distance * unit_ : distance * unit_;
  }

  ProfileCurve curve_;
  double unit_; ///< of the curve's distances
};

class WidthByDistance : public DistanceRule<WidthRule> {
public:
  using DistanceRule::DistanceRule;
  /// Lines where the curve is not below the widths do not matter.
  void lower(std::span<const Vec3> points, std::span<double> widths) const override {
    std::vector<double> own(widths.size());
    const double farthest = curve().farthest_below(*std::max_element(widths.begin(), widths.end()));
    evaluate_up_to(farthest, points, own);
    for (std::size_t k = 0; k < widths.size(); ++k)
      widths[k] = std::min(widths[k], own[k]);
  }
  /// The limit is exact: along the shortest path to the line, the distance changes by the path's
  /// length.
  Rule limited(double gradient, double radius_km) const override {
    return curve().grows_from_zero()
               ? std::make_shared<WidthByDistance>(distance_, is_behind_, curve().limited(gradient),
                                                   radius_km)
               : nullptr;
  }
};

/// 1 within a region, 0 outside.
class ShareOfRegion : public ShareRule {
public:
  explicit ShareOfRegion(Surface region)
      : ShareRule(region.is_sphere() ? RuleSpace::sphere : RuleSpace::plane),
        region_(std::move(region)) {}
  void evaluate(std::span<const Vec3> points, std::span<double> shares) const override {
    for (std::size_t k = 0; k < points.size(); ++k)
      shares[k] = share_at(points[k]);
  }
  Bounds bounds(const Vec3& point, double reach) const override {
    if (domain_detail::is_near_boundary(region_, point, reach))
      return {0, 1};
    return {share_at(point), share_at(point)};
  }

private:
  double share_at(const Vec3& p) const { return region_.contains({p.x, p.y, p.z}) ? 1 : 0; }

  Surface region_;
};

class ShareOfRaster : public ShareRule {
public:
  explicit ShareOfRaster(const Raster& raster)
      : ShareRule(space_of(raster)), field_(raster), bounds_(field_) {}
  void evaluate(std::span<const Vec3> points, std::span<double> shares) const override {
    evaluate_block(field_, points, shares);
  }
  Bounds bounds(const Vec3& point, double reach) const override {
    return bounds_.within(point, reach);
  }

private:
  RasterField field_;
  RasterBounds bounds_;
};

/// The rings of a surface as closed lines.
std::vector<Points3> closed_rings(const Surface& surface) {
  std::vector<Points3> lines;
  for (const DoubleMatrix& ring : surface.rings()) {
    Points3 line = Points3::Zero(3, ring.cols() + 1); // z of a plane
    line.topRows(ring.rows()) << ring, ring.col(0);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::shared_ptr<const WidthsOfRadius> for_any_radius(Rule rule) {
  return std::make_shared<WidthsOfRadius>(std::move(rule));
}

/// A rule of(curve, radius) by the distance from lines.
/// \tparam Made a rule by distance, of widths or of shares.
template <class Made, class Of>
std::shared_ptr<const OfRadius<Of>> of_sides(const std::vector<Points3>& lines,
                                             std::function<bool(const Vec3&)> is_behind,
                                             const ProfileCurve& curve, const Surface& surface) {
  const auto distance = std::make_shared<LineDistance>(lines, surface);
  return std::make_shared<OfRadius<Of>>(
      surface.is_sphere() ? RuleSpace::sphere : RuleSpace::plane,
      [curve, distance, is_behind = std::move(is_behind)](double radius_km) {
        return std::make_shared<Made>(distance, is_behind, curve, radius_km);
      });
}

/// Calls body(block, begin) for blocks of points in a rule's space: unit vectors, or x y 0.
template <class Body>
void for_each_block_of(const PointsRef& points, RuleSpace space, const Body& body) {
  const bool plane = space == RuleSpace::plane, sphere = space == RuleSpace::sphere;
  Points3 x = Points3::Zero(3, points.cols()); // for a number, points have no effect
  if (plane)
    x = base_detail::with_z(base_detail::plane_points_of(points));
  if (sphere)
    x = base_detail::directions_of(points);
  base_detail::for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::vector<Vec3> block;
    for (std::int64_t i = begin; i != end; ++i)
      block.push_back(sphere ? domain_detail::as_unit(base_detail::column(x, i))
                             : base_detail::column(x, i));
    body(block, begin);
  });
}

constexpr double quarter = 90;

double farthest_on(const Surface& surface) {
  constexpr double farthest_in_plane = 1e30;
  return surface.is_sphere() ? farthest_on_sphere : farthest_in_plane;
}

} // namespace

std::shared_ptr<const WidthsOfRadius> rule_of_sides(const std::vector<Points3>& lines,
                                                    std::function<bool(const Vec3&)> is_behind,
                                                    const ProfileCurve& curve,
                                                    const Surface& surface) {
  return of_sides<WidthByDistance, WidthRule>(lines, std::move(is_behind), curve, surface);
}

std::shared_ptr<const SharesOfRadius> share_of_sides(const std::vector<Points3>& lines,
                                                     std::function<bool(const Vec3&)> is_behind,
                                                     const ProfileCurve& curve,
                                                     const Surface& surface) {
  return of_sides<DistanceRule<ShareRule>, ShareRule>(lines, std::move(is_behind), curve, surface);
}

std::shared_ptr<const WidthRule> rule_of_field(const Raster& raster) {
  return std::make_shared<FieldRule>(raster);
}

} // namespace density_detail

using namespace density_detail;

Widths::Widths(double width) : Widths(for_any_radius(std::make_shared<ConstantRule>(width))) {}
Widths::Widths(Raster raster)
    : Widths(for_any_radius(std::make_shared<RasterRule>(std::move(raster)))) {}
Widths::Widths(std::shared_ptr<const WidthsOfRadius> rule, double radius_km)
    : rule_of_radius_(std::move(rule)), radius_km_(radius_km) {}

std::shared_ptr<const WidthRule> Widths::rule() const { return (*rule_of_radius_)(radius_km_); }

bool Widths::is_of_plane() const { return rule_of_radius_->space() == RuleSpace::plane; }

Widths Widths::on_sphere(double radius_km) const {
  require_radius(radius_km);
  if (is_of_plane() || radius_km == radius_km_)
    return *this;
  require(radius_km_ == earth_radius_km,
          "the widths are those of a sphere of {} km, not of {}; give one radius", radius_km_,
          radius_km);
  Widths there = *this;
  there.radius_km_ = radius_km;
  return there;
}

DoubleVector evaluate(const Widths& widths, const PointsRef& points) {
  DoubleVector values(points.cols());
  const Rule rule = widths.rule();
  for_each_block_of(points, rule->space(), [&](const std::vector<Vec3>& block, std::int64_t begin) {
    rule->evaluate(block, {values.data() + begin, block.size()});
  });
  return values;
}

Ids active_rules(const Widths& minimum, const PointsRef& points) {
  Ids active(points.cols());
  const Rule rule = minimum.rule();
  for_each_block_of(points, rule->space(), [&](const std::vector<Vec3>& block, std::int64_t begin) {
    rule->find_active(block, {active.data() + begin, block.size()});
  });
  return active;
}

Widths Widths::by_latitude(const WidthProfile& profile) {
  return Widths(for_any_radius(
      std::make_shared<LatitudeRule>(ProfileCurve(profile, "the latitude", -quarter, quarter))));
}

Widths Widths::by_distance(const std::vector<Points3>& lines, const WidthProfile& profile,
                           const Surface& surface) {
  return Widths(rule_of_sides(
      lines, nullptr, ProfileCurve(profile, "a distance", 0, farthest_on(surface)), surface));
}

Widths Widths::around(const std::vector<Points3>& lines, double width, double over,
                      const Surface& surface) {
  const ProfileCurve curve({{{0, width}, {over, width}}}, "a distance", 0, farthest_on(surface));
  return Widths(rule_of_sides(lines, nullptr, curve.within(0, over), surface));
}

WidthShare::WidthShare(const Surface& region)
    : rule_of_radius_(std::make_shared<SharesOfRadius>(std::make_shared<ShareOfRegion>(region))) {}

WidthShare::WidthShare(const Raster& raster) {
  require_values(raster, "shares", a_fraction);
  rule_of_radius_ = std::make_shared<SharesOfRadius>(std::make_shared<ShareOfRaster>(raster));
}

WidthShare::WidthShare(const Surface& region, const WidthProfile& profile) {
  require(region.is_bounded(), "a surface without a boundary has none to be distant from; give a "
                               "region");
  const double farthest = farthest_on(region);
  const auto is_inside = [region](const Vec3& point) {
    return region.contains({point.x, point.y, point.z});
  };
  rule_of_radius_ = share_of_sides(
      closed_rings(region), is_inside,
      ProfileCurve(profile, "a distance", -farthest, farthest, "share", a_fraction), region);
}

} // namespace calotte
