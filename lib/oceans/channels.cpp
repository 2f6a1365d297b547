// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/elementary.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "density/disc_rule.h"
#include "density/raster_field.h"
#include "oceans/coast_sides.h"

#include <calotte/delaunay.h>
#include <calotte/widths.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

// The circumcentres of the Delaunay triangles of points along the coast sample the medial axis of
// the sea: the points with two or more nearest points of the coast.

namespace calotte {
namespace oceans_detail {
namespace {

using base_detail::arc_sine;
using density_detail::Disc;
using domain_detail::for_each_short_part;

/// Points along the lines of a coast.
struct CoastPoints {
  struct Position {
    std::int32_t line;
    double along; ///< position along the line, radians
  };
  Points3 points;
  std::vector<Position> positions;
  std::vector<double> lengths; ///< by line, radians
};

/// \param step the largest distance between neighbours, radians.
CoastPoints points_along(const std::vector<CoastArc>& arcs, double step) {
  constexpr double most = 20e6;
  double length = 0;
  for (const auto& [arc, line] : arcs)
    length += norm(arc.to - arc.from);
  require(length / step < most, "the least width cuts the coast into more than 20 million pieces; "
                                "give a larger one");
  std::vector<Vec3> points;
  CoastPoints all;
  all.lengths.resize(static_cast<std::size_t>(arcs.back().line) + 1);
  for (const auto& [arc, line] : arcs)
    for_each_short_part(arc, step, [&, number = line](const Arc& part) {
      double& along = all.lengths[static_cast<std::size_t>(number)];
      points.push_back(part.from);
      all.positions.push_back({number, along});
      along += 2 * arc_sine(0.5 * norm(part.to - part.from));
    });
  all.points.resize(3, std::ssize(points));
  for (std::size_t k = 0; k < points.size(); ++k)
    set_column(all.points, static_cast<std::int64_t>(k), points[k]);
  return all;
}

/// The circle through three points of the coast.
struct Circle {
  std::array<std::int32_t, 3> points;
  Vec3 centre;
  double chord, radius; ///< from the centre to a point: straight, and along the sphere, radians
};

Circle circle_through(const CoastPoints& coast, const std::array<std::int32_t, 3>& points) {
  const Vec3 &a = column(coast.points, points[0]), &b = column(coast.points, points[1]),
             &c = column(coast.points, points[2]);
  const Vec3 centre = normalised(cross(b - a, c - a));
  const double chord = norm(centre - a);
  return {points, centre, chord, 2 * arc_sine(std::min(1.0, 0.5 * chord))};
}

/// The length of the coast between two points; infinite if they are on different lines.
double length_between(const CoastPoints& coast, std::int32_t a, std::int32_t b) {
  const CoastPoints::Position &from = coast.positions[static_cast<std::size_t>(a)],
                              &to = coast.positions[static_cast<std::size_t>(b)];
  if (from.line != to.line)
    return std::numeric_limits<double>::infinity();
  const double way = std::abs(from.along - to.along);
  return std::min(way, coast.lengths[static_cast<std::size_t>(from.line)] - way);
}

/// Whether a circle without points inside lies in a channel: two of its points are far apart both
/// around the circle and along the coast.
bool lies_across(const Circle& circle, const CoastPoints& coast) {
  constexpr double apart_around =
      3; // the square of the chord of 120 degrees, of a circle of radius 1
  constexpr double apart_along = 6; // in radii
  const double square = circle.chord * circle.chord,
               flat = square * (1 - 0.25 * square); // of the radius in the circle's plane
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t a = circle.points[k], b = circle.points[(k + 1) % 3];
    const Vec3 apart = column(coast.points, a) - column(coast.points, b);
    if (dot(apart, apart) > apart_around * flat &&
        length_between(coast, a, b) > apart_along * circle.radius)
      return true;
  }
  return false;
}

/// By site of a mesh, the index of its first input point.
std::vector<std::int32_t> first_inputs(const Mesh& mesh) {
  std::vector<std::int32_t> inputs(static_cast<std::size_t>(mesh.points.cols()), -1);
  for (std::size_t k = mesh.site_of_input.size(); k-- > 0;)
    inputs[static_cast<std::size_t>(mesh.site_of_input[k])] = static_cast<std::int32_t>(k);
  return inputs;
}

/// \param step of the points, radians.
std::vector<Disc> find_discs(const CoastPoints& coast, const CoastSides& sides,
                             const ChannelRule& rule, double step, double radius_km) {
  const Mesh mesh = delaunay(coast.points);
  const std::vector<std::int32_t> inputs = first_inputs(mesh);
  const auto input = [&](std::int32_t site) { return inputs[static_cast<std::size_t>(site)]; };
  const std::int64_t count = mesh.triangles.cols();
  std::vector<std::vector<Disc>> of_block(static_cast<std::size_t>(block_count(count)));
  for_each_block(count, [&](std::int64_t block, std::int64_t from, std::int64_t to) {
    for (std::int64_t t = from; t != to; ++t) {
      const auto corners = mesh.triangles.col(t);
      const Circle circle =
          circle_through(coast, {input(corners[0]), input(corners[1]), input(corners[2])});
      const double width = 2 * radius_km * circle.radius;
      if (width <= rule.widest && lies_across(circle, coast) && sides.is_sea(circle.centre))
        of_block[static_cast<std::size_t>(block)].push_back(
            // The disc is slightly larger than the circle: the coast between two circles is in
            // neither.
            {circle.centre, circle.radius + 0.25 * step, std::max(rule.least, width / rule.cells)});
    }
  });
  std::vector<Disc> all;
  for (const std::vector<Disc>& some : of_block)
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

} // namespace
} // namespace oceans_detail

Widths Widths::by_channel(const Coast& coast, const ChannelRule& rule) {
  using namespace oceans_detail;
  density_detail::require_positive(rule.cells, "number of cells", "channels");
  density_detail::require_positive(rule.least, "least width", "channels");
  density_detail::require_positive(rule.widest, "widest channel", "channels");
  const std::vector<CoastArc> arcs = coast_arcs(coast);
  if (arcs.empty())
    return no_demand;
  const auto sides = std::make_shared<const CoastSides>(arcs);
  const auto make = [arcs, sides, rule](double radius_km) {
    // The circles through points that are an eighth of their width apart err by less than 1/100.
    const double step = std::min(rule.cells * rule.least, rule.widest) / 8 / radius_km;
    return std::make_shared<density_detail::DiscRule>(
        find_discs(points_along(arcs, step), *sides, rule, step, radius_km));
  };
  return Widths(
      std::make_shared<density_detail::WidthsOfRadius>(density_detail::RuleSpace::sphere, make));
}

} // namespace calotte
