// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "draw/draw.h"
#include "draw/picture.h"
#include "draw/text.h"
#include "draw/title.h"
#include "help/help.h"
#include "io/command.h"
#include "options/coastlines_option.h"
#include "options/config_option.h"
#include "options/cvt_options.h"
#include "options/files.h"
#include "options/model_option.h"
#include "options/region_option.h"
#include "options/sphere_radius_option.h"
#include "options/units_option.h"
#include "options/warning.h"
#include "run/cvt_checks.h"
#include "run/cvt_input.h"
#include "run/grid_plan.h"
#include "run/progress.h"
#include "text/text.h"
#include "view/page.h"

#include <calotte/grid.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>

#include <CLI/App.hpp>

#include <iostream>
#include <memory>
#include <optional>
#include <utility>

namespace calotte::tools {
namespace {

struct PlanRequest {
  std::shared_ptr<CvtRequest> run;  ///< without files that it writes
  std::optional<std::string> model; ///< --for
  std::optional<double> sphere_radius;
  std::optional<bool> coastlines; ///< of the picture
  std::string picture, raster, report;
};

bool is_page(const std::string& path) { return path.ends_with(".html"); }

/// The spacings on a map, or on a page as those of calotte view.
void draw_widths(const PlanRequest& request, const Density& density, const GridPlan& plan,
                 const Unit& unit) {
  if (!plan.surface.is_sphere())
    refuse("-o draws widths on the sphere; leave it out for a plane");
  const bool coastlines = shows_coastlines(request.coastlines, plan.radius_km);
  if (is_page(request.picture)) {
    write_file(request.picture, page_of(plan_page({.widths = plan.density,
                                                   .cells = plan.cells,
                                                   .density = density,
                                                   .unit = plan.spacing.unit,
                                                   .radius_km = plan.radius_km,
                                                   .lengths = unit,
                                                   .coastlines = coastlines})));
    return;
  }
  const auto values = [&](const Points3& x) {
    return spacings_of(density, plan.spacing.unit * unit.of_radian, x);
  };
  const std::string range = range_text(unit.of_radian * plan.spacing.least,
                                       unit.of_radian * plan.spacing.greatest, symbol_of(unit));
  draw(request.picture,
       SphereField{values, message("{} cells: {}, {}", grouped(plan.cells), plan.density, range),
                   "cell width, " + unit.name},
       Look{.projection = Projection::plate_carree, .graticule = true, .coastlines = coastlines});
}

void require_request(const PlanRequest& request) {
  const CvtRequest& run = *request.run;
  const WidthWords& widths = run.density->widths;
  require_start(run);
  if (planar(run))
    require_no_sphere(request.sphere_radius, run.units);
  require_sphere_radius(request.sphere_radius.value_or(1));
  radius_for(model_of(request.model), request.sphere_radius); // throws for a contradiction
  if (!request.picture.empty() && !is_page(request.picture))
    picture_format(request.picture, ".html");
  if (!request.raster.empty() && (!widths.in_km() || widths.uniform))
    refuse("--raster writes widths of --cell-width FILE; give one, or leave it out");
  require_outputs(
      {{"picture", request.picture}, {"report", request.report}, {"raster", request.raster}},
      {run.points, run.fixed, widths.file, widths.raster, run.domain->file.value_or(""),
       region_file(run.part.region), *run.config});
}

/// The radius of the planet, km, where widths do not give it: that of the option, or the model's,
/// or the one to which lengths of the region refer.
std::optional<double> radius_of(const PlanRequest& request) {
  if (request.sphere_radius && *request.sphere_radius != 1)
    return *request.sphere_radius / metres_per_km;
  if (const ModelNeeds* const model = model_of(request.model))
    return model->planet_radius / metres_per_km;
  return has_length(request.run->part.region) ? std::optional(request.run->density->widths.radius)
                                              : std::nullopt;
}

Unit unit_for(const PlanRequest& request, const GridPlan& plan) {
  return plan.surface.is_sphere() ? unit_of(request.run->units, plan.radius_km) : Unit();
}

/// The raster of a recipe's widths.
Raster raster_of(const Recipe& recipe) {
  const Widths& widths = std::get<Widths>(recipe.resolution);
  return sampled(recipe.surface.is_sphere() ? widths.on_sphere(recipe.radius_km) : widths,
                 recipe.surface);
}

/// Writes the picture and the report, too.
GridPlan make_plan(const PlanRequest& request) {
  Progress progress;
  GridPlan plan;
  with_threads(request.run->delaunay->threads, [&] {
    CvtInput input;
    Schedule schedule;
    const double seconds = seconds_of([&] {
      input = read_input(*request.run, progress);
      schedule = plan_of(input, progress);
    });
    require_used(*request.run, schedule);
    plan = make_grid_plan(*request.run, input, schedule, radius_of(request));
    if (request.model.value_or("mpas-atmosphere") != "mpas-atmosphere")
      plan.model.reset();
    plan.width_seconds = schedule.widths ? seconds : 0;
    if (!request.picture.empty()) {
      progress.writing(request.picture);
      draw_widths(request, schedule.density, plan, unit_for(request, plan));
    }
    if (!request.raster.empty()) {
      progress.writing(request.raster);
      calotte::write(request.raster, raster_of(input.recipe));
    }
  });
  if (!request.report.empty()) {
    progress.writing(request.report);
    write_file(request.report, to_json(plan));
  }
  return plan;
}

/// The grid of --hexagons needs no run. A model has no effect on it, but on the file of calotte
/// cvt, whose options these are.
/// \throws Error invalid_argument for other options.
void print_hexagons(const PlanRequest& request) {
  require_no_run(*request.run, {"for"});
  if (!request.report.empty() || !request.picture.empty() ||
      !request.raster.empty()) // which are no options of a run
    refuse("--hexagons needs no run; leave --report, --output and --raster out");
  const MeshFile file = hexagons_of(*request.run->domain);
  const std::int64_t cells = file.polygons ? file.polygons->size() : file.mesh->points.cols();
  std::cout << row("cells", 22, message("{} regular hexagons", cells));
}

void run(const PlanRequest& request) {
  set_domain_of_picture(*request.run);
  request.run->density->widths.plane = planar(*request.run);
  if (request.run->domain->hexagons) {
    print_hexagons(request);
    return;
  }
  require_request(request);
  const GridPlan plan = make_plan(request);
  if (!plan.doubt.empty())
    warn(plan.doubt);
  std::cout << table(plan, unit_for(request, plan));
}

void add_outputs(CLI::App& command, PlanRequest& request) {
  const OptionGroup group(command, "Output");
  add_model(command, request.model);
  add_sphere_radius(command, request.sphere_radius,
                    "Radius of the sphere, for distances in km where no widths give it: metres, > "
                    "0, or earth (6371229 m); default: that of the model of --for");
  add_units(command, request.run->units);
  command
      .add_option("-o,--output", request.picture,
                  "Draw the cell widths on a map of longitude and latitude: .png, .svg or .pdf; or "
                  "write a page as those of calotte view: .html")
      ->type_name("FILE")
      ->configurable(false); // that of calotte cvt is the mesh
  add_coastlines(command, request.coastlines);
  command
      .add_option("--raster", request.raster,
                  "Write the widths as they are read or follow from rules, before --cells scales "
                  "them: NetCDF cellWidth(lat, lon) (.nc) or JIGSAW's grid (.msh)")
      ->type_name("FILE")
      ->configurable(false);
  command.add_option("--report", request.report, "Write the same quantities to this JSON file")
      ->type_name("FILE")
      ->configurable(false);
}

} // namespace

void add_plan(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "plan",
      "Describes the grid that calotte cvt would make, without making it. It prints cells, widths "
      "and their gradient, and estimates of time, memory and file sizes.");
  auto request = std::make_shared<PlanRequest>();
  request->run = add_run_options(*command);
  add_outputs(*command, *request);
  request->run->config = add_config(*command, cvt_option_names());
  set_help(
      *command,
      {.common = {"START", "--cells", "--density", "--cell-width", "--outside-width",
                  "--transition", "--gradient", "--region", "--limited-area", "--for",
                  "--sphere-radius", "--units", "--config", "--threads", "--output", "--report"},
       .examples = {
           "calotte plan --cell-width 60km", "calotte plan --config grid.toml",
           "calotte plan --cell-width 60km --region circle=-105,40,1000km --limited-area",
           "calotte plan --cell-width coast.geojson --outside-width 120 --transition 4000"}});
  command->callback([request, command] {
    request->run->options = given_options(*command);
    run(*request);
  });
}

} // namespace calotte::tools
