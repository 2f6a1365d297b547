// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh.h>

#include <string>
#include <vector>

namespace calotte::tools {

/// Where Debian's packages gmt-gshhg-low, -high and -full put the coasts of GSHHG.
inline constexpr const char* coast_folder = "/usr/share/gmt-gshhg";

/// The coasts for an enlarged map, on which those of 1:110 million are too coarse: rings of
/// unit columns, without those of a few pixels. Of the files of GSHHG in the folder, it reads the
/// coarsest one whose details are about a pixel, or else the finest.
/// \param pixel its width on the Earth, km.
/// \returns none where the coarse ones suffice, or there is no file that can be read.
std::vector<Points3> fine_coast(double pixel, const std::string& folder = coast_folder);

} // namespace calotte::tools
