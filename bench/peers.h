// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stopwatch.h"

#include <calotte/delaunay.h>

#include <cstdint>
#include <string>

namespace calotte::bench {

/// A sum over the triangles that depends on the set of oriented triangles alone, not on their order
/// or on which vertex each starts at: equal sets have equal digests, others (but for 2^-64) not.
class Digest {
public:
  void add(std::int32_t a, std::int32_t b, std::int32_t c);
  std::uint64_t value() const { return sum_; }

private:
  std::uint64_t sum_ = 0;
};

/// The result of one timed run; only the triangulation is timed.
struct Outcome : Timed {
  std::int64_t sites = 0; ///< vertices of the result
  std::int64_t triangles = 0;
  std::uint64_t digest = 0; ///< Digest of the triangles in the ids of the input
  std::string failure;      ///< describes a failure; empty if the run gave a triangulation
};

/// calotte::delaunay from points that it takes over to the mesh, on `threads` threads; copying the
/// points before and freeing the mesh are not timed.
Outcome run_calotte(const Points3& points, int threads, const DelaunayOptions& options = {});

/// Runs one triangulation per thread at once; returns the seconds of the slowest. They share the
/// points, the process's memory management and the machine's caches, and use as many times the
/// memory of one. Their slowdown compared with one alone is a reference for the machine, not a
/// bound for several threads on one set.
Outcome run_side_by_side(const Points3& points, int threads);

/// CGAL::Delaunay_triangulation_on_sphere_2 with exact predicates and inexact constructions: the
/// insertion of a range of points of CGAL's own type, which CGAL sorts along a space-filling curve.
Outcome run_cgal(const Points3& points);

/// STRIPACK's TRMESH; its arrays are allocated and touched before the clock starts, and its linked
/// lists are the result.
/// \pre has_stripack().
Outcome run_stripack(const Points3& points);

/// Qhull's convex hull of the points, whose facets are the triangles (Barber, Dobkin, Huhdanpaa,
/// ACM TOMS 22(4), 1996): with option Qt, which cuts the facets that it had to merge into
/// triangles. \pre has_qhull().
Outcome run_qhull(const Points3& points);

/// True if this program was built with Qhull, and its version.
bool has_qhull();
std::string qhull_version();

} // namespace calotte::bench
