// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"
#include "run/progress.h"

#include <calotte/error.h>
#include <calotte/grid.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// What to mesh, and how wide its cells are: the part of a recipe that does not ask for a run.
struct GridInput {
  Recipe recipe;
  WidthRules rules; ///< of widths, if there are any
};

/// \param plane the surface, unless it is the sphere or the part of it.
/// \throws Error invalid_argument, parse, file.
GridInput read_grid(const DensityWords& density, const RegionWords& part,
                    std::optional<std::int64_t> cells, std::optional<Surface> plane = {});

/// What a request asks for, with its files read.
struct CvtInput {
  /// A file of points, and the lines of it where they stand.
  struct File {
    std::string name; ///< or ""
    std::vector<std::int64_t> lines;
  };
  Recipe recipe;
  WidthRules rules;      ///< of widths, if there are any
  File fixed_file, file; ///< of the fixed points, which come first in a run, and of the start's
  /// Checksums of these points and of the lines of --fixed, lines "name value" of a run's
  /// configuration.
  std::string points, fixed;
};

/// Whether points of a start depend on the seed.
inline bool is_drawn(CvtStart::Kind kind) {
  return kind == CvtStart::Kind::multilevel || kind == CvtStart::Kind::continuation ||
         kind == CvtStart::Kind::random || kind == CvtStart::Kind::density;
}

/// Validates the options of the start before any work. \throws Error invalid_argument.
void require_start(const CvtRequest& request);

/// Reads all files that a recipe takes.
/// \throws Error invalid_argument, parse, file.
CvtInput read_input(const CvtRequest& request, Progress& progress);

/// The schedule of its recipe. An error that names a point names its line, too.
/// \throws Error as plan().
Schedule plan_of(const CvtInput& input, Progress& progress);

/// Rejects options that the start chosen for the request does not have. \throws Error
/// invalid_argument.
void require_used(const CvtRequest& request, const Schedule& schedule);

/// Remarks on the widths and on the number of cells, a line each, without an end.
std::vector<std::string> notes_on(const CvtRequest& request, const CvtInput& input,
                                  const Schedule& schedule);

/// Replaces the column of a bad point of the start in an error by the line in its file.
[[noreturn]] void rethrow_with_line(const Error& error, const CvtInput& input);

} // namespace calotte::tools
