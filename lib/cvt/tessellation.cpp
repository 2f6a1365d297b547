// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/tessellation.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "cvt/planar_cells.h"
#include "cvt/region_cells.h"
#include "cvt/shape.h"
#include "cvt/spherical_cells.h"
#include "delaunay/divide.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace calotte::cvt_detail {
namespace {

constexpr std::int64_t sampled =
    64; ///< one point in this many represents all when motion is measured

} // namespace

/// One sort and one division serve both the triangulation and the tasks of the regions.
template <class Cells>
Tessellation<Cells>::Tessellation(Cells cells, const Points3& points, const Partition& partition,
                                  Level&& level)
    : cells_(std::move(cells)), generators_(points.cols()), partition_(partition) {
  cells_.move(points);
  Sites sites = level.sites ? std::move(*level.sites) : cells_.sites();
  if (sites.size() != generators_) // two points have met
    cells_.signs().triangulate();  // which says it
  Regions regions = delaunay_detail::divide(sites, partition_);
  Owners owners = owners_of(sites, regions);
  if (!level.mesh) {
    mesh_ = cells_.triangulate(std::move(sites), std::move(regions));
    adopt(std::move(owners));
    return;
  }
  sites = {};
  regions = {};
  mesh_ = std::move(*level.mesh);
  adopt(std::move(owners));
  Effort unused;
  if (const Faults faults = find_faults(unused); !faults.none() && !mend(faults, unused))
    rebuild(unused);
}

template <class Cells> bool Tessellation<Cells>::drifted() const {
  const double spacing = cells_.spacing();
  for (std::int64_t k = 0; k < sample_.size(); ++k) {
    const Vec3 way =
        cells_.offset(sample_[k], cells_.place(static_cast<std::int32_t>(k * sampled)));
    if (dot(way, way) > spacing * spacing)
      return true;
  }
  return false;
}

template <class Cells> void Tessellation<Cells>::note_sample() {
  sample_ = Array<Vec3>((generators_ + sampled - 1) / sampled);
  for (std::int64_t k = 0; k < sample_.size(); ++k)
    sample_[k] = cells_.place(static_cast<std::int32_t>(k * sampled));
}

template <class Cells> void Tessellation<Cells>::divide() {
  patches_.clear(); // sorting takes as much memory
  std::optional<Owners> owners;
  if (const Sites sites = cells_.sites(); sites.size() == generators_)
    owners = owners_of(sites, delaunay_detail::divide(sites, partition_));
  // If two points coincide, the old regions stay; a new triangulation will report the error.
  adopt(owners ? std::move(*owners)
               : Owners{std::move(ownership_.owner), static_cast<std::int32_t>(work_.size())});
}

template <class Cells>
typename Tessellation<Cells>::Owners Tessellation<Cells>::owners_of(const Sites& sites,
                                                                    const Regions& regions) const {
  const auto count = static_cast<std::int32_t>(regions.centres.size());
  Owners owners{Array<std::int32_t>(cells_.places()), count};
  std::fill(owners.owner.begin() + generators_, owners.owner.end(), 0);
  for_each_block(generators_, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r != end; ++r)
      owners.owner[sites.id[r]] = count > 1 ? regions.owner[r] : 0;
  });
  return owners;
}

template <class Cells> void Tessellation<Cells>::adopt(Owners&& owners) {
  ownership_ = make_ownership(std::move(owners.owner), owners.regions);
  patches_ = make_patches(mesh_.triangles, ownership_);
  work_ = std::vector<Work>(patches_.size());
  for (std::size_t k = 0; k < patches_.size(); ++k)
    work_[k].report.sites = patches_[k].owned;
  note_sample();
}

/// Positions of a patch's sites, by local number.
template <class Cells> Array<Vec3> Tessellation<Cells>::exchange(const Patch& patch) const {
  constexpr std::int64_t together = 16;
  Array<Vec3> x(std::ssize(patch.sites));
  for (std::int64_t i = 0; i < x.size();) {
    const Vec3& place = cells_.place(patch.sites[static_cast<std::size_t>(i)]);
    if (are_consecutive(patch, i, together)) { // as their places are in memory
      std::copy_n(&place, together, &x[i]);
      i += together;
    } else {
      x[i++] = place;
    }
  }
  return x;
}

template <class Cells> void Tessellation<Cells>::find_faults(const Patch& patch, Work& work) const {
  const auto signs = cells_.signs();
  for (const std::int32_t suspect : work.suspects)
    add_faults(mesh_, signs, patch.triangles[static_cast<std::size_t>(suspect)], work.faults);
}

/// Runs the task of each region, then adds faults and effort in the order of the regions.
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
    all.overturned.insert(all.overturned.end(), work.faults.overturned.begin(),
                          work.faults.overturned.end());
    effort.seconds_exchange += work.effort.seconds_exchange;
    effort.seconds_repair += work.effort.seconds_repair;
    effort.seconds_moments += work.effort.seconds_moments;
  }
  return all;
}

template <class Cells> Faults Tessellation<Cells>::find_faults(Effort& effort) {
  return run_tasks(
      [&](const Patch& patch, Work& work) {
        Clock::time_point mark = Clock::now();
        const Array<Vec3> x = exchange(patch);
        work.effort.seconds_exchange = lap(mark);
        cells_.find_suspects(patch, x, work.suspects);
        find_faults(patch, work);
        work.effort.seconds_repair = lap(mark);
      },
      effort);
}

template <class Cells> bool Tessellation<Cells>::mend(const Faults& faults, Effort& effort) {
  Clock::time_point start = Clock::now();
  const std::optional<Repair> repaired = repair(mesh_, cells_.signs(), faults);
  if (repaired) {
    renew_patches(patches_, mesh_.triangles, ownership_, repaired->changed);
    effort.flips += repaired->flips;
  }
  effort.seconds_repair += lap(start);
  return repaired.has_value();
}

template <class Cells> void Tessellation<Cells>::rebuild(Effort& effort) {
  Clock::time_point start = Clock::now();
  patches_.clear();
  mesh_ = {};
  mesh_ = cells_.signs().triangulate();
  patches_ = make_patches(mesh_.triangles, ownership_);
  effort.rebuilt = true;
  effort.seconds_repair += lap(start);
}

template <class Cells>
Faults Tessellation<Cells>::integrate(const Integrand& integrand, const Receiver& receive,
                                      Effort& effort) {
  return run_tasks(
      [&](const Patch& patch, Work& work) {
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
      },
      effort);
}

template <class Cells>
std::vector<std::int32_t>
Tessellation<Cells>::distorted(const Eigen::VectorXd& inverse_spacing) const {
  const std::int64_t count = mesh_.triangles.cols();
  std::vector<std::vector<std::int32_t>> parts(static_cast<std::size_t>(block_count(count)));
  for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (auto t = static_cast<std::int32_t>(begin); t != end; ++t)
      if (is_distorted(cells_, mesh_, inverse_spacing, t))
        parts[static_cast<std::size_t>(block)].push_back(t);
  });
  std::vector<std::int32_t> all;
  for (const std::vector<std::int32_t>& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

template <class Cells>
std::optional<Connectivity> Tessellation<Cells>::take_mesh(const Points3& points) {
  move(points);
  Effort unused;
  const Faults faults = find_faults(unused);
  patches_.clear();
  if (!faults.overturned.empty() || (!faults.none() && !repair(mesh_, cells_.signs(), faults)))
    return std::nullopt;
  return std::move(mesh_);
}

template <class Cells> std::vector<CvtRegion> Tessellation<Cells>::regions() const {
  std::vector<CvtRegion> reports;
  for (const Work& work : work_)
    reports.push_back(work.report);
  return reports;
}

template class Tessellation<SphericalCells>;
template class Tessellation<PlanarCells>;
template class Tessellation<RegionCells>;

} // namespace calotte::cvt_detail
