// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "peers.h"

#include <functional>

namespace calotte::bench {

/// Runs a triangulation in a new process, whose memory no earlier run has touched; of the report
/// come back the seconds and the numbers, without the lists of regions.
/// \pre this process has started no threads.
Outcome run_in_new_process(const std::function<Outcome()>& run);

} // namespace calotte::bench
