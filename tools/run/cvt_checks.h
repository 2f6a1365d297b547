// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"

#include <optional>
#include <set>
#include <string>

namespace calotte::tools {

/// Rejects options that do not apply to the grid of --hexagons.
/// \param outputs options that the command has for it, without hyphens.
/// \throws Error invalid_argument.
void require_no_run(const CvtRequest& request, const std::set<std::string>& outputs);

/// The same for calotte cvt. \throws Error invalid_argument, file.
void require_hexagons(const CvtRequest& request);

/// Rejects options of the sphere in a plane. \throws Error invalid_argument.
void require_no_sphere(const std::optional<double>& sphere_radius,
                       const std::optional<std::string>& units);

/// Checks all options of a run that can fail, before any work.
/// \throws Error invalid_argument, file.
void require_request(const CvtRequest& request);

} // namespace calotte::tools
