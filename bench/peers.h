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

/// What one timed run made; timed is the triangulation alone.
struct Outcome : Timed {
  std::int64_t sites = 0; ///< vertices of the result
  std::int64_t triangles = 0;
  std::uint64_t digest = 0; ///< Digest of the triangles in the ids of the input
  std::string failure;      ///< not empty when the run gave no triangulation
  DelaunayReport report;    ///< of the library's own runs
};

/// calotte::delaunay from the caller's points to the mesh, on `threads` threads; freeing it is not
/// timed.
Outcome run_calotte(const Points3& points, int threads, const DelaunayOptions& options = {});

/// As many of them as threads, each on a thread of its own, at once; the seconds of the slowest.
/// They share the points, the process's memory management and the machine's caches, with as many
/// times the memory of one: how much longer than one alone they take is a yardstick of the machine,
/// no bound of what several threads on one set can reach.
Outcome run_side_by_side(const Points3& points, int threads);

/// CGAL::Delaunay_triangulation_on_sphere_2 with exact predicates and inexact constructions: the
/// insertion of a range of points of CGAL's own type, which CGAL sorts along a space-filling curve.
Outcome run_cgal(const Points3& points);

/// STRIPACK's TRMESH, with its arrays allocated and touched before the clock starts; its linked
/// lists are its result. \pre has_stripack().
Outcome run_stripack(const Points3& points);

/// Qhull's convex hull of the points, whose facets are the triangles (Barber, Dobkin, Huhdanpaa,
/// ACM TOMS 22(4), 1996): with option Qt, which cuts the facets that it had to merge into
/// triangles. \pre has_qhull().
Outcome run_qhull(const Points3& points);

/// Whether this program was built with Qhull, and with which.
bool has_qhull();
std::string qhull_version();

} // namespace calotte::bench
