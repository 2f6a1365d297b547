// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/cvt_options.h"

#include "options/config_option.h"
#include "options/format_options.h"
#include "options/numbers.h"

#include <limits>
#include <map>
#include <string>

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

void add_cells(CLI::App& command, CvtRequest& request) {
  const auto set = [&request](const std::string& text) {
    request.cells_of_widths = text == "auto";
    if (!request.cells_of_widths)
      request.cells = std::stoi(text);
  };
  const CLI::Validator number = whole_number(3, 1 << 30);
  const auto check = [number](std::string& text) {
    return text == "auto" ? std::string() : number(text);
  };
  command
      .add_option_function<std::string>(
          "--cells", set,
          "the number of cells of the result (after bisections of a domain with a boundary, "
          "about so many), or auto: as many as the cell widths ask for")
      ->transform(CLI::Validator(check, ""))
      ->type_name("N|auto");
}

void add_start(CLI::App& command, CvtRequest& request) {
  command
      .add_option("START,--points", request.points,
                  "where to start: text, x y z a line (in the plane x y); - is standard input; or "
                  "the points of a mesh, " +
                      std::string(mesh_suffixes) + "; or give --cells")
      ->type_name("FILE");
  command.add_flag("--lonlat", request.lonlat,
                   "the text's points are longitude and latitude in degrees");
  add_cells(command, request);
  command
      .add_option("--start", request.start,
                  "where to start without a file: continuation (the default: from a coarse grid, "
                  "converged and bisected in turn), random, density (drawn from its root, as the "
                  "cells of an optimal grid lie), fibonacci, "
                  "spiral or icosahedron; in the plane density (the default), random or hexagonal")
      ->check(CLI::IsMember({"continuation", "random", "density", "fibonacci", "spiral",
                             "icosahedron", "hexagonal"}));
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
                      "at most, by itself or over the spacing, the root of the mean area "
                      "of a cell, or the energy's gradient")
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
  command.add_option("-o,--output", request.mesh, help_of_output())->type_name("FILE")->required();
  command.add_option("--report", request.report, "a JSON file of what each iteration did")
      ->type_name("FILE");
  command
      .add_option("--checkpoint", request.checkpoint,
                  "keep the run's state in this file, to go on after an interruption")
      ->type_name("FILE");
  command
      .add_option("--checkpoint-every", request.checkpoint_every, "iterations between checkpoints")
      ->transform(whole_number(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command
      .add_option("--checkpoint-minutes", request.checkpoint_minutes,
                  "minutes between checkpoints, if that comes first")
      ->capture_default_str();
  command
      .add_option("--resume", request.resume,
                  "go on from this checkpoint of the same command; threads, regions and files "
                  "may differ")
      ->type_name("FILE");
  request.config = add_config(command);
}

} // namespace

std::string norm_word(const CvtRequest& request) {
  return request.iterations ? "none" : request.norm;
}

CvtOptions options_of(const CvtRequest& request) {
  CvtOptions options;
  options.method = methods.at(request.method);
  options.relaxation = request.relaxation;
  options.norm = norms.at(norm_word(request));
  options.tolerance = request.tolerance;
  options.max_iterations = request.iterations.value_or(request.max_iterations);
  options.rule = request.rule;
  options.final_rule = request.final_rule;
  options.triangle_divisions = request.triangle_divisions;
  options.partition = options_of(*request.partition, planar(request));
  return options;
}

std::shared_ptr<CvtRequest> add_cvt_options(CLI::App& command) {
  auto request = std::make_shared<CvtRequest>();
  add_start(command, *request);
  request->domain = add_domain(command);
  request->density = add_density(command);
  add_method(command, *request);
  add_end(command, *request);
  add_quadrature(command, *request);
  request->partition = add_partition(command);
  request->format = add_format(command);
  add_files(command, *request);
  return request;
}

} // namespace calotte::tools
