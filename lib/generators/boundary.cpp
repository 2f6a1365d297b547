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

/// The rings of a boundary as segments with the surface to their left.
template <Space S> std::vector<std::vector<Segment>> list_segments(const Surface& surface) {
  std::vector<std::vector<Segment>> all;
  for (const std::vector<Vec3>& ring : outline_of<S>(surface)->rings()) {
    std::vector<Segment>& segments = all.emplace_back();
    for (std::size_t k = 0; k < ring.size(); ++k)
      segments.push_back({ring[k], ring[(k + 1) % ring.size()]});
  }
  return all;
}

template <Space S>
std::vector<Curve<S>> make_curves(const Surface& surface, const DemandedSpacing& spacing) {
  std::vector<Curve<S>> curves;
  for (std::vector<Segment>& ring : list_segments<S>(surface))
    curves.emplace_back(spacing, longest_step<S>(surface), std::move(ring), true);
  return curves;
}

/// The number of cells of a lattice without a boundary that has the spacing of n generators, b of
/// which are on the boundary and have half a cell each. b is inversely proportional to the spacing:
/// with b_0 edges at the spacing of n whole cells, the ratio s of the spacings satisfies n s^2 -
/// b_0 s / 2 - n = 0.
double whole_cells(double n, double edges) {
  const double s = (edges / 2 + std::sqrt(edges * edges / 4 + 4 * n * n)) / (2 * n);
  return n / (s * s);
}

template <Space S>
BoundaryPoints points_on_boundary(const Surface& surface, std::int64_t cells,
                                  const Density& density) {
  constexpr std::int64_t samples = 65536;
  const auto n = static_cast<double>(cells);
  double edges = 0;
  const DemandedSpacing of_all(surface, density, n, samples);
  for (const Curve<S>& curve : make_curves<S>(surface, of_all))
    edges += curve.edges();
  const DemandedSpacing spacing(surface, density, whole_cells(n, edges), samples);
  const std::vector<Curve<S>> curves = make_curves<S>(surface, spacing);
  BoundaryPoints out;
  std::vector<Vec3> positions;
  for (std::size_t ring = 0; ring < curves.size(); ++ring) {
    const Curve<S>& curve = curves[ring];
    require(curve.edges() > 0,
            "the density is zero along ring {} of the boundary; make it positive", ring);
    for (const double stop : curve.stops()) {
      const auto [point, segment] = curve.position(stop);
      positions.push_back(domain_detail::pushed_inside<S>(
          *outline_of<S>(surface), point, domain_detail::left_of<S>(curve.segments()[segment])));
    }
    out.ring_ends.push_back(std::ssize(positions));
  }
  out.points.resize(3, std::ssize(positions));
  for (std::size_t i = 0; i < positions.size(); ++i)
    base_detail::set_column(out.points, static_cast<std::int64_t>(i), positions[i]);
  return out;
}

} // namespace

BoundaryPoints generators_detail::all_boundary_points(const Surface& surface, std::int64_t cells,
                                                      const Density& density) {
  base_detail::require_count(cells, 4, "the number of cells");
  if (!surface.is_bounded())
    return {Points3(3, 0), {}};
  return surface.is_sphere() ? points_on_boundary<Sphere>(surface, cells, density)
                             : points_on_boundary<Plane>(surface, cells, density);
}

BoundaryPoints generators_detail::limited_boundary_points(const Surface& surface,
                                                          std::int64_t cells,
                                                          const Density& density) {
  BoundaryPoints out = all_boundary_points(surface, cells, density);
  require(out.points.cols() < std::max<std::int64_t>(cells, 1),
          "the boundary takes {} of the {} generators; give more cells", out.points.cols(), cells);
  return out;
}

Points3 boundary_points(const Surface& surface, std::int64_t cells, const Density& density) {
  return limited_boundary_points(surface, cells, density).points;
}

} // namespace calotte
