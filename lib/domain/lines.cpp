// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/lines.h"

#include "base/points.h"
#include "base/require.h"
#include "domain/arcs.h"

namespace calotte::domain_detail {

using base_detail::require;

std::vector<Vec3> checked_line(const Points3& line, std::int64_t number, bool sphere) {
  std::vector<Vec3> points;
  for (Eigen::Index i = 0; i < line.cols(); ++i) {
    const auto x = line.col(i);
    require(x.allFinite() && (sphere ? !x.isZero(0) : x.z() == 0),
            "line {}, point {} is no {}; correct it", number, i,
            sphere ? "direction" : "place x y 0 of a plane");
    const Vec3 at = sphere ? as_unit(base_detail::column(line, i)) : base_detail::column(line, i);
    const Vec3 middle = points.empty() ? at : points.back() + at;
    require(!sphere || dot(middle, middle) > 1e-20,
            "line {}, point {} is opposite to the one before; give a point between them", number,
            i);
    points.push_back(at);
  }
  return points;
}

} // namespace calotte::domain_detail
