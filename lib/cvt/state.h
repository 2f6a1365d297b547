// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vector_field.h"
#include "cvt/room.h"

#include <calotte/cvt.h>

#include <cstdint>
#include <vector>

namespace calotte::cvt_detail {

/// The memory of a descent's method.
struct Memory {
  /// The steps of generators and the changes of the gradient along them; the oldest first.
  std::vector<base_detail::CompactField> steps, changes;
  std::vector<double> curvatures; ///< their inner products
  double stride = 1;       ///< first trial of the next line search, as a share of the full step
  Points3 laplacian_at;    ///< generators that the graph Laplacian was made for
  int since_laplacian = 0; ///< evaluations
  bool flipped = false;    ///< edges, since then
  int iterations = 0;      ///< evaluations of the descent
  int since_restart = 0;   ///< evaluations since its points were changed
  bool final_rule = false; ///< it has taken over
  bool stuck = false;      ///< no step lowers the value, as far as the method can tell
};

/// The position of a run in its actions.
struct Cursor {
  std::int32_t action = 0; ///< in CvtReport::actions
  int times = 0;  ///< what counts of CvtAction::times: a round after a long descent counts for two
  int idle = 0;   ///< rounds that brought the number of generators no nearer to the level's end
  int glides = 0; ///< number of glides
};

/// The penalty that a polish minimises besides the energy.
struct Polish {
  double penalty = 0;          ///< of shapes; 0 before a polish
  double demanded_spacing = 1; ///< of neighbours at rho = 1
  bool descended = true;       ///< the descent before it converged
};

/// The contents of a CvtState.
struct State {
  static State& of(CvtState& state) { return *state.state_; }
  static const State& of(const CvtState& state) { return *state.state_; }
  static CvtState wrapped(State&& state);

  Points3 points; ///< unit generators, along a space-filling curve; in the plane with z = 0
  std::vector<std::int32_t> id;            ///< of each: its column in the result
  std::vector<std::int32_t> site_of_input; ///< as Mesh's; of the start, or empty after a bisection
  std::int64_t fixed = 0;                  ///< generators with lower ids stay where they are
  /// Of these, the ids of those that follow lines: from `first` on and below `end`; those below
  /// `inner` are at ends and confluences. Where a polish does not suffice, they move. The schedule
  /// says which; checkpoints do not.
  struct {
    std::int64_t first = 0, inner = 0, end = 0;
    bool contain(std::int32_t generator) const { return generator >= first && generator < end; }
  } on_lines;
  Cursor cursor;
  Polish polish;
  Memory memory;
  CvtReport report;

  /// \pre the report has the actions.
  const CvtAction& action() const {
    return report.actions[static_cast<std::size_t>(cursor.action)];
  }
  bool in_polish() const { return polish.penalty > 0; }
  bool has_lines() const { return on_lines.first < on_lines.end; }
  std::int64_t on_boundary() const { return fixed - on_lines.end; } ///< generators that slide
  bool slides() const { return on_boundary() > 0; }
};

/// By generator, whether it is pinned, see shape.h; empty if none is.
std::vector<std::uint8_t> fixed_generators(const State& state);

/// By generator of a state the next one along the boundary, or none.
/// \param next Schedule::next_on_boundary.
std::vector<std::int32_t> boundary_order(const State& state, const std::vector<std::int32_t>& next);

/// The generators in the order of the result.
Points3 in_order(const State& state);

} // namespace calotte::cvt_detail
