// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>

#include <functional>
#include <string_view>

CALOTTE_API_BEGIN
namespace calotte {

/// How far a run has come.
struct Progress {
  /// The current stage, one word: "sites", "regions", "triangulate" or "unite" of a triangulation,
  /// "number" or "write" of write(), "check" of check().
  std::string_view stage;
  double fraction = 0; ///< estimated part of the run that is done: 0 to 1, never decreasing
};

/// Called at the start of each stage and between the parallel tasks of a run: after each region,
/// block or file section, never from inside the triangulation of a region. Return true to cancel
/// the run, which then throws Error cancelled and leaves no result and no file.
///
/// Calls come from one thread at a time, but not always from the same thread. The last call of a
/// run that completes has the fraction 1; its return value is ignored. An exception that the
/// callback throws ends the run and reaches the caller. Default: empty; the run then reports
/// nothing.
using ProgressCallback = std::function<bool(const Progress&)>;

} // namespace calotte
CALOTTE_API_END
