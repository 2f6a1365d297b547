// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>

#include "clock.h"
#include "cull.h"
#include "divide.h"
#include "regions.h"
#include "unite.h"

#include <calotte/error.h>

#include <algorithm>
#include <atomic>
#include <optional>

namespace calotte {
namespace detail {
namespace {

/// The values that the stages of a triangulation by regions leave for the union.
struct Reports {
  std::vector<RegionTriangles> regions;
  Array<std::int32_t> triangles_of; ///< by site, see report_triangles
};

void add(DelaunayReport& report, const PredicateCounts& counts) {
  report.filtered_predicates += counts.filtered;
  report.exact_predicates += counts.exact;
}

/// The whole set as one region, seen from the sphere's centre: nothing is left to certify.
Reports triangulate_whole(const Sites& sites, DelaunayReport& report) {
  std::vector<Member> members(static_cast<std::size_t>(sites.size()));
  for (std::size_t r = 0; r < members.size(); ++r)
    members[r] = {static_cast<std::int32_t>(r), 0, true};
  CapTriangulation triangulation{Sphere(sites)};
  if (!triangulation.build(members))
    throw Error(ErrorCode::degenerate,
                "all sites lie on one great circle: add a site off it, they span no triangle");
  certify_all(triangulation);
  Reports reports;
  reports.triangles_of = Array<std::int32_t>(sites.size());
  reports.regions.push_back(
      report_triangles(triangulation, sites, Array<std::int32_t>(), reports.triangles_of));
  add(report, triangulation.space().counts());
  report.one_region = true;
  report.regions = 1;
  report.overlap = 1;
  report.sites_per_region = report.owned_per_region = {sites.size()};
  return reports;
}

struct CapResult {
  RegionTriangles triangles;
  CullCounts cull;
  PredicateCounts predicates;
  std::int64_t members = 0, owned = 0;
  double seconds = 0;
};

/// One region: gather, project, triangulate, cull and certify. Empty when its cap cannot certify
/// its sites.
std::optional<CapResult> triangulate_cap(const Sites& sites, const Regions& regions, std::int32_t k,
                                         Array<std::int32_t>& triangles_of) {
  Clock::time_point start = Clock::now();
  std::vector<Member> members = gather(sites, regions, k);
  const auto count_owned = [&] {
    return std::count_if(members.begin(), members.end(), [](const Member& m) { return m.owned; });
  };
  CapResult result;
  result.owned = count_owned();
  if (result.owned == 0)
    return result;
  const Vec3& centre = regions.centres[static_cast<std::size_t>(k)];
  double reach = 0;
  for (const Member& m : members) {
    const Vec3 apart = sites.unit[m.rank] - centre;
    reach = std::max(reach, dot(apart, apart));
  }
  CapTriangulation triangulation{Sphere(sites, centre, 1.000001 * std::sqrt(reach))};
  std::erase_if(members, [&](const Member& m) { return !triangulation.space().has_place(m.rank); });
  if (count_owned() != result.owned) // its own focus is a site of its own
    return std::nullopt;
  if (!triangulation.build(members) || !certify(triangulation, sites, regions, k, result.cull))
    return std::nullopt;
  result.triangles = report_triangles(triangulation, sites, regions.owner, triangles_of);
  result.predicates = triangulation.space().counts();
  result.members = std::ssize(triangulation.members());
  result.seconds = lap(start);
  return result;
}

void summarise(const std::vector<CapResult>& caps, std::int64_t sites, DelaunayReport& report) {
  std::int64_t members = 0;
  for (const CapResult& cap : caps) {
    members += cap.members;
    report.sites_per_region.push_back(cap.members);
    report.owned_per_region.push_back(cap.owned);
    report.seconds_per_region.push_back(cap.seconds);
    report.certified_by_cull += cap.cull.by_cull;
    report.certified_by_query += cap.cull.by_query;
    report.halo_insertions += cap.cull.inserted;
    for (const std::int32_t t : cap.triangles.seams)
      report.seam_triangles += cap.triangles.rank[t] >= 0;
    add(report, cap.predicates);
  }
  report.regions = static_cast<int>(caps.size());
  report.overlap = static_cast<double>(members) / static_cast<double>(sites);
}

/// All regions, a task each; empty when one of them cannot certify its sites, or when a rounded
/// bisector has cost one a site that it owns.
std::optional<Reports> triangulate_caps(const Sites& sites, const Regions& regions,
                                        DelaunayReport& report) {
  Reports reports;
  reports.triangles_of = Array<std::int32_t>(sites.size());
  std::vector<CapResult> caps(regions.centres.size());
  std::atomic<bool> failed = false;
  for_each_task(std::ssize(caps), [&](std::int64_t k) {
    if (failed.load(std::memory_order_relaxed))
      return;
    std::optional<CapResult> cap =
        triangulate_cap(sites, regions, static_cast<std::int32_t>(k), reports.triangles_of);
    if (cap)
      caps[static_cast<std::size_t>(k)] = std::move(*cap);
    else
      failed.store(true, std::memory_order_relaxed);
  });
  std::int64_t owned = 0;
  for (const CapResult& cap : caps)
    owned += cap.owned;
  if (failed || owned != sites.size())
    return std::nullopt;
  summarise(caps, sites.size(), report);
  for (CapResult& cap : caps)
    reports.regions.push_back(std::move(cap.triangles));
  return reports;
}

Mesh make_mesh(Sites&& sites, Reports&& reports) {
  Mesh mesh;
  unite(std::move(reports.regions), std::move(reports.triangles_of), mesh);
  mesh.points = std::move(sites.points);
  mesh.site_of_input = std::move(sites.site_of_input);
  return mesh;
}

/// For each centre those whose coarse Voronoi cells meet its own: its neighbours in the Delaunay
/// triangulation of the centres, or all others where those have none.
std::vector<std::vector<std::int32_t>> adjacent_centres(const std::vector<Vec3>& centres) {
  const std::size_t count = centres.size();
  std::vector<std::vector<std::int32_t>> adjacent(count);
  Points3 points(3, static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k)
    points.col(static_cast<Eigen::Index>(k)) << centres[k].x, centres[k].y, centres[k].z;
  try {
    Sites sites = make_sites(points, Duplicates::merge, 0);
    DelaunayReport unused;
    Reports reports = triangulate_whole(sites, unused);
    const Mesh mesh = make_mesh(std::move(sites), std::move(reports));
    if (mesh.closed() && mesh.points.cols() == points.cols()) {
      for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
        for (int i = 0; i < 3; ++i)
          adjacent[static_cast<std::size_t>(mesh.triangles(i, t))].push_back(
              mesh.triangles((i + 1) % 3, t));
      return adjacent;
    }
  } catch (const Error&) { // too few centres, or all on one great circle
  }
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t m = 0; m < count; ++m)
      if (m != k)
        adjacent[k].push_back(static_cast<std::int32_t>(m));
  return adjacent;
}

} // namespace

Regions divide(const Sites& sites, const DelaunayOptions& options) {
  std::vector<Vec3> centres = make_centres(sites, options);
  if (centres.size() == 1)
    return {std::move(centres), {}, {}, {}};
  const std::vector<std::vector<std::int32_t>> adjacent = adjacent_centres(centres);
  return make_regions(sites, std::move(centres), adjacent, options.sort);
}

namespace {

Mesh run(const Points3& points, const DelaunayOptions& options, DelaunayReport& report) {
  Clock::time_point start = Clock::now(), mark = start;
  Sites sites = make_sites(points, options.duplicates, options.merge_within);
  report.threads = thread_count();
  report.sites = sites.size();
  report.duplicates = points.cols() - sites.size();
  report.seconds.sites = lap(mark);

  const Regions regions = divide(sites, options);
  report.seconds.regions = lap(mark);
  std::optional<Reports> reports;
  if (regions.centres.size() > 1)
    reports = triangulate_caps(sites, regions, report);
  if (!reports)
    reports = triangulate_whole(sites, report);
  report.seconds.triangulate = lap(mark);

  Mesh mesh = make_mesh(std::move(sites), std::move(*reports));
  report.seconds.unite = lap(mark);
  report.seconds.total = lap(start);
  return mesh;
}

} // namespace
} // namespace detail

Mesh delaunay(const Points3& points, const DelaunayOptions& options, DelaunayReport* report) {
  DelaunayReport unused;
  DelaunayReport& used = report != nullptr ? *report : unused;
  used = {};
  return detail::run(points, options, used);
}

} // namespace calotte
