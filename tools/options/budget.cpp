// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/budget.h"

#include "io/command.h"
#include "text/text.h"

#include <calotte/write.h>

#include <cmath>
#include <map>
#include <string_view>

namespace calotte::tools {
namespace {

[[noreturn]] void refuse_budget(const std::string& words, const std::string& why) {
  refuse(message("--budget {}: {}; give memory such as 24GiB, a number such as 500000-cells, or a "
                 "step such as step=10s",
                 words, why));
}

/// The number of a measure in a unit. \throws Error invalid_argument.
double value_of(const std::string& words, const std::string& text,
                const std::map<std::string, double>& units) {
  const Measure measure = measure_of(text).value_or(Measure{});
  const auto unit = units.find(measure.unit);
  if (!(measure.value > 0 && std::isfinite(measure.value)))
    refuse_budget(words, "that is no positive number");
  if (unit == units.end())
    refuse_budget(words, measure.unit.empty() ? "it has no unit"
                                              : message("\"{}\" is no unit here", measure.unit));
  return measure.value * unit->second;
}

} // namespace

double longest_step(double width, double least_spacing) {
  constexpr double metres_per_km = 1000;
  return longest_step(find_model("mpas-atmosphere")->demands,
                      width * metres_per_km * least_spacing);
}

double width_of_step(double seconds, double least_spacing) {
  return seconds / longest_step(1, least_spacing);
}

Budget budget_of(const std::string& words, const ModelMemory& memory) {
  constexpr std::string_view step = "step=", cells = "-cells";
  Budget budget;
  if (words.starts_with(step)) {
    budget.step = seconds_in(words.substr(step.size()));
    return budget;
  }
  double number = 0;
  if (words.ends_with(cells)) {
    number = value_of(words, words.substr(0, words.size() - cells.size()), {{"", 1}});
  } else {
    budget.bytes = value_of(words, words,
                            {{"MB", 1e6},
                             {"GB", 1e9},
                             {"TB", 1e12},
                             {"MiB", 0x1p20},
                             {"GiB", 0x1p30},
                             {"TiB", 0x1p40}});
    number = *budget.bytes / memory.of(1);
  }
  if (!(number >= fewest_cells && number <= most_cells))
    refuse_budget(words, message("{} cells are out of range, {} to {}", formatted("%.0f", number),
                                 fewest_cells, most_cells));
  budget.cells = static_cast<std::int64_t>(number);
  return budget;
}

} // namespace calotte::tools
