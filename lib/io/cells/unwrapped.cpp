// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "exact/space.h"
#include "io/cells/room.h"

#include <calotte/mesh_file.h>

#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

/// Corners, and copies of them by their shift in whole periods.
class Copies {
public:
  Copies(const Points3& corners, const Plane& plane) : corners_(corners), plane_(plane) {}

  /// The copy of a corner that is nearest to a point.
  std::int32_t near(std::int32_t corner, const Vec3& point) {
    const Plane::Position copy = plane_.near(column(corners_, corner), {{point.x, point.y}, 0, 0});
    if (copy.i == 0 && copy.j == 0)
      return corner;
    const std::array<std::int32_t, 3> key{corner, copy.i, copy.j};
    const auto [known, is_new] =
        known_.try_emplace(key, static_cast<std::int32_t>(corners_.cols() + std::ssize(copies_)));
    if (is_new)
      copies_.push_back(plane_.coordinates(copy));
    return known->second;
  }

  Points3 all() const {
    Points3 points(3, corners_.cols() + std::ssize(copies_));
    points.leftCols(corners_.cols()) = corners_;
    for (std::size_t k = 0; k < copies_.size(); ++k)
      set_column(points, corners_.cols() + static_cast<std::int64_t>(k), copies_[k]);
    return points;
  }

private:
  const Points3& corners_;
  Plane plane_;
  std::vector<Vec3> copies_;
  std::map<std::array<std::int32_t, 3>, std::int32_t> known_;
};

} // namespace

Polygons unwrapped(Polygons polygons) {
  if (!(polygons.surface.period().maxCoeff() > 0))
    return polygons;
  Copies copies(polygons.corners, Plane(polygons.surface.period()));
  const bool centred = polygons.centres.cols() == polygons.size();
  for (std::int64_t i = 0; i < polygons.size(); ++i) {
    const std::span<std::int32_t> ids = polygons.ids[i];
    if (ids.empty())
      continue;
    const Vec3 point = centred ? column(polygons.centres, i) : column(polygons.corners, ids[0]);
    for (std::int32_t& id : ids)
      id = copies.near(id, point);
  }
  Points3 corners = copies.all();
  polygons.corners = std::move(corners);
  polygons.surface = Surface::plane();
  return polygons;
}

} // namespace calotte
