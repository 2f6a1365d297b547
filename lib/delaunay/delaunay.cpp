// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"

#include "base/clock.h"
#include "base/monitor.h"
#include "delaunay/centres.h"
#include "delaunay/cull.h"
#include "delaunay/divide.h"
#include "delaunay/owners.h"
#include "delaunay/periodic.h"
#include "delaunay/regions.h"
#include "delaunay/sample.h"
#include "delaunay/unite.h"
#include "domain/surface.h"

#include <calotte/error.h>
#include <calotte/mesh.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <type_traits>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace calotte::delaunay_detail {
namespace {

/// The ends of the stages, as fractions of the run time.
constexpr double sites_made = 0.25, divided = 0.35, triangulated = 0.8, united = 0.99;

/// The results of the triangulation of regions, for the union.
struct Reports {
  explicit Reports(std::int64_t sites) : triangles_of(sites) {}
  std::vector<RegionTriangles> regions;
  Array<std::int32_t> triangles_of; ///< by site, see report_triangles
};

void add(DelaunayReport& report, const PredicateCounts& counts) {
  report.filtered_predicates += counts.filtered;
  report.exact_predicates += counts.exact;
}

/// Refuses sites that span no triangle.
[[noreturn]] void refuse_degenerate(const Sites& sites) {
  throw Error(ErrorCode::degenerate,
              sites.frame
                  ? "all sites lie on one line: add a site off it, they span no triangle"
                  : "all sites lie on one great circle: add a site off it, they span no triangle");
}

/// Triangulates the whole set as one region, on the sphere from its centre. No triangle needs a
/// certificate.
template <class Chart> Reports triangulate_whole(const Sites& sites, DelaunayReport& report) {
  std::vector<Member> members(static_cast<std::size_t>(sites.size()));
  for (std::size_t r = 0; r < members.size(); ++r)
    members[r] = {static_cast<std::int32_t>(r), 0};
  Triangulation<Chart> triangulation{Chart(sites)};
  if (!triangulation.build(members))
    refuse_degenerate(sites);
  certify_all(triangulation);
  Reports reports(sites.size());
  reports.regions.push_back(
      report_triangles(triangulation, sites, Array<std::int32_t>(), reports.triangles_of));
  add(report, triangulation.chart().counts());
  report.serial = true;
  report.regions = 1;
  report.overlap = 1;
  report.sites_per_region = report.owned_per_region = {sites.size()};
  return reports;
}

struct CapResult {
  RegionTriangles triangles;
  CullCounts cull;
  PredicateCounts predicates;
  std::int64_t members = 0, owned = 0, seams = 0;
  double seconds = 0;
};

/// Triangulates one region: gather, project, triangulate, cull and certify. False if that fails for
/// its cap.
template <class Chart>
bool triangulate_cap(const Sites& sites, const Regions& regions, std::int32_t k, Reports& reports,
                     CapResult& result) {
  Clock::time_point start = Clock::now();
  std::vector<Member> members = gather<Chart>(sites, regions, k);
  const auto count_owned = [&] {
    return std::count_if(members.begin(), members.end(), [](const Member& m) { return m.owned(); });
  };
  result.owned = count_owned();
  if (result.owned == 0)
    return true;
  const Vec3& centre = regions.centres[static_cast<std::size_t>(k)];
  double reach = 0;
  for (const Member& m : members)
    reach = std::max(reach, dot(sites.unit[m.rank] - centre, sites.unit[m.rank] - centre));
  reach = 1.000001 * std::sqrt(reach);
  const Chart chart(sites, centre, reach);
  if (!Chart::has_all_points(reach)) {
    std::erase_if(members, [&](const Member& m) { return !chart.has_point(m.rank); });
    if (count_owned() != result.owned) // one of its own sites is at the focus
      return false;
  }
  Triangulation<Chart> triangulation(chart);
  if (!triangulation.build(members)) // too few, or on one line: add sites from outside
    triangulation = build_with_sample<Chart>(chart, sites.size(), members);
  if (triangulation.members().empty() || !certify(triangulation, sites, regions, k, result.cull))
    return false;
  result.triangles = report_triangles(triangulation, sites, regions.owner, reports.triangles_of);
  result.predicates = triangulation.chart().counts();
  result.members = std::ssize(triangulation.members());
  result.seams = result.triangles.own_seams();
  result.seconds = restart_clock(start);
  return true;
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
    report.seam_triangles += cap.seams;
    add(report, cap.predicates);
  }
  report.regions = static_cast<int>(caps.size());
  report.overlap = static_cast<double>(members) / static_cast<double>(sites);
}

/// Adds the regions whose caps lack sites that they own, which a rounded bisector has removed.
void add_incomplete(const std::vector<CapResult>& caps, const Array<std::int32_t>& owner,
                    std::vector<char>& failed) {
  std::vector<std::int64_t> owned(caps.size(), 0);
  for (const std::int32_t k : owner)
    ++owned[static_cast<std::size_t>(k)];
  for (std::size_t k = 0; k < caps.size(); ++k)
    failed[k] |= static_cast<char>(caps[k].owned != owned[k]);
}

/// Triangulates all regions, each in its own task. Regions that cannot certify their sites are
/// merged; the merged regions and their neighbours are triangulated again. Empty if that does not
/// suffice.
template <class Chart>
std::optional<Reports> triangulate_caps(const Sites& sites, Regions& regions,
                                        DelaunayReport& report, Monitor& monitor) {
  Reports reports(sites.size());
  std::vector<CapResult> caps(regions.centres.size());
  std::vector<char> failed(caps.size(), 0);
  std::vector<std::int32_t> list = all_of(regions.centres);
  for (const bool last : {false, true}) {
    std::atomic<std::int64_t> failures = 0;
    const std::int64_t most =
        last ? 0 : std::ssize(caps) / 2; // more would make most sites one region
    monitor.begin("triangulate", triangulated, std::ssize(list));
    for_each_task(std::ssize(list), [&](std::int64_t i) {
      if (failures.load(std::memory_order_relaxed) > most)
        return;
      const std::int32_t k = list[static_cast<std::size_t>(i)];
      CapResult cap;
      const bool done = triangulate_cap<Chart>(sites, regions, k, reports, cap);
      if (!done)
        failures += cap.cull.hull ? std::ssize(caps) : 1; // merging does not help at a hull
      failed[static_cast<std::size_t>(k)] = static_cast<char>(!done);
      caps[static_cast<std::size_t>(k)] = done ? std::move(cap) : CapResult{};
      monitor.step();
    });
    if (failures > most)
      return std::nullopt;
    add_incomplete(caps, regions.owner, failed);
    if (std::count(failed.begin(), failed.end(), 0) == std::ssize(failed))
      break;
    list = last ? std::vector<std::int32_t>() : merge_failed(sites, failed, regions);
    if (list.empty())
      return std::nullopt;
  }
  summarise(caps, sites.size(), report);
  for (CapResult& cap : caps)
    reports.regions.push_back(std::move(cap.triangles));
  return reports;
}

Mesh make_mesh(Sites&& sites, Reports&& reports, Monitor* monitor = nullptr) {
  Mesh mesh{std::move(sites.points), {}, {}, std::move(sites.site_of_input)};
  sites = {}; // frees what is left of the sites
  unite(std::move(reports.regions), std::move(reports.triangles_of), mesh, monitor);
  return mesh;
}

template <class Chart, class Points>
Sites make_chart_sites(Points&& points, Duplicates duplicates, double merge_within,
                       Monitor* monitor = nullptr) {
  if constexpr (std::is_same_v<Chart, PlaneChart>)
    return make_planar_sites(points, duplicates, merge_within, monitor);
  else
    return make_sites(std::forward<Points>(points), duplicates, merge_within, monitor);
}

/// The mesh of centres; none if they are too few, coincide, or lie on one line, or on the sphere in
/// a hemisphere.
template <class Chart, class Points> std::optional<Mesh> triangulate_centres(const Points& points) {
  try {
    Sites sites = make_chart_sites<Chart>(points, Duplicates::merge, 0);
    DelaunayReport unused;
    Reports reports = triangulate_whole<Chart>(sites, unused);
    Mesh mesh = make_mesh(std::move(sites), std::move(reports));
    if (mesh.points.cols() == points.cols() && (std::is_same_v<Chart, PlaneChart> || mesh.closed()))
      return mesh;
  } catch (const Error&) {
  }
  return std::nullopt;
}

/// For each centre the centres whose coarse Voronoi cells meet its own: its neighbours in the
/// Delaunay triangulation of the centres, or all others if there is no such triangulation.
IdLists adjacent_centres(const std::vector<Vec3>& centres, bool planar) {
  const std::int64_t count = std::ssize(centres);
  Points3 points(3, count);
  for (std::int64_t k = 0; k < count; ++k)
    set_column(points, k, centres[static_cast<std::size_t>(k)]);
  const std::optional<Mesh> mesh = planar ? triangulate_centres<PlaneChart>(points.topRows<2>())
                                          : triangulate_centres<SphereChart>(points);
  if (mesh)
    return neighbours(*mesh);
  IdLists all;
  all.begin.setZero(count + 1);
  all.items.resize(count * (count - 1));
  for (std::int32_t k = 0; k < count; ++k) {
    all.begin[k + 1] = (k + 1) * (count - 1);
    std::int32_t other = 0;
    for (std::int32_t& id : all[k]) {
      other += other == k ? 1 : 0;
      id = other++;
    }
  }
  return all;
}

} // namespace

Regions divide(const Sites& sites, const Decomposition& decomposition) {
  std::vector<Vec3> centres = make_centres(sites, decomposition);
  if (centres.size() == 1)
    return {std::move(centres), {}, {}, {}};
  const IdLists adjacent = adjacent_centres(centres, sites.frame.has_value());
  return make_regions(sites, std::move(centres), adjacent, decomposition.overlap);
}

namespace {

/// Computes the mesh from sites and regions; in a plane its points have z = 0. Each array is freed
/// after its last use, because the largest sets take all of the memory.
template <class Chart>
Mesh triangulate_regions(Sites&& sites, Regions&& regions, DelaunayReport& report,
                         Monitor& monitor) {
  Clock::time_point mark = Clock::now();
  sites.cells = {};
  std::optional<Reports> reports;
  if (regions.centres.size() > 1)
    reports = triangulate_caps<Chart>(sites, regions, report, monitor);
  regions = {};
  if (!reports) {
    monitor.begin("triangulate", triangulated, 1);
    reports = triangulate_whole<Chart>(sites, report);
  }
  report.seconds.triangulate = restart_clock(mark);

  monitor.begin("unite", united, 2 * std::ssize(reports->regions));
  Mesh mesh = make_mesh(std::move(sites), std::move(*reports), &monitor);
  mesh.surface = Chart::surface();
  report.seconds.unite = restart_clock(mark);
  return mesh;
}

/// Returns to the system what the reports of many sites took: between blocks that stay, the C
/// library would keep half a gigabyte of 10 million.
void return_memory([[maybe_unused]] std::int64_t sites) {
#ifdef __GLIBC__
  constexpr std::int64_t many = 1 << 23;
  if (sites > many)
    malloc_trim(0);
#endif
}

template <class Chart>
Mesh triangulate(Sites&& sites, const Decomposition& decomposition, DelaunayReport& report,
                 Monitor& monitor) {
  Clock::time_point mark = Clock::now();
  monitor.begin("regions", divided, 1);
  Regions regions = divide(sites, decomposition);
  report.seconds.regions = restart_clock(mark);
  Mesh mesh = triangulate_regions<Chart>(std::move(sites), std::move(regions), report, monitor);
  return_memory(mesh.points.cols());
  return mesh;
}

template <class Chart, class Points>
Sites prepare_sites(Points&& points, const DelaunayOptions& options, DelaunayReport& report,
                    Monitor& monitor) {
  monitor.begin("sites", sites_made, site_steps);
  Clock::time_point mark = Clock::now();
  Sites sites = make_chart_sites<Chart>(std::forward<Points>(points), options.duplicates,
                                        options.merge_within, &monitor);
  report = {};
  report.threads = thread_count();
  report.sites = sites.size();
  report.duplicates = std::ssize(sites.site_of_input) - sites.size();
  report.seconds.sites = restart_clock(mark);
  return sites;
}

template <class Points>
Mesh triangulate_sphere(Points&& points, const DelaunayOptions& options, DelaunayReport& report) {
  Clock::time_point start = Clock::now();
  Monitor monitor(options.progress);
  Sites sites = prepare_sites<SphereChart>(std::forward<Points>(points), options, report, monitor);
  Mesh mesh = triangulate<SphereChart>(std::move(sites), options.decomposition, report, monitor);
  report.seconds.total = restart_clock(start);
  monitor.finish();
  return mesh;
}

} // namespace

Mesh mesh_of_sphere(const Points3Ref& points, const DelaunayOptions& options,
                    DelaunayReport& report) {
  return triangulate_sphere(points, options, report);
}

Mesh mesh_of_sphere(Points3&& points, const DelaunayOptions& options, DelaunayReport& report) {
  return triangulate_sphere(std::move(points), options, report);
}

Mesh mesh_of_plane(const Points2Ref& points, const DelaunayOptions& options,
                   DelaunayReport& report) {
  Clock::time_point start = Clock::now();
  Monitor monitor(options.progress);
  Sites sites = prepare_sites<PlaneChart>(points, options, report, monitor);
  Mesh mesh = triangulate<PlaneChart>(std::move(sites), options.decomposition, report, monitor);
  report.seconds.total = restart_clock(start);
  monitor.finish();
  return mesh;
}

Mesh mesh_of_box(const Points2Ref& points, const Surface& box, const DelaunayOptions& options,
                 DelaunayReport& report) {
  Clock::time_point start = Clock::now();
  require_inside(with_z(points), box);
  Monitor monitor(options.progress);
  Sites sites = prepare_sites<PlaneChart>(points, options, report, monitor);
  const auto triangulate_images = [&](std::vector<Image> images, const Vec2& period) {
    Sites copies = make_sites(std::move(images), period);
    report.sites_per_region.clear();
    report.owned_per_region.clear();
    report.seconds_per_region.clear();
    return triangulate<PlaneChart>(std::move(copies), options.decomposition, report, monitor);
  };
  Mesh mesh = triangulate_periodic(sites.points, box, triangulate_images);
  mesh.site_of_input = std::move(sites.site_of_input);
  report.seconds.total = restart_clock(start);
  monitor.finish();
  return mesh;
}

Mesh spherical_mesh(Sites&& sites, Regions&& regions) {
  DelaunayReport unused;
  Monitor monitor({});
  return triangulate_regions<SphereChart>(std::move(sites), std::move(regions), unused, monitor);
}

} // namespace calotte::delaunay_detail
