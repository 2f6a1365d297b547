// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/raster.h>
#include <calotte/surface.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <vector>

/// The cells of an ocean grid: the fraction of land of each, and the cells of the sea.
CALOTTE_API_BEGIN
namespace calotte {

/// The boundaries of areas of land that do not overlap. Parts of them may coincide, as where
/// polygons are cut along a meridian.
struct Coast {
  /// Rings, each 3 x corners, unit columns, joined by arcs shorter than a half circle. Land is to
  /// the left, seen from outside the sphere.
  std::vector<Points3> rings;
  double area = 0; ///< of the land, steradians
};

/// The arcs of a coast, each a line of two points, without those that occur in both directions, as
/// where polygons are cut.
std::vector<Points3> shores(const Coast& coast);

/// The coast without the islands and the lakes that are smaller than an area, and without what lies
/// in these: its closed lines, see shores(), that have less on one side are left out.
/// \param least_area km^2, >= 0; less is left out. 0 changes nothing.
/// \param radius_km of the sphere that the area refers to, > 0; 1 for an area in steradians.
/// \throws Error invalid_argument for an area that is negative or not finite, for one that leaves
///         nothing, for a radius that is not positive and finite, and as shores().
Coast without_small(const Coast& coast, double least_area, double radius_km);

/// The land around a point, such as an island with its lakes: the smallest left side of a ring that
/// contains it, without the loops in which a simplified coast crosses itself.
/// \param point direction of any norm.
/// \throws Error invalid_argument for a point in the sea; as Surface::within() for the rings around
/// it.
Surface land_around(const Coast& coast, const Eigen::Vector3d& point);

/// The fraction of each cell that is land, from the exact intersections of the coast's arcs with
/// the cells, whose sides are arcs between their vertices. The areas sum to that of the land within
/// 1e-10. The arcs are turned by 1e-12 radians so that none passes through a vertex. The result has
/// the same bits for any number of threads.
/// \param cells a closed tessellation of the sphere; only its cells, vertices and lists of cells
///        are read.
/// \returns n fractions from 0 to 1.
/// \throws Error invalid_argument, for cells that do not cover the sphere; for an area that is not
///         that of the rings, and for points covered twice.
DoubleVector land_fractions(const Voronoi& cells, const Coast& coast);

/// The fraction of each cell that is land, by a raster of the sphere, whose values are fractions of
/// land: the mean of the values in the boxes of lon_lat_boxes(), weighted by the exact areas that
/// they share with the cell. A cell of no area has the value at its generator. The result has the
/// same bits for any number of threads.
/// \param cells of the sphere; only their cells, vertices and lists of vertices are read.
/// \returns n fractions from 0 to 1.
/// \throws Error invalid_argument, for shapes, coordinates or values that violate the conditions of
///         Raster or of boxes, or are no fractions.
DoubleVector land_fractions(const Voronoi& cells, const Raster& land);

/// The cells that lines cross, in increasing order. Successive cells of a line share an edge.
/// \param lines each 3 x points, unit columns, joined by arcs shorter than a half circle.
/// \throws Error invalid_argument, for cells that do not cover the sphere, or a line without a
/// point.
std::vector<std::int32_t> cells_on_lines(const Voronoi& cells, const std::vector<Points3>& lines);

/// The rules that decide which cells are sea, beginning with those that are no land.
struct SeaOptions {
  std::vector<std::int32_t> opened = {}; ///< cells that are sea, even on land. Default: none.
  std::vector<std::int32_t> closed = {}; ///< cells that are land, unless opened. Default: none.
  bool fill = true; ///< cells with a single neighbour in the sea, or none, become land, repeatedly
  /// n flags: 1 for cells that become land, repeatedly, without an open vertex, which is one whose
  /// three cells are sea. The velocity of sea ice stands at vertices: without an open one a cell is
  /// land-locked, and ice cannot leave it. Opened cells stay. Default: none.
  std::vector<std::uint8_t> need_open_vertex = {};
  /// The sea is what is connected with one of these cells. Default: none, the largest part.
  std::vector<std::int32_t> seeds = {};
};

/// A connected part of the sea.
struct SeaPart {
  std::int64_t cells = 0;   ///< their number
  std::int32_t middle = -1; ///< one of its cells that is farthest from other cells, in rows
};

/// The decisions of sea_cells().
struct SeaReport {
  std::int64_t opened = 0;  ///< cells of land that became sea
  std::int64_t closed = 0;  ///< cells of the sea that became land
  std::int64_t filled = 0;  ///< cells with a single neighbour in the sea, or none
  std::int64_t locked = 0;  ///< other cells without an open vertex, which need one
  std::int64_t parts = 0;   ///< of the sea before the others were left out
  std::int64_t severed = 0; ///< cells in parts without a seed
  /// The largest parts without a seed, at most max_severed_parts, largest first.
  std::vector<SeaPart> severed_parts = {};
};

/// The number of parts that SeaReport names.
inline constexpr std::size_t max_severed_parts = 5;

/// The sea, and how it was decided.
struct SeaCells {
  Ids mask;         ///< by cell: 0 for the sea, -1 for land
  SeaReport report; ///< counts
};

/// The cells of a connected sea. Closed and opened cells are decided first, then filled cells, then
/// the parts without a seed. A filled cell is on no path between two others, so that an opened
/// passage stays open.
/// \param cells_on_cell the n cells' 0-based neighbours, in their order around the cell; -1 for a
///        missing one, which counts as land.
/// \param land n flags: 1 for land.
/// \throws Error invalid_argument: if no cell is sea; naming the first seed that is on land; for
///         another number of flags.
SeaCells sea_cells(const IdLists& cells_on_cell, const std::vector<std::uint8_t>& land,
                   const SeaOptions& options = {});

} // namespace calotte
CALOTTE_API_END
