// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/text.h"
#include "io/cells/raw_mesh.h"
#include "io/command.h"
#include "io/formats/room.h"
#include "io/mpas/mpas.h"
#include "io/shapes/points_text.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

/// The writers and readers of formats; format_table.cpp has the table of them. A writer receives a
/// mesh whose numbers are those of the file. A reader checks that the file is complete and leaves
/// everything else to read_mesh.
namespace calotte::io_detail {

// ---- Streams

/// Writes i j k a line.
/// \param id_of what stands for each site; empty: the site itself.
void put_triangle_lines(const Sink& sink, const Triangles& triangles,
                        std::span<const std::int32_t> id_of = {});
void put_off(const Sink& sink, const Mesh& mesh);
void put_off(const Sink& sink, const Polygons& polygons);
void put_ply(const Sink& sink, const Mesh& mesh);
void put_ply(const Sink& sink, const Polygons& polygons);
void put_triangles_text(const Sink& sink, const Mesh& mesh);
void put_msh(const Sink& sink, const Mesh& mesh);
void put_gmsh(const Sink& sink, const Mesh& mesh, const WriteOptions& options);
void put_sms(const Sink& sink, const Mesh& mesh, const WriteOptions& options);
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
RawMesh get_coastal(std::istream& in, const std::string& name); ///< of SCHISM and ADCIRC
RawMesh get_sms(std::istream& in, const std::string& name);
RawMesh get_geojson(std::istream& in, const std::string& name);

/// Reads triangles whose ids are below `points`.
Triangles get_triangles_text(std::istream& in, const std::string& name, std::int64_t points);

// ---- Files of their own making. \throws Error invalid_argument, file.

struct CellGrid;
void write_ugrid(const std::string& path, const CellGrid& grid, const WriteOptions& options);
void write_ugrid_triangles(const std::string& path, const Mesh& mesh, const WriteOptions& options);
void write_scrip(const std::string& path, const CellGrid& grid, const WriteOptions& options);
void write_esmf(const std::string& path, const CellGrid& grid, const WriteOptions& options);
void write_exodus(const std::string& path, const CellGrid& grid, const WriteOptions& options);
void write_fesom(const std::string& path, const Mesh& mesh, const WriteOptions& options);
void write_schism(const std::string& path, const Mesh& mesh, const WriteOptions& options);
void write_adcirc(const std::string& path, const Mesh& mesh, const WriteOptions& options);
void write_mpi_scvt(const std::string& path, const Mesh& mesh, const WriteOptions& options);

class NetcdfReader;
/// Whether an open file has the format.
bool is_ugrid(const NetcdfReader& file);
bool is_scrip(const NetcdfReader& file);
bool is_esmf(const NetcdfReader& file);
bool is_exodus(const NetcdfReader& file);
bool is_icon(const NetcdfReader& file);
/// \pre the file has the format. \throws Error parse, file.
RawMesh read_ugrid(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_scrip(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_esmf(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_exodus(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_icon(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
RawMesh read_fesom(const std::string& path);
/// Reads the cells, with the lists of corners as in the file.
/// \pre the file has corners.
/// \param centres one for each cell, or none.
Polygons read_scrip_cells(const NetcdfReader& file, const Points3& centres);
Polygons read_esmf_cells(const NetcdfReader& file, const Points3& centres);
Points3 read_esmf_centres(const NetcdfReader& file); ///< none if the file has none
RawMesh read_mpi_scvt(const std::string& path);

} // namespace calotte::io_detail
