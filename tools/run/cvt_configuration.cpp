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
  std::string text = "start " + std::string(word_of(kind)) + "\n" + input.points;
  if (kind != CvtStart::Kind::points)
    text += "cells " + std::to_string(recipe.cells) + "\n";
  if (is_drawn(kind))
    text += "seed " + std::to_string(recipe.seed) + "\n";
  text += input.fixed;
  if (schedule.on_boundary > 0)
    text += "boundary generators\n";
  if (kind == CvtStart::Kind::multilevel)
    text += "insertion-rounds " + std::to_string(*recipe.start.insertion_rounds) + "\n";
  else if (kind != CvtStart::Kind::continuation) // whose bisections follow from cells and density
    text += "bisections " + std::to_string(recipe.start.bisections.value_or(0)) + "\n";
  if (planar(request))
    text += domain_configuration(*request.domain);
  if (!request.part.region.empty())
    text += region_configuration(recipe.surface);
  return text;
}

std::string stopping_rule(const CvtRequest& request, const CvtStop& stop) {
  if (stop.iterations)
    return "iterations " + std::to_string(*stop.iterations) + "\n";
  const std::string spacing =
      request.least_spacing ? "\nleast-spacing " + shortest(*request.least_spacing) : "";
  return "norm " + request.norm + spacing + "\ntolerance " + shortest(*stop.tolerance) +
         "\nmax-iterations " + std::to_string(stop.max_iterations) + "\n";
}

} // namespace

std::string configuration_of(const CvtRequest& request, const CvtInput& input,
                             const Schedule& schedule) {
  std::string text = "calotte " CALOTTE_VERSION "\n" + start_of(request, input, schedule);
  const auto add = [&](const std::string& name, const std::string& value) {
    text += name + " " + value + "\n";
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
    history += "; not converged, " + request.norm + " " + formatted("%.3g", report.residual);
  return history;
}

} // namespace calotte::tools
