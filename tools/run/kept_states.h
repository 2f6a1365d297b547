// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"

#include <calotte/cvt.h>

#include <cstdint>
#include <string>
#include <vector>

namespace calotte::tools {

/// A state of a run in a file of its own.
struct KeptState {
  std::int64_t evaluation = 0; ///< its number in the run, from 1
  std::string file;            ///< its name, in the folder of the run's result
};

/// Writes the triangles of a run's generators after every N evaluations: of "grid.nc" the files
/// "grid.000010.vtp", "grid.000020.vtp" and so on; in a periodic box "grid.000010.nc" and so on.
class KeptStates {
public:
  /// \param before evaluations of the earlier parts of a resumed run, whose files are listed, too.
  /// \param surface of the run.
  KeptStates(const CvtRequest& request, const Surface& surface, std::size_t before);

  bool due(const CvtReport& report) const;

  /// \throws Error file.
  void keep(const CvtState& state);

  const std::vector<KeptState>& all() const { return states_; }

private:
  std::string mesh_; ///< the result's path
  Surface surface_;
  std::size_t every_, last_;
  std::vector<KeptState> states_;
};

} // namespace calotte::tools
