// SPDX-License-Identifier: GPL-3.0-or-later
#include "peers.h"
#include "delaunay/delaunay.h"

#include "stripack.h"

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <array>
#include <bit>
#include <future>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace calotte::bench {

namespace {

/// The finaliser of SplitMix64 (Steele, Lea, Flood, 2014).
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

} // namespace

void Digest::add(std::int32_t a, std::int32_t b, std::int32_t c) {
  while (a > b || a > c)
    std::tie(a, b, c) = std::tuple(b, c, a);
  const auto word = [](std::int32_t i) { return static_cast<std::uint64_t>(i) + 1; };
  sum_ += mix(mix(mix(word(a)) + word(b)) + word(c));
}

Outcome run_calotte(const Points3& points, int threads, const DelaunayOptions& options) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  Outcome outcome;
  Triangulation result;
  Points3 own = points; // handed over, as the command does; the peers' copies are not timed either
  const Stopwatch watch;
  arena.execute([&] { result = triangulate(std::move(own), Surface::sphere(), options); });
  watch.stop(outcome);
  const Mesh& mesh = result.mesh;
  outcome.sites = mesh.points.cols();
  outcome.triangles = mesh.triangles.cols();
  if (mesh.points.cols() != points.cols())
    outcome.failure = "the set holds equal directions; a comparison needs distinct ones";
  else if (!mesh.closed())
    outcome.failure = "the mesh is not closed";
  Digest digest;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    digest.add(mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t));
  outcome.digest = digest.value();
  return outcome;
}

Outcome run_side_by_side(const Points3& points, int threads) {
  std::vector<std::future<Outcome>> runs;
  for (int t = 0; t < threads; ++t)
    runs.push_back(std::async(std::launch::async, [&] { return run_calotte(points, 1); }));
  Outcome slowest = runs.front().get();
  for (auto run = runs.begin() + 1; run != runs.end(); ++run) {
    Outcome outcome = run->get();
    if (outcome.seconds > slowest.seconds)
      std::swap(outcome, slowest);
    if (slowest.failure.empty() && outcome.digest != slowest.digest)
      slowest.failure = "two runs at once made different triangles";
    if (slowest.failure.empty())
      slowest.failure = outcome.failure;
  }
  return slowest;
}

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>;
using Triangulation = CGAL::Delaunay_triangulation_on_sphere_2<Traits>;
using Point = Kernel::Point_3;

struct PointHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::uint64_t sum = 0;
    for (const double x : p)
      sum = mix(sum + std::bit_cast<std::uint64_t>(x));
    return sum;
  }
};

/// The digest of CGAL's triangles in the ids of `points`, which CGAL's vertices do not store.
std::uint64_t digest_of(const Triangulation& triangulation, const Points3& points) {
  std::unordered_map<std::array<double, 3>, std::int32_t, PointHash> ids;
  ids.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    ids.emplace(std::array{points(0, i), points(1, i), points(2, i)}, static_cast<std::int32_t>(i));
  Digest digest;
  for (const Triangulation::Face_handle face : triangulation.all_face_handles()) {
    if (face->is_ghost())
      continue;
    std::array<std::int32_t, 3> corner{};
    for (int i = 0; i < 3; ++i) {
      const Point& p = face->vertex(i)->point();
      corner[static_cast<std::size_t>(i)] = ids.at({p.x(), p.y(), p.z()});
    }
    digest.add(corner[0], corner[1], corner[2]);
  }
  return digest.value();
}

} // namespace

Outcome run_cgal(const Points3& points) {
  std::vector<Point> input;
  input.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    input.emplace_back(points(0, i), points(1, i), points(2, i));
  Outcome outcome;
  const Stopwatch watch;
  Triangulation triangulation(Point(0, 0, 0), 1);
  triangulation.insert(input.begin(), input.end());
  watch.stop(outcome);
  outcome.sites = static_cast<std::int64_t>(triangulation.number_of_vertices());
  outcome.triangles = static_cast<std::int64_t>(triangulation.number_of_solid_faces());
  outcome.digest = digest_of(triangulation, points);
  return outcome;
}

Outcome run_stripack(const Points3& points) {
  Stripack mesh(points.cols());
  mesh.x.assign(points.row(0).begin(), points.row(0).end());
  mesh.y.assign(points.row(1).begin(), points.row(1).end());
  mesh.z.assign(points.row(2).begin(), points.row(2).end());
  Outcome outcome;
  const Stopwatch watch;
  const int error = mesh.triangulate();
  watch.stop(outcome);
  if (error != 0) {
    outcome.failure = "TRMESH gave up with IER = " + std::to_string(error);
    return outcome;
  }
  outcome.sites = points.cols();
  Digest digest;
  mesh.for_each_triangle([&](std::int32_t a, std::int32_t b, std::int32_t c) {
    ++outcome.triangles;
    digest.add(a, b, c);
  });
  outcome.digest = digest.value();
  return outcome;
}

} // namespace calotte::bench
