// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"
#include "run/run_region.h"

#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// The start of a run.
struct CvtStart {
  /// A file of points, and the lines of it where they stand.
  struct File {
    std::string name; ///< or ""
    std::vector<std::int64_t> lines;
  };
  File fixed_file, file; ///< of the fixed points, which come first, and of the others
  std::int64_t fixed = 0;
  std::int64_t on_boundary = 0; ///< the last of the fixed ones
  Points3 points;               ///< on the sphere
  Points2 places;               ///< or in the plane
  int bisections = 0;
  std::string note; ///< a message for the user, or ""
  /// The input that determines it, for the run's configuration: lines "name value".
  std::string configuration;
};

/// The rounds of insertion on each level of a multilevel start.
int rounds_of(const CvtRequest& request);

/// Validates the options of the start before any work.
/// \throws Error bad_option.
void require_start(const CvtRequest& request);

/// Sets the request's number of cells to that of the widths, if it is automatic.
/// \returns messages about the widths, one line each.
/// \throws Error bad_option.
std::vector<std::string> settle_cells(CvtRequest& request, const Resolution& resolution,
                                      const std::optional<RunRegion>& region,
                                      const std::optional<PlanarDomain>& domain);

/// Reads or computes the fixed points and the others, if they come from files, and describes the
/// input that determines them. Where the number of cells follows from widths, the request receives
/// that beside the fixed points.
/// \throws Error bad_option, parse, file.
CvtStart open_start(CvtRequest& request, const Density& density,
                    const std::optional<PlanarDomain>& domain,
                    const std::optional<RunRegion>& region);

/// Computes the free points, unless they come from a file, and a continuation's bisections and
/// note.
/// \param domain of a plane.
/// \throws Error bad_option.
void generate_points(const CvtRequest& request, const Density& density,
                     const std::optional<PlanarDomain>& domain,
                     const std::optional<RunRegion>& region, CvtStart& start);

} // namespace calotte::tools
