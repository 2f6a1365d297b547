// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <calotte/mesh_file.h>

#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// The values of the options for what formats of the coastal ocean hold besides triangles.
struct CoastWords {
  std::optional<std::string> levels; ///< FESOM's: numbers, or the name of a file of numbers
  std::optional<std::string> bottom; ///< a number, or the name of a field or of a raster's file
  double least = 0;                  ///< depth, metres
  std::string open;                  ///< a shape, or a file of lines or a region, or none

  bool given() const { return levels || bottom || !open.empty(); }
};

/// Adds --depth-levels, --depth and --open.
void add_coast(CLI::App& command, CoastWords& words);

/// The files that the options name.
std::vector<std::string> files_of(const CoastWords& words);

/// Refuses options that the format has no use for, before any input is read.
/// \param format of the output, not by_name.
/// \throws Error invalid_argument.
void require_coast(const CoastWords& words, const std::string& output, Format format);

/// Sets the depths and the open boundary of a file that is written.
/// \param file as it is written: its fields may have the depth of the bottom.
/// \throws Error invalid_argument, for what are no numbers, for a field that the file does not
/// have,
///         for a raster without a number at a site, and where no edge of the boundary is open;
///         as read_raster(), read_lines() and read_region(); file.
void set_coast(const CoastWords& words, const MeshFile& file, WriteOptions& options);

/// A line on depths that are missing; "" where there are none to write, or the file has them.
std::string missing_depths(const std::string& output, const WriteOptions& options,
                           const MeshFile& file);

/// Makes an open mesh one that FESOM reads, where it is written for it, see without_ears().
/// \returns a line on what was removed; "" for nothing.
std::string remove_ears(const std::string& output, Format format, MeshFile& file);

} // namespace calotte::tools
