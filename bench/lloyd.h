// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/cvt.h"

#include <calotte/cvt.h>
#include <calotte/density.h>
#include <calotte/types.h>

#include <map>
#include <string>
#include <vector>

namespace calotte::bench {

/// The target of the iteration, the same for all programs.
struct Target {
  Density density;
  int rule = 3; ///< quadrature points on each half kite, where the density is not uniform
};

/// Number of first iterations that no measurement includes: they test the start's mesh twice and
/// use fresh memory.
constexpr int warm_up = 2;

/// Options for a number of iterations, all with the target's rule.
CvtOptions fixed_iterations(const Target& target, int iterations);

/// The result of one timed run, and the measurements of one iteration.
struct Iterated {
  double seconds = 0;                     ///< wall-clock time of one iteration
  std::map<std::string, double> counters; ///< by name, see below
  Points3 points;                         ///< 3 x n: the generators afterwards, in the given order
  std::string failure;                    ///< describes a failure; empty on success
};

/// `iterations` > warm_up of calotte::cvt on `threads` threads; `seconds` is the median of those
/// after the warm-up. Counters, all of these iterations:
///   cpu               median of the CPU seconds of all threads;
///   median ns         seconds times threads over sites, in nanoseconds: of a site and core;
///   exchange, repair, moments   shares in threads times seconds.
Iterated run_cvt(const Points3& start, const Target& target, int iterations, int threads);

/// One iteration as a serial program would make it: STRIPACK's triangulation of the points as they
/// are, its lists read off into triangles, then the library's moments of the cells and the step, on
/// one thread. All of it is timed from the points to the next points, with all arrays allocated and
/// touched before. Counters: cpu, median ns, and the shares triangulate, lists and moments.
/// \pre has_stripack(). \param points 3 x n unit columns.
Iterated run_stripack_iteration(const Points3& points, const Target& target);

/// The largest distance between equal columns.
double largest_distance(const Points3& a, const Points3& b);

} // namespace calotte::bench
