// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/parts.h"
#include "quality/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

/// The triangles of a mesh, and the cells that they surround.
namespace calotte::quality_detail {

/// The mesh with all columns of norm 1.
Mesh with_unit_columns(Mesh mesh);

/// The shape of a triangle. \param mesh of unit columns, or of the plane.
Shape make_shape(const Mesh& mesh, std::int64_t t);
Shapes make_shapes(const Mesh& mesh); ///< of all

/// Measures of the sides of a cell, as far as triangles surround it.
struct Sides {
  Tally arcs;    ///< lengths of its Delaunay edges
  Tally voronoi; ///< lengths of its Voronoi edges
  double area = 0;
  bool open = false;
  bool bad = false; ///< has a short side, or the centre of an obtuse triangle as a corner

  /// Whether triangles surround the site.
  bool whole() const { return !open && arcs.count > 0; }
};

/// The sides of cells, by site.
/// \param mesh may be open; \param shapes of its triangles.
std::vector<Sides> sides_of_cells(const Mesh& mesh, const Shapes& shapes);

/// Sets sigma, cell_quality, cell_area, bad_cells and bad_spacing by the cells that triangles
/// surround. \returns the sum of their areas.
double set_whole_cells(const std::vector<Sides>& cells, Quality& result);

/// By number of neighbours, the number of sites with a closed ring of triangles.
std::vector<std::int64_t> inner_degrees(const std::vector<Sides>& cells);

} // namespace calotte::quality_detail
