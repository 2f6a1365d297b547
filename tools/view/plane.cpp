// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view_mesh.h"

#include <calotte/voronoi.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

using Eigen::Vector2d;

/// The number of periods from `from` to the copy of `to` that is nearest to it, in each direction.
std::array<int, 2> periods_between(const Vector2d& from, const Vector2d& to,
                                   const Vector2d& period) {
  std::array<int, 2> shift = {0, 0};
  for (Eigen::Index k = 0; k < 2; ++k)
    if (period[k] > 0)
      shift[static_cast<std::size_t>(k)] =
          static_cast<int>(std::lround((from[k] - to[k]) / period[k]));
  return shift;
}

/// Points, and copies of them one or more periods away.
class Copies {
public:
  Copies(const Points3& points, const Vector2d& period) : period_(period) {
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      places_.emplace_back(points.col(i).head<2>());
  }

  /// The point, or the copy that is nearest to a place.
  std::int32_t nearest(std::int32_t id, const Vector2d& place) {
    const Vector2d here = places_[static_cast<std::size_t>(id)];
    const std::array<int, 2> shift = periods_between(place, here, period_);
    if (shift == std::array<int, 2>{0, 0})
      return id;
    const auto [found, is_new] =
        copies_.try_emplace({id, shift[0], shift[1]}, static_cast<std::int32_t>(places_.size()));
    if (is_new) {
      copied_.push_back(id);
      places_.emplace_back(here + Vector2d(shift[0] * period_.x(), shift[1] * period_.y()));
    }
    return found->second;
  }

  const std::vector<std::int32_t>& copied() const { return copied_; }

  Vector2d place(std::int32_t id) const { return places_[static_cast<std::size_t>(id)]; }

  Points3 points() const {
    Points3 points = Points3::Zero(3, std::ssize(places_));
    for (std::size_t i = 0; i < places_.size(); ++i)
      points.col(static_cast<Eigen::Index>(i)).head<2>() = places_[i];
    return points;
  }

private:
  Vector2d period_;
  std::vector<Vector2d> places_;
  std::vector<std::int32_t> copied_; ///< by copy: the point
  std::map<std::array<std::int32_t, 3>, std::int32_t> copies_;
};

} // namespace

void set_plane(ViewMesh& mesh, const Mesh& planar, const Polygons& cells) {
  Copies sites(planar.points, planar.surface.period());
  mesh.triangles = planar.triangles;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 1; v < 3; ++v)
      mesh.triangles(v, t) = sites.nearest(mesh.triangles(v, t), sites.place(mesh.triangles(0, t)));
  mesh.points = sites.points();
  mesh.copied = sites.copied();
  mesh.shapes = unwrapped(cells);
}

void set_plane(ViewMesh& mesh, const Mesh& planar) {
  Voronoi cells = voronoi(planar);
  set_plane(mesh, planar,
            Polygons{std::move(cells.vertices), std::move(cells.vertices_on_cell),
                     std::move(cells.cells), false, cells.period});
}

} // namespace calotte::tools
