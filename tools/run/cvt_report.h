// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"
#include "run/kept_states.h"

#include <calotte/grid.h>

#include <string>
#include <vector>

namespace calotte::tools {

/// The report of a completed run.
/// \param states that the run kept.
/// \param threads number of threads.
/// \param area area of the sphere or the domain.
std::string to_json(const CvtRequest& request, const Schedule& schedule, const CvtReport& report,
                    std::int64_t cells, double area, int threads,
                    const std::vector<KeptState>& states);

/// One line without a line end.
/// \param before iterations of the earlier parts of a resumed run.
/// \param area area of a planar domain, by whose square the energy is divided; 1 for the sphere.
std::string summary(const CvtRequest& request, const CvtStop& stop, const CvtReport& report,
                    std::int64_t cells, double area, std::int64_t before);

/// "l2-scaled 1.2e-05", or "" for a run of a number of iterations.
std::string residual_words(const CvtRequest& request, const CvtReport& report);

} // namespace calotte::tools
