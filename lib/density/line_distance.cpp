// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/line_distance.h"

#include "base/elementary.h"
#include "base/require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace calotte::density_detail {
namespace {

using base_detail::require;

bool is_point(const Arc& arc) { return same_direction(arc.from, arc.to); }

constexpr double longest = 0.1; ///< of a chord: boxes of long arcs hold much else

std::vector<Arc> arcs_of(const std::vector<Points3>& lines) {
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Points3& line = lines[k];
    Vec3 before{};
    for (Eigen::Index i = 0; i < line.cols(); ++i) {
      const auto name = [&] {
        return "line " + std::to_string(k) + ", point " + std::to_string(i);
      };
      const Eigen::Vector3d x = line.col(i);
      require(x.allFinite() && x.norm() > 0, name() + " is no direction; correct it");
      const Vec3 at = as_unit(Vec3{x.x(), x.y(), x.z()});
      const Vec3 middle = before + at;
      require(i == 0 || dot(middle, middle) > 1e-20,
              name() + " is opposite to the one before; give a point between them");
      if (i == 0 ? line.cols() == 1 : same_direction(before, at))
        arcs.push_back({at, at});
      else if (i > 0)
        for_each_short_part({before, at}, longest, [&](const Arc& part) { arcs.push_back(part); });
      before = at;
    }
  }
  require(!arcs.empty(), "there is no line to be distant from; give one or more points");
  return arcs;
}

} // namespace

LineDistance::LineDistance(const std::vector<Points3>& lines)
    : arcs_(arcs_of(lines)), tree_(arcs_) {}

double LineDistance::square_from(std::int32_t item, const Vec3& p) const {
  const Arc& arc = arcs_[static_cast<std::size_t>(item)];
  if (!is_point(arc))
    return domain_detail::square_from(arc, p);
  const Vec3 apart = p - arc.from;
  return dot(apart, apart);
}

void LineDistance::operator()(std::span<const Vec3> places, std::span<double> angles) const {
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
    angles[k] = 2 * base_detail::arc_sine(std::min(1.0, 0.5 * std::sqrt(least)));
  }
}

} // namespace calotte::density_detail
