// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grids/room.h"

#include <calotte/grid.h>

#include <cstdint>

namespace calotte::grids_detail {

/// The minimum number of cells with which a grid resolves a density that is not uniform. The first
/// level of CvtStart::Kind::continuation has at least as many cells.
inline constexpr std::int64_t fewest_graded = 642;

/// The first level of a run, from which bisections lead to the last.
struct FirstLevel {
  CvtStart::Kind kind = CvtStart::Kind::density; ///< kind of its points
  std::int64_t cells = 0;                        ///< number of cells, including fixed generators
  int bisections = 0;
};

/// The first level of CvtStart::Kind::continuation.
FirstLevel first_of_continuation(std::int64_t cells, bool uniform);

/// The first level of CvtStart::Kind::multilevel: the fewest generators that resolve the density.
/// They are at least 160, 12 in each hemisphere on average or 6 across a box, and four times the
/// number of fixed generators.
/// \param on_boundary of the fixed ones the number of those that the mesh ends at.
/// \throws Error invalid_argument for an ill-formed density.
FirstLevel first_of_multilevel(std::int64_t cells, const Surface& surface, const Density& density,
                               std::int64_t fixed, std::int64_t on_boundary);

/// The first level of another kind with a number of bisections. \throws Error invalid_argument if
/// bisections do not lead to the number of cells, with the nearest numbers that they reach.
FirstLevel first_of_kind(CvtStart::Kind kind, std::int64_t cells, int bisections,
                         const Surface& surface, std::int64_t fixed);

/// The free generators of a schedule's first level: 3 x n, in the plane with z = 0.
/// \throws Error as random_sphere() and the like.
Points3 free_generators(const Schedule& schedule);

/// The number of cells of a grid with fixed generators: their number, plus the part of the
/// density's demand that they leave unmet. An estimate from random points.
/// \param cells number that the density demands without fixed generators.
std::int64_t cells_beside(const Points3& fixed, std::int64_t cells, const Density& density,
                          const Surface& surface);

} // namespace calotte::grids_detail
