// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_report.h"

#include "run/cvt_actions.h"
#include "run/memory_use.h"
#include "text/text.h"

#include <calotte/version.h>

#include <nlohmann/json.hpp>

namespace calotte::tools {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const CvtIteration& iteration) {
  return {{"cells", iteration.cells},
          {"spacing", iteration.spacing},
          {"rule", iteration.rule},
          {"linear_density", iteration.linear_density},
          {"l2", iteration.l2},
          {"linf", iteration.linf},
          {"gradient", iteration.gradient},
          {"energy", iteration.energy},
          {"shape_excess", iteration.shape_excess},
          {"off_centroid", iteration.off_centroid},
          {"largest_offset", iteration.largest_offset},
          {"accepted", iteration.accepted},
          {"flips", iteration.flips},
          {"rebuilt", iteration.rebuilt},
          {"seconds", iteration.seconds},
          {"seconds_exchange", iteration.seconds_exchange},
          {"seconds_repair", iteration.seconds_repair},
          {"seconds_moments", iteration.seconds_moments},
          {"seconds_solver", iteration.seconds_solver}};
}

/// The actions, with what was done of each.
Json actions_of(const CvtReport& report) {
  Json array = Json::array();
  for (std::size_t k = 0; k < report.actions.size(); ++k) {
    const CvtDone done = k < report.done.size() ? report.done[k] : CvtDone{};
    Json& action = array.emplace_back(tools::to_json(report.actions[k]));
    action["done"] = {
        {"times", done.times}, {"iterations", done.iterations}, {"cells", done.cells}};
  }
  return array;
}

Json to_json(const CvtRegion& region) {
  return {{"sites", region.sites}, {"seconds", region.seconds}};
}

Json to_json(const KeptState& state) {
  return {{"evaluation", state.evaluation}, {"file", state.file}};
}

template <class List> Json array_of(const List& list) {
  Json array = Json::array();
  for (const auto& item : list)
    array.push_back(to_json(item));
  return array;
}

} // namespace

std::string to_json(const CvtRequest& request, const Schedule& schedule, const CvtReport& report,
                    std::int64_t cells, double area, int threads,
                    const std::vector<KeptState>& states) {
  const CvtStop& stop = schedule.recipe.stop;
  Json json;
  json["calotte"] = CALOTTE_VERSION;
  json["density"] = density_names(*request.density);
  json["method"] = request.method;
  json["norm"] = stop.iterations ? "none" : request.norm;
  json["stop"] = *stop.well_centred ? "well-centred" : "tolerance";
  json["tolerance"] = *stop.tolerance;
  json["converged"] = report.converged;
  json["well_centred"] = report.well_centred;
  if (report.worst_cell >= 0) {
    json["cells_beyond_limits"] = report.cells_beyond_limits;
    json["worst_cell"] = report.worst_cell;
  }
  if (schedule.on_lines > 0)
    json["lines"] = {{"generators", schedule.on_lines},
                     {"farthest_in_widths", schedule.from_lines}};
  json["residual"] = report.residual;
  json["cells"] = cells;
  json["area"] = area;
  json["threads"] = threads;
  json["seconds"] = report.seconds;
  json["memory"] = memory_use();
  json["actions"] = actions_of(report);
  json["iterations"] = array_of(report.iterations);
  json["regions"] = array_of(report.regions);
  if (!states.empty())
    json["states"] = array_of(states);
  return json.dump(1) + "\n";
}

std::string residual_words(const CvtRequest& request, const CvtReport& report) {
  return request.iterations ? ""
                            : message("{} {}", request.norm, formatted("%.3g", report.residual));
}

std::string summary(const CvtRequest& request, const CvtStop& stop, const CvtReport& report,
                    std::int64_t cells, double area, std::int64_t before) {
  const char* const end = request.iterations    ? ""
                          : !report.converged   ? "not converged, "
                          : report.well_centred ? "well-centred, "
                          : *stop.well_centred  ? "not well-centred, "
                                                : "converged, ";
  std::string line = message("{}: {} cells, {}{}", request.mesh, cells, end,
                             counted(std::ssize(report.iterations), "iteration"));
  if (before > 0)
    line += message(" ({} before it was resumed)", before);
  if (const std::string residual = residual_words(request, report); !residual.empty())
    line += ", " + residual;
  if (!report.iterations.empty()) {
    const CvtIteration& last = report.iterations.back();
    line +=
        message(", energy x cells {}{}", planar(request) ? "/ area^2 " : "",
                formatted("%.7g", last.energy * static_cast<double>(last.cells) / (area * area)));
    if (last.off_centroid > 0)
      line +=
          message(", {} generators more than 0.01 of the spacing from their centroids (at most {})",
                  last.off_centroid, formatted("%.2g", last.largest_offset));
  }
  return line + formatted(", %.2f s", report.seconds);
}

} // namespace calotte::tools
