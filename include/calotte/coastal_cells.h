// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/voronoi.h>

#include <cstdint>

CALOTTE_API_BEGIN
namespace calotte {

/// What coastal_cells() changes. Lengths are in widths of a cell, the square root of its area.
struct CoastalOptions {
  /// A corner of the boundary within a cell stays if it is farther than this from the straight line
  /// between its neighbours that stay; 0 to 0.5. 0 keeps all corners.
  double straightness = 1.0 / 32;
  /// The least length of a Voronoi edge that the boundary cuts, over the distance of its cells; >=
  /// 0 and at most 0.5. Where an edge is shorter, its end on the boundary moves outwards. Ends of
  /// an edge on the boundary that is shorter than 0.05 move along both bisectors. 0 moves none.
  double least_edge = 0.2;
};

/// What coastal_cells() changed. Areas are in steradians; in a plane in the square of its unit.
struct CoastChanges {
  std::int64_t merged_parts = 0;  ///< parts of cells that became parts of the only cell beside them
  std::int64_t removed_parts = 0; ///< parts of cells that became land, beside several cells
  double removed_area = 0;        ///< of these
  std::int64_t removed_islands = 0; ///< islands within a cell that became part of the cell
  double island_area = 0;           ///< of these
  std::int64_t removed_corners = 0; ///< of the boundary
  std::int64_t moved_ends = 0;      ///< of Voronoi edges, off the boundary
  double changed_area = 0;          ///< of cells by both, without sign
  /// Cells that are left with a part of the boundary which their site does not see, or which is
  /// nearer to it than 0.02: they have kites of negative areas, or distances near 0.
  std::int64_t hidden_cells = 0;
  std::int32_t hidden_cell = -1; ///< the first one
  /// Cells at the boundary with less than a third of the mean area of the cells beside them.
  std::int64_t small_cells = 0;
  std::int32_t small_cell = -1; ///< the first one

  /// Whether all values are equal.
  friend bool operator==(const CoastChanges&, const CoastChanges&) = default;
};

/// The cells of coastal_cells().
struct CoastalCells {
  Voronoi voronoi;      ///< the cells, with their edges
  CoastChanges changes; ///< from those of voronoi(mesh)
};

/// The cells of voronoi(mesh) in a bounded surface, in a form that models take:
///
/// - Each cell is one polygon. Where the boundary cuts a cell into parts, as a strip of land does
///   that is narrower than a cell, the cell keeps the part around its site. Another part becomes
///   one of the cell beside it, or land if it is beside several. An island within a cell becomes
///   part of the cell.
/// - A cell has few edges on the boundary: one between two Voronoi edges that the boundary crosses,
///   unless it bends there, see CoastalOptions::straightness. Its site sees all of them: corners
///   that hide a part of the boundary are removed, up to 0.5 from the edge that remains, and all of
///   the cell where that does not suffice. Both ends of each edge are points of the boundary.
/// - No Voronoi edge ends so shortly behind the boundary that it would limit a model's time step,
///   see CoastalOptions::least_edge.
///
/// Voronoi::dc of an edge on the boundary is twice the distance of its cell from Voronoi::edges,
/// the point of the middle half of the edge that is nearest to the cell; of hidden cells it may be
/// sqrt(3) dv.
/// \param mesh as for voronoi(), on a bounded surface. The sites are inside.
/// \throws Error as voronoi(); invalid_argument for a surface without a boundary, and for an option
///         out of range.
CoastalCells coastal_cells(const Mesh& mesh, const CoastalOptions& options = {});

} // namespace calotte
CALOTTE_API_END
