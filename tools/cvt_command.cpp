// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "options/config_option.h"
#include "options/cvt_options.h"
#include "options/cvt_request.h"
#include "options/files.h"
#include "options/numbers.h"
#include "options/warning.h"
#include "run/channel.h"
#include "run/cvt_checks.h"
#include "run/cvt_configuration.h"
#include "run/cvt_costs.h"
#include "run/cvt_forecast.h"
#include "run/cvt_report.h"
#include "run/cvt_start.h"
#include "run/exit_code.h"
#include "run/interruption.h"
#include "run/kept_states.h"
#include "run/progress.h"
#include "run/start_files.h"

#include <calotte/cut.h>
#include <calotte/error.h>
#include <calotte/io.h>
#include <calotte/lonlat.h>
#include <calotte/version.h>

#include <oneapi/tbb/task_arena.h>

#include <chrono>
#include <iostream>
#include <optional>

namespace calotte::tools {
namespace {

// ---- The run

/// Where the state of an interrupted run goes.
std::string checkpoint_of(const CvtRequest& request) {
  return request.checkpoint.empty() ? request.mesh + ".checkpoint" : request.checkpoint;
}

/// Writes the state of a run to a file at intervals.
class Keeper {
public:
  Keeper(const CvtRequest& request, std::string configuration, std::size_t iterations)
      : request_(request), configuration_(std::move(configuration)), iterations_(iterations) {}

  bool due(const CvtReport& report) const {
    const std::chrono::duration<double, std::ratio<60>> minutes = Clock::now() - time_;
    return !request_.checkpoint.empty() &&
           (report.iterations.size() >=
                iterations_ + static_cast<std::size_t>(request_.checkpoint_every) ||
            minutes.count() >= request_.checkpoint_minutes);
  }

  /// \throws Error file.
  void keep(const CvtState& state) {
    iterations_ = state.report().iterations.size();
    time_ = Clock::now();
    write_checkpoint(checkpoint_of(request_), state, configuration_, request_.options);
  }

private:
  using Clock = std::chrono::steady_clock;
  const CvtRequest& request_;
  std::string configuration_;
  std::size_t iterations_; ///< of the last attempt
  Clock::time_point time_ = Clock::now();
};

struct Outcome {
  CvtReport report;
  Mesh mesh;        ///< on the sphere; empty after it is written
  PlanarMesh plane; ///< or in the plane
  std::int64_t cells = 0;
  std::string grid;        ///< a line about a limited-area grid
  std::string doubt;       ///< about a mesh that should end at the boundary, or ""
  std::string worst_place; ///< of the cell of the worst shape: " (at ...)", or ""
  double area = 0;         ///< of the sphere, the region or the domain
  int signal = 0;          ///< the signal that ended it early
  bool kept = false;       ///< its state then
  std::size_t before = 0;  ///< iterations of the earlier parts of a resumed run
  std::vector<KeptState> states;
  int threads = 0;
};

/// Returns false and prints a line if a full disk, for example, prevents it.
bool keep(const CvtState& state, Keeper& keeper, Progress& progress, const std::string& then) {
  try {
    keeper.keep(state);
  } catch (const Error& error) {
    progress.say("calotte: " + std::string(error.what()) + then);
    return false;
  }
  return true;
}

/// Keeps a state; a full disk, for example, does not end the run.
void keep(const CvtState& state, KeptStates& states, Progress& progress) {
  try {
    states.keep(state);
  } catch (const Error& error) {
    progress.say("calotte: " + std::string(error.what()) + " (the run continues)");
  }
}

/// Shows progress, keeps states and checkpoints, and ends the run after a signal.
bool after_iteration(const CvtProgress& now, const CvtRequest& request, const CvtOptions& options,
                     Keeper& keeper, KeptStates& states, Progress& progress, Outcome& outcome) {
  progress.stage(describe(now, options, norm_word(request)), std::to_string(now.bisections_left));
  if (states.due(now.report))
    keep(now.state, states, progress);
  outcome.signal = Interruption::signal();
  if (outcome.signal != 0)
    outcome.kept = keep(now.state, keeper, progress, "");
  else if (keeper.due(now.report)) // a full disk may have space again by the next time
    keep(now.state, keeper, progress, " (the run continues)");
  return outcome.signal != 0;
}

/// The input of a run.
struct Plan {
  CvtOptions options;
  std::optional<PlanarDomain> domain;     ///< of a plane
  std::optional<Eigen::Vector2d> channel; ///< the part of the domain between walls
  std::optional<RunRegion> region;        ///< of the sphere
  CvtStart start;
  std::string configuration;
  std::optional<CvtState> state; ///< where it goes on
};

/// Replaces a box that has walls by a wider one, and the number of its cells.
void widen_channel(CvtRequest& request, Walls walls, Plan& plan) {
  ChannelRun run = channel_run(*plan.domain, walls, plan.options.density, *request.cells);
  plan.channel = plan.domain->period;
  plan.domain = std::move(run.box);
  plan.options.density = std::move(run.density);
  request.cells = static_cast<int>(run.cells);
}

/// \param request receives the number of cells that the widths imply.
Plan prepare(CvtRequest& request, Progress& progress) {
  Plan plan;
  plan.options = options_of(request);
  plan.domain = domain_of(*request.domain);
  progress.stage("reading the density");
  Region asked = asked_region(request.part, request.density->widths);
  Resolution resolution = resolution_of(*request.density, planar(request), asked);
  plan.options.density = resolution.density;
  plan.region =
      region_of_run(request.part, std::move(asked), request.density->widths, resolution.widths);
  const std::vector<std::string> notes =
      settle_cells(request, resolution, plan.region, plan.domain);
  if (const Walls walls = walls_of(*request.domain); walls.x || walls.y)
    widen_channel(request, walls, plan);
  if (request.cells)
    require_space(request.mesh, file_bytes(format_of(request.mesh, write_options(request).format),
                                           *request.cells, plan.options.density.uniform()));
  progress.stage("making the start");
  plan.start = open_start(request, plan.options.density, plan.domain, plan.region);
  plan.options.fixed = plan.start.fixed;
  if (start_kind(request) == "multilevel") {
    plan.options.insertion_rounds = rounds_of(request);
    plan.options.cells = *request.cells;
  }
  plan.configuration = configuration_of(request, plan.options, plan.start);
  if (!request.resume.empty()) {
    plan.state = read_checkpoint(request.resume, plan.configuration);
    return plan;
  }
  for (const std::string& note : notes)
    progress.say("calotte: " + note);
  generate_points(request, plan.options.density, plan.domain, plan.region, plan.start);
  plan.options.bisections = plan.start.bisections;
  if (!plan.start.note.empty())
    progress.say("calotte: " + plan.start.note);
  return plan;
}

/// Runs the plan on the sphere or in the plane; the outcome has the mesh of that kind.
void run_plan(Plan& plan, const CvtCallback& callback, Outcome& outcome) {
  const CvtOptions& options = plan.options;
  if (plan.domain) {
    PlanarCvt result = plan.state
                           ? planar_cvt(std::move(*plan.state), *plan.domain, options, callback)
                           : planar_cvt(plan.start.places, *plan.domain, options, callback);
    outcome.plane = std::move(result.mesh);
    outcome.report = std::move(result.report);
    outcome.cells = outcome.plane.points.cols();
    outcome.area = area(*plan.domain);
  } else {
    const Region region = plan.region ? plan.region->meshed : Region{};
    Cvt result = plan.state ? spherical_cvt(std::move(*plan.state), region, options, callback)
                            : spherical_cvt(plan.start.points, region, options, callback);
    outcome.mesh = std::move(result.mesh);
    outcome.report = std::move(result.report);
    outcome.cells = outcome.mesh.points.cols();
    outcome.area = area(region);
  }
}

/// Where the cell of the worst shape is: " (at ...)"; "" without one.
std::string worst_place(const Outcome& outcome) {
  const std::int64_t cell = outcome.report.worst_cell;
  if (cell < 0)
    return "";
  if (outcome.mesh.points.cols() == 0) {
    const Eigen::Vector2d at = outcome.plane.points.col(cell);
    return " (at x " + formatted("%.6g", at.x()) + ", y " + formatted("%.6g", at.y()) + ")";
  }
  const Points2 at = to_lonlat(outcome.mesh.points.col(cell));
  return " (at " + lonlat_words(at(0, 0), at(1, 0)) + ")";
}

/// \param plan its state is moved out.
Outcome tessellate(const CvtRequest& request, Plan& plan, Progress& progress) {
  Outcome outcome;
  outcome.before = plan.state ? plan.state->report().iterations.size() : 0;
  Keeper keeper(request, plan.configuration, outcome.before);
  KeptStates states(request, plan.domain, outcome.before);
  const CvtCallback callback = [&](const CvtProgress& now) {
    return after_iteration(now, request, plan.options, keeper, states, progress, outcome);
  };
  progress.stage("triangulating the start");
  try {
    with_threads(request.partition->threads, [&] {
      outcome.threads = tbb::this_task_arena::max_concurrency();
      run_plan(plan, callback, outcome);
    });
  } catch (const Error& error) {
    rethrow_with_line(error, plan.start);
  }
  outcome.states = states.all();
  outcome.worst_place = worst_place(outcome);
  return outcome;
}

// ---- After it

/// Prints where a signal ended the run and how to resume it.
[[noreturn]] void finish_interrupted(const CvtRequest& request, const Outcome& outcome) {
  const std::vector<CvtIteration>& iterations = outcome.report.iterations;
  const std::string residual = residual_words(request, outcome.report);
  std::cerr << std::string("calotte: stopped by ") +
                   (outcome.signal == SIGINT ? "SIGINT" : "SIGTERM") + " after iteration " +
                   std::to_string(iterations.size()) + ", at " +
                   std::to_string(iterations.back().cells) + " cells" +
                   (residual.empty() ? "" : ", " + residual) + "; the mesh is written as it is; " +
                   (outcome.kept
                        ? "to continue: calotte cvt --resume " + checkpoint_of(request) + "\n"
                        : "to continue from it: calotte cvt " + request.mesh +
                              ", with the options of the run\n");
  finish(outcome.signal == SIGINT ? interrupted : terminated);
}

/// The mesh is a good CVT, but not all shapes are those asked for.
[[noreturn]] void finish_not_well_centred(const CvtRequest& request, const Outcome& outcome) {
  const CvtReport& report = outcome.report;
  // A file of a part of the cells numbers them anew; a run that had ended does not know its worst.
  const bool part =
      request.part.limited_area || (request.domain->walls && !request.domain->walls->empty());
  const std::string where =
      part ? outcome.worst_place
           : " at cell " + std::to_string(report.worst_cell) + outcome.worst_place;
  const std::string cells = report.worst_cell < 0
                                ? "a shape is "
                                : std::to_string(report.misshapen_cells) + " of " +
                                      std::to_string(report.iterations.back().cells) +
                                      " cells with shapes beyond their limits, the worst, ";
  std::cout.flush();
  std::cerr << "calotte: not well-centred: " + cells +
                   formatted("%.2g", report.iterations.back().misshapen) + " beyond" +
                   (report.worst_cell < 0 ? " its limit" : "," + where) +
                   "; the mesh is written; make the widths smoother, or give more cells\n";
  finish(not_well_centred);
}

[[noreturn]] void finish_not_converged(const CvtRequest& request, const CvtReport& report) {
  std::cout.flush();
  std::cerr << "calotte: not converged: " + residual_words(request, report) +
                   " is above the tolerance " + shortest(tolerance_of(request)) + " after " +
                   std::to_string(request.max_iterations) +
                   " iterations; the mesh is written; increase --max-iterations\n";
  finish(not_converged);
}

/// Whether a cell is one polygon is known only now. If not, the triangles keep the run's result.
void write_plane(const std::string& path, const PlanarMesh& mesh, const PlanarDomain& domain,
                 const WriteOptions& options) {
  try {
    write(path, mesh, domain, options);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_option)
      throw;
    const std::string kept = path + ".vtp";
    write(kept, mesh);
    throw Error(error.code(), path + ": " + error.what() + "; " + kept + " has the triangles",
                error.index());
  }
}

/// The periods and walls of a mesh.
std::string kind_of_plane(const Eigen::Vector2d& period) {
  const auto side = [](const char* name, double length) {
    return length > 0 ? "periodic in " + std::string(name) + ", " + shortest(length)
                      : "with walls in " + std::string(name);
  };
  return side("x", period.x()) + "; " + side("y", period.y());
}

/// Writes the cells between walls; the outcome receives their number.
void write_channel(const CvtRequest& request, const Eigen::Vector2d& extent, Outcome& outcome,
                   const WriteOptions& options) {
  MeshFile file = walled(outcome.plane, extent, walls_of(*request.domain));
  WriteOptions part = options;
  if (options.site_density.size() > 0) { // of all sites
    std::vector<double> values;
    const Walls walls = walls_of(*request.domain);
    for (Eigen::Index i = 0; i < outcome.plane.points.cols(); ++i)
      if (!(walls.x && outcome.plane.points(0, i) > extent.x()) &&
          !(walls.y && outcome.plane.points(1, i) > extent.y()))
        values.push_back(options.site_density[i]);
    part.site_density = Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
  }
  const std::int64_t cells = file.polygons->size();
  const Eigen::Vector2d period = file.polygons->period;
  write(request.mesh, file, part);
  outcome.grid = request.mesh + ": " + std::to_string(cells) + " cells, " + kind_of_plane(period) +
                 "; the others fill the gap beyond the walls\n";
}

/// Writes a limited-area grid; the outcome receives its number of cells.
void write_region(const CvtRequest& request, const RunRegion& region, Outcome& outcome,
                  const WriteOptions& options) {
  CutOptions cut;
  cut.sphere_radius = options.sphere_radius;
  cut.dimensions = options.dimensions;
  cut.history = options.history;
  const CutReport report = write_limited_area(request.mesh, outcome.mesh.points, region.meshed,
                                              region.region, options, cut);
  outcome.grid = request.mesh + ": " + std::to_string(report.cells) + " cells, " +
                 std::to_string(report.cells_by_mask.front()) + " in the region and " +
                 std::to_string(report.cells - report.cells_by_mask.front()) +
                 " in the rings around it\n";
}

void write_result(const CvtRequest& request, const Plan& plan, Outcome& outcome,
                  Progress& progress) {
  progress.stage("writing " + request.mesh);
  WriteOptions options = write_options(request);
  if (!plan.domain)
    options.density = plan.options.density;
  else if (!plan.options.density.uniform())
    options.site_density = evaluate(plan.options.density, *plan.domain, outcome.plane.points);
  options.history = history_of(request, plan.configuration, outcome.report);
  if (request.part.limited_area)
    write_region(request, *plan.region, outcome, options);
  else if (plan.channel)
    write_channel(request, *plan.channel, outcome, options);
  else if (plan.domain)
    write_plane(request.mesh, outcome.plane, *plan.domain, options);
  else
    write(request.mesh, std::move(outcome.mesh), options);
  if (!request.report.empty())
    write_file(request.report, to_json(request, outcome.report, outcome.cells, outcome.area,
                                       outcome.threads, outcome.states));
}

/// From here on a signal ends the run after the current iteration, with its output complete.
Outcome tessellate_and_write(CvtRequest& request) {
  Progress progress;
  Plan plan = prepare(request, progress);
  const Interruption interruption;
  Outcome outcome = tessellate(request, plan, progress);
  if (const CvtStart& start = plan.start; start.on_boundary > 0)
    outcome.doubt =
        doubt_of_boundary(outcome.mesh, start.fixed - start.on_boundary, start.on_boundary);
  write_result(request, plan, outcome, progress);
  return outcome;
}

/// A line on the models that the mesh suits; "" in a plane.
std::string models_of(const CvtRequest& request) {
  const WriteOptions options = write_options(request);
  return planar(request) ? ""
                         : suited_models(request.mesh, options.format, options.sphere_radius,
                                         options.dimensions);
}

/// Prints what the run's result lacks.
void warn_of_result(const CvtRequest& request, const Outcome& outcome) {
  if (request.cells && outcome.cells != *request.cells && !request.domain->walls)
    std::cerr << "calotte: " + std::to_string(outcome.cells) + " cells instead of " +
                     std::to_string(*request.cells) + ": " +
                     (start_kind(request) == "hexagonal"
                          ? "the hexagonal lattice has whole rows and columns; --start density "
                          : "bisections of a domain with a boundary leave out midpoints outside "
                            "it; --start multilevel ") +
                     "gives exactly as many\n";
  if (!outcome.doubt.empty())
    warn(outcome.doubt);
}

/// Writes the grid of --hexagons, which is the optimal one of its density: there is nothing to run.
void write_hexagons(const CvtRequest& request) {
  require_hexagons(request);
  const MeshFile file = hexagons_of(*request.domain);
  WriteOptions options = write_options(request);
  options.history = "calotte " + std::string(CALOTTE_VERSION) + " cvt --hexagons " +
                    *request.domain->hexagons +
                    (request.domain->walls ? " --walls " + *request.domain->walls : "");
  write(request.mesh, file, options);
  const bool open = file.polygons.has_value();
  std::cout << request.mesh + ": " +
                   std::to_string(open ? file.polygons->size() : file.plane->points.cols()) +
                   " hexagons, " +
                   kind_of_plane(open ? file.polygons->period : file.plane->period) + "\n";
}

void run(CvtRequest request) {
  request.density->widths.plane = planar(request);
  if (request.domain->hexagons) {
    write_hexagons(request);
    return;
  }
  require_request(request);
  const Outcome outcome = tessellate_and_write(request);
  if (outcome.signal != 0)
    finish_interrupted(request, outcome);
  std::cout << summary(request, outcome.report, outcome.cells, planar(request) ? outcome.area : 1,
                       static_cast<std::int64_t>(outcome.before)) +
                   "\n" + outcome.grid + models_of(request);
  warn_of_result(request, outcome);
  if (!outcome.report.converged)
    finish_not_converged(request, outcome.report);
  if (well_centred(request) && !outcome.report.well_centred)
    finish_not_well_centred(request, outcome);
}

} // namespace

void add_cvt(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "cvt", "Computes a centroidal Voronoi tessellation of the sphere or of a planar domain for a "
             "density. The mesh has the same bits for any number of threads and regions. A resumed "
             "run gives the same bits as an uninterrupted one.");
  const std::shared_ptr<CvtRequest> request = add_cvt_options(*command);
  set_help(*command, {.common = {"START", "--cells", "--density", "--cell-width", "--tolerance",
                                 "--max-iterations", "--output", "--for", "--sphere-radius",
                                 "--report", "--checkpoint", "--resume", "--config", "--threads"},
                      .examples = {"calotte cvt --cell-width 60km -o earth.nc",
                                   "calotte cvt --cells 40962 -o uniform.nc --for mpas-ocean",
                                   "calotte cvt --cells 40962 -o x8.vtp --density "
                                   "tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8",
                                   "calotte cvt --hexagons 16,50,10000 --walls y -o channel.nc"}});
  command->callback([request, command] {
    request->options = given_options(*command);
    run(*request);
  });
}

} // namespace calotte::tools
