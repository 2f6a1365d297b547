// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_forecast.h"

#include "text/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace calotte::tools {
namespace {

constexpr std::size_t fewest = 10, most = 500;

/// The last iterations of the current level; empty if there are too few.
std::span<const CvtIteration> recent(const CvtProgress& progress) {
  const std::span all(progress.report.iterations);
  const auto level = std::min(all.size(), static_cast<std::size_t>(progress.iterations_of_descent));
  return level < fewest ? all.last(0) : all.last(std::clamp(level / 2, fewest, most));
}

/// The least-squares line through the logarithms of the norm: its slope per iteration and its value
/// at the last one.
struct Decay {
  double slope, last;
};

/// Calls visit(k, norm's logarithm) for the accepted iterations k.
template <class Visit>
void visit_norms(std::span<const CvtIteration> iterations, Norm norm, const Visit& visit) {
  for (std::size_t k = 0; k < iterations.size(); ++k)
    if (iterations[k].accepted)
      visit(static_cast<double>(k), std::log(norm_of(iterations[k], norm)));
}

Decay fit(std::span<const CvtIteration> iterations, Norm norm) {
  double count = 0, mean_x = 0, mean_y = 0, slope = 0, spread = 0;
  visit_norms(iterations, norm, [&](double x, double y) {
    ++count;
    mean_x += x;
    mean_y += y;
  });
  mean_x /= count;
  mean_y /= count;
  visit_norms(iterations, norm, [&](double x, double y) {
    slope += (x - mean_x) * (y - mean_y);
    spread += (x - mean_x) * (x - mean_x);
  });
  slope /= spread;
  return {slope, mean_y + slope * (static_cast<double>(iterations.size()) - 1 - mean_x)};
}

double mean_seconds(std::span<const CvtIteration> iterations) {
  double seconds = 0;
  for (const CvtIteration& iteration : iterations)
    seconds +=
        (iteration.seconds + iteration.seconds_solver) / static_cast<double>(iterations.size());
  return seconds;
}

} // namespace

std::optional<Forecast> forecast(const CvtProgress& progress, const CvtAction& action) {
  const std::span<const CvtIteration> iterations = recent(progress);
  if (iterations.empty())
    return std::nullopt;
  const double seconds = mean_seconds(iterations);
  // The trials of the last step may exceed the limit.
  const double to_limit = std::max(action.max_iterations - progress.iterations_of_descent, 0);
  if (action.norm == Norm::none)
    return Forecast{seconds * to_limit, false};
  const Decay decay = fit(iterations, action.norm);
  if (!(decay.slope < 0))
    return Forecast{seconds * to_limit, false};
  const double to_tolerance =
      std::ceil(std::max((std::log(action.tolerance) - decay.last) / decay.slope, 0.0));
  return Forecast{seconds * std::min(to_tolerance, to_limit), to_tolerance <= to_limit};
}

namespace {

/// The wall-clock time of the run over that of its evaluations, >= 1: between them it triangulates,
/// bisects, and waits for processors that others use.
double pace(const CvtProgress& progress) {
  double seconds = 0;
  for (const CvtIteration& iteration : progress.report.iterations)
    seconds += iteration.seconds + iteration.seconds_solver;
  return seconds > 0 ? std::max(1.0, progress.report.seconds / seconds) : 1;
}

/// Seconds spent on the current level, all of its descents.
double spent_on_level(const CvtProgress& progress) {
  const std::vector<CvtIteration>& all = progress.report.iterations;
  const auto cells = static_cast<double>(all.back().cells);
  double seconds = 0;
  for (auto i = all.rbegin(); i != all.rend(); ++i) {
    if (std::abs(static_cast<double>(i->cells) / cells - 1) > 0.5)
      break;
    seconds += i->seconds + i->seconds_solver;
  }
  return seconds;
}

/// The action whose descent runs.
const CvtAction& action_of(const CvtProgress& progress, const Schedule& schedule) {
  const std::size_t begun = std::max<std::size_t>(progress.report.done.size(), 1);
  return schedule.actions[std::min(begun, schedule.actions.size()) - 1];
}

/// The descents of each level, from the coarsest.
std::vector<int> descents_of(const Schedule& schedule) {
  std::vector<int> descents;
  for (const CvtAction& action : schedule.actions)
    if (action.kind == CvtAction::Kind::start || action.kind == CvtAction::Kind::bisect)
      descents.push_back(1);
    else if (action.kind == CvtAction::Kind::insert)
      descents.back() += action.times;
  return descents;
}

/// The usual seconds of the rest of a last descent to 1e-4, whose norm falls at its end: these took
/// 19 to 24 iterations in graded runs with 16 000 to 600 000 cells. Infinite for others.
double usual_rest(const CvtProgress& progress, const Schedule& schedule) {
  constexpr double usual = 25, least = 5, tolerance = 1e-4;
  const CvtAction& action = action_of(progress, schedule);
  const int done = progress.iterations_of_descent;
  if (action.kind != CvtAction::Kind::converge || action.tolerance < tolerance ||
      schedule.recipe.method != Method::automatic || done > 2 * usual)
    return std::numeric_limits<double>::infinity();
  return std::max(usual - done, least) * mean_seconds(recent(progress));
}

} // namespace

std::optional<Remaining> remaining(const CvtProgress& progress, const Schedule& schedule) {
  auto descent = forecast(progress, action_of(progress, schedule));
  if (!descent)
    return std::nullopt;
  descent->seconds = std::min(descent->seconds, usual_rest(progress, schedule));
  const double scale = pace(progress);
  const std::vector<int> descents = descents_of(schedule);
  if (progress.bisections_left == 0 && progress.rounds_left == 0 && descents.back() == 1)
    return Remaining{0.7 * scale * descent->seconds, 1.4 * scale * descent->seconds};
  double later = (1 + progress.rounds_left) * descent->seconds;
  double level = spent_on_level(progress) + later;
  // Four times for four times as many cells, less for fewer rounds of insertion.
  for (auto k = std::ssize(descents) - progress.bisections_left; k < std::ssize(descents); ++k)
    later += level *=
        4.0 * descents[static_cast<std::size_t>(k)] / descents[static_cast<std::size_t>(k - 1)];
  if (*schedule.recipe.stop.well_centred)
    later += 0.2 * level;
  return Remaining{0.5 * scale * later, 2 * scale * later};
}

std::string describe(const CvtProgress& progress, const Schedule& schedule) {
  const CvtStop& stop = schedule.recipe.stop;
  const CvtIteration& last = progress.report.iterations.back();
  std::string text = message("{} cells, iteration {}", last.cells, progress.iterations_of_descent);
  const bool polishes = last.shape_excess > 0;
  if (polishes)
    text += formatted(", shapes %.2g beyond their limits", last.shape_excess);
  else if (!stop.iterations)
    text +=
        message(", {} {} of {}", word_of(stop.norm), formatted("%.2e", progress.report.residual),
                formatted("%.0e", *stop.tolerance));
  text += formatted(", energy x cells %.6g", last.energy * static_cast<double>(last.cells));
  if (progress.bisections_left > 0)
    text += message(", then {}", counted(progress.bisections_left, "finer level"));
  if (const auto left = remaining(progress, schedule); left && !polishes) {
    const std::string from = duration(std::round(left->least)),
                      to = duration(std::round(left->most));
    text += message(", {} left", from == to ? from : message("{} to {}", from, to));
  }
  return text;
}

} // namespace calotte::tools
