// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/options.h"
#include "cvt/room.h"

#include <calotte/cvt.h>

#include <functional>

/// The run of a schedule from given generators; make_grid() calls it.
namespace calotte {

/// Called after each accepted iteration; return true to stop.
using CvtCallback = std::function<bool(const CvtProgress&)>;

/// Executes the actions of a schedule. Its descents minimise the energy E, the sum over cells of
/// the integral of rho |x - x_i|^2. They move the generators until these are, up to the tolerance,
/// the constrained centroids M/|M| of their cells, with M the integral of rho x (Jacobsen et al.,
/// 2013, Sect. 3.3); in the plane, the centroids. At the end the generators are moved to these
/// centroids. Each region's task integrates over the cells that the region owns.
///
/// The same start gives the same bits for any number of threads and regions. A run that does not
/// converge within its iterations is no error; the report says so. Lengths in the report are in
/// radians, or in the plane's unit.
///
/// The boundary of a bounded surface clips the cells. Generators stay inside: where the centroid of
/// a cell lies outside the surface, its generator moves to the nearest point inside. A bisection
/// adds the midpoints of the edges that lie inside.
///
/// The mesh of a part of the sphere has the Delaunay triangles of the generators whose circumcentre
/// lies in the part. It is open along the boundary, within about a cell of it; a generator may be
/// in no triangle. With Boundary::generators the mesh ends at the generators on the boundary. A
/// bisection then adds no midpoint between two of them along the boundary.
///
/// \param start the fixed generators of the recipe, then the free ones: 3 x n directions of any
///        norm, 12 distinct at least, not within a hemisphere; 4 in a part of the sphere. In the
///        plane as triangulate() takes them, not on one line. All inside the surface; by default
///        equal ones merge.
/// \param schedule as plan() gives it.
/// \return the mesh in the order of the start; after bisections, the midpoints follow.
/// \throws Error as triangulate() and Surface::within(); too_few_sites for fewer generators on the
///         sphere, or when they leave a hemisphere empty or meet; degenerate for fewer in the
///         plane; invalid_argument with the index of a generator outside the surface, or for a
///         density that is ill-formed, negative or NaN somewhere, or zero over a whole cell.
Cvt cvt(Points3 start, const Schedule& schedule, const cvt_detail::Execution& execution = {},
        const CvtCallback& callback = {});

/// Continues from a state of a run of the same actions. The ends of their descents may differ. With
/// the same schedule the result has the bits of an uninterrupted run.
/// \throws Error as above; invalid_argument for an incomplete state, and for other actions.
Cvt cvt(CvtState state, const Schedule& schedule, const cvt_detail::Execution& execution = {},
        const CvtCallback& callback = {});

} // namespace calotte
