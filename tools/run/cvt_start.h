// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"

#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// Where a run starts.
struct CvtStart {
  std::string file;                ///< that the points come from, or ""
  std::vector<std::int64_t> lines; ///< of it, where they stand
  Points3 points;                  ///< on the sphere
  Points2 places;                  ///< or in the plane
  int bisections = 0;
  std::string note; ///< what the user ought to know of it, or ""
  /// What determines it, for the run's configuration: lines "name value".
  std::string configuration;
};

/// Refuses, before any work, what the options say of the start.
/// \throws Error bad_option.
void require_start(const CvtRequest& request);

/// Gives the request the number of cells that the widths ask for, where it is to have that.
/// \returns what the user ought to know of the widths, a line each. \throws Error bad_option.
std::vector<std::string> settle_cells(CvtRequest& request, const std::optional<CellWidth>& widths);

/// Reads the points, if they come from a file, and says what determines them.
/// \throws Error bad_option, parse, file.
CvtStart open_start(const CvtRequest& request);

/// Makes the points, unless they come from a file; a continuation's bisections and note, too.
/// \param domain of a plane. \throws Error bad_option.
void generate_points(const CvtRequest& request, const Density& density,
                     const std::optional<PlanarDomain>& domain, CvtStart& start);

} // namespace calotte::tools
