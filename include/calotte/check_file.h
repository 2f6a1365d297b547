// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh_file.h>

#include <cstdint>
#include <string>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// A variable or attribute of a file that contradicts the mesh of the file or a rule of its format.
struct Deviation {
  std::string variable; ///< its name in the file
  /// The largest relative difference between a stored and the derived value; 1 for ids and for
  /// rules without a measure; infinite for values that are not finite.
  double difference = 0;
  std::int64_t index = -1; ///< 0-based, of that value in the variable; -1 for none
  /// True if all its differences are a known fault of MpasMeshConverter (MPAS-Tools), in variables
  /// that do not enter a model's equations.
  bool known = false;
  std::string text; ///< one line: the variable, the rule, the index, and both values
};

/// Compares the variables of a NetCDF mesh file with what follows from its mesh, and with the rules
/// of its format (MPAS, UGRID, SCRIP, ESMF). Absent variables are not checked. The file's numbering
/// of edges and vertices, the first entry of a cyclic list, and the first cell of an edge are free.
///
/// The mesh is that of the cells and of cellsOnVertex (MPAS), or of the polygons. All else follows
/// from it, so that a wrong position of a cell makes many variables deviate.
///
/// Differences count from 1e-6 of a value's scale on, because MpasMeshConverter computes lengths
/// and areas in single precision; angles are compared modulo 2 pi. The scale is local: that of
/// dvEdge is dcEdge, that of an area is the sum of its kites, that of a coordinate the distance to
/// the nearest cells. Longitudes and latitudes of MPAS may differ by 2e-8 + 1e-6 mean cell widths.
/// nominalMinDc, a sum over all cells of a closed mesh, must agree to 1e-10, because it alone tells
/// of meshDensity.
///
/// The spacing of cells that have all their neighbours is compared with nominalMinDc
/// meshDensity^(-1/4). The ratios are smoothed over neighbours. Their median may be 1/1.25 to 1.25,
/// where an open mesh has nominalMinDc, and their 95% quantile 1.6 times the 5% quantile: within
/// that are independent random sites of uniform density, and CVTs of any density.
/// Files with coordinates in single precision have a wider tolerance.
///
/// Not checked: what depends on the missing cells of an open MPAS mesh, and the positions of its
/// vertices on the boundary; fields; masks, but for
/// values other than 0 and 1; areas in units other than radians^2; centres that are inside their
/// cells, where most of the cells are not Voronoi cells.
///
/// \param file the contents of the file at `path`, as read_mesh_file() returns them.
/// \returns nothing for other formats.
/// \throws Error file, parse, as read_mesh_file().
std::vector<Deviation> check_file(const std::string& path, const MeshFile& file);

/// The same, with less memory for MPAS: `file` is freed on the way, and unspecified afterwards.
std::vector<Deviation> check_file(const std::string& path, MeshFile&& file);

} // namespace calotte
CALOTTE_API_END
