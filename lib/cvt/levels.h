// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/insertion.h"
#include "cvt/room.h"
#include "cvt/state.h"
#include "cvt/tessellation.h"
#include "mesh/connectivity.h"

#include <calotte/cvt.h>
#include <calotte/density.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cstdint>
#include <optional>

/// The operations of a run on its surface before, between and after the descents.
namespace calotte::cvt_detail {

/// The minimum number of generators of a run.
std::int64_t fewest_generators(const Surface& surface);
/// The maximum number of generators after bisections of n. On the whole sphere it is exact; on a
/// bounded surface some midpoints may be outside.
std::int64_t bisected(const Surface& surface, std::int64_t n, int bisections = 1);
/// The number whose bisection is nearest to n.
std::int64_t halved(const Surface& surface, std::int64_t n);
/// The number of generators of a level, so many bisections before the last one, which has n.
/// \param on_boundary number of generators on the boundary, the same at all levels. Of each, a cell
///        has half the size that it has at the last level, and at a coarser one less of it.
std::int64_t generators_of_level(const Surface& surface, std::int64_t n, int bisections,
                                 std::int64_t on_boundary);

/// The start of a run.
struct Begun {
  State state;
  Level level;
};

/// \param start the fixed generators of the recipe, then the free ones.
/// \throws Error as make_sites(); too_few_sites; degenerate for points of the plane on one line;
///         invalid_argument with the index of the first point outside the surface; duplicate, with
///         the index of a fixed generator that merges with an earlier one.
Begun begin(Points3&& start, const Recipe& recipe);

/// \throws Error invalid_argument: the state is not one that a run has left.
[[noreturn]] void refuse_state();
/// Refuses a state whose points are too few, or not on the surface.
void require_points(const State& state, const Surface& surface);

/// The Delaunay triangulation of a state's generators, in the order of the start. On a bounded part
/// of the sphere it includes the triangles outside the part.
/// \param connectivity of the generators, if it is known.
Mesh mesh_of_run(const State& state, const Surface& surface,
                 std::optional<Connectivity>&& connectivity);

/// Sets the generators of a state to those of a bisected mesh, in curve order; returns the start of
/// the next level.
/// \param density here and below, as surface_density() gives it.
/// \param cells of the next level. On a bounded surface full gaps between fixed generators get no
///        midpoint, see insertion.h.
Level set_bisected(State& state, const Mesh& coarse, const Density& density, std::int64_t cells);
/// The same after insertion and contraction of edges.
Level set_split_and_collapsed(State& state, const Mesh& mesh, const Density& density,
                              const EdgeChanges& changes);

} // namespace calotte::cvt_detail
