// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/history_report.h"

#include "io/command.h"
#include "text/text.h"

#include <calotte/error.h>
#include <calotte/grid.h>
#include <calotte/read.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace calotte::tools {

namespace {

using nlohmann::json;

/// A part of a report, with its path for messages.
struct Part {
  const json& value;
  std::string file;
  std::string path; ///< such as iterations[3].l2; empty for the whole

  [[noreturn]] void fail(const std::string& what) const {
    fail_file(file, "{} {}; give a report of calotte cvt --report", path, what);
  }
  Part at(const std::string& key) const {
    const bool present = value.is_object() && value.contains(key);
    Part part = {present ? value.at(key) : value, file,
                 path.empty() ? key : message("{}.{}", path, key)};
    if (!present) {
      part.fail("is missing");
    }
    return part;
  }
  /// Finite and >= 0.
  double number() const {
    if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < 0) {
      fail("is not a number >= 0");
    }
    return value.get<double>();
  }
  std::int64_t count(std::int64_t least) const {
    if (!value.is_number_integer() || value.get<std::int64_t>() < least) {
      fail(message("is not an integer >= {}", least));
    }
    return value.get<std::int64_t>();
  }
  bool truth() const {
    if (!value.is_boolean()) {
      fail("is neither true nor false");
    }
    return value.get<bool>();
  }
};

json parse(const std::string& path) {
  const std::string text = read_file(path);
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    fail_at(path, line,
            "this is not JSON, or was cut short; give a report of calotte cvt --report");
  } catch (const json::out_of_range&) {
    fail_file(path, "a number in it is too large for a double; give a report of calotte cvt "
                    "--report");
  }
}

template <class Value> Value value_of(const Part& part, std::span<const NamedValue<Value>> words) {
  std::vector<std::string> known;
  for (const NamedValue<Value>& word : words) {
    known.emplace_back(word.word);
    if (part.value == known.back())
      return word.value;
  }
  part.fail("is not one of " + listed(known));
}

std::vector<std::string> density_of(const Part& part) {
  const auto is_text = [](const json& word) { return word.is_string(); };
  if (!part.value.is_array() || !std::all_of(part.value.begin(), part.value.end(), is_text)) {
    part.fail("is not an array of strings");
  }
  return part.value.get<std::vector<std::string>>();
}

/// Reports of versions that had only Lloyd's method do not name it.
std::string method_of(const Part& report) {
  if (!report.value.contains("method")) {
    return "";
  }
  const Part method = report.at("method");
  value_of(method, method_words());
  return method.value.get<std::string>();
}

CvtIteration iteration_of(const Part& part) {
  CvtIteration iteration;
  iteration.cells = part.at("cells").count(1);
  iteration.spacing = part.value.contains("spacing") // older reports are for the sphere
                          ? part.at("spacing").number()
                          : std::sqrt(4 * std::numbers::pi / static_cast<double>(iteration.cells));
  // Older reports have the rule -1 for a density that is linear between the generators.
  const auto rule = static_cast<int>(std::min<std::int64_t>(part.at("rule").count(-1), 1000));
  iteration.linear_density =
      rule < 0 || (part.value.contains("linear_density") && part.at("linear_density").truth());
  iteration.rule = std::max(rule, 0);
  iteration.l2 = part.at("l2").number();
  iteration.linf = part.at("linf").number();
  iteration.energy = part.at("energy").number();
  iteration.flips = part.at("flips").count(0);
  iteration.rebuilt = part.at("rebuilt").truth();
  iteration.seconds = part.at("seconds").number();
  // Reports of versions with only Lloyd's method have neither key.
  iteration.accepted = !part.value.contains("accepted") || part.at("accepted").truth();
  if (part.value.contains("seconds_solver")) {
    iteration.seconds_solver = part.at("seconds_solver").number();
  }
  return iteration;
}

StateFile state_of(const Part& part) {
  const Part file = part.at("file");
  if (!file.value.is_string() || file.value.get<std::string>().find('/') != std::string::npos) {
    file.fail("is not the name of a file");
  }
  return {part.at("evaluation").count(1), file.value.get<std::string>()};
}

/// The items of an array, each with its path.
std::vector<Part> items_of(const Part& array) {
  if (!array.value.is_array()) {
    array.fail("is not an array");
  }
  std::vector<Part> items;
  for (std::size_t i = 0; i < array.value.size(); ++i) {
    items.push_back({array.value[i], array.file, message("{}[{}]", array.path, i)});
  }
  return items;
}

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

std::vector<double> scaled(const History& history, double CvtIteration::*norm) {
  std::vector<double> values;
  values.reserve(history.iterations.size());
  for (const CvtIteration& iteration : history.iterations) {
    values.push_back(iteration.accepted ? iteration.*norm / iteration.spacing : nowhere);
  }
  return values;
}

/// The evaluations of a level that were accepted.
std::vector<std::size_t> accepted_between(const History& history, std::size_t first,
                                          std::size_t last) {
  std::vector<std::size_t> accepted;
  for (std::size_t i = first; i < last; ++i) {
    if (history.iterations[i].accepted) {
      accepted.push_back(i);
    }
  }
  return accepted;
}

/// Whether energies compare.
bool same_functional(const CvtIteration& a, const CvtIteration& b) {
  return a.rule == b.rule && a.linear_density == b.linear_density;
}

/// The decrease of the energy from the k-th to the next of the evaluations `way` of a level.
double descent(const History& history, const std::vector<std::size_t>& way, std::size_t k) {
  const auto at = [&](std::size_t j) -> const CvtIteration& { return history.iterations[way[j]]; };
  if (same_functional(at(k), at(k + 1))) {
    return at(k).energy - at(k + 1).energy;
  }
  // Energies of different rules do not compare.
  return k > 0 && same_functional(at(k - 1), at(k)) ? at(k - 1).energy - at(k).energy : 0;
}

/// Levels of runs have the same key if their energies compare.
using Comparable = std::tuple<std::vector<std::string>, std::int64_t, int, bool>;

Comparable comparable(const History& history, std::size_t last) {
  const CvtIteration& end = history.iterations[last];
  return {history.density, end.cells, end.rule, end.linear_density};
}

/// Calls the function for each level of a run with its accepted evaluations, if there are any.
template <class Visit> void each_level(const History& history, const Visit& visit) {
  const std::vector<std::size_t> starts = level_starts(history);
  for (std::size_t level = 0; level + 1 < starts.size(); ++level) {
    const std::vector<std::size_t> way =
        accepted_between(history, starts[level], starts[level + 1]);
    if (!way.empty()) {
      visit(way);
    }
  }
}

std::map<Comparable, double> least_energies(const std::vector<History>& histories) {
  std::map<Comparable, double> least;
  for (const History& history : histories) {
    each_level(history, [&](const std::vector<std::size_t>& way) {
      const double end = history.iterations[way.back()].energy;
      const auto [position, first] = least.try_emplace(comparable(history, way.back()), end);
      position->second = std::min(position->second, end);
    });
  }
  return least;
}

} // namespace

History read_history(const std::string& path) {
  const json document = parse(path);
  const Part report = {document, path, ""};
  History history;
  history.name = path;
  history.density = density_of(report.at("density"));
  history.method = method_of(report);
  history.norm = value_of(report.at("norm"), norm_words());
  history.tolerance = report.at("tolerance").number();
  history.converged = report.at("converged").truth();
  history.seconds = report.at("seconds").number();
  const Part iterations = report.at("iterations");
  for (const Part& iteration : items_of(iterations)) {
    history.iterations.push_back(iteration_of(iteration));
  }
  if (history.iterations.empty()) {
    iterations.fail("is empty: the run made no iteration");
  }
  if (document.contains("states")) {
    for (const Part& state : items_of(report.at("states"))) {
      history.states.push_back(state_of(state));
    }
  }
  return history;
}

std::vector<double> evaluation_numbers(const History& history) {
  std::vector<double> numbers(history.iterations.size());
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

std::vector<double> elapsed_seconds(const History& history) {
  std::vector<double> elapsed;
  elapsed.reserve(history.iterations.size());
  double sum = 0;
  for (const CvtIteration& iteration : history.iterations) {
    sum += iteration.seconds + iteration.seconds_solver;
    elapsed.push_back(sum);
  }
  return elapsed;
}

std::vector<double> scaled_l2(const History& history) { return scaled(history, &CvtIteration::l2); }

std::vector<double> scaled_linf(const History& history) {
  return scaled(history, &CvtIteration::linf);
}

std::vector<double> scaled_tolerance(const History& history) {
  std::vector<double> values;
  values.reserve(history.iterations.size());
  for (const CvtIteration& iteration : history.iterations) {
    switch (history.norm) {
    case Norm::l2:
    case Norm::linf:
      values.push_back(history.tolerance / iteration.spacing);
      break;
    case Norm::l2_scaled:
    case Norm::linf_scaled:
      values.push_back(history.tolerance);
      break;
    default:
      values.push_back(nowhere);
    }
  }
  return values;
}

std::vector<std::size_t> level_starts(const History& history) {
  std::vector<std::size_t> starts = {0};
  for (std::size_t i = 1; i < history.iterations.size(); ++i) {
    if (history.iterations[i].cells != history.iterations[i - 1].cells) {
      starts.push_back(i);
    }
  }
  starts.push_back(history.iterations.size());
  return starts;
}

std::vector<std::vector<double>> energy_excess(const std::vector<History>& histories) {
  const std::map<Comparable, double> least = least_energies(histories);
  std::vector<std::vector<double>> excesses;
  for (const History& history : histories) {
    std::vector<double>& excess = excesses.emplace_back(history.iterations.size(), nowhere);
    each_level(history, [&](const std::vector<std::size_t>& way) {
      const double end = history.iterations[way.back()].energy;
      const double reference = least.at(comparable(history, way.back()));
      excess[way.back()] = (end - reference) / reference;
      for (std::size_t k = way.size() - 1; k-- > 0;) {
        excess[way[k]] = excess[way[k + 1]] + descent(history, way, k) / reference;
      }
    });
  }
  return excesses;
}

} // namespace calotte::tools
