// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/command.h"
#include "io/room.h"
#include "io/text.h"

#include <calotte/io.h>
#include <calotte/mesh_file.h>
#include <calotte/types.h>
#include <calotte/voronoi.h>

#include <iosfwd>
#include <string>
#include <vector>

/// The formats. A writer's mesh is numbered as its file shall be; a reader checks that the file is
/// whole and leaves the rest to read_mesh.
namespace calotte::io_detail {

/// A mesh as a file holds it, before anything is known of its order and orientation.
struct RawMesh {
  Points3 points = {};      ///< the sites; none where the file holds cells without centres
  Triangles triangles = {}; ///< of the sites; none where these are to be triangulated
  Polygons polygons = {};   ///< the cells, of either orientation; a cell without corners is unknown
  /// The format leaves the orientation of each cell free, and clockwise ones are turned.
  bool turns_each = false;
  /// How far a corner may be from its place by the file's digits alone, radians.
  double corner_rounding = 0;
  DoubleVector density = {}; ///< by site, or empty
  std::vector<MeshField> fields = {};
  Pairs edges = {};                      ///< the sites of the edges that fields have; -1 for none
  std::vector<std::string> ignored = {}; ///< variables that are neither the mesh's nor fields
};

// ---- Streams

void put_points(const Sink& sink, const Points3& points);              ///< x y z a line
void put_triangle_lines(const Sink& sink, const Triangles& triangles); ///< i j k a line
void put_off(const Sink& sink, const Mesh& mesh);
void put_off(const Sink& sink, const Polygons& polygons);
void put_ply(const Sink& sink, const Mesh& mesh);
void put_ply(const Sink& sink, const Polygons& polygons);
void put_triangles_text(const Sink& sink, const Mesh& mesh);
void put_msh(const Sink& sink, const Mesh& mesh);
void put_vtp(const Sink& sink, const Mesh& mesh, const WriteOptions& options);
void put_vtu(const Sink& sink, const Mesh& mesh, const WriteOptions& options);
void put_vtp_cells(const Sink& sink, const Mesh& mesh, const WriteOptions& options);
void put_vtu_cells(const Sink& sink, const Mesh& mesh, const WriteOptions& options);
void put_vtp_cells(const Sink& sink, const Polygons& polygons, const WriteOptions& options);
void put_vtu_cells(const Sink& sink, const Polygons& polygons, const WriteOptions& options);
void put_geojson(const Sink& sink, const Mesh& mesh, const WriteOptions& options);
void put_geojson(const Sink& sink, const Polygons& polygons, const WriteOptions& options);

/// \throws Error parse, file.
RawMesh get_vtk_xml(std::istream& in, const std::string& name);    ///< .vtp and .vtu
RawMesh get_vtk_legacy(std::istream& in, const std::string& name); ///< .vtk
RawMesh get_off(std::istream& in, const std::string& name);
RawMesh get_ply(std::istream& in, const std::string& name);
RawMesh get_msh(std::istream& in, const std::string& name);
RawMesh get_geojson(std::istream& in, const std::string& name);

/// Triangles of `points` columns.
Triangles get_triangles_text(std::istream& in, const std::string& name, std::int64_t points);

/// Whether a format has a place for a field; all that have a place for fields at all have one for
/// those with one number for each cell.
bool holds_field(Format format, const MeshField& field);

/// The format that holds polygons where one of triangles is asked for: vtp and vtu have a kind of
/// their own for cells. none for a format that holds no other faces than triangles.
std::optional<Format> polygon_format(Format format);

// ---- Files of their own making. \throws Error invalid_argument, file.

/// The mesh is consumed: its arrays are reused, and freed after their last use.
void write_mpas(const std::string& path, Mesh mesh, const WriteOptions& options);
/// A whole tessellation, which may be open. \param places of its cells: radius times the unit
/// vectors; in a plane 3 x 0.
void write_mpas(const std::string& path, Voronoi voronoi, Points3 places,
                const WriteOptions& options);
void write_mpas_minimal(const std::string& path, Mesh mesh, const WriteOptions& options);
struct CellGrid;
void write_ugrid(const std::string& path, const CellGrid& grid, const WriteOptions& options);
void write_ugrid_triangles(const std::string& path, const Mesh& mesh, const WriteOptions& options);
void write_scrip(const std::string& path, const CellGrid& grid, const WriteOptions& options);
void write_esmf(const std::string& path, const CellGrid& grid, const WriteOptions& options);
void write_exodus(const std::string& path, const CellGrid& grid, const WriteOptions& options);
void write_fesom(const std::string& path, const Mesh& mesh, const WriteOptions& options);
void write_mpi_scvt(const std::string& path, const Mesh& mesh, const WriteOptions& options);

class NetcdfReader;
/// Whether an open file is of the kind.
bool is_mpas(const NetcdfReader& file);
bool is_ugrid(const NetcdfReader& file);
bool is_scrip(const NetcdfReader& file);
bool is_esmf(const NetcdfReader& file);
bool is_exodus(const NetcdfReader& file);
bool is_icon(const NetcdfReader& file);
/// \pre it is. \throws Error parse, file.
RawMesh read_mpas(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
Points3 read_mpas_sites(const NetcdfReader& file); ///< without a look at the triangles
bool is_planar_mpas(const NetcdfReader& file);
MeshFile read_planar_mpas(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_ugrid(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_scrip(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_esmf(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_exodus(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_icon(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_fesom(const std::string& path);
/// The cells with their corners' lists as the file has them. \pre it has corners, and as many
/// centres or none.
Polygons read_scrip_cells(const NetcdfReader& file, const Points3& centres);
Polygons read_esmf_cells(const NetcdfReader& file, const Points3& centres);
Points3 read_esmf_centres(const NetcdfReader& file); ///< none where the file has none
RawMesh read_mpi_scvt(const std::string& path);

/// Appends ids of one line of text, which count from `first` there and from 0 in `faces`.
/// \throws Error parse for an id that is not one of the points.
void parse_ids(const LineReader& reader, const std::int64_t* ids, std::int64_t points,
               std::vector<std::int32_t>& faces, std::int64_t first = 0, std::int64_t count = 3);

/// An array's bytes.
template <class T> std::string_view bytes_of(const T* data, Eigen::Index count) {
  return {reinterpret_cast<const char*>(data), sizeof(T) * static_cast<std::size_t>(count)};
}

} // namespace calotte::io_detail
