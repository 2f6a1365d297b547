// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/raster.h>

#include <Eigen/SparseCore>

#include <cstdint>

/// Weights that take values from grid to grid: conservative ones between cells and boxes of
/// rasters, others from sites and cells to positions.
CALOTTE_API_BEGIN
namespace calotte {

/// The method by which values at sites or of cells give values elsewhere. All but `conservative`
/// are exact at the sites.
enum class Interpolation {
  linear, ///< on each triangle, by the weights of locate()
  /// By the areas that a cell of the position would take from the cells of the sites around it
  /// (Sibson, Math. Proc. Camb. Phil. Soc. 87, 1980). Smooth except at the sites. In the plane it
  /// is exact for linear functions.
  natural_neighbours,
  nearest,      ///< the value at the nearest site
  conservative, ///< the mean over a cell by shared areas, see conservative_weights(); not at
                ///< positions
};

/// Weights of sites: a row for each position, a column for each site. The weights of a row are >= 0
/// and sum to 1; a row outside of an open mesh has none, unless it is of the nearest site.
using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The weights that interpolate from the sites of a mesh to positions on its surface.
/// \param mesh, positions as for locate().
/// \throws Error as locate(); invalid_argument for Interpolation::conservative.
Weights interpolation_weights(const Mesh& mesh, const PointsRef& positions,
                              Interpolation kind = Interpolation::linear);

/// Values at positions: the product of weights and values; NaN outside.
/// \param values by site.
/// \throws Error invalid_argument unless there is a value for each site.
DoubleVector interpolate(const Weights& weights, const DoubleVector& values);

/// The boxes of a raster of longitudes and latitudes: nx x ny, between meridians and parallels,
/// which are small circles. Box i of row j has the number j nx + i. A box at a pole is a sector of
/// its cap.
struct LonLatBoxes {
  DoubleVector longitudes; ///< nx degrees, of the nodes, one in each box; ascending
  DoubleVector latitudes;  ///< ny degrees, of the nodes; ascending or descending, -90 to 90
  DoubleVector meridians;  ///< nx + 1 degrees, ascending, the last at most the first + 360
  DoubleVector parallels;  ///< ny + 1 degrees, in the direction of the latitudes, -90 to 90

  std::int64_t size() const { return longitudes.size() * latitudes.size(); } ///< number of boxes
};

/// Equal boxes over the whole sphere, from longitude 0 and latitude -90 on.
/// \param columns, rows 3 and 1 to 2^20.
/// \throws Error invalid_argument for a number out of range.
LonLatBoxes lon_lat_boxes(std::int64_t columns, std::int64_t rows);

/// Boxes around nodes: their sides are half way between these. The first and the last box end half
/// a step beyond their node, with these exceptions. Longitudes whose gap round the sphere is at
/// most 1.5 times their widest step meet in its middle; the first and the last box end at their
/// nodes if these are 360 degrees apart, as in a raster that repeats its first meridian. Latitudes
/// within a step of a pole reach it.
/// \param longitudes, latitudes at least 3 and 2 degrees, ascending; latitudes may descend.
/// \throws Error invalid_argument, naming the first value that is out of order or out of range; for
///         a step of 180 degrees or more.
LonLatBoxes lon_lat_boxes(const DoubleVector& longitudes, const DoubleVector& latitudes);

/// The boxes of a raster, which cover the whole sphere: their sides are half way between nodes,
/// round the sphere and up to the poles. \throws Error as above.
LonLatBoxes lon_lat_boxes(const Raster& raster);

/// Requires boxes that satisfy the conditions above, each narrower than 180 degrees.
/// \throws Error invalid_argument, naming the value.
void require_boxes(const LonLatBoxes& boxes);

/// Areas in steradians: the width in radians times the difference of the sines of the latitudes.
DoubleVector areas(const LonLatBoxes& boxes);

/// 3 x n unit columns, the nodes.
Points3 nodes(const LonLatBoxes& boxes);

/// Weights from the cells of a source to those of a target, with the other data of a file of
/// weights.
struct GridWeights {
  /// A row for each cell of the target. Conservative: the areas that it shares with cells of the
  /// source, divided by their sum. A row outside of the source has none.
  Weights weights;
  DoubleVector source_area;     ///< of the cells: steradians, in a plane the square of its unit
  DoubleVector target_area;     ///< the same of the target
  DoubleVector source_fraction; ///< of each cell's area, what the target covers; 1 up to rounding
  DoubleVector target_fraction; ///< of each cell's area, what the source covers
};

/// A field at the cells of the target. Values that are NaN do not count: the sum of the others is
/// divided by the part of the row's weights that they have. The result is NaN where there is none
/// of them, or where they cover less than a fraction of the cell.
///
/// A field of integers has categories: each cell gets the category of the greatest weight, the
/// lowest of equal ones.
/// \param min_cover the fraction of a cell's area, 0 to 1: that of the weights that count times
///        target_fraction.
/// \throws Error invalid_argument: for a field that has no value for each cell of the source, or is
///         not at cells; for a fraction out of range.
MeshField interpolate(const GridWeights& weights, const MeshField& field, double min_cover = 0);

/// The areas that cells share, from their exact intersections: those of polygons of great-circle
/// arcs, and of such polygons with boxes, whose parallels stay small circles. The integral of a
/// field over what source and target share, the sum of value times area times fraction, is kept
/// within 1e-12 of the sum of its magnitudes. Cells of the source must not overlap.
///
/// Polygons may be concave. Shared areas smaller than rounding, about 1e-15 times the width of the
/// smaller cell, are none. In a plane both are polygons, of the same period. The result has the
/// same bits for any number of threads.
/// \throws Error invalid_argument: as require_boxes(); for ids out of range, naming the polygon;
///         for polygons on different surfaces.
GridWeights conservative_weights(const Polygons& source, const Polygons& target);
GridWeights conservative_weights(const Polygons& source,
                                 const LonLatBoxes& target); ///< the same
GridWeights conservative_weights(const LonLatBoxes& source,
                                 const Polygons& target); ///< the same
/// The same; exact, as products of lengths along longitude and sine of latitude.
GridWeights conservative_weights(const LonLatBoxes& source, const LonLatBoxes& target);

/// The polygon that contains each position, the lowest of several; -1 where there is none. Sides
/// belong to both polygons beside them, up to rounding. \param positions directions, or points of
/// the plane; as locate() takes them. \throws Error as locate() for positions; as
/// conservative_weights() for polygons.
Ids cells_at(const Polygons& polygons, const PointsRef& positions);

/// Weights of a raster's nodes at positions on the sphere: `nearest`, the box that contains the
/// position; or `linear`, bilinear in longitude and latitude between nodes, round the sphere where
/// the boxes close it. Between the last latitude and a pole that its boxes reach it is linear in
/// latitude; the value at the pole is the mean of the row. In the outer half of boxes at another
/// edge of the raster it is constant across that edge. A row outside of the boxes has none.
/// \param positions 3 x n directions.
/// \throws Error invalid_argument: as require_boxes(); for another kind; as locate() for positions.
Weights interpolation_weights(const LonLatBoxes& source, const PointsRef& positions,
                              Interpolation kind);

} // namespace calotte
CALOTTE_API_END
