// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/region_world.h"

#include "base/first_fault.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "cvt/cvt.h"
#include "cvt/insertion.h"
#include "cvt/region_cells.h"
#include "delaunay/sites.h"
#include "mesh/adjacency.h"
#include "mesh/canonical_order.h"
#include "mesh/edges.h"

#include <calotte/error.h>
#include <calotte/generators.h>

#include <algorithm>
#include <string>
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

Mesh mesh_of(Points3&& points, Triangles&& triangles) {
  Triangles neighbours = neighbours_of(triangles, points.cols());
  make_canonical(triangles, neighbours);
  std::vector<std::int32_t> sites = themselves(points.cols());
  return {std::move(points), std::move(triangles), std::move(neighbours), std::move(sites)};
}

/// Sets the state's generators, in curve order.
void set_generators(State& state, const Sites& sites) { set_points(state, sites, sites.unit); }

bool all_inside(const SphericalOutline& outline, const Points3& points) {
  return holds_for_blocks(points.cols(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      if (outline.side(column(points, i)) == Side::outside)
        return false;
    return true;
  });
}

/// \param fixed number of fixed generators, the first points.
/// \throws Error invalid_argument with the index of the first point outside.
void require_inside(const SphericalOutline& outline, const Points3Ref& points, std::int64_t fixed) {
  FirstFault outside;
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      if (outline.side(column(points, i)) == Side::outside)
        outside.at(i);
  });
  outside.refuse(outside.index() < fixed ? "fixed generator" : "generator",
                 "is outside the region; give points inside it, or a larger region");
}

} // namespace

Begun RegionWorld::begin(const Points3Ref& start, const CvtOptions& options) const {
  Sites sites =
      distinct_units(make_sites(start, options.duplicates, options.merge_within), options);
  require_inside(*outline_, start, options.fixed);
  if (sites.size() < fewest)
    throw Error(ErrorCode::too_few_sites, "there are " + std::to_string(sites.size()) +
                                              " distinct generators: give at least " +
                                              std::to_string(fewest));
  require_fixed(sites, options.fixed);
  State state;
  state.fixed = options.fixed;
  set_generators(state, sites);
  state.site_of_input = std::move(sites.site_of_input);
  state.bisections_left = options.bisections;
  return {std::move(state), {}};
}

void RegionWorld::require_points(const State& state) const {
  if (state.points.cols() < fewest ||
      !((state.points.colwise().squaredNorm().array() - 1).abs() < 1e-12).all() ||
      !all_inside(*outline_, state.points))
    refuse_state();
}

Mesh RegionWorld::triangulated(Points3&& points) const {
  RegionCells cells(outline_, Boundary::clip);
  cells.move(points);
  const Connectivity all = cells.signs().triangulate();
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(all.triangles.cols()));
  for (Eigen::Index t = 0; t < all.triangles.cols(); ++t)
    keep[static_cast<std::size_t>(t)] = all.triangles.col(t).maxCoeff() < points.cols() ? 1 : 0;
  return mesh_of(std::move(points), selected(all.triangles, keep));
}

Mesh RegionWorld::inner(Mesh&& mesh, Boundary boundary) const {
  RegionCells cells(outline_, boundary);
  cells.move(mesh.points);
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(mesh.triangles.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    keep[static_cast<std::size_t>(t)] =
        cells.has_centre(mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)) ? 1 : 0;
  Triangles triangles = selected(mesh.triangles, keep);
  keep.assign(static_cast<std::size_t>(triangles.cols()), 1);
  while (drop_small_fans(triangles, mesh.points.cols(), keep) > 0) {
    triangles = selected(triangles, keep);
    keep.assign(static_cast<std::size_t>(triangles.cols()), 1);
  }
  std::vector<std::int32_t> sites = std::move(mesh.site_of_input);
  mesh = mesh_of(std::move(mesh.points), std::move(triangles));
  mesh.site_of_input = std::move(sites);
  return std::move(mesh);
}

Level RegionWorld::set_bisected(State& state, const Mesh& coarse) const {
  std::vector<Eigen::Index> inside;
  const Points3 all = bisect(coarse);
  for (Eigen::Index i = 0; i < coarse.points.cols(); ++i)
    inside.push_back(i);
  Eigen::Index next = coarse.points.cols();
  mesh_detail::for_each_edge(coarse, [&](std::int32_t a, std::int32_t b) {
    const bool fixed = std::max(a, b) < state.fixed &&
                       lies_along(*outline_, column(coarse.points, a), column(coarse.points, b));
    if (!fixed && outline_->side(column(all, next)) == Side::inside)
      inside.push_back(next);
    ++next;
  });
  set_generators(state, make_sites(Points3(all(Eigen::all, inside)), Duplicates::refuse, 0));
  return {};
}

Level RegionWorld::set_split_and_collapsed(State& state, const Mesh& mesh, const Density& density,
                                           const EdgeChanges& changes) const {
  set_generators(state, make_sites(split_and_collapsed(mesh, *outline_, density, changes),
                                   Duplicates::refuse, 0));
  return {};
}

} // namespace calotte::cvt_detail
