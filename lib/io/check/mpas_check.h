// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "io/cells/deviations.h"
#include "io/check/room.h"
#include "io/mpas/mpas_numbering.h"
#include "io/mpas/mpas_variables.h"

#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>

/// Compares an MPAS file with what the writer would put for its mesh. The tessellation of the mesh
/// takes over the free choices of the file. The values of the writer are then those of the file, up
/// to rounding.
namespace calotte::io_detail {

/// What the file should contain.
struct MpasCheck {
  Deviations& deviations;
  Voronoi& voronoi;          ///< with the free choices of the file, as far as they are known
  DoubleVector density = {}; ///< density of the file by cell; empty without one
  double radius = 1;         ///< of the sphere; 1 in a plane
  double width = 1;          ///< mean width of a cell, in the unit of voronoi
  double tolerance = rounding_of_others; ///< relative, of lengths and areas
  bool closed = true, has_edges = true, has_vertices = true;
  /// By edge of an open mesh: 1 if its only cell is the second in the file. Here it is the first.
  Array<std::uint8_t> flipped = {};

  /// Sets the width, and the tolerance that positions in single precision need where cells are
  /// smallest. \pre the lengths of voronoi are known.
  void set_width(double mean);
  /// Rounding of a coordinate in the file, in the unit of voronoi.
  double rounding(const std::string& variable) const;
  /// Whether the file has a variable of the table. A wrong shape is a deviation.
  bool has(const std::string& variable) const;
  /// Adds a deviation if there are differences in a variable of the table.
  void add(const std::string& variable, const Differences& differences,
           const std::string& fault = {}) const {
    deviations.add(variable, differences, mpas_variable(variable).rule, fault);
  }
  std::int64_t rows(MpasDimension dimension) const;
  bool is_flipped(std::int64_t e) const { return flipped.size() > 0 && flipped[e] != 0; }
  /// Whether a vertex has three cells and three edges.
  bool has_triangle(std::int64_t v) const {
    return closed || (voronoi.cells_on_vertex.col(v).minCoeff() >= 0 &&
                      voronoi.edges_on_vertex.col(v).minCoeff() >= 0);
  }
  /// Whether a triangle has a right angle, up to the precision of other programs.
  bool is_right(std::int64_t v) const;
  /// Whether both cells of an edge are present and complete.
  bool has_weights(std::int64_t e) const {
    const std::int32_t a = voronoi.cells_on_edge(0, e), b = voronoi.cells_on_edge(1, e);
    return closed || (b >= 0 && voronoi.cell_area[a] > 0 && voronoi.cell_area[b] > 0);
  }
};

// ---- Rules

/// Some rows of a variable, both stored and derived: of ints, or of doubles.
struct MpasRows {
  std::int64_t begin, end;
  const double* stored;
  std::int64_t stored_width; ///< width of a row; values beyond the width of either count as 0
  const std::int32_t* ints;
  const double* doubles;
  std::int64_t width;
  const std::int32_t* edges; ///< derived edgesOnEdge, for weights; otherwise null
};

/// Records the values that differ by more than the tolerance.
using MpasRule = std::function<void(const MpasRows& rows, Differences& out)>;

/// The rules by variable. They refer to the check.
std::map<std::string, MpasRule> mpas_rules(const MpasCheck& check);

/// A fault of MpasMeshConverter.
struct Fault {
  std::string text = {};
  std::function<bool(std::int64_t row, double stored)> explains = {};
};

/// The known fault of a variable; without a text if it has none. It refers to the check.
Fault mpas_fault(const MpasCheck& check, const std::string& variable);

// ---- Checks

/// Gives edges, vertices and starts of lists the numbers of the file. If the file does not
/// determine them, they keep their numbers, and has_edges or has_vertices is false.
void take_numbering(MpasNumbering&& numbering, MpasCheck& check);

/// Compares each variable with the values of the writer. If the tessellation has only cells,
/// compares only variables of cells.
void compare_mpas(const MpasCheck& check);
void check_mpas_density(const MpasCheck& check);

/// Checks an open mesh: the relations between the lists of ids, and what present cells determine.
void check_open_mpas(const MeshFile& file, double radius, Deviations& deviations);

/// Checks an MPAS file. Frees the mesh once its tessellation is begun: if the caller moves the file
/// in, only one of the two is in memory.
void check_mpas(MeshFile file, Deviations& deviations);

} // namespace calotte::io_detail
