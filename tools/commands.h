// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/io.h>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// The command's parts. A subcommand throws calotte::Error, which main turns into one line and an
/// exit code.
namespace calotte::tools {

// ---- Each registers one subcommand with its options and a callback that does the work.

void add_delaunay(CLI::App& app);
void add_cvt(CLI::App& app);
void add_points(CLI::App& app);
void add_check(CLI::App& app);
void add_info(CLI::App& app);
void add_draw(CLI::App& app);
void add_convert(CLI::App& app);

// ---- What they share.

enum ExitCode {
  done = 0,
  check_failed = 1,
  not_converged = 1,
  bad_input = 2,
  file_trouble = 3,
  internal_error = 4,
  interrupted = 130, ///< by SIGINT, as a shell has it: 128 and the signal's number
  terminated = 143,  ///< by SIGTERM
};

/// Ends the command with an exit code, without a message.
[[noreturn]] void finish(ExitCode code);

/// Refuses, before any work, a file that could not be written: it is a folder, or its own does not
/// exist or is closed. \throws Error file.
void require_folder(const std::string& path);

/// Refuses an output that would replace an input ("-" is none).
/// \throws Error bad_option.
void require_distinct(const std::string& output, const std::string& input);

/// A file that a command writes, and the word that messages have for it.
struct Output {
  std::string what, path;
};

/// As require_folder and require_distinct, of all the outputs with a path; nor may two be one file.
/// \throws Error file, bad_option.
void require_outputs(const std::vector<Output>& outputs, const std::vector<std::string>& inputs);

/// What tells a file's bytes from others', for configurations: a checksum and their number.
/// \throws Error file.
std::string checksum_of(const std::string& path);

/// With the fewest digits that read back to the same bits.
std::string shortest(double value);

/// Whole numbers in a range, for an option's transform: in decimal, though they may start with
/// zeros.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// As read_points; "-" is standard input.
Points3 points_from(const std::string& path, Columns columns,
                    std::vector<std::int64_t>* lines = nullptr);

/// Points with the lines they stand on, for messages.
struct PointFile {
  std::string name;
  Points3 points;
  std::vector<std::int64_t> lines;
};

/// The suffixes of meshes that hold their points, for help texts.
inline constexpr const char* mesh_suffixes =
    ".nc (MPAS, UGRID, SCRIP or ESMF), .vtp, .vtu, .off, .ply, .msh or .geojson";

/// Text (MPI-SCVT's SaveVertices and RegionList are such), or the points of a mesh, see
/// mesh_suffixes, which have no lines.
/// \throws Error as points_from and read_sites; bad_option for a mesh in longitude and latitude.
PointFile read_point_file(const std::string& path, bool lonlat);

/// Places in a plane, likewise.
struct PlanarPointFile {
  std::string name;
  Points2 points;
  std::vector<std::int64_t> lines;
};

/// Text, x y a line; "-" is standard input. \throws Error as read_planar_points.
PlanarPointFile read_planar_point_file(const std::string& path);

/// The library names the column of a bad point; who wrote the file looks for the line.
/// \param lines of the columns of the file `name`; none where it has none.
[[noreturn]] void rethrow_with_line(const Error& error, const std::string& name,
                                    const std::vector<std::int64_t>& lines);

/// Where a mesh is read from: the file, and the points that a .txt or .tri file refers to.
struct MeshSource {
  std::string path;
  std::string points;
  bool lonlat = false;
  bool plane = false; ///< a mesh of the plane, read by read_planar_mesh
};

/// Adds the positional MESH, or of another name, and the options --points and --lonlat.
std::shared_ptr<MeshSource> add_mesh_source(CLI::App& command, const std::string& names = "MESH");

/// Adds --plane. \returns the option.
CLI::Option* add_plane(CLI::App& command, MeshSource& source);

/// \throws Error as read_mesh and read_points do.
Mesh read_mesh(const MeshSource& source);
PlanarMesh read_planar_mesh(const MeshSource& source);

} // namespace calotte::tools
