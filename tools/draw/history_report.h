// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>

#include <cstdint>
#include <string>
#include <vector>

namespace calotte::tools {

/// A mesh that a run wrote on its way.
struct StateFile {
  std::int64_t evaluation = 0; ///< its number in the run, from 1
  std::string name;            ///< in the folder of the run's result
};

/// The data of one run's report for a picture of convergence, see CvtReport.
struct History {
  std::string name;                 ///< of the file
  std::vector<std::string> density; ///< in the syntax of --density
  std::string method;               ///< the value of --method; empty in a report without it
  Norm norm = Norm::l2_scaled;
  double tolerance = 0;
  bool converged = false;
  double seconds = 0;
  std::vector<CvtIteration> iterations; ///< at least one; the evaluations of the energy
  std::vector<StateFile> states;        ///< of --keep-every
};

/// Reads the JSON that `calotte cvt --report` writes.
/// \throws Error file; parse, naming the file and the key that is missing or has no such value.
History read_history(const std::string& path);

/// The number of each evaluation, from 1 through all levels, whether accepted or not.
std::vector<double> evaluation_numbers(const History& history);

/// For each evaluation the seconds from the start to its end: the sum over it and all before,
/// including the search directions.
std::vector<double> elapsed_seconds(const History& history);

/// For each evaluation a norm of its move over h = sqrt(4 pi / cells); NaN if it was not accepted.
std::vector<double> scaled_l2(const History& history);
std::vector<double> scaled_linf(const History& history);

/// For each evaluation the tolerance of the stopping norm on that scale; NaN for a run without one.
std::vector<double> scaled_tolerance(const History& history);

/// For each run and evaluation E/E_min - 1, NaN if it was not accepted. E_min is the minimum of the
/// energies at the ends of the levels, in any run, with the same number of cells, density and rule
/// at their end. If the quadrature rule changes within a level, the jump of the energy (less a
/// decrease like the previous one) is removed.
std::vector<std::vector<double>> energy_excess(const std::vector<History>& histories);

/// The first evaluation of each level, and the number of evaluations.
std::vector<std::size_t> level_starts(const History& history);

} // namespace calotte::tools
