// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/delaunay.h>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>

/// The choices of a triangulation that change no bit of it.
namespace calotte::test {

template <class Call> auto with_threads(int threads, const Call& call) {
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(call);
}

inline DelaunayOptions with_regions(int regions, RegionOverlap overlap = RegionOverlap::halo,
                                    RegionCentres centres = RegionCentres::sample) {
  DelaunayOptions options;
  options.decomposition.regions = regions;
  options.decomposition.overlap = overlap;
  options.decomposition.centres = centres;
  return options;
}

} // namespace calotte::test
