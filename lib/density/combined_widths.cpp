// SPDX-License-Identifier: GPL-3.0-or-later
// Rules that combine others: their minimum, a blend, a limit of the gradient.
#include "density/width_rules.h"

#include "base/require.h"
#include "density/gradient_limit.h"
#include "density/width_cones.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte {
namespace density_detail {
namespace {

using Rule = std::shared_ptr<const WidthRule>;

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
  const Rule raster = Widths(limit_gradient(nodes, gradient, {}, radius_km)).rule();
  return std::make_shared<CombinedRule>(std::vector<Rule>{rule, raster}, least_of);
}

} // namespace density_detail

using namespace density_detail;

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

} // namespace calotte
