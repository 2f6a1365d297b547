// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/inner_mesh.h"

#include "base/points.h"
#include "base/triangle.h"
#include "cvt/cells.h"
#include "cvt/repair.h"
#include "mesh/adjacency.h"
#include "mesh/canonical_order.h"
#include "mesh/faces.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {
namespace {

/// The columns of the triangles to keep.
Triangles selected(const Triangles& triangles, const std::vector<std::uint8_t>& keep) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    if (keep[static_cast<std::size_t>(t)] != 0)
      kept.push_back(t);
  return triangles(Eigen::all, kept);
}

/// A fan: the triangles at a site from one open edge to the next.
struct Fan {
  Corner first;
  std::int32_t site;
  std::int32_t triangles, last; ///< their number, and the highest
};

/// At each site with several fans, unmarks the triangles of all but the largest. Returns the number
/// of triangles that it unmarked.
std::int64_t drop_small_fans(const Triangles& triangles, std::int64_t points,
                             std::vector<std::uint8_t>& keep) {
  const Triangles neighbours = neighbours_of(triangles, points);
  const Faces faces{triangles, neighbours, points};
  std::vector<Fan> fans;
  for (std::int32_t t = 0; t < triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (neighbours(previous_vertex(v), t) < 0) {
        Fan& fan = fans.emplace_back(Fan{{t, v}, triangles(v, t), 0, t});
        walk_around(faces, fan.first, [&](Corner corner) {
          ++fan.triangles;
          fan.last = std::max(fan.last, corner.triangle);
        });
      }
  std::sort(fans.begin(), fans.end(), [](const Fan& a, const Fan& b) {
    return std::tie(a.site, b.triangles, b.last) < std::tie(b.site, a.triangles, a.last);
  });
  std::int64_t dropped = 0;
  for (std::size_t k = 1; k < fans.size(); ++k)
    if (fans[k].site == fans[k - 1].site)
      walk_around(faces, fans[k].first, [&](Corner corner) {
        dropped += std::exchange(keep[static_cast<std::size_t>(corner.triangle)], 0);
      });
  return dropped;
}

/// The triangles to keep, but of those that meet at a site only in it the largest fan.
Triangles without_small_fans(const Triangles& all, std::int64_t points,
                             std::vector<std::uint8_t> keep) {
  Triangles triangles = selected(all, keep);
  keep.assign(static_cast<std::size_t>(triangles.cols()), 1);
  while (drop_small_fans(triangles, points, keep) > 0) {
    triangles = selected(triangles, keep);
    keep.assign(static_cast<std::size_t>(triangles.cols()), 1);
  }
  return triangles;
}

Mesh make_mesh(Points3&& points, Triangles&& triangles, const Surface& surface) {
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
  return make_mesh(std::move(points), selected(triangles, keep), surface);
}

namespace {

/// Flags the triangles on the surface. \param next the next site along the boundary, with the
/// surface to the left, of each of the first sites; -1 for others. Triangles do not cross the edges
/// from site to site.
std::vector<std::uint8_t> left_of(std::span<const std::int32_t> next, const Connectivity& mesh) {
  const auto has = [&](std::int32_t from, std::int32_t to) {
    return from < std::ssize(next) && next[static_cast<std::size_t>(from)] == to;
  };
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(mesh.triangles.cols()), 0);
  std::vector<std::int32_t> row;
  const auto take = [&](std::int32_t t) {
    if (std::exchange(keep[static_cast<std::size_t>(t)], 1) == 0)
      row.push_back(t);
  };
  const auto side = [&](std::int32_t t, int v) {
    return std::pair{mesh.triangles(next_vertex(v), t), mesh.triangles(previous_vertex(v), t)};
  };
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (const auto [from, to] = side(t, v); has(from, to))
        take(t);
  while (!row.empty()) {
    const std::int32_t t = row.back();
    row.pop_back();
    for (int v = 0; v < 3; ++v)
      if (const auto [from, to] = side(t, v); !has(from, to) && mesh.neighbours(v, t) >= 0)
        take(mesh.neighbours(v, t));
  }
  return keep;
}

template <Space S>
Mesh mesh_to_boundary(const S&, Points3&& points, const Surface& surface,
                      std::span<const std::int32_t> next) {
  std::vector<Ends> edges;
  for (std::int32_t from = 0; from < std::ssize(next); ++from)
    if (const std::int32_t to = next[static_cast<std::size_t>(from)]; to >= 0)
      edges.push_back(std::minmax({from, to}));
  std::sort(edges.begin(), edges.end());
  Cells<S> cells(surface, Boundary::generators);
  cells.move(points);
  Connectivity mesh = cells.triangulate();
  const bool whole = constrain(mesh, cells.positions(), edges) == 0;
  std::vector<std::uint8_t> keep = left_of(next, mesh);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    std::uint8_t& here = keep[static_cast<std::size_t>(t)];
    const auto corners = mesh.triangles.col(t);
    here = here != 0 && corners.maxCoeff() < points.cols() &&
           (whole || cells.has_centre(column(points, corners[0]), column(points, corners[1]),
                                      column(points, corners[2])));
  }
  return make_mesh(std::move(points), without_small_fans(mesh.triangles, points.cols(), keep),
                   surface);
}

} // namespace

Mesh mesh_to_boundary(Points3&& points, const Surface& surface,
                      std::span<const std::int32_t> next) {
  return in_space_of(surface, [&](const Space auto& space) {
    return mesh_to_boundary(space, std::move(points), surface, next);
  });
}

Mesh inner_mesh(Mesh&& mesh) {
  if (!mesh.surface.is_bounded() || !mesh.surface.is_sphere())
    return std::move(mesh);
  Cells<Sphere> cells(mesh.surface);
  cells.move(mesh.points);
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(mesh.triangles.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const auto corner = [&](int v) { return column(mesh.points, mesh.triangles(v, t)); };
    keep[static_cast<std::size_t>(t)] = cells.has_centre(corner(0), corner(1), corner(2)) ? 1 : 0;
  }
  Triangles triangles = without_small_fans(mesh.triangles, mesh.points.cols(), std::move(keep));
  std::vector<std::int32_t> sites = std::move(mesh.site_of_input);
  const Surface surface = mesh.surface;
  mesh = make_mesh(std::move(mesh.points), std::move(triangles), surface);
  mesh.site_of_input = std::move(sites);
  return std::move(mesh);
}

} // namespace calotte::cvt_detail
