// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

/// The files that a command reads and writes: their names are validated before any work.
namespace calotte::tools {

/// Throws, before any work, for a file that cannot be written: it is a folder, or its folder does
/// not exist or is not writable.
/// \throws Error file.
void require_folder(const std::string& path);

/// Throws for an output that would replace an input ("-" is none).
/// \throws Error invalid_argument.
void require_distinct(const std::string& output, const std::string& input);

/// Throws for an input that cannot be read, before what is named after it is validated.
/// \throws Error file.
void require_input(const std::string& path);

/// A file that a command writes, and its name in messages.
struct Output {
  std::string what, path;
};

/// Applies require_folder and require_distinct to all outputs with a path. Two outputs must not be
/// one file.
/// \throws Error file, invalid_argument.
void require_outputs(const std::vector<Output>& outputs, const std::vector<std::string>& inputs);

/// Throws if the disk has no space for a file of so many bytes.
/// \throws Error file.
void require_space(const std::string& path, double bytes);

/// A fingerprint of a file's bytes for configurations: a checksum and their number.
/// \throws Error file.
std::string checksum_of(const std::string& path);

} // namespace calotte::tools
