// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/line_distance.h"

#include "base/elementary.h"
#include "base/require.h"
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

constexpr double longest = 0.1; ///< of a chord: boxes of long arcs hold much else

template <class Name> Vec3 direction_of(const Eigen::Vector3d& x, const Name& name) {
  require(x.allFinite() && x.norm() > 0, name() + " is no direction; correct it");
  return as_unit(Vec3{x.x(), x.y(), x.z()});
}

template <class Name> Vec3 place_of(const Eigen::Vector3d& x, const Name& name) {
  require(x.allFinite() && x.z() == 0, name() + " is no place x y 0 of a plane; correct it");
  return {x.x(), x.y(), 0};
}

std::vector<Arc> arcs_of(const std::vector<Points3>& lines, bool sphere) {
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Points3& line = lines[k];
    Vec3 before{};
    for (Eigen::Index i = 0; i < line.cols(); ++i) {
      const auto name = [&] {
        return "line " + std::to_string(k) + ", point " + std::to_string(i);
      };
      const Vec3 at = sphere ? direction_of(line.col(i), name) : place_of(line.col(i), name);
      const Vec3 middle = before + at;
      require(!sphere || i == 0 || dot(middle, middle) > 1e-20,
              name() + " is opposite to the one before; give a point between them");
      if (i == 0 ? line.cols() == 1 : is_point({before, at}, sphere))
        arcs.push_back({at, at});
      else if (i > 0 && !sphere)
        arcs.push_back({before, at});
      else if (i > 0)
        for_each_short_part({before, at}, longest, [&](const Arc& part) { arcs.push_back(part); });
      before = at;
    }
  }
  require(!arcs.empty(), "there is no line to be distant from; give one or more points");
  return arcs;
}

/// And their copies in the periods around that of a plane.
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

/// In the order of the lines, which keeps neighbours together.
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
    : sphere_(surface.is_sphere()), arcs_(with_copies(arcs_of(lines, sphere_), surface.period())),
      tree_(sphere_ ? ArcTree(arcs_) : tree_in_plane(arcs_)) {}

double LineDistance::square_from(std::int32_t item, const Vec3& p) const {
  const Arc& arc = arcs_[static_cast<std::size_t>(item)];
  if (!sphere_)
    return domain_detail::square_from(Outline::Edge{{arc.from.x, arc.from.y}, {arc.to.x, arc.to.y}},
                                      {p.x, p.y});
  if (!is_point(arc, sphere_))
    return domain_detail::square_from(arc, p);
  const Vec3 apart = p - arc.from;
  return dot(apart, apart);
}

void LineDistance::operator()(std::span<const Vec3> places, std::span<double> distances) const {
  std::int32_t nearest = -1;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vec3& p = places[k];
    double least = nearest < 0 ? std::numeric_limits<double>::infinity() : square_from(nearest, p);
    tree_.visit([&](const Box3& box) { return curve_detail::square_from(box, p) < least; },
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
