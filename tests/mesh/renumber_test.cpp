// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "mesh/renumber.h"
#include "support/clouds.h"
#include "support/errors.h"
#include "support/laws.h"
#include "support/random.h"
#include "support/shuffled.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

using calotte::Mesh;
using calotte::Numbering;
using calotte::Points3;
using calotte::Triangles;
using namespace calotte::test;

namespace {

/// The small sets, and two larger ones.
std::vector<Cloud> clouds() {
  std::vector<Cloud> out = small_clouds();
  out.push_back({"random 700", calotte::random_sphere(700, 1)});
  out.push_back({"half of 300", upper_half(300, 3), false});
  return out;
}

/// The new index of each site of `mesh`: sites are distinct directions and keep their bits.
std::vector<std::int32_t> where(const Mesh& mesh, const Mesh& moved) {
  std::vector<std::int32_t> to(std::size_t(mesh.points.cols()), -1);
  for (std::size_t i = 0; i < mesh.site_of_input.size(); ++i)
    to[std::size_t(mesh.site_of_input[i])] = moved.site_of_input[i];
  return to;
}

} // namespace

TEST_CASE("a renumbered mesh is that of the points in their new order") {
  for (const auto& [name, points, closed, ties, sites] : clouds()) {
    CAPTURE(name);
    const Mesh mesh = calotte::delaunay(points);
    const Mesh moved = calotte::renumbered(mesh, Numbering::curve);
    const std::vector<std::int32_t> to = where(mesh, moved);
    CHECK(std::is_permutation(to.begin(), to.end(), where(mesh, mesh).begin()));
    Mesh expected = renumbered(mesh, to);
    expected.site_of_input = moved.site_of_input;
    CHECK(identical(moved, expected));
    CHECK(same_bits(moved.triangles, calotte::delaunay(moved.points).triangles));
    for (std::size_t i = 0; i < to.size(); ++i)
      REQUIRE(same_bits(moved.points.col(to[i]).eval(), mesh.points.col(Eigen::Index(i)).eval()));
  }
}

TEST_CASE("input keeps a mesh, and one along the curve stays as it is") {
  for (const auto& [name, points, closed, ties, sites] : clouds()) {
    CAPTURE(name);
    const Mesh mesh = calotte::delaunay(points);
    CHECK(identical(calotte::renumbered(mesh, Numbering::input), mesh));
    const Mesh ordered = calotte::renumbered(mesh, Numbering::curve);
    CHECK(identical(calotte::renumbered(ordered, Numbering::curve), ordered));
  }
}

TEST_CASE("is_in_curve_order() is true exactly if renumbering would not change the mesh") {
  Random random(7);
  const auto check = [](const Mesh& mesh) {
    CHECK(calotte::mesh_detail::is_in_curve_order(mesh) ==
          identical(calotte::renumbered(mesh, Numbering::curve), mesh));
  };
  std::vector<Cloud> sets = clouds();
  sets.push_back({"of three blocks", calotte::random_sphere(40'000, 8)});
  for (const auto& [name, points, closed, ties, sites] : sets) {
    CAPTURE(name);
    const Mesh mesh = calotte::delaunay(points);
    check(mesh);
    const Mesh ordered = calotte::renumbered(mesh, Numbering::curve);
    CHECK(calotte::mesh_detail::is_in_curve_order(ordered));
    Mesh other = ordered;
    shuffle_triangles(other.triangles, other.neighbours, random);
    check(other);
    other = ordered; // only its last two triangles are exchanged
    const Eigen::Index last = other.triangles.cols() - 1;
    other.triangles.col(last).swap(other.triangles.col(last - 1));
    check(other);
    for (const Eigen::Index i : {Eigen::Index{0}, ordered.points.cols() / 2}) {
      other = ordered; // two sites are exchanged
      other.points.col(i).swap(other.points.col(i + 1));
      check(other);
    }
  }
  check({});
}

TEST_CASE("the result does not depend on the order of the triangles") {
  Random random(5);
  for (const auto& [name, points, closed, ties, sites] : clouds()) {
    CAPTURE(name);
    const Mesh mesh = calotte::delaunay(points);
    Mesh shuffled = mesh;
    shuffle_triangles(shuffled.triangles, shuffled.neighbours, random);
    const Mesh moved = calotte::renumbered(shuffled, Numbering::curve);
    require_canonical(moved);
    require_whole(moved, mesh.closed());
    CHECK(identical(moved, calotte::renumbered(mesh, Numbering::curve)));
  }
}

TEST_CASE("along the curve neighbours in memory are neighbours in space") {
  const Mesh mesh =
      calotte::renumbered(calotte::delaunay(calotte::random_sphere(5000, 2)), Numbering::curve);
  const double spacing = std::sqrt(4 * std::numbers::pi / 5000);
  double sum = 0;
  for (int i = 1; i < 5000; ++i)
    sum += (mesh.points.col(i) - mesh.points.col(i - 1)).norm();
  CHECK(sum / 5000 < 2 * spacing); // at random it is 4/3, some 27 spacings
}

TEST_CASE("soups: sites without triangles, repeated vertices, and edges of three triangles") {
  Mesh raw;
  raw.points = calotte::random_sphere(9, 4);
  raw.triangles.resize(3, 7);
  raw.triangles << 0, 0, 1, 7, 3, 0, 2, //
      1, 1, 0, 7, 3, 1, 0,              //
      2, 3, 4, 5, 3, 2, 1;
  raw.neighbours = Triangles::Constant(3, 7, -1);
  raw.neighbours(2, 1) = 2;
  raw.neighbours(2, 2) = 1;
  for (int i = 0; i < 9; ++i)
    raw.site_of_input.push_back(i);
  const Mesh moved = calotte::renumbered(raw, Numbering::curve);
  const std::vector<std::int32_t> to = where(raw, moved);
  std::vector<Triple> expected, found;
  for (Eigen::Index t = 0; t < 7; ++t) {
    Triple ids{};
    for (int i = 0; i < 3; ++i)
      ids[std::size_t(i)] = to[std::size_t(raw.triangles(i, t))];
    Triple lowest = ids;
    for (int i = 0; i < 3; ++i) {
      std::rotate(ids.begin(), ids.begin() + 1, ids.end());
      lowest = std::min(lowest, ids);
    }
    expected.push_back(lowest);
    found.push_back(triple(moved, t));
  }
  CHECK(std::is_sorted(found.begin(), found.end()));
  std::sort(expected.begin(), expected.end());
  CHECK(found == expected);
  for (Eigen::Index t = 0; t < 7; ++t)
    for (int i = 0; i < 3; ++i)
      if (const std::int32_t u = moved.neighbours(i, t); u >= 0)
        CHECK((moved.neighbours.col(u).array() == t).any());
  CHECK((moved.neighbours.array() >= 0).count() == 2);
  CHECK(identical(calotte::renumbered(moved, Numbering::curve), moved));
}

TEST_CASE("the order does not depend on the number of threads") {
  const Mesh mesh = calotte::delaunay(calotte::random_sphere(40'000, 6));
  const auto with = [&](int threads) {
    return tbb::task_arena(threads).execute(
        [&] { return calotte::renumbered(mesh, Numbering::curve); });
  };
  CHECK(identical(with(1), with(3)));
}

TEST_CASE("ids out of range and points without a direction are refused") {
  const Mesh mesh = calotte::delaunay(octahedron());
  const auto code = [](const Mesh& bad) {
    return code_of([&] { calotte::renumbered(bad, Numbering::curve); });
  };
  for (const std::int32_t id : {-1, 6}) {
    Mesh bad = mesh;
    bad.triangles(1, 3) = id;
    CHECK(code(bad) == calotte::ErrorCode::invalid_argument);
    bad = mesh;
    bad.site_of_input[2] = id;
    CHECK(code(bad) == calotte::ErrorCode::invalid_argument);
  }
  Mesh bad = mesh;
  bad.neighbours(0, 0) = 8;
  CHECK(code(bad) == calotte::ErrorCode::invalid_argument);
  bad.neighbours.resize(3, 0);
  CHECK(code(bad) == calotte::ErrorCode::invalid_argument);
  bad = mesh;
  bad.points.col(2).setZero();
  CHECK(!calotte::mesh_detail::is_in_curve_order(bad));
  CHECK(code(bad) == calotte::ErrorCode::zero_vector);
  bad.points(1, 2) = std::nan("");
  CHECK(!calotte::mesh_detail::is_in_curve_order(bad));
  CHECK(code(bad) == calotte::ErrorCode::not_finite);
  CHECK(calotte::renumbered({}, Numbering::curve).points.cols() == 0);
}
