// SPDX-License-Identifier: GPL-3.0-or-later
#include "generators/boundary.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/mesh.h>
#include <calotte/multimesh.h>
#include <calotte/surface.h>
#include <calotte/voronoi.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

using namespace calotte;

namespace {

/// The edges of a mesh by another way: pairs of neighbours.
Pairs pairs_of(const Mesh& mesh) {
  const IdLists around = neighbours(mesh);
  std::vector<std::int32_t> ends;
  for (std::int32_t i = 0; i < around.size(); ++i) {
    std::vector<std::int32_t> higher;
    for (const std::int32_t j : around[i])
      if (j > i)
        higher.push_back(j);
    std::ranges::sort(higher);
    for (const std::int32_t j : higher)
      ends.insert(ends.end(), {i, j});
  }
  return Eigen::Map<const Pairs>(ends.data(), 2, std::ssize(ends) / 2);
}

bool is_connected(std::int64_t nodes, const Pairs& edges) {
  std::vector<std::int32_t> root(static_cast<std::size_t>(nodes));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t i) {
    while (root[static_cast<std::size_t>(i)] != i)
      i = root[static_cast<std::size_t>(i)] =
          root[static_cast<std::size_t>(root[static_cast<std::size_t>(i)])];
    return i;
  };
  std::int64_t parts = nodes;
  for (const auto& edge : edges.colwise()) {
    const std::int32_t a = find(edge[0]), b = find(edge[1]);
    parts -= a != b;
    root[static_cast<std::size_t>(a)] = b;
  }
  return parts == 1;
}

/// The laws of all multimeshes.
void check_laws(const Multimesh& made) {
  REQUIRE(made.edges.size() == made.meshes.size());
  REQUIRE(made.parents.cols() == made.points().cols());
  std::int64_t before = 0;
  for (std::size_t level = 0; level < made.meshes.size(); ++level) {
    CAPTURE(level);
    const Mesh& mesh = made.meshes[level];
    const std::int64_t n = mesh.points.cols();
    CHECK(n > before);
    CHECK(mesh.points == made.points().leftCols(n)); // to the bit
    CHECK(made.edges[level] == pairs_of(mesh));
    CHECK(is_connected(n, made.edges[level]));
    for (std::int64_t i = before; i < n; ++i) {
      const auto parents = made.parents.col(i);
      REQUIRE(parents.minCoeff() >= (level == 0 ? -1 : 0));
      REQUIRE(parents.maxCoeff() < std::max<std::int64_t>(before, level == 0 ? 0 : 1));
      REQUIRE((level == 0) == (parents[0] == parents[1]));
    }
    before = n;
  }
}

/// Parents of a run on the sphere are the two nearest nodes of the level before, by brute force.
void check_nearest(const Multimesh& made) {
  for (std::size_t level = 1; level < made.meshes.size(); ++level) {
    const std::int64_t before = made.meshes[level - 1].points.cols();
    for (std::int64_t i = before; i < made.meshes[level].points.cols(); ++i) {
      CAPTURE(i);
      const DoubleVector squares =
          (made.points().leftCols(before).colwise() - made.points().col(i)).colwise().squaredNorm();
      std::vector<double> sorted(squares.begin(), squares.end());
      std::ranges::sort(sorted);
      const auto parents = made.parents.col(i);
      CHECK(parents[0] != parents[1]);
      CHECK(std::abs(squares[parents[0]] - sorted[0]) < 1e-15);
      CHECK(std::abs(squares[parents[1]] - sorted[1]) < 1e-15);
    }
  }
}

/// The ratio of each cell's area to that demanded of it, 1 in the mean.
DoubleVector area_ratios(const Mesh& mesh, const DoubleVector& widths) {
  DoubleVector ratio = voronoi(mesh).cell_area.array() / widths.array().square();
  return ratio / ratio.mean();
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Checks the median of ratios in bins of equally many nodes by their widths.
void check_bins(const DoubleVector& ratio, const DoubleVector& widths, int bins, double within) {
  std::vector<std::int64_t> order(static_cast<std::size_t>(ratio.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::int64_t i) { return widths[i]; });
  const double all = quantile({ratio.begin(), ratio.end()}, 0.5);
  for (int bin = 0; bin < bins; ++bin) {
    std::vector<double> values;
    for (std::size_t k = order.size() * bin / bins; k < order.size() * (bin + 1) / bins; ++k)
      values.push_back(ratio[order[k]]);
    CAPTURE(bin);
    CHECK(std::abs(quantile(values, 0.5) / all - 1) < within);
  }
}

Density gentle_bump() { return tanh_bump({0, -0.8, 0.6}, 0.5, 0.3, 1.0 / 256); }

} // namespace

TEST_CASE("the multimesh of GraphCast") {
  const Multimesh six = multimesh(6);
  check_laws(six);
  CHECK(six.points().cols() == 40962);
  CHECK(2 * all_edges(six).cols() == 327660);
  for (int level = 0; level <= 6; ++level) {
    const Mesh& mesh = six.meshes[static_cast<std::size_t>(level)];
    CHECK(mesh.points.cols() == 10 * (1 << (2 * level)) + 2);
    CHECK(mesh.triangles == delaunay(mesh.points).triangles);
    std::int64_t fives = 0;
    const IdLists around = neighbours(mesh);
    for (std::int64_t i = 0; i < around.size(); ++i) {
      fives += around.count(i) == 5;
      REQUIRE((around.count(i) == 5 || around.count(i) == 6));
    }
    CHECK(fives == 12);
  }
  for (Eigen::Index i = 12; i < six.points().cols(); ++i) {
    const Eigen::Vector3d sum =
        six.points().col(six.parents(0, i)) + six.points().col(six.parents(1, i));
    REQUIRE((sum.normalized() - six.points().col(i)).norm() < 1e-15);
  }
}

TEST_CASE("a multimesh of the class III geodesics") {
  const Multimesh made = multimesh(2, geodesic_sphere(2, 1));
  check_laws(made);
  CHECK(made.meshes[0].points == geodesic_sphere(2, 1));
  CHECK(made.points().cols() == 16 * 70 + 2);
  CHECK(made.reports.empty());
  const Multimesh alone = multimesh(0, fibonacci_sphere(20));
  check_laws(alone);
  CHECK(all_edges(alone) == alone.edges[0]);
}

TEST_CASE("a multimesh follows a density at every level") {
  const Multimesh made = multimesh(3, {.cells = 16 * 4 * 300, .resolution = gentle_bump()});
  check_laws(made);
  CHECK(made.reports.size() == 4);
  for (const Mesh& mesh : made.meshes) {
    CAPTURE(mesh.points.cols());
    CHECK(mesh.triangles == delaunay(mesh.points).triangles);
    const DoubleVector widths = evaluate(gentle_bump(), mesh.points).array().pow(-0.25);
    const DoubleVector ratio = area_ratios(mesh, widths);
    check_bins(ratio, widths, 6, 0.05);
    CHECK(quantile({ratio.begin(), ratio.end()}, 0.01) > 0.8);
    CHECK(quantile({ratio.begin(), ratio.end()}, 0.99) < 1.2);
  }
  for (std::size_t k = 0; k + 1 < made.meshes.size(); ++k)
    CHECK(made.meshes[k + 1].points.cols() == 4 * made.meshes[k].points.cols() - 6);
  Multimesh again;
  tbb::task_arena(1).execute(
      [&] { again = multimesh(3, {.cells = 19200, .resolution = gentle_bump()}); });
  CHECK(again.points() == made.points());
  CHECK(again.parents == made.parents);
}

TEST_CASE("levels follow a density that the coarsest does not resolve") {
  const Density steep = tanh_bump({0, -0.8, 0.6}, 0.5, 0.2, 1.0 / 4096);
  const Multimesh made = multimesh(4, {.resolution = steep}, 42);
  check_laws(made);
  check_nearest(made);
  const Mesh& mesh = made.meshes.back();
  const DoubleVector widths = evaluate(steep, mesh.points).array().pow(-0.25);
  check_bins(area_ratios(mesh, widths), widths, 6, 0.07); // by bisections alone 0.1
}

TEST_CASE("a multimesh of a part of the sphere ends at its boundary, at every level") {
  const Surface region = circle({1, 0.2, 0.5}, 0.35);
  const Multimesh made = multimesh(3, {.resolution = Widths(60), .surface = region});
  check_laws(made);
  for (const CvtReport& report : made.reports)
    CHECK(report.off_boundary == 0);
  for (const Mesh& mesh : made.meshes) {
    CAPTURE(mesh.points.cols());
    const IdLists loops = boundary_loops(mesh);
    REQUIRE(loops.size() == 1);
    std::vector<char> outer(static_cast<std::size_t>(mesh.points.cols()), 0);
    for (const std::int32_t site : loops[0]) {
      outer[static_cast<std::size_t>(site)] = 1;
      const double angle =
          std::acos(mesh.points.col(site).dot(Eigen::Vector3d(1, 0.2, 0.5).normalized()));
      CHECK(std::abs(angle / 0.35 - 1) < 1e-3);
    }
    const DoubleVector ratio = area_ratios(mesh, DoubleVector::Ones(mesh.points.cols()));
    std::vector<double> inner;
    for (Eigen::Index i = 0; i < ratio.size(); ++i)
      if (outer[static_cast<std::size_t>(i)] == 0)
        inner.push_back(ratio[i]);
    const double median = quantile(inner, 0.5);
    CHECK(quantile(inner, 0.01) / median > 0.75);
    CHECK(quantile(inner, 0.99) / median < 1.25);
  }
}

TEST_CASE("generators of a boundary are nested, and those between them halve the gaps") {
  const Surface disc = circle({1, 0.2, 0.5}, 0.35),
                hole = Surface::plane().within(
                    {(DoubleMatrix(2, 4) << 0, 3, 3, 0, 0, 0, 3, 3).finished(),
                     (DoubleMatrix(2, 4) << 1, 1, 2, 2, 1, 2, 2, 1).finished()});
  for (const Surface& surface : {disc, hole}) {
    const auto levels = generators_detail::halved_boundary_points(surface, 300, {}, 3);
    REQUIRE(levels.size() == 4);
    CHECK(levels[0].points == boundary_points(surface, 300));
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
      const auto &coarse = levels[k], &fine = levels[k + 1];
      const auto b = static_cast<std::int32_t>(coarse.points.cols());
      REQUIRE(fine.points.cols() == 2 * b);
      CHECK(fine.points.leftCols(b) == coarse.points);
      for (std::int32_t i = 0; i < b; ++i) {
        const std::int32_t middle = fine.next[i];
        REQUIRE(middle >= b);
        REQUIRE(fine.next[middle] == coarse.next[i]);
        const double before = (fine.points.col(middle) - fine.points.col(i)).norm(),
                     after = (fine.points.col(coarse.next[i]) - fine.points.col(middle)).norm();
        REQUIRE(std::abs(after / before - 1) < 0.02);
      }
    }
  }
  CHECK(generators_detail::halved_boundary_points({}, 300, {}, 2).back().points.cols() == 0);
}

TEST_CASE("multimeshes of planes") {
  check_laws(multimesh(2, {.cells = 1600, .surface = Surface::periodic({2, 1})}));
  check_laws(multimesh(2, {.cells = 1600,
                           .surface = Surface::plane().within(
                               {(DoubleMatrix(2, 4) << 0, 2, 2, 0, 0, 0, 1, 1).finished()})}));
}

TEST_CASE("what a multimesh refuses, in one line") {
  const auto refused = [](const auto& make) {
    try {
      make();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  CHECK(refused([] { multimesh(-1); }) == "the finest level is -1; give 0 to 13");
  CHECK(refused([] { multimesh(14); }) == "the finest level is 14; give 0 to 13");
  CHECK(refused([] { multimesh(13, fibonacci_sphere(100)); }) ==
        "13 bisections of 100 nodes give more than 1073741824; give fewer");
  Points3 twice = fibonacci_sphere(20);
  twice.col(7) = twice.col(3);
  CHECK(refused([&] { multimesh(1, twice); }).find("7") != std::string::npos);
  twice(1, 7) = std::nan("");
  CHECK(refused([&] { multimesh(1, twice); }).find("7") != std::string::npos);
  CHECK(refused([] { multimesh(1, Points3(3, 0)); }) != "nothing");
  CHECK(refused([] { multimesh(1, Points3(fibonacci_sphere(100).cwiseAbs())); }) ==
        "the coarsest nodes are within a hemisphere, so that their mesh is open; give nodes all "
        "round the sphere");
  CHECK(refused([] { multimesh(1, {.cells = 642}, 162); }) ==
        "there are 162 nodes of the coarsest level and 642 of the finest; give one of them");
  CHECK(refused([] {
          multimesh(3, {.resolution = Widths(3000)});
        }).find("leave 3 at the coarsest") != std::string::npos);
  const Surface strip = box(-0.7, 0.77, 1.05, 0.87);
  CHECK(refused([&] {
          multimesh(3, {.resolution = Widths(100), .surface = strip});
        }).find("give fewer levels or more nodes") != std::string::npos);
  CHECK(refused([] { multimesh(3, Recipe{}); }).find("there is no number of nodes") == 0);
  CHECK(refused([] {
          multimesh(13, {.resolution = gentle_bump()}, 642);
        }).find("13 bisections of 642") == 0);
}
