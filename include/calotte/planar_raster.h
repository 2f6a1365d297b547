// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/surface.h>
#include <calotte/types.h>

CALOTTE_API_BEGIN
namespace calotte {

/// A density of the plane at the nodes of a grid, which may be irregular. Between nodes it is
/// bilinear. Outside the grid it has the value of the nearest point of the grid.
struct PlanarRaster {
  DoubleVector x;       ///< nx >= 2, finite and ascending, in the unit of the domain
  DoubleVector y;       ///< ny >= 2, finite and ascending, in the unit of the domain
  DoubleMatrix density; ///< nx x ny, finite and >= 0; only ratios matter
};

/// The density of a raster, a callable for planar domains.
/// \throws Error invalid_argument if shapes, coordinates or values violate the conditions above.
Density density_of(const PlanarRaster& raster);

/// Prescribed cell widths (distances between the centres of neighbouring cells) of the plane at the
/// nodes of a grid, which may be irregular. Between nodes the width is bilinear. Outside the grid
/// it has the value of the nearest point of the grid.
struct PlanarCellWidth {
  DoubleVector x;      ///< nx >= 2, finite and ascending, in the unit of the domain
  DoubleVector y;      ///< ny >= 2, finite and ascending, in the unit of the domain
  DoubleMatrix widths; ///< nx x ny, > 0 and finite, in the unit of the domain
};

/// The density rho = (h_min/h)^4 of the interpolated width h, see density_of(const CellWidth&).
/// \throws Error invalid_argument if shapes, coordinates or values violate the conditions above.
Density density_of(const PlanarCellWidth& cell_width);

/// The number of cells that the widths h imply: the integral of 2/(sqrt(3) h^2) over a box or a
/// part of the plane, within about 0.2%: a mean over 2^18 random points.
/// \throws Error as above; invalid_argument for the sphere, and for a plane
///         without rings and two periods.
double implied_cells(const PlanarCellWidth& cell_width, const Surface& surface);

/// The largest widths that are nowhere above the given ones, and change by at most g per unit of
/// length between any two nodes of the domain: the least of h(y) + g d(x, y) over all nodes y of
/// the domain, with the length d of the shortest way in it, round its islands and across its
/// periods. A node outside the domain has what the other nodes allow it straight across. Ways
/// may be longer by some hundredths of a step of the raster, and round islands by a third of one.
/// The result has the same bits for any number of threads.
///
/// \param gradient g, > 0 and finite.
/// \param surface a plane.
/// \throws Error as density_of; invalid_argument for a gradient out of range, and for the sphere.
PlanarCellWidth limit_gradient(const PlanarCellWidth& cell_width, double gradient,
                               const Surface& surface);

/// Throws unless the nodes cover a box or a part of the plane, except for half of the widest step.
/// \throws Error invalid_argument, naming the extents; for the sphere, and for a plane without
///         rings and two periods.
void require_covering(const PlanarCellWidth& cell_width, const Surface& surface);

} // namespace calotte
CALOTTE_API_END
