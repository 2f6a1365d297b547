// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

/// The files that a command reads and writes: checks of their names before any work.
namespace calotte::tools {

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

} // namespace calotte::tools
