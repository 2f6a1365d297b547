// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "options/files.h"
#include "options/global_option.h"
#include "options/model_option.h"
#include "options/region_option.h"
#include "options/sphere_radius_option.h"
#include "run/interruption.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/cut.h>
#include <calotte/version.h>

#include <CLI/App.hpp>

#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace calotte::tools {
namespace {

struct CutRequest {
  std::string source, region, inside, output;
  int rings = limited_area_rings;
  std::optional<double> sphere_radius;
  std::optional<std::string> model;
  bool keep_radius = false;
};

/// Checks all options that can fail, before any input is read.
void require_request(const CutRequest& request) {
  require_mpas_source(request.source);
  require_mpas_name(request.output);
  if (request.sphere_radius)
    require_sphere_radius(*request.sphere_radius);
  require_mpas_model(request.model);
  radius_for(model_of(request.model), request.sphere_radius); // throws for a contradiction
  require_outputs({{"grid", request.output}}, {request.source, region_file(request.region)});
}

CutOptions options_of(const CutRequest& request) {
  CutOptions options;
  options.rings = request.rings;
  if (request.keep_radius) {
    options.sphere_radius.reset();
    options.vertex_order.reset();
  } else
    options.sphere_radius = radius_for(model_of(request.model), request.sphere_radius).value_or(1);
  if (const ModelNeeds* const model = model_of(request.model)) {
    options.vertex_order = model->vertex_order;
    options.dimensions = model->dimensions;
  }
  options.history = message(
      "calotte " CALOTTE_VERSION " cut: {} --region {}{} --rings {}", request.source,
      request.region, request.inside.empty() ? "" : " --inside " + request.inside, request.rings);
  return options;
}

std::string rings_in_words(int rings, std::int64_t inside, std::int64_t around) {
  if (rings == 0)
    return "all in the region, without rings";
  return message("{} in the region and {} in {} around it", inside, around, counted(rings, "ring"));
}

std::string describe_cut(const CutRequest& request, const CutReport& report) {
  const std::int64_t inside = report.cells_by_mask.front();
  std::string lines;
  for (const std::string& name : report.left_out)
    lines += message("{}: without the variable {}\n", request.output, name);
  lines += message("{}: {} cells, {}, {} edges, {} vertices\n", request.output, report.cells,
                   rings_in_words(request.rings, inside, report.cells - inside), report.edges,
                   report.vertices);
  if (request.keep_radius)
    return lines;
  return lines + suited_models(request.output, {.format = Format::mpas,
                                                .sphere_radius = report.sphere_radius,
                                                .vertex_order = report.vertex_order,
                                                .dimensions = options_of(request).dimensions});
}

void run(const CutRequest& request) {
  require_request(request);
  CutReport report;
  {
    Progress progress;
    progress.stage("reading " + request.region);
    const Surface region = region_of(request.region, request.inside);
    progress.stage("cutting " + request.source);
    announce_files();
    CutOptions options = options_of(request);
    options.progress = progress.bar();
    report = cut(request.source, request.output, region, options);
  }
  std::cout << describe_cut(request, report);
}

} // namespace

void add_cut(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "cut", "Cuts a limited-area grid from a global MPAS file, with all its fields.");
  auto request = std::make_shared<CutRequest>();
  add_global(*command, request->source);
  command
      ->add_option("--region", request->region,
                   "Region whose cells the grid holds: those with their generators in it. A shape "
                   "such as circle=-105,40,1000km, or a file; see calotte help region.")
      ->type_name("SHAPE|FILE")
      ->required();
  add_inside(*command, request->inside);
  command
      ->add_option("-o,--output", request->output,
                   "The MPAS file of the grid. NAME.graph.info is written beside NAME.nc.")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--rings", request->rings,
                   "Rings of boundary cells around the region, 0 to 7. Default: 7, which "
                   "MPAS-Atmosphere needs: 5 of relaxation (bdyMaskCell 1 to 5) and 2 specified.")
      ->type_name("N");
  add_sphere_radius(*command, request->sphere_radius,
                    "Radius of the sphere of the grid: metres, > 0, or earth (6371229 m). Lengths "
                    "and areas are converted. Default: 1, which MPAS-Atmosphere needs for grids.");
  CLI::Option* const model = add_model(*command, request->model);
  command
      ->add_flag("--keep-radius", request->keep_radius,
                 "Keep the radius of the global file. Use it for files of static or initial "
                 "fields, whose lengths and areas the model takes as they are.")
      ->excludes("--sphere-radius")
      ->excludes(model);
  set_help(*command,
           {.common = {},
            .examples = {"calotte cut x1.40962.grid.nc --region circle=-105,40,1000km -o region.nc",
                         "calotte cut x1.40962.static.nc --region area.geojson --keep-radius "
                         "-o area.static.nc"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
