// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_history_report.h"

#include "../lib/io/file.h"

#include <calotte/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace calotte::tools {

namespace {

using nlohmann::json;

/// A part of a report, and its place there for messages.
struct Part {
  const json& value;
  std::string file;
  std::string place; ///< such as iterations[3].l2; empty for the whole

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::parse,
                file + ": " + place + " " + what + "; give a report of calotte cvt --report");
  }
  Part at(const std::string& key) const {
    const bool present = value.is_object() && value.contains(key);
    Part part = {present ? value.at(key) : value, file, place.empty() ? key : place + "." + key};
    if (!present) {
      part.fail("is missing");
    }
    return part;
  }
  /// Finite and >= 0.
  double number() const {
    if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < 0) {
      fail("is not a number 0 or more");
    }
    return value.get<double>();
  }
  std::int64_t count(std::int64_t least) const {
    if (!value.is_number_integer() || value.get<std::int64_t>() < least) {
      fail("is not a whole number " + std::to_string(least) + " or more");
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
  std::ifstream in = detail::open_input(path);
  const std::string text = detail::read_all(in, path);
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw Error(ErrorCode::parse,
                path + " line " + std::to_string(line) +
                    ": this is not JSON, or was cut short; give a report of calotte cvt --report",
                line);
  } catch (const json::out_of_range&) {
    throw Error(ErrorCode::parse, path + ": a number in it is too large for a double; give a "
                                         "report of calotte cvt --report");
  }
}

Norm norm_of(const Part& part) {
  static const std::vector<std::pair<std::string, Norm>> words = {
      {"l2", Norm::l2},
      {"linf", Norm::linf},
      {"l2-scaled", Norm::l2_scaled},
      {"linf-scaled", Norm::linf_scaled},
      {"gradient", Norm::gradient},
      {"none", Norm::none}};
  for (const auto& [word, norm] : words) {
    if (part.value == word) {
      return norm;
    }
  }
  part.fail("is none of l2, linf, l2-scaled, linf-scaled, gradient and none");
}

CvtIteration iteration_of(const Part& part) {
  CvtIteration iteration;
  iteration.cells = part.at("cells").count(1);
  iteration.rule = static_cast<int>(std::min<std::int64_t>(part.at("rule").count(0), 1000));
  iteration.l2 = part.at("l2").number();
  iteration.linf = part.at("linf").number();
  iteration.energy = part.at("energy").number();
  iteration.flips = part.at("flips").count(0);
  iteration.rebuilt = part.at("rebuilt").truth();
  return iteration;
}

double spacing(const CvtIteration& iteration) {
  return std::sqrt(4 * std::numbers::pi / static_cast<double>(iteration.cells));
}

std::vector<double> scaled(const History& history, double CvtIteration::*norm) {
  std::vector<double> values;
  values.reserve(history.iterations.size());
  for (const CvtIteration& iteration : history.iterations) {
    values.push_back(iteration.*norm / spacing(iteration));
  }
  return values;
}

} // namespace

History read_history(const std::string& path) {
  const json document = parse(path);
  const Part report = {document, path, ""};
  History history;
  history.name = path;
  history.norm = norm_of(report.at("norm"));
  history.tolerance = report.at("tolerance").number();
  history.converged = report.at("converged").truth();
  history.seconds = report.at("seconds").number();
  const Part iterations = report.at("iterations");
  if (!iterations.value.is_array()) {
    iterations.fail("is not an array");
  }
  if (iterations.value.empty()) {
    iterations.fail("is empty: the run made no iteration");
  }
  for (std::size_t i = 0; i < iterations.value.size(); ++i) {
    history.iterations.push_back(
        iteration_of({iterations.value[i], path, "iterations[" + std::to_string(i) + "]"}));
  }
  return history;
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
      values.push_back(history.tolerance / spacing(iteration));
      break;
    case Norm::l2_scaled:
    case Norm::linf_scaled:
      values.push_back(history.tolerance);
      break;
    default:
      values.push_back(std::numeric_limits<double>::quiet_NaN());
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

std::vector<double> energy_excess(const History& history) {
  const std::vector<std::size_t> starts = level_starts(history);
  const auto& steps = history.iterations;
  std::vector<double> excess(steps.size());
  for (std::size_t level = 0; level + 1 < starts.size(); ++level) {
    const double end = steps[starts[level + 1] - 1].energy;
    for (std::size_t i = starts[level + 1] - 1; i-- > starts[level];) {
      double descent = steps[i].energy - steps[i + 1].energy;
      if (steps[i].rule != steps[i + 1].rule) { // two rules' energies do not compare
        descent = i > starts[level] && steps[i - 1].rule == steps[i].rule
                      ? steps[i - 1].energy - steps[i].energy
                      : 0;
      }
      excess[i] = excess[i + 1] + descent / end;
    }
  }
  return excess;
}

} // namespace calotte::tools
