// SPDX-License-Identifier: GPL-3.0-or-later
// Times calotte::triangulate and its peers on the sphere and in the plane, in one process. Every
// result is checked; a wrong one ends in a message and exit code 1.

#include "clouds.h"
#include "peers.h"
#include "program.h"
#include "stripack.h"

#include <CGAL/version.h>

#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <type_traits>

namespace calotte::bench {

namespace {

const std::vector<std::string> row_names = {"calotte",          "one-thread", "one-region",
                                            "side-by-side",     "cgal",       "stripack",
                                            "stripack-natural", "qhull"};

struct Options : RoundOptions {
  std::vector<std::string> rows = {"calotte", "one-thread", "one-region", "cgal", "stripack"};
  std::vector<int> sweep;
  std::int64_t limit = 200000;
  bool warm = false, fresh = false;
  std::string pbbs, geogram;
};

/// The triangles of a peer compared with the library's. Peers decide by the stored doubles, the
/// library by the exact directions. On random sites the difference does not affect any decision; on
/// a bisected icosahedron it affects many, so that triangles are only counted there.
enum class Expected { same, as_many, all_but_at_hull };

struct Competitor {
  std::string name;
  std::function<Outcome(const Points3&)> run;
  bool ours = false;
  Expected expected = Expected::same;
};

/// The sites of one set, computed at first use, and the triangles of the library's first run.
struct Workload {
  std::string set;
  std::int64_t n = 0;
  Points3 points;
  std::optional<Digest> reference;
};

Competitor library(std::string name, const std::string& set, int threads,
                   std::optional<int> regions = {}) {
  DelaunayOptions options;
  options.decomposition.regions = regions;
  const Surface surface = in_plane(set) ? Surface::plane() : Surface::sphere();
  return {std::move(name),
          [=](const Points3& points) { return run_calotte(points, surface, threads, options); },
          true};
}

/// \returns nothing for a peer that is missing, takes fewer sites or is of the other surface.
std::optional<Competitor> competitor(const std::string& name, const std::string& set,
                                     std::int64_t n, const Options& options) {
  const int threads = options.threads;
  const bool plane = in_plane(set);
  const bool serial_hull = !plane && n <= options.limit;
  const Expected peers = set == "bisection" ? Expected::as_many : Expected::same;
  if (name == "calotte")
    return library(name, set, threads);
  if (name == "one-thread")
    return library(threads_row(1), set, 1);
  if (name == "one-region")
    return library("calotte one region", set, 1, 1);
  if (name == "side-by-side")
    return Competitor{"calotte side by side",
                      [=](const Points3& points) {
                        return run_side_by_side(
                            points, plane ? Surface::plane() : Surface::sphere(), threads);
                      },
                      true};
  if (name == "cgal")
    return Competitor{"CGAL", plane ? run_cgal_plane : run_cgal, false, peers};
  if (name == "stripack" && serial_hull && has_stripack)
    return Competitor{"STRIPACK", run_stripack, false, peers};
  if (name == "stripack-natural" && serial_hull && has_stripack && set == "bisection")
    return Competitor{
        "STRIPACK, natural order",
        [](const Points3& shuffled) { return run_stripack(natural_bisection(shuffled.cols())); },
        false, peers};
  if (name == "qhull" && serial_hull && !qhull_version().empty())
    return Competitor{"Qhull", run_qhull, false, peers};
  return {};
}

/// The rows asked for, then those of the user's own programs and of the sweep.
std::vector<Competitor> competitors(const std::string& set, std::int64_t n,
                                    const Options& options) {
  const bool plane = in_plane(set);
  std::vector<Competitor> result;
  for (const std::string& name : options.rows)
    if (std::optional<Competitor> found = competitor(name, set, n, options))
      result.push_back(std::move(*found));
  for (const int threads : {1, options.threads}) {
    const std::string suffix = threads == 1 ? " 1 thread" : "";
    if (plane && !options.pbbs.empty())
      result.push_back({"PBBS" + suffix,
                        [=, program = options.pbbs](const Points3& points) {
                          return run_pbbs(program, points, threads);
                        },
                        false, Expected::all_but_at_hull});
    if (!options.geogram.empty() && (threads == 1 || !plane)) // it is serial in the plane
      result.push_back({"geogram" + suffix, [=, program = options.geogram](const Points3& points) {
                          return run_geogram(program, points, plane, threads);
                        }});
  }
  for (const int threads : options.sweep)
    result.push_back(library(threads_row(threads), set, threads));
  return result;
}

/// Runs a triangulation in a new process, whose memory no earlier run has touched.
/// \pre this process has started no threads.
Outcome run_in_new_process(const std::function<Outcome()>& run) {
  static_assert(std::is_trivially_copyable_v<Outcome>);
  int ends[2];
  if (pipe(ends) != 0)
    throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    try {
      const Outcome outcome = run();
      _exit(write(ends[1], &outcome, sizeof outcome) == sizeof outcome ? 0 : 1);
    } catch (const std::exception& error) {
      std::cerr << error.what() << '\n';
      _exit(1);
    }
  }
  close(ends[1]);
  Outcome outcome;
  const bool received = child > 0 && read(ends[0], &outcome, sizeof outcome) == sizeof outcome;
  close(ends[0]);
  if (child > 0)
    waitpid(child, nullptr, 0);
  if (!received)
    throw std::runtime_error("the new process ended without a result");
  return outcome;
}

/// Runs a row as the options say: in a new process, or here, perhaps after a run that is not timed.
Outcome run_once(Workload& work, const Competitor& row, const Options& options) {
  if (options.fresh)
    return run_in_new_process([&] { return row.run(cloud(work.set, work.n)); });
  if (work.points.cols() == 0)
    work.points = cloud(work.set, work.n);
  if (options.warm && row.ours)
    row.run(work.points);
  return row.run(work.points);
}

/// \throws std::runtime_error if triangles are not the expected ones.
void check(const Digest& triangles, const Competitor& row, const Workload& work) {
  const std::int64_t count = triangles.count;
  if (!in_plane(work.set) && count != 2 * work.n - 4)
    throw std::runtime_error(std::to_string(count) + " triangles, where " +
                             std::to_string(2 * work.n - 4) + " are due");
  if (!work.reference)
    return;
  const std::int64_t due = work.reference->count;
  bool good = triangles == *work.reference;
  if (row.expected == Expected::as_many)
    good = count == due;
  else if (row.expected == Expected::all_but_at_hull)
    good = count <= due && 100 * count > 99 * due;
  if (!good)
    throw std::runtime_error("another set of triangles than the library's first run gave");
}

Sample measure(Workload& work, const Competitor& row, const Options& options) {
  const Outcome outcome = run_once(work, row, options);
  check(outcome.triangles, row, work);
  if (row.ours && !work.reference)
    work.reference = outcome.triangles;
  return sample_of(outcome);
}

/// The library's own row opens the first round, as the reference for the peers.
std::vector<Row> rows(const std::string& set, std::int64_t n, const Options& options) {
  const auto work = std::make_shared<Workload>(Workload{set, n, {}, {}});
  std::vector<Row> result;
  for (const Competitor& row : competitors(set, n, options))
    result.push_back({row.name, [=, &options] { return measure(*work, row, options); }});
  return result;
}

void add_options(CLI::App& app, Options& options) {
  add_list_option(app, "--sets", options.sets,
                  "sets of sites: random, bisection; of the plane: uniform, clusters, line",
                  CLI::IsMember(cloud_names()));
  add_list_option(app, "--sizes", options.sizes, "numbers of sites", CLI::Range(4, 300000000));
  add_list_option(app, "--rows", options.rows,
                  "what to time: " + CLI::detail::join(row_names, ", "), CLI::IsMember(row_names));
  add_threads_option(app, options);
  add_list_option(app, "--sweep", options.sweep,
                  "also time the library on these numbers of threads", CLI::PositiveNumber);
  app.add_option("--limit", options.limit,
                 "maximum number of sites for STRIPACK and Qhull, which are slow beyond")
      ->capture_default_str();
  app.add_flag("--warm", options.warm,
               "before each of the library's runs, one that is not timed: beside peers that take "
               "half a minute, whose arrays are touched before their clock starts");
  app.add_flag("--fresh", options.fresh,
               "each run in a new process, whose memory no run has touched: what a command takes")
      ->excludes("--warm");
  app.add_option("--pbbs", options.pbbs,
                 "also time this program of your own build in the plane: delaunay of PBBS' "
                 "incrementalDelaunay (github.com/cmuparlay/pbbsbench)")
      ->check(CLI::ExistingFile);
  app.add_option("--geogram", options.geogram,
                 "also time this program of your own build: compute_delaunay of geogram's "
                 "Delaunay_psm (github.com/BrunoLevy/geogram)")
      ->check(CLI::ExistingFile);
}

std::map<std::string, std::string> peers() {
  std::map<std::string, std::string> versions = {{"CGAL", CGAL_VERSION_STR}};
  if (has_stripack)
    versions["STRIPACK"] = "";
  if (!qhull_version().empty())
    versions["Qhull"] = qhull_version();
  return versions;
}

} // namespace
} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  options.sets = {"random"};
  options.sizes = {163842, 2621442};
  return run_program(
      argc, argv, options,
      {"Times the library's Delaunay triangulation and its peers, interleaved.", peers(),
       [&](CLI::App& app) { add_options(app, options); },
       [&](const std::string& set, std::int64_t n) { return rows(set, n, options); }});
}
