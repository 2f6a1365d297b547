// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "draw/draw.h"
#include "draw/picture.h"
#include "draw/text.h"
#include "draw/title.h"
#include "help/help.h"
#include "io/command.h"
#include "options/coastlines_option.h"
#include "options/delaunay_options.h"
#include "options/density_option.h"
#include "options/files.h"
#include "options/numbers.h"
#include "options/region_option.h"
#include "options/rule_shares.h"
#include "options/sphere_radius_option.h"
#include "options/warning.h"
#include "run/cvt_actions.h"
#include "run/cvt_costs.h"
#include "run/cvt_input.h"
#include "run/progress.h"
#include "run/spacing_survey.h"
#include "text/text.h"

#include <calotte/grid.h>
#include <calotte/read.h>

#include <CLI/App.hpp>

#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <utility>

namespace calotte::tools {
namespace {

struct PlanRequest {
  std::shared_ptr<DensityWords> density;
  RegionWords part;                  ///< of the sphere
  std::optional<std::int64_t> cells; ///< or those that the widths imply
  std::optional<double> sphere_radius;
  std::optional<int> threads;
  std::optional<bool> coastlines; ///< of the picture
  std::string picture, raster, report;
};

/// The grid that a run would make.
struct Plan {
  std::string region;  ///< its word, or ""
  std::string density; ///< its name
  std::string doubt;   ///< about widths that may be in metres, or ""
  std::int64_t cells = 0;
  double implied = 0;             ///< cells that widths in km imply; 0 for a density
  double factor = 1;              ///< of the widths of the file, in this grid
  std::vector<CvtAction> actions; ///< of the run
  SpacingSurvey spacing;
  std::optional<double> radius_km; ///< of the sphere, if known
  double width_seconds = 0;        ///< that reading widths in km and planning with them took
  std::vector<RuleShare> rules;    ///< of the widths, if there are any
  int threads = 1;
  CvtCosts costs;
};

/// Widths in km: on the whole sphere all quantities follow from their nodes.
SpacingSurvey survey(const Schedule& schedule, double factor, const WidthWords& words,
                     std::optional<double> limit) {
  const Recipe& made = schedule.recipe;
  if (!schedule.widths)
    return survey_spacing(schedule.density, made.cells, made.surface);
  const WidthField& widths = *schedule.widths;
  const double scale = factor / made.radius_km, least = widths.least() * scale;
  if (made.surface.is_bounded())
    return survey_spacing(schedule.density, made.cells, made.surface, least);
  return {least, least, widths.greatest() * scale, steepest_of(widths, words, limit, factor)};
}

Plan plan_of(const PlanRequest& request, const GridInput& input, const Schedule& schedule) {
  const Recipe& recipe = input.recipe;
  Plan plan;
  plan.density = density_name(*request.density);
  plan.region = request.part.region;
  const Recipe& made = schedule.recipe;
  plan.cells = made.cells;
  plan.implied = schedule.implied_cells;
  plan.actions = schedule.actions;
  if (plan.implied > 0)
    plan.factor = std::sqrt(plan.implied / static_cast<double>(plan.cells));
  if (schedule.widths)
    plan.radius_km = recipe.radius_km;
  else if (request.sphere_radius)
    plan.radius_km = *request.sphere_radius / metres_per_km;
  plan.spacing = survey(schedule, plan.factor, request.density->widths, input.rules.gradient);
  if (schedule.widths)
    plan.doubt = doubt_of(*schedule.widths, request.density->widths);
  if (!input.rules.names.empty())
    plan.rules = rule_shares(input.rules, recipe.surface, schedule.density);
  plan.threads = tbb::this_task_arena::max_concurrency();
  plan.costs = cvt_costs(plan.cells, schedule.density, made.surface, plan.threads);
  return plan;
}

// ---- Output

std::string interval(double low, double high) {
  return message("{} to {}", formatted("%.4g", low), formatted("%.4g", high));
}

std::string bytes(double count) {
  constexpr double mega = 1e6, giga = 1e9;
  return count < giga ? formatted("%.3g MB", count / mega) : formatted("%.3g GB", count / giga);
}

std::string duration(double seconds) {
  constexpr double minute = 60, hour = 3600;
  if (seconds < 2 * minute)
    return formatted("%.2g s", seconds);
  return seconds < 2 * hour ? formatted("%.2g min", seconds / minute)
                            : formatted("%.2g h", seconds / hour);
}

std::string percent(double share) { return formatted("%5.1f%%", 100 * share); }

std::string gradient_words(const WidthGradient& gradient) {
  if (!(gradient.slope > 0))
    return "0";
  return message("{} at {}{}", formatted("%.2g", gradient.slope), lonlat_words(gradient),
                 is_too_steep(gradient.slope)
                     ? message(", above {}, the limit for most models", steepest_width)
                     : "");
}

std::string table(const Plan& plan) {
  std::string lines;
  const auto add = [&lines](const std::string& name, const std::string& value) {
    lines += row(name, 22, value);
  };
  add("density", plan.density);
  if (!plan.region.empty())
    add("region", plan.region);
  add("cells", message("{}", plan.cells));
  if (plan.implied > 0) {
    add("cells of the widths", formatted("%.0f", plan.implied));
    add("factor on the widths", formatted("%.4g", plan.factor));
  }
  if (plan.radius_km)
    add("cell width, km",
        interval(plan.spacing.least * *plan.radius_km, plan.spacing.greatest * *plan.radius_km));
  add("cell width, degrees", interval(plan.spacing.least / radians_per_degree,
                                      plan.spacing.greatest / radians_per_degree));
  add("steepest gradient", gradient_words(plan.spacing.steepest));
  lines += "actions of the run:\n";
  for (const CvtAction& action : plan.actions)
    add("  " + std::string(word_of(action.kind)), described(action));
  if (plan.width_seconds > 0)
    add("time of the widths", duration(plan.width_seconds));
  if (!plan.rules.empty())
    lines += "rules, and where each gives the width:\n";
  for (const RuleShare& rule : plan.rules)
    lines +=
        row("  " + rule.name, 32,
            message(" {} of the area, {} of the cells", percent(rule.area), percent(rule.cells)));
  lines += message("estimates for {}, within a factor of 3:\n", counted(plan.threads, "thread"));
  add("  time of cvt", duration(plan.costs.seconds));
  add("  memory", bytes(plan.costs.memory));
  add("  MPAS file (.nc)", bytes(plan.costs.mpas_file));
  add("  triangles (.vtp)", bytes(plan.costs.vtp_file));
  return lines;
}

std::string to_json(const Plan& plan) {
  nlohmann::ordered_json json;
  json["density"] = plan.density;
  if (!plan.region.empty())
    json["region"] = plan.region;
  json["cells"] = plan.cells;
  if (plan.implied > 0) {
    json["implied_cells"] = plan.implied;
    json["width_factor"] = plan.factor;
  }
  if (plan.radius_km)
    json["width_km"] = {{"min", plan.spacing.least * *plan.radius_km},
                        {"max", plan.spacing.greatest * *plan.radius_km}};
  json["width_degrees"] = {{"min", plan.spacing.least / radians_per_degree},
                           {"max", plan.spacing.greatest / radians_per_degree}};
  json["gradient"] = {{"slope", plan.spacing.steepest.slope},
                      {"longitude", plan.spacing.steepest.longitude},
                      {"latitude", plan.spacing.steepest.latitude}};
  if (plan.width_seconds > 0)
    json["width_seconds"] = plan.width_seconds;
  for (const RuleShare& rule : plan.rules)
    json["rules"].push_back({{"name", rule.name}, {"area", rule.area}, {"cells", rule.cells}});
  for (const CvtAction& action : plan.actions)
    json["actions"].push_back(tools::to_json(action));
  json["estimates"] = {{"threads", plan.threads},
                       {"seconds", plan.costs.seconds},
                       {"memory_bytes", plan.costs.memory},
                       {"mpas_bytes", plan.costs.mpas_file},
                       {"vtp_bytes", plan.costs.vtp_file}};
  return json.dump(2) + "\n";
}

/// The spacings on the map, in km if the radius is known, else in degrees.
void draw_widths(const PlanRequest& request, const Density& density, const Plan& plan) {
  const double radius = plan.radius_km.value_or(1 / radians_per_degree);
  const double unit = plan.spacing.unit * radius;
  const auto values = [&](const Points3& x) { return spacings_of(density, unit, x); };
  const std::string range = range_text(radius * plan.spacing.least, radius * plan.spacing.greatest,
                                       plan.radius_km ? "km" : "\u00b0");
  draw(request.picture,
       SphereField{values, message("{}, {} cells, {}", plan.density, grouped(plan.cells), range),
                   plan.radius_km ? "cell width, km" : "cell width, degrees"},
       Look{.projection = Projection::plate_carree,
            .graticule = true,
            .coastlines = shows_coastlines(request.coastlines, plan.radius_km)});
}

// ---- The command

void require_request(const PlanRequest& request) {
  require_region_words(request.part);
  const WidthWords& widths = request.density->widths;
  if (!request.cells && !widths.in_km())
    refuse("a density has no unit, and implies no number of cells; give --cells N, or widths in "
           "km (--cell-width 60km)");
  require_sphere_radius(request.sphere_radius.value_or(1));
  if (request.sphere_radius && widths.in_km())
    refuse("--sphere-radius does not apply to widths in km; give --earth-radius, in km");
  if (!request.picture.empty())
    picture_format(request.picture);
  const bool shape = request.part.region.find('=') != std::string::npos;
  if (!request.raster.empty() && (!widths.in_km() || widths.uniform))
    refuse("--raster writes widths of --cell-width FILE; give one, or leave it out");
  require_outputs(
      {{"picture", request.picture}, {"report", request.report}, {"raster", request.raster}},
      {widths.file, widths.raster, shape ? "" : request.part.region});
}

/// The raster of a recipe's widths.
Raster raster_of(const Recipe& recipe) {
  return sampled(std::get<Widths>(recipe.resolution).on_sphere(recipe.radius_km), recipe.surface);
}

/// Writes the picture and the report, too.
Plan make_plan(const PlanRequest& request) {
  Progress progress;
  progress.stage("reading the density");
  Plan plan;
  with_threads(request.threads, [&] {
    GridInput input;
    Schedule schedule;
    const double seconds = seconds_of([&] {
      input = read_grid(*request.density, request.part, request.cells);
      schedule = calotte::plan(input.recipe);
    });
    plan = plan_of(request, input, schedule);
    plan.width_seconds = schedule.widths ? seconds : 0;
    progress.stage("drawing " + request.picture);
    if (!request.picture.empty())
      draw_widths(request, schedule.density, plan);
    if (!request.raster.empty())
      calotte::write(request.raster, raster_of(input.recipe));
  });
  if (!request.report.empty())
    write_file(request.report, to_json(plan));
  return plan;
}

void run(const PlanRequest& request) {
  require_request(request);
  const Plan plan = make_plan(request);
  if (!plan.doubt.empty())
    warn(plan.doubt);
  std::cout << table(plan);
}

void add_cells(CLI::App& command, PlanRequest& request) {
  const auto set = [&request](const std::string& text) {
    if (text != "auto")
      request.cells = std::stoi(text);
  };
  command
      .add_option_function<std::string>(
          "--cells", set,
          "Number of cells, 12 to 1073741824; it scales the widths. Or auto (default): computed "
          "from the cell widths")
      ->transform(whole_number_or_auto(12, 1 << 30));
}

} // namespace

void add_plan(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "plan",
      "Describes the grid that calotte cvt would make, without making it. It prints cells, widths "
      "and their gradient, and estimates of time, memory and file sizes.");
  auto request = std::make_shared<PlanRequest>();
  request->density = add_density(*command);
  add_cells(*command, *request);
  add_region(*command, request->part);
  add_sphere_radius(
      *command, request->sphere_radius,
      "Radius of the sphere, for the widths of a density in km: metres, > 0, or earth "
      "(6371229 m)");
  add_threads(*command, request->threads, "Number of threads of the run, 1 to 4096; default: all");
  command
      ->add_option("-o,--output", request->picture,
                   "Draw the cell widths on a map of longitude and latitude: .png, .svg or .pdf")
      ->type_name("FILE");
  add_coastlines(*command, request->coastlines);
  command
      ->add_option("--raster", request->raster,
                   "Write the widths as they are read or follow from rules, before --cells scales "
                   "them: NetCDF cellWidth(lat, lon) (.nc) or JIGSAW's grid (.msh)")
      ->type_name("FILE");
  command->add_option("--report", request->report, "Write the same quantities to this JSON file")
      ->type_name("FILE");
  set_help(*command,
           {.common = {"--cells", "--density", "--cell-width", "--outside-width", "--transition",
                       "--region", "--limited-area", "--sphere-radius", "--threads", "--output",
                       "--report"},
            .examples = {
                "calotte plan --cell-width 60km",
                "calotte plan --cell-width 60km --region circle=-105,40,1000km --limited-area",
                "calotte plan --cell-width coast.geojson --outside-width 120 --transition 4000"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
