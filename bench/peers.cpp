// SPDX-License-Identifier: GPL-3.0-or-later
#include "peers.h"

#include "stripack.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

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
  sum += mix(mix(mix(word(a)) + word(b)) + word(c));
  ++count;
}

Outcome run_calotte(const Points3& points, const Surface& surface, int threads,
                    const DelaunayOptions& options) {
  Outcome outcome;
  on_threads(threads, [&] {
    Triangulation result;
    if (surface.is_sphere()) {
      Points3 own = points; // handed over, as the command does
      const Stopwatch watch;
      result = triangulate(std::move(own), surface, options);
      outcome = {watch.stop(), {}};
    } else {
      const Points2 own = points.topRows<2>();
      const Stopwatch watch;
      result = triangulate(own, surface, options);
      outcome = {watch.stop(), {}};
    }
    for (const auto& t : result.mesh.triangles.colwise())
      outcome.triangles.add(t(0), t(1), t(2));
  });
  return outcome;
}

Outcome run_side_by_side(const Points3& points, const Surface& surface, int threads) {
  std::vector<std::future<Outcome>> runs;
  for (int t = 0; t < threads; ++t)
    runs.push_back(std::async(std::launch::async, [&] { return run_calotte(points, surface, 1); }));
  Outcome slowest;
  for (std::future<Outcome>& run : runs)
    if (const Outcome outcome = run.get(); outcome.seconds > slowest.seconds)
      slowest = outcome;
  return slowest;
}

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SphereTriangulation = CGAL::Delaunay_triangulation_on_sphere_2<
    CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>>;

struct PointHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::uint64_t sum = 0;
    for (const double x : p)
      sum = mix(sum + std::bit_cast<std::uint64_t>(x));
    return sum;
  }
};

/// CGAL's triangles in the ids of `points`, which CGAL's vertices do not store.
Digest digest_of(const SphereTriangulation& triangulation, const Points3& points) {
  std::unordered_map<std::array<double, 3>, std::int32_t, PointHash> ids;
  ids.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    ids.emplace(std::array{points(0, i), points(1, i), points(2, i)}, static_cast<std::int32_t>(i));
  Digest digest;
  for (const SphereTriangulation::Face_handle face : triangulation.all_face_handles()) {
    if (face->is_ghost())
      continue;
    const auto id = [&](int i) {
      const Point& p = face->vertex(i)->point();
      return ids.at({p.x(), p.y(), p.z()});
    };
    digest.add(id(0), id(1), id(2));
  }
  return digest;
}

} // namespace

Outcome run_cgal(const Points3& points) {
  std::vector<Point> input;
  input.reserve(static_cast<std::size_t>(points.cols()));
  for (const auto& p : points.colwise())
    input.emplace_back(p(0), p(1), p(2));
  const Stopwatch watch;
  SphereTriangulation triangulation(Point(0, 0, 0), 1);
  triangulation.insert(input.begin(), input.end());
  const Timed timed = watch.stop();
  return {timed, digest_of(triangulation, points)};
}

Outcome run_cgal_plane(const Points3& points) {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
  using Store = CGAL::Triangulation_data_structure_2<Vertex>;
  std::vector<std::pair<Kernel::Point_2, std::int32_t>> input;
  input.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    input.emplace_back(Kernel::Point_2(points(0, i), points(1, i)), static_cast<std::int32_t>(i));
  CGAL::Delaunay_triangulation_2<Kernel, Store> triangulation;
  const Stopwatch watch;
  triangulation.insert(input.begin(), input.end());
  Outcome outcome{watch.stop(), {}};
  for (const auto& face : triangulation.finite_face_handles())
    outcome.triangles.add(face->vertex(0)->info(), face->vertex(1)->info(),
                          face->vertex(2)->info());
  return outcome;
}

Outcome run_stripack(const Points3& points) {
  Stripack mesh(points.cols());
  mesh.set_nodes(points);
  const Stopwatch watch;
  mesh.triangulate();
  Outcome outcome{watch.stop(), {}};
  mesh.for_each_triangle(
      [&](std::int32_t a, std::int32_t b, std::int32_t c) { outcome.triangles.add(a, b, c); });
  return outcome;
}

} // namespace calotte::bench
