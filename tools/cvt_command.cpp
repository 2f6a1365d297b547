// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/config_option.h"
#include "options/cvt_options.h"
#include "options/cvt_request.h"
#include "options/files.h"
#include "options/model_option.h"
#include "options/numbers.h"
#include "options/warning.h"
#include "run/cvt_checks.h"
#include "run/cvt_configuration.h"
#include "run/cvt_costs.h"
#include "run/cvt_forecast.h"
#include "run/cvt_input.h"
#include "run/cvt_report.h"
#include "run/exit_code.h"
#include "run/interruption.h"
#include "run/kept_states.h"
#include "run/model_gates.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/checkpoint.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/quality.h>
#include <calotte/read.h>
#include <calotte/version.h>
#include <calotte/write.h>
#include <calotte/write_grid.h>

#include <CLI/App.hpp>

#include <oneapi/tbb/task_arena.h>

#include <chrono>
#include <iostream>
#include <optional>
#include <utility>

namespace calotte::tools {
namespace {

// ---- The run

/// A run before its first descent.
struct Run {
  CvtInput input;
  Schedule schedule;
  std::string configuration;
  std::optional<CvtState> state; ///< from which it resumes
};

/// Where the state of an interrupted run goes: one that was resumed goes on with its file.
std::string checkpoint_of(const CvtRequest& request) {
  return !request.checkpoint.empty() ? request.checkpoint
         : !request.resume.empty()   ? request.resume
                                     : request.mesh + ".checkpoint";
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

struct CvtOutcome {
  CvtReport report;
  Mesh mesh; ///< empty after it is written
  std::int64_t cells = 0;
  BadShapes shapes;                ///< of the mesh, where no polish ended the run
  std::string grid;                ///< the cells of the file, in words
  std::string remarks;             ///< on the file: lines, or ""
  CoastChanges coast;              ///< of the file
  std::optional<ModelGates> gates; ///< of the model that is to read the file
  std::string worst_position;      ///< of the cell of the worst shape: " (at ...)", or ""
  double area = 0;                 ///< of the surface
  int signal = 0;                  ///< the signal that ended it early
  bool kept = false;               ///< its state then
  std::size_t before = 0;          ///< iterations of the earlier parts of a resumed run
  std::vector<KeptState> states;
  int threads = 0;
};

/// Returns false and prints a line if a full disk, for example, prevents it.
/// \param files a Keeper or KeptStates.
template <class Files>
bool keep(const CvtState& state, Files& files, Progress& progress, const std::string& then) {
  try {
    files.keep(state);
  } catch (const Error& error) {
    progress.say(error.what() + then);
    return false;
  }
  return true;
}

/// "325 MB to a.nc": what the mesh file of so many cells will be.
std::string file_words(const CvtRequest& request, const Run& run, std::int64_t cells) {
  const Format format = format_of(request.mesh, write_options(request).format);
  const double bytes = file_bytes(format, cells, run.schedule.density.uniform());
  const Recipe& asked = run.input.recipe;
  const bool part = asked.limited_area || asked.walls.x || asked.walls.y; // of the run's cells
  return bytes > 0 ? message("{}{} to {}", part ? "at most " : "", data_size(bytes), request.mesh)
                   : request.mesh;
}

constexpr const char* at_once = "Ctrl-C again, after a second, ends it at once without a mesh";

/// The answer to a signal while a run iterates with so many cells.
std::string answer_of_run(const CvtRequest& request, const Run& run, std::int64_t cells,
                          std::string_view iteration) {
  return message("the run stops after {} iteration, then writes {} and its state to {}; {}",
                 iteration, file_words(request, run, cells), checkpoint_of(request), at_once);
}

/// Shows progress, keeps states and checkpoints, and ends the run after a signal.
ProgressReply after_iteration(const CvtProgress& now, const CvtRequest& request, const Run& run,
                              Keeper& keeper, KeptStates& states, Progress& progress,
                              Interruption& interruption, CvtOutcome& outcome) {
  const std::string continues = " (the run continues)";
  const Schedule& schedule = run.schedule;
  progress.stage(describe(now, schedule), std::to_string(now.bisections_left));
  if (states.due(now.report))
    keep(now.state, states, progress, continues);
  outcome.signal = Interruption::signal();
  if (outcome.signal != 0) {
    progress.stage("writing " + checkpoint_of(request));
    outcome.kept = keep(now.state, keeper, progress, "");
  } else if (keeper.due(now.report)) // a full disk may have space again by the next time
    keep(now.state, keeper, progress, continues);
  interruption.set_answer(
      answer_of_run(request, run, now.report.iterations.back().cells, "the current"));
  return outcome.signal != 0 ? ProgressReply::stop : ProgressReply::proceed;
}

Run prepare(const CvtRequest& request, Progress& progress) {
  Run run{read_input(request, progress), {}, {}, {}};
  const Format format = format_of(request.mesh, write_options(request).format);
  if (const Surface& surface = run.input.recipe.surface; !surface.is_sphere())
    require_planar_format(request.mesh, surface, format);
  run.schedule = plan_of(run.input, progress);
  require_used(request, run.schedule);
  run.input.recipe.start.points.resize(3, 0); // the schedule has them, and the density
  run.input.recipe.resolution = {};
  run.input.rules.widths = Widths::no_demand;
  const Recipe& recipe = run.schedule.recipe;
  require_space(request.mesh, file_bytes(format, recipe.cells, run.schedule.density.uniform()));
  run.configuration = configuration_of(request, run.input, run.schedule);
  if (!request.resume.empty()) {
    run.state = read_checkpoint(request.resume, run.configuration);
    return run;
  }
  for (const std::string& note : notes_on(request, run.input, run.schedule))
    progress.say(note);
  return run;
}

/// Where the cell of the worst shape is: " (at ...)"; "" without one.
std::string worst_position(const CvtOutcome& outcome) {
  const std::int64_t cell = outcome.report.worst_cell;
  if (cell < 0)
    return "";
  if (!outcome.mesh.surface.is_sphere()) {
    const Eigen::Vector3d at = outcome.mesh.points.col(cell);
    return message(" (at x {}, y {})", at.x(), at.y());
  }
  const Points2 at = to_lonlat(outcome.mesh.points.col(cell));
  return message(" (at {})", lonlat_words(at(0, 0), at(1, 0)));
}

/// \param run its state is moved out.
CvtOutcome tessellate(const CvtRequest& request, Run& run, Progress& progress,
                      Interruption& interruption) {
  CvtOutcome outcome;
  outcome.before = run.state ? run.state->report().iterations.size() : 0;
  Keeper keeper(request, run.configuration, outcome.before);
  KeptStates states(request, run.schedule.recipe.surface, outcome.before);
  RunOptions options{options_of(*request.delaunay).decomposition,
                     [&](const calotte::Progress& now) {
                       return after_iteration(*now.run, request, run, keeper, states, progress,
                                              interruption, outcome);
                     },
                     std::move(run.state)};
  progress.stage("making the start");
  try {
    with_threads(request.delaunay->threads, [&] {
      outcome.threads = tbb::this_task_arena::max_concurrency();
      Cvt grid = make_grid(run.schedule, std::move(options));
      outcome.mesh = std::move(grid.mesh);
      outcome.report = std::move(grid.report);
      if (!*run.schedule.recipe.stop.well_centred && outcome.report.converged)
        outcome.shapes = count_bad_shapes(outcome.mesh);
    });
  } catch (const Error& error) {
    rethrow_with_line(error, run.input);
  }
  outcome.cells = outcome.mesh.points.cols();
  outcome.area = run.schedule.recipe.surface.area();
  outcome.states = states.all();
  outcome.worst_position = worst_position(outcome);
  return outcome;
}

// ---- After it

/// Prints where a signal ended the run and how to resume it.
[[noreturn]] void finish_interrupted(const CvtRequest& request, const CvtOutcome& outcome) {
  const std::vector<CvtIteration>& iterations = outcome.report.iterations;
  const std::string residual = residual_words(request, outcome.report);
  const bool by_user = outcome.signal == SIGINT;
  finish(
      by_user ? interrupted : terminated,
      message("stopped by {} after iteration {}, at {} cells{}; the mesh is written as it is; {}",
              by_user ? "SIGINT" : "SIGTERM", iterations.size(), iterations.back().cells,
              residual.empty() ? "" : ", " + residual,
              outcome.kept
                  ? "to continue: calotte cvt --resume " + checkpoint_of(request)
                  : message("to continue from it: calotte cvt {}, with the options of the run",
                            request.mesh)));
}

/// The mesh is a good CVT, but not all shapes are those asked for.
[[noreturn]] void finish_not_well_centred(const CvtRequest& request, const CvtOutcome& outcome) {
  const CvtReport& report = outcome.report;
  // A file of a part of the cells numbers them anew; a run that had ended does not know its worst.
  const bool part =
      request.part.limited_area || (request.domain->walls && !request.domain->walls->empty());
  const CvtIteration& last = report.iterations.back();
  const std::string excess = formatted("%.2g", last.shape_excess),
                    cell = part ? "" : message(" at cell {}", report.worst_cell),
                    shapes =
                        report.worst_cell < 0
                            ? message("a shape is {} beyond its limit", excess)
                            : message("{} of {} cells with shapes beyond their limits, the worst, "
                                      "{} beyond,{}{}",
                                      report.cells_beyond_limits, last.cells, excess, cell,
                                      outcome.worst_position);
  finish(not_well_centred,
         message("not well-centred: {}; the mesh is written; {}give more cells", shapes,
                 request.density->widths.uniform   ? ""
                 : request.density->widths.in_km() ? "make the widths smoother (--gradient), or "
                                                   : "make the density smoother, or "));
}

[[noreturn]] void finish_not_converged(const CvtRequest& request, const CvtStop& stop,
                                       const CvtReport& report) {
  finish(not_converged,
         message("not converged: {} is above the tolerance {} after {} iterations; "
                 "the mesh is written; increase --max-iterations",
                 residual_words(request, report), *stop.tolerance, stop.max_iterations));
}

/// Whether a cell is one polygon, and whether a model takes the boundary, is known only now. If
/// not, the triangles keep the run's result.
[[noreturn]] void keep_triangles(const std::string& path, Mesh mesh, const Error& error) {
  const std::string kept = path + ".vtp";
  if (!mesh.surface.is_sphere())
    mesh.surface = Surface::plane();
  write(kept, mesh);
  throw Error(error.code(), message("{}: {}; {} has the triangles", path, error.what(), kept),
              error.index());
}

/// Makes the mesh one for models of the coastal ocean, and adds what their formats hold besides.
/// \returns remarks, each a line.
std::string prepare_coast(const CvtRequest& request, Mesh& mesh, WriteOptions& options) {
  MeshFile file;
  options.format = format_of(request.mesh, options.format);
  if (!request.coast.given() && options.format != Format::fesom)
    return missing_depths(request.mesh, options, file);
  file.mesh = mesh; // which a caller needs where an error occurs
  const std::string ears = remove_ears(request.mesh, options.format, file);
  set_coast(request.coast, file, options);
  mesh = *std::move(file.mesh);
  return ears + missing_depths(request.mesh, options, file);
}

GridFile write_file_of(const CvtRequest& request, const Run& run, CvtOutcome& outcome,
                       WriteOptions options) {
  Mesh& mesh = outcome.mesh;
  try {
    outcome.remarks = prepare_coast(request, mesh, options);
    return write_grid(request.mesh, std::move(mesh), run.input.recipe, run.schedule, options);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::invalid_argument && run.schedule.recipe.surface.is_bounded() &&
        mesh.points.cols() > 0)
      keep_triangles(request.mesh, std::move(mesh), error);
    throw;
  }
}

/// Compares the grid of a run that ended by itself with the demands of its model. The file is there
/// first, whatever happens here.
void compare_with_demands(const CvtRequest& request, CvtOutcome& outcome, Progress& progress) {
  const ModelNeeds* model = model_of(request.format->model);
  if (model == nullptr || !has_demands(*model) || planar(request) || outcome.signal != 0)
    return;
  progress.stage("comparing with the demands of " + model->name);
  outcome.gates =
      gates_of(*model, request.mesh, read_mesh_file(request.mesh, nullptr, FieldChoice::none));
}

void write_result(const CvtRequest& request, const Run& run, CvtOutcome& outcome,
                  Progress& progress) {
  const Recipe& made = run.schedule.recipe;
  WriteOptions options = write_options(request);
  options.history = history_of(request, made.stop, run.configuration, outcome.report);
  options.progress = progress.writing(request.mesh);
  const GridFile file = write_file_of(request, run, outcome, options);
  outcome.grid = describe_cells(run.input.recipe, file);
  outcome.coast = file.coast;
  compare_with_demands(request, outcome, progress);
  if (!request.report.empty())
    write_file(request.report,
               to_json(request, run.schedule, outcome.report, outcome.cells, outcome.area,
                       outcome.threads, outcome.states, outcome.gates, outcome.coast));
}

/// The cells of the next iteration: of the start, or of the state.
std::int64_t cells_before(const Run& run) {
  if (run.state && !run.state->report().iterations.empty())
    return run.state->report().iterations.back().cells;
  return run.schedule.actions.front().cells;
}

/// From here on a signal ends the run after the current iteration, with its output complete.
/// \param schedule receives that of the run.
CvtOutcome tessellate_and_write(const CvtRequest& request, Schedule& schedule) {
  Progress progress;
  Run run = prepare(request, progress);
  Interruption interruption(answer_of_run(request, run, cells_before(run), "the next"));
  CvtOutcome outcome = tessellate(request, run, progress, interruption);
  interruption.set_answer(message("the run has ended and writes {}; {}",
                                  file_words(request, run, outcome.cells), at_once));
  write_result(request, run, outcome, progress);
  schedule = std::move(run.schedule);
  return outcome;
}

/// A line on the models that the mesh suits; "" in a plane.
std::string models_of(const CvtRequest& request) {
  const WriteOptions options = write_options(request);
  return planar(request) ? "" : suited_models(request.mesh, options);
}

/// Prints what the run's result lacks.
void warn_of_result(const CvtRequest& request, const Schedule& schedule,
                    const CvtOutcome& outcome) {
  if (request.points.empty() && outcome.cells != schedule.recipe.cells && !request.domain->walls)
    complain(message("{} cells instead of {}: {} gives exactly as many", outcome.cells,
                     schedule.recipe.cells,
                     schedule.recipe.start.kind == CvtStart::Kind::hexagonal
                         ? "the hexagonal lattice has whole rows and columns; --start density"
                         : "bisections of a domain with a boundary leave out midpoints outside "
                           "it; --start multilevel"));
  const double radius = schedule.recipe.radius_km;
  if (const std::string coast = describe_coast_changes(outcome.coast, radius * radius);
      !coast.empty())
    complain(coast);
  if (outcome.report.moved_on_lines > 0)
    complain(
        message("{} of {} generators on lines have moved by up to {} of the cell width, for shapes "
                "within their limits",
                outcome.report.moved_on_lines, schedule.on_lines,
                formatted("%.2f", outcome.report.farthest_move)));
  if (outcome.report.off_boundary > 0)
    warn(message("the mesh leaves the boundary of the region in places: {} of its outer edges do "
                 "not join the {} generators on the boundary; where the region or what it leaves "
                 "out is narrower than its cells, give more cells",
                 outcome.report.off_boundary, schedule.on_boundary));
}

/// Writes the grid of --hexagons, which is the optimal one of its density: there is nothing to run.
void write_hexagons(const CvtRequest& request) {
  require_hexagons(request);
  const MeshFile file = hexagons_of(*request.domain);
  WriteOptions options = write_options(request);
  options.history =
      message("calotte " CALOTTE_VERSION " cvt --hexagons {}{}", *request.domain->hexagons,
              request.domain->walls ? " --walls " + *request.domain->walls : "");
  {
    Progress progress;
    options.progress = progress.writing(request.mesh);
    write(request.mesh, file, options);
  }
  const std::int64_t hexagons = file.polygons ? file.polygons->size() : file.mesh->points.cols();
  std::cout << message("{}: {} hexagons, {}\n", request.mesh, hexagons,
                       kind_of_plane(file.surface().period()));
}

void run(CvtRequest request) {
  set_domain_of_picture(request);
  request.density->widths.plane = planar(request);
  if (request.domain->hexagons) {
    write_hexagons(request);
    return;
  }
  require_request(request);
  Schedule schedule;
  const CvtOutcome outcome = tessellate_and_write(request, schedule);
  const CvtStop& stop = schedule.recipe.stop;
  if (outcome.signal != 0)
    finish_interrupted(request, outcome);
  std::cout << outcome.remarks +
                   message("{}: {}, {}{}\n", request.mesh, outcome.grid,
                           verdict(stop, outcome.report, outcome.shapes),
                           outcome.before > 0
                               ? message(", resumed after {}",
                                         counted(static_cast<std::int64_t>(outcome.before),
                                                 "iteration"))
                               : "") +
                   models_of(request);
  warn_of_result(request, schedule, outcome);
  const std::string beyond = outcome.gates ? failure_of(*outcome.gates) : "";
  if (!beyond.empty())
    complain(beyond + "; the mesh is written; smoother widths (--gradient) or more cells mend it");
  if (!outcome.report.converged)
    finish_not_converged(request, stop, outcome.report);
  if (*stop.well_centred && !outcome.report.well_centred)
    finish_not_well_centred(request, outcome);
  const std::string faults = describe_coast_faults(outcome.coast);
  if (!faults.empty())
    finish(beyond_demands, faults);
  if (!beyond.empty())
    finish(beyond_demands);
}

} // namespace

void add_cvt(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "cvt", "Computes a centroidal Voronoi tessellation of the sphere or of a planar domain. The "
             "mesh has the same bits for any number of threads and regions. A resumed "
             "run gives the same bits as an uninterrupted one.");
  const std::shared_ptr<CvtRequest> request = add_cvt_options(*command);
  set_help(*command,
           {.common = {"START", "--cells", "--region", "--limited-area", "--density",
                       "--cell-width", "--outside-width", "--transition", "--gradient",
                       "--tolerance", "--max-iterations", "--output", "--for", "--sphere-radius",
                       "--report", "--checkpoint", "--resume", "--config", "--threads"},
            .examples = {"calotte cvt --cell-width 60km -o earth.nc",
                         "calotte cvt --region box=-20,30,40,60 --cell-width 60km "
                         "--limited-area -o europe.nc",
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
