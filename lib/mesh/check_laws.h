// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/monitor.h"
#include "base/parallel.h"
#include "mesh/array_laws.h"
#include "mesh/closed_laws.h"
#include "mesh/failures.h"
#include "mesh/ring_law.h"
#include "mesh/shape_laws.h"

#include <calotte/check.h>

#include <cstdint>
#include <string>

/// The laws that check() proves, for a surface of either kind: a Surface has Faces and knows
///
///     circle                     what the predicate's circle is called, after "circum"
///     orientation(a, b, c)       of three sites near a
///     in_circle(a, b, c, d)      of four sites near a, ties resolved
///     stored(site)               address of the coordinates that the predicates read first
///     cube_faces, square(site)   position of a site, for a Traversal
///     own_failure(t)             failure of a triangle that only this kind of surface has
///     euler(boundary edges)      the characteristic that it must have
///     area(t)                    of a triangle known to be counter-clockwise
///     set_area(sum, result)      sets what result tells of the areas
///     area_failure(sum, result)  failure of the areas' sum
namespace calotte::mesh_detail {

/// The property to prove: that a mesh is the Delaunay triangulation of its points, or that it is a
/// surface of counter-clockwise triangles, which need be neither Delaunay nor convex nor simply
/// connected.
enum class Proof { delaunay, surface };

/// Tests the laws in an order in which each may rely on those before it.
/// \param site_failure(i) the failure of a site alone.
/// \param surface called when all sites are valid.
template <class SiteFailure, class MakeSurface>
std::string first_broken_law(const Mesh& mesh, const SiteFailure& site_failure,
                             const MakeSurface& surface, Proof proof, CheckReport& result,
                             Monitor& monitor) {
  std::string failure = shape_failure(mesh);
  const auto holds = [&](std::int64_t n, const auto& law) {
    failure = first_failure(n, law, monitor);
    return failure.empty();
  };
  const auto holds_of_edges = [&](const auto& law) {
    failure = first_edge_failure(mesh.triangles.cols(), law, monitor);
    return failure.empty();
  };
  if (!failure.empty() || !holds(mesh.points.cols(), site_failure))
    return failure;
  const auto s = surface();
  const std::int64_t triangles = s.triangles();
  if (!holds(triangles, [&](std::int64_t t) { return id_failure(s, t); }) ||
      (result.boundary_edges == 0 && is_proven_closed(s, result, monitor)))
    return failure;

  // An open mesh, or one with a failure, is tested law by law.
  if (!holds(triangles, [&](std::int64_t t) { return order_failure(s, t); }) ||
      !holds_of_edges([&](std::int64_t t, int i) { return neighbour_failure(s, t, i); }) ||
      !holds(triangles, [&](std::int64_t t) { return s.own_failure(t); }) ||
      !holds(triangles, [&](std::int64_t t) { return orientation_failure(s, t); }))
    return failure;
  const Stars stars(s);
  const bool delaunay = proof == Proof::delaunay;
  if (!holds(s.sites(), [&](std::int64_t i) {
        const auto site = static_cast<std::int32_t>(i);
        return exists(stars.first(site)) || delaunay ? ring_failure(s, stars, site, delaunay)
                                                     : std::string();
      }))
    return failure;
  if (failure = delaunay ? euler_failure(s, result.boundary_edges) : ""; !failure.empty())
    return failure;
  const Area area = sum_areas(s);
  s.set_area(area.value, result);
  if (delaunay && !holds_of_edges([&](std::int64_t t, int i) { return edge_failure(s, t, i); }))
    return failure;
  return s.area_failure(area, result);
}

template <class SiteFailure, class MakeSurface>
CheckReport check_laws(const Mesh& mesh, const SiteFailure& site_failure,
                       const MakeSurface& surface, Proof proof, const ProgressCallback& progress) {
  Monitor monitor(progress);
  CheckReport result;
  result.sites = mesh.points.cols();
  result.triangles = mesh.triangles.cols();
  result.boundary_edges = count_boundary_edges(mesh.neighbours);
  const std::int64_t triangles = block_count(mesh.triangles.cols());
  monitor.begin("check", 0.99, block_count(mesh.points.cols()) + 2 * triangles);
  result.failure = first_broken_law(mesh, site_failure, surface, proof, result, monitor);
  monitor.finish();
  return result;
}

} // namespace calotte::mesh_detail
