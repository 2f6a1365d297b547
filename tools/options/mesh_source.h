// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"
#include "options/cell_width_option.h"

#include <calotte/mesh_file.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// The source of a mesh: the file, and the points that a .txt or .tri file refers to; and of its
/// fields.
struct MeshSource {
  std::string path = {};
  std::string points = {};
  bool lonlat = false;
  bool plane = false;              ///< --plane: the mesh is one of the plane
  std::string mesh = {};           ///< of the fields at `path`, which holds none itself; or ""
  std::vector<FieldIndex> at = {}; ///< of the dimensions of fields
  /// The options that apply to a mesh of the sphere alone, and those to one of the plane.
  std::vector<const CLI::Option*> of_sphere = {}, of_plane = {};

  /// The file that holds the mesh.
  const std::string& mesh_path() const { return mesh.empty() ? path : mesh; }
};

/// The name of its file, without the folder.
std::string file_name(const MeshSource& source);

/// Adds the positional MESH, or of another name, and the options --points and --lonlat.
std::shared_ptr<MeshSource> add_mesh_source(CLI::App& command, const std::string& names = "MESH");

/// Adds --plane. A file that is read may know better: with one of the other surface, options of
/// these names are refused.
void add_plane(CLI::App& command, MeshSource& source,
               const std::vector<std::string>& of_sphere = {},
               const std::vector<std::string>& of_plane = {});

/// Adds --at, for commands that take fields.
void add_at(CLI::App& command, std::vector<FieldIndex>& indices);

/// Adds --mesh and --at, for commands that show fields.
void add_fields_of(CLI::App& command, MeshSource& source);

/// The mesh alone, and the fields of its own file.
/// \param choices indices of its fields. Default: none.
/// \throws Error as read_mesh_file and read_points do; invalid_argument for a mesh of the sphere
///         with --plane, and for options of another surface than the mesh's.
MeshFile read_mesh_alone(const MeshSource& source, FieldChoice choice,
                         const std::vector<FieldIndex>& choices = {});

/// The mesh and the fields of MESH, at the indices of --at.
/// \throws Error as above, and as read_field_grid() and find_indices().
MeshFile read_mesh_file(const MeshSource& source, FieldChoice choice);

/// "Time=3, lev=0": the indices of --at; "" without any.
std::string words_of(const std::vector<FieldIndex>& indices);

/// The radius of the sphere, km: that given in metres, that of the planet which a file is of, or
/// the one to which widths in km refer; none if none of these is known.
std::optional<double> radius_km(const MeshFile& file, const WidthWords& widths,
                                std::optional<double> metres = {});

/// The field of a name with a number for each of so many cells; null if the file has none.
const MeshField* find_cell_field(const MeshFile& file, const std::string& name, std::int64_t cells);

/// The lines that say what reading changed, each after the file's name.
std::string changes_of(const MeshSource& source, const MeshFile& file);

} // namespace calotte::tools
