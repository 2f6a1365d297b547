// SPDX-License-Identifier: GPL-3.0-or-later
// Times calotte::delaunay and its peers in one process, in rounds: each round runs every row once
// on the same sites, so that a ratio of two rows of a round saw the same machine. The next round
// starts with the next row. Every result is checked; a wrong one ends in a message and exit code 1.

#include "built_peers.h"
#include "clouds.h"
#include "fresh.h"
#include "peers.h"
#include "program.h"
#include "stripack.h"

#include <CGAL/version.h>
#include <benchmark/benchmark.h>

#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

namespace calotte::bench {

namespace {

struct Options : RoundOptions {
  std::vector<std::string> sets = {"random"};
  std::vector<std::int64_t> sizes = {163842, 2621442};
  std::vector<std::string> rows = {"calotte", "one-thread", "one-region", "cgal", "stripack"};
  std::vector<int> sweep;
  std::int64_t stripack_limit = 200000, qhull_limit = 200000;
  bool warm = false, fresh = false;
  BuiltPeers built;
};

/// The sites of one set, computed at first use, and the triangulation of the first run.
struct Workload {
  std::string set;
  Points3 points;
  std::optional<Outcome> reference; ///< from the first of the library's rows
};

using Run = std::function<Outcome(const Points3&)>;

struct Row {
  std::string name;
  Run run;
  bool peer = false;
  std::int64_t limit = std::numeric_limits<std::int64_t>::max(); ///< sites
  std::string only_set = {}; ///< where it is not for all of them
};

const std::vector<std::string> row_names = {"calotte",          "one-thread", "one-region",
                                            "side-by-side",     "cgal",       "stripack",
                                            "stripack-natural", "qhull"};

/// TRMESH on the sites of the set bisection, coarse levels first.
Outcome run_stripack_natural(const Points3& shuffled) {
  return run_stripack(natural_bisection(shuffled.cols()));
}

Row library_row(std::string name, int threads, std::optional<int> regions = {}) {
  return {std::move(name), [=](const Points3& points) {
            DelaunayOptions options;
            options.partition.regions = regions;
            return run_calotte(points, threads, options);
          }};
}

std::vector<Row> make_rows(const Options& options) {
  std::vector<Row> rows;
  for (const std::string& name : options.rows) {
    if (name == "calotte") {
      rows.push_back(library_row("calotte", options.threads));
    } else if (name == "one-thread") {
      rows.push_back(library_row(threads_row(1), 1));
    } else if (name == "one-region") {
      rows.push_back(library_row("calotte one region", 1, 1));
    } else if (name == "side-by-side") {
      rows.push_back({"calotte side by side", [threads = options.threads](const Points3& points) {
                        return run_side_by_side(points, threads);
                      }});
    } else if (name == "cgal") {
      rows.push_back({"CGAL", run_cgal, true});
    } else if (name == "stripack" && has_stripack()) {
      rows.push_back({"STRIPACK", run_stripack, true, options.stripack_limit});
    } else if (name == "stripack-natural" && has_stripack()) {
      rows.push_back({"STRIPACK, natural order", run_stripack_natural, true, options.stripack_limit,
                      "bisection"});
    } else if (name == "qhull" && has_qhull()) {
      rows.push_back({"Qhull", run_qhull, true, options.qhull_limit});
    }
  }
  if (const std::string& program = options.built.geogram; !program.empty())
    for (const int threads : {1, options.threads})
      rows.push_back({threads == 1 ? "geogram 1 thread" : "geogram",
                      [=](const Points3& points) { return run_geogram(program, points, threads); },
                      true});
  for (const int threads : options.sweep)
    rows.push_back(library_row(threads_row(threads), threads));
  return rows;
}

/// One line that describes how an outcome differs from the expected one; empty if it does not.
/// Peers decide by the stored doubles, the library by the exact directions. On random sites the
/// difference does not affect any decision; on a bisected icosahedron it affects many, so that the
/// peers' triangles are only counted there.
std::string fault(const Outcome& outcome, const Row& row, const std::string& set, std::int64_t n,
                  const std::optional<Outcome>& reference) {
  if (!outcome.failure.empty())
    return outcome.failure;
  const std::int64_t expected = 2 * n - 4;
  if (outcome.triangles != expected) {
    return std::to_string(outcome.triangles) + " triangles with " + std::to_string(outcome.sites) +
           " vertices, where " + std::to_string(expected) + " are due";
  }
  const bool same_decisions = !row.peer || set != "bisection";
  if (same_decisions && reference && outcome.digest != reference->digest)
    return "another set of triangles than the library's first run gave";
  return {};
}

/// Runs a row as the options say: in a new process, or here, perhaps after a run that is not timed.
Outcome run_once(Workload& work, std::int64_t n, const Row& row, const Options& options) {
  if (options.fresh)
    return run_in_new_process([&] { return row.run(cloud(work.set, n)); });
  if (work.points.cols() == 0)
    work.points = cloud(work.set, n);
  if (options.warm && !row.peer)
    row.run(work.points);
  return row.run(work.points);
}

void run_row(benchmark::State& state, Workload& work, std::int64_t n, const Row& row,
             const Options& options) {
  for (auto _ : state) {
    const Outcome outcome = run_once(work, n, row, options);
    state.SetIterationTime(outcome.seconds);
    if (const std::string message = fault(outcome, row, work.set, n, work.reference);
        !message.empty()) {
      state.SkipWithError(message.c_str());
      return;
    }
    if (!row.peer && !work.reference)
      work.reference = outcome;
    state.counters["cpu"] = outcome.cpu_seconds;
  }
}

std::vector<RoundRow> rows_of(const std::vector<Row>& rows, const std::shared_ptr<Workload>& work,
                              std::int64_t n, const Options& options) {
  std::vector<RoundRow> result;
  for (const Row& row : rows) {
    if (!row.only_set.empty() && row.only_set != work->set)
      continue;
    const auto run = [work, n, row, options](benchmark::State& state) {
      run_row(state, *work, n, row, options);
    };
    result.push_back({row.name, run, row.limit});
  }
  return result;
}

/// Registered in the order of execution; the sets alternate, too. The library's own row opens the
/// first round, as the reference for the peers.
void register_all(const Options& options) {
  const std::vector<Row> rows = make_rows(options);
  for (const std::int64_t n : options.sizes) {
    std::vector<std::shared_ptr<Workload>> works;
    for (const std::string& set : options.sets)
      works.push_back(std::make_shared<Workload>(Workload{set, {}, {}}));
    for (int round = 0; round < options.rounds; ++round)
      for (const auto& work : works)
        register_round(work->set, n, round, rows_of(rows, work, n, options));
  }
}

void add_options(CLI::App& app, Options& options) {
  add_list_option(app, "--sets", options.sets, "sets of sites: random, bisection, x8",
                  CLI::IsMember(cloud_names()));
  add_list_option(app, "--sizes", options.sizes, "numbers of sites", CLI::Range(4, 300000000));
  add_list_option(app, "--rows", options.rows,
                  "what to time: " + CLI::detail::join(row_names, ", "), CLI::IsMember(row_names));
  add_list_option(app, "--sweep", options.sweep,
                  "also time the library on these numbers of threads", CLI::PositiveNumber);
  add_round_options(app, options);
  app.add_option("--stripack-limit", options.stripack_limit,
                 "most sites that STRIPACK is given; it is slow beyond")
      ->capture_default_str();
  app.add_option("--qhull-limit", options.qhull_limit, "the same for Qhull")->capture_default_str();
  app.add_flag("--warm", options.warm,
               "before each of the library's runs, one that is not timed: beside peers that take "
               "half a minute, whose arrays are touched before their clock starts");
  app.add_flag("--fresh", options.fresh,
               "each run in a new process, whose memory no run has touched: what a command takes")
      ->excludes("--warm");
  add_geogram_option(app, options.built);
}

std::map<std::string, std::string> peers() {
  std::map<std::string, std::string> versions = {{"CGAL", CGAL_VERSION_STR}};
  if (has_stripack())
    versions["STRIPACK"] = "";
  if (has_qhull())
    versions["Qhull"] = qhull_version();
  return versions;
}

} // namespace
} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  return run_program(
      argc, argv,
      {"Times the library's Delaunay triangulation of the sphere and its peers, interleaved.",
       peers(), [&](CLI::App& app) { add_options(app, options); }, [&] { register_all(options); }});
}
