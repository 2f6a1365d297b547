// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vector_field.h"
#include "cvt/room.h"

#include <calotte/cvt.h>

#include <cstdint>
#include <vector>

namespace calotte::cvt_detail {

/// The memory of a method.
struct Memory {
  /// Of generators, and of the gradient then; oldest first.
  std::vector<base_detail::CompactField> steps, changes;
  std::vector<double> curvatures; ///< their inner products
  double stride = 1;       ///< first trial of the next line search, as a share of the full step
  Points3 laplacian_at;    ///< generators that the graph Laplacian was made for
  int since_laplacian = 0; ///< evaluations
  bool flipped = false;    ///< edges, since then
};

/// What a CvtState holds.
struct State {
  static State& of(CvtState& state) { return *state.state_; }
  static const State& of(const CvtState& state) { return *state.state_; }
  static CvtState wrapped(State&& state);

  Points3 points; ///< unit generators, along a space-filling curve; in the plane with z = 0
  std::vector<std::int32_t> id;            ///< of each: its column in the result
  std::vector<std::int32_t> site_of_input; ///< as Mesh's; of the start, or empty after a bisection
  std::int64_t fixed = 0;                  ///< generators with lower ids stay where they are
  int bisections_left = 0;
  int rounds_left = 0; ///< of insertion, on this level
  int idle_rounds =
      0; ///< of this level: they brought the number of generators no nearer to its end
  int iterations_of_level = 0;
  bool final_rule = false;     ///< it has taken over
  bool stuck = false;          ///< no step lowers the value, as far as the method can tell
  double penalty = 0;          ///< of shapes, in the polish; 0 before
  double demanded_spacing = 1; ///< in the polish: at rho = 1
  int glides = 0;              ///< how often dislocations were moved
  int since_restart = 0;       ///< evaluations of the descent since its points were changed
  int raised = 0;              ///< how often the penalty was raised
  bool descended = true;       ///< the descent before the polish converged
  Memory memory;
  CvtReport report;
};

/// Whether each generator stays where it is; empty if none does.
std::vector<std::uint8_t> fixed_generators(const State& state);

/// The generators in the order of the result.
Points3 in_order(const State& state);

} // namespace calotte::cvt_detail
