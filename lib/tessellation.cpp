// SPDX-License-Identifier: GPL-3.0-or-later
#include "tessellation.h"

#include "clock.h"
#include "divide.h"
#include "parallel.h"
#include "points.h"

#include <calotte/error.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace calotte::detail {
namespace {

/// Bytes of positions that each region would send: three doubles for each of its sites that is in
/// another one's halo.
void count_halos(const Regions& regions, std::vector<CvtRegion>& out) {
  for (std::size_t k = 0; k < regions.members.size(); ++k)
    for (const Run& run : regions.members[k])
      for (std::int32_t r = run.begin; r != run.end; ++r) {
        const auto owner = static_cast<std::size_t>(regions.owner[r]);
        if (owner == k)
          continue;
        ++out[k].halo;
        out[owner].halo_bytes += static_cast<std::int64_t>(3 * sizeof(double));
      }
}

} // namespace

Tessellation::Tessellation(const Points3& points, const DelaunayOptions& partition)
    : partition_(partition), mesh_(triangulate_closed(points)) {
  divide(points);
}

void Tessellation::divide(const Points3& points) {
  const Sites sites = make_sites(points, Duplicates::merge, 0);
  if (sites.size() != points.cols()) // two have met: the old regions do, repair() will say it
    return;
  const Regions regions = detail::divide(sites, partition_);
  const std::size_t count = regions.centres.size();
  Array<std::int32_t> owner(points.cols());
  for (std::int64_t r = 0; r < owner.size(); ++r)
    owner[sites.id[r]] = count > 1 ? regions.owner[r] : 0;
  ownership_ = make_ownership(std::move(owner), static_cast<std::int32_t>(count));
  patches_ = make_patches(mesh_.triangles, ownership_);
  std::vector<CvtRegion> reports(count);
  if (count > 1)
    count_halos(regions, reports);
  work_ = std::vector<Work>(count);
  for (std::size_t k = 0; k < count; ++k) {
    work_[k].report = reports[k];
    work_[k].report.sites = patches_[k].owned;
  }
  drift_ = 0;
}

void Tessellation::exchange(const Patch& patch, const Points3& points, Work& work) const {
  const std::int64_t count = std::ssize(patch.sites);
  if (work.x.size() != count) {
    work.x = Array<Vec3>(count);
    work.moments = Array<CellMoments>(count);
  }
  for (std::int64_t i = 0; i < count; ++i)
    work.x[i] = column(points, patch.sites[static_cast<std::size_t>(i)]);
}

void Tessellation::find_faults(const Patch& patch, const Points3& points, Work& work) const {
  for (const std::int32_t suspect : work.suspects)
    add_faults(mesh_, points, patch.triangles[static_cast<std::size_t>(suspect)], work.faults);
}

/// Runs the task of each region; its faults and effort are added up in the order of the regions.
template <class Task> Faults Tessellation::run_tasks(const Task& task, Effort& effort) {
  for_each_task(std::ssize(patches_), [&](std::int64_t k) {
    Work& work = work_[static_cast<std::size_t>(k)];
    work.suspects.clear();
    work.faults = {};
    work.effort = {};
    Clock::time_point start = Clock::now();
    task(patches_[static_cast<std::size_t>(k)], work);
    work.report.seconds += lap(start);
  });
  Faults all;
  for (const Work& work : work_) {
    all.edges.insert(all.edges.end(), work.faults.edges.begin(), work.faults.edges.end());
    all.overturned = all.overturned || work.faults.overturned;
    effort.seconds_exchange += work.effort.seconds_exchange;
    effort.seconds_repair += work.effort.seconds_repair;
    effort.seconds_moments += work.effort.seconds_moments;
  }
  return all;
}

void Tessellation::mend(const Points3& points, const Faults& faults, Effort& effort) {
  Clock::time_point start = Clock::now();
  const Repair repaired = repair(mesh_, points, faults);
  if (repaired.rebuilt)
    patches_ = make_patches(mesh_.triangles, ownership_);
  else
    renew_patches(patches_, mesh_.triangles, ownership_, repaired.changed);
  effort.flips += repaired.flips;
  effort.rebuilt = effort.rebuilt || repaired.rebuilt;
  effort.seconds_repair += lap(start);
}

Tessellation::Effort Tessellation::evaluate(const Points3& points, const Integrand& integrand,
                                            const Receiver& receive) {
  Effort effort;
  const double h = std::sqrt(4 * std::numbers::pi / static_cast<double>(points.cols()));
  if (drift_ > h)
    divide(points);
  if (restless_) {
    const Faults faults = run_tasks(
        [&](const Patch& patch, Work& work) {
          Clock::time_point mark = Clock::now();
          exchange(patch, points, work);
          work.effort.seconds_exchange = lap(mark);
          find_suspects(patch, work.x, work.suspects);
          find_faults(patch, points, work);
          work.effort.seconds_repair = lap(mark);
        },
        effort);
    if (!faults.none())
      mend(points, faults, effort);
  }
  const auto integrate_region = [&](const Patch& patch, Work& work) {
    Clock::time_point mark = Clock::now();
    exchange(patch, points, work);
    work.effort.seconds_exchange = lap(mark);
    integrate(integrand, patch, work.x, work.moments, nullptr, work.suspects);
    work.effort.seconds_moments = lap(mark);
    find_faults(patch, points, work);
    work.effort.seconds_repair = lap(mark);
    if (work.faults.none())
      receive(patch, work.x, work.moments);
    work.effort.seconds_moments += lap(mark);
  };
  // After a mending nothing is left to mend: twice is the most that this takes.
  for (Faults faults = run_tasks(integrate_region, effort); !faults.none();
       faults = run_tasks(integrate_region, effort))
    mend(points, faults, effort);
  restless_ = effort.flips > 0 || effort.rebuilt;
  return effort;
}

std::vector<CvtRegion> Tessellation::regions() const {
  std::vector<CvtRegion> reports;
  for (const Work& work : work_)
    reports.push_back(work.report);
  return reports;
}

} // namespace calotte::detail
