// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/density_option.h"
#include "options/region_option.h"

#include <calotte/region.h>
#include <calotte/types.h>

#include <cstdint>
#include <optional>
#include <string>

namespace calotte::tools {

/// The region of a run.
struct RunRegion {
  Region region; ///< of the request
  Region meshed; ///< wider for a limited-area grid, whose rings lie outside the region
};

/// The region of the request; the whole sphere where there is none. Reads the file, if there is
/// one. \throws Error as region_of().
Region asked_region(const RegionWords& words, const WidthWords& width_words);

/// None for a run on the whole sphere or in a plane.
/// \param asked as asked_region() returns it.
/// \param widths in km, if there are any; a limited-area grid requires them.
/// \throws Error bad_option, also for widths that do not cover the rings.
std::optional<RunRegion> region_of_run(const RegionWords& words, Region asked,
                                       const WidthWords& width_words,
                                       const std::optional<CellWidth>& widths);

/// The number of cells that the widths imply in a region.
/// \pre the resolution has widths.
/// \throws Error bad_option if no grid has so many or so few.
int cells_of_region(const RegionWords& words, const WidthWords& width_words,
                    const Resolution& resolution, const RunRegion& region);

/// A remark on a mesh that should end at generators on the boundary, where it does not; "" for
/// others. \param first the first generator on the boundary. \param count their number.
std::string doubt_of_boundary(const Mesh& mesh, std::int64_t first, std::int64_t count);

} // namespace calotte::tools
