// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/message.h"
#include "base/parallel.h"
#include "base/require.h"
#include "density/raster_field.h"
#include "density/sampled_widths.h"
#include "density/width_rules.h"
#include "density/width_tiles.h"
#include "domain/near_boundary.h"
#include "domain/surface.h"

#include <calotte/widths.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

// Evaluates rules at nodes: at those of tiles, which a run uses, and of regular rasters.

namespace calotte {
namespace density_detail {
namespace {

/// The box that a raster of a plane covers.
struct PlaneBox {
  Eigen::Vector2d low, size;
};

PlaneBox box_of(const Surface& plane) {
  if (!plane.is_bounded())
    return {Eigen::Vector2d::Zero(), plane.period()};
  const Box2& box = domain_detail::outline_of<Plane>(plane)->box();
  return {{box.low.x, box.low.y}, {box.high.x - box.low.x, box.high.y - box.low.y}};
}

/// A raster of a width that is the same everywhere.
Raster one_width(double width, const Surface& surface) {
  constexpr double far = 1e30; // the largest coordinate of a domain
  const bool plane = !surface.is_sphere();
  return {plane ? DoubleVector{{-far, far}} : DoubleVector{{0, 180}},
          plane ? DoubleVector{{-far, far}} : DoubleVector{{-90, 90}},
          DoubleMatrix::Constant(2, 2, width), plane};
}

/// \throws Error invalid_argument for rules of another kind than a surface.
void require_kind_of(const WidthRule& rule, const Surface& surface) {
  if (surface.is_sphere()) {
    require(rule.space() != RuleSpace::plane,
            "the widths are those of a plane; give the domain that they are for");
    return;
  }
  domain_detail::require_finite_plane(surface);
  require(rule.space() != RuleSpace::sphere,
          "the widths are those of the sphere; give rules of a plane");
}

Raster sample_on_sphere(const Widths& widths, double step) {
  require(step == 0 || (step >= 0.01 && step <= 10),
          "the step {} of a raster is out of range; give 0.01 to 10 degrees", step);
  const std::shared_ptr<const WidthRule> rule = widths.rule();
  return sample(*rule, step == 0 ? step_for(*rule, widths.radius_km()) : step);
}

Raster sample_in_plane(const Widths& widths, const Surface& plane, double step) {
  const std::shared_ptr<const WidthRule> rule = widths.rule();
  const PlaneBox box = box_of(plane);
  constexpr double most_nodes = 2e7, usual_nodes = 4e6;
  require(step == 0 ||
              (step > 0 && (box.size[0] / step + 1) * (box.size[1] / step + 1) <= most_nodes),
          "the step {} of a raster is not positive, or gives more than {} nodes; give another one",
          step, most_nodes);
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
    require_kind(given->of_plane, surface);
    return *given;
  }
  if (rule->space() == RuleSpace::any && step == 0)
    return one_width(rule->least(), surface);
  require_kind_of(*rule, surface);
  return surface.is_sphere() ? sample_on_sphere(widths, step)
                             : sample_in_plane(widths, surface, step);
}

void refuse_point(double x, double y, bool of_plane) {
  refuse(message("no rule gives a width at {} {}, {} {}; "
                 "add one that holds everywhere, such as a number",
                 of_plane ? "x" : "longitude", x, of_plane ? "y" : "latitude", y));
}

namespace {

/// Gives nodes outside a surface without a demand the largest width of the others.
/// \param for_each_node calls body(x, y, width) for nodes in a fixed order, degrees on the sphere.
/// \throws Error invalid_argument for a node inside without a demand; if no node is inside, for a
/// corner without one.
template <class ForEachNode>
void fill_outside(const Widths& widths, const Surface& surface, const ForEachNode& for_each_node) {
  const bool of_plane = !surface.is_sphere();
  double widest = 0;
  bool has_node = false; // inside
  for_each_node([&](double x, double y, double& width) {
    const bool asks = Widths::is_demand(width);
    if (asks)
      widest = std::max(widest, width);
    if (asks && has_node)
      return;
    const Vec3 at = point_at(x, y, of_plane);
    if (surface.is_bounded() && !surface.contains({at.x, at.y, at.z}))
      return;
    if (!asks)
      refuse_point(x, y, of_plane);
    has_node = true;
  });
  if (!has_node) // all of the surface lies between nodes
    widest = std::max(widest, widest_at_corners(widths, surface));
  for_each_node([&](double, double, double& width) {
    if (!Widths::is_demand(width))
      width = widest;
  });
}

void fill_outside(const Widths& widths, const Surface& surface, Raster& raster) {
  if (!raster.values.allFinite())
    fill_outside(widths, surface, [&](const auto& body) {
      for (Eigen::Index j = 0; j < raster.y.size(); ++j)
        for (Eigen::Index i = 0; i < raster.x.size(); ++i)
          body(raster.x[i], raster.y[j], raster.values(i, j));
    });
}

// ---- Tiles

constexpr std::int32_t most_intervals = 1024; // of a tile in one direction

/// The number of intervals of a length for nodes at most a distance apart, a power of two.
std::int32_t intervals_for(double length, double apart) {
  std::int32_t intervals = 1;
  while (intervals < most_intervals && length > apart * intervals)
    intervals *= 2;
  return intervals;
}

/// The demand of a tile: its extent in widths.
struct TileDemand {
  double across = 1, up = 1;
  bool outside = false; ///< it has no point in a bounded surface
};

/// \param unit km a radian, in a plane 1.
TileDemand estimate_demand(const WidthRule& rule, const Extent& tile, double unit) {
  constexpr double flat = 1e-3; // a change of widths that corners tell well enough
  constexpr double silent = 8;  // parts, whose corners may lie in a bounded surface
  const Bounds widths = rule.bounds(tile.middle, tile.reach);
  if (!Widths::is_demand(widths.least))
    return {silent, silent};
  if (widths.greatest <= (1 + flat) * widths.least)
    return {};
  return {tile.width * unit / widths.least, tile.height * unit / widths.least};
}

/// The shapes of tiles for nodes at most `apart` widths apart.
std::vector<WidthTiles::Shape> shapes_for(const std::vector<TileDemand>& demands, double apart) {
  std::vector<WidthTiles::Shape> shapes;
  for (const TileDemand& demand : demands)
    shapes.push_back(
        {intervals_for(demand.across, apart), intervals_for(demand.up, apart), demand.outside});
  return shapes;
}

/// The shapes of tiles with at most so many nodes in all. They meet the demands, or all are coarser
/// by the same factor.
std::vector<WidthTiles::Shape> shapes_within(const std::vector<TileDemand>& demands, double most) {
  constexpr double factor = 1.1;
  for (double apart = 1;; apart *= factor) {
    std::vector<WidthTiles::Shape> shapes = shapes_for(demands, apart);
    double nodes = 0;
    for (const WidthTiles::Shape& shape : shapes)
      nodes += (shape.columns + 1.0) * (shape.rows + 1.0);
    if (nodes <= most)
      return shapes;
  }
}

/// The largest distance of nodes, in widths; at least 1.
double apart_in(const std::vector<TileDemand>& demands,
                const std::vector<WidthTiles::Shape>& shapes) {
  double apart = 1;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (!shapes[k].outside)
      apart =
          std::max({apart, demands[k].across / shapes[k].columns, demands[k].up / shapes[k].rows});
  return apart;
}

/// Whether no point of a tile is in a surface.
bool lies_outside(const Extent& tile, const Surface& surface) {
  const Vec3& at = tile.middle;
  return surface.is_bounded() && !domain_detail::is_near_boundary(surface, at, tile.reach) &&
         !surface.contains({at.x, at.y, at.z});
}

SampledWidths sample_tiles(const Widths& widths, const TileBox& box, const Surface& surface) {
  constexpr double most_nodes = 4e7;
  const std::shared_ptr<const WidthRule> rule = widths.rule();
  const double unit = box.of_plane ? 1 : widths.radius_km();
  std::vector<TileDemand> demands(static_cast<std::size_t>(std::int64_t{box.columns} * box.rows));
  base_detail::for_each_task(std::ssize(demands), [&](std::int64_t k) {
    const Extent tile = extent_of(box.tile(k), box.of_plane);
    TileDemand& demand = demands[static_cast<std::size_t>(k)];
    if (lies_outside(tile, surface))
      demand.outside = true;
    else
      demand = estimate_demand(*rule, tile, unit);
  });
  const std::vector<WidthTiles::Shape> shapes = shapes_within(demands, most_nodes);
  WidthTiles tiles(box, shapes);
  base_detail::for_each_task(tiles.size(), [&](std::int64_t k) {
    const std::vector<Vec3> points = tiles.points(k);
    const std::vector<std::int32_t> order = tiles.near_order(k);
    std::vector<Vec3> near;
    near.reserve(order.size());
    for (const std::int32_t node : order)
      near.push_back(points[static_cast<std::size_t>(node)]);
    std::vector<double> widths(near.size());
    rule->evaluate(near, widths);
    for (std::size_t i = 0; i < order.size(); ++i)
      tiles.values(k)[order[i]] = widths[i];
  });
  const bool whole = std::all_of(tiles.values().begin(), tiles.values().end(),
                                 [](double width) { return Widths::is_demand(width); });
  if (!whole)
    fill_outside(widths, surface, [&](const auto& body) {
      for (std::int64_t k = 0; k < tiles.size(); ++k)
        tiles.for_each_node(k, body);
    });
  tiles.join_edges();
  return {std::move(tiles), apart_in(demands, shapes)};
}

/// Divides the box of a plane into some thousand nearly square tiles.
TileBox tiles_of_plane(const Surface& plane) {
  constexpr double tiles = 4096, most = 16384; // in all, and in a row
  const PlaneBox box = box_of(plane);
  const double size = std::max(std::sqrt(box.size.prod() / tiles), box.size.maxCoeff() / most);
  const auto count = [&](int k) {
    return static_cast<std::int32_t>(std::max(1.0, std::round(box.size[k] / size)));
  };
  const std::int32_t columns = count(0), rows = count(1);
  const bool whole = !plane.is_bounded(); // of a periodic box
  return {.west = box.low[0],
          .dx = box.size[0] / columns,
          .south = box.low[1],
          .dy = box.size[1] / rows,
          .columns = columns,
          .rows = rows,
          .of_plane = true,
          .around_x = whole && plane.period().x() > 0,
          .around_y = whole && plane.period().y() > 0};
}

} // namespace

double widest_at_corners(const Widths& widths, const Surface& surface) {
  double widest = 0;
  for (DoubleMatrix ring : surface.rings()) {
    if (surface.is_sphere())
      for (auto corner : ring.colwise())
        corner /= corner.norm();
    const DoubleVector there = evaluate(widths, ring);
    for (Eigen::Index i = 0; i < ring.cols(); ++i)
      if (!Widths::is_demand(there[i])) {
        if (!surface.is_sphere())
          refuse_point(ring(0, i), ring(1, i), true);
        const auto [longitude, latitude] =
            base_detail::lonlat_of({ring(0, i), ring(1, i), ring(2, i)});
        refuse_point(longitude, latitude, false);
      }
    widest = std::max(widest, there.maxCoeff());
  }
  return widest;
}

} // namespace density_detail

WidthField width_field(const Widths& widths, const Surface& surface) {
  using namespace density_detail;
  const std::shared_ptr<const WidthRule> rule = widths.rule();
  if (const Raster* const given = rule->raster()) {
    require_covering(*given, surface);
    return *given;
  }
  if (rule->space() == RuleSpace::any) {
    Raster raster = one_width(rule->least(), surface);
    fill_outside(widths, surface, raster);
    return raster;
  }
  require_kind_of(*rule, surface);
  return WidthField(std::make_shared<const SampledWidths>(sample_tiles(
      widths, surface.is_sphere() ? tiles_of_sphere() : tiles_of_plane(surface), surface)));
}

Raster sampled(const Widths& widths, const Surface& surface, double step) {
  Raster raster = density_detail::sample(widths, surface, step);
  density_detail::fill_outside(widths, surface, raster);
  return raster;
}

Widths Widths::with_step(double step) const {
  base_detail::require(step > 0 && std::isfinite(step),
                       "the step {} of a raster is not a positive number; give one", step);
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
