// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"
#include "run/kept_states.h"
#include "run/model_gates.h"

#include <calotte/grid.h>
#include <calotte/quality.h>
#include <calotte/write_grid.h>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// The report of a completed run.
/// \param states that the run kept.
/// \param threads number of threads.
/// \param area area of the sphere or the domain.
/// \param gates of the model that is to read the grid, if one is named.
/// \param coast what making the cells of a region changed.
std::string to_json(const CvtRequest& request, const Schedule& schedule, const CvtReport& report,
                    std::int64_t cells, double area, int threads,
                    const std::vector<KeptState>& states, const std::optional<ModelGates>& gates,
                    const CoastChanges& coast);

/// The periods and walls of a mesh of a plane.
std::string kind_of_plane(const Eigen::Vector2d& period);

/// "10 242 cells", and which part of the mesh they are.
std::string describe_cells(const Recipe& asked, const GridFile& file);

/// What cells that end at a coast changed of it, in words; "" for no part and no island.
/// \param square_km of a steradian.
std::string describe_coast_changes(const CoastChanges& coast, double square_km);

/// That cells do not see all of their coast or are small, and what to do; "" if there are none.
std::string describe_coast_faults(const CoastChanges& coast);

/// Whether a run's grid is good, a clause: "all shapes within the limits of models", or what is not
/// and what to do.
/// \param shapes as measured; of a run that did not end with a polish.
std::string verdict(const CvtStop& stop, const CvtReport& report, const BadShapes& shapes);

/// "l2-scaled 1.2e-05", or "" for a run of a number of iterations.
std::string residual_words(const CvtRequest& request, const CvtReport& report);

} // namespace calotte::tools
