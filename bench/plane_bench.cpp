// SPDX-License-Identifier: GPL-3.0-or-later
// Times the planar calotte::delaunay and CGAL's own triangulation of the plane in one process, in
// rounds as delaunay_bench does, and PBBS and geogram of the user's own build beside them. The
// triangles of all are compared in every round.

#include "built_peers.h"
#include "delaunay/delaunay.h"
#include "peers.h"
#include "program.h"

#include <calotte/delaunay.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/version.h>
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace calotte::bench {
namespace {

/// About n places in random order:
///   uniform   independent in the unit square;
///   clusters  20 Gaussian clusters of width 0.01;
///   line      Gaussian about a line, 1e-6 wide.
Points2 plane_cloud(const std::string& set, std::int64_t n) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  Points2 centres(2, 20);
  for (double& x : centres.reshaped())
    x = unit(engine);
  Points2 points(2, n);
  for (auto point : points.colwise()) {
    if (set == "uniform")
      point << unit(engine), unit(engine);
    else if (set == "line")
      point << unit(engine), 1e-6 * normal(engine);
    else
      point = centres.col(static_cast<Eigen::Index>(engine() % 20)) +
              0.01 * Eigen::Vector2d(normal(engine), normal(engine));
  }
  return points;
}

Outcome run_library(const Points2& points, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  Outcome outcome;
  Triangulation result;
  const Stopwatch watch;
  arena.execute([&] { result = triangulate(points, Surface::plane()); });
  watch.stop(outcome);
  const Mesh& mesh = result.mesh;
  outcome.triangles = mesh.triangles.cols();
  Digest digest;
  for (const auto& t : mesh.triangles.colwise())
    digest.add(t(0), t(1), t(2));
  outcome.digest = digest.value();
  return outcome;
}

/// The insertion of a range, which CGAL sorts along a space-filling curve.
Outcome run_cgal_plane(const Points2& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
  using Store = CGAL::Triangulation_data_structure_2<Vertex>;
  std::vector<std::pair<Kernel::Point_2, std::int32_t>> range;
  range.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    range.emplace_back(Kernel::Point_2(points(0, i), points(1, i)), static_cast<std::int32_t>(i));
  Outcome outcome;
  CGAL::Delaunay_triangulation_2<Kernel, Store> triangulation;
  const Stopwatch watch;
  triangulation.insert(range.begin(), range.end());
  watch.stop(outcome);
  outcome.triangles = static_cast<std::int64_t>(triangulation.number_of_faces());
  Digest digest;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end();
       ++face)
    digest.add(face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info());
  outcome.digest = digest.value();
  return outcome;
}

struct Options : RoundOptions {
  std::vector<std::string> sets = {"uniform", "clusters", "line"};
  std::int64_t size = 1000000;
  BuiltPeers built;
};

/// The places of a set, computed at first use, and the outcome of the first run, the library's.
struct Workload {
  Points2 points;
  std::optional<Outcome> reference;
};

using Run = std::function<Outcome(const Points2&)>;

struct Row {
  std::string name;
  Run run;
  bool lacks_hull = false; ///< it leaves out triangles near the hull, at most a hundredth
};

std::vector<Row> make_rows(const Options& options) {
  const auto library = [](int threads) -> Run {
    return [threads](const Points2& points) { return run_library(points, threads); };
  };
  std::vector<Row> rows = {{"calotte", library(options.threads)},
                           {threads_row(1), library(1)},
                           {"CGAL", run_cgal_plane}};
  if (const std::string& program = options.built.pbbs; !program.empty())
    for (const int threads : {1, options.threads})
      rows.push_back({threads == 1 ? "PBBS 1 thread" : "PBBS",
                      [=](const Points2& points) { return run_pbbs(program, points, threads); },
                      true});
  if (const std::string& program = options.built.geogram; !program.empty())
    rows.push_back(
        {"geogram", [=](const Points2& points) { return run_geogram(program, points); }});
  return rows;
}

/// One line that describes how an outcome differs from the first run's; empty if it does not.
std::string fault(const Outcome& outcome, const Row& row, const Outcome& reference) {
  if (!outcome.failure.empty())
    return outcome.failure;
  const bool same = row.lacks_hull ? 100 * outcome.triangles > 99 * reference.triangles &&
                                         outcome.triangles <= reference.triangles
                                   : outcome.digest == reference.digest;
  return same ? "" : "another set of triangles than the first run gave";
}

RoundRow row_of(const Row& row, const std::string& set, std::int64_t n,
                const std::shared_ptr<Workload>& work) {
  return {row.name, [=](benchmark::State& state) {
            if (work->points.cols() == 0)
              work->points = plane_cloud(set, n);
            for (auto _ : state) {
              const Outcome outcome = row.run(work->points);
              state.SetIterationTime(outcome.seconds);
              state.counters["cpu"] = outcome.cpu_seconds;
              if (!work->reference)
                work->reference = outcome;
              if (const std::string what = fault(outcome, row, *work->reference); !what.empty())
                state.SkipWithError(what.c_str());
            }
          }};
}

void register_all(const Options& options) {
  const std::int64_t n = options.size;
  const std::vector<Row> rows = make_rows(options);
  std::vector<std::shared_ptr<Workload>> works(options.sets.size());
  for (auto& work : works)
    work = std::make_shared<Workload>();
  for (int round = 0; round < options.rounds; ++round)
    for (std::size_t s = 0; s < works.size(); ++s) {
      std::vector<RoundRow> rounds;
      for (const Row& row : rows)
        rounds.push_back(row_of(row, options.sets[s], n, works[s]));
      register_round(options.sets[s], n, round, rounds);
    }
}

void add_options(CLI::App& app, Options& options) {
  add_list_option(app, "--sets", options.sets, "uniform, clusters, line",
                  CLI::IsMember({"uniform", "clusters", "line"}));
  app.add_option("--size", options.size, "number of sites")
      ->check(CLI::Range(3, 300000000))
      ->capture_default_str();
  add_round_options(app, options);
  add_pbbs_option(app, options.built);
  add_geogram_option(app, options.built);
}

} // namespace
} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  return run_program(argc, argv,
                     {"Times the library's Delaunay triangulation of the plane beside CGAL's.",
                      {{"CGAL", CGAL_VERSION_STR}},
                      [&](CLI::App& app) { add_options(app, options); },
                      [&] { register_all(options); }});
}
