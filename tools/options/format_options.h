// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"
#include "options/model_option.h"
#include "options/sphere_radius_option.h"

#include <calotte/read.h>
#include <calotte/write.h>

#include <memory>
#include <optional>
#include <string>

namespace calotte::tools {

/// The values of the options for the mesh file that is written.
struct FormatWords {
  std::optional<std::string> format; ///< by the file's name where none is given
  std::optional<std::string> order;  ///< by the format
  std::optional<double> sphere_radius;
  std::optional<std::string> model; ///< --for
};

/// What a command does where an option is not given, for the help.
struct FormatDefaults {
  std::string radius = "1", order = "curve in NetCDF files, else input";
};

/// Adds --for, --format, --sphere-radius and --order.
std::shared_ptr<FormatWords> add_format(CLI::App& command, const FormatDefaults& defaults = {});

/// The names of files of meshes that hold their points, for help texts.
std::string names_of_read_meshes();

/// True if read_sites() reads a file of this name: a mesh that holds its points, except text such
/// as MPI-SCVT's SaveVertices.
bool holds_points(const std::string& path);

/// True if a file is text of positions, as far as its name and its first bytes determine it: of no
/// format of meshes, but for other text than MPI-SCVT's files.
bool is_positions(const std::string& path);

/// True if a file of this name holds triangles alone, as far as the name determines it.
bool holds_triangles(const std::string& path);

/// The help of an option for a mesh that is written in the format of its name or of --format.
std::string help_of_output();

/// Whether the format is MPAS's.
bool is_mpas(Format format);

/// The options of a file of this name, without density and history. A model determines what the
/// other options do not give.
/// \throws Error invalid_argument, before any work: for a name that is no mesh's, or of another
///         format than --format or the model's; for a radius that the model cannot use, or one that
///         is not positive, or not 1 where the format takes points as they are; for an order of
///         triangles alone, which go with the points they were made from.
WriteOptions options_of(const FormatWords& words, const std::string& path);

} // namespace calotte::tools
