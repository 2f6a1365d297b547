// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/io.h>

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

/// The command's parts. A subcommand throws calotte::Error, which main turns into one line and an
/// exit code.
namespace calotte::tools {

// ---- Each registers one subcommand with its options and a callback that does the work.

void add_delaunay(CLI::App& app);
void add_points(CLI::App& app);
void add_check(CLI::App& app);
void add_draw(CLI::App& app);

// ---- What they share.

enum ExitCode { done = 0, check_failed = 1, bad_input = 2, file_trouble = 3, internal_error = 4 };

/// Ends the command with an exit code, without a message.
[[noreturn]] void finish(ExitCode code);

/// Refuses, before any work, a file that could not be written: it is a folder, or its own does not
/// exist or is closed. \throws Error file.
void require_folder(const std::string& path);

/// Refuses an output that would replace an input ("-" is none).
/// \throws Error bad_option.
void require_distinct(const std::string& output, const std::string& input);

/// As read_points; "-" is standard input.
Points3 points_from(const std::string& path, Columns columns,
                    std::vector<std::int64_t>* lines = nullptr);

/// Where a mesh is read from: the file, and the points that a .txt or .tri file refers to.
struct MeshSource {
  std::string path;
  std::string points;
  bool lonlat = false;
};

/// Adds the positional MESH and the options --points and --lonlat.
std::shared_ptr<MeshSource> add_mesh_source(CLI::App& command);

/// \throws Error as read_mesh and read_points do.
Mesh read_mesh(const MeshSource& source);

} // namespace calotte::tools
