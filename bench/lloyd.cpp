// SPDX-License-Identifier: GPL-3.0-or-later
#include "lloyd.h"
#include "cvt/cvt.h"

#include "program.h"
#include "stripack.h"

#include "base/clock.h"
#include "base/points.h"
#include "integrals/moments.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <ctime>

namespace calotte::bench {

namespace {

/// CPU seconds of all threads so far.
double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Measurements of an iteration, summed over those after the warm-up.
struct Sums {
  double seconds = 0, exchange = 0, repair = 0, moments = 0;
};

Sums sums_of(const std::vector<CvtIteration>& iterations) {
  Sums sums;
  for (std::size_t k = warm_up; k < iterations.size(); ++k) {
    const CvtIteration& iteration = iterations[k];
    sums.seconds += iteration.seconds;
    sums.exchange += iteration.seconds_exchange;
    sums.repair += iteration.seconds_repair;
    sums.moments += iteration.seconds_moments;
  }
  return sums;
}

/// \param cpu CPU seconds at the end of each iteration.
void measure(const std::vector<CvtIteration>& iterations, const std::vector<double>& cpu,
             int threads, Iterated& out) {
  std::vector<double> seconds, cpu_seconds;
  for (std::size_t k = warm_up; k < iterations.size(); ++k) {
    seconds.push_back(iterations[k].seconds);
    cpu_seconds.push_back(cpu[k] - cpu[k - 1]);
  }
  const Sums sums = sums_of(iterations);
  out.seconds = median(seconds);
  const double ns = 1e9 * threads / static_cast<double>(out.points.cols());
  const double all = threads * sums.seconds;
  out.counters = {{"cpu", median(cpu_seconds)},
                  {"median ns", ns * out.seconds},
                  {"exchange", sums.exchange / all},
                  {"repair", sums.repair / all},
                  {"moments", sums.moments / all}};
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
  integrals_detail::Patch
      cells; ///< the one region that owns all sites: its local numbers are the sites'
  std::vector<std::int32_t> suspects;
};

void set_points(Serial& serial, const Points3& points) {
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const base_detail::Vec3& point = base_detail::column(points, i);
    serial.x[i] = point;
    serial.mesh.x[at] = point.x;
    serial.mesh.y[at] = point.y;
    serial.mesh.z[at] = point.z;
  }
}

/// Visits nodes in ascending order, so that the triangles need no sorting.
void read_triangles(Serial& serial) {
  serial.cells.corners.clear();
  serial.mesh.for_each_triangle([&](std::int32_t a, std::int32_t b, std::int32_t c) {
    serial.cells.corners.push_back({a, b, c});
  });
}

/// Lloyd's step: to M/|M|, M the integral of rho x over the cell.
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

} // namespace

CvtOptions fixed_iterations(const Target& target, int iterations) {
  CvtOptions options;
  options.density = target.density;
  options.method = Method::lloyd;
  options.norm = Norm::none;
  options.max_iterations = iterations;
  options.rule = options.final_rule = target.rule;
  return options;
}

Iterated run_cvt(const Points3& start, const Target& target, int iterations, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  std::vector<double> cpu;
  const CvtCallback note_cpu = [&](const CvtProgress&) {
    cpu.push_back(cpu_now());
    return false;
  };
  Cvt result;
  arena.execute([&] {
    result = cvt(start, Surface::sphere(), fixed_iterations(target, iterations), note_cpu);
  });
  Iterated out;
  out.points = std::move(result.mesh.points);
  if (std::ssize(result.report.iterations) != iterations) {
    out.failure = "the run ended after " + std::to_string(result.report.iterations.size()) +
                  " iterations of " + std::to_string(iterations);
    return out;
  }
  measure(result.report.iterations, cpu, threads, out);
  return out;
}

Iterated run_stripack_iteration(const Points3& points, const Target& target) {
  const std::int64_t n = points.cols();
  const integrals_detail::Integrand integrand =
      integrals_detail::make_integrand(target.density, target.rule, 1);
  Serial serial(n);
  Iterated out;
  out.points = Points3::Zero(3, n);
  const double cpu = cpu_now();
  base_detail::Clock::time_point mark = base_detail::Clock::now();
  set_points(serial, points);
  const int error = serial.mesh.triangulate();
  const double triangulate = base_detail::lap(mark);
  if (error != 0) {
    out.failure = "TRMESH gave up with IER = " + std::to_string(error);
    return out;
  }
  read_triangles(serial);
  const double lists = base_detail::lap(mark);
  step(serial, integrand, out.points);
  const double moments = base_detail::lap(mark);
  out.seconds = triangulate + lists + moments;
  out.counters = {{"cpu", cpu_now() - cpu},
                  {"median ns", 1e9 * out.seconds / static_cast<double>(n)},
                  {"triangulate", triangulate / out.seconds},
                  {"lists", lists / out.seconds},
                  {"moments", moments / out.seconds}};
  if (std::ssize(serial.cells.corners) != 2 * n - 4)
    out.failure = "TRMESH gave " + std::to_string(serial.cells.corners.size()) +
                  " triangles, where " + std::to_string(2 * n - 4) + " are due";
  return out;
}

double largest_distance(const Points3& a, const Points3& b) {
  return (a - b).colwise().norm().maxCoeff();
}

} // namespace calotte::bench
