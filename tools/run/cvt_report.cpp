// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_report.h"

#include "options/sphere_radius_option.h"
#include "run/cvt_actions.h"
#include "run/memory_use.h"
#include "text/text.h"

#include <calotte/version.h>

#include <nlohmann/json.hpp>

#include <optional>

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

Json to_json(const CoastChanges& coast) {
  return {{"merged_parts", coast.merged_parts}, {"removed_parts", coast.removed_parts},
          {"removed_area", coast.removed_area}, {"removed_islands", coast.removed_islands},
          {"island_area", coast.island_area},   {"removed_corners", coast.removed_corners},
          {"moved_ends", coast.moved_ends},     {"changed_area", coast.changed_area},
          {"hidden_cells", coast.hidden_cells}, {"hidden_cell", coast.hidden_cell},
          {"small_cells", coast.small_cells},   {"small_cell", coast.small_cell}};
}

template <class List> Json array_of(const List& list) {
  Json array = Json::array();
  for (const auto& item : list)
    array.push_back(to_json(item));
  return array;
}

/// The radius of the planet whose grid a file of the run is, if that is known.
std::optional<double> radius_km(const CvtRequest& request, const Schedule& schedule) {
  if (planar(request))
    return std::nullopt;
  if (schedule.widths)
    return schedule.recipe.radius_km;
  const WriteOptions output = write_options(request);
  const double metres =
      output.sphere_radius != 1 ? output.sphere_radius : output.planet_radius.value_or(0);
  return metres > 0 ? std::optional(metres / metres_per_km) : std::nullopt;
}

constexpr const char* within_limits = "all shapes within the limits of models";

} // namespace

std::string to_json(const CvtRequest& request, const Schedule& schedule, const CvtReport& report,
                    std::int64_t cells, double area, int threads,
                    const std::vector<KeptState>& states, const std::optional<ModelGates>& gates,
                    const CoastChanges& coast) {
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
                     {"farthest_in_widths", schedule.from_lines},
                     {"moved", report.moved_on_lines},
                     {"farthest_move_in_widths", report.farthest_move}};
  json["residual"] = report.residual;
  json["cells"] = cells;
  json["area"] = area;
  if (const std::optional<double> radius = radius_km(request, schedule)) {
    json["radius_km"] = *radius;
    json["area_km2"] = area * *radius * *radius;
  }
  json["threads"] = threads;
  json["seconds"] = report.seconds;
  json["memory"] = memory_use();
  json["actions"] = actions_of(report);
  json["iterations"] = array_of(report.iterations);
  json["regions"] = array_of(report.regions);
  if (!states.empty())
    json["states"] = array_of(states);
  if (gates)
    json["demands"] = to_json(*gates);
  if (coast != CoastChanges())
    json["coast"] = to_json(coast);
  return json.dump(1) + "\n";
}

std::string residual_words(const CvtRequest& request, const CvtReport& report) {
  return request.iterations ? ""
                            : message("{} {}", request.norm, formatted("%.3g", report.residual));
}

std::string kind_of_plane(const Eigen::Vector2d& period) {
  const auto side = [](const char* name, double length) {
    return length > 0 ? message("periodic in {}, {}", name, shortest(length))
                      : message("with walls in {}", name);
  };
  return message("{}; {}", side("x", period.x()), side("y", period.y()));
}

std::string describe_cells(const Recipe& asked, const GridFile& file) {
  const std::string cells = spaced(file.cells) + " cells";
  if (asked.limited_area)
    return message("{}, {} in the region and {} in the rings around it", cells, spaced(file.inside),
                   spaced(file.cells - file.inside));
  if (asked.walls.x || asked.walls.y)
    return message("{}, {}", cells, kind_of_plane(file.period));
  return cells;
}

std::string describe_coast_changes(const CoastChanges& coast, double square_km) {
  std::vector<std::string> words;
  const auto area = [&](double steradians) {
    return formatted("%.3g km^2", square_km * steradians);
  };
  if (coast.merged_parts > 0)
    words.push_back(
        message("{} of cells joined the cell beside", counted(coast.merged_parts, "part")));
  if (coast.removed_parts > 0)
    words.push_back(message("{} of cells with {} became land", counted(coast.removed_parts, "part"),
                            area(coast.removed_area)));
  if (coast.removed_islands > 0)
    words.push_back(message("{} with {} became sea", counted(coast.removed_islands, "island"),
                            area(coast.island_area)));
  if (words.empty())
    return "";
  return message("at the coast, where land or sea is narrower than a cell, {}",
                 listed(words, " and "));
}

std::string describe_coast_faults(const CoastChanges& coast) {
  std::vector<std::string> faults;
  if (coast.hidden_cells > 0)
    faults.push_back(
        message("{} behind a bend of the coast, with parts of negative area, the first "
                "of which is {} of the file (0-based)",
                counted(coast.hidden_cells, "cell"), coast.hidden_cell));
  if (coast.small_cells > 0)
    faults.push_back(message("{} with less than a third of the area of those beside, the first of "
                             "which is {}",
                             counted(coast.small_cells, "cell"), coast.small_cell));
  return faults.empty() ? ""
                        : message("the coast leaves {}; the mesh is written; make the region by "
                                  "calotte coast, or give more cells",
                                  listed(faults, " and "));
}

std::string verdict(const CvtStop& stop, const CvtReport& report, const BadShapes& shapes) {
  if (!report.converged)
    return "not converged";
  if (*stop.well_centred)
    return report.well_centred ? within_limits : "not well-centred";
  std::vector<std::string> faults;
  if (shapes.obtuse > 0)
    faults.push_back(counted(shapes.obtuse, "obtuse triangle"));
  if (shapes.short_edges > 0)
    faults.push_back(message("{} below {} times the Delaunay edge",
                             counted(shapes.short_edges, "Voronoi edge"), short_voronoi_edge));
  if (faults.empty())
    return within_limits;
  return message("{}, to which models object; {}", listed(faults, " and ", " and "),
                 stop.iterations ? "leave --iterations out" : "give --stop well-centred");
}

} // namespace calotte::tools
