// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The demands of models on grids. Which these are, see models().
CALOTTE_API_BEGIN
namespace calotte {

/// What a model demands of a grid, and the speeds that limit its time step. 0 where it demands
/// nothing.
struct GridDemands {
  std::int64_t least_sides = 0; ///< of a cell that lacks no neighbour
  double least_dv_over_dc = 0;  ///< of a Voronoi edge over its Delaunay edge
  /// Of the width of a cell over that of a neighbour, minus 1. Widths are those of hexagons of the
  /// cells' areas, their logarithms smoothed with a weight whose standard deviation is sqrt(2)
  /// cells, which removes the scatter of single cells.
  double largest_change = 0;
  /// Of the two cells of an edge and their neighbours, which advection through the edge uses.
  std::int64_t most_advecting_cells = 0;
  /// Of a Voronoi edge, in units of the distance of numbers of 32 bits at the planet's radius.
  /// Coordinates in such numbers turn and lengthen an edge by up to two units, so that from 100 on
  /// the error is at most two percent.
  double least_dv_in_float32 = 0;
  double wind = 0;  ///< m/s: the fastest flow, which moves by 0.9 dc in the longest step
  double waves = 0; ///< m/s: the fastest waves, see wave_step()
};

/// The longest step of the flow, s: it moves by 0.9 of a distance.
/// \param dc the least distance of neighbours, metres. \pre demands.wind > 0.
inline double longest_step(const GridDemands& demands, double dc) {
  return 0.9 * dc / demands.wind;
}

/// One demand of a model, and what a grid has.
struct Gate {
  std::string name;            ///< such as "sides of a cell, least"
  double value = 0;            ///< the grid's worst
  std::optional<double> limit; ///< of the demand; none for a value that informs
  bool at_least = false;       ///< whether values below the limit fail; else those above it
  std::int64_t beyond = 0;     ///< number of cells, or of edges, that fail
  std::int32_t cell = -1;      ///< at which the worst is; of an edge its first cell; -1 for none
  /// True unless a cell or an edge fails.
  bool passed() const { return beyond == 0; }
};

/// Compares a grid of the sphere with the demands of a model. A demand that fails is a result, not
/// an error. These tell the sides of cells, the shortest Voronoi edges, the change of widths, the
/// cells that take part in the advection through an edge, what coordinates of 32 bits leave of the
/// shortest edges, and the longest steps. A cell with four sides, a collapsed edge or a change of
/// more than an eighth from cell to cell have ended forecasts at kilometres.
/// \param voronoi the cells of the grid; a part of the sphere has edges with one cell.
/// \param radius of the planet, metres; > 0 and finite.
/// \param mask by cell, of a limited area, see limited_area_mask(): rings that do not follow one
///        another fail. Default: none.
/// \throws Error invalid_argument for a plane, a radius out of range, another number of masks.
std::vector<Gate> gates(const Voronoi& voronoi, const GridDemands& demands, double radius,
                        const Ids& mask = {});

} // namespace calotte
CALOTTE_API_END
