// SPDX-License-Identifier: GPL-3.0-or-later
#include "grids/schedule.h"

#include "cvt/course.h"
#include "cvt/levels.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace calotte::grids_detail {
namespace {

using Kind = CvtAction::Kind;
namespace course = cvt_detail::course;

/// The number of rounds of a level. \param rounds of the last level.
int rounds_of_level(int rounds, int bisections_left) {
  return std::min(rounds * (bisections_left + 1), std::max(rounds, course::most_rounds));
}

/// The end of all descents but the last of a run with insertion.
CvtAction early(CvtAction end) {
  end.tolerance = end.norm == Norm::l2_scaled ? std::max(course::early_tolerance, end.tolerance)
                                              : course::early_tolerance;
  end.norm = Norm::l2_scaled;
  end.max_iterations = std::min(end.max_iterations, course::early_iterations);
  return end;
}

} // namespace

std::vector<CvtAction> actions_of(const Recipe& recipe, const FirstLevel& first,
                                  std::int64_t on_lines, std::int64_t on_boundary) {
  const CvtStop& stop = recipe.stop;
  const int rounds = recipe.start.insertion_rounds.value_or(0);
  CvtAction end;
  if (stop.iterations)
    end = {.norm = Norm::none, .max_iterations = *stop.iterations};
  else
    end = {.norm = stop.norm, .tolerance = *stop.tolerance, .max_iterations = stop.max_iterations};
  const CvtAction before = rounds > 0 && !stop.iterations ? early(end) : end;
  std::vector<CvtAction> actions;
  const auto add = [&](Kind kind, CvtAction action, std::int64_t cells, int times = 1) {
    action.kind = kind;
    action.cells = cells;
    action.times = times;
    actions.push_back(action);
  };
  std::int64_t cells = first.cells;
  for (int left = first.bisections; left >= 0; --left) {
    if (rounds > 0)
      cells = cvt_detail::generators_of_level(recipe.surface, recipe.cells, left, on_boundary);
    else if (left < first.bisections)
      cells = cvt_detail::bisected(recipe.surface, cells);
    add(left == first.bisections ? Kind::start : Kind::bisect, before, cells);
    if (rounds > 0)
      add(Kind::insert, before, cells, rounds_of_level(rounds, left));
  }
  if (rounds > 0)
    add(Kind::converge, end, cells);
  if (*stop.well_centred && end.max_iterations > 0) { // which begins where a descent ended
    const CvtAction polish{.norm = end.norm, .max_iterations = course::polish_iterations};
    add(Kind::polish, polish, cells);
    add(Kind::raise, polish, cells,
        on_lines > 0 ? course::most_raised_beside_lines : course::most_raised);
  }
  return actions;
}

} // namespace calotte::grids_detail
