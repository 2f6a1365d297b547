// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/generators.h>

#include "base/points.h"
#include "base/require.h"
#include "curve/box_tree.h"
#include "curve/hilbert.h"
#include "density/demanded_spacing.h"
#include "density/hexagons.h"
#include "density/line_distance.h"
#include "domain/lines.h"
#include "domain/surface.h"
#include "generators/curve.h"
#include "generators/line_network.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace calotte {
namespace {

using namespace generators_detail;
using base_detail::require;

/// A tree of positions. In a plane the positions are in the order of lines, which keeps neighbours
/// together.
BoxTree tree_of(const std::vector<Vec3>& positions, bool sphere) {
  std::vector<Box3> boxes;
  std::vector<std::uint64_t> keys;
  for (const Vec3& p : positions) {
    boxes.push_back({p, p});
    keys.push_back(sphere ? curve_key(to_cube(p)) : keys.size());
  }
  return {boxes, keys};
}

/// Positions for generators, the most important ones first: confluences, ends, then those along the
/// lines.
template <Space S> class Candidates {
public:
  Candidates(const LineNetwork& network, const DemandedSpacing& spacing, double longest)
      : spacing_(spacing) {
    const auto is = [&](std::size_t id, bool confluence) {
      return network.neighbours[id] != 2 && (network.neighbours[id] > 2) == confluence;
    };
    for (const bool confluence : {true, false})
      for (std::size_t id = 0; id < network.points.size(); ++id)
        if (is(id, confluence))
          positions_.push_back(network.points[id]);
    ends_ = positions_.size();
    for (const std::vector<std::int32_t>& chain : network.chains)
      if (chain.size() > 1)
        add(network, chain, longest);
  }

  const std::vector<Vec3>& positions() const { return positions_; }
  std::size_t ends() const { return ends_; } ///< number of those at confluences and ends
  const std::vector<Curve<S>>& curves() const { return curves_; }

private:
  void add(const LineNetwork& network, const std::vector<std::int32_t>& chain, double longest) {
    const auto position = [&](std::size_t k) {
      return network.points[static_cast<std::size_t>(chain[k])];
    };
    std::vector<Segment> segments;
    for (std::size_t k = 1; k < chain.size(); ++k)
      segments.push_back({position(k - 1), position(k)});
    const bool loop = chain.front() == chain.back() &&
                      network.neighbours[static_cast<std::size_t>(chain.front())] == 2;
    curves_.emplace_back(spacing_, longest, std::move(segments), loop);
    const std::vector<double> stops = curves_.back().stops(loop);
    for (std::size_t k = loop ? 0 : 1; k + (loop ? 0 : 1) < stops.size(); ++k)
      positions_.push_back(curves_.back().position(stops[k]).at);
  }

  const DemandedSpacing& spacing_;
  std::vector<Vec3> positions_;
  std::size_t ends_ = 0;
  std::vector<Curve<S>> curves_;
};

double edge_at(const DemandedSpacing& spacing, const Vec3& x) {
  const double h = spacing.at(x);
  return hexagon_width(h * h);
}

/// Selects positions that are no nearer than two thirds of the demanded edge to a previously
/// selected position or to other points. Returns their indices.
std::vector<std::size_t> apart(const std::vector<Vec3>& others, const std::vector<Vec3>& positions,
                               const DemandedSpacing& spacing, bool sphere) {
  constexpr double nearest = 2.0 / 3;
  std::vector<Vec3> all = others;
  all.insert(all.end(), positions.begin(), positions.end());
  std::vector<std::uint8_t> taken(all.size(), 0);
  std::fill_n(taken.begin(), others.size(), 1);
  const BoxTree tree = tree_of(all, sphere);
  std::vector<std::size_t> kept;
  for (std::size_t k = others.size(); k < all.size(); ++k) {
    const double reach = nearest * edge_at(spacing, all[k]);
    bool near = false;
    tree.visit([&](const Box3& box) { return !near && square_from(box, all[k]) < reach * reach; },
               [&](std::int32_t other) { near = near || taken[static_cast<std::size_t>(other)]; });
    if (near)
      continue;
    taken[k] = 1;
    kept.push_back(k - others.size());
  }
  return kept;
}

/// The largest distance of positions on curves from the nearest of some points, in demanded edges.
template <Space S>
double farthest(const std::vector<Curve<S>>& curves, const LineDistance& from_points,
                const DemandedSpacing& spacing) {
  constexpr double step = 0.05; // edges
  double most = 0;
  for (const Curve<S>& curve : curves) {
    const auto samples = std::max<std::int64_t>(1, std::llround(std::ceil(curve.edges() / step)));
    std::vector<Vec3> positions;
    for (std::int64_t k = 0; k <= samples; ++k)
      positions.push_back(
          curve.position(curve.edges() * static_cast<double>(k) / static_cast<double>(samples)).at);
    std::vector<double> distances(positions.size());
    from_points(positions, distances);
    for (std::size_t k = 0; k < positions.size(); ++k)
      most = std::max(most, distances[k] / edge_at(spacing, positions[k]));
  }
  return most;
}

std::vector<Vec3> columns_of(const Points3& points, bool sphere) {
  std::vector<Vec3> columns;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3& x = base_detail::column(points, i);
    columns.push_back(sphere ? domain_detail::as_unit(x) : x);
  }
  return columns;
}

void require_inside(const std::vector<Points3>& lines, const Surface& surface) {
  for (std::size_t k = 0; k < lines.size(); ++k)
    for (Eigen::Index i = 0; i < lines[k].cols(); ++i)
      require(surface.contains(lines[k].col(i)),
              "line {}, point {} is outside the surface; cut the lines to its extent", k, i);
}

template <Space S>
LinePoints points_on_lines(const std::vector<Points3>& lines, const Surface& surface,
                           std::int64_t cells, const Density& density, const Points3& beside) {
  constexpr std::int64_t samples = 65536;
  const DemandedSpacing spacing(surface, density, static_cast<double>(cells), samples);
  const LineNetwork network = make_network(lines, S::on_sphere);
  require_inside(lines, surface);
  const Candidates<S> candidates(network, spacing, longest_step<S>(surface));
  const std::vector<Vec3> others = columns_of(beside, S::on_sphere);
  std::vector<Vec3> points;
  LinePoints out;
  for (const std::size_t k : apart(others, candidates.positions(), spacing, S::on_sphere)) {
    points.push_back(candidates.positions()[k]);
    out.ends += k < candidates.ends() ? 1 : 0;
  }
  for (const Vec3& x : points)
    require(side_of<S>(outline_of<S>(surface), x) != Side::outside,
            "a line crosses what the surface leaves out, at {} {} {}; cut it there", x.x, x.y, x.z);
  out.points.resize(3, std::ssize(points));
  for (std::size_t k = 0; k < points.size(); ++k)
    base_detail::set_column(out.points, static_cast<std::int64_t>(k), points[k]);
  std::vector<Points3> all; // a line each
  for (const auto& point : out.points.colwise())
    all.emplace_back(point);
  for (const auto& point : beside.colwise())
    all.emplace_back(point);
  if (!all.empty())
    out.farthest = farthest(candidates.curves(), LineDistance(all, surface), spacing);
  return out;
}

} // namespace

LinePoints line_points(const std::vector<Points3>& lines, const Surface& surface,
                       std::int64_t cells, const Density& density, const Points3& beside) {
  base_detail::require_count(cells, 3, "the number of cells");
  require(surface.period().isZero(0) || lines.empty(),
          "lines are not followed in a periodic plane; give fixed points");
  if (surface.is_sphere())
    return points_on_lines<Sphere>(lines, surface, cells, density, beside);
  domain_detail::require_finite_plane(surface);
  return points_on_lines<Plane>(lines, surface, cells, density, beside);
}

} // namespace calotte
