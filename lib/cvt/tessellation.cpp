// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/tessellation.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "cvt/planar_cells.h"
#include "cvt/spherical_cells.h"
#include "delaunay/divide.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace calotte::cvt_detail {
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

template <class Cells>
Tessellation<Cells>::Tessellation(Cells cells, const Points3& points,
                                  const DelaunayOptions& partition)
    : cells_(std::move(cells)), generators_(points.cols()), partition_(partition) {
  cells_.move(points);
  mesh_ = cells_.signs().triangulate();
  divide();
}

/// The decomposition's own arrays are gone before the patches are made.
template <class Cells>
std::optional<typename Tessellation<Cells>::Division> Tessellation<Cells>::divided() const {
  const Sites sites = cells_.sites();
  if (sites.size() != generators_)
    return std::nullopt;
  const Regions regions = delaunay_detail::divide(sites, partition_);
  const std::size_t count = regions.centres.size();
  Division result{Array<std::int32_t>(cells_.places()), std::vector<CvtRegion>(count)};
  std::fill(result.owner.begin() + generators_, result.owner.end(), 0);
  for_each_block(generators_, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r != end; ++r)
      result.owner[sites.id[r]] = count > 1 ? regions.owner[r] : 0;
  });
  if (count > 1)
    count_halos(regions, result.reports);
  return result;
}

template <class Cells> void Tessellation<Cells>::divide() {
  patches_.clear(); // sorting takes as much memory
  std::optional<Division> division = divided();
  if (!division) { // two have met: the old regions do, a new triangulation will say it
    patches_ = make_patches(mesh_.triangles, ownership_);
    return;
  }
  const std::size_t count = division->reports.size();
  ownership_ = make_ownership(std::move(division->owner), static_cast<std::int32_t>(count));
  patches_ = make_patches(mesh_.triangles, ownership_);
  work_ = std::vector<Work>(count);
  for (std::size_t k = 0; k < count; ++k) {
    work_[k].report = division->reports[k];
    work_[k].report.sites = patches_[k].owned;
  }
  drift_ = 0;
}

/// Positions of a patch's sites, by local number.
template <class Cells> Array<Vec3> Tessellation<Cells>::exchange(const Patch& patch) const {
  Array<Vec3> x(std::ssize(patch.sites));
  for (std::int64_t i = 0; i < x.size(); ++i)
    x[i] = cells_.place(patch.sites[static_cast<std::size_t>(i)]);
  return x;
}

template <class Cells> void Tessellation<Cells>::find_faults(const Patch& patch, Work& work) const {
  const auto signs = cells_.signs();
  for (const std::int32_t suspect : work.suspects)
    add_faults(mesh_, signs, patch.triangles[static_cast<std::size_t>(suspect)], work.faults);
}

/// Runs the task of each region; its faults and effort are added up in the order of the regions.
template <class Cells>
template <class Task>
Faults Tessellation<Cells>::run_tasks(const Task& task, Effort& effort) {
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

template <class Cells>
void Tessellation<Cells>::mend(const Faults& faults, const Room& room, Effort& effort) {
  Clock::time_point start = Clock::now();
  if (const std::optional<Repair> repaired = repair(mesh_, cells_.signs(), faults)) {
    renew_patches(patches_, mesh_.triangles, ownership_, repaired->changed);
    effort.flips += repaired->flips;
  } else {
    room.give_up();
    patches_.clear();
    mesh_ = {};
    mesh_ = cells_.signs().triangulate();
    patches_ = make_patches(mesh_.triangles, ownership_);
    effort.rebuilt = true;
  }
  effort.seconds_repair += lap(start);
}

template <class Cells>
typename Tessellation<Cells>::Effort
Tessellation<Cells>::evaluate(const Points3& points, const Integrand& integrand,
                              const Receiver& receive, const Room& room) {
  Effort effort;
  cells_.move(points);
  if (drift_ > cells_.spacing()) {
    room.give_up();
    divide();
  }
  if (restless_) {
    const Faults faults = run_tasks(
        [&](const Patch& patch, Work& work) {
          Clock::time_point mark = Clock::now();
          const Array<Vec3> x = exchange(patch);
          work.effort.seconds_exchange = lap(mark);
          cells_.find_suspects(patch, x, work.suspects);
          find_faults(patch, work);
          work.effort.seconds_repair = lap(mark);
        },
        effort);
    if (!faults.none())
      mend(faults, room, effort);
  }
  const auto integrate_region = [&](const Patch& patch, Work& work) {
    Clock::time_point mark = Clock::now();
    const Array<Vec3> x = exchange(patch);
    Array<CellMoments> moments(x.size());
    work.effort.seconds_exchange = lap(mark);
    cells_.integrate(integrand, patch, x, moments, work.suspects);
    work.effort.seconds_moments = lap(mark);
    find_faults(patch, work);
    work.effort.seconds_repair = lap(mark);
    if (work.faults.none())
      receive(patch, x, moments);
    work.effort.seconds_moments += lap(mark);
  };
  const auto integrate_all = [&] {
    room.take();
    return run_tasks(integrate_region, effort);
  };
  // After a mending nothing is left to mend: twice is the most that this takes.
  for (Faults faults = integrate_all(); !faults.none(); faults = integrate_all())
    mend(faults, room, effort);
  restless_ = effort.flips > 0 || effort.rebuilt;
  return effort;
}

template <class Cells> std::vector<CvtRegion> Tessellation<Cells>::regions() const {
  std::vector<CvtRegion> reports;
  for (const Work& work : work_)
    reports.push_back(work.report);
  return reports;
}

template class Tessellation<SphericalCells>;
template class Tessellation<PlanarCells>;

} // namespace calotte::cvt_detail
