// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/room.h"

#include <calotte/widths.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace calotte::density_detail {

class RasterField;

/// Where a rule gives widths: a number, and what is made of numbers, does everywhere the same.
enum class RuleSpace { any, sphere, plane };

/// A width for every place. Immutable.
class WidthRule {
public:
  explicit WidthRule(RuleSpace space = RuleSpace::sphere) : space_(space) {}
  WidthRule(const WidthRule&) = delete;
  WidthRule& operator=(const WidthRule&) = delete;
  virtual ~WidthRule() = default;

  RuleSpace space() const { return space_; }

  /// \param places unit vectors, in a plane x y 0. Where each lies next to the one before, it takes
  /// less time.
  virtual void evaluate(std::span<const Vec3> places, std::span<double> widths) const = 0;

  /// By place the part of a minimum that is the least, by index; 0 of other rules.
  virtual void find_active(std::span<const Vec3> places, std::span<std::int32_t> active) const;

  /// A bound from below of all widths, km, > 0.
  virtual double least() const = 0;

  /// The raster whose values the rule gives; null for other rules.
  virtual const RasterField* raster() const { return nullptr; }

  /// The rule with a limited gradient if no raster is needed for that; else null.
  virtual std::shared_ptr<const WidthRule> limited(double gradient, double radius_km) const;

private:
  RuleSpace space_;
};

/// A rule as a function of the radius of its sphere. What it makes for a radius it keeps, so that
/// rules that are made of others share it. Threads may ask at once.
class RuleOfRadius {
public:
  using Make = std::function<std::shared_ptr<const WidthRule>(double radius_km)>;

  RuleOfRadius(RuleSpace space, Make make) : space_(space), make_(std::move(make)) {}
  /// Of a rule that depends on no radius.
  explicit RuleOfRadius(std::shared_ptr<const WidthRule> rule)
      : RuleOfRadius(rule->space(), [rule](double) { return rule; }) {}

  RuleSpace space() const { return space_; }
  std::shared_ptr<const WidthRule> operator()(double radius_km) const;

private:
  RuleSpace space_;
  Make make_;
  mutable std::mutex mutex_; ///< of what follows: the last one that was asked for
  mutable double radius_km_ = 0;
  mutable std::shared_ptr<const WidthRule> rule_;
};

/// A rule by the distance from lines, which is negative at places where `is_behind` is true.
/// \param lines closed boundaries of these places.
///
/// \param profile of the distance, on the sphere in km.
///
/// \param surface the sphere or a plane.
/// \throws Error invalid_argument as Widths::by_distance().
std::shared_ptr<const RuleOfRadius> rule_of_sides(const std::vector<Points3>& lines,
                                                  std::function<bool(const Vec3&)> is_behind,
                                                  const WidthProfile& profile,
                                                  const Surface& surface = {});

/// Any rule with a limited gradient: nowhere above the rule.
/// \param radius_km for which the rule was made.
/// \throws Error invalid_argument for a rule of a plane that needs a raster.
std::shared_ptr<const WidthRule> limited(const std::shared_ptr<const WidthRule>& rule,
                                         double gradient, double radius_km);

/// The step of a raster for the least width of a rule on a sphere, degrees.
double step_for(const WidthRule& rule, double radius_km);
/// The widths of a rule at the nodes of a raster of the sphere.
Raster sample(const WidthRule& rule, double step);
/// The raster of sampled(). \throws Error as there, but for places without a demand.
Raster sample(const Widths& widths, const Surface& surface, double step);
/// Gives nodes outside a surface without a demand the largest width of the others.
/// \throws Error invalid_argument for one inside.
void fill_outside(Raster& raster, const Surface& surface);

} // namespace calotte::density_detail
