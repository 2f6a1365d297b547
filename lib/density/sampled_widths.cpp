// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/require.h"
#include "density/raster_field.h"
#include "density/width_rules.h"
#include "domain/surface.h"

#include <calotte/widths.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

// Rasters of rules.

namespace calotte {
namespace density_detail {
namespace {

using base_detail::require;
using base_detail::shortly;

/// What a raster of a plane covers.
struct PlaneBox {
  Eigen::Vector2d low, size;
};

PlaneBox box_of(const Surface& plane) {
  if (!plane.is_bounded())
    return {Eigen::Vector2d::Zero(), plane.period()};
  const Box2& box = domain_detail::outline_of<Plane>(plane)->box();
  return {{box.low.x, box.low.y}, {box.high.x - box.low.x, box.high.y - box.low.y}};
}

/// Of a width that is the same everywhere.
Raster one_width(double width, const Surface& surface) {
  constexpr double far = 1e30; // the largest coordinate of a domain
  const bool plane = !surface.is_sphere();
  return {plane ? DoubleVector{{-far, far}} : DoubleVector{{0, 180}},
          plane ? DoubleVector{{-far, far}} : DoubleVector{{-90, 90}},
          DoubleMatrix::Constant(2, 2, width), plane};
}

Raster sample_on_sphere(const Widths& widths, double step) {
  require(step == 0 || (step >= 0.01 && step <= 10),
          "the step " + shortly(step) + " of a raster is out of range; give 0.01 to 10 degrees");
  const std::shared_ptr<const WidthRule> rule = widths.rule();
  return sample(*rule, step == 0 ? step_for(*rule, widths.radius_km()) : step);
}

Raster sample_in_plane(const Widths& widths, const Surface& plane, double step) {
  domain_detail::require_finite_plane(plane);
  const std::shared_ptr<const WidthRule> rule = widths.rule();
  require(rule->space() != RuleSpace::sphere,
          "the widths are those of the sphere; give rules of a plane");
  const PlaneBox box = box_of(plane);
  constexpr double most_nodes = 2e7, usual_nodes = 4e6;
  require(step == 0 ||
              (step > 0 && (box.size[0] / step + 1) * (box.size[1] / step + 1) <= most_nodes),
          "the step " + shortly(step) + " of a raster is not positive, or gives more than " +
              shortly(most_nodes) + " nodes; give another one");
  Raster raster = step > 0
                      ? grid_over(box.low, box.size, step, 2 * most_nodes)
                      : grid_over(box.low, box.size,
                                  std::min(rule->least() / 2, box.size.maxCoeff()), usual_nodes);
  base_detail::for_each_task(raster.y.size(), [&](std::int64_t j) {
    std::vector<Vec3> row;
    for (const double x : raster.x)
      row.push_back({x, raster.y[j], 0});
    rule->evaluate(row, {raster.values.col(j).data(), row.size()});
  });
  return raster;
}

} // namespace

double step_for(const WidthRule& rule, double radius_km) {
  constexpr double finest = 0.05, coarsest = 1, degrees = 180 / std::numbers::pi;
  return std::clamp(rule.least() / radius_km * degrees, finest, coarsest);
}

Raster sample(const WidthRule& rule, double step) {
  require(rule.space() != RuleSpace::plane,
          "the widths are those of a plane; give the domain that they are for");
  Raster raster = regular_grid(step);
  const Eigen::Index columns = raster.x.size();
  std::vector<double> zeros(static_cast<std::size_t>(columns), 0);
  std::vector<Vec3> round(static_cast<std::size_t>(columns));
  base_detail::from_lonlats(raster.x.data(), zeros.data(), columns, round.data());
  base_detail::for_each_task(raster.y.size(), [&](std::int64_t j) {
    const Vec3 meridian = base_detail::from_lonlat(0, raster.y[j]);
    std::vector<Vec3> row;
    for (const Vec3& at : round)
      row.push_back({meridian.x * at.x, meridian.x * at.y, meridian.z});
    rule.evaluate(row, {raster.values.col(j).data(), row.size()});
  });
  return raster;
}

Raster sample(const Widths& widths, const Surface& surface, double step) {
  if (step == 0)
    step = widths.step();
  const std::shared_ptr<const WidthRule> rule = widths.rule();
  if (const Raster* const given = rule->raster(); given != nullptr && step == 0) {
    require_kind(*given, surface);
    return *given;
  }
  if (rule->space() == RuleSpace::any && step == 0)
    return one_width(rule->least(), surface);
  return surface.is_sphere() ? sample_on_sphere(widths, step)
                             : sample_in_plane(widths, surface, step);
}

namespace {

[[noreturn]] void refuse_place(double x, double y, bool of_plane) {
  base_detail::refuse("no rule gives a width at " +
                      (of_plane ? "x " + shortly(x) + ", y " + shortly(y)
                                : "longitude " + shortly(x) + ", latitude " + shortly(y)) +
                      "; add one that holds everywhere, such as a number");
}

/// \throws Error invalid_argument for a corner of the surface without a demand.
void require_corners(const Widths& widths, const Surface& surface) {
  for (const DoubleMatrix& ring : surface.rings()) {
    const DoubleVector there = evaluate(widths, ring);
    for (Eigen::Index i = 0; i < ring.cols(); ++i)
      if (!Widths::is_demand(there[i])) {
        if (!surface.is_sphere())
          refuse_place(ring(0, i), ring(1, i), true);
        const auto [longitude, latitude] =
            base_detail::lonlat_of({ring(0, i), ring(1, i), ring(2, i)});
        refuse_place(longitude, latitude, false);
      }
  }
}

/// Gives nodes outside a surface without a demand the largest width of the others.
/// \throws Error invalid_argument for one inside; where none is inside, for a corner.
void fill_outside(const Widths& widths, const Surface& surface, Raster& raster) {
  if (raster.values.allFinite())
    return;
  const auto is_inside = [&](double x, double y) {
    if (!surface.is_bounded())
      return true;
    const Vec3 at = raster.of_plane ? Vec3{x, y, 0} : base_detail::from_lonlat(x, y);
    return surface.contains({at.x, at.y, at.z});
  };
  double widest = 0;
  bool has_node = false; // inside
  for (Eigen::Index j = 0; j < raster.y.size(); ++j)
    for (Eigen::Index i = 0; i < raster.x.size(); ++i) {
      const double width = raster.values(i, j), x = raster.x[i], y = raster.y[j];
      const bool asks = Widths::is_demand(width);
      if (asks)
        widest = std::max(widest, width);
      if ((asks && has_node) || !is_inside(x, y))
        continue;
      if (!asks)
        refuse_place(x, y, raster.of_plane);
      has_node = true;
    }
  if (!has_node)
    require_corners(widths, surface);
  if (widest == 0) // all of the surface lies between nodes
    refuse_place(raster.x[0], raster.y[0], raster.of_plane);
  raster.values = raster.values.unaryExpr(
      [&](double width) { return Widths::is_demand(width) ? width : widest; });
}

} // namespace
} // namespace density_detail

Raster sampled(const Widths& widths, const Surface& surface, double step) {
  Raster raster = density_detail::sample(widths, surface, step);
  density_detail::fill_outside(widths, surface, raster);
  return raster;
}

Widths Widths::with_step(double step) const {
  base_detail::require(step > 0 && std::isfinite(step),
                       "the step " + base_detail::shortly(step) +
                           " of a raster is not a positive number; give one");
  Widths widths = *this;
  widths.step_ = step;
  return widths;
}

Widths Widths::limit_gradient(double gradient, const Surface& surface) const {
  if (surface.is_sphere() || rule_of_radius_->space() == density_detail::RuleSpace::any)
    return limit_gradient(gradient);
  Raster raster =
      calotte::limit_gradient(density_detail::sample(*this, surface, 0), gradient, surface);
  density_detail::fill_outside(*this, surface, raster);
  return raster;
}

} // namespace calotte
