// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/boundary.h>

#include "density/line_distance.h"
#include "oceans/room.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace calotte {
namespace oceans_detail {
namespace {

/// The sites of the boundary for which test(site, mean length of the outer edges there) holds. At a
/// site where the boundary passes more than once, all its edges count.
/// \param points of the sites: on the sphere unit vectors.
Ids select_sites(const Mesh& mesh, const Points3& points,
                 const std::function<bool(std::int32_t, double)>& test) {
  const IdLists loops = boundary_loops(mesh);
  std::vector<double> length(static_cast<std::size_t>(mesh.points.cols()));
  std::vector<int> edges(length.size());
  for (std::int64_t k = 0; k < loops.size(); ++k) {
    std::int32_t before = loops[k].back();
    for (const std::int32_t site : loops[k]) {
      const double chord = (points.col(before) - points.col(site)).norm();
      const double edge =
          mesh.surface.is_sphere() ? 2 * std::asin(std::min(chord / 2, 1.0)) : chord;
      for (const std::int32_t end : {before, site}) {
        length[static_cast<std::size_t>(end)] += edge;
        ++edges[static_cast<std::size_t>(end)];
      }
      before = site;
    }
  }
  std::vector<std::int32_t> sites;
  for (std::int32_t site = 0; site < mesh.points.cols(); ++site) {
    const auto k = static_cast<std::size_t>(site);
    if (edges[k] > 0 && test(site, length[k] / edges[k]))
      sites.push_back(site);
  }
  return Eigen::Map<const Ids>(sites.data(), std::ssize(sites));
}

Points3 points_of(const Mesh& mesh) {
  Points3 points = mesh.points;
  for (Eigen::Index k = 0; mesh.surface.is_sphere() && k < points.cols(); ++k)
    set_column(points, k, normalised(column(points, k)));
  return points;
}

} // namespace
} // namespace oceans_detail

Ids boundary_sites(const Mesh& mesh, const Surface& region) {
  using namespace oceans_detail;
  return select_sites(mesh, points_of(mesh), [&](std::int32_t site, double) {
    return region.contains(mesh.points.col(site));
  });
}

Ids boundary_sites(const Mesh& mesh, const std::vector<Points3>& lines) {
  using namespace oceans_detail;
  const density_detail::LineDistance distance(lines, mesh.surface);
  const Points3 points = points_of(mesh);
  return select_sites(mesh, points, [&](std::int32_t site, double length) {
    return distance(column(points, site)) <= length / 2;
  });
}

} // namespace calotte
