// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <calotte/mesh_file.h>

#include <optional>
#include <string>

namespace calotte::tools {

/// The values of the options for FESOM's aux3d.out.
struct DepthWords {
  std::optional<std::string> levels; ///< numbers, or the name of a file of numbers
  std::optional<std::string> bottom; ///< a number, or the name of a field

  bool given() const { return levels.has_value(); }
};

/// Adds --depth-levels and --depth.
void add_depths(CLI::App& command, DepthWords& words);

/// Sets the depths of a file that is written.
/// \param file as it is written: its fields may have the depth of the bottom.
/// \throws Error invalid_argument, for what are no numbers, and for a field that the file does not
///         have; file.
void set_depths(const DepthWords& words, const MeshFile& file, WriteOptions& options);

} // namespace calotte::tools
