// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>

#include <functional>
#include <string_view>

CALOTTE_API_BEGIN
namespace calotte {

struct CvtProgress;

/// The progress of a call.
struct Progress {
  /// The current stage, one word: "sites", "regions", "triangulate" or "unite" of a triangulation,
  /// "descend" of make_grid(), "number" or "write" of write(), "check" of check().
  std::string_view stage;
  /// Estimated part of the call that is done: 0 to 1, never decreasing; 0 for "descend", whose end
  /// is not known.
  double fraction = 0;
  const CvtProgress* run = nullptr; ///< of make_grid(): the run so far; null for other functions
};

/// The action of a call after its callback.
enum class ProgressReply {
  proceed, ///< goes on
  /// make_grid() ends with the grid as it is, marked not converged. Before the last level it has
  /// fewer cells than the recipe asks for. Other functions act as for `cancel`.
  stop,
  cancel, ///< throws Error cancelled, and leaves no result and no file
};

/// Called at the start of each stage and between the parallel tasks of a call: after each region,
/// block or file section, never from inside the triangulation of a region; in make_grid() after
/// each accepted iteration.
///
/// Calls come from one thread at a time, but not always from the same thread. Outside of
/// make_grid() the last call has the fraction 1; what it returns has no effect. An exception that
/// the callback throws reaches the caller. Default: empty; nothing is reported.
using ProgressCallback = std::function<ProgressReply(const Progress&)>;

} // namespace calotte
CALOTTE_API_END
