// SPDX-License-Identifier: GPL-3.0-or-later
// Times one iteration of calotte::cvt from a bisected start beside one of a serial program around
// STRIPACK, in one process. All generators are compared; a difference ends in a message and exit
// code 1.

#include "clouds.h"
#include "program.h"
#include "stripack.h"

#include "base/clock.h"
#include "base/points.h"
#include "integrals/moments.h"

#include <calotte/grid.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace calotte::bench {

namespace {

/// Quadrature points on each half kite, where the density is not uniform; the same for all
/// programs.
constexpr int rule = 3;

/// Iterations of each of the library's runs. No measurement includes the first ones: they test the
/// start's mesh twice and use fresh memory.
constexpr int warm_up = 2, library_iterations = 12;

struct Options : RoundOptions {
  std::vector<std::string> rows = {"calotte", "one-thread", "stripack"};
  std::string order = "natural";
  std::vector<int> sweep;
  std::int64_t limit = 200000;
};

/// One set of sites and the data of its iterations; computed at first use.
struct Workload {
  std::int64_t n = 0;
  Density density;
  Points3 start;
  Points3 result;        ///< of the first of the library's runs
  Points3 before, after; ///< the library's generators around the first iteration that is timed
};

/// Lloyd's iterations, with the usual rule.
Recipe fixed_iterations(const Density& density, const Points3& start, int iterations) {
  return {.resolution = density,
          .start = {.points = start},
          .stop = {.iterations = iterations},
          .method = Method::lloyd};
}

const Points3& start_of(Workload& work, const Options& options) {
  if (work.start.cols() == 0)
    work.start =
        options.order == "shuffled" ? cloud("bisection", work.n) : natural_bisection(work.n);
  return work.start;
}

/// Medians of the iterations after the warm-up, and of their parts: restoring the Delaunay property
/// is the library's triangulation.
/// \param cpu CPU seconds at the end of each iteration.
Sample sample_of(const std::vector<CvtIteration>& iterations, const std::vector<double>& cpu,
                 int threads) {
  std::vector<double> seconds, cpu_seconds, repair, moments;
  for (std::size_t k = warm_up; k < iterations.size(); ++k) {
    seconds.push_back(iterations[k].seconds);
    cpu_seconds.push_back(cpu[k] - cpu[k - 1]);
    repair.push_back(iterations[k].seconds_repair / threads);
    moments.push_back(iterations[k].seconds_moments / threads);
  }
  return {median(seconds),
          {{"cpu", median(cpu_seconds)},
           {"triangulation", median(repair)},
           {"integration", median(moments)}},
          {}};
}

Sample run_library(Workload& work, const Options& options, int threads) {
  const Points3& start = start_of(work, options);
  const Stopwatch watch;
  std::vector<double> cpu;
  const auto note_cpu = [&](const Progress&) {
    cpu.push_back(watch.stop().cpu_seconds);
    return ProgressReply::proceed;
  };
  Cvt result;
  on_threads(threads, [&] {
    result = make_grid(fixed_iterations(work.density, start, library_iterations),
                       {.progress = note_cpu});
  });
  if (std::ssize(result.report.iterations) != library_iterations)
    throw std::runtime_error("the run ended after " +
                             std::to_string(result.report.iterations.size()) + " iterations");
  if (work.result.cols() == 0)
    work.result = result.mesh.points;
  if (result.mesh.points != work.result)
    throw std::runtime_error("other generators than the library's first run gave");
  return sample_of(result.report.iterations, cpu, threads);
}

/// The data of a serial program between iterations.
struct Serial {
  explicit Serial(std::int64_t n) : mesh(n), x(n), moments(n) {
    std::fill(x.begin(), x.end(), base_detail::Vec3{0, 0, 0});
    std::fill(moments.begin(), moments.end(), integrals_detail::CellMoments{{0, 0, 0}, 0});
    cells.owned = static_cast<std::int32_t>(n);
    cells.corners.resize(static_cast<std::size_t>(2 * n));
    suspects.reserve(static_cast<std::size_t>(2 * n));
  }

  Stripack mesh;
  base_detail::Array<base_detail::Vec3> x;
  base_detail::Array<integrals_detail::CellMoments> moments;
  integrals_detail::Patch cells; ///< the one region, whose local numbers are the sites'
  std::vector<std::int32_t> suspects;
};

/// STRIPACK's triangulation of the points as they are, its lists read off into triangles.
void triangulate(Serial& serial, const Points3& points) {
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    serial.x[i] = base_detail::column(points, i);
  serial.mesh.set_nodes(points);
  serial.mesh.triangulate();
  serial.cells.corners.clear();
  serial.mesh.for_each_triangle([&](std::int32_t a, std::int32_t b, std::int32_t c) {
    serial.cells.corners.push_back({a, b, c});
  });
}

/// The library's moments of the cells, and Lloyd's step: to M/|M|, M the integral of rho x over the
/// cell.
void step(Serial& serial, const integrals_detail::Integrand& integrand, Points3& next) {
  serial.suspects.clear();
  const integrals_detail::Generators<exact_detail::Sphere> sphere{{}, nullptr, serial.x.size()};
  integrals_detail::integrate(integrand, sphere, serial.cells, serial.x, {serial.moments},
                              serial.suspects);
  for (Eigen::Index i = 0; i < next.cols(); ++i) {
    const base_detail::Vec3& first = serial.moments[i].first;
    const base_detail::Vec3 centroid = (1 / domain_detail::norm(first)) * first;
    next.col(i) << centroid.x, centroid.y, centroid.z;
  }
}

/// \throws std::runtime_error if generators after one iteration of n from the same points differ by
/// more than rounding. The terms of a first moment have the size h of a cell, the moment has that
/// of its area h^2: rounding grows as 1/h, and at 163 842 sites is about 6 roundoffs over h.
void check(const Points3& found, const Points3& expected) {
  const double h = std::sqrt(4 * std::numbers::pi / static_cast<double>(found.cols()));
  const double tolerance = std::max(1e-13, 8 * 0x1p-53 / h);
  const double difference = (found - expected).colwise().norm().maxCoeff();
  if (difference <= tolerance)
    return;
  std::ostringstream message;
  message << "generators differ from the library's by " << difference
          << ", where rounding explains " << tolerance;
  throw std::runtime_error(message.str());
}

/// One iteration as a serial program would make it. All of it is timed from the points to the next
/// points, with all arrays allocated and touched before.
Sample run_serial(Workload& work, const Options& options) {
  if (work.before.cols() == 0) {
    const auto after = [&](const Points3& points, int iterations) {
      return make_grid(fixed_iterations(work.density, points, iterations)).mesh.points;
    };
    work.before = after(start_of(work, options), warm_up);
    work.after = after(work.before, 1);
  }
  const integrals_detail::Integrand integrand =
      integrals_detail::make_integrand(work.density, rule, 1);
  Serial serial(work.n);
  Points3 next = Points3::Zero(3, work.n);
  const Stopwatch watch;
  base_detail::Clock::time_point mark = base_detail::Clock::now();
  triangulate(serial, work.before);
  const double triangulation = base_detail::restart_clock(mark);
  step(serial, integrand, next);
  const double integration = base_detail::restart_clock(mark);
  Sample sample = bench::sample_of(watch.stop());
  sample.counters["triangulation"] = triangulation;
  sample.counters["integration"] = integration;
  check(next, work.after);
  return sample;
}

std::vector<Row> rows(const std::string& set, std::int64_t n, const Options& options) {
  const auto work = std::make_shared<Workload>(Workload{n, named_density(set), {}, {}, {}, {}});
  const auto library = [&](int threads) {
    return [=, &options] { return run_library(*work, options, threads); };
  };
  std::vector<Row> result;
  for (const int threads : options.sweep)
    result.push_back({threads_row(threads), library(threads)});
  for (const std::string& name : options.rows)
    if (name == "calotte")
      result.push_back({"calotte", library(options.threads)});
    else if (name == "one-thread")
      result.push_back({threads_row(1), library(1)});
    else if (has_stripack && n <= options.limit)
      result.push_back({"STRIPACK", [=, &options] { return run_serial(*work, options); }});
  return result;
}

void add_options(CLI::App& app, Options& options) {
  add_grid_options(app, options);
  app.add_option("--order", options.order,
                 "of the start: natural, coarse levels first, or shuffled; the library sorts them "
                 "anyway, STRIPACK is slower on shuffled ones")
      ->check(CLI::IsMember({"natural", "shuffled"}))
      ->capture_default_str();
  add_list_option(app, "--rows", options.rows, "what to time: calotte, one-thread, stripack",
                  CLI::IsMember({"calotte", "one-thread", "stripack"}));
  add_threads_option(app, options);
  add_list_option(app, "--sweep", options.sweep,
                  "also time the library on these numbers of threads", CLI::PositiveNumber);
  app.add_option("--limit", options.limit,
                 "maximum number of sites for STRIPACK, which is slow beyond")
      ->capture_default_str();
}

} // namespace

} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  options.sets = {"uniform", "x8"};
  options.sizes = {163842};
  std::map<std::string, std::string> peers;
  if (has_stripack)
    peers["STRIPACK"] = "";
  return run_program(
      argc, argv, options,
      {"Times one iteration of a centroidal Voronoi tessellation, interleaved with one of a serial "
       "program around STRIPACK.",
       peers, [&](CLI::App& app) { add_options(app, options); },
       [&](const std::string& set, std::int64_t n) { return rows(set, n, options); }});
}
