// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/coastlines_option.h"
#include "options/density_option.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/mesh_source.h"
#include "options/numbers.h"
#include "options/sphere_radius_option.h"
#include "options/units_option.h"
#include "run/cvt_input.h"
#include "run/progress.h"
#include "run/spacing_survey.h"
#include "text/text.h"
#include "view/page.h"
#include "view/run.h"
#include "view_option.h"

#include <calotte/error.h>

#include <CLI/App.hpp>

#include <spawn.h>
#include <sys/wait.h>

#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <utility>

extern char** environ; // NOLINT: of POSIX

namespace calotte::tools {
namespace {

struct ViewRequest {
  std::shared_ptr<MeshSource> source;
  std::string other; ///< the mesh beside it, or ""
  std::shared_ptr<DensityWords> density;
  std::shared_ptr<DomainWords> domain; ///< of a plane
  std::optional<double> sphere_radius; ///< metres
  std::optional<std::string> units;
  std::vector<std::string> fields;
  std::optional<LonLat> view;
  bool operators = false;
  std::string report; ///< of the run that made the mesh, or ""
  std::int64_t most_cells = ViewChoice{}.most_cells;
  std::optional<bool> coastlines;
  bool plan = false;
  std::optional<std::int64_t> cells; ///< of a plan
  std::string output;
  bool open = false;
};

std::string output_of(const ViewRequest& request) {
  if (!request.output.empty())
    return request.output;
  return request.plan ? "plan.html"
                      : std::filesystem::path(request.source->path).replace_extension(".html");
}

/// A page under the name of a picture or a mesh would deceive other programs.
void require_page_name(const ViewRequest& request) {
  const std::string suffix = std::filesystem::path(request.output).extension();
  if (suffix.empty() || suffix == ".html" || suffix == ".htm")
    return;
  refuse_path(request.output,
              "a page is HTML; give a name that ends in .html, or draw a picture: calotte draw {}",
              request.plan ? "or calotte plan" : message("{} -o NAME.png", request.source->path));
}

void require_request(const ViewRequest& request) {
  if (request.plan && request.view)
    refuse("--view is the place of the cells that a page of a large mesh holds; leave it out with "
           "--plan");
  if (request.plan == !request.source->path.empty())
    refuse(request.plan ? "--plan shows widths before there is a mesh; leave MESH out"
                        : "give a mesh, or --plan and the widths of a grid");
  if (request.plan &&
      (!request.fields.empty() || !request.report.empty() || request.operators ||
       request.source->plane || request.domain->given() || !request.source->points.empty() ||
       !request.source->mesh.empty() || !request.source->at.empty()))
    refuse("--plan shows widths on the sphere; leave out --field, --mesh, --at, --history, "
           "--operators, --points, --plane and its domain");
  if (request.plan && request.sphere_radius && request.density->widths.in_km())
    refuse("widths in km refer to --earth-radius; give it in place of --sphere-radius");
  if (!request.plan && request.cells)
    refuse("--cells belongs to --plan; leave it out, or give --most-cells");
  if (request.plan && !request.cells && !request.density->widths.in_km())
    refuse("a density has no unit; give --cells N, or widths in km (--cell-width 60km)");
  require_sphere_radius(request.sphere_radius.value_or(1));
  const WidthWords& widths = request.density->widths;
  if (!request.plan)
    require_input(request.source->path); // before the page, which may be named after it
  require_outputs({{"page", output_of(request)}},
                  {request.source->path, request.source->points, request.source->mesh,
                   request.other, request.report, widths.file, widths.raster,
                   request.domain->file.value_or("")});
  require_page_name(request);
}

/// A mesh to show, and the radius of its sphere if it is known.
struct ViewInput {
  MeshSource source;
  MeshFile file;
  std::optional<double> radius_km;
};

ViewInput read_input(const ViewRequest& request, const MeshSource& source, Progress& progress) {
  progress.stage("reading " + source.path);
  ViewInput input{source, read_mesh_file(source, FieldChoice::scalars), std::nullopt};
  if (!input.file.plane())
    input.radius_km = radius_km(input.file, request.density->widths, request.sphere_radius);
  return input;
}

/// The mesh, and the one beside it. A sphere of unknown radius has that of the other, so that both
/// are measured in the same unit.
std::vector<ViewInput> read_inputs(const ViewRequest& request, Progress& progress) {
  std::vector<ViewInput> inputs = {read_input(request, *request.source, progress)};
  if (request.other.empty())
    return inputs;
  inputs.push_back(read_input(request,
                              {.path = request.other,
                               .plane = request.source->plane,
                               .mesh = request.source->mesh,
                               .at = request.source->at,
                               .of_sphere = request.source->of_sphere,
                               .of_plane = request.source->of_plane},
                              progress));
  if (!inputs[0].file.plane() != !inputs[1].file.plane())
    refuse_path(request.other, "one mesh is of the sphere and one of the plane; view them apart");
  for (std::size_t k = 0; k < 2; ++k)
    if (!inputs[k].radius_km)
      inputs[k].radius_km = inputs[1 - k].radius_km;
  return inputs;
}

/// \param plane whether the meshes are of the plane.
ViewChoice choice_of(const ViewRequest& request, bool plane) {
  const std::optional<Surface> surface = surface_of(*request.domain);
  return {.surface = surface,
          .density =
              density_of(*request.density, plane ? surface.value_or(Surface::plane()) : Surface()),
          .fields = request.fields,
          .units = request.units,
          .view = request.view,
          .operators = request.operators,
          .most_cells = request.most_cells};
}

ViewPage view_of_meshes(const ViewRequest& request, Progress& progress) {
  std::vector<ViewInput> inputs = read_inputs(request, progress);
  ViewChoice choice = choice_of(request, inputs.front().file.plane() != nullptr);
  ViewPage view;
  for (ViewInput& input : inputs) {
    progress.stage("measuring " + input.source.path);
    choice.radius_km = input.radius_km;
    view.title += (view.title.empty() ? "" : " and ") + file_name(input.source);
    const std::string changes = changes_of(input.source, input.file);
    view.meshes.push_back(view_mesh(file_name(input.source), std::move(input.file), choice));
    if (const std::string indices = words_of(input.source.at); !indices.empty())
      view.meshes.back().notice += message("Fields are shown at {}. ", indices);
    std::cerr << changes;
  }
  view.side_by_side = view.meshes.size();
  choice.radius_km = view.meshes.front().radius_km;
  if (!request.report.empty()) {
    progress.stage("reading " + request.report);
    add_run(view, request.report, std::filesystem::path(request.source->path).parent_path(),
            choice);
  }
  view.coastlines = view.meshes.front().on_sphere &&
                    shows_coastlines(request.coastlines, view.meshes.front().radius_km);
  return view;
}

ViewPage view_of_plan(const ViewRequest& request, Progress& progress) {
  progress.stage("reading the density");
  const WidthWords& words = request.density->widths;
  const GridInput input = read_grid(*request.density, {}, request.cells);
  const Schedule schedule = plan(input.recipe);
  std::optional<double> radius =
      request.sphere_radius ? std::optional(*request.sphere_radius / metres_per_km) : std::nullopt;
  if (words.in_km())
    radius = words.radius;
  const double unit = schedule.widths && !request.cells
                          ? schedule.widths->least() / words.radius
                          : survey_spacing(schedule.density, schedule.recipe.cells).unit;
  return plan_page({.widths = density_name(*request.density),
                    .cells = schedule.recipe.cells,
                    .density = schedule.density,
                    .unit = unit,
                    .radius_km = radius,
                    .lengths = unit_of(request.units, radius),
                    .coastlines = shows_coastlines(request.coastlines, radius)});
}

/// Shows a file in the browser that the desktop prefers.
void open_in_browser(const std::string& path) {
  std::string program = "xdg-open", file = path;
  char* arguments[] = {program.data(), file.data(), nullptr};
  pid_t child = 0;
  int status = 0;
  if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ) != 0 ||
      waitpid(child, &status, 0) != child || status != 0)
    throw Error(ErrorCode::file,
                message("{} is written, but xdg-open cannot show it; open it in a browser", path));
}

std::string summary(const ViewPage& view) {
  std::string text;
  for (std::size_t k = 0; k < view.side_by_side; ++k) {
    const ViewMesh& mesh = view.meshes[k];
    text += mesh.planned > 0
                ? message("a plan of {} cells", spaced(mesh.planned))
                : message("{}{}{} cells", k > 0 ? " and " : "", mesh.cells,
                          mesh.cells < mesh.total ? message(" of {}", mesh.total) : "");
  }
  if (!view.states.empty())
    text += message(", {} states", view.states.size());
  return text;
}

void run(const ViewRequest& request) {
  require_request(request);
  const std::string output = output_of(request);
  ViewPage view;
  {
    Progress progress;
    view = request.plan ? view_of_plan(request, progress) : view_of_meshes(request, progress);
    progress.writing(output);
    write_file(output, page_of(view));
  }
  std::cout << message("{}: page of {}\n", output, summary(view));
  if (request.open)
    open_in_browser(output);
}

void add_content(CLI::App& command, ViewRequest& request) {
  command
      .add_option("--field", request.fields,
                  "A field of the file at cells or triangles, by its name; may be given several "
                  "times. Default: the first 12 fields with one number for each cell or triangle")
      ->type_name("NAME");
  command.add_flag("--operators", request.operators,
                   "Also show the errors that the operators of a C-grid model (TRiSK) have at each "
                   "cell, as calotte info --operators measures them");
  command
      .add_option("--history", request.report,
                  "Show the convergence of the run that made the mesh, from its report, and the "
                  "states of --keep-every")
      ->type_name("REPORT");
  command
      .add_option(
          "--most-cells", request.most_cells,
          "Of a larger mesh the page holds so many cells: a tenth around --view, or else the "
          "smallest cell; the ten worst of each quantity and those around them; and others, "
          "evenly spread, which it shows as dots")
      ->transform(whole_number(12, std::numeric_limits<int>::max()))
      ->capture_default_str();
  add_view(command, request.view,
           "Where the page opens, in degrees. Default: over the finest cells, or an open mesh");
  add_sphere_radius(command, request.sphere_radius,
                    "Radius of the sphere, for distances in km: metres, > 0, or earth (6371229 m); "
                    "default: the planet's that the file names, or --earth-radius with "
                    "--cell-width");
  add_units(command, request.units);
  add_coastlines(command, request.coastlines);
}

void add_plan_options(CLI::App& command, ViewRequest& request) {
  command.add_flag("--plan", request.plan,
                   "Show the widths that --cell-width or --density prescribes and their gradient, "
                   "before there is a mesh");
  command
      .add_option("--cells", request.cells,
                  "Number of cells of the grid that is planned; it scales the widths")
      ->transform(whole_number(12, 1 << 30));
}

} // namespace

void add_view(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "view", "Writes an HTML page that shows a mesh, or two side by side, in a browser. Turn it, "
              "find its worst cells, read their numbers. The page needs no network.");
  auto request = std::make_shared<ViewRequest>();
  request->source = add_mesh_source(*command);
  command->get_option("MESH")->required(false); // --plan replaces it
  add_fields_of(*command, *request->source);
  command
      ->add_option("OTHER", request->other,
                   "A second mesh, shown beside the first; with --mesh a second file of fields")
      ->type_name("FILE");
  command
      ->add_option("-o,--output", request->output,
                   "Output page; default: the name of the mesh with the suffix .html")
      ->type_name("FILE");
  command->add_flag("--open", request->open, "Open the page in the browser");
  add_content(*command, *request);
  request->domain = add_domain(*command);
  add_plane(*command, *request->source, {"--sphere-radius", "--units", "--view"}, domain_names);
  request->density = add_density(*command);
  add_plan_options(*command, *request);
  set_help(
      *command,
      {.common = {"MESH", "OTHER", "--mesh", "--at", "--output", "--open", "--field", "--view",
                  "--history", "--density", "--cell-width", "--domain", "--plan"},
       .examples = {"calotte view mesh.nc --open", "calotte view mine.nc theirs.nc -o both.html",
                    "calotte view --plan --cell-width coast.geojson "
                    "--outside-width 120 --transition 4000 -o plan.html"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
