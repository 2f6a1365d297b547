// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/raw_mesh.h"
#include "io/cells/written_fields.h"
#include "io/formats/room.h"

#include <calotte/mesh_file.h>
#include <calotte/write.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The table of formats. Everything that depends on a format follows from it.
namespace calotte::io_detail {

struct CellGrid;
class NetcdfReader;

/// A mesh to write. The writer may consume it.
struct WrittenMesh {
  const Mesh& mesh;
  Mesh* own = nullptr; ///< the same mesh, if it may be consumed

  Mesh take() { return own != nullptr ? std::move(*own) : mesh; }
};

/// The planar meshes that a format supports. All formats support the sphere.
struct Planes {
  bool whole = false;    ///< triangles of any plane but a periodic one, z = 0
  bool clipped = false;  ///< cells that the boundary of a plane clips, or polygons of a plane
  bool periodic = false; ///< meshes of a periodic plane
};

/// What a format holds of a coast besides its triangles.
struct CoastParts {
  bool boundary = false; ///< which parts of the boundary are open, see WriteOptions::open_sites
  bool depth = false;    ///< depths at the sites, see WriteOptions::site_depth
};

/// A file that is being read.
struct InputFile {
  const std::string& path;
  const NetcdfReader* netcdf; ///< null for a file that is not NetCDF
  FieldChoice fields;
};

/// A row of the table. A pointer is null if the format does not support the function.
struct FormatRow {
  FormatInfo info;
  std::string label; ///< name of the contents, MeshFile::format
  Planes planes = {};
  std::int64_t bytes_a_site = 100;                 ///< approximate; used for progress only
  FieldFault (*fault)(const MeshField&) = nullptr; ///< of a field; null if it stores none

  CoastParts holds = {};
  void (*write_mesh)(const std::string&, WrittenMesh, const WriteOptions&) = nullptr;
  /// Writes cells of any shape.
  void (*write_polygons)(const std::string&, const CellGrid&, const WriteOptions&) = nullptr;
  /// The format that is written instead for such cells.
  std::optional<Format> polygons_as = {};

  /// Whether a NetCDF file is of the format. The first row that says so reads it.
  bool (*is)(const NetcdfReader&) = nullptr;
  RawMesh (*read)(const InputFile&) = nullptr;
  /// Whether points with z = 0 make a planar mesh. Otherwise the reader itself says what is planar.
  bool reads_planes = false;
  /// Reads the sites only. Null if nothing else in the file is slow to read or may be invalid.
  Points3 (*read_sites)(const InputFile&) = nullptr;
};

std::span<const FormatRow> format_table();
/// \pre not by_name.
const FormatRow& find_row(Format format);

/// The row of an open NetCDF file; null if it belongs to no row.
const FormatRow* find_row(const NetcdfReader& file);

/// Why a format cannot store a field.
FieldFault find_fault(Format format, const MeshField& field);
/// Whether a format for graphics programs computes a field of that name at Voronoi cells. Those of
/// a file are not stored.
bool is_computed(Format format, const MeshField& field);
/// Refuses a field that a format cannot store, with the formats that can.
/// \throws Error invalid_argument.
[[noreturn]] void refuse_field(const std::string& path, Format format, const MeshField& field,
                               FieldFault fault);

// For messages: the suffixes of formats that contain triangles and their points.
// \param last joins the last two.
std::string triangle_formats(const std::string& last = " or ");
std::string polygon_formats(bool on_sphere); ///< words of formats of cells of any shape
std::string clipped_formats();               ///< words of formats of the clipped cells of a plane

/// The format of a mesh file by its name, if the name determines it.
std::optional<Format> format_of_name(const std::string& path);

/// \throws Error invalid_argument, always, with the names that determine a format.
[[noreturn]] void refuse_name(const std::string& path);

} // namespace calotte::io_detail
