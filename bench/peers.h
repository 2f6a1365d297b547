// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "program.h"

#include <calotte/delaunay.h>

#include <cstdint>
#include <string>

namespace calotte::bench {

/// Triangles, counted, with a sum that depends on the set of oriented triangles alone, not on their
/// order or on which vertex each starts at: equal sets have equal digests, others (but for 2^-64)
/// not.
struct Digest {
  void add(std::int32_t a, std::int32_t b, std::int32_t c);

  std::int64_t count = 0;
  std::uint64_t sum = 0;

  bool operator==(const Digest&) const = default;
};

/// The result of one timed run; only the triangulation is timed.
struct Outcome : Timed {
  Digest triangles; ///< in the ids of the input
};

// The functions below run one triangulation of the columns of `points`. A peer that fails is an
// exception.

/// calotte::triangulate from points that it takes over, on `threads` threads; copying the points
/// before and freeing the mesh are not timed.
Outcome run_calotte(const Points3& points, const Surface& surface, int threads,
                    const DelaunayOptions& options = {});

/// Runs one triangulation per thread at once; returns the slowest. They share the points, the
/// process's memory management and the machine's caches, and use as many times the memory of one.
/// Their slowdown compared with one alone is a reference for the machine, not a bound for several
/// threads on one set.
Outcome run_side_by_side(const Points3& points, const Surface& surface, int threads);

/// CGAL::Delaunay_triangulation_on_sphere_2 with exact predicates and inexact constructions: the
/// insertion of a range of points of CGAL's own type, which CGAL sorts along a space-filling curve.
Outcome run_cgal(const Points3& points);

/// CGAL::Delaunay_triangulation_2, the same in the plane.
Outcome run_cgal_plane(const Points3& points);

/// STRIPACK's TRMESH; its arrays are allocated and touched before the clock starts, and its linked
/// lists are the result. \pre has_stripack.
Outcome run_stripack(const Points3& points);

/// Qhull's convex hull of the points, whose facets are the triangles (Barber, Dobkin, Huhdanpaa,
/// ACM TOMS 22(4), 1996): with option Qt, which cuts the facets that it had to merge into
/// triangles. \pre qhull_version() is not empty.
Outcome run_qhull(const Points3& points);

/// Empty if this program was built without Qhull.
std::string qhull_version();

// The peers below are programs of the user's own build. They run once on a file of the points; the
// seconds are those that they print.

/// PBBS' incremental Delaunay triangulation of the plane (Blelloch, Gu, Shun, Sun, J. ACM 67(4),
/// 2020), `delaunay`, warm: it repeats the triangulation for a second first. It adds ten vertices
/// around the points and never removes them, so that triangles at the hull are missing; those that
/// have only the points for corners are triangles of the Delaunay triangulation.
Outcome run_pbbs(const std::string& program, const Points3& points, int threads);

/// geogram's `compute_delaunay`: in the plane with algorithm BDEL2d, which is serial; on the sphere
/// the hull of its tetrahedra between the points and the centre, BDEL on one thread, otherwise PDEL
/// on all cores. On the sphere its triangles come in any orientation and are turned
/// counter-clockwise seen from outside.
Outcome run_geogram(const std::string& program, const Points3& points, bool plane, int threads);

} // namespace calotte::bench
