// SPDX-License-Identifier: GPL-3.0-or-later
#include "grids/patch.h"

#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "density/hexagons.h"
#include "domain/arcs.h"
#include "exact/space.h"
#include "mesh/faces.h"
#include "mesh/rows.h"
#include "mesh/stars.h"

#include <calotte/error.h>
#include <calotte/voronoi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <queue>
#include <string>
#include <unordered_map>
#include <utility>

namespace calotte::grids_detail {
namespace {

using mesh_detail::Corner;
using mesh_detail::Faces;
using mesh_detail::grown;
using mesh_detail::Stars;
using mesh_detail::Submesh;

/// The offset from one site to another, in the unit of widths.
template <Space S>
Vec3 chord(const S& space, const Mesh& mesh, std::int32_t from, std::int32_t to) {
  return space.offset(measured_point(space, column(mesh.points, from)),
                      measured_point(space, column(mesh.points, to)));
}

template <Space S> double flat_area(const S& space, const Mesh& mesh, std::int64_t t) {
  const auto corners = mesh.triangles.col(t);
  return 0.5 * norm(cross(chord(space, mesh, corners[0], corners[1]),
                          chord(space, mesh, corners[0], corners[2])));
}

/// The area of a third of the triangles around each site; 0 at the boundary.
template <Space S>
DoubleVector cell_areas(const Mesh& mesh, const S& space, const Stars& stars,
                        const Marks& at_boundary) {
  DoubleVector areas(mesh.points.cols());
  for_each_block(areas.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      double sum = 0;
      stars.for_each_corner(static_cast<std::int32_t>(i),
                            [&](Corner corner) { sum += flat_area(space, mesh, corner.triangle); });
      areas[i] = at_boundary[static_cast<std::size_t>(i)] != 0 ? 0 : sum / 3;
    }
  });
  return areas;
}

/// Marks the triangles around some sites, including all fans where a boundary passes through a site
/// more than once.
Marks mark_stars(const Mesh& mesh, const Marks& sites) {
  Marks triangles(static_cast<std::size_t>(mesh.triangles.cols()), 0);
  for_each_block(mesh.triangles.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      for (int i = 0; i < 3; ++i)
        triangles[static_cast<std::size_t>(t)] |=
            sites[static_cast<std::size_t>(mesh.triangles(i, t))];
  });
  return triangles;
}

/// Values of sites from which a field spreads.
using Sources = std::vector<std::pair<double, std::int32_t>>;

/// Lowers a field at sites so that it is at most each source's value plus the gradient times the
/// distance along edges (Dijkstra, Numer. Math. 1, 1959).
/// \param may(site) whether the field may be lowered at a site.
template <class May>
void spread(const Mesh& mesh, const IdLists& neighbours, const Sources& sources, double gradient,
            DoubleVector& field, const May& may) {
  using Entry = Sources::value_type;
  std::priority_queue<Entry, Sources, std::greater<>> queue(std::greater<>(), sources);
  in_space_of(mesh.surface, [&](const Space auto& space) {
    while (!queue.empty()) {
      const Entry entry = queue.top();
      queue.pop();
      const std::int32_t i = entry.second;
      if (entry.first > field[i])
        continue;
      for (const std::int32_t other : neighbours[i]) {
        const double most = entry.first + gradient * norm(chord(space, mesh, i, other));
        if (most < field[other] && may(other)) {
          field[other] = most;
          queue.emplace(most, other);
        }
      }
    }
  });
}

// ---- Triangles of patches

/// Whether the edge across from a vertex of a marked triangle leads to an unmarked one, or to none.
bool is_rim(const Mesh& mesh, const Marks& triangles, std::int64_t t, int i) {
  const std::int32_t beyond = mesh.neighbours(i, t);
  return beyond < 0 || triangles[static_cast<std::size_t>(beyond)] == 0;
}

/// Adds the stars of sites where marked triangles touch each other in a vertex only.
void separate(const Mesh& mesh, Marks& triangles) {
  for (std::int64_t before = -1, count = 0; count != before;) {
    std::unordered_map<std::int32_t, int> fans; // by site: edges of the rim that begin there
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
      if (triangles[static_cast<std::size_t>(t)] != 0)
        for (int i = 0; i < 3; ++i)
          if (is_rim(mesh, triangles, t, i))
            ++fans[mesh.triangles(next_vertex(i), t)];
    Marks touched(static_cast<std::size_t>(mesh.points.cols()), 0);
    for (const auto& [site, edges] : fans)
      touched[static_cast<std::size_t>(site)] = edges > 1;
    const Marks stars = mark_stars(mesh, touched);
    before = std::exchange(count, 0);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      count += triangles[t] |= stars[t];
  }
}

/// The component of marked triangles that contains a given one. Their marks are removed.
std::vector<std::int32_t> take_component(const Mesh& mesh, Marks& triangles, std::int32_t first) {
  std::vector<std::int32_t> found{first};
  triangles[static_cast<std::size_t>(first)] = 0;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (int i = 0; i < 3; ++i)
      if (const std::int32_t beyond = mesh.neighbours(i, found[k]);
          beyond >= 0 &&
          std::exchange(triangles[static_cast<std::size_t>(beyond)], std::uint8_t{0}) != 0)
        found.push_back(beyond);
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::vector<std::int32_t>> trace_rings(const Submesh& part) {
  std::vector<std::int32_t> next(part.sites.size(), -1); // along the rim
  const auto after = [&](std::int32_t site) -> std::int32_t& {
    return next[static_cast<std::size_t>(site)];
  };
  for (const Submesh::RimEdge& edge : part.rim)
    if (std::exchange(after(edge.from), edge.to) >= 0) {
      const std::int32_t site = part.sites[static_cast<std::size_t>(edge.from)];
      throw Error(ErrorCode::invalid_argument,
                  base_detail::message("a patch would reach both sides of site {}, where the "
                                       "mesh's boundary meets itself; give a part without it",
                                       site),
                  site);
    }
  std::vector<std::vector<std::int32_t>> rings;
  for (const Submesh::RimEdge& edge : part.rim) {
    std::vector<std::int32_t> ring;
    for (std::int32_t at = edge.from; after(at) >= 0; at = ring.back())
      ring.push_back(std::exchange(after(at), -1));
    if (!ring.empty())
      rings.push_back(std::move(ring));
  }
  return rings;
}

/// Frees all sites of short loops of the boundary of which some are free: a whole loop has three
/// generators or more.
void free_whole_islands(const Mesh& mesh, Marks& is_free) {
  constexpr std::int64_t few = 8; // edges
  const IdLists loops = boundary_loops(mesh);
  for (std::int64_t loop = 0; loop < loops.size(); ++loop) {
    const auto sites = loops[loop];
    if (loops.count(loop) <= few && std::ranges::any_of(sites, [&](std::int32_t site) {
          return is_free[static_cast<std::size_t>(site)] != 0;
        }))
      for (const std::int32_t site : sites)
        is_free[static_cast<std::size_t>(site)] = 1;
  }
}

PatchRegion make_patch(const Mesh& mesh, const Marks& is_free,
                       std::vector<std::int32_t>&& component) {
  PatchRegion patch{extract(mesh.triangles, mesh.neighbours, std::move(component))};
  Marks stays;
  for (const std::int32_t site : patch.part.sites)
    stays.push_back(is_free[static_cast<std::size_t>(site)] == 0);
  patch.fixed = put_first(patch.part, stays);
  patch.rings = trace_rings(patch.part);
  return patch;
}

/// Marks the ends of open edges. Where the circumcentre of a triangle lies beyond an open edge, as
/// in thin triangles along a hull, cells extend out of the mesh: the triangle's other edges then
/// count as open.
template <Space S> Marks sites_at_open_edges(const Mesh& mesh, const S& space) {
  const Faces faces = faces_of(mesh);
  Marks marks(static_cast<std::size_t>(mesh.points.cols()), 0),
      beyond(static_cast<std::size_t>(mesh.triangles.cols()), 0);
  std::vector<Corner> open; // across from the edges
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.neighbours(i, t) < 0)
        open.push_back({t, i});
  while (!open.empty()) {
    const auto [t, i] = open.back();
    open.pop_back();
    const std::int32_t at = mesh.triangles(i, t), a = mesh.triangles(next_vertex(i), t),
                       b = mesh.triangles(previous_vertex(i), t);
    marks[static_cast<std::size_t>(a)] = marks[static_cast<std::size_t>(b)] = 1;
    if (!(dot(chord(space, mesh, at, a), chord(space, mesh, at, b)) < 0) ||
        std::exchange(beyond[static_cast<std::size_t>(t)], std::uint8_t{1}) != 0)
      continue;
    for (const int k : {next_vertex(i), previous_vertex(i)})
      if (const std::int32_t next = mesh.neighbours(k, t); next >= 0)
        open.push_back(
            {next, next_vertex(slot_of(faces, next, mesh.triangles(next_vertex(k), t)))});
  }
  return marks;
}

} // namespace

std::vector<std::int32_t> PatchRegion::on_boundary() const {
  std::vector<std::int32_t> moved;
  for (const std::vector<std::int32_t>& ring : rings)
    std::ranges::copy_if(ring, std::back_inserter(moved),
                         [&](std::int32_t site) { return site >= fixed; });
  return moved;
}

Marks sites_at_boundary(const Mesh& mesh) {
  Marks marks = in_space_of(
      mesh.surface, [&](const Space auto& space) { return sites_at_open_edges(mesh, space); });
  if (!mesh.surface.is_sphere() && mesh.surface.is_bounded()) {
    const Voronoi clipped = voronoi(mesh);
    for (const auto& cells : clipped.cells_on_edge.colwise())
      if (cells(1) < 0)
        marks[static_cast<std::size_t>(cells(0))] = 1;
  }
  return marks;
}

DoubleVector own_widths(const Mesh& mesh, const Marks& at_boundary) {
  const Stars stars(faces_of(mesh));
  const DoubleVector areas = in_space_of(mesh.surface, [&](const Space auto& space) {
    return cell_areas(mesh, space, stars, at_boundary);
  });
  DoubleVector widths(areas.size());
  for_each_block(areas.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      double sum = areas[i] > 0 ? std::log(areas[i]) : 0;
      int count = areas[i] > 0;
      stars.for_each_neighbour(static_cast<std::int32_t>(i), [&](std::int32_t other) {
        if (areas[other] > 0) {
          sum += std::log(areas[other]);
          ++count;
        }
      });
      widths[i] = count > 0 ? density_detail::hexagon_width(std::exp(sum / count)) : 0;
    }
  });
  return widths;
}

void complete_widths(const Mesh& mesh, const IdLists& neighbours, DoubleVector& widths) {
  in_space_of(mesh.surface, [&](const Space auto& space) {
    for (std::int32_t i = 0; i < widths.size(); ++i) {
      if (widths[i] > 0)
        continue;
      for (const std::int32_t other : neighbours[i])
        widths[i] += norm(chord(space, mesh, i, other)) / static_cast<double>(neighbours.count(i));
    }
  });
}

WantedWidths wanted_widths(const Mesh& mesh, const IdLists& neighbours, Marks stays,
                           const DoubleVector& own, const DoubleVector& demanded, Way way,
                           double tolerance, double gradient) {
  const bool finer = way == Way::finer;
  WantedWidths wanted{own, std::move(stays), 0};
  Marks changes(static_cast<std::size_t>(own.size()), 0);
  const auto has = [](const Marks& marks, std::int32_t i) {
    return marks[static_cast<std::size_t>(i)] != 0;
  };
  std::vector<std::int32_t> changed;
  for (std::int32_t i = 0; i < own.size(); ++i) {
    const bool unmet = own[i] > 0 && (finer ? demanded[i] < (1 - tolerance) * own[i]
                                            : demanded[i] > (1 + tolerance) * own[i]);
    if (!unmet)
      continue;
    wanted.held += has(wanted.stays, i) ? 1 : 0;
    if (has(wanted.stays, i))
      continue;
    changes[static_cast<std::size_t>(i)] = 1;
    wanted.width[i] = demanded[i];
    changed.push_back(i);
  }

  // Finer widths spread from all sites that change, coarser ones from unchanged sites beside them.
  Sources narrow;
  for (const std::int32_t i : changed) {
    if (finer)
      narrow.emplace_back(wanted.width[i], i);
    else
      for (const std::int32_t other : neighbours[i])
        if (!has(changes, other))
          narrow.emplace_back(own[other], other);
  }
  spread(mesh, neighbours, narrow, gradient, wanted.width,
         [&](std::int32_t i) { return finer ? !has(wanted.stays, i) : has(changes, i); });
  if (!finer)
    return wanted;

  // Beside sites that stay, widths are at least theirs minus what the gradient allows.
  Sources wide;
  for (std::int32_t i = 0; i < own.size(); ++i)
    if (has(wanted.stays, i) && own[i] > 0)
      wide.emplace_back(-own[i], i);
  DoubleVector least = -wanted.width;
  spread(mesh, neighbours, wide, gradient, least,
         [&](std::int32_t i) { return !has(wanted.stays, i) && wanted.width[i] < own[i]; });
  wanted.width = (-least).cwiseMin(own);
  for (const std::int32_t i : changed)
    wanted.held += wanted.width[i] > (1 + tolerance) * demanded[i] ? 1 : 0;
  return wanted;
}

std::vector<PatchRegion> find_patches(const Mesh& mesh, const IdLists& neighbours,
                                      const DoubleVector& own, const WantedWidths& wanted,
                                      int rows_that_adapt) {
  constexpr double least_change = 0.01;
  constexpr int rows_that_stay = 1; // and one more, the rim of their stars
  const auto n = static_cast<std::size_t>(mesh.points.cols());
  Marks is_free(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto site = static_cast<Eigen::Index>(i);
    is_free[i] = own[site] > 0 && std::abs(wanted.width[site] / own[site] - 1) > least_change;
  }
  for (int row = 0; row < rows_that_adapt; ++row) { // not around or across a boundary
    is_free = grown(neighbours, std::move(is_free), 1);
    for (std::size_t i = 0; i < n; ++i)
      if (wanted.stays[i] != 0)
        is_free[i] = 0;
  }
  free_whole_islands(mesh, is_free);
  Marks triangles = mark_stars(mesh, grown(neighbours, is_free, rows_that_stay));
  separate(mesh, triangles);
  Marks left = triangles;
  std::vector<PatchRegion> patches;
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    if (left[static_cast<std::size_t>(t)] != 0)
      patches.push_back(make_patch(mesh, is_free, take_component(mesh, left, t)));
  return patches;
}

} // namespace calotte::grids_detail
