// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>

#include <string>
#include <vector>

namespace calotte::tools {

/// What a picture of convergence takes from the report of one run, see CvtReport.
struct History {
  std::string name; ///< of the file
  Norm norm = Norm::l2_scaled;
  double tolerance = 0;
  bool converged = false;
  double seconds = 0;
  std::vector<CvtIteration> iterations; ///< at least one
};

/// Reads the JSON that `calotte cvt --report` writes.
/// \throws Error file; parse, naming the file and the key that is missing or has no such value.
History read_history(const std::string& path);

/// By iteration a norm of its move over h = sqrt(4 pi / cells).
std::vector<double> scaled_l2(const History& history);
std::vector<double> scaled_linf(const History& history);

/// By iteration what the stopping norm's tolerance is on that scale; NaN where it has no place on
/// it (the gradient).
std::vector<double> scaled_tolerance(const History& history);

/// By iteration E/E_end - 1, E_end the energy at the end of the iteration's level. Where the
/// quadrature rule changes within a level, the energy's jump (less a descent like the one before)
/// is taken out. 0 at the end of each level.
std::vector<double> energy_excess(const History& history);

/// The first iteration of each level, and the number of iterations.
std::vector<std::size_t> level_starts(const History& history);

} // namespace calotte::tools
