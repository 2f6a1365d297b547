// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/cell_width_option.h"
#include "options/config_option.h"
#include "options/delaunay_options.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/mesh_source.h"
#include "options/region_option.h"
#include "options/warning.h"
#include "run/exit_code.h"
#include "run/memory_use.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/mesh_file.h>
#include <calotte/refine.h>
#include <calotte/version.h>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

/// refine or coarsen: what the command says, and the library's function.
struct Verb {
  const char* name;
  const char* purpose;
  const char* widths;
  const char* factor;
  const char* left;                          ///< of cells that do not meet the demand
  const char* reach;                         ///< how they would at the boundary
  base_detail::Pattern<std::int64_t> missed; ///< the same of so many not at the boundary
  ChangedMesh (*change)(const Mesh&, const WidthDemand&, const RefineOptions&);
};

constexpr Verb refining{"refine",
                        "Makes cells of a part of a mesh finer, and keeps all others to the bit.",
                        "Widths, in km, that cells become as narrow as where they are wider",
                        "How many times as narrow cells of the region become, more than 1 to 100",
                        "wider",
                        "; if the mesh ends at generators, give --boundary generators",
                        "{} cells are wider than demanded by more than 0.3; refine the result "
                        "again, or give a larger --gradient",
                        refine};
constexpr Verb coarsening{
    "coarsen",
    "Makes cells of a part of a mesh coarser, and keeps all others to the bit.",
    "Widths, in km, that cells become as wide as where they are narrower",
    "How many times as wide cells of the region become, more than 1 to 100",
    "narrower",
    "",
    "the demand is met in none of its {} cells: coarser ones grow from those around; give a larger "
    "region or --gradient",
    coarsen};

struct RefineRequest {
  const Verb* verb = nullptr;
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<FormatWords> format;
  std::shared_ptr<DelaunayWords> delaunay;
  std::shared_ptr<std::string> config;
  std::shared_ptr<DomainWords> domain;
  WidthWords widths;
  Boundary boundary = Boundary::clip;
  std::string region, inside, output, cell_map, report;
  std::optional<double> factor, gradient;
  double tolerance = RefineOptions{}.tolerance;
  FieldMethods methods;
};

/// Checks all options that can fail, before any input is read.
void require_request(const RefineRequest& request) {
  options_of(*request.format, request.output);
  if (!request.widths.in_km() && request.region.empty())
    refuse("there are no widths; give --cell-width KM|FILE, or --region REGION with --factor F");
  surface_of(*request.domain);
  const CellMapPaths maps = cell_map_paths(request.cell_map);
  require_outputs({{"mesh", request.output},
                   {"map of cells", maps.forward},
                   {"map of cells back", maps.backward},
                   {"report", request.report}},
                  {request.source->path, request.source->points, request.widths.file,
                   region_file(request.region), request.domain->file.value_or(""),
                   *request.config});
}

/// A plane is known by the rings that clip its cells, or by its period: given, or what the cells
/// fill.
void set_known_surface(const RefineRequest& request, MeshFile& file) {
  const std::optional<Surface> given = surface_of(*request.domain);
  if (!file.plane() || (!given && file.mesh->surface.period().maxCoeff() > 0))
    return;
  const std::optional<Surface> domain = given ? given : filled_surface(file);
  if (!domain)
    refuse_path(request.source->path, "a planar mesh needs its domain, which clips the cells; give "
                                      "--domain or --rectangle");
  set_surface(*file.mesh, *domain);
}

WidthDemand demand_of(const RefineRequest& request, const MeshFile& file) {
  const Surface& surface = file.mesh->surface;
  WidthDemand demand;
  WidthWords words = request.widths;
  words.radius = radius_of_widths(radius_km(file, {}), file.sphere_radius, words.radius);
  demand.radius_km = words.radius;
  if (request.region.empty()) {
    demand.widths = read_widths(words, surface).widths;
    return demand;
  }
  if (!surface.is_sphere())
    refuse(message("{} is a mesh of a plane; give --cell-width with rules (.toml), a region is one "
                   "of the sphere",
                   request.source->path));
  demand.region = region_of(request.region, request.inside, demand.radius_km);
  demand.factor = *request.factor;
  return demand;
}

RefineOptions options_of(const RefineRequest& request, Progress& progress) {
  RefineOptions options;
  options.tolerance = request.tolerance;
  options.gradient = request.gradient.value_or(options.gradient);
  options.boundary = request.boundary;
  options.decomposition = options_of(*request.delaunay).decomposition;
  options.progress = [&progress](const calotte::Progress& now) {
    if (now.run != nullptr)
      progress.stage(message("{} cells of a patch, evaluation {}",
                             now.run->report.iterations.back().cells,
                             now.run->report.iterations.size()));
    return ProgressReply::proceed;
  };
  return options;
}

WriteOptions write_options(const RefineRequest& request, const MeshFile& file) {
  WriteOptions options = options_of(*request.format, request.output);
  if (!request.format->sphere_radius && !request.format->model)
    options.sphere_radius = file.sphere_radius;
  if (!request.format->model)
    options.vertex_order = file.vertex_order;
  if (!request.format->order)
    options.numbering = Numbering::input;
  options.history =
      message("calotte " CALOTTE_VERSION " {}: {}", request.verb->name, request.source->path);
  return options;
}

/// The sums over all patches.
struct Totals {
  std::int64_t beyond = 0;
  bool converged = true, well_centred = true;

  explicit Totals(const std::vector<ChangedPatch>& patches) {
    for (const ChangedPatch& patch : patches) {
      beyond += patch.report.cells_beyond_limits;
      converged = converged && patch.report.converged;
      well_centred = well_centred && patch.report.well_centred;
    }
  }
};

std::string to_json(const ChangedMesh& changed, double read, double change, double write) {
  nlohmann::ordered_json json;
  json["cells"] = changed.mesh.points.cols();
  json["kept"] = (changed.new_of_old.array() >= 0).count();
  json["held"] = changed.held;
  json["missed"] = changed.missed;
  json["patches"] = nlohmann::ordered_json::array();
  for (const ChangedPatch& patch : changed.patches)
    json["patches"].push_back({{"removed", patch.removed},
                               {"added", patch.added},
                               {"converged", patch.report.converged},
                               {"well_centred", patch.report.well_centred},
                               {"cells_beyond_limits", patch.report.cells_beyond_limits},
                               {"evaluations", patch.report.iterations.size()},
                               {"seconds", patch.report.seconds}});
  json["seconds"] = {{"read", read}, {"change", change}, {"write", write}};
  json["memory"] = memory_use();
  return json.dump(2) + "\n";
}

std::string describe_change(const RefineRequest& request, const std::vector<std::string>& ignored,
                            const ChangedMesh& changed, const ChangedFile& file,
                            const WrittenFields& written) {
  std::string lines;
  const auto list = [&](const std::string& what, const std::vector<std::string>& names) {
    if (!names.empty())
      lines += message("{}: {}: {}\n", request.output, what, listed(names));
  };
  list("fields at new cells are means over their areas", request.methods.conservative);
  list("fields at new cells are those of the nearest old one", file.nearest);
  list("fields that do not follow the cells", file.left_out);
  list("variables that were not read", ignored);
  list("the format does not hold", written.dropped);
  const std::int64_t cells = changed.new_of_old.size(),
                     kept = (changed.new_of_old.array() >= 0).count(),
                     added = (changed.old_of_new.array() < 0).count();
  const double percent = 100.0 * static_cast<double>(kept) / static_cast<double>(cells);
  return lines + message("{}: {} cells, {} of {} kept ({}%), {} new in {} {}", request.output,
                         spaced(changed.mesh.points.cols()), spaced(kept), spaced(cells),
                         formatted("%.2f", percent), spaced(added), changed.patches.size(),
                         changed.patches.size() == 1 ? "patch" : "patches");
}

/// What falls short, with its remedies, and the exit code.
struct Verdict {
  std::vector<std::string> faults;
  ExitCode code = done;
};

Verdict verdict(const RefineRequest& request, const ChangedMesh& changed) {
  const Totals totals(changed.patches);
  Verdict found;
  if (changed.held > 0)
    found.faults.push_back(
        message("{} cells stay {} than demanded, because they are at the boundary or next to it{}",
                changed.held, request.verb->left, request.verb->reach));
  if (changed.missed > 0)
    found.faults.push_back(message(request.verb->missed, changed.missed));
  if (!totals.converged)
    found.faults.emplace_back("not converged; give a smaller --gradient");
  if (!found.faults.empty())
    found.code = not_converged;
  if (totals.well_centred)
    return found;
  found.faults.push_back(message("not well-centred: {} with shapes beyond the limits of models; "
                                 "give a smaller --gradient",
                                 counted(totals.beyond, "cell")));
  if (found.code == done)
    found.code = not_well_centred;
  return found;
}

void run(const RefineRequest& request) {
  require_request(request);
  std::string words;
  ChangedMesh changed;
  {
    Progress progress;
    progress.stage("reading " + request.source->path);
    MeshFile base;
    const double read =
        seconds_of([&] { base = read_mesh_file(*request.source, FieldChoice::all); });
    if (base.other_cells())
      refuse(message("{} holds no Voronoi cells: {}; give the file of a Voronoi mesh",
                     request.source->path, base.not_voronoi.text()));
    require_fields(base, request.methods);
    set_known_surface(request, base);
    const WidthDemand demand = demand_of(request, base);
    progress.stage("finding the patches");
    const double change = seconds_of([&] {
      with_threads(request.delaunay->threads, [&] {
        changed = request.verb->change(*base.mesh, demand, options_of(request, progress));
      });
    });
    const ChangedFile file = changed_file(base, changed, request.methods);
    WriteOptions options = write_options(request, base);
    options.progress = progress.writing(request.output);
    WrittenFields written;
    std::optional<CellMapFiles> maps;
    if (!request.cell_map.empty())
      maps.emplace(cell_map_paths(request.cell_map), changed.new_of_old, changed.old_of_new);
    const double write =
        seconds_of([&] { written = calotte::write(request.output, file.file, options); });
    if (maps)
      maps->commit();
    words = changes_of(*request.source, base) +
            describe_change(request, base.ignored, changed, file, written);
    if (!request.report.empty())
      write_file(request.report, to_json(changed, read, change, write));
  }
  const Verdict found = verdict(request, changed);
  std::cout << words
            << (found.code != done        ? "\n"
                : changed.patches.empty() ? "; the demand is met\n"
                                          : ", all new shapes within the limits of models\n");
  if (found.code != done)
    finish(found.code, message("{}: {}", request.output, listed(found.faults, "; and ", "; ")));
}

void add(CLI::App& app, const Verb& verb) {
  CLI::App* command = app.add_subcommand(verb.name, verb.purpose);
  auto request = std::make_shared<RefineRequest>();
  request->verb = &verb;
  request->source = add_mesh_source(*command, "BASE");
  request->domain = add_domain(*command);
  add_plane(*command, *request->source, {}, domain_names);
  CLI::Option* const file = add_width_file(*command, request->widths, verb.widths);
  CLI::Option* const region =
      command
          ->add_option("--region", request->region,
                       "Part of the sphere whose cells change, see calotte help region")
          ->type_name("SHAPE|FILE")
          ->excludes(file);
  add_inside(*command, request->inside);
  CLI::Option* const factor =
      command->add_option("--factor", request->factor, verb.factor)->type_name("F")->needs(region);
  region->needs(factor);
  add_gradient(*command, request->gradient,
               "Largest change of the widths in the transition beside the part, in km per km, "
               "0.001 to 1; default: 0.05");
  command
      ->add_option("--tolerance", request->tolerance,
                   "Share of its width within which a cell meets the demand, 0.01 to 0.5")
      ->capture_default_str();
  if (&verb == &refining)
    add_boundary(*command, request->boundary,
                 "Cells at the boundary of a mesh of a part of the surface: clip (they stay), or "
                 "generators (for a mesh that ends at generators, as --boundary generators of "
                 "calotte cvt makes it: finer cells reach the boundary, along which new generators "
                 "replace the old ones)");
  command
      ->add_option("--nearest", request->methods.nearest,
                   "Fields at cells, separated by commas, whose values at new cells are those of "
                   "the nearest old one, as those of whole numbers are. Default: linear between "
                   "old cells")
      ->delimiter(',')
      ->type_name("NAME,...");
  command
      ->add_option(
          "--conservative", request->methods.conservative,
          "Fields at cells, separated by commas, whose values at new cells are means of the "
          "old ones, weighted by the areas that cells share; of whole numbers the one of "
          "the greatest area")
      ->delimiter(',')
      ->type_name("NAME,...");
  command
      ->add_option("-o,--output", request->output,
                   "Output mesh, with the cells that stayed in their order, then the new ones. Its "
                   "field mapNewToBase has the number of each cell in BASE, or 0")
      ->type_name("FILE")
      ->required();
  request->format = add_format(
      *command, {.radius = "that of BASE",
                 .order = "input, the cells that stayed in their order, then the new ones"});
  CLI::Option* const map =
      command
          ->add_option("--cell-map", request->cell_map,
                       "Folder for cellMapForward.txt and cellMapBackward.txt. By cell of BASE the "
                       "0-based number of the new cell or -1, and by new cell that of BASE's")
          ->type_name("FOLDER");
  command->get_option("--order")->excludes(map); // the maps have the order that refine() gives
  command->add_option("--report", request->report, "Write counts and times to this JSON file")
      ->type_name("FILE");
  request->delaunay = add_delaunay_options(*command);
  request->config = add_config(*command);
  set_help(
      *command,
      {.common = {"BASE", "--cell-width", "--region", "--factor", "--gradient", "--nearest",
                  "--conservative", "--output", "--for", "--order", "--report", "--config",
                  "--threads"},
       .examples = {
           message("calotte {} global.nc --region bay.geojson --factor 2 -o new.nc", verb.name),
           message("calotte {} global.nc --cell-width bay.toml --gradient 0.05 -o new.nc",
                   verb.name)}});
  command->callback([request] { run(*request); });
}

} // namespace

void add_refine(CLI::App& app) { add(app, refining); }
void add_coarsen(CLI::App& app) { add(app, coarsening); }

} // namespace calotte::tools
