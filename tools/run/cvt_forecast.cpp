// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_forecast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

namespace calotte::tools {
namespace {

constexpr std::size_t fewest = 10, most = 500;

/// The last iterations of the current level; empty if there are too few.
std::span<const CvtIteration> recent(const CvtProgress& progress) {
  const std::span all(progress.report.iterations);
  const auto level = std::min(all.size(), static_cast<std::size_t>(progress.iterations_of_level));
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

std::string duration(double seconds) {
  constexpr double minute = 60, hour = 3600;
  std::array<char, 32> text{};
  if (seconds < 2 * minute)
    std::snprintf(text.data(), text.size(), "%.0f s", seconds);
  else if (seconds < 2 * hour)
    std::snprintf(text.data(), text.size(), "%.0f min", seconds / minute);
  else
    std::snprintf(text.data(), text.size(), "%.1f h", seconds / hour);
  return text.data();
}

} // namespace

std::optional<Forecast> forecast(const CvtProgress& progress, const CvtOptions& options) {
  const std::span<const CvtIteration> iterations = recent(progress);
  if (iterations.empty())
    return std::nullopt;
  double seconds = 0;
  for (const CvtIteration& iteration : iterations)
    seconds +=
        (iteration.seconds + iteration.seconds_solver) / static_cast<double>(iterations.size());
  // The trials of the last step may exceed the limit.
  const double to_limit = std::max(options.max_iterations - progress.iterations_of_level, 0);
  if (options.norm == Norm::none)
    return Forecast{seconds * to_limit, false};
  const Decay decay = fit(iterations, options.norm);
  if (!(decay.slope < 0))
    return Forecast{seconds * to_limit, false};
  const double to_tolerance =
      std::ceil(std::max((std::log(options.tolerance) - decay.last) / decay.slope, 0.0));
  return Forecast{seconds * std::min(to_tolerance, to_limit), to_tolerance <= to_limit};
}

std::string describe(const CvtProgress& progress, const CvtOptions& options,
                     const std::string& norm) {
  const CvtIteration& last = progress.report.iterations.back();
  std::string text = std::to_string(last.cells) + " cells, iteration " +
                     std::to_string(progress.iterations_of_level);
  std::array<char, 64> number{};
  if (options.norm != Norm::none && last.misshapen == 0) {
    std::snprintf(number.data(), number.size(), " %.2e of %.0e", progress.report.residual,
                  options.tolerance);
    text += ", " + norm + number.data();
  }
  const bool inserts =
                 options.insertion_rounds > 0, // whose descents end at tolerances of their own
      finishes = last.misshapen > 0;
  if (finishes) {
    std::snprintf(number.data(), number.size(), ", shapes %.2g beyond their limits",
                  last.misshapen);
    text += number.data();
  }
  if (inserts && progress.rounds_left > 0)
    text += ", then " + std::to_string(progress.rounds_left) +
            (progress.rounds_left == 1 ? " round of insertion" : " rounds of insertion");
  if (const auto end = forecast(progress, options);
      end && !finishes &&
      (!inserts || (progress.rounds_left == 0 && progress.bisections_left == 0)))
    text += (end->converges ? ", about " : ", ") + duration(end->seconds) + " to the " +
            (end->converges ? "tolerance" : "last iteration");
  if (progress.bisections_left > 0)
    text += ", then " + std::to_string(progress.bisections_left) +
            (progress.bisections_left == 1 ? " finer level" : " finer levels");
  return text;
}

} // namespace calotte::tools
