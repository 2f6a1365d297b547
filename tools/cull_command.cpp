// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/choice.h"
#include "options/files.h"
#include "options/global_option.h"
#include "options/model_option.h"
#include "options/numbers.h"
#include "options/ocean_options.h"
#include "run/interruption.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/cut.h>
#include <calotte/field_grid.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/version.h>

#include <CLI/App.hpp>

#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace calotte::tools {
namespace {

struct CullRequest {
  std::string source, output, mask, cell_map;
  std::optional<std::string> model;
  std::vector<std::string> land, passages, barriers, seeds;
  std::string raster, raster_variable;
  RasterQuantity raster_values = RasterQuantity::height;
  std::string heights, topography; ///< of the sea floor, in and out
  std::string field, field_file;
  std::optional<double> below, from;
  double land_fraction = CullOptions{}.land_fraction;
  double least_area = 0; ///< km^2 of the Earth
  bool no_fill = false;
  std::optional<double> sea_ice_latitude;
  std::string land_mesh;

  std::vector<std::string> inputs() const {
    std::vector<std::string> all{source, field_file, raster, heights};
    for (const auto* files : {&land, &passages, &barriers})
      all.insert(all.end(), files->begin(), files->end());
    return all;
  }
};

/// Checks all options that can fail, before any input is read.
void require_request(const CullRequest& request) {
  require_mpas_source(request.source);
  require_mpas_name(request.output);
  require_mpas_model(request.model);
  if (request.land.empty() && request.raster.empty() && request.field.empty() &&
      request.barriers.empty())
    refuse("there is no land; give --land FILE, --raster FILE, --field NAME or --barrier FILE");
  if (!request.land_mesh.empty())
    require_mpas_name(request.land_mesh);
  if (!request.topography.empty() && !request.topography.ends_with(".nc"))
    refuse_path(request.topography,
                "the sea floor is written to NetCDF; give a name that ends in .nc");
  if (!request.topography.empty() && request.heights.empty() &&
      (request.raster.empty() || request.raster_values != RasterQuantity::height))
    refuse("--topography needs heights; give --heights FILE, or --raster FILE with heights");
  const CellMapPaths maps = cell_map_paths(request.cell_map);
  require_outputs({{"grid", request.output},
                   {"grid of all other cells", request.land_mesh},
                   {"mask", request.mask},
                   {"topography", request.topography},
                   {"map of cells", maps.forward},
                   {"map of cells back", maps.backward}},
                  request.inputs());
}

/// Adds the file to a message about one of the lines of several files, see read_all_lines().
[[noreturn]] void rethrow_with_file(const Error& error, const std::vector<std::string>& files) {
  std::int64_t before = 0;
  for (const std::string& file : files) {
    const std::int64_t lines = std::ssize(read_lines(file));
    if (error.index() < before + lines)
      throw Error(error.code(), message("{}: {}", file, error.what()), error.index() - before);
    before += lines;
  }
  throw error;
}

/// The dimensions that the model needs besides the mesh's.
std::vector<FieldDimension> dimensions_of(const CullRequest& request) {
  const ModelNeeds* const model = model_of(request.model);
  return model != nullptr ? model->dimensions : std::vector<FieldDimension>{};
}

CullOptions options_of(const CullRequest& request) {
  CullOptions options;
  options.coast = without_small(read_coasts(request.land), request.least_area, earth_radius_km);
  if (!request.raster.empty())
    options.raster = read_land(request.raster, request.raster_variable, request.raster_values);
  options.land_fraction = request.land_fraction;
  options.field = {request.field_file, request.field};
  if (request.from)
    options.field.lower = *request.from;
  if (request.from || request.below)
    options.field.upper = request.below.value_or(std::numeric_limits<double>::infinity());
  options.passages = read_all_lines(request.passages);
  options.barriers = read_all_lines(request.barriers);
  options.fill = !request.no_fill;
  options.sea_ice_latitude = request.sea_ice_latitude;
  options.land_path = request.land_mesh;
  options.seeds = read_seeds(request.seeds);
  options.mask_path = request.mask;
  options.cell_map_folder = request.cell_map;
  if (const ModelNeeds* const model = model_of(request.model)) {
    options.sphere_radius = model->sphere_radius;
    options.vertex_order = model->vertex_order;
  }
  options.dimensions = dimensions_of(request);
  options.history = "calotte " CALOTTE_VERSION " cull: " + request.source;
  for (const std::string& file : request.inputs())
    if (!file.empty() && file != request.source)
      options.history += ", " + file;
  return options;
}

/// The largest parts of the sea that are left out, a line for each.
std::string severed_parts(const CullReport& report) {
  std::string lines;
  std::int64_t cells = 0;
  for (std::size_t k = 0; k < report.sea.severed_parts.size(); ++k) {
    cells += report.sea.severed_parts[k].cells;
    const Points2 at = to_lonlat(report.severed.col(static_cast<Eigen::Index>(k)));
    lines += row("  around " + lonlat_words(at(0, 0), at(1, 0)), 28,
                 message("{}", report.sea.severed_parts[k].cells));
  }
  if (!report.sea.severed_parts.empty())
    lines += message("{}--passage connects a part, --seed selects parts by points in them\n",
                     cells < report.sea.severed ? "  and others; " : "  ");
  return lines;
}

/// A line on passages without effect; "" if all have one.
std::string stranded_passages(const CullReport& report, const CullOptions& options) {
  std::vector<std::string> positions;
  for (const std::int64_t passage : report.stranded_passages) {
    const Points3& line = options.passages[static_cast<std::size_t>(passage)];
    const Points2 at = to_lonlat(line.col(line.cols() / 2));
    positions.push_back(lonlat_words(at(0, 0), at(1, 0)));
  }
  return positions.empty() ? ""
                           : message("{} on land only, without effect: {}\n",
                                     counted(std::ssize(positions), "passage"), listed(positions));
}

std::string describe_cull(const CullRequest& request, const CullOptions& options,
                          const CullReport& report) {
  const auto line = [](const std::string& name, std::int64_t cells) {
    return row(name, 28, message("{}", cells));
  };
  const SeaReport& sea = report.sea;
  std::string lines;
  for (const std::string& name : report.left_out)
    lines += message("{}: without the variable {}\n", request.output, name);
  lines += line("cells of land", report.land);
  if (!request.barriers.empty())
    lines += line("closed by barriers", sea.closed);
  if (!request.passages.empty())
    lines += line("opened by passages", sea.opened) + stranded_passages(report, options);
  if (!request.no_fill)
    lines += line("filled, of one neighbour", sea.filled);
  if (request.sea_ice_latitude)
    lines += line("land-locked for sea ice", sea.locked);
  lines += line("parts of the sea", sea.parts);
  lines += line("cells in parts left out", sea.severed);
  lines += severed_parts(report);
  if (!request.land_mesh.empty())
    lines += message("{}: {} cells, all others\n", request.land_mesh, report.others);
  return lines +
         message("{}: {} cells, {} edges, {} vertices\n", request.output, report.cells,
                 report.edges, report.vertices) +
         suited_models(request.output, {.format = Format::mpas,
                                        .sphere_radius = report.sphere_radius,
                                        .vertex_order = report.vertex_order,
                                        .dimensions = dimensions_of(request)});
}

/// The heights of the sea floor, if they are asked for.
std::optional<Raster> heights_of(const CullRequest& request) {
  if (request.topography.empty())
    return std::nullopt;
  return request.heights.empty()
             ? read_raster(request.raster, {request.raster_variable, RasterQuantity::height})
             : read_raster(request.heights, {"", RasterQuantity::height});
}

/// Writes the sea floor at the cells of the new grid. \returns a line on it.
std::string write_topography(const CullRequest& request, const Raster& heights,
                             const std::string& history) {
  const FieldGrid ocean = read_field_grid(request.output, FieldChoice::none);
  const SeaFloor floor = sea_floor(heights, ocean);
  write_fields(request.topography, ocean, floor.fields, history);
  return message("{}: the sea floor at {}{}\n", request.topography, counted(ocean.size(), "cell"),
                 floor.dry == 0 ? ""
                                : message("; {} {} no height below 0, and bed_elevation is 0 there",
                                          floor.dry, floor.dry == 1 ? "has" : "have"));
}

void run(const CullRequest& request) {
  require_request(request);
  CullOptions options;
  CullReport report;
  std::string topography;
  {
    Progress progress;
    progress.stage("reading the land");
    options = options_of(request);
    const std::optional<Raster> heights = heights_of(request);
    progress.stage("culling " + request.source);
    announce_files();
    options.progress = progress.bar();
    try {
      report = cull(request.source, request.output, options);
    } catch (const Error& error) {
      if (std::string_view(error.what()).starts_with("passage "))
        rethrow_with_file(error, request.passages);
      throw;
    }
    progress.stage("the sea floor");
    if (heights)
      topography = write_topography(request, *heights, options.history);
  }
  std::cout << describe_cull(request, options, report) << topography;
}

void add_raster(CLI::App& command, CullRequest& request) {
  CLI::Option* const file =
      command
          .add_option("--raster", request.raster,
                      "NetCDF raster of latitudes and longitudes that tells the sea from the land. "
                      "The fraction of land of a cell is that of the areas that it shares with the "
                      "raster's boxes. With --land, the greater fraction counts.")
          ->type_name("FILE");
  command
      .add_option("--raster-variable", request.raster_variable,
                  "Its variable(lat, lon), of a file with several")
      ->type_name("NAME")
      ->needs(file);
  add_choice<RasterQuantity>(
      command, "--raster-values", request.raster_values,
      {{"height", RasterQuantity::height},
       {"sea-fraction", RasterQuantity::sea_fraction},
       {"land-fraction", RasterQuantity::land_fraction}},
      "What the values are: heights, of which those below 0 are sea (height), or fractions "
      "from 0 to 1 of sea or of land (sea-fraction, land-fraction)")
      ->needs(file);
}

void add_land(CLI::App& command, CullRequest& request) {
  const OptionGroup group(command, "Land");
  command
      .add_option("--land", request.land,
                  "Polygons of land: GeoJSON such as Natural Earth's, which may share edges, but "
                  "not overlap; or a binned file of GSHHG, such as "
                  "/usr/share/gmt-gshhg/binned_GSHHS_l.nc of Debian's gmt-gshhg-low. May be "
                  "repeated.")
      ->type_name("FILE");
  add_raster(command, request);
  command
      .add_option("--land-fraction", request.land_fraction,
                  "Cells with a larger fraction of land are land, 0 to less than 1. The fractions "
                  "of --land are exact. Default: 0.5.")
      ->type_name("F");
  command
      .add_option("--least-area", request.least_area,
                  "Islands and lakes of --land that are smaller do not count, km^2 on the Earth; "
                  ">= 0. Default: 0, all count.")
      ->transform(square_kilometres())
      ->needs("--land");
  command
      .add_option("--field", request.field,
                  "Variable with a number for each cell that tells the sea from the land. Cells "
                  "without a number are land.")
      ->type_name("NAME");
  command
      .add_option("--field-file", request.field_file,
                  "NetCDF file of that variable. Default: the global file.")
      ->type_name("FILE")
      ->needs("--field");
  command
      .add_option("--sea-below", request.below,
                  "The sea has values below this one. Default: 0 for a topography, unlimited with "
                  "--sea-from.")
      ->type_name("X")
      ->needs("--field");
  command
      .add_option("--sea-from", request.from,
                  "The sea has values from this one on, such as 0.5 of ocean_frac. Default: "
                  "unlimited.")
      ->type_name("X")
      ->needs("--field");
}

void add_sea(CLI::App& command, CullRequest& request) {
  const OptionGroup group(command, "Sea");
  command
      .add_option("--passage", request.passages,
                  "GeoJSON lines whose cells are sea, such as straits. Successive cells share an "
                  "edge. May be repeated.")
      ->type_name("FILE");
  command
      .add_option("--barrier", request.barriers,
                  "GeoJSON lines whose cells are land, unless a passage opens them. May be "
                  "repeated.")
      ->type_name("FILE");
  command
      .add_option("--seed", request.seeds,
                  "Point in the sea, in degrees. The grid holds what is connected with a seed. May "
                  "be repeated. Default: the largest part of the sea.")
      ->type_name("LON,LAT");
  command
      .add_option("--sea-ice-latitude", request.sea_ice_latitude,
                  "From this latitude on towards both poles, such as 43, cells need a vertex whose "
                  "three cells are sea, or else are land-locked and become land, repeatedly: the "
                  "velocity of sea ice stands at vertices. Passages stay. Default: no such rule.")
      ->type_name("DEGREES")
      ->check(CLI::Range(0.0, 90.0));
  command.add_flag("--no-fill", request.no_fill,
                   "Keep cells with a single neighbour in the sea. Default: they become land, "
                   "repeatedly.");
}

} // namespace

void add_cull(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "cull", "Makes an ocean grid: removes the land cells from a global MPAS file.");
  auto request = std::make_shared<CullRequest>();
  add_global(*command, request->source);
  add_land(*command, *request);
  add_sea(*command, *request);
  {
    const OptionGroup group(*command, "Output");
    command
        ->add_option("-o,--output", request->output,
                     "The MPAS file of the grid, with the ids of the global cells, edges and "
                     "vertices. NAME.graph.info is written beside NAME.nc.")
        ->type_name("FILE")
        ->required();
    add_model(*command, request->model);
    command
        ->add_option("--land-mesh", request->land_mesh,
                     "MPAS file of all other cells, for the land of a coupled model. With the "
                     "ocean it has each global cell once; --mask has the ids in both.")
        ->type_name("FILE");
    command
        ->add_option("--mask", request->mask,
                     "NetCDF file of masks by global cell: cullCell and regionCellMasks, as "
                     "MPAS-Tools reads them, oceanCell and landCell, the 0-based ids in the ocean "
                     "and among the other cells, or -1, and landFraction.")
        ->type_name("FILE");
    command
        ->add_option("--topography", request->topography,
                     "NetCDF file of the sea floor at the cells of the grid, such as "
                     "topography_culled.nc, which the initial state of MPAS-Ocean reads: "
                     "bed_elevation, the mean of the heights below 0 by shared areas, "
                     "oceanFracObserved, and fields of land ice, which are 0.")
        ->type_name("FILE");
    command
        ->add_option("--heights", request->heights,
                     "Heights for --topography: a NetCDF raster in metres. Default: --raster.")
        ->type_name("FILE")
        ->needs("--topography");
    command
        ->add_option("--cell-map", request->cell_map,
                     "Folder for cellMapForward.txt and cellMapBackward.txt, as "
                     "MpasCellCuller.x -c writes them. By global cell the 0-based number of the "
                     "ocean's cell or -1, and by ocean's cell that of the global one.")
        ->type_name("FOLDER");
  }
  set_help(*command,
           {.common = {"GLOBAL", "--land", "--raster", "--raster-variable", "--land-fraction",
                       "--least-area", "--field", "--sea-below", "--passage", "--barrier", "--seed",
                       "--sea-ice-latitude", "--output", "--for", "--land-mesh", "--mask",
                       "--topography", "--heights"},
            .examples = {"calotte cull global.nc --land ne_10m_land.geojson -o ocean.nc",
                         "calotte cull global.nc --raster bed.nc --raster-variable z -o ocean.nc",
                         "calotte cull global.nc --field ter --sea-below 0 --seed -150,0 -o "
                         "ocean.nc"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
