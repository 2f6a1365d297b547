// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the largest sets that one machine's memory allows: a triangulation of many random sites,
// its check, and some iterations of a CVT from there, with the peak memory and the time of each
// stage. A small set is triangulated first, as the reference for the time per site: its first
// triangulation compares with the first of the many sites, both in memory that is mostly new to the
// process; later ones compare with a second.

#include "cvt/cvt.h"
#include "delaunay/delaunay.h"

#include <calotte/check.h>
#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte::bench {

namespace {

constexpr double gib = 1024.0 * 1024 * 1024;
constexpr std::uint64_t seed = 20130923;
using Json = nlohmann::ordered_json;

struct Options {
  std::vector<std::int64_t> sizes = {10000000, 30000000, 100000000};
  std::int64_t base = 2621442;
  int base_runs = 3;
  int iterations = 3;
  int threads = 2;
  double limit = 24; ///< GiB
  std::string json;
};

/// The process's peak of resident memory since reset_peak(), bytes.
std::int64_t peak() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (std::int64_t kib = 0; word == "VmHWM:" && status >> kib) {
      return kib * 1024;
    }
  }
  return 0;
}

/// If the system does not support a reset, peaks count from the start; they do not decrease,
/// because the sizes ascend.
void reset_peak() { std::ofstream("/proc/self/clear_refs") << '5'; }

/// The time and memory of a stage.
struct Cost {
  double seconds = 0;
  std::int64_t peak = 0; ///< bytes
};

template <class Stage> Cost cost_of(const Stage& stage) {
  using Clock = std::chrono::steady_clock;
  reset_peak();
  const Clock::time_point start = Clock::now();
  stage();
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return {seconds, peak()};
}

double ns_a_site(double seconds, std::int64_t sites) {
  return 1e9 * seconds / static_cast<double>(sites);
}

Json to_json(const Cost& cost, std::int64_t sites) {
  return {{"seconds", cost.seconds},
          {"ns_a_site", ns_a_site(cost.seconds, sites)},
          {"peak_bytes", cost.peak},
          {"bytes_a_site", static_cast<double>(cost.peak) / static_cast<double>(sites)}};
}

void print(const char* stage, const Cost& cost, std::int64_t sites) {
  std::printf("| %s | %.2f | %.0f | %.2f | %.0f |\n", stage, cost.seconds,
              ns_a_site(cost.seconds, sites), static_cast<double>(cost.peak) / gib,
              static_cast<double>(cost.peak) / static_cast<double>(sites));
  std::fflush(stdout);
}

void print_part(const char* stage, double seconds, std::int64_t sites) {
  std::printf("| - %s | %.2f | %.0f | | |\n", stage, seconds, ns_a_site(seconds, sites));
}

/// Triangulates and reports the cost; the mesh stays alive.
Cost triangulation(Points3 points, Mesh& mesh, DelaunayReport* report = nullptr) {
  return cost_of([&] {
    Triangulation result = triangulate(std::move(points), Surface::sphere());
    mesh = std::move(result.mesh);
    if (report != nullptr)
      *report = std::move(result.report);
  });
}

/// The small set, the reference for the time per site of a large one. Its first triangulation
/// faults in memory, as that of a larger set does, and starts the threads; later ones do not.
class Base {
public:
  explicit Base(const Options& options)
      : sites_(options.base), runs_(options.base_runs), first_(run()) {}

  std::int64_t sites() const { return sites_; }
  double first() const { return first_; } ///< ns a site

  /// The median of some more, ns a site.
  double later() const {
    std::vector<double> times;
    for (int i = 0; i < runs_; ++i)
      times.push_back(run());
    const auto middle = times.begin() + std::ssize(times) / 2;
    std::nth_element(times.begin(), middle, times.end());
    return *middle;
  }

private:
  double run() const {
    Mesh mesh;
    return ns_a_site(triangulation(random_sphere(sites_, seed), mesh).seconds, sites_);
  }

  std::int64_t sites_;
  int runs_;
  double first_;
};

Json stages(const DelaunayReport& report, std::int64_t n) {
  const DelaunayReport::Seconds& seconds = report.seconds;
  const std::vector<std::pair<const char*, double>> parts{{"sites", seconds.sites},
                                                          {"regions", seconds.regions},
                                                          {"triangulate", seconds.triangulate},
                                                          {"unite", seconds.unite}};
  Json json;
  for (const auto& [name, value] : parts) {
    print_part(name, value, n);
    json[name] = value;
  }
  return json;
}

/// The laws hold, and every point is a site.
std::string fault(const Check& check, std::int64_t n) {
  if (!check.passed()) {
    return check.failure;
  }
  if (check.sites != n || check.boundary_edges != 0) {
    return "the mesh is not a closed one of all points";
  }
  return {};
}

/// Checks a mesh and reports the cost; false if a law is violated.
bool prove(const Mesh& mesh, std::int64_t n, const char* name, Json& json) {
  Check check;
  const Cost cost = cost_of([&] { check = calotte::check(mesh); });
  print(name, cost, n);
  const std::string failure = fault(check, n);
  json["check"] = to_json(cost, n);
  json["check"]["failure"] = failure;
  json["check"]["triangles"] = check.triangles;
  json["check"]["area"] = check.area;
  if (!failure.empty()) {
    std::cerr << "scale_bench: " << n << " sites, " << name << ": " << failure << '\n';
  }
  return failure.empty();
}

/// Measures that the library computes of a mesh; meshes of the same points have the same values.
std::size_t fingerprint(const Mesh& mesh) {
  const auto bytes = [](const auto& matrix) {
    return std::string_view(reinterpret_cast<const char*>(matrix.data()),
                            static_cast<std::size_t>(matrix.size()) * sizeof(*matrix.data()));
  };
  const std::hash<std::string_view> hash;
  return hash(bytes(mesh.triangles)) + 3 * hash(bytes(mesh.neighbours));
}

/// Compares the time a site with the small set's: first with first, again with later.
void compare(std::int64_t n, double first, double again, const Base& base, double later,
             Json& json) {
  std::printf("\n| ns a site | the first time | again |\n| --- | --: | --: |\n"
              "| %lld sites | %.0f | %.0f |\n| %lld sites | %.0f | %.0f |\n"
              "| times as long | %.2f | %.2f |\n",
              static_cast<long long>(base.sites()), base.first(), later, static_cast<long long>(n),
              first, again, first / base.first(), again / later);
  json["base"] = {
      {"sites", base.sites()}, {"first_ns_a_site", base.first()}, {"again_ns_a_site", later}};
  json["relative_first"] = first / base.first();
  json["relative_again"] = again / later;
}

bool triangulate(std::int64_t n, const Base& base, Json& json) {
  Mesh mesh;
  DelaunayReport report;
  const Cost first = triangulation(random_sphere(n, seed), mesh, &report);
  print("triangulation", first, n);
  Json& out = json["triangulation"] = to_json(first, n);
  out["stages"] = stages(report, n);
  out["regions"] = report.regions;
  out["overlap"] = report.overlap;
  bool good = prove(mesh, n, "its check", out);
  print_part("both", first.seconds + out["check"]["seconds"].get<double>(), n);
  // The host of a virtual machine may reclaim free memory for some seconds, so that the mesh is
  // freed last.
  Points3 points = random_sphere(n, seed);
  const std::size_t proved = fingerprint(mesh);
  const double later = base.later();
  mesh = Mesh();
  const Cost again = triangulation(std::move(points), mesh);
  print("the same triangulation again", again, n);
  if (fingerprint(mesh) != proved) {
    std::cerr << "scale_bench: " << n << " sites: the same points gave another mesh\n";
    good = false;
  }
  out["again"] = to_json(again, n);
  compare(n, ns_a_site(first.seconds, n), ns_a_site(again.seconds, n), base, later, out);
  return good;
}

bool iterate(std::int64_t n, const Options& options, Json& json) {
  std::printf(
      "\n| stage | s | ns a site | peak GiB | bytes a site |\n| --- | --: | --: | --: | --: "
      "|\n");
  Points3 points = random_sphere(n, seed);
  Cvt grid;
  const Cost cost = cost_of([&] {
    grid = cvt(std::move(points), Surface::sphere(),
               {.method = Method::lloyd, .norm = Norm::none, .max_iterations = options.iterations});
  });
  print("CVT, with two triangulations", cost, n);
  Json& out = json["cvt"] = to_json(cost, n);
  for (const CvtIteration& iteration : grid.report.iterations) {
    print_part("an evaluation", iteration.seconds, n);
    out["iterations"].push_back({{"seconds", iteration.seconds},
                                 {"seconds_repair", iteration.seconds_repair},
                                 {"seconds_moments", iteration.seconds_moments},
                                 {"flips", iteration.flips},
                                 {"rebuilt", iteration.rebuilt},
                                 {"energy", iteration.energy}});
  }
  return prove(grid.mesh, n, "its check", out);
}

/// One number of sites; false when a law is broken.
bool run(std::int64_t n, const Options& options, const Base& base, Json& json) {
  std::printf("\n## %lld random sites, %d threads\n\n| stage | s | ns a site | peak GiB | bytes a "
              "site |\n| --- | --: | --: | --: | --: |\n",
              static_cast<long long>(n), options.threads);
  json = {{"sites", n}, {"threads", options.threads}};
  bool good = triangulate(n, base, json);
  if (options.iterations > 0) {
    good = iterate(n, options, json) && good;
  }
  return good;
}

/// Limits memory, so that excess ends in bad_alloc before the system ends the process.
void limit_memory(double limit) {
  const auto bytes = static_cast<rlim_t>(limit * gib);
  const rlimit data{bytes, bytes};
  setrlimit(RLIMIT_DATA, &data);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("sites", options.sizes, "numbers of sites")
      ->check(CLI::Range(std::int64_t{12}, std::int64_t{1} << 30))
      ->capture_default_str();
  app.add_option("--iterations", options.iterations, "of Lloyd's method; 0 for none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--base", options.base, "sites of the set that times a site are compared with")
      ->check(CLI::Range(4, 1 << 30))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "threads")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--limit", options.limit, "GiB of memory that may be taken")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--json", options.json, "write the numbers to this file, too");
  app.footer("Exit codes: 0 done, 1 a law was broken or memory too small, 2 bad usage.");
}

} // namespace

int scale_main(int argc, char** argv) {
  Options options;
  CLI::App app{"Triangulates, checks and iterates over many random sites: time and memory."};
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  limit_memory(options.limit);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(options.threads));
  tbb::task_arena arena(options.threads);
  std::sort(options.sizes.begin(), options.sizes.end());
  const auto keep = [&](const Json& all) {
    if (!options.json.empty() && !(std::ofstream(options.json) << all.dump(2) << std::endl))
      throw std::runtime_error(options.json + " cannot be written: give --json another place");
  };
  bool good = true;
  Json all = Json::array();
  keep(all); // a place that does not serve is known before the work
  const Base base = arena.execute([&] { return Base(options); });
  for (const std::int64_t n : options.sizes) {
    all.emplace_back();
    good = arena.execute([&] { return run(n, options, base, all.back()); }) && good;
    keep(all);
  }
  return good ? 0 : 1;
}

} // namespace calotte::bench

int main(int argc, char** argv) {
  try {
    return calotte::bench::scale_main(argc, argv);
  } catch (const std::bad_alloc&) {
    std::cerr << "scale_bench: the memory that --limit allows is too small\n";
  } catch (const std::exception& error) {
    std::cerr << "scale_bench: " << error.what() << '\n';
  }
  return 1;
}
