// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/raw_mesh.h"
#include "io/formats/room.h"

#include <calotte/mesh_file.h>
#include <calotte/write.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// One table of formats, from which everything follows that depends on a format.
namespace calotte::io_detail {

struct CellGrid;
class NetcdfReader;

/// A mesh to write. The writer may use it up.
struct WrittenMesh {
  const Mesh& mesh;
  Mesh* own = nullptr; ///< the same, if it may be used up

  Mesh take() { return own != nullptr ? std::move(*own) : mesh; }
};

/// Which planes a format holds; all hold the sphere.
struct Planes {
  bool whole = false;    ///< triangles of any plane but a periodic one, z = 0
  bool clipped = false;  ///< cells that the boundary of a plane clips, or polygons of a plane
  bool periodic = false; ///< and one with a period
};

/// A file that is being read.
struct InputFile {
  const std::string& path;
  const NetcdfReader* netcdf; ///< null where it is none
  FieldChoice fields;
};

/// A row of the table. A pointer is null where a format does not have it.
struct FormatRow {
  FormatInfo info;
  std::string label; ///< of what a file holds, MeshFile::format
  Planes planes = {};
  std::int64_t bytes_a_site = 100; ///< roughly: progress alone depends on it
  bool (*holds_field)(const MeshField&) = nullptr;

  void (*write_mesh)(const std::string&, WrittenMesh, const WriteOptions&) = nullptr;
  /// Cells of any shape.
  void (*write_polygons)(const std::string&, const CellGrid&, const WriteOptions&) = nullptr;
  /// The format that holds such cells where this one is asked for.
  std::optional<Format> polygons_as = {};

  /// Whether a NetCDF file is of the format. The first row that says so reads it.
  bool (*is)(const NetcdfReader&) = nullptr;
  RawMesh (*read)(const InputFile&) = nullptr;
  bool reads_planes = false; ///< of points with z = 0; else a reader itself says what is planar
  /// The sites alone, where what goes with them costs a look or may fail.
  Points3 (*read_sites)(const InputFile&) = nullptr;
};

std::span<const FormatRow> format_table();
/// \pre not by_name.
const FormatRow& row_of(Format format);

/// The row of an open NetCDF file; null where it is none that the table knows.
const FormatRow* row_of(const NetcdfReader& file);
bool holds_field(Format format, const MeshField& field);

// For messages: formats of triangles with their points, by suffixes; \param last joins the last
// two.
std::string triangle_formats(const std::string& last = " or ");
std::string polygon_formats(bool on_sphere); ///< those of cells of any shape, by words
std::string clipped_formats();               ///< those of the clipped cells of a plane, by words

/// The format of a mesh file by its name, if the name determines it.
std::optional<Format> format_of_name(const std::string& path);

/// \throws Error invalid_argument, always, with the names that determine a format.
[[noreturn]] void refuse_name(const std::string& path);

} // namespace calotte::io_detail
