// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/line_distance.h"

#include "base/elementary.h"
#include "base/require.h"
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

double LineDistance::square_from(std::int32_t item, const Vec3& p) const {
  const Arc& arc = arcs_[static_cast<std::size_t>(item)];
  if (!sphere_)
    return domain_detail::square_from(Outline::Edge{{arc.from.x, arc.from.y}, {arc.to.x, arc.to.y}},
                                      {p.x, p.y});
  const Vec3 &a = arc.from, &b = arc.to;
  if (a.x != b.x || a.y != b.y || a.z != b.z) // an arc of one point has equal ends, see make_arcs()
    return domain_detail::square_from(arc, p);
  const Vec3 apart = p - arc.from;
  return dot(apart, apart);
}

void LineDistance::operator()(std::span<const Vec3> points, std::span<double> distances) const {
  std::int32_t nearest = -1;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3& p = points[k];
    double least = nearest < 0 ? std::numeric_limits<double>::infinity() : square_from(nearest, p);
    // Rounding must not exclude a line: otherwise the last bit would depend on the previous point.
    constexpr double rounding = 1e-9;
    tree_.visit(
        [&](const Box3& box) {
          return curve_detail::square_from(box, p) * (1 - rounding) <= least + 1e-28;
        },
        [&](std::int32_t item) {
          if (const double square = square_from(item, p); square < least) {
            least = square;
            nearest = item;
          }
        });
    const double chord = std::sqrt(least);
    distances[k] = sphere_ ? 2 * base_detail::arc_sine(std::min(1.0, 0.5 * chord)) : chord;
  }
}

} // namespace calotte::density_detail
