// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "view/page.h"

#include <string>

namespace calotte::tools {

/// Adds the convergence of a run to a page, from the report of calotte cvt --report, and the states
/// that the run kept.
/// \param view has the run's mesh. \param folder of that mesh and the states.
/// \param choice of the states' quantities.
/// \throws Error as read_history() and read_mesh_file().
void add_run(ViewPage& view, const std::string& report, const std::string& folder,
             const ViewChoice& choice);

} // namespace calotte::tools
