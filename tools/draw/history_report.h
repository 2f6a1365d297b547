// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>

#include <string>
#include <vector>

namespace calotte::tools {

/// What a picture of convergence takes from the report of one run, see CvtReport.
struct History {
  std::string name;                 ///< of the file
  std::vector<std::string> density; ///< as --density was given
  std::string method;               ///< the word of --method; empty in a report without it
  Norm norm = Norm::l2_scaled;
  double tolerance = 0;
  bool converged = false;
  double seconds = 0;
  std::vector<CvtIteration> iterations; ///< at least one; the evaluations of the energy
};

/// Reads the JSON that `calotte cvt --report` writes.
/// \throws Error file; parse, naming the file and the key that is missing or has no such value.
History read_history(const std::string& path);

/// The number of each evaluation, from 1 through all levels, whether accepted or not.
std::vector<double> evaluation_numbers(const History& history);

/// By evaluation the seconds from the start to its end: those of it and of all before, and of
/// finding the directions that led there.
std::vector<double> elapsed_seconds(const History& history);

/// By evaluation a norm of its move over h = sqrt(4 pi / cells); NaN where it was not accepted.
std::vector<double> scaled_l2(const History& history);
std::vector<double> scaled_linf(const History& history);

/// By evaluation what the stopping norm's tolerance is on that scale; NaN where it has no place on
/// it (the gradient).
std::vector<double> scaled_tolerance(const History& history);

/// By run and evaluation E/E_min - 1, NaN where it was not accepted. E_min is the least of the
/// energies at the ends of the levels, in any run, that have the same number of cells, density and
/// rule at their end: those that compare. Where the quadrature rule changes within a level, the
/// energy's jump (less a descent like the one before) is taken out.
std::vector<std::vector<double>> energy_excess(const std::vector<History>& histories);

/// The first evaluation of each level, and the number of evaluations.
std::vector<std::size_t> level_starts(const History& history);

} // namespace calotte::tools
