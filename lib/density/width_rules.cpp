// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/width_rules.h"

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "density/gradient_limit.h"
#include "density/line_distance.h"
#include "density/raster_bounds.h"
#include "density/raster_field.h"
#include "density/width_cones.h"
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
    std::transform(widths.begin(), widths.end(), own.begin(), widths.begin(),
                   [](double a, double b) { return std::min(a, b); });
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

/// The space where two rules are both defined.
RuleSpace common_space(RuleSpace a, RuleSpace b) {
  require(a == RuleSpace::any || b == RuleSpace::any || a == b,
          "some widths are of the sphere and some of a plane; give those of one of them");
  return a == RuleSpace::any ? b : a;
}

template <class Rules> RuleSpace common_space(const Rules& rules) {
  RuleSpace space = RuleSpace::any;
  for (const auto& rule : rules)
    space = common_space(space, rule->space());
  return space;
}

/// A rule that combines several rules at each point.
class CombinedRule : public WidthRule {
public:
  using Combine = double (*)(double, double);
  CombinedRule(std::vector<Rule> parts, Combine combine)
      : WidthRule(common_space(parts)), parts_(std::move(parts)), combine_(combine) {}
  void evaluate(std::span<const Vec3> points, std::span<double> widths) const override {
    parts_.front()->evaluate(points, widths);
    std::vector<double> others(widths.size());
    for (std::size_t k = 1; k < parts_.size(); ++k) {
      parts_[k]->evaluate(points, others);
      std::transform(widths.begin(), widths.end(), others.begin(), widths.begin(), combine_);
    }
  }
  Bounds bounds(const Vec3& point, double reach) const override {
    Bounds bounds = parts_.front()->bounds(point, reach);
    for (std::size_t k = 1; k < parts_.size(); ++k) {
      const Bounds other = parts_[k]->bounds(point, reach);
      bounds = {combine_(bounds.least, other.least), combine_(bounds.greatest, other.greatest)};
    }
    return bounds;
  }

protected:
  const std::vector<Rule>& parts() const { return parts_; }

private:
  std::vector<Rule> parts_;
  Combine combine_; ///< does not fall where a width grows
};

double least_of(double a, double b) { return std::min(a, b); }
double greatest_of(double a, double b) { return std::max(a, b); }
double sum_of(double a, double b) { return a + b; }
double product_of(double a, double b) { return a * b; }

/// The minimum of several rules. Its limit is the minimum of their limits.
class MinimumRule : public CombinedRule {
public:
  explicit MinimumRule(std::vector<Rule> parts) : CombinedRule(std::move(parts), least_of) {}
  void evaluate(std::span<const Vec3> points, std::span<double> widths) const override {
    std::fill(widths.begin(), widths.end(), Widths::no_demand);
    lower(points, widths);
  }
  void lower(std::span<const Vec3> points, std::span<double> widths) const override {
    for (const Rule& part : parts())
      part->lower(points, widths);
  }
  void find_active(std::span<const Vec3> points, std::span<std::int32_t> active) const override {
    std::fill(active.begin(), active.end(), 0);
    std::vector<double> least(points.size(), Widths::no_demand), widths(least);
    for (std::size_t part = 0; part < parts().size(); ++part) {
      parts()[part]->evaluate(points, widths);
      for (std::size_t k = 0; k < points.size(); ++k)
        if (widths[k] < least[k]) {
          least[k] = widths[k];
          active[k] = static_cast<std::int32_t>(part);
        }
    }
  }
  Rule limited(double gradient, double radius_km) const override {
    std::vector<Rule> limited;
    for (const Rule& part : parts())
      limited.push_back(density_detail::limited(part, gradient, radius_km));
    return std::make_shared<MinimumRule>(std::move(limited));
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

/// (1 - t) a + t b.
double blended_width(double a, double b, double t) {
  if (!(t > 0))
    return a;
  if (t >= 1)
    return b;
  // No demand has no mean with a width.
  return Widths::is_demand(std::max(a, b)) ? a + t * (b - a) : Widths::no_demand;
}

/// A rule that blends two rules by a share. \tparam Weight gives t for a share.
template <double (*Weight)(double)> class BlendRule : public WidthRule {
public:
  BlendRule(RuleSpace space, Rule a, Rule b, std::shared_ptr<const ShareRule> share)
      : WidthRule(space), a_(std::move(a)), b_(std::move(b)), share_(std::move(share)) {}
  void evaluate(std::span<const Vec3> points, std::span<double> widths) const override {
    std::vector<double> others(widths.size()), shares(widths.size());
    a_->evaluate(points, widths);
    b_->evaluate(points, others);
    share_->evaluate(points, shares);
    for (std::size_t k = 0; k < points.size(); ++k)
      widths[k] = blended_width(widths[k], others[k], Weight(shares[k]));
  }
  Bounds bounds(const Vec3& point, double reach) const override {
    const Bounds shares = share_->bounds(point, reach), a = a_->bounds(point, reach),
                 b = b_->bounds(point, reach);
    Bounds bounds; // linear in t, and grows with both widths
    for (const double t : {Weight(shares.least), Weight(shares.greatest)}) {
      bounds.add(blended_width(a.least, b.least, t));
      bounds.add(blended_width(a.greatest, b.greatest, t));
    }
    return bounds;
  }

private:
  Rule a_, b_;
  std::shared_ptr<const ShareRule> share_;
};

double all_of(double share) { return share; }
double rounded(double share) { return share >= 0.5 ? 1 : 0; }

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

/// The common radius of some widths: those of the Earth take that of the other sphere.
double common_radius(const std::vector<Widths>& widths) {
  double radius = earth_radius_km;
  for (const Widths& one : widths)
    if (one.radius_km() != earth_radius_km) {
      require(radius == earth_radius_km || radius == one.radius_km(),
              "some widths are of a sphere of {} km and some of one of {}; "
              "give those of one of them",
              radius, one.radius_km());
      radius = one.radius_km();
    }
  return radius;
}

/// Widths that make(rules) combines from the rules of some widths.
template <class Make> Widths combine_rules(const std::vector<Widths>& widths, const Make& make) {
  require(!widths.empty(), "there are no widths to combine; give one or more");
  std::vector<std::shared_ptr<const WidthsOfRadius>> parts;
  for (const Widths& one : widths)
    parts.push_back(one.rule_of_radius());
  const RuleSpace space = common_space(parts);
  const auto of_radius = [parts = std::move(parts), make](double radius_km) {
    std::vector<Rule> rules;
    for (const auto& part : parts)
      rules.push_back((*part)(radius_km));
    return make(std::move(rules));
  };
  return Widths(std::make_shared<WidthsOfRadius>(space, of_radius), common_radius(widths));
}

Widths combined(const std::vector<Widths>& of, CombinedRule::Combine combine) {
  return combine_rules(of, [combine](std::vector<Rule> rules) {
    return std::make_shared<CombinedRule>(std::move(rules), combine);
  });
}

template <double (*Weight)(double)>
Widths blended(const Widths& a, const Widths& b, const WidthShare& share) {
  const auto of_a = a.rule_of_radius(), of_b = b.rule_of_radius();
  const auto of_share = share.rule_of_radius();
  const RuleSpace space =
      common_space(common_space(of_a->space(), of_b->space()), of_share->space());
  const auto make = [=](double radius_km) {
    return std::make_shared<BlendRule<Weight>>(space, (*of_a)(radius_km), (*of_b)(radius_km),
                                               (*of_share)(radius_km));
  };
  return Widths(std::make_shared<WidthsOfRadius>(space, make), common_radius({a, b}));
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

void WidthRule::lower(std::span<const Vec3> points, std::span<double> widths) const {
  std::vector<double> own(widths.size());
  evaluate(points, own);
  std::transform(widths.begin(), widths.end(), own.begin(), widths.begin(), least_of);
}

void WidthRule::find_active(std::span<const Vec3>, std::span<std::int32_t> active) const {
  std::fill(active.begin(), active.end(), 0);
}

std::shared_ptr<const WidthRule> WidthRule::limited(double, double) const { return nullptr; }

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

std::shared_ptr<const WidthRule> limited(const std::shared_ptr<const WidthRule>& rule,
                                         double gradient, double radius_km) {
  if (rule->space() == RuleSpace::any) // made of numbers
    return rule;
  if (Rule exact = rule->limited(gradient, radius_km))
    return exact;
  require(rule->space() != RuleSpace::plane, "the gradient of such widths of a plane depends on "
                                             "the domain; limit that of all widths in it");
  const Raster nodes =
      with_cones(*rule, sample(*rule, step_for(*rule, radius_km)), gradient * radius_km);
  if (!Widths::is_demand(nodes.values.minCoeff()))
    return rule;
  const Rule raster = std::make_shared<RasterRule>(limit_gradient(nodes, gradient, {}, radius_km));
  return std::make_shared<CombinedRule>(std::vector<Rule>{rule, raster}, least_of);
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

Widths Widths::limit_gradient(double gradient) const {
  require_gradient(gradient);
  const auto make = [rule = rule_of_radius_, gradient](double radius_km) {
    return limited((*rule)(radius_km), gradient, radius_km);
  };
  Widths limits = *this;
  limits.rule_of_radius_ = std::make_shared<WidthsOfRadius>(rule_of_radius_->space(), make);
  if (is_of_plane())
    limits.rule(); // which not every rule has
  return limits;
}

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

Widths Widths::minimum(const std::vector<Widths>& of) {
  return combine_rules(
      of, [](std::vector<Rule> rules) { return std::make_shared<MinimumRule>(std::move(rules)); });
}
Widths Widths::maximum(const std::vector<Widths>& of) { return combined(of, greatest_of); }
Widths Widths::sum(const std::vector<Widths>& of) { return combined(of, sum_of); }
Widths Widths::times(double factor) const {
  require(factor > 0 && std::isfinite(factor),
          "the factor {} of widths is not a positive number; give one", factor);
  return combined({*this, factor}, product_of);
}
Widths Widths::where(const WidthShare& share, const Widths& inside, const Widths& outside) {
  return blended<rounded>(outside, inside, share);
}
Widths Widths::blend(const Widths& a, const Widths& b, const WidthShare& t) {
  return blended<all_of>(a, b, t);
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
