// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/lines.h"

#include "base/points.h"
#include "base/require.h"
#include "domain/arcs.h"

namespace calotte::domain_detail {

using base_detail::require;

std::string name_of_point(std::int64_t line, Eigen::Index point) {
  return "line " + std::to_string(line) + ", point " + std::to_string(point);
}

std::vector<Vec3> places_of(const Points3& line, std::int64_t number, bool sphere) {
  std::vector<Vec3> places;
  for (Eigen::Index i = 0; i < line.cols(); ++i) {
    const auto x = line.col(i);
    require(x.allFinite() && (sphere ? !x.isZero(0) : x.z() == 0),
            name_of_point(number, i) +
                (sphere ? " is no direction" : " is no place x y 0 of a plane") + "; correct it");
    const Vec3 at = sphere ? as_unit(base_detail::column(line, i)) : base_detail::column(line, i);
    const Vec3 middle = places.empty() ? at : places.back() + at;
    require(!sphere || dot(middle, middle) > 1e-20,
            name_of_point(number, i) + " is opposite to the one before; give a point between them");
    places.push_back(at);
  }
  return places;
}

} // namespace calotte::domain_detail
