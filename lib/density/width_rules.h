// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/bounds.h"
#include "density/raster_field.h"
#include "density/room.h"
#include "density/width_profile.h"

#include <calotte/widths.h>

#include <tbb/task_arena.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace calotte::density_detail {

/// Where a rule is defined. A number, and a combination of numbers, is defined in any space.
enum class RuleSpace { any, sphere, plane };

/// A value for every point. Immutable.
class PointRule {
public:
  explicit PointRule(RuleSpace space) : space_(space) {}
  PointRule(const PointRule&) = delete;
  PointRule& operator=(const PointRule&) = delete;
  virtual ~PointRule() = default;

  RuleSpace space() const { return space_; }

  /// \param points unit vectors, in a plane x y 0. Faster if each point is near the previous one.
  virtual void evaluate(std::span<const Vec3> points, std::span<double> values) const = 0;

  /// Bounds of the values within a distance of a point, not always tight.
  /// \param reach radians, in a plane its unit; infinite for all points.
  virtual Bounds bounds(const Vec3& point, double reach) const = 0;

private:
  RuleSpace space_;
};

/// A share from 0 to 1.
class ShareRule : public PointRule {
public:
  using PointRule::PointRule;
};

/// A width, or Widths::no_demand.
class WidthRule : public PointRule {
public:
  explicit WidthRule(RuleSpace space = RuleSpace::sphere) : PointRule(space) {}

  /// Lowers widths at points to the rule's, where these are less. Faster than evaluate() where a
  /// rule can tell early that it demands no less.
  virtual void lower(std::span<const Vec3> points, std::span<double> widths) const;

  /// By point, the index of the part of a minimum that gives the width; 0 for other rules.
  virtual void find_active(std::span<const Vec3> points, std::span<std::int32_t> active) const;

  /// A lower bound of all widths, km, > 0.
  double least() const { return bounds({0, 0, 1}, std::numeric_limits<double>::infinity()).least; }

  /// The raster of a rule that is one; null for other rules.
  virtual const Raster* raster() const { return nullptr; }
  /// The field whose nodes a limit of the gradient considers besides those of a regular raster: the
  /// rule's own; null for rules without one.
  virtual const RasterField* field() const { return nullptr; }

  /// The rule with a limited gradient, if that needs no other raster; else null.
  virtual std::shared_ptr<const WidthRule> limited(double gradient, double radius_km) const;
};

/// A rule of widths or of shares as a function of the radius of its sphere. It keeps the last rule
/// that it made, so that combined rules share it. Thread-safe.
template <class Rule> class OfRadius {
public:
  using Make = std::function<std::shared_ptr<const Rule>(double radius_km)>;

  OfRadius(RuleSpace space, Make make) : space_(space), make_(std::move(make)) {}
  /// Makes the function of a rule that does not depend on the radius.
  explicit OfRadius(std::shared_ptr<const Rule> rule)
      : OfRadius(rule->space(), [rule](double) { return rule; }) {}

  RuleSpace space() const { return space_; }

  std::shared_ptr<const Rule> operator()(double radius_km) const {
    const std::lock_guard lock(mutex_);
    if (rule_ == nullptr || radius_km != radius_km_) {
      // Isolated: another task of the caller that this thread took up could request the same rule.
      tbb::this_task_arena::isolate([&] { rule_ = make_(radius_km); });
      radius_km_ = radius_km;
    }
    return rule_;
  }

private:
  RuleSpace space_;
  Make make_;
  mutable std::mutex mutex_; ///< guards the members below: the last rule requested
  mutable double radius_km_ = 0;
  mutable std::shared_ptr<const Rule> rule_;
};

using WidthsOfRadius = OfRadius<WidthRule>;
using SharesOfRadius = OfRadius<ShareRule>;

/// A rule by the distance from lines, which is negative at points where `is_behind` is true.
/// \param lines closed boundaries of these points.
///
/// \param curve by the distance, on the sphere in km.
///
/// \param surface the sphere or a plane.
/// \throws Error invalid_argument as Widths::by_distance().
std::shared_ptr<const WidthsOfRadius> rule_of_sides(const std::vector<Points3>& lines,
                                                    std::function<bool(const Vec3&)> is_behind,
                                                    const ProfileCurve& curve,
                                                    const Surface& surface = {});
/// The same with a share by the distance.
std::shared_ptr<const SharesOfRadius> share_of_sides(const std::vector<Points3>& lines,
                                                     std::function<bool(const Vec3&)> is_behind,
                                                     const ProfileCurve& curve,
                                                     const Surface& surface = {});

/// Refuses a point at which no rule gives a width. \param x, y degrees, or in a plane its unit.
[[noreturn]] void refuse_point(double x, double y, bool of_plane);

/// A rule that interpolates the values of a raster; no demand next to a node without one.
std::shared_ptr<const WidthRule> rule_of_field(const Raster& raster);

/// A rule with a limited gradient, nowhere above the given rule.
/// \param radius_km for which the rule was made.
/// \throws Error invalid_argument for a rule of a plane that needs a raster.
std::shared_ptr<const WidthRule> limited(const std::shared_ptr<const WidthRule>& rule,
                                         double gradient, double radius_km);

/// The step of a raster that resolves the least width of a rule on a sphere, degrees.
double step_for(const WidthRule& rule, double radius_km);
/// The widths of a rule at the nodes of a raster of the sphere.
Raster sample(const WidthRule& rule, double step);
/// The largest width at the corners of a surface.
/// \throws Error invalid_argument for a corner without a demand.
double widest_at_corners(const Widths& widths, const Surface& surface);

/// The raster of sampled(), with Widths::no_demand where there is none. \throws Error as there.
Raster sample(const Widths& widths, const Surface& surface, double step);

} // namespace calotte::density_detail
