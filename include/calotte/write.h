// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/progress.h>
#include <calotte/renumber.h>
#include <calotte/types.h>

#include <iosfwd>
#include <string>
#include <string_view>

/// Writers. Each file is written beside its place, flushed to the disk and renamed when whole: a
/// reader sees all of it or none.
CALOTTE_API_BEGIN
namespace calotte {

/// Writes x y z, in the plane x y, on each line, with the fewest digits (at most 17) that read back
/// to the same bits.
/// \param points 3 x n, or 2 x n.
/// \throws Error bad_option for another number of rows, before any file is touched; file.
void write_points(const std::string& path, const PointsRef& points);
void write_points(std::ostream& out, const PointsRef& points);

enum class Format {
  by_name,         ///< of the path, see write
  mpas,            ///< full MPAS mesh, NetCDF; NAME.graph.info, as METIS reads it, beside NAME.nc
  mpas_minimal,    ///< what MPAS's MpasMeshConverter.x reads, NetCDF
  ugrid,           ///< UGRID of the Voronoi cells, NetCDF
  ugrid_triangles, ///< UGRID of the Delaunay triangles, NetCDF
  scrip,           ///< SCRIP of the cells, NetCDF
  esmf,            ///< ESMF unstructured of the cells, NetCDF
  vtp,             ///< VTK PolyData of the triangles, CellFields at the sites
  vtu,             ///< VTK UnstructuredGrid of the same
  vtp_cells,       ///< VTK PolyData of the Voronoi cells with their CellFields
  vtu_cells,       ///< VTK UnstructuredGrid of the same
  off,             ///< text, digits as write_points
  ply,             ///< binary doubles
  triangles,       ///< 0-based `i j k` on each line
  mpi_scvt,        ///< SaveVertices, and SaveTriangles and SaveDensity beside it
  msh,             ///< JIGSAW
  geojson,         ///< the cells as polygons with their CellFields
};

struct WriteOptions {
  Format format = Format::by_name;
  Numbering numbering = Numbering::by_format;
  /// Radius of the sphere in NetCDF files, in the file's unit of length (MPAS: metres); > 0;
  /// default 1. Other formats store the points unchanged.
  double sphere_radius = 1;
  /// Density of the mesh, for fields such as meshDensity and nominalMinDc. Default: uniform.
  Density density = {};
  std::string history =
      {}; ///< one line a fact: how the mesh was made; an attribute of NetCDF files
  /// Stages: number, write. A cancelled run leaves no file.
  ProgressCallback progress = {};
};

/// Writes a mesh. By its name the format is that of
///   .nc          mpas
///   .vtp .vtu .off .ply .msh .geojson
///   .txt .tri    triangles: the ids are columns of the input of the triangulation, so that the
///   file goes
///                with the points it was made from: a merged duplicate goes by its site's lowest
///                column
///   SaveVertices mpi_scvt; the rest of the name, if any, is that of the files beside it, too
/// Formats of cells, and the fields of the others, need a closed mesh.
/// Places of NetCDF files are sphere_radius times the unit vectors; a point whose norm is that
/// radius but for rounding keeps its bits.
/// \throws Error bad_option for an unknown suffix, a radius out of range, an ill-formed density,
///         ids that are not the mesh's, an open mesh for a format of cells; all before any file is
///         written; file.
void write(const std::string& path, const Mesh& mesh, const WriteOptions& options = {});

/// A plane, numbered as it is. Periodic: mpas, mpas_minimal and triangles. Not periodic: triangles,
/// and the streams vtp, vtu, off, ply and msh with z = 0.
void write(const std::string& path, const PlanarMesh& mesh, const WriteOptions& options = {});

/// The format that `write` gives a path: the option's, or else that of its name.
/// \throws Error bad_option for a name that says none; for an option that is not that of the name's
///         suffix (a NetCDF format of .nc; vtp and vtp_cells of .vtp, and so on), because readers
///         go by the name; for mpi_scvt under another name.
Format format_of(const std::string& path, Format option = Format::by_name);

/// True if the format stores Voronoi cells and thus requires a closed mesh.
bool holds_cells(Format format);

/// Throws unless `write` supports planar (or periodic) meshes in the format.
/// \throws Error bad_option.
void require_planar_format(const std::string& path, bool periodic, Format format);

/// Writes bytes to a file that is complete or absent, as described above.
/// \throws Error file.
void write_file(const std::string& path, std::string_view bytes);

} // namespace calotte
CALOTTE_API_END
