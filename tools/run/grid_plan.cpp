// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/grid_plan.h"

#include "options/cell_width_option.h"
#include "options/numbers.h"
#include "run/cvt_actions.h"
#include "text/text.h"

#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>

namespace calotte::tools {
namespace {

/// Widths: on the whole sphere all quantities follow from their nodes.
SpacingSurvey survey(const Schedule& schedule, std::int64_t cells, double factor,
                     const WidthWords& words, std::optional<double> limit) {
  const Recipe& made = schedule.recipe;
  if (!schedule.widths)
    return survey_spacing(schedule.density, cells, made.surface);
  const WidthField& widths = *schedule.widths;
  const double scale = factor / (made.surface.is_sphere() ? made.radius_km : 1),
               least = widths.least() * scale;
  if (!made.surface.is_whole_sphere())
    return survey_spacing(schedule.density, cells, made.surface, least);
  return {least, least, widths.greatest() * scale, steepest_of(widths, words, limit, factor)};
}

/// The evaluations of all cells that --iterations asks for; none for runs that a norm ends.
std::optional<double> given_evaluations(const Schedule& schedule, std::int64_t cells) {
  if (!schedule.recipe.stop.iterations)
    return std::nullopt;
  double sum = 0;
  for (const CvtAction& action : schedule.actions)
    sum += static_cast<double>(action.cells) * action.times * action.max_iterations;
  return sum / static_cast<double>(cells);
}

// ---- Output

std::string interval(double low, double high) {
  return message("{} to {}", formatted("%.4g", low), formatted("%.4g", high));
}

std::string percent(double share) { return formatted("%5.1f%%", 100 * share); }

std::string gradient_words(const GridPlan& plan) {
  const WidthGradient& gradient = plan.spacing.steepest;
  if (!(gradient.slope > 1e-9))
    return "0";
  const std::string at = plan.surface.is_sphere()
                             ? lonlat_words(gradient)
                             : message("x {}, y {}", formatted("%.4g", gradient.longitude),
                                       formatted("%.4g", gradient.latitude));
  return message("{} at {}{}", formatted("%.2g", gradient.slope), at,
                 is_too_steep(gradient.slope)
                     ? message(", above {}, the limit for most models", steepest_width)
                     : "");
}

/// Whether the run fits into the memory of this machine.
std::string memory_words(const GridPlan& plan) {
  const std::string need = data_size(plan.costs.memory), have = data_size(plan.memory);
  if (plan.costs.memory < 0.7 * plan.memory)
    return message("{}; it fits into the {} of this machine", need, have);
  if (plan.costs.memory < plan.memory)
    return message("{}; it may just fit into the {} of this machine", need, have);
  return message("{}; it does not fit into the {} of this machine: give fewer cells, or use a "
                 "larger machine",
                 need, have);
}

/// Of a part of the sphere, or of a plane.
std::string area_words(const GridPlan& plan, const Unit& unit) {
  const double area = plan.surface.area();
  if (!plan.surface.is_sphere())
    return formatted("%.6g", area);
  return message("{} {}, {} of the sphere",
                 unit.name == "km" ? spaced(std::llround(unit.of_steradian * area))
                                   : formatted("%.4g", area),
                 unit.area, formatted("%.2g%%", 100 * area / (4 * std::numbers::pi)));
}

} // namespace

GridPlan make_grid_plan(const CvtRequest& request, const CvtInput& input, const Schedule& schedule,
                        std::optional<double> radius_km) {
  const Recipe &asked = input.recipe, &made = schedule.recipe;
  GridPlan plan;
  plan.density = density_name(*request.density);
  plan.surface = asked.surface;
  plan.region = request.part.region;
  if (!asked.surface.is_whole_sphere())
    plan.extent = extent_of(asked.surface);
  plan.cells = made.cells > 0 ? made.cells : made.start.points.cols() + made.fixed.cols();
  plan.beyond = asked.limited_area               ? ", with those of the rings and some beyond"
                : asked.walls.x || asked.walls.y ? ", with those of a gap beyond the walls"
                                                 : "";
  plan.implied = schedule.implied_cells;
  plan.fixed = made.fixed.cols();
  plan.actions = schedule.actions;
  if (plan.implied > 0)
    plan.factor = std::sqrt(plan.implied / static_cast<double>(plan.cells));
  if (asked.surface.is_sphere())
    plan.radius_km = schedule.widths ? std::optional(asked.radius_km) : radius_km;
  plan.spacing =
      survey(schedule, plan.cells, plan.factor, request.density->widths, input.rules.gradient);
  if (schedule.widths && asked.surface.is_sphere())
    plan.doubt = doubt_of(*schedule.widths, request.density->widths);
  if (!input.rules.names.empty() && asked.surface.is_sphere())
    plan.rules = rule_shares(input.rules, asked.surface, schedule.density);
  plan.threads = tbb::this_task_arena::max_concurrency();
  plan.costs = cvt_costs(plan.cells, schedule.density, made.surface, plan.threads,
                         given_evaluations(schedule, plan.cells));
  plan.memory = machine_memory();
  if (asked.surface.is_sphere())
    plan.model = request.memory;
  plan.least_spacing = made.stop.least_spacing;
  return plan;
}

namespace {

std::string plan_row(const std::string& name, const std::string& value) {
  return row(name, 22, value);
}

/// What the grid is: its part of the surface, its cells and their widths.
std::string grid_rows(const GridPlan& plan, const Unit& unit) {
  const auto width = [&plan](const Unit& of) {
    return plan_row(
        of.name.empty() ? "cell width" : "cell width, " + of.name,
        interval(plan.spacing.least * of.of_radian, plan.spacing.greatest * of.of_radian));
  };
  std::string lines = plan_row("density", plan.density);
  if (!plan.region.empty())
    lines += plan_row("region", plan.region);
  if (plan.extent)
    lines += plan_row("extent", words_of(*plan.extent, plan.surface.is_sphere())) +
             plan_row("area", area_words(plan, unit));
  lines += plan_row("cells", message("{}{}", plan.cells, plan.beyond));
  if (plan.fixed > 0)
    lines += plan_row("generators that stay", message("{}", plan.fixed));
  if (plan.implied > 0)
    lines += plan_row("cells of the widths", formatted("%.0f", plan.implied)) +
             plan_row("factor on the widths", formatted("%.4g", plan.factor));
  lines += width(unit);
  if (unit.name == "km")
    lines += width(unit_of("degrees", {}));
  return lines + plan_row("steepest gradient", gradient_words(plan));
}

/// The longest step of MPAS-Atmosphere, s; nothing in a plane and where the radius is not known.
std::optional<double> step_of(const GridPlan& plan) {
  if (!plan.radius_km || !plan.model)
    return std::nullopt;
  return longest_step(plan.spacing.least * *plan.radius_km, plan.least_spacing);
}

std::string estimate_rows(const GridPlan& plan) {
  std::string lines =
      message("estimates for {}, within a factor of 3:\n", counted(plan.threads, "thread")) +
      plan_row("  time of cvt", duration(plan.costs.seconds)) +
      plan_row("  memory", memory_words(plan)) +
      plan_row("  MPAS file (.nc)", data_size(plan.costs.mpas_file)) +
      plan_row("  triangles (.vtp)", data_size(plan.costs.vtp_file));
  if (const std::optional<double> step = step_of(plan))
    lines += plan_row(
        "MPAS-Atmosphere",
        message("steps up to {} s; {} of memory with {} levels", formatted("%.3g", *step),
                data_size(plan.model->of(static_cast<double>(plan.cells))), plan.model->levels));
  return lines;
}

} // namespace

std::string table(const GridPlan& plan, const Unit& unit) {
  std::string lines = grid_rows(plan, unit) + "actions of the run:\n";
  for (const CvtAction& action : plan.actions)
    lines += plan_row("  " + std::string(word_of(action.kind)), described(action));
  if (plan.width_seconds > 0)
    lines += plan_row("time of the widths", duration(plan.width_seconds));
  if (!plan.rules.empty())
    lines += "rules, and where each gives the width:\n";
  for (const RuleShare& rule : plan.rules)
    lines +=
        row("  " + rule.name, 32,
            message(" {} of the area, {} of the cells", percent(rule.area), percent(rule.cells)));
  return lines + estimate_rows(plan);
}

namespace {

using Json = nlohmann::ordered_json;

/// Lengths in the units of the surface, of which a plane has one.
void add_widths(const GridPlan& plan, Json& json) {
  const auto range = [&plan](double scale) -> Json {
    return {{"min", plan.spacing.least * scale}, {"max", plan.spacing.greatest * scale}};
  };
  if (!plan.surface.is_sphere())
    json["width"] = range(1);
  if (plan.radius_km)
    json["width_km"] = range(*plan.radius_km);
  if (plan.surface.is_sphere())
    json["width_degrees"] = range(unit_of("degrees", {}).of_radian);
  const WidthGradient& steepest = plan.spacing.steepest;
  const bool sphere = plan.surface.is_sphere();
  json["gradient"] = {{"slope", steepest.slope},
                      {sphere ? "longitude" : "x", steepest.longitude},
                      {sphere ? "latitude" : "y", steepest.latitude}};
}

void add_extent(const GridPlan& plan, Json& json) {
  if (!plan.extent)
    return;
  const bool sphere = plan.surface.is_sphere();
  json["extent"] = {{sphere ? "longitude" : "x", plan.extent->x},
                    {sphere ? "latitude" : "y", plan.extent->y}};
  if (plan.extent->all_around)
    json["extent"]["longitude"] = {-180, 180};
  json["area"] = plan.surface.area();
  if (plan.radius_km)
    json["area_km2"] = plan.surface.area() * *plan.radius_km * *plan.radius_km;
}

} // namespace

std::string to_json(const GridPlan& plan) {
  Json json;
  json["density"] = plan.density;
  if (!plan.region.empty())
    json["region"] = plan.region;
  add_extent(plan, json);
  json["cells"] = plan.cells;
  if (plan.fixed > 0)
    json["fixed"] = plan.fixed;
  if (plan.implied > 0) {
    json["implied_cells"] = plan.implied;
    json["width_factor"] = plan.factor;
  }
  add_widths(plan, json);
  if (plan.width_seconds > 0)
    json["width_seconds"] = plan.width_seconds;
  for (const RuleShare& rule : plan.rules)
    json["rules"].push_back({{"name", rule.name}, {"area", rule.area}, {"cells", rule.cells}});
  for (const CvtAction& action : plan.actions)
    json["actions"].push_back(to_json(action));
  json["estimates"] = {{"threads", plan.threads},
                       {"seconds", plan.costs.seconds},
                       {"memory_bytes", plan.costs.memory},
                       {"machine_bytes", plan.memory},
                       {"mpas_bytes", plan.costs.mpas_file},
                       {"vtp_bytes", plan.costs.vtp_file}};
  if (const std::optional<double> step = step_of(plan))
    json["model"] = {{"step_seconds", *step},
                     {"levels", plan.model->levels},
                     {"memory_bytes", plan.model->of(static_cast<double>(plan.cells))}};
  return json.dump(2) + "\n";
}

} // namespace calotte::tools
