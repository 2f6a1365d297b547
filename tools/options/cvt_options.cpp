// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/cvt_options.h"

#include "help/help.h"
#include "options/config_option.h"
#include "options/format_options.h"
#include "options/numbers.h"
#include "options/picture_density.h"
#include "options/units_option.h"

#include <calotte/checkpoint.h>
#include <calotte/cut.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <CLI/App.hpp>

#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace calotte::tools {
namespace {

/// The words of an option's values but some.
template <class Value>
std::vector<std::string> words_of(std::span<const NamedValue<Value>> words,
                                  const std::set<std::string_view>& but = {}) {
  std::vector<std::string> names;
  for (const NamedValue<Value>& word : words)
    if (!but.contains(word.word))
      names.emplace_back(word.word);
  return names;
}

void add_cells(CLI::App& command, CvtRequest& request) {
  const auto set = [&request](const std::string& text) {
    request.cells_of_widths = text == "auto";
    if (!request.cells_of_widths)
      request.cells = std::stoi(text);
  };
  CLI::Option* const cells =
      command
          .add_option_function<std::string>("--cells", set,
                                            "Number of cells of the result, 3 to 1073741824 (on "
                                            "the sphere >= 12), or auto: computed "
                                            "from the cell widths, the default with --cell-width. "
                                            "Approximate after bisections of a "
                                            "domain with a boundary")
          ->transform(whole_number_or_auto(3, 1 << 30));
  command
      .add_option("--budget", request.budget,
                  "The finest cells, by one factor on all widths, that fit the memory of a model "
                  "(24GiB, 24GB), a number of cells (500000-cells), or the time step of "
                  "MPAS-Atmosphere (step=10s, which needs cell widths)")
      ->type_name("GiB|N-cells|step=S")
      ->excludes(cells);
  command
      .add_option("--levels", request.memory.levels,
                  "Levels of the model, for its memory in --budget and calotte plan; default: 55")
      ->transform(whole_number(1, 10000));
  command
      .add_option("--bytes-per-level", request.memory.bytes_per_level,
                  "Its memory for each cell and level, bytes; default: 1500, of MPAS-Atmosphere "
                  "with numbers of 32 bits; with 64 bits give 3000")
      ->check(CLI::Range(1.0, 1e9));
}

void add_start(CLI::App& command, CvtRequest& request) {
  command
      .add_option("START,--points", request.points,
                  "Initial generators: text with x y z on each line (in the plane x y), - for "
                  "standard input, or the points of a mesh. Without a file give --cells. Meshes: " +
                      names_of_read_meshes())
      ->type_name("FILE");
  command.add_flag("--lonlat", request.lonlat,
                   "The points of START and --fixed are longitude and latitude in degrees");
  command
      .add_option(
          "--fixed", request.fixed,
          "Generators that stay where they are: a file such as START, or lines that generators "
          "follow, such as rivers (.geojson of LineString). They are part of the "
          "number of cells and come first in the mesh. The start multilevel puts the other "
          "ones where these are not as dense as demanded; for density and random, or beside "
          "START, they may be anywhere")
      ->type_name("FILE");
  add_cells(command, request);
  command
      .add_option(
          "--start", request.start,
          "Initial generators without a file: multilevel (converges a coarse grid, bisects it and "
          "converges again, in turn; inserts and removes cells where the density demands it; the "
          "default but for a uniform density on the whole sphere), continuation (the same without "
          "insertion, for the sphere; the default there if the density is uniform, and geodesic "
          "from 150 cells on), density (random, distributed as the cells of an optimal grid; the "
          "default with iterations in the plane), random (uniform), fibonacci, spiral, icosahedron "
          "(bisected) or geodesic (12 cells of five neighbours, all others of six, for any number "
          "of cells) on the sphere, or hexagonal in the plane")
      ->check(CLI::IsMember(words_of(start_words(), {"automatic", "points"})));
  command.add_option("--seed", request.seed, "Seed of random points, >= 0; default: 1")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  command
      .add_option("--bisections", request.bisections,
                  "Number of bisections, 0 to 13; default: 0. Each refines the converged grid, "
                  "which then converges again. --cells is the number after the last bisection")
      ->transform(whole_number(0, 13));
  command
      .add_option(
          "--insertion-rounds", request.insertion_rounds,
          "Rounds of insertion and removal of cells on the last level of --start multilevel; 1 "
          "to 100; default: 1, with --fixed 3. Coarser levels have more")
      ->transform(whole_number(1, 100));
}

void add_method(CLI::App& command, CvtRequest& request) {
  command
      .add_option("--method", request.method,
                  "Method that minimises the energy: auto (lbfgs far from the minimum and on the "
                  "levels of --start multilevel, lbfgs-laplacian near it), lloyd (moves each "
                  "generator to its centroid), "
                  "lbfgs (quasi-Newton) or lbfgs-laplacian (L-BFGS "
                  "preconditioned with the graph Laplacian of the mesh)")
      ->check(CLI::IsMember(words_of(method_words())))
      ->capture_default_str();
}

void add_end(CLI::App& command, CvtRequest& request) {
  CLI::Option* stop =
      command
          .add_option("--stop", request.stop,
                      "The end of the run: tolerance (a pure CVT: the norm is at most the "
                      "tolerance; a few triangles may be obtuse, and a few Voronoi edges so short "
                      "that a model's diffusion of vorticity needs a shorter step), or "
                      "well-centred (then dislocations at such shapes are moved, and where that "
                      "does not suffice, a few generators leave their centroids: no obtuse "
                      "triangle, Voronoi edges from 0.18 times the Delaunay edge on; exit code 5 "
                      "if it is not reached). The errors of a model are those of a pure CVT. "
                      "Default: well-centred with --start "
                      "multilevel, else tolerance")
          ->check(CLI::IsMember({"tolerance", "well-centred"}));
  command
      .add_option(
          "--least-spacing", request.least_spacing,
          "With --stop well-centred: least distance of neighbours over the demanded width, "
          "0 to 0.95; default: 0.83. It decides a model's time step. Values near 1 move many "
          "generators away from their centroids")
      ->check(CLI::Range(0.0, 0.95));
  command
      .add_option("--most-off-midpoint", request.most_off_midpoint,
                  "With --stop well-centred: distance between the midpoints of an edge and of its "
                  "Voronoi edge, over the edge, above which generators are moved to lessen it; "
                  "above 0; default: 1, nowhere. 0.01 halves the largest errors of a model's "
                  "divergence, which are at dislocations; those of the tangential velocity grow")
      ->check(CLI::Range(1e-6, 1.0));
  CLI::Option* norm =
      command
          .add_option("--norm", request.norm,
                      "Norm that is compared with the tolerance: l2 (root mean square distance "
                      "that the generators move), linf (largest distance), l2-scaled or "
                      "linf-scaled (the same divided by the spacing, the square root of the mean "
                      "cell area)")
          ->check(CLI::IsMember(words_of(norm_words(), {"none"})))
          ->capture_default_str();
  CLI::Option* tolerance = command.add_option("--tolerance", request.given_tolerance,
                                              "Stop when the norm is at most this value; > 0; "
                                              "default: 1e-4 with --stop well-centred, else 1e-6");
  CLI::Option* limit = command
                           .add_option("--max-iterations", request.max_iterations,
                                       "Maximum number of iterations per level, >= 1. A run that "
                                       "reaches it has not converged (exit code 1)")
                           ->transform(whole_number(1, std::numeric_limits<int>::max()))
                           ->capture_default_str();
  command
      .add_option("--iterations", request.iterations,
                  "Number of iterations per level, >= 1, instead of a tolerance. Each trial of a "
                  "step counts; the last step is completed")
      ->transform(whole_number(1, std::numeric_limits<int>::max()))
      ->excludes(stop)
      ->excludes(norm)
      ->excludes(tolerance)
      ->excludes(limit);
}

void add_files(CLI::App& command, CvtRequest& request) {
  command.add_option("-o,--output", request.mesh, help_of_output())->type_name("FILE")->required();
  request.format = add_format(command);
  add_coast(command, request.coast);
  command
      .add_option("--report", request.report, "Write the data of every iteration to this JSON file")
      ->type_name("FILE");
  command
      .add_option("--keep-every", request.keep_every,
                  "Keep the triangles after every N evaluations, >= 1, beside the output: of "
                  "grid.nc as grid.000010.vtp and so on, in a periodic box as grid.000010.nc. "
                  "calotte view --history shows them")
      ->transform(whole_number(1, std::numeric_limits<int>::max()));
  command
      .add_option(
          "--checkpoint", request.checkpoint,
          "Save the state of the run to this file at intervals, for --resume. The file stays "
          "when the run ends. Without this option an interrupted run saves its state to the "
          "file it resumed from, or to OUTPUT.checkpoint")
      ->type_name("FILE");
  command
      .add_option("--checkpoint-every", request.checkpoint_every,
                  "Iterations between checkpoints; >= 1")
      ->transform(whole_number(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command
      .add_option("--checkpoint-minutes", request.checkpoint_minutes,
                  "Minutes between checkpoints, if they pass before --checkpoint-every; > 0")
      ->capture_default_str();
}

/// Files that hold options: they apply to all that were added before.
void add_saved(CLI::App& command, CvtRequest& request) {
  request.config = add_config(command);
  command
      .add_option_function<std::string>(
          "--resume",
          [&command, &request](const std::string& file) {
            request.resume = file;
            apply_options(command, read_checkpoint_command(file), file);
          },
          "Continue from this checkpoint, which holds the options of its command. Threads, "
          "regions, files and the rule that stops the run may be given anew")
      ->type_name("FILE")
      ->configurable(false);
}

} // namespace

WriteOptions write_options(const CvtRequest& request) {
  WriteOptions options = options_of(*request.format, request.mesh);
  if (request.part.limited_area && !options.vertex_order)
    options.vertex_order = CutOptions{}.vertex_order;
  return options;
}

std::shared_ptr<CvtRequest> add_run_options(CLI::App& command) {
  auto request = std::make_shared<CvtRequest>();
  {
    const OptionGroup group(command, "Start");
    add_start(command, *request);
    add_region(command, request->part);
    request->domain = add_domain(command);
    add_hexagons(command, *request->domain);
  }
  request->density = add_density(command);
  {
    const OptionGroup group(command, "Stop");
    add_end(command, *request);
  }
  {
    const OptionGroup group(command, "Method");
    add_method(command, *request);
  }
  request->delaunay = add_delaunay_options(command);
  return request;
}

std::shared_ptr<CvtRequest> add_cvt_options(CLI::App& command) {
  const std::shared_ptr<CvtRequest> request = add_run_options(command);
  const OptionGroup group(command, "Output");
  add_files(command, *request);
  add_units(command, request->units);
  add_saved(command, *request);
  return request;
}

std::set<std::string> cvt_option_names() {
  CLI::App command;
  add_cvt_options(command);
  std::set<std::string> names;
  for (const CLI::Option* option : command.get_options())
    names.insert(option->get_lnames().begin(), option->get_lnames().end());
  return names;
}

void set_domain_of_picture(CvtRequest& request) {
  const std::string& raster = request.density->widths.raster;
  if (is_picture(raster) && !planar(request) && request.part.region.empty())
    request.domain->rectangle = rectangle_of_picture(raster);
}

} // namespace calotte::tools
