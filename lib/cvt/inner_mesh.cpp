// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/inner_mesh.h"

#include "base/points.h"
#include "base/triangle.h"
#include "cvt/cells.h"
#include "mesh/adjacency.h"
#include "mesh/canonical_order.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {
namespace {

/// The columns of triangles that are kept.
Triangles selected(const Triangles& triangles, const std::vector<std::uint8_t>& keep) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    if (keep[static_cast<std::size_t>(t)] != 0)
      kept.push_back(t);
  return triangles(Eigen::all, kept);
}

/// The triangles around a site in fans, each of which hangs together through edges at the site.
std::vector<std::vector<std::int32_t>> fans_at(const Triangles& triangles,
                                               const Triangles& neighbours, std::int32_t site,
                                               std::vector<std::int32_t> around) {
  std::vector<std::vector<std::int32_t>> fans;
  while (!around.empty()) {
    std::vector<std::int32_t> fan{around.back()};
    around.pop_back();
    for (std::size_t k = 0; k < fan.size(); ++k)
      for (int v = 0; v < 3; ++v) {
        const auto next = std::find(around.begin(), around.end(), neighbours(v, fan[k]));
        if (triangles(v, fan[k]) != site && next != around.end()) {
          fan.push_back(*next);
          around.erase(next);
        }
      }
    fans.push_back(std::move(fan));
  }
  return fans;
}

/// Marks all triangles but those of each site's largest fan; returns how many.
std::int64_t drop_small_fans(const Triangles& triangles, std::int64_t points,
                             std::vector<std::uint8_t>& keep) {
  const Triangles neighbours = neighbours_of(triangles, points);
  std::vector<std::int32_t> open(static_cast<std::size_t>(points), 0);
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (neighbours(v, t) < 0)
        ++open[static_cast<std::size_t>(triangles(next_vertex(v), t))];
  std::vector<std::vector<std::int32_t>> around(static_cast<std::size_t>(points));
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (open[static_cast<std::size_t>(triangles(v, t))] > 1)
        around[static_cast<std::size_t>(triangles(v, t))].push_back(static_cast<std::int32_t>(t));
  std::int64_t dropped = 0;
  for (std::int32_t site = 0; site < points; ++site) {
    auto fans = fans_at(triangles, neighbours, site, around[static_cast<std::size_t>(site)]);
    if (fans.size() < 2)
      continue;
    const auto largest =
        std::max_element(fans.begin(), fans.end(), [](const auto& a, const auto& b) {
          return a.size() != b.size() ? a.size() < b.size()
                                      : *std::max_element(a.begin(), a.end()) <
                                            *std::max_element(b.begin(), b.end());
        });
    for (const auto& fan : fans)
      for (const std::int32_t t : fan)
        if (&fan != &*largest && std::exchange(keep[static_cast<std::size_t>(t)], 0) != 0)
          ++dropped;
  }
  return dropped;
}

Mesh mesh_of(Points3&& points, Triangles&& triangles, const Surface& surface) {
  Triangles neighbours = neighbours_of(triangles, points.cols());
  make_canonical(triangles, neighbours);
  std::vector<std::int32_t> sites = themselves(points.cols());
  return {std::move(points), std::move(triangles), std::move(neighbours), std::move(sites),
          surface};
}

} // namespace

Mesh without_hull(Points3&& points, const Triangles& triangles, const Surface& surface) {
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(triangles.cols()));
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    keep[static_cast<std::size_t>(t)] = triangles.col(t).maxCoeff() < points.cols() ? 1 : 0;
  return mesh_of(std::move(points), selected(triangles, keep), surface);
}

namespace {

/// Flags of the triangles whose centre the surface has, see Cells::has_centre().
template <Space S> std::vector<std::uint8_t> with_centre(const Mesh& mesh, Boundary boundary) {
  Cells<S> cells(mesh.surface, boundary);
  cells.move(mesh.points);
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(mesh.triangles.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    keep[static_cast<std::size_t>(t)] = cells.has_centre(column(mesh.points, mesh.triangles(0, t)),
                                                         column(mesh.points, mesh.triangles(1, t)),
                                                         column(mesh.points, mesh.triangles(2, t)))
                                            ? 1
                                            : 0;
  return keep;
}

} // namespace

Mesh inner_mesh(Mesh&& mesh, Boundary boundary) {
  const bool plane = !mesh.surface.is_sphere();
  if (!mesh.surface.is_bounded() || (plane && boundary == Boundary::clip))
    return std::move(mesh);
  std::vector<std::uint8_t> keep =
      plane ? with_centre<Plane>(mesh, boundary) : with_centre<Sphere>(mesh, boundary);
  Triangles triangles = selected(mesh.triangles, keep);
  keep.assign(static_cast<std::size_t>(triangles.cols()), 1);
  while (drop_small_fans(triangles, mesh.points.cols(), keep) > 0) {
    triangles = selected(triangles, keep);
    keep.assign(static_cast<std::size_t>(triangles.cols()), 1);
  }
  std::vector<std::int32_t> sites = std::move(mesh.site_of_input);
  const Surface surface = mesh.surface;
  mesh = mesh_of(std::move(mesh.points), std::move(triangles), surface);
  mesh.site_of_input = std::move(sites);
  return std::move(mesh);
}

} // namespace calotte::cvt_detail
