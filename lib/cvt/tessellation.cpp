// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/tessellation.h"

#include "base/clock.h"
#include "base/parallel.h"
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
template <Space S>
Tessellation<S>::Tessellation(Cells<S> cells, const Points3& points,
                              const Decomposition& decomposition, Level&& level)
    : cells_(std::move(cells)), generators_(points.cols()), decomposition_(decomposition) {
  cells_.move(points);
  Sites sites = level.sites ? std::move(*level.sites) : cells_.sites();
  if (sites.size() != generators_) // two points coincide
    cells_.triangulate();          // refuses them
  Regions regions = delaunay_detail::divide(sites, decomposition_);
  Owners owners = owners_by_site(sites, regions);
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
  if (const Faults faults = find_faults(unused); !faults.none() && !repair_faults(faults, unused))
    rebuild(unused);
}

template <Space S> bool Tessellation<S>::drifted() const {
  const double spacing = cells_.spacing();
  for (std::int64_t k = 0; k < sample_.size(); ++k) {
    const Vec3 way =
        cells_.offset(sample_[k], cells_.position(static_cast<std::int32_t>(k * sampled)));
    if (dot(way, way) > spacing * spacing)
      return true;
  }
  return false;
}

template <Space S> void Tessellation<S>::note_sample() {
  sample_ = Array<Vec3>((generators_ + sampled - 1) / sampled);
  for (std::int64_t k = 0; k < sample_.size(); ++k)
    sample_[k] = cells_.position(static_cast<std::int32_t>(k * sampled));
}

template <Space S> void Tessellation<S>::divide() {
  division_.patches.clear(); // sorting takes as much memory
  std::optional<Owners> owners;
  if (const Sites sites = cells_.sites(); sites.size() == generators_)
    owners = owners_by_site(sites, delaunay_detail::divide(sites, decomposition_));
  // If two points coincide, the old regions stay; a new triangulation will report the error.
  adopt(owners ? std::move(*owners)
               : Owners{std::move(division_.ownership.owner),
                        static_cast<std::int32_t>(division_.work.size())});
}

template <Space S>
typename Tessellation<S>::Owners Tessellation<S>::owners_by_site(const Sites& sites,
                                                                 const Regions& regions) const {
  const auto count = static_cast<std::int32_t>(regions.centres.size());
  Owners owners{Array<std::int32_t>(cells_.site_count()), count};
  std::fill(owners.owner.begin() + generators_, owners.owner.end(), 0);
  for_each_block(generators_, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r != end; ++r)
      owners.owner[sites.id[r]] = count > 1 ? regions.owner[r] : 0;
  });
  return owners;
}

template <Space S> void Tessellation<S>::set_division(Owners&& owners) {
  division_.ownership = make_ownership(std::move(owners.owner), owners.regions);
  division_.patches = make_patches(mesh_.triangles, division_.ownership);
  division_.work = std::vector<RegionWork>(division_.patches.size());
  for (std::size_t k = 0; k < division_.patches.size(); ++k)
    division_.work[k].report.sites = division_.patches[k].owned;
}

template <Space S> void Tessellation<S>::change_mesh(const Points3& points, const Change& change) {
  const std::optional<std::vector<std::int32_t>> changed = change(mesh_);
  move(points);
  Effort unused;
  if (changed)
    renew_patches(division_.patches, mesh_.triangles, division_.ownership, *changed);
  else
    rebuild(unused);
}

template <Space S> void Tessellation<S>::adopt(Owners&& owners) {
  set_division(std::move(owners));
  note_sample();
}

/// Positions of a patch's sites, by local number.
template <Space S> Array<Vec3> Tessellation<S>::exchange(const Patch& patch) const {
  constexpr std::int64_t together = 16;
  Array<Vec3> x(std::ssize(patch.sites));
  for (std::int64_t i = 0; i < x.size();) {
    const Vec3& position = cells_.position(patch.sites[static_cast<std::size_t>(i)]);
    if (are_consecutive(patch, i, together)) { // as they are in memory
      std::copy_n(&position, together, &x[i]);
      i += together;
    } else {
      x[i++] = position;
    }
  }
  return x;
}

template <Space S> void Tessellation<S>::find_faults(const Patch& patch, RegionWork& work) const {
  for (const std::int32_t suspect : work.suspects)
    add_faults(mesh_, cells_.positions(), patch.triangles[static_cast<std::size_t>(suspect)],
               work.faults);
}

/// Runs the task of each region, then adds faults and effort in the order of the regions.
template <Space S>
template <class Task>
Faults Tessellation<S>::run_tasks(const Task& task, Effort& effort) {
  for_each_task(std::ssize(division_.patches), [&](std::int64_t k) {
    RegionWork& work = division_.work[static_cast<std::size_t>(k)];
    work.suspects.clear();
    work.faults = {};
    work.effort = {};
    Clock::time_point start = Clock::now();
    task(division_.patches[static_cast<std::size_t>(k)], work);
    work.report.seconds += restart_clock(start);
  });
  Faults all;
  for (const RegionWork& work : division_.work) {
    all.edges.insert(all.edges.end(), work.faults.edges.begin(), work.faults.edges.end());
    all.overturned.insert(all.overturned.end(), work.faults.overturned.begin(),
                          work.faults.overturned.end());
    effort.seconds_exchange += work.effort.seconds_exchange;
    effort.seconds_repair += work.effort.seconds_repair;
    effort.seconds_moments += work.effort.seconds_moments;
  }
  return all;
}

template <Space S> Faults Tessellation<S>::find_faults(Effort& effort) {
  return run_tasks(
      [&](const Patch& patch, RegionWork& work) {
        Clock::time_point mark = Clock::now();
        const Array<Vec3> x = exchange(patch);
        work.effort.seconds_exchange = restart_clock(mark);
        cells_.find_suspects(patch, x, work.suspects);
        find_faults(patch, work);
        work.effort.seconds_repair = restart_clock(mark);
      },
      effort);
}

/// Makes the mesh Delaunay by flips. False if flips do not suffice; the mesh is then unusable.
template <Space S> bool Tessellation<S>::repair_faults(const Faults& faults, Effort& effort) {
  Clock::time_point start = Clock::now();
  const std::optional<Repair> repaired = repair(mesh_, cells_.positions(), faults);
  if (repaired) {
    renew_patches(division_.patches, mesh_.triangles, division_.ownership, repaired->changed);
    effort.flips += repaired->flips;
  }
  effort.seconds_repair += restart_clock(start);
  return repaired.has_value();
}

/// Triangulates the points again.
template <Space S> void Tessellation<S>::rebuild(Effort& effort) {
  Clock::time_point start = Clock::now();
  division_.patches.clear();
  mesh_ = {};
  mesh_ = cells_.triangulate();
  division_.patches = make_patches(mesh_.triangles, division_.ownership);
  effort.rebuilt = true;
  effort.seconds_repair += restart_clock(start);
}

/// Calls the receiver in the tasks of regions without faults, and returns the faults of others.
template <Space S>
Faults Tessellation<S>::integrate(const Integrand& integrand, const Receiver& receive,
                                  Effort& effort) {
  return run_tasks(
      [&](const Patch& patch, RegionWork& work) {
        Clock::time_point mark = Clock::now();
        const Array<Vec3> x = exchange(patch);
        Array<CellMoments> moments(x.size());
        work.effort.seconds_exchange = restart_clock(mark);
        cells_.integrate(integrand, patch, x, moments, work.suspects);
        work.effort.seconds_moments = restart_clock(mark);
        find_faults(patch, work);
        work.effort.seconds_repair = restart_clock(mark);
        if (work.faults.none())
          receive(patch, x, moments);
        work.effort.seconds_moments += restart_clock(mark);
      },
      effort);
}

/// After a repair few faults are left, and none after a new triangulation.
template <Space S>
void Tessellation<S>::integrate_repaired(const Integrand& integrand,
                                         const std::function<void(bool)>& set_room,
                                         const Receiver& receive, Effort& effort) {
  bool turned = false; // a second time, flips have not sufficed
  const auto make_sound = [&](const Faults& faults) {
    if (faults.none())
      return;
    const bool again = turned && !faults.overturned.empty();
    turned = turned || !faults.overturned.empty();
    if (!again && repair_faults(faults, effort))
      return;
    set_room(false);
    rebuild(effort);
  };
  const auto integrate_all = [&] {
    set_room(true);
    return integrate(integrand, receive, effort);
  };
  if (restless_)
    make_sound(find_faults(effort));
  for (Faults faults = integrate_all(); !faults.none(); faults = integrate_all())
    make_sound(faults);
  restless_ = effort.flips > 0 || effort.rebuilt;
}

template <Space S> void Tessellation<S>::make_delaunay(Effort& effort) {
  for (int tries = 0;; ++tries) {
    const Faults faults = find_faults(effort);
    if (faults.none())
      return;
    if (tries > 1 || !repair_faults(faults, effort)) {
      rebuild(effort);
      return;
    }
  }
}

template <Space S> std::optional<Connectivity> Tessellation<S>::take_mesh(const Points3& points) {
  move(points);
  Effort unused;
  const Faults faults = find_faults(unused);
  division_.patches.clear();
  if (!faults.overturned.empty() || (!faults.none() && !repair(mesh_, cells_.positions(), faults)))
    return std::nullopt;
  return std::move(mesh_);
}

template <Space S> std::vector<CvtRegion> Tessellation<S>::regions() const {
  std::vector<CvtRegion> reports;
  for (const RegionWork& work : division_.work)
    reports.push_back(work.report);
  return reports;
}

template class Tessellation<Sphere>;
template class Tessellation<Plane>;

} // namespace calotte::cvt_detail
