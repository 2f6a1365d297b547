// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <cerrno>
#include <filesystem>
#include <iostream>
#include <system_error>

#include <unistd.h>

namespace calotte::tools {

void finish(ExitCode code) { throw CLI::RuntimeError(code); }

void require_folder(const std::string& path) {
  const std::filesystem::path parent = std::filesystem::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (std::error_code error; std::filesystem::is_directory(path, error))
    throw Error(ErrorCode::file,
                "cannot write " + path + ": it is a folder; give the name of a file");
  if (std::error_code error; !std::filesystem::is_directory(folder, error))
    throw Error(ErrorCode::file, "cannot write " + path + ": the folder " + folder +
                                     " does not exist; create it first");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(ErrorCode::file, "cannot write " + path + ": the folder " + folder + ": " +
                                     std::generic_category().message(errno) + "; write elsewhere");
}

void require_distinct(const std::string& output, const std::string& input) {
  std::error_code absent;
  if (input != "-" && std::filesystem::equivalent(output, input, absent))
    throw Error(ErrorCode::bad_option, output + " is both input and output; give the output "
                                                "another name");
}

Points3 points_from(const std::string& path, Columns columns, std::vector<std::int64_t>* lines) {
  return path == "-" ? read_points(std::cin, "standard input", columns, lines)
                     : read_points(path, columns, lines);
}

std::shared_ptr<MeshSource> add_mesh_source(CLI::App& command) {
  auto source = std::make_shared<MeshSource>();
  command
      .add_option("MESH", source->path,
                  "the mesh: .vtp, .vtu, .off, .ply, or .txt/.tri with --points")
      ->required();
  command.add_option("--points", source->points, "the points that a .txt or .tri file refers to");
  command.add_flag("--lonlat", source->lonlat,
                   "these points are longitude and latitude in degrees");
  return source;
}

Mesh read_mesh(const MeshSource& source) {
  if (source.points.empty())
    return calotte::read_mesh(source.path);
  const Points3 points = points_from(source.points, source.lonlat ? Columns::lonlat : Columns::xyz);
  return calotte::read_mesh(source.path, &points);
}

} // namespace calotte::tools
