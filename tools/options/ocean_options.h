// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh.h>

#include <string>
#include <vector>

/// The options of commands for oceans.
namespace calotte::tools {

/// The lines of several files, one file after the other.
std::vector<Points3> read_all_lines(const std::vector<std::string>& files);

/// The points of --seed. \param words LON,LAT, degrees.
Points3 read_seeds(const std::vector<std::string>& words);

} // namespace calotte::tools
