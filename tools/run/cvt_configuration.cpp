// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_configuration.h"

#include "text/text.h"

#include <calotte/version.h>

#include <sstream>

namespace calotte::tools {
namespace {

std::string start_of(const CvtRequest& request, const CvtInput& input, const Schedule& schedule) {
  const Recipe& recipe = schedule.recipe;
  const CvtStart::Kind kind = recipe.start.kind;
  std::string text = message("start {}\n{}", word_of(kind), input.points);
  if (kind != CvtStart::Kind::points)
    text += message("cells {}\n", recipe.cells);
  if (is_drawn(kind))
    text += message("seed {}\n", recipe.seed);
  text += input.fixed;
  if (schedule.on_boundary > 0)
    text += "boundary generators\n";
  if (kind == CvtStart::Kind::multilevel)
    text += message("insertion-rounds {}\n", *recipe.start.insertion_rounds);
  else if (kind != CvtStart::Kind::continuation) // whose bisections follow from cells and density
    text += message("bisections {}\n", recipe.start.bisections.value_or(0));
  if (planar(request))
    text += domain_configuration(*request.domain);
  if (!request.part.region.empty())
    text += region_configuration(recipe.surface);
  return text;
}

std::string stopping_rule(const CvtRequest& request, const CvtStop& stop) {
  if (stop.iterations)
    return message("iterations {}\n", *stop.iterations);
  const auto given = [](const std::string& name, const std::optional<double>& value) {
    return value ? message("\n{} {}", name, shortest(*value)) : "";
  };
  return message("norm {}{}{}\ntolerance {}\nmax-iterations {}\n", request.norm,
                 given("least-spacing", request.least_spacing),
                 given("most-off-midpoint", request.most_off_midpoint), shortest(*stop.tolerance),
                 stop.max_iterations);
}

} // namespace

std::string configuration_of(const CvtRequest& request, const CvtInput& input,
                             const Schedule& schedule) {
  std::string text = "calotte " CALOTTE_VERSION "\n" + start_of(request, input, schedule);
  const auto add = [&](const std::string& name, const std::string& value) {
    text += message("{} {}\n", name, value);
  };
  text += density_configuration(*request.density);
  add("method", request.method);
  if (const CvtStop& stop = schedule.recipe.stop; !stop.iterations)
    add("stop", *stop.well_centred ? "well-centred" : "tolerance");
  add("duplicates", request.delaunay->duplicates);
  add("merge-within", shortest(request.delaunay->merge_within));
  return text;
}

std::string history_of(const CvtRequest& request, const CvtStop& stop,
                       const std::string& configuration, const CvtReport& report) {
  std::istringstream lines(configuration + stopping_rule(request, stop));
  std::string history, fact;
  std::getline(lines, history); // "calotte VERSION"
  history += " cvt";
  for (const char* separator = ": "; std::getline(lines, fact); separator = "; ")
    history += separator + fact;
  if (!report.converged)
    history += message("; not converged, {} {}", request.norm, formatted("%.3g", report.residual));
  return history;
}

} // namespace calotte::tools
