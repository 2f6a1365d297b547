// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "config_option.h"
#include "cvt_forecast.h"
#include "cvt_report.h"
#include "cvt_request.h"
#include "cvt_start.h"
#include "interruption.h"
#include "progress.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <oneapi/tbb/task_arena.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <optional>

namespace calotte::tools {
namespace {

const std::map<std::string, Norm> norms{{"l2", Norm::l2},
                                        {"linf", Norm::linf},
                                        {"l2-scaled", Norm::l2_scaled},
                                        {"linf-scaled", Norm::linf_scaled},
                                        {"gradient", Norm::gradient},
                                        {"none", Norm::none}};

const std::map<std::string, Method> methods{{"auto", Method::automatic},
                                            {"lloyd", Method::lloyd},
                                            {"nesterov", Method::nesterov},
                                            {"lbfgs", Method::lbfgs},
                                            {"lbfgs-laplacian", Method::lbfgs_laplacian}};

std::string shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

// ---- Before any work

void require_positive(const std::string& option, double value, const std::string& remedy) {
  if (!(value > 0) || !std::isfinite(value))
    throw Error(ErrorCode::bad_option,
                option + " " + shortest(value) + " is not a positive number; give " + remedy);
}

/// All that can be known to fail from the options alone.
void require_request(const CvtRequest& request) {
  require_positive("--tolerance", request.tolerance, "one such as 1e-6");
  require_positive("--checkpoint-minutes", request.checkpoint_minutes, "one such as 10");
  if (request.relaxation != 1 && request.method != "lloyd")
    throw Error(ErrorCode::bad_option, "--relaxation is for --method lloyd only; leave it out");
  require_start(request);
  require_mesh_suffix(request.mesh);
  const std::vector<std::string> inputs{request.points, centres_file(*request.partition),
                                        *request.config};
  require_outputs(
      {{"mesh", request.mesh}, {"report", request.report}, {"checkpoint", request.checkpoint}},
      inputs);
  // A run may go on writing the checkpoint that it was resumed from.
  require_outputs({{"mesh", request.mesh}, {"report", request.report}}, {request.resume});
}

/// All that determines the bits of the result, a line each; see write_checkpoint. Threads, regions
/// and outputs do not.
std::string configuration_of(const CvtRequest& request, const CvtOptions& options,
                             const CvtStart& start) {
  std::string text = "calotte " CALOTTE_VERSION "\n" + start.configuration;
  const auto add = [&](const std::string& name, const std::string& value) {
    text += name + " " + value + "\n";
  };
  const std::vector<std::string>& densities = request.density->densities;
  for (const std::string& density : densities)
    add("density", density);
  if (densities.empty())
    add("density", "uniform");
  if (densities.size() > 1)
    add("join", request.density->join);
  add("method", request.method);
  if (options.method == Method::lloyd)
    add("relaxation", shortest(request.relaxation));
  if (request.iterations) {
    add("iterations", std::to_string(*request.iterations));
  } else {
    add("norm", request.norm);
    add("tolerance", shortest(request.tolerance));
    add("max-iterations", std::to_string(request.max_iterations));
  }
  if (!options.density.uniform()) {
    add("rule", std::to_string(request.rule));
    add("final-rule", std::to_string(request.final_rule));
    add("triangle-divisions", std::to_string(request.triangle_divisions));
  }
  add("duplicates", request.partition->duplicates);
  add("merge-within", shortest(request.partition->merge_within));
  return text;
}

// ---- The run

/// Keeps a run's state in a file, now and then.
class Keeper {
public:
  Keeper(const CvtRequest& request, std::string configuration, std::size_t iterations)
      : request_(request), configuration_(std::move(configuration)), iterations_(iterations) {}

  bool due(const CvtState& state) const {
    const std::chrono::duration<double, std::ratio<60>> minutes = Clock::now() - time_;
    return !request_.checkpoint.empty() &&
           (state.report.iterations.size() >=
                iterations_ + static_cast<std::size_t>(request_.checkpoint_every) ||
            minutes.count() >= request_.checkpoint_minutes);
  }

  /// \throws Error file.
  void keep(const CvtState& state) {
    iterations_ = state.report.iterations.size();
    time_ = Clock::now();
    write_checkpoint(request_.checkpoint, state, configuration_);
  }

private:
  using Clock = std::chrono::steady_clock;
  const CvtRequest& request_;
  std::string configuration_;
  std::size_t iterations_; ///< of the last attempt
  Clock::time_point time_ = Clock::now();
};

struct Outcome {
  Cvt result;
  int signal = 0;         ///< that ended it early
  std::size_t before = 0; ///< iterations of the parts that it resumed
  int threads = 0;
};

/// Shows where the run stands, keeps it, and ends it when a signal came.
bool after_iteration(const CvtState& state, const CvtRequest& request, const CvtOptions& options,
                     Keeper& keeper, Progress& progress, int& signal) {
  progress.stage(describe(state, options, norm_word(request)));
  signal = Interruption::signal();
  if (signal != 0) {
    if (!request.checkpoint.empty())
      keeper.keep(state);
    return true;
  }
  if (!keeper.due(state))
    return false;
  try {
    keeper.keep(state);
  } catch (const Error& error) { // a full disk may have room again before the run needs it
    progress.say("calotte: " + std::string(error.what()) + " (the run goes on)");
  }
  return false;
}

/// All that a run needs.
struct Plan {
  CvtOptions options;
  CvtStart start;
  std::string configuration;
  std::optional<CvtState> state; ///< where it goes on
};

Plan prepare(const CvtRequest& request, Progress& progress) {
  Plan plan;
  plan.options = options_of(request);
  progress.stage("making the start");
  plan.start = open_start(request);
  plan.configuration = configuration_of(request, plan.options, plan.start);
  if (!request.resume.empty()) {
    plan.state = read_checkpoint(request.resume, plan.configuration);
    return plan;
  }
  generate_points(request, plan.options.density, plan.start);
  plan.options.bisections = plan.start.bisections;
  if (!plan.start.note.empty())
    progress.say("calotte: " + plan.start.note);
  return plan;
}

Outcome tessellate(const CvtRequest& request, Plan plan, Progress& progress) {
  Outcome outcome;
  outcome.before = plan.state ? plan.state->report.iterations.size() : 0;
  Keeper keeper(request, plan.configuration, outcome.before);
  const CvtStop stop = [&](const CvtState& now) {
    return after_iteration(now, request, plan.options, keeper, progress, outcome.signal);
  };
  progress.stage("triangulating the start");
  try {
    with_threads(request.partition->threads, [&] {
      outcome.threads = tbb::this_task_arena::max_concurrency();
      outcome.result = plan.state ? cvt(std::move(*plan.state), plan.options, stop)
                                  : cvt(plan.start.file.points, plan.options, stop);
    });
  } catch (const Error& error) {
    rethrow_with_line(error, plan.start.file);
  }
  return outcome;
}

// ---- After it

/// Says where a signal ended the run and how to go on.
[[noreturn]] void finish_interrupted(const CvtRequest& request, const Outcome& outcome) {
  const std::vector<CvtIteration>& iterations = outcome.result.report.iterations;
  std::cerr << std::string("calotte: stopped by ") +
                   (outcome.signal == SIGINT ? "SIGINT" : "SIGTERM") + " after iteration " +
                   std::to_string(iterations.size()) + ", at " +
                   std::to_string(iterations.back().cells) + " cells; " +
                   (request.checkpoint.empty()
                        ? "nothing is kept, give --checkpoint FILE to be able to go on\n"
                        : "to go on, give the same command --resume " + request.checkpoint + "\n");
  finish(outcome.signal == SIGINT ? interrupted : terminated);
}

[[noreturn]] void finish_not_converged(const CvtRequest& request, const CvtReport& report) {
  std::cout.flush();
  std::cerr << "calotte: not converged: " + residual_words(request, report) +
                   " is above the tolerance " + shortest(request.tolerance) + " after " +
                   std::to_string(request.max_iterations) +
                   " iterations; the mesh is written, raise --max-iterations\n";
  finish(not_converged);
}

void write_result(const CvtRequest& request, const Outcome& outcome, Progress& progress) {
  progress.stage("writing " + request.mesh);
  write(request.mesh, outcome.result.mesh);
  if (!request.report.empty())
    write_file(request.report, to_json(request, outcome.result, outcome.threads));
}

/// From the first iteration to the end of writing a signal ends the run in order.
Outcome tessellate_and_write(const CvtRequest& request) {
  Progress progress;
  Plan plan = prepare(request, progress);
  const Interruption interruption;
  Outcome outcome = tessellate(request, std::move(plan), progress);
  if (outcome.signal == 0)
    write_result(request, outcome, progress);
  return outcome;
}

void run(const CvtRequest& request) {
  require_request(request);
  const Outcome outcome = tessellate_and_write(request);
  if (outcome.signal != 0)
    finish_interrupted(request, outcome);
  std::cout << summary(request, outcome.result, static_cast<std::int64_t>(outcome.before)) + "\n";
  if (!outcome.result.report.converged)
    finish_not_converged(request, outcome.result.report);
}

// ---- Options

void add_start(CLI::App& command, CvtRequest& request) {
  command.add_option("START,--points", request.points,
                     "where to start: text, x y z a line; - is standard input; or the points of a "
                     "mesh, .vtp .vtu .off .ply; or give --cells");
  command.add_flag("--lonlat", request.lonlat,
                   "the text's points are longitude and latitude in degrees");
  command.add_option("--cells", request.cells, "the number of cells of the result")
      ->transform(whole_number(12, 1 << 30));
  command
      .add_option("--start", request.start,
                  "where to start without a file: continuation (the default: from a coarse grid, "
                  "converged and bisected in turn), random, density (drawn from its root, as the "
                  "cells of an optimal grid lie), fibonacci, "
                  "spiral or icosahedron")
      ->check(CLI::IsMember(
          {"continuation", "random", "density", "fibonacci", "spiral", "icosahedron"}));
  command.add_option("--seed", request.seed, "of random points; default 1")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  command
      .add_option("--bisections", request.bisections,
                  "how often to bisect what has converged and converge again; --cells counts the "
                  "cells after the last; default 0")
      ->transform(whole_number(0, 13));
}

void add_method(CLI::App& command, CvtRequest& request) {
  command
      .add_option("--method", request.method,
                  "how the energy is brought down: auto (lbfgs from afar, lbfgs-laplacian from "
                  "near), lloyd (each generator moves to its centroid), nesterov (that, "
                  "accelerated), lbfgs (quasi-Newton), or lbfgs-laplacian (from the inverse of "
                  "the mesh's graph Laplacian)")
      ->check(CLI::IsMember({"auto", "lloyd", "nesterov", "lbfgs", "lbfgs-laplacian"}))
      ->capture_default_str();
  command
      .add_option("--relaxation", request.relaxation,
                  "of Lloyd's steps: times the way to the centroid, from 1 to below 2")
      ->capture_default_str();
}

void add_end(CLI::App& command, CvtRequest& request) {
  CLI::Option* norm =
      command
          .add_option("--norm", request.norm,
                      "what is compared with the tolerance: the generators' move in the mean or "
                      "at most, by itself or over the spacing sqrt(4 pi/n), or the energy's "
                      "gradient")
          ->check(CLI::IsMember({"l2", "linf", "l2-scaled", "linf-scaled", "gradient"}))
          ->capture_default_str();
  CLI::Option* tolerance =
      command.add_option("--tolerance", request.tolerance, "stop at this norm")
          ->capture_default_str();
  CLI::Option* limit = command
                           .add_option("--max-iterations", request.max_iterations,
                                       "stop there, not converged (exit code 1); of each level")
                           ->transform(whole_number(1, std::numeric_limits<int>::max()))
                           ->capture_default_str();
  command
      .add_option("--iterations", request.iterations,
                  "do so many, on each level, instead of converging; trials of a step count, and "
                  "the last step is finished")
      ->transform(whole_number(1, std::numeric_limits<int>::max()))
      ->excludes(norm)
      ->excludes(tolerance)
      ->excludes(limit);
}

void add_quadrature(CLI::App& command, CvtRequest& request) {
  const CLI::IsMember rules({1, 3, 6, 7, 13, 19});
  command
      .add_option("--rule", request.rule,
                  "quadrature points on each half kite; not used for uniform density")
      ->check(rules)
      ->capture_default_str();
  command
      .add_option("--final-rule", request.final_rule,
                  "the same once the norm is within ten times the tolerance")
      ->check(rules)
      ->capture_default_str();
  command
      .add_option("--triangle-divisions", request.triangle_divisions,
                  "each half kite is first cut into that many squared")
      ->transform(whole_number(1, 100))
      ->capture_default_str();
}

void add_files(CLI::App& command, CvtRequest& request) {
  command
      .add_option("-o,--output", request.mesh,
                  "the mesh; its suffix names the format: .txt .tri .vtp .vtu .off .ply")
      ->required();
  command.add_option("--report", request.report, "a JSON file of what each iteration did");
  command.add_option("--checkpoint", request.checkpoint,
                     "keep the run's state in this file, to go on after an interruption");
  command
      .add_option("--checkpoint-every", request.checkpoint_every, "iterations between checkpoints")
      ->transform(whole_number(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command
      .add_option("--checkpoint-minutes", request.checkpoint_minutes,
                  "minutes between checkpoints, if that comes first")
      ->capture_default_str();
  command.add_option("--resume", request.resume,
                     "go on from this checkpoint of the same command; threads, regions and files "
                     "may differ");
  request.config = add_config(command);
}

} // namespace

std::string norm_word(const CvtRequest& request) {
  return request.iterations ? "none" : request.norm;
}

CvtOptions options_of(const CvtRequest& request) {
  CvtOptions options;
  options.density = density_of(*request.density);
  options.method = methods.at(request.method);
  options.relaxation = request.relaxation;
  options.norm = norms.at(norm_word(request));
  options.tolerance = request.tolerance;
  options.max_iterations = request.iterations.value_or(request.max_iterations);
  options.rule = request.rule;
  options.final_rule = request.final_rule;
  options.triangle_divisions = request.triangle_divisions;
  options.partition = options_of(*request.partition);
  return options;
}

void add_cvt(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "cvt", "Converge a centroidal Voronoi tessellation of the sphere for a density; the mesh is "
             "the same bits for any threads and regions, and after any interruption.");
  auto request = std::make_shared<CvtRequest>();
  add_start(*command, *request);
  request->density = add_density(*command);
  add_method(*command, *request);
  add_end(*command, *request);
  add_quadrature(*command, *request);
  request->partition = add_partition(*command);
  add_files(*command, *request);
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
