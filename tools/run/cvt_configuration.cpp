// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_configuration.h"

#include "options/numbers.h"

#include <calotte/version.h>

#include <sstream>

namespace calotte::tools {
namespace {

std::string stopping_rule(const CvtRequest& request) {
  if (request.iterations)
    return "iterations " + std::to_string(*request.iterations) + "\n";
  const std::string spacing =
      request.least_spacing ? "\nleast-spacing " + shortest(*request.least_spacing) : "";
  return "norm " + request.norm + "\nstop " +
         (well_centred(request) ? "well-centred" : "tolerance") + spacing + "\ntolerance " +
         shortest(tolerance_of(request)) + "\nmax-iterations " +
         std::to_string(request.max_iterations) + "\n";
}

} // namespace

std::string configuration_of(const CvtRequest& request, const CvtOptions& options,
                             const CvtStart& start) {
  std::string text = "calotte " CALOTTE_VERSION "\n" + start.configuration;
  const auto add = [&](const std::string& name, const std::string& value) {
    text += name + " " + value + "\n";
  };
  text += density_configuration(*request.density);
  add("method", request.method);
  if (options.method == Method::lloyd)
    add("relaxation", shortest(request.relaxation));
  if (!options.density.uniform()) {
    add("rule", std::to_string(request.rule));
    add("final-rule", std::to_string(request.final_rule));
    add("triangle-divisions", std::to_string(request.triangle_divisions));
  }
  add("duplicates", request.partition->duplicates);
  add("merge-within", shortest(request.partition->merge_within));
  return text;
}

std::string history_of(const CvtRequest& request, const std::string& configuration,
                       const CvtReport& report) {
  std::istringstream lines(configuration + stopping_rule(request));
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
