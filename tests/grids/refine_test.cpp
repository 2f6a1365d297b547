// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/files.h"
#include "support/text.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/locate.h>
#include <calotte/mesh.h>
#include <calotte/quality.h>
#include <calotte/refine.h>
#include <calotte/rotation.h>
#include <calotte/voronoi.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace calotte;

namespace {

const Mesh& uniform_sphere() {
  static const Mesh mesh = make_grid({.cells = 10242}).mesh;
  return mesh;
}

WidthDemand in_circle(const Eigen::Vector3d& centre, double radius, double factor) {
  WidthDemand demand;
  demand.region = circle(centre, radius);
  demand.factor = factor;
  return demand;
}

/// Sites that stay keep their bits and their order, before the new ones, and the mesh is the
/// Delaunay triangulation of all.
void expect_changed(const Mesh& old, const ChangedMesh& changed) {
  const Eigen::Index n = old.points.cols(), m = changed.mesh.points.cols();
  REQUIRE(changed.new_of_old.size() == n);
  REQUIRE(changed.old_of_new.size() == m);
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    if (const std::int32_t id = changed.new_of_old[i]; id >= 0) {
      REQUIRE(id == kept++);
      REQUIRE(changed.old_of_new[id] == i);
      REQUIRE(changed.mesh.points.col(id) == old.points.col(i));
    }
  CHECK((changed.old_of_new.head(kept).array() >= 0).all());
  CHECK((changed.old_of_new.tail(m - kept).array() == -1).all());
  std::int64_t removed = 0, added = 0;
  for (const ChangedPatch& patch : changed.patches) {
    removed += patch.removed;
    added += patch.added;
  }
  CHECK(kept >= n - removed); // those of a step may go in the next
  CHECK(m - n == added - removed);
  CHECK(changed.mesh.site_of_input.size() == static_cast<std::size_t>(m));
}

/// The mean distance of the site nearest to a place from its neighbours.
double spacing_near(const Mesh& mesh, const Eigen::Vector3d& place) {
  const std::int32_t site = locate(mesh, Points3(place)).nearest[0];
  double sum = 0;
  int count = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.triangles(i, t) == site) {
        sum += (mesh.points.col(mesh.triangles((i + 1) % 3, t)) - mesh.points.col(site)).norm();
        ++count;
      }
  return sum / count;
}

void expect_delaunay(const Mesh& mesh) {
  const Mesh anew = delaunay(mesh.points, mesh.surface);
  CHECK(anew.triangles == mesh.triangles);
  CHECK(anew.neighbours == mesh.neighbours);
}

/// As a whole new grid must be.
void expect_good_shapes(const ChangedMesh& changed) {
  for (const ChangedPatch& patch : changed.patches) {
    CHECK(patch.report.converged);
    CHECK(patch.report.well_centred);
  }
  const Quality q = quality(changed.mesh);
  CHECK(q.obtuse == 0);
  CHECK(q.angles.min > 38);
  CHECK(q.angles.max < 89);
}

/// The mean length of the edges within a circle.
double mean_edge(const Mesh& mesh, const Eigen::Vector3d& centre, double radius) {
  double sum = 0;
  int count = 0;
  for (const auto& triangle : mesh.triangles.colwise())
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d a = mesh.points.col(triangle(i)),
                            b = mesh.points.col(triangle((i + 1) % 3));
      if ((a - centre.normalized()).norm() < radius) {
        sum += (a - b).norm();
        ++count;
      }
    }
  return sum / count;
}

std::vector<std::array<double, 3>> sorted_points(const Mesh& mesh) {
  std::vector<std::array<double, 3>> points;
  for (const auto& x : mesh.points.colwise())
    points.push_back({x(0), x(1), x(2)});
  std::sort(points.begin(), points.end());
  return points;
}

/// A regular lattice of triangles in a rectangle; in a box, one that is periodic.
Mesh lattice(bool periodic) {
  constexpr int columns = 60, rows = 52;
  const double height = std::sqrt(0.75);
  Points2 points(2, columns * rows);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      points.col(r * columns + c) << c + 0.25 + 0.5 * (r % 2), (r + 0.5) * height;
  return delaunay(std::move(points),
                  periodic ? Surface::periodic({columns, rows * height}) : Surface::plane());
}

Surface square(double x, double y, double side) {
  return rectangle({x - side / 2, y - side / 2}, {x + side / 2, y + side / 2});
}

/// A sea with a wavy coast and an island, in which cells are 0.04 wide.
const Mesh& wavy_sea() {
  static const Mesh mesh = [] {
    const auto ring = [](int corners, double sign, const auto& radius) {
      Points2 lonlat(2, corners);
      for (int k = 0; k < corners; ++k) {
        const double at = sign * 2 * std::numbers::pi * k / corners;
        lonlat.col(k) << 40 + radius(at) * std::cos(at), 5 + radius(at) * std::sin(at);
      }
      return DoubleMatrix(from_lonlat(lonlat));
    };
    Recipe recipe;
    recipe.surface =
        Surface::sphere().within({ring(300, 1, [](double at) { return 20 + 3 * std::cos(4 * at); }),
                                  ring(40, -1, [](double) { return 5; })});
    recipe.boundary = Boundary::generators;
    recipe.cells = 300;
    return make_grid(recipe).mesh;
  }();
  return mesh;
}

/// The largest distance of sites of a mesh's boundary from the boundary of another mesh.
double from_boundary(const Mesh& of, const Mesh& other) {
  double most = 0;
  const IdLists loops = boundary_loops(other);
  for (const std::int32_t site : boundary_loops(of).items) {
    const Eigen::Vector3d x = of.points.col(site);
    double least = 10;
    for (std::int64_t loop = 0; loop < loops.size(); ++loop)
      for (std::size_t k = 0; k < loops[loop].size(); ++k) {
        const Eigen::Vector3d a = other.points.col(loops[loop][k]),
                              ab = other.points.col(loops[loop][(k + 1) % loops[loop].size()]) - a;
        const double share = std::clamp(ab.dot(x - a) / ab.squaredNorm(), 0.0, 1.0);
        const Eigen::Vector3d beside = a + share * ab - x;
        least = std::min(least, share > 0 && share < 1 && other.surface.is_sphere()
                                    ? std::abs(a.cross(ab).normalized().dot(x))
                                    : beside.norm());
      }
    most = std::max(most, least);
  }
  return most;
}

/// The least and the largest angle of flat triangles, in degrees.
std::array<double, 2> angles_of(const Mesh& mesh) {
  std::array<double, 2> range{180, 0};
  for (const auto& t : mesh.triangles.colwise())
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d at = mesh.points.col(t(i)), u = mesh.points.col(t((i + 1) % 3)) - at,
                            v = mesh.points.col(t((i + 2) % 3)) - at;
      const double angle = std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
      range = {std::min(range[0], angle), std::max(range[1], angle)};
    }
  return range;
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles.colwise()) {
    const Eigen::Vector3d a = mesh.points.col(t(0)), b = mesh.points.col(t(1)),
                          c = mesh.points.col(t(2));
    sum += (b - a).cross(c - a).norm() / 2;
  }
  return sum;
}

} // namespace

TEST_CASE("cells in a circle become finer, and all others stay [slow]") {
  const Mesh& base = uniform_sphere();
  for (const Eigen::Vector3d& centre : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(-1, 0, 0.1)}) {
    const ChangedMesh finer = refine(base, in_circle(centre, 0.15, 2));
    REQUIRE(finer.patches.size() == 1);
    expect_changed(base, finer);
    expect_delaunay(finer.mesh);
    expect_good_shapes(finer);
    CHECK(finer.held == 0);
    const double ratio = mean_edge(base, centre, 0.1) / mean_edge(finer.mesh, centre, 0.1);
    CHECK(std::abs(ratio - 2) < 0.06);
    const double around = mean_edge(finer.mesh, -centre, 0.2) / mean_edge(base, -centre, 0.2);
    CHECK(around == 1);
  }
}

TEST_CASE("cells in a circle become coarser, and all others stay [slow]") {
  const Mesh& base = uniform_sphere();
  const Eigen::Vector3d centre(-1, -0.05, 0.4);
  const ChangedMesh coarser = coarsen(base, in_circle(centre, 0.45, 1.6));
  REQUIRE(coarser.patches.size() == 1);
  expect_changed(base, coarser);
  expect_delaunay(coarser.mesh);
  expect_good_shapes(coarser);
  CHECK(coarser.patches[0].added < coarser.patches[0].removed);
  const double ratio = mean_edge(coarser.mesh, centre, 0.15) / mean_edge(base, centre, 0.15);
  CHECK(std::abs(ratio - 1.6) < 0.1);
}

TEST_CASE("a patch that is refined and coarsened again leaves the rest untouched [slow]") {
  const Mesh& base = uniform_sphere();
  const Eigen::Vector3d centre(0.3, 0.2, 1);
  const ChangedMesh finer = refine(base, in_circle(centre, 0.15, 1.8));
  const ChangedMesh back = coarsen(finer.mesh, in_circle(centre, 0.25, 1.8));
  expect_changed(finer.mesh, back);
  expect_delaunay(back.mesh);
  std::int64_t touched = 0;
  for (Eigen::Index i = 0; i < base.points.cols(); ++i) {
    const std::int32_t id = finer.new_of_old[i];
    if (id >= 0 && back.new_of_old[id] >= 0)
      CHECK_MESSAGE(back.mesh.points.col(back.new_of_old[id]) == base.points.col(i), i);
    else
      ++touched;
  }
  CHECK(touched < 800);
}

TEST_CASE("a patch inside another one [slow]") {
  const Mesh& base = uniform_sphere();
  const ChangedMesh once = refine(base, in_circle({0, 1, 0.2}, 0.3, 1.5));
  const ChangedMesh twice = refine(once.mesh, in_circle({0, 1, 0.2}, 0.06, 2));
  expect_changed(once.mesh, twice);
  expect_delaunay(twice.mesh);
  expect_good_shapes(twice);
}

TEST_CASE("a part of a graded mesh, where its cells are fine, coarse and between [slow]") {
  const Density density = tanh_bump({1, 0, 0}, 0.5, 0.3, 1.0 / 256); // widths 1 to 4
  const Mesh base = make_grid({.cells = 6000, .resolution = density}).mesh;
  const Quality whole = quality(base);
  REQUIRE(whole.obtuse == 0);
  for (const Eigen::Vector3d& centre :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.8, 0.6, 0), Eigen::Vector3d(-1, 0.2, 0.1)}) {
    const ChangedMesh finer = refine(base, in_circle(centre, 0.2, 1.7));
    REQUIRE(finer.patches.size() == 1);
    expect_changed(base, finer);
    expect_delaunay(finer.mesh);
    expect_good_shapes(finer);
    const double ratio = mean_edge(base, centre, 0.12) / mean_edge(finer.mesh, centre, 0.12);
    CHECK(std::abs(ratio - 1.7) < 0.1);
  }
}

TEST_CASE("several patches in one call are those of a call each [slow]") {
  const Mesh& base = uniform_sphere();
  const Eigen::Vector3d one(0, 0, 1), other(1, 0, 0);
  const auto bounds = [](const Eigen::Vector3d& centre) {
    Points3 line(3, 2);
    line << centre, (centre + Eigen::Vector3d(0, 0.05, 0)).normalized();
    return Widths::by_distance({line}, {{{0, 120}, {300, 120}, {1700, 260}}});
  };
  const auto demand = [](const std::vector<Widths>& widths) {
    WidthDemand out;
    out.widths = Widths::minimum(widths);
    return out;
  };
  const ChangedMesh both = refine(base, demand({bounds(one), bounds(other)}));
  REQUIRE(both.patches.size() == 2);
  expect_changed(base, both);
  expect_delaunay(both.mesh);
  expect_good_shapes(both);
  const Mesh in_turn =
      refine(refine(base, demand({bounds(one)})).mesh, demand({bounds(other)})).mesh;
  CHECK(sorted_points(both.mesh) == sorted_points(in_turn));
}

TEST_CASE("patches that do not touch commute [slow]") {
  const Mesh& base = uniform_sphere();
  const WidthDemand one = in_circle({0, 0, 1}, 0.1, 1.7), other = in_circle({1, 0, 0}, 0.1, 2.5);
  const RefineOptions options{.gradient = 0.1};
  const Mesh a = refine(refine(base, one, options).mesh, other, options).mesh,
             b = refine(refine(base, other, options).mesh, one, options).mesh;
  CHECK(sorted_points(a) == sorted_points(b));
  CHECK(renumbered(a, Numbering::curve).triangles == renumbered(b, Numbering::curve).triangles);
}

TEST_CASE("widths along a line, finer than the cells of the mesh [slow]") {
  const Mesh& base = uniform_sphere(); // of 240 km
  Points3 line(3, 2);
  line << 1, 0.9, 0, 0.2, 0, 0.1;
  WidthDemand demand;
  demand.widths = Widths::by_distance({line}, {{{0, 60}, {50, 60}, {2050, 260}}});
  const ChangedMesh finer = refine(base, demand);
  REQUIRE(finer.patches.size() == 1);
  expect_changed(base, finer);
  expect_delaunay(finer.mesh);
  expect_good_shapes(finer);
  double shortest = 1;
  for (const auto& triangle : finer.mesh.triangles.colwise())
    shortest = std::min(
        shortest, (finer.mesh.points.col(triangle(0)) - finer.mesh.points.col(triangle(1))).norm());
  CHECK(shortest * earth_radius_km < 70);
  CHECK(shortest * earth_radius_km > 45);
}

TEST_CASE("a part that is too small for coarser cells is told") {
  const Mesh& base = uniform_sphere(); // 240 km
  const Eigen::Vector3d at = base.points.col(4000);
  for (const auto& [radius, missed] : {std::pair(150.0, true), {600.0, true}, {6000.0, false}}) {
    CAPTURE(radius);
    const ChangedMesh coarser = coarsen(base, in_circle(at, radius / earth_radius_km, 1.5));
    CHECK((coarser.missed > 0) == missed);
  }
  CHECK(coarsen(base, in_circle(at, 150 / earth_radius_km, 1.5)).missed == 1);
  const Eigen::Vector3d between =
      (base.points.col(base.triangles(0, 5)) + base.points.col(base.triangles(1, 5)) +
       base.points.col(base.triangles(2, 5)))
          .normalized();
  CHECK(test::code_of([&] { coarsen(base, in_circle(between, 0.001, 1.5)); }) ==
        ErrorCode::invalid_argument);
}

TEST_CASE("a demand between the sites is met: circles smaller than a cell, and narrow lines") {
  const Mesh& base = uniform_sphere(); // 240 km
  const std::vector<double> radii = {20, 90, 150};
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const Eigen::Index t = 1000 + 4000 * static_cast<Eigen::Index>(k);
    const Eigen::Vector3d at =
        (base.points.col(base.triangles(0, t)) + base.points.col(base.triangles(1, t)) +
         base.points.col(base.triangles(2, t)))
            .normalized();
    CAPTURE(radii[k]);
    const double radius = radii[k] / earth_radius_km;
    const ChangedMesh finer = refine(base, in_circle(at, radius, 4));
    expect_changed(base, finer);
    expect_delaunay(finer.mesh);
    CHECK(finer.missed == 0);
    CHECK(spacing_near(finer.mesh, at) < 1.3 * 60 / earth_radius_km);
  }
  const Points3 ends = Points3{{0.5, -0.2}, {0.1, 0.8}, {0.3, 0.4}}.colwise().normalized();
  for (const double width : {30.0, 100.0}) {
    WidthDemand demand;
    demand.widths = Widths::around({ends}, width, 1.5 * width);
    const ChangedMesh finer = refine(base, demand);
    expect_changed(base, finer);
    CHECK(finer.missed == 0);
    expect_good_shapes(finer);
    for (const double part : {0.0, 0.21, 0.5, 0.83}) {
      const Eigen::Vector3d at = ((1 - part) * ends.col(0) + part * ends.col(1)).normalized();
      CHECK(spacing_near(finer.mesh, at) < 1.3 * width / earth_radius_km);
    }
  }
}

TEST_CASE("a demand that is met changes nothing") {
  const Mesh& base = uniform_sphere();
  WidthDemand demand;
  demand.widths = Widths(250.0);
  for (const ChangedMesh& same : {refine(base, demand), coarsen(base, {.widths = Widths(200.0)})}) {
    CHECK(same.patches.empty());
    CHECK(same.mesh.points == base.points);
    CHECK(same.mesh.triangles == base.triangles);
    CHECK(same.mesh.neighbours == base.neighbours);
    expect_changed(base, same);
  }
}

TEST_CASE("a patch over the seams of a periodic box") {
  const Mesh base = lattice(true);
  WidthDemand demand;
  demand.region = square(60, 45, 12); // half of it beyond the period
  demand.factor = 2;
  const ChangedMesh finer = refine(base, demand);
  REQUIRE(finer.patches.size() == 1);
  expect_changed(base, finer);
  expect_delaunay(finer.mesh);
  expect_good_shapes(finer);
  WidthDemand all;
  all.region = rectangle({-1, 10}, {61, 20});
  all.factor = 2;
  CHECK(test::has(test::message_of([&] { refine(base, all); }), "leads around"));
}

TEST_CASE("sites at a boundary stay, and are counted where they do not meet the demand [slow]") {
  const Mesh base = lattice(false);
  WidthDemand demand;
  demand.region = square(30, 0, 14);
  demand.factor = 2;
  const ChangedMesh finer = refine(base, demand);
  REQUIRE(finer.patches.size() == 1);
  expect_changed(base, finer);
  expect_delaunay(finer.mesh);
  CHECK(finer.held > 20);
  CHECK(finer.held < 200);
  for (std::int32_t i = 0; i < 60; ++i) // the first row
    CHECK(finer.new_of_old[i] >= 0);
}

TEST_CASE("widths do not depend on the norm of the sites [slow]") {
  const Mesh& unit = uniform_sphere();
  Mesh earth = unit;
  earth.points *= 6371220; // as files of MPAS-Ocean have them
  WidthDemand demand;
  demand.widths = Widths::around({Points3(Eigen::Vector3d(0.6, 0, 0.8))}, 120, 700);
  const ChangedMesh expected = refine(unit, demand), finer = refine(earth, demand);
  expect_changed(earth, finer);
  REQUIRE(finer.patches.size() == 1);
  CHECK(finer.patches[0].removed == expected.patches[0].removed);
  const auto added = [](const ChangedMesh& mesh) {
    return static_cast<double>(mesh.patches[0].added);
  };
  CHECK(std::abs(added(finer) / added(expected) - 1) < 0.02);
  const auto norms = finer.mesh.points.colwise().norm().array();
  CHECK((norms / 6371220 - 1).abs().maxCoeff() < 1e-12);
}

TEST_CASE("a patch whose rings are concave [slow]") {
  const Surface lake = rectangle({0, 0}, {24, 16});
  const Mesh base = make_grid({.cells = 440, .surface = lake}).mesh;
  WidthDemand demand;
  demand.region = square(11, 8, 5);
  demand.factor = 2;
  const ChangedMesh finer = refine(base, demand); // up to the sites that stay at the boundary
  REQUIRE(finer.patches.size() == 1);
  expect_changed(base, finer);
  CHECK(lake.contains(finer.mesh.points.rowwise().minCoeff()));
  CHECK(lake.contains(finer.mesh.points.rowwise().maxCoeff()));
}

TEST_CASE("a patch between the rings of a plane that a lake leaves [slow]") {
  Points2 outer(2, 4), island(2, 4);
  outer << 0, 60, 60, 0, 0, 0, 45, 45;
  island << 24, 36, 36, 24, 28, 28, 36, 36;
  const Surface lake = Surface::plane().within({outer, island});
  const Mesh base = make_grid({.cells = 3000, .surface = lake}).mesh;
  WidthDemand demand;
  demand.region = square(30, 14, 8);
  demand.factor = 1.8;
  const ChangedMesh finer = refine(base, demand);
  REQUIRE(finer.patches.size() == 1);
  expect_changed(base, finer);
  expect_delaunay(finer.mesh);
  for (const ChangedPatch& patch : finer.patches)
    CHECK(patch.report.well_centred);
  CHECK(finer.held == 0);
  demand.region = square(30, 27, 8); // the island's shore
  const ChangedMesh shore = refine(base, demand);
  expect_changed(base, shore);
  expect_delaunay(shore.mesh);
  CHECK(shore.held > 0);
  for (std::int32_t i = 0; i < shore.old_of_new.size(); ++i)
    if (shore.old_of_new[i] < 0)
      CHECK(lake.contains(shore.mesh.points.col(i)));
}

TEST_CASE("the same bits on any number of threads and for any number of regions [slow]") {
  const Mesh& base = uniform_sphere();
  const WidthDemand demand = in_circle({0, 0, 1}, 0.12, 2);
  RefineOptions options{.gradient = 0.1};
  const ChangedMesh expected = refine(base, demand, options);
  for (const int threads : {1, 4}) {
    tbb::task_arena arena(threads);
    options.decomposition.regions = 5 * threads;
    const ChangedMesh other = arena.execute([&] { return refine(base, demand, options); });
    CHECK(other.mesh.points == expected.mesh.points);
    CHECK(other.mesh.triangles == expected.mesh.triangles);
  }
}

TEST_CASE("a patch does not reach both sides of a site where the boundary meets itself") {
  const Mesh good = make_grid({.cells = 642}).mesh;
  const std::int32_t a = good.triangles(0, 600);
  const Eigen::Vector3d centre = good.points.col(a);

  // Two triangles at a site, across from each other, are left out.
  Mesh open = good;
  std::vector<Eigen::Index> kept, around;
  for (Eigen::Index k = 0; k < good.triangles.cols(); ++k)
    if ((good.triangles.col(k).array() == a).any())
      around.push_back(k);
  REQUIRE(around.size() == 6);
  const Eigen::Index first = around[0];
  const auto shares = [&](Eigen::Index k) {
    int common = 0;
    for (const std::int32_t site : good.triangles.col(k))
      common += (good.triangles.col(first).array() == site).any() ? 1 : 0;
    return common;
  };
  Eigen::Index opposite = -1;
  for (const Eigen::Index k : around) {
    bool apart = shares(k) == 1;
    for (int i = 0; i < 3; ++i)
      if (const std::int32_t n = good.neighbours(i, k); n >= 0)
        apart = apart && n != first;
    // Across: none of its neighbours at the site is a neighbour of the first.
    int near = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        near += good.neighbours(i, k) == good.neighbours(j, first) ? 1 : 0;
    if (apart && near == 0)
      opposite = k;
  }
  REQUIRE(opposite >= 0);
  for (Eigen::Index k = 0; k < good.triangles.cols(); ++k)
    if (k != first && k != opposite)
      kept.push_back(k);
  std::vector<std::int32_t> number(static_cast<std::size_t>(good.triangles.cols()), -1);
  for (std::size_t k = 0; k < kept.size(); ++k)
    number[static_cast<std::size_t>(kept[k])] = static_cast<std::int32_t>(k);
  open.triangles = good.triangles(Eigen::all, kept);
  open.neighbours = good.neighbours(Eigen::all, kept).unaryExpr([&](std::int32_t n) {
    return number[static_cast<std::size_t>(n)];
  });
  WidthDemand wide = in_circle(centre, 1.2, 1.5);
  const Error error = test::error_of([&] { refine(open, wide); });
  CHECK(error.code() == ErrorCode::invalid_argument);
  CHECK(error.index() == a);
  CHECK(test::has(error.what(), "meets itself"));
}

TEST_CASE("meshes of irregular cells change, too [slow]") {
  struct Irregular {
    std::int64_t sites;
    bool finer;
  };
  // A patch within others, one that is the whole sphere, and one of coarser cells.
  for (const auto& [sites, finer] : {Irregular{2000, true}, {400, true}, {400, false}}) {
    CAPTURE(sites);
    CAPTURE(finer);
    const Mesh base = delaunay(random_sphere(sites, 2));
    const WidthDemand demand = in_circle(base.points.col(34), 0.3, 2);
    const ChangedMesh made = finer ? refine(base, demand) : coarsen(base, demand);
    REQUIRE(made.patches.size() == 1);
    CHECK((made.patches[0].removed == sites) == (finer && sites == 400));
    expect_changed(base, made);
    expect_delaunay(made.mesh);
  }
}

TEST_CASE(
    "lengths refer to the planet of a file, or on the unit sphere to a radius that is given") {
  constexpr double mars = 3389.5, model = 6371.229;
  CHECK(radius_of_widths({}, 1) == earth_radius_km);
  CHECK(radius_of_widths({}, 1, mars) == mars);
  CHECK(radius_of_widths(model, 1) == earth_radius_km); // that of widths without another
  CHECK(radius_of_widths(model, 6371229) == model);
  CHECK(radius_of_widths(mars, 1) == mars);
  CHECK(radius_of_widths(mars, 1, 5000) == 5000);
  CHECK(radius_of_widths(mars, 3389500, 5000) == mars);
  CHECK(is_earth(6371 * 1.0099));
  CHECK(!is_earth(6371 * 1.0101));
}

TEST_CASE("demands that cannot be") {
  const Mesh& base = uniform_sphere();
  const auto refused = [&](const WidthDemand& demand, const std::string& what,
                           const RefineOptions& options = {}) {
    const std::string message = test::error_of([&] { refine(base, demand, options); }).what();
    CHECK_MESSAGE(message.find(what) != std::string::npos, message);
  };
  refused({}, "neither widths nor a region");
  WidthDemand both = in_circle({0, 0, 1}, 0.1, 2);
  both.widths = Widths(100.0);
  refused(both, "widths and a region");
  refused(in_circle({0, 0, 1}, 0.1, 1), "factor is 1");
  refused(in_circle({0, 0, 1}, 0.1, 1000), "factor is 1000");
  refused(in_circle({0, 0, 1}, 0.1, 1.05), "factor 1.05 is met by all cells");
  WidthDemand planar;
  planar.region = square(0, 0, 1);
  planar.factor = 2;
  refused(planar, "kind of surface");
  RefineOptions options;
  options.tolerance = 0;
  refused(in_circle({0, 0, 1}, 0.1, 2), "tolerance is 0", options);
  options = {};
  options.gradient = 2;
  refused(in_circle({0, 0, 1}, 0.1, 2), "gradient is 2", options);
  options = {.boundary = Boundary::generators};
  refused(in_circle({0, 0, 1}, 0.1, 2), "the mesh has no boundary", options);
  const Mesh clipped = make_grid({.cells = 200, .surface = circle({0, 0, 1}, 0.3)}).mesh;
  const std::string text = test::message_of([&] {
    refine(clipped, in_circle({0, 0, 1}, 0.1, 2), options);
  });
  CHECK_MESSAGE(text.find("at the end of the mesh is not on the boundary") != std::string::npos,
                text);
  CHECK(test::has(test::message_of([&] {
                    coarsen(wavy_sea(), in_circle(wavy_sea().points.col(0), 0.2, 2), options);
                  }),
                  "do not become coarser"));
}

TEST_CASE("a patch at a corner of a hull with thin triangles [slow]") {
  const Mesh bounded = make_grid({.cells = 440, .surface = rectangle({0, 0}, {24, 16})}).mesh;
  const Mesh base = delaunay(bounded.points, Surface::plane());
  WidthDemand demand;
  demand.region = rectangle({0, 0}, {6, 6});
  demand.factor = 1.5;
  const ChangedMesh finer = refine(base, demand, {.gradient = 0.3});
  REQUIRE(finer.patches.size() == 1);
  expect_changed(base, finer);
  expect_delaunay(finer.mesh);
  CHECK(finer.held > 10);
}

TEST_CASE("finer cells reach the shore of a mesh that ends at generators [slow]") {
  Mesh base = wavy_sea();
  base.surface = Surface::sphere(); // as a file has it
  const RefineOptions shore{.gradient = 0.1, .boundary = Boundary::generators};
  const Eigen::Vector3d cape = from_lonlat(Eigen::Vector2d(63, 5)),
                        island = from_lonlat(Eigen::Vector2d(40, 5));
  for (const Eigen::Vector3d& centre : {cape, island}) {
    const WidthDemand demand = in_circle(centre, 0.13, 2.5);
    CHECK(refine(base, demand, {.gradient = 0.1}).held > 0);
    const ChangedMesh finer = refine(base, demand, shore);
    expect_changed(base, finer);
    CHECK(finer.held == 0);
    CHECK(finer.missed == 0);
    CHECK(check_surface(finer.mesh).failure == "");
    CHECK(count_edges(finer.mesh).not_delaunay == 0);
    CHECK(boundary_loops(finer.mesh).size() == 2);
    CHECK(from_boundary(finer.mesh, base) < 1e-12);
    CHECK(std::abs(area_of(finer.mesh) / area_of(base) - 1) < 0.01);
    CHECK(mean_edge(finer.mesh, centre, 0.13) / mean_edge(base, centre, 0.13) < 0.5);
    CHECK(angles_of(finer.mesh)[0] > 35);
    CHECK(angles_of(finer.mesh)[1] < 91);
    CHECK(finer.width_ratio.maxCoeff() < 1.2);
    CHECK(finer.width_ratio.minCoeff() > 0.3);
  }
  const WidthDemand demand = in_circle(cape, 0.13, 2.5);
  tbb::task_arena arena(1);
  const ChangedMesh alone = arena.execute([&] { return refine(base, demand, shore); });
  CHECK(alone.mesh.points == refine(base, demand, shore).mesh.points);
  // In memory a mesh knows its coast, beside whose arcs new generators may lie: the result does
  // not.
  const ChangedMesh known = refine(wavy_sea(), demand, shore);
  CHECK(known.mesh.triangles == alone.mesh.triangles);
  CHECK(!known.mesh.surface.is_bounded());
  const ChangedMesh again = refine(known.mesh, in_circle(cape, 0.05, 2), shore);
  expect_changed(known.mesh, again);
  CHECK(from_boundary(again.mesh, known.mesh) < 1e-12);
}

TEST_CASE("finer cells reach the sides and corners of a plane [slow]") {
  Recipe recipe;
  recipe.surface = rectangle({0, 0}, {24, 16});
  recipe.boundary = Boundary::generators;
  recipe.cells = 440;
  const Mesh base = make_grid(recipe).mesh;
  WidthDemand demand;
  demand.region = rectangle({-1, -1}, {5, 4});
  demand.factor = 2;
  const ChangedMesh finer =
      refine(base, demand, {.gradient = 0.2, .boundary = Boundary::generators});
  expect_changed(base, finer);
  CHECK(finer.held == 0);
  CHECK(from_boundary(finer.mesh, base) < 1e-12);
  CHECK(std::abs(area_of(finer.mesh) / (24 * 16) - 1) < 1e-12); // no corner is cut off
  CHECK(check_surface(finer.mesh).failure == "");
  CHECK(angles_of(finer.mesh)[1] < 91);
}

TEST_CASE("in a strait without inner sites cells become finer, too") {
  // Two rows of sites, all of them at the boundary.
  Points3 sites(3, 60);
  for (int k = 0; k < 30; ++k) {
    sites.col(k) << k, 0, 0;
    sites.col(30 + k) << k + 0.5, 0.9, 0;
  }
  const Mesh base = delaunay(sites, Surface::plane());
  WidthDemand demand;
  demand.region = rectangle({10, -1}, {20, 2});
  demand.factor = 2;
  const ChangedMesh finer =
      refine(base, demand, {.gradient = 0.2, .boundary = Boundary::generators});
  expect_changed(base, finer);
  CHECK(finer.held == 0);
  CHECK(from_boundary(finer.mesh, base) < 1e-12);
  CHECK(std::abs(area_of(finer.mesh) / area_of(base) - 1) < 1e-12);
  CHECK(finer.mesh.points.cols() > 85); // with a third row
}

TEST_CASE("small islands at the rim of a patch keep three generators [slow]") {
  // Islands as wide as a cell, a patch ends at some of which.
  std::vector<DoubleMatrix> rings;
  Points2 outer(2, 4);
  outer << 0, 24, 24, 0, 0, 0, 16, 16;
  rings.emplace_back(outer);
  for (double x = 3.1; x < 22; x += 4)
    for (double y = 3.2; y < 14; y += 4) {
      Points2 island(2, 6);
      for (int k = 0; k < 6; ++k)
        island.col(k) << x + 0.5 * std::cos(-k * std::numbers::pi / 3),
            y + 0.5 * std::sin(-k * std::numbers::pi / 3);
      rings.emplace_back(island);
    }
  Recipe recipe;
  recipe.surface = Surface::plane().within(rings);
  recipe.boundary = Boundary::generators;
  recipe.cells = 450;
  const Mesh base = make_grid(recipe).mesh;
  const auto loops = boundary_loops(base).size();
  REQUIRE(loops == std::ssize(rings));
  for (double x = 1; x < 9; x += 1.3) {
    WidthDemand demand;
    demand.region = square(x, 7, 5);
    demand.factor = 1.6;
    const ChangedMesh finer =
        refine(base, demand, {.gradient = 0.5, .boundary = Boundary::generators});
    expect_changed(base, finer);
    CHECK(boundary_loops(finer.mesh).size() == loops);
    CHECK(check_surface(finer.mesh).failure == "");
    CHECK(from_boundary(finer.mesh, base) < 0.05); // each step ends at chords of the one before
  }
}

TEST_CASE("a mesh that ends at generators is one after a rotation [slow]") {
  const Mesh moved = rotated(wavy_sea(), Rotation({40, 5}, {-100, 77}, 30));
  CHECK(voronoi(moved).cell_area.sum() == doctest::Approx(moved.surface.area()));
  CHECK(check_surface(moved).failure == "");
}
