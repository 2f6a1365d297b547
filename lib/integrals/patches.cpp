// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/patches.h"

#include "base/parallel.h"
#include "base/triangle.h"

#include <algorithm>

namespace calotte::integrals_detail {
namespace {

using Triple = std::array<std::int32_t, 3>;

/// Orders triangles by their keys.
struct ByKey {
  const Triangles& triangles;

  /// The key of a triangle: its lowest site and the next one. No two triangles of a mesh share
  /// both.
  std::uint64_t key_of(std::int32_t t) const {
    const Triple sites = sites_from_lowest(triangles, t);
    return std::uint64_t{static_cast<std::uint32_t>(sites[0])} << 32 |
           static_cast<std::uint32_t>(sites[1]);
  }

  bool operator()(std::int32_t t, std::int32_t u) const { return key_of(t) < key_of(u); }
};

/// Calls body(region) once for each region that owns a site of a triangle.
template <class Body>
void for_each_owner(const Triple& sites, const Array<std::int32_t>& owner, const Body& body) {
  const std::int32_t a = owner[sites[0]], b = owner[sites[1]], c = owner[sites[2]];
  if (a >= 0)
    body(a);
  if (b != a && b >= 0)
    body(b);
  if (c != a && c != b && c >= 0)
    body(c);
}

/// The numbers of each region's triangles, ascending. Parts of the mesh are counted, then written
/// to disjoint indices. There are few parts, because each counts for all regions.
std::vector<std::vector<std::int32_t>> triangles_by_region(const Triangles& triangles,
                                                           const Ownership& ownership) {
  const std::size_t regions = ownership.owned.size();
  const std::int64_t parts = std::min<std::int64_t>(block_count(triangles.cols()), 256);
  std::vector<std::vector<std::int32_t>> index(static_cast<std::size_t>(parts),
                                               std::vector<std::int32_t>(regions, 0));
  const auto visit = [&](const auto& body) {
    for_each_task(parts, [&](std::int64_t part) {
      std::vector<std::int32_t>& here = index[static_cast<std::size_t>(part)];
      const std::int64_t begin = triangles.cols() * part / parts,
                         end = triangles.cols() * (part + 1) / parts;
      for (auto t = static_cast<std::int32_t>(begin); t != end; ++t)
        for_each_owner(sites_from_lowest(triangles, t), ownership.owner, [&](std::int32_t k) {
          body(t, static_cast<std::size_t>(k), here[static_cast<std::size_t>(k)]++);
        });
    });
  };
  visit([](std::int32_t, std::size_t, std::int32_t) {});
  std::vector<std::vector<std::int32_t>> out(regions);
  for_each_task(static_cast<std::int64_t>(regions), [&](std::int64_t region) {
    const auto k = static_cast<std::size_t>(region);
    std::int32_t sum = 0;
    for (std::vector<std::int32_t>& here : index)
      sum += std::exchange(here[k], sum);
    out[k].resize(static_cast<std::size_t>(sum));
  });
  visit([&](std::int32_t t, std::size_t k, std::int32_t at) {
    out[k][static_cast<std::size_t>(at)] = t;
  });
  return out;
}

/// Numbers the sites of a patch's triangles: halo and corners.
void number_sites(Patch& patch, const Triangles& triangles, const Ownership& ownership) {
  const std::vector<std::int32_t>& own = ownership.owned[static_cast<std::size_t>(patch.region)];
  const auto is_own = [&](std::int32_t site) { return ownership.owner[site] == patch.region; };
  std::vector<std::int32_t> halo;
  for (const std::int32_t t : patch.triangles)
    for (const std::int32_t site : sites_from_lowest(triangles, t))
      if (!is_own(site))
        halo.push_back(site);
  std::sort(halo.begin(), halo.end());
  halo.erase(std::unique(halo.begin(), halo.end()), halo.end());
  patch.owned = static_cast<std::int32_t>(own.size());
  patch.sites.clear();
  patch.sites.reserve(own.size() + halo.size());
  patch.sites.insert(patch.sites.end(), own.begin(), own.end());
  patch.sites.insert(patch.sites.end(), halo.begin(), halo.end());
  const auto local = [&](std::int32_t site) {
    if (is_own(site))
      return ownership.index[site];
    const auto at = std::lower_bound(halo.begin(), halo.end(), site);
    return patch.owned + static_cast<std::int32_t>(at - halo.begin());
  };
  patch.corners.resize(patch.triangles.size());
  for (std::size_t i = 0; i < patch.corners.size(); ++i) {
    const Triple sites = sites_from_lowest(triangles, patch.triangles[i]);
    patch.corners[i] = {local(sites[0]), local(sites[1]), local(sites[2])};
  }
}

/// Removes changed triangles from a patch's list and adds those of them that now belong to it.
void renew(Patch& patch, const Triangles& triangles, const Ownership& ownership,
           const std::vector<std::uint8_t>& has_changed, std::vector<std::int32_t> own) {
  std::sort(own.begin(), own.end(), ByKey{triangles});
  own.erase(std::unique(own.begin(), own.end()), own.end());
  std::erase_if(patch.triangles,
                [&](std::int32_t t) { return has_changed[static_cast<std::size_t>(t)] != 0; });
  std::vector<std::int32_t> merged(patch.triangles.size() + own.size());
  std::merge(patch.triangles.begin(), patch.triangles.end(), own.begin(), own.end(), merged.begin(),
             ByKey{triangles});
  patch.triangles = std::move(merged);
  number_sites(patch, triangles, ownership);
}

} // namespace

Triple sites_from_lowest(const Triangles& triangles, std::int32_t t) {
  const std::int32_t a = triangles(0, t), b = triangles(1, t), c = triangles(2, t);
  if (a < b && a < c)
    return {a, b, c};
  return b < c ? Triple{b, c, a} : Triple{c, a, b};
}

void sort_by_sites(std::vector<std::int32_t>& list, const Triangles& triangles) {
  if (!std::is_sorted(list.begin(), list.end(), ByKey{triangles})) // sorted in the library's meshes
    std::sort(list.begin(), list.end(), ByKey{triangles});
}

Ownership make_ownership(Array<std::int32_t>&& owner, std::int32_t regions) {
  Ownership result{std::move(owner), {}, {}};
  const std::int64_t n = result.owner.size();
  result.index = Array<std::int32_t>(n);
  std::vector<std::int32_t> count(static_cast<std::size_t>(regions), 0);
  for (std::int64_t i = 0; i < n; ++i)
    if (result.owner[i] >= 0)
      result.index[i] = count[static_cast<std::size_t>(result.owner[i])]++;
  for (const std::int32_t own : count)
    result.owned.emplace_back(static_cast<std::size_t>(own));
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      if (result.owner[i] >= 0)
        result.owned[static_cast<std::size_t>(result.owner[i])]
                    [static_cast<std::size_t>(result.index[i])] = static_cast<std::int32_t>(i);
  });
  return result;
}

std::vector<Patch> make_patches(const Triangles& triangles, const Ownership& ownership) {
  std::vector<std::vector<std::int32_t>> lists = triangles_by_region(triangles, ownership);
  std::vector<Patch> patches(lists.size());
  for_each_task(std::ssize(lists), [&](std::int64_t k) {
    Patch& patch = patches[static_cast<std::size_t>(k)];
    patch.region = static_cast<std::int32_t>(k);
    patch.triangles = std::move(lists[static_cast<std::size_t>(k)]);
    sort_by_sites(patch.triangles, triangles);
    number_sites(patch, triangles, ownership);
  });
  return patches;
}

void renew_patches(std::vector<Patch>& patches, const Triangles& triangles,
                   const Ownership& ownership, std::span<const std::int32_t> changed) {
  std::vector<std::uint8_t> has_changed(static_cast<std::size_t>(triangles.cols()), 0);
  std::vector<std::vector<std::int32_t>> own(patches.size());
  for (const std::int32_t t : changed) {
    has_changed[static_cast<std::size_t>(t)] = 1;
    for_each_owner(sites_from_lowest(triangles, t), ownership.owner,
                   [&](std::int32_t k) { own[static_cast<std::size_t>(k)].push_back(t); });
  }
  // A flip leaves all four of its sites in the two triangles: a patch that lost a triangle still
  // has one of the changed ones.
  for_each_task(std::ssize(patches), [&](std::int64_t k) {
    const auto region = static_cast<std::size_t>(k);
    if (!own[region].empty())
      renew(patches[region], triangles, ownership, has_changed, std::move(own[region]));
  });
}

} // namespace calotte::integrals_detail
