// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/generators.h>

#include "base/points.h"
#include "base/require.h"
#include "density/demanded_spacing.h"
#include "domain/along_boundary.h"
#include "domain/outline.h"
#include "domain/spherical_outline.h"
#include "domain/surface.h"
#include "generators/boundary.h"
#include "generators/curve.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace generators_detail;
using base_detail::require;

/// A part of a boundary, with the surface to its left.
template <Space S>
Curve<S> curve_of(const Surface& surface, const std::vector<Vec3>& corners, bool closed,
                  const DemandedSpacing& spacing) {
  std::vector<Segment> segments;
  for (std::size_t k = 0; k + (closed ? 0 : 1) < corners.size(); ++k)
    segments.push_back({corners[k], corners[(k + 1) % corners.size()]});
  return {spacing, longest_step<S>(surface), std::move(segments), closed};
}

template <Space S>
std::vector<Curve<S>> make_curves(const Surface& surface, const DemandedSpacing& spacing) {
  std::vector<Curve<S>> curves;
  for (const std::vector<Vec3>& ring : outline_of<S>(surface)->rings())
    curves.push_back(curve_of<S>(surface, ring, true, spacing));
  return curves;
}

/// The point after a number of edges, not outside by rounding.
template <Space S> Vec3 point_at(const Curve<S>& curve, const OutlineOf<S>& outline, double stop) {
  const auto [point, segment] = curve.position(stop);
  return domain_detail::pushed_inside<S>(outline, point,
                                         domain_detail::left_of<S>(curve.segments()[segment]));
}

/// The generators along a part of a boundary, without the ends of an open one.
template <Space S>
std::vector<Vec3> points_along(const Curve<S>& curve, const OutlineOf<S>& outline) {
  const std::vector<double> stops = curve.stops(true);
  const std::size_t ends = curve.is_closed() ? 0 : 1;
  std::vector<Vec3> points;
  for (std::size_t k = ends; k + ends < stops.size(); ++k)
    points.push_back(point_at<S>(curve, outline, stops[k]));
  return points;
}

/// The number of cells of a lattice without a boundary that has the spacing of n generators, b of
/// which are on the boundary and have half a cell each. b is inversely proportional to the spacing:
/// with b_0 edges at the spacing of n whole cells, the ratio s of the spacings satisfies n s^2 -
/// b_0 s / 2 - n = 0.
double whole_cells(double n, double edges) {
  const double s = (edges / 2 + std::sqrt(edges * edges / 4 + 4 * n * n)) / (2 * n);
  return n / (s * s);
}

/// A generator of a ring: its position in edges, and its id.
struct Stop {
  double edges;
  std::int32_t id;
};

/// The stops of a ring with others in the middle between them. \param next_id of the first of
/// these.
std::vector<Stop> halved(const std::vector<Stop>& ring, double length, std::int32_t next_id) {
  std::vector<Stop> out;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const double from = ring[k].edges,
                 to = k + 1 < ring.size() ? ring[k + 1].edges : ring[0].edges + length,
                 middle = from + (to - from) / 2;
    out.push_back(ring[k]);
    out.push_back({middle < length ? middle : middle - length, next_id++});
  }
  return out;
}

BoundaryPoints linked(const std::vector<Vec3>& positions,
                      const std::vector<std::vector<Stop>>& rings) {
  BoundaryPoints out;
  out.points.resize(3, std::ssize(positions));
  for (std::size_t i = 0; i < positions.size(); ++i)
    base_detail::set_column(out.points, static_cast<std::int64_t>(i), positions[i]);
  out.next.resize(positions.size());
  for (const std::vector<Stop>& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k)
      out.next[static_cast<std::size_t>(ring[k].id)] = ring[(k + 1) % ring.size()].id;
  return out;
}

template <Space S>
std::vector<BoundaryPoints> points_on_boundary(const Surface& surface, std::int64_t cells,
                                               const Density& density, int halvings) {
  constexpr std::int64_t samples = 65536;
  const auto n = static_cast<double>(cells);
  double edges = 0;
  const DemandedSpacing of_all(surface, density, n, samples);
  for (const Curve<S>& curve : make_curves<S>(surface, of_all))
    edges += curve.edges();
  const DemandedSpacing spacing(surface, density, whole_cells(n, edges), samples);
  const std::vector<Curve<S>> curves = make_curves<S>(surface, spacing);
  std::vector<Vec3> positions;
  std::vector<std::vector<Stop>> rings(curves.size());
  const auto place = [&](std::size_t ring) { // those that have an id beyond the positions
    for (const Stop& stop : rings[ring])
      if (stop.id >= std::ssize(positions))
        positions.push_back(point_at<S>(curves[ring], *outline_of<S>(surface), stop.edges));
  };
  const auto next_id = [&] { return static_cast<std::int32_t>(positions.size()); };
  for (std::size_t ring = 0; ring < curves.size(); ++ring) {
    require(curves[ring].edges() > 0,
            "the density is zero along ring {} of the boundary; make it positive", ring);
    std::int32_t id = next_id();
    for (const double stop : curves[ring].stops(true))
      rings[ring].push_back({stop, id++});
    place(ring);
  }
  std::vector<BoundaryPoints> out{linked(positions, rings)};
  for (int k = 0; k < halvings; ++k) {
    for (std::size_t ring = 0; ring < curves.size(); ++ring) {
      rings[ring] = halved(rings[ring], curves[ring].edges(), next_id());
      place(ring);
    }
    out.push_back(linked(positions, rings));
  }
  return out;
}

} // namespace

std::vector<BoundaryPoints> generators_detail::halved_boundary_points(const Surface& surface,
                                                                      std::int64_t cells,
                                                                      const Density& density,
                                                                      int halvings) {
  base_detail::require_count(cells, 4, "the number of cells");
  if (!surface.is_bounded())
    return std::vector<BoundaryPoints>(static_cast<std::size_t>(halvings) + 1, {Points3(3, 0), {}});
  return surface.is_sphere() ? points_on_boundary<Sphere>(surface, cells, density, halvings)
                             : points_on_boundary<Plane>(surface, cells, density, halvings);
}

BoundaryPoints generators_detail::all_boundary_points(const Surface& surface, std::int64_t cells,
                                                      const Density& density) {
  return halved_boundary_points(surface, cells, density, 0).front();
}

BoundaryPoints generators_detail::limited_boundary_points(const Surface& surface,
                                                          std::int64_t cells,
                                                          const Density& density) {
  BoundaryPoints out = all_boundary_points(surface, cells, density);
  require(out.points.cols() < std::max<std::int64_t>(cells, 1),
          "the boundary takes {} of the {} generators; give more cells", out.points.cols(), cells);
  return out;
}

std::vector<Vec3> generators_detail::points_along_boundary(const Surface& surface,
                                                           const std::vector<Vec3>& corners,
                                                           bool closed,
                                                           const DemandedSpacing& spacing) {
  const auto along = [&]<class S>(const S&) {
    return points_along<S>(curve_of<S>(surface, corners, closed, spacing), *outline_of<S>(surface));
  };
  return surface.is_sphere() ? along(Sphere{}) : along(Plane());
}

Points3 boundary_points(const Surface& surface, std::int64_t cells, const Density& density) {
  return limited_boundary_points(surface, cells, density).points;
}

} // namespace calotte
