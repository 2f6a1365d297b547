// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <calotte/cvt.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <string>

namespace calotte::tools {

/// The words for the region of a run.
struct RegionWords {
  std::string region;        ///< a shape or a file, or none
  std::string inside;        ///< LON,LAT of the region, or none
  bool limited_area = false; ///< adds the rings of boundary cells
  Boundary boundary = Boundary::clip;
};

/// Whether the mesh ends at generators on the region's boundary.
inline bool ends_at_boundary(const RegionWords& words) {
  return words.boundary == Boundary::generators;
}

/// Adds --boundary, how a mesh ends.
void add_boundary(CLI::App& command, Boundary& boundary, const char* help);

/// Adds --inside, which needs --region.
void add_inside(CLI::App& command, std::string& inside);

/// Adds --region, --inside, --limited-area and --boundary.
void add_region(CLI::App& command, RegionWords& words);

/// Rejects words that exclude each other. \throws Error invalid_argument.
void require_region_words(const RegionWords& words);

/// The region of the word of --region, see read_region(). Reads the file, if there is one.
/// \param inside LON,LAT of the region, where its rings may have it on either side; or empty.
/// \param radius_km radius of the sphere to which lengths in km refer.
/// \throws Error invalid_argument naming the option, the word and the remedy; as read_region() and
///         region_around().
Surface region_of(const std::string& word, const std::string& inside,
                  double radius_km = earth_radius_km);

/// Whether the word has a length in km or m, as circle=10,50,1500km does.
bool has_length(const std::string& word);

/// A fingerprint of the corners, a line for a run's configuration.
std::string region_configuration(const Surface& region);

} // namespace calotte::tools
