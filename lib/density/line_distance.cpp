// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/line_distance.h"

#include "base/elementary.h"
#include "base/require.h"
#include "base/vector_loops.h"
#include "density/least_of_items.h"
#include "domain/lines.h"
#include "domain/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace calotte::density_detail {
namespace {

using base_detail::require;

bool is_point(const Arc& arc, bool sphere) {
  const Vec3 apart = arc.to - arc.from;
  return sphere ? same_direction(arc.from, arc.to) : dot(apart, apart) == 0;
}

constexpr double longest = 0.1; ///< of a chord: boxes of long arcs contain many other lines

std::vector<Arc> make_arcs(const std::vector<Points3>& lines, bool sphere) {
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::vector<Vec3> points =
        domain_detail::checked_line(lines[k], static_cast<std::int64_t>(k), sphere);
    if (points.size() == 1)
      arcs.push_back({points[0], points[0]});
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Arc arc{points[i - 1], points[i]};
      if (is_point(arc, sphere))
        arcs.push_back({arc.to, arc.to});
      else if (sphere)
        for_each_short_part(arc, longest, [&](const Arc& part) { arcs.push_back(part); });
      else
        arcs.push_back(arc);
    }
  }
  require(!arcs.empty(), "there is no line to be distant from; give one or more points");
  return arcs;
}

/// The lines with their copies in the periods around the box of a plane.
std::vector<Arc> with_copies(std::vector<Arc> lines, const Eigen::Vector2d& period) {
  const std::size_t own = lines.size();
  for (const int i : {-1, 0, 1})
    for (const int j : {-1, 0, 1}) {
      const Vec3 shift{i * period.x(), j * period.y(), 0};
      if ((i == 0 || period.x() > 0) && (j == 0 || period.y() > 0) && (i != 0 || j != 0))
        for (std::size_t k = 0; k < own; ++k)
          lines.push_back({lines[k].from + shift, lines[k].to + shift});
    }
  return lines;
}

/// A tree in the order of the lines, which keeps neighbours together.
BoxTree tree_in_plane(const std::vector<Arc>& lines) {
  std::vector<Box3> boxes;
  std::vector<std::uint64_t> along;
  for (const Arc& line : lines) {
    boxes.push_back(joined(Box3{line.from, line.from}, Box3{line.to, line.to}));
    along.push_back(along.size());
  }
  return {boxes, along};
}

} // namespace

LineDistance::LineDistance(const std::vector<Points3>& lines, const Surface& surface)
    : sphere_(surface.is_sphere()), arcs_(with_copies(make_arcs(lines, sphere_), surface.period())),
      tree_(sphere_ ? ArcTree(arcs_) : tree_in_plane(arcs_)) {}

namespace {

/// A straight line of a plane, with the interface of ArcDistance.
class EdgeDistance {
public:
  explicit EdgeDistance(const Arc& line)
      : edge_{{line.from.x, line.from.y}, {line.to.x, line.to.y}} {}
  double square_from(const Vec3& p) const { return domain_detail::square_from(edge_, {p.x, p.y}); }

private:
  Outline::Edge edge_;
};

template <class Line>
CALOTTE_VECTOR_WIDTHS void set_distances(const Line& line, const PointRow& points,
                                         RowValues& distances) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < row_size; ++k)
    distances[k] = std::sqrt(line.square_from({points.x[k], points.y[k], points.z[k]}));
}

template <class Line>
CALOTTE_VECTOR_WIDTHS void lower_squares(const Line& line, const PointRow& points,
                                         RowValues& squares) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < row_size; ++k)
    squares[k] = std::min(squares[k], line.square_from({points.x[k], points.y[k], points.z[k]}));
}

/// Squares of distances from lines, see lower_to_least(). Their bounds are distances.
template <class Line> class LineSquares {
public:
  using Item = Line;
  LineSquares(const std::vector<Arc>& lines, const BoxTree& tree, double farthest)
      : lines_(lines), tree_(tree), farthest_(farthest) {}

  const BoxTree& tree() const { return tree_; }
  double least(const Box3& box, const Ball& ball, double) const {
    return std::sqrt(curve_detail::square_from(box, ball.middle)) - ball.reach;
  }
  Line item(std::int32_t k) const { return Line(lines_[static_cast<std::size_t>(k)]); }
  void set_bounds(const Line& line, const PointRow& middles, const RowValues& reaches,
                  RowValues& least, RowValues& greatest) const {
    constexpr double rounding = 1e-9, tiny = 1e-14;
    set_distances(line, middles, least);
    for (std::size_t k = 0; k < row_size; ++k) {
      greatest[k] = (least[k] + reaches[k]) * (1 + rounding) + tiny;
      least[k] -= reaches[k];
    }
  }
  void lower(const Line& line, const PointRow& points, RowValues& squares) const {
    lower_squares(line, points, squares);
  }
  double bound(double) const { return farthest_; }

private:
  const std::vector<Arc>& lines_;
  const BoxTree& tree_;
  double farthest_;
};

} // namespace

void LineDistance::operator()(std::span<const Vec3> points, std::span<double> distances,
                              double farthest) const {
  std::fill(distances.begin(), distances.end(), std::numeric_limits<double>::max()); // of squares
  if (sphere_)
    lower_to_least(LineSquares<ArcDistance>(arcs_, tree_, farthest), points, distances);
  else
    lower_to_least(LineSquares<EdgeDistance>(arcs_, tree_, farthest), points, distances);
  for (double& distance : distances) {
    const double chord = std::sqrt(distance);
    distance = sphere_ ? 2 * base_detail::arc_sine(std::min(1.0, 0.5 * chord)) : chord;
  }
}

Vec3 LineDistance::nearest(const Vec3& point) const {
  double square = std::numeric_limits<double>::infinity();
  std::int32_t nearest = 0;
  tree_.visit_nearest(
      [&](const Box3& box) { return curve_detail::square_from(box, point); }, square,
      [&](std::int32_t k) {
        const double other = domain_detail::square_from(arcs_[static_cast<std::size_t>(k)], point);
        if (other < square) {
          square = other;
          nearest = k;
        }
      });
  return domain_detail::nearest_on(arcs_[static_cast<std::size_t>(nearest)], point);
}

} // namespace calotte::density_detail
