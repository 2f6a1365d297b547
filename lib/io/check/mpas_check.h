// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/deviations.h"
#include "io/check/room.h"
#include "io/mpas/mpas_numbering.h"
#include "io/mpas/mpas_variables.h"

#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

/// What an MPAS file holds against what follows from its cells and its cellsOnVertex.
namespace calotte::io_detail {

/// What the file should hold, in its own numbering.
struct MpasCheck {
  Deviations& deviations;
  const Voronoi& voronoi;
  const DoubleVector& density; ///< of the file, by cell; empty if it has none
  const MpasNumbering& numbering;
  double radius;    ///< of the sphere; 1 in a plane
  double width;     ///< mean width of a cell, in the unit of voronoi
  double tolerance; ///< relative, of lengths and areas
  bool closed = true;
  /// Rounding of a variable's places, in the unit of voronoi.
  double rounding(const std::string& variable) const;

  /// Whether the file has a variable of the table; another shape is a deviation.
  bool has(const std::string& variable) const;
  /// Adds a deviation if there are differences in a variable of the table.
  void add(const std::string& variable, const Differences& differences,
           const std::string& fault = {}) const {
    deviations.add(variable, differences, mpas_variable(variable).rule, fault);
  }
  bool has_vertices() const { return numbering.vertex.size() > 0; }
  /// Whether a vertex of the tessellation has three cells and three edges.
  bool has_triangle(std::int32_t v) const {
    return closed || (voronoi.cells_on_vertex.col(v).minCoeff() >= 0 &&
                      voronoi.edges_on_vertex.col(v).minCoeff() >= 0);
  }
  bool has_edges() const { return numbering.edge.size() > 0; }
  /// Whether both cells of an edge of the tessellation are there, and whole.
  bool has_weights(std::int32_t e) const {
    const std::int32_t a = voronoi.cells_on_edge(0, e), b = voronoi.cells_on_edge(1, e);
    return closed || (b >= 0 && voronoi.cell_area[a] > 0 && voronoi.cell_area[b] > 0);
  }
};

void check_mpas_attributes(Deviations& deviations, bool on_sphere);
void check_mpas_places(const MpasCheck& check);
void check_mpas_lists(const MpasCheck& check); ///< of ids
void check_mpas_measures(const MpasCheck& check);
void check_mpas_weights(const MpasCheck& check);
void check_mpas_values(const MpasCheck& check); ///< those that the table has a function for
void check_mpas_density(const MpasCheck& check);

/// Of an open mesh: the relations between the lists of ids, and what present cells determine.
void check_open_mpas(const MeshFile& file, double radius, Deviations& deviations);

/// All of it. Frees the mesh of the file once its tessellation is begun: a caller that moves the
/// file in needs memory for one of the two.
void check_mpas(MeshFile file, Deviations& deviations);

} // namespace calotte::io_detail
