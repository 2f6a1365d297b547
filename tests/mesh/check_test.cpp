// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/traversal.h"
#include "delaunay/delaunay.h"
#include "domain/surface.h"
#include "mesh/renumber.h"
#include "support/clouds.h"
#include "support/laws.h"
#include "support/text.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <tbb/task_arena.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

bool fails_with(const Mesh& mesh, const std::string& words) {
  const CheckReport result = check(mesh);
  INFO("failure: ", result.failure);
  CHECK_FALSE(result.passed());
  CHECK(result.failure.find('\n') == std::string::npos);
  const bool found = result.failure.find(words) != std::string::npos;
  CHECK(found);
  return found;
}

std::vector<Triple> triangles_of(const Mesh& mesh) {
  std::vector<Triple> out;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
    out.push_back(triple(mesh, t));
  return out;
}

Mesh good_mesh() { return oracle::delaunay(random_sphere(20, 4)); }

/// The mesh with the edge across from vertex 0 of triangle t flipped.
Mesh flipped(const Mesh& mesh, std::int64_t t) {
  std::vector<Triple> triangles = triangles_of(mesh);
  const std::int32_t other = mesh.neighbours(0, t);
  const Triple own = triple(mesh, t);
  std::int32_t across = -1;
  for (int j = 0; j < 3; ++j)
    if (std::find(own.begin(), own.end(), mesh.triangles(j, other)) == own.end())
      across = mesh.triangles(j, other);
  triangles[static_cast<std::size_t>(t)] = {own[0], own[1], across};
  triangles[static_cast<std::size_t>(other)] = {own[0], across, own[2]};
  return oracle::mesh_of(mesh.points, triangles);
}

void exchange_sites(Points3& points, Eigen::Index i, Eigen::Index j) {
  const Eigen::Vector3d p = points.col(i);
  points.col(i) = points.col(j);
  points.col(j) = p;
}

} // namespace

TEST_CASE("meshes made by the definition pass, closed and open") {
  for (const Cloud& cloud : small_clouds()) {
    if (cloud.points.cols() > 25 || cloud.sites >= 0)
      continue;
    CAPTURE(cloud.name);
    const Mesh mesh = oracle::delaunay(cloud.points);
    const CheckReport result = check(mesh);
    CHECK(result.failure == "");
    CHECK(result.sites == mesh.points.cols());
    CHECK(result.triangles == mesh.triangles.cols());
    CHECK((result.boundary_edges == 0) == cloud.closed);
    CHECK(mesh.closed() == cloud.closed);
    if (cloud.closed)
      CHECK(result.area == doctest::Approx(4 * std::numbers::pi).epsilon(1e-9));
    else
      CHECK(result.area <= 2 * std::numbers::pi * (1 + 1e-12));
  }
}

TEST_CASE("triangles that are hemispheres up to rounding have positive areas") {
  Random random(26);
  for (int round = 0; round < 200; ++round) {
    Points3 points = Points3::Zero(3, 7); // on the equator, one of them just below it; a pole
    for (Eigen::Index i = 0; i < 6; ++i) {
      const double angle = random.real(0, 2 * std::numbers::pi);
      points.col(i).head<2>() << 4 * std::cos(angle), 4 * std::sin(angle); // units of z = 0 or -0
    }
    points(2, 2) = -5e-324;
    points(2, 6) = 1;
    const CheckReport result = check(delaunay(points));
    CHECK(result.failure == "");
    if (result.boundary_edges == 0)
      CHECK(result.area == doctest::Approx(4 * std::numbers::pi).epsilon(1e-9));
  }
}

TEST_CASE("points of any norm pass, also unit vectors up to rounding") {
  Mesh mesh = delaunay(random_sphere(3000, 5));
  for (const double factor : {1.0, 1 + 0x1p-52, 1 - 0x1p-53, 1 + 0x1p-50, 1 - 0x1p-50, 3e28}) {
    Mesh scaled = mesh;
    scaled.points *= factor;
    CHECK(check(scaled).failure == "");
    scaled.triangles.col(7).reverseInPlace();
    CHECK(check(scaled).failure != "");
  }
}

TEST_CASE("an empty mesh, and sizes that do not match") {
  fails_with({.surface = Surface::plane()}, "no triangle");
  Mesh mesh = good_mesh();
  mesh.neighbours.conservativeResize(3, mesh.neighbours.cols() - 1);
  fails_with(mesh, "neighbours");
  mesh = good_mesh();
  mesh.points.resize(3, 0);
  mesh.site_of_input.clear();
  fails_with(mesh, "vertex outside");
}

TEST_CASE("sites that are not directions") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mesh mesh = good_mesh();
    mesh.points(1, 7) = bad;
    fails_with(mesh, "site 7 ");
  }
  Mesh mesh = good_mesh();
  mesh.points.col(3).setZero();
  fails_with(mesh, "site 3 ");
}

TEST_CASE("ids out of range") {
  for (const std::int32_t id : {-1, 20, 1 << 30, std::numeric_limits<std::int32_t>::min()}) {
    Mesh mesh = good_mesh();
    mesh.triangles(2, 5) = id;
    fails_with(mesh, "triangle 5 ");
  }
  for (const std::int32_t id : {-2, 36, 1 << 30, std::numeric_limits<std::int32_t>::min()}) {
    Mesh mesh = good_mesh();
    mesh.neighbours(1, 9) = id;
    fails_with(mesh, "triangle 9 ");
  }
  Mesh mesh = good_mesh();
  mesh.site_of_input[4] = 20;
  fails_with(mesh, "input 4 ");
}

TEST_CASE("order that is not canonical") {
  Mesh mesh = good_mesh();
  std::rotate(mesh.triangles.col(6).data(), mesh.triangles.col(6).data() + 1,
              mesh.triangles.col(6).data() + 3);
  fails_with(mesh, "triangle 6 ");
  mesh = good_mesh();
  mesh.triangles.col(3).swap(mesh.triangles.col(4));
  fails_with(mesh, "triangle 4 ");
  mesh = good_mesh();
  mesh.triangles(1, 8) = mesh.triangles(2, 8);
  fails_with(mesh, "vertex twice");
  mesh = good_mesh();
  mesh.triangles.col(8) = mesh.triangles.col(7);
  fails_with(mesh, "there twice");
}

TEST_CASE("neighbours that are wrong") {
  Mesh mesh = good_mesh();
  mesh.neighbours(0, 2) = 2;
  fails_with(mesh, "triangle 2 ");
  mesh = good_mesh();
  std::swap(mesh.neighbours(0, 2), mesh.neighbours(1, 2));
  fails_with(mesh, "triangle 2 ");
  mesh = good_mesh();
  mesh.neighbours(0, 2) = -1;
  fails_with(mesh, "edge");
  mesh = good_mesh();
  // Cut along one edge: both sides have no neighbour there.
  const std::int32_t other = mesh.neighbours(0, 2);
  for (int j = 0; j < 3; ++j)
    if (mesh.neighbours(j, other) == 2)
      mesh.neighbours(j, other) = -1;
  mesh.neighbours(0, 2) = -1;
  fails_with(mesh, "site");
}

TEST_CASE("a triangle missing, there twice, or turned over") {
  const Mesh mesh = good_mesh();
  std::vector<Triple> triangles = triangles_of(mesh);
  triangles.erase(triangles.begin() + 10);
  fails_with(oracle::mesh_of(mesh.points, triangles), "convex");
  triangles = triangles_of(mesh);
  std::swap(triangles[10][0], triangles[10][1]);
  CHECK_FALSE(check(oracle::mesh_of(mesh.points, triangles)).passed());
  Mesh twice = mesh;
  twice.triangles.col(11) = twice.triangles.col(10);
  CHECK_FALSE(check(twice).passed());
}

TEST_CASE("every edge flipped is found") {
  const Mesh mesh = good_mesh();
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
    CAPTURE(t);
    CHECK_FALSE(check(flipped(mesh, t)).passed());
  }
}

TEST_CASE("a flipped edge of a convex quadrilateral is named") {
  // A long thin diamond on the equator with its long diagonal.
  const Points3 points = columns({{1, 0, 0}, {0.6, 0.8, 0}, {1, 0.4, 0.1}, {1, 0.4, -0.1}});
  fails_with(oracle::mesh_of(points, {{0, 1, 2}, {0, 3, 1}}), "edge (0, 1) of triangle 0");
  CHECK(check(oracle::mesh_of(points, {{0, 3, 2}, {1, 2, 3}})).failure == "");
}

TEST_CASE("two sites exchanged") {
  const Mesh mesh = good_mesh();
  for (Eigen::Index j = 1; j < 20; ++j) {
    Mesh wrong = mesh;
    exchange_sites(wrong.points, 0, j);
    CAPTURE(j);
    CHECK_FALSE(check(wrong).passed());
  }
}

TEST_CASE("a cube's face with the other diagonal") {
  const Mesh mesh = oracle::delaunay(signs_of({1, 1, 1}));
  REQUIRE(check(mesh).failure == "");
  int tied = 0;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
    const Mesh other = flipped(mesh, t);
    if (exact::orientation(site(other.points, other.triangles(0, t)),
                           site(other.points, other.triangles(1, t)),
                           site(other.points, other.triangles(2, t))) <= 0)
      continue;
    ++tied;
    CHECK_FALSE(check(other).passed());
  }
  CHECK(tied > 0);
}

TEST_CASE("a site that is no vertex") {
  Mesh mesh = good_mesh();
  mesh.points.conservativeResize(3, 21);
  mesh.points.col(20) << 1, 2, 3;
  fails_with(mesh, "site 20 is not a vertex");
}

TEST_CASE("a boundary that is not convex") {
  const Points3 points = columns({{0, 0, 1}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}, {-1, -1, 2}});
  const Mesh whole = oracle::mesh_of(points, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  CHECK(check(whole).failure == "");
  fails_with(oracle::mesh_of(points, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}), "not convex at site 0");
}

TEST_CASE("one site of two fans") {
  const Points3 points = columns({{0, 0, 1}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}, {-1, -1, 2}});
  const Mesh mesh = oracle::mesh_of(points, {{0, 1, 2}, {0, 3, 4}});
  fails_with(mesh, "site 0 are not a single cycle or fan");
  CHECK(check_surface(mesh).failure == "");
}

TEST_CASE("two sheets over the sphere") {
  // The octahedron, twice around its axis: every triangle counter-clockwise, every edge in two.
  std::vector<Vec3> ring;
  for (int i = 0; i < 8; ++i)
    ring.push_back({std::cos(i * std::numbers::pi / 2 + 0.01 * i),
                    std::sin(i * std::numbers::pi / 2 + 0.01 * i), 0});
  ring.push_back({0, 0, 1});
  ring.push_back({0, 0, -1});
  std::vector<Triple> triangles;
  for (std::int32_t i = 0; i < 8; ++i) {
    triangles.push_back({i, (i + 1) % 8, 8});
    triangles.push_back({(i + 1) % 8, i, 9});
  }
  fails_with(oracle::mesh_of(columns(ring), triangles), "turn 2 times around site 8");
}

TEST_CASE("two spheres in one mesh") {
  const Points3 one = columns({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
  const Mesh mesh = oracle::delaunay(one);
  std::vector<Triple> triangles = triangles_of(mesh);
  for (std::size_t t = 0; t < 4; ++t)
    triangles.push_back({triangles[t][0] + 4, triangles[t][1] + 4, triangles[t][2] + 4});
  fails_with(oracle::mesh_of(joined(one, 2 * one), triangles), "Euler");
}

TEST_CASE("arrays of nonsense do not crash") {
  Random random(47);
  for (int round = 0; round < 3000; ++round) {
    const int n = random.integer(0, 6), m = random.integer(0, 8);
    Mesh mesh;
    mesh.points.resize(3, n);
    for (Eigen::Index i = 0; i < mesh.points.size(); ++i)
      mesh.points.data()[i] = random.integer(-1, 1);
    mesh.triangles.resize(3, m);
    mesh.neighbours.resize(3, m);
    for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
      mesh.triangles.data()[i] = random.integer(0, n);
      mesh.neighbours.data()[i] = random.integer(-1, m);
    }
    CHECK_FALSE(check(mesh).passed());
  }
  // Valid triangles over wrong points, with mutual neighbours, which pass the first laws.
  const Mesh mesh = good_mesh();
  for (int round = 0; round < 1000; ++round) {
    Mesh wrong = mesh;
    for (int k = 0; k < 20; ++k)
      exchange_sites(wrong.points, random.integer(0, 19), random.integer(0, 19));
    const CheckReport result = check(wrong);
    CHECK((!result.passed() || wrong.points == mesh.points));
  }
}

// ---- The plane

namespace {

Points2 scatter(int n, std::uint64_t seed) {
  Random random(seed);
  Points2 points(2, n);
  for (Eigen::Index i = 0; i < 2 * n; ++i)
    points.data()[i] = random.real(0, 1);
  return points;
}

Points2 square_lattice(int side) {
  Points2 points(2, side * side);
  for (int i = 0; i < side * side; ++i)
    points.col(i) << i % side, i / side; // NOLINT(bugprone-integer-division)
  return points;
}

/// Canonical again after its triangles were changed.
Mesh planar_mesh_of(const Mesh& mesh, std::vector<Triple> triangles) {
  Mesh out = mesh;
  const Mesh whole =
      oracle::mesh_of(Points3::Constant(3, mesh.points.cols(), 1), std::move(triangles));
  out.triangles = whole.triangles;
  out.neighbours = whole.neighbours;
  return out;
}

/// The mesh with the edge across from vertex i of triangle t flipped.
Mesh flipped(const Mesh& mesh, std::int64_t t, int i) {
  std::vector<Triple> triangles;
  for (std::int64_t u = 0; u < mesh.triangles.cols(); ++u)
    triangles.push_back({mesh.triangles(0, u), mesh.triangles(1, u), mesh.triangles(2, u)});
  const std::int32_t other = mesh.neighbours(i, t);
  const std::int32_t a = mesh.triangles(i, t), b = mesh.triangles((i + 1) % 3, t),
                     c = mesh.triangles((i + 2) % 3, t);
  std::int32_t d = -1;
  for (int j = 0; j < 3; ++j)
    if (mesh.neighbours(j, other) == t)
      d = mesh.triangles(j, other);
  triangles[static_cast<std::size_t>(t)] = {a, b, d};
  triangles[static_cast<std::size_t>(other)] = {a, d, c};
  return planar_mesh_of(mesh, triangles);
}

std::vector<Mesh> planar_meshes() {
  std::vector<Mesh> meshes;
  for (const double scale : {1.0, 1e-150, 1e150})
    meshes.push_back(delaunay(scale * scatter(60, 8), Surface::plane()));
  meshes.push_back(delaunay(square_lattice(6), Surface::plane()));
  Points2 thin = scatter(80, 9); // long triangles along the hull
  thin.row(1) *= 1e-9;
  meshes.push_back(delaunay(thin, Surface::plane()));
  for (const std::uint64_t seed : {1, 2, 3})
    meshes.push_back(delaunay(scatter(100, seed), Surface::periodic({1, 1})));
  Points2 wide = scatter(300, 4);
  wide.row(0) *= 7e28;
  wide.row(1) *= 3e28;
  meshes.push_back(delaunay(wide, Surface::periodic({7e28, 3e28})));
  meshes.push_back(delaunay(square_lattice(8), Surface::periodic({8, 8})));
  meshes.push_back(delaunay(hexagonal_box(8, 10, 1).points, hexagonal_box(8, 10, 1).surface));
  return meshes;
}

/// Six rows of eight nearly equilateral triangles between straight walls, whose sites are the 16 of
/// the first and the last row; along y with negative x.
Mesh channel(bool along_x) {
  const Mesh box = hexagonal_box(8, 6, 1);
  Mesh mesh = box;
  std::vector<Triple> triangles;
  for (const auto& t : box.triangles.colwise()) {
    const Eigen::Vector3d y(box.points(1, t[0]), box.points(1, t[1]), box.points(1, t[2]));
    if (y.maxCoeff() - y.minCoeff() < 2)
      triangles.push_back({t[0], t[1], t[2]});
  }
  const double top = box.points.row(1).maxCoeff();
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    if (const double y = box.points(1, i); y > 0 && y < top)
      mesh.points.col(i).head<2>() +=
          0.04 * Eigen::Vector2d(std::sin(3.0 * double(i)), std::cos(double(i * i)));
  mesh.points.row(0) =
      mesh.points.row(0).unaryExpr([](double x) { return x - 8 * std::floor(x / 8); });
  mesh.surface = Surface::periodic({8, 0});
  if (!along_x) {
    const Eigen::RowVectorXd x = mesh.points.row(0);
    mesh.points.row(0) = -mesh.points.row(1);
    mesh.points.row(1) = x;
    mesh.surface = Surface::periodic({0, 8});
  }
  return planar_mesh_of(mesh, triangles);
}

} // namespace

TEST_CASE("planar meshes pass, open and periodic, and their areas are known") {
  for (const Mesh& mesh : planar_meshes()) {
    CAPTURE(mesh.points.cols());
    const CheckReport result = check(mesh);
    CHECK(result.failure == "");
    CHECK(result.sites == mesh.points.cols());
    CHECK(result.area == doctest::Approx(result.expected_area).epsilon(1e-12));
    if (mesh.surface.is_box()) {
      CHECK(result.expected_area == doctest::Approx(mesh.surface.area()));
      CHECK(result.boundary_edges == 0);
    }
  }
  CHECK(check(delaunay(square_lattice(6), Surface::plane())).area == 25);
}

TEST_CASE("channels pass between straight walls, along x and y, and their area is known") {
  for (const bool along_x : {true, false}) {
    const Mesh mesh = channel(along_x);
    CAPTURE(along_x);
    const CheckReport result = check(mesh);
    CHECK(result.failure == "");
    CHECK(result.triangles == 2 * mesh.points.cols() - 16);
    CHECK(result.boundary_edges == 16);
    CHECK(result.area == doctest::Approx(8 * 5 * std::sqrt(3) / 2));
    CHECK(result.expected_area == doctest::Approx(8 * 5 * std::sqrt(3) / 2));
    CHECK(check_surface(mesh).failure == "");

    Mesh wrong = mesh; // a dent and a bump in a wall
    wrong.points(along_x ? 1 : 0, 0) += 0.1;
    CHECK(has(check(wrong).failure, "not convex"));
    CHECK(check_surface(wrong).failure == "");
    wrong.points(along_x ? 1 : 0, 0) -= 0.2;
    CHECK(has(check(wrong).failure, "not convex"));
    CHECK(check_surface(wrong).failure == "");
    wrong = mesh;
    wrong.points(along_x ? 0 : 1, 3) = 8;
    fails_with(wrong, "site 3 is outside the periodic channel");
    wrong = mesh; // the triangles at the seam are missing
    wrong.surface = Surface::periodic(2 * wrong.surface.period());
    CHECK_FALSE(check(wrong).passed());
    wrong = mesh;
    wrong.surface = Surface::plane();
    CHECK_FALSE(check(wrong).passed());
  }
}

TEST_CASE("two sheets over a channel, and two channels, are not one") {
  const Mesh one = channel(true);
  const auto n = static_cast<std::int32_t>(one.points.cols());
  for (const double apart : {0.0, 100.0}) {
    Mesh two = one;
    two.points.resize(3, 2 * n);
    two.points << one.points, (one.points.colwise() + Eigen::Vector3d(0, apart, 0));
    std::vector<Triple> triangles;
    for (const std::int32_t shift : {0, n})
      for (const auto& t : one.triangles.colwise())
        triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    CAPTURE(apart);
    CHECK_FALSE(check(planar_mesh_of(two, triangles)).passed());
  }
}

TEST_CASE("every flipped edge of a planar mesh is found, ties and copies too") {
  std::vector<Mesh> meshes = planar_meshes();
  meshes.push_back(channel(true));
  meshes.push_back(channel(false));
  for (const Mesh& mesh : meshes)
    for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
      for (int i = 0; i < 3; ++i)
        if (mesh.neighbours(i, t) > t) {
          CAPTURE(t);
          CHECK_FALSE(check(flipped(mesh, t, i)).passed());
        }
}

TEST_CASE("in the plane the other diagonals of cocircular sites are counted, and are no fault") {
  for (const Mesh& mesh : {delaunay(square_lattice(6), Surface::plane()),
                           delaunay(square_lattice(8), Surface::periodic({8, 8})),
                           delaunay(1e150 * square_lattice(5), Surface::plane())}) {
    CHECK(count_edges(mesh).cocircular == 0);
    std::int64_t squares = 0;
    for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
      for (int i = 0; i < 3; ++i) {
        if (mesh.neighbours(i, t) < t)
          continue;
        const Mesh other = flipped(mesh, t, i);
        const bool diagonal =
            (other.triangles.cols() == mesh.triangles.cols()) && check_surface(other).passed();
        if (!diagonal) // two triangles of a straight line, or of one that is wider than the box
          continue;
        CAPTURE(t);
        const EdgeCounts edges = count_edges(other);
        CHECK(edges.edges == (3 * mesh.triangles.cols() + edges.boundary) / 2);
        // The edge between two triangles of one unit square; of others, not Delaunay.
        const bool square = edges.not_delaunay == 0;
        squares += square;
        CHECK(edges.cocircular == (square ? 1 : 0));
      }
    CHECK(squares == mesh.triangles.cols() / 2);
  }
}

TEST_CASE(
    "in the plane edges that are not Delaunay are counted, with the rounding of coordinates") {
  const Mesh random = delaunay(scatter(60, 8), Surface::plane());
  std::int64_t flips = 0;
  for (std::int64_t t = 0; t < random.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      if (random.neighbours(i, t) < t)
        continue;
      const Mesh other = flipped(random, t, i);
      if (!check_surface(other).passed()) // not a convex quadrangle
        continue;
      ++flips;
      CHECK(count_edges(other).not_delaunay == 1);
      CHECK(count_edges(other).cocircular == 0);
    }
  CHECK(flips > 60);

  // A turned square: whichever diagonal, its sites are cocircular up to rounding.
  Points3 corners(3, 4);
  corners << 0.3, 1.1, 0.5, -0.3, 0.1, 0.7, 1.5, 0.9, 0, 0, 0, 0;
  for (const std::vector<Triple>& triangles :
       {std::vector<Triple>{{0, 1, 2}, {0, 2, 3}}, {{0, 1, 3}, {1, 2, 3}}}) {
    const Mesh mesh = planar_mesh_of({.points = corners, .surface = Surface::plane()}, triangles);
    CHECK(count_edges(mesh).not_delaunay == 0);
    CHECK(count_edges(mesh).edges == 5);
    CHECK(count_edges(mesh).boundary == 4);
    CHECK(count_edges(mesh).loops == 1);
  }
  // 10% longer along one side it is a rectangle, and cocircular still; as a kite it is not.
  corners << 0, 1, 2, 1, 0, -0.1, 0, 0.1, 0, 0, 0, 0;
  const EdgeCounts edges = count_edges(
      planar_mesh_of({.points = corners, .surface = Surface::plane()}, {{0, 1, 2}, {0, 2, 3}}));
  CHECK(edges.not_delaunay == 1);
  CHECK((edges.first[0] == 0 && edges.first[1] == 2));
  // The angles at sites 1 and 3 are pi - 2 atan(1/10), whose cotangent is (1/100 - 1) / (2/10).
  CHECK(edges.shortest == doctest::Approx((0.01 - 1) / 0.2));
}

TEST_CASE("arrays and sites of a planar mesh that are wrong are named") {
  const Mesh open = delaunay(scatter(30, 5), Surface::plane()),
             box = delaunay(scatter(60, 6), Surface::periodic({1, 1}));
  fails_with({.surface = Surface::plane()}, "no triangle");
  for (const Mesh& mesh : {open, box}) {
    Mesh wrong = mesh;
    wrong.points(1, 4) = std::numeric_limits<double>::quiet_NaN();
    fails_with(wrong, "site 4 is not a place");
    wrong = mesh;
    wrong.points.resize(3, 0);
    wrong.site_of_input.clear();
    fails_with(wrong, "vertex outside");
    wrong = mesh;
    wrong.triangles(2, 5) = 1 << 30;
    fails_with(wrong, "triangle 5 ");
    wrong = mesh;
    wrong.triangles.col(3).swap(wrong.triangles.col(4));
    fails_with(wrong, "triangle 4 ");
    wrong = mesh;
    wrong.neighbours(0, 2) = 2;
    fails_with(wrong, "triangle 2 ");
    wrong = mesh;
    wrong.points.col(0).swap(wrong.points.col(1));
    CHECK_FALSE(check(wrong).passed());
    wrong = mesh;
    wrong.points.conservativeResize(3, mesh.points.cols() + 1);
    wrong.points.rightCols<1>() << 0.5, 0.5, 0;
    fails_with(wrong, "is not a vertex");
  }
  Mesh wrong = box;
  wrong.points(0, 3) = 1;
  fails_with(wrong, "site 3 is outside the periodic box");
  wrong = box;
  wrong.surface = Surface::periodic(
      2 * wrong.surface.period()); // the bridge of the meshes' triangles is missing
  CHECK_FALSE(check(wrong).passed());
  wrong = box;
  wrong.surface = Surface::plane();
  CHECK_FALSE(check(wrong).passed());
}

TEST_CASE("a planar boundary that is not convex, and a torus with a hole") {
  const Mesh open = delaunay(scatter(30, 5), Surface::plane()),
             box = delaunay(scatter(60, 6), Surface::periodic({1, 1}));
  for (const Mesh& mesh : {open, box}) {
    std::vector<Triple> triangles;
    for (std::int64_t u = 0; u < mesh.triangles.cols(); ++u)
      if (u != 7)
        triangles.push_back({mesh.triangles(0, u), mesh.triangles(1, u), mesh.triangles(2, u)});
    CHECK_FALSE(check(planar_mesh_of(mesh, triangles)).passed());
  }
}

TEST_CASE("two sheets over a periodic box are not one") {
  const Mesh one = delaunay(scatter(60, 6), Surface::periodic({1, 1}));
  Mesh two = one;
  two.points.resize(3, 120);
  two.points << one.points, one.points;
  std::vector<Triple> triangles;
  for (const std::int32_t shift : {0, 60})
    for (std::int64_t u = 0; u < one.triangles.cols(); ++u)
      triangles.push_back(
          {one.triangles(0, u) + shift, one.triangles(1, u) + shift, one.triangles(2, u) + shift});
  two.site_of_input.clear();
  fails_with(planar_mesh_of(two, triangles), "the areas sum to 2");
}

namespace {

/// Of a closed mesh.
void check_neighbours_exchanged(Mesh mesh, int rounds = 40) {
  REQUIRE(check(mesh).passed());
  const auto triangles = static_cast<int>(mesh.triangles.cols());
  Random random(48);
  for (int round = 0; round < rounds; ++round) {
    const int i = random.integer(0, 2), t = random.integer(0, triangles - 1);
    const std::int32_t good =
        std::exchange(mesh.neighbours(i, t), random.integer(0, triangles - 1));
    CHECK(check(mesh).passed() == (mesh.neighbours(i, t) == good));
    mesh.neighbours(i, t) = good;
  }
}

} // namespace

TEST_CASE("any wrong neighbour is found, in a mesh of several blocks") {
  check_neighbours_exchanged(calotte::delaunay(calotte::random_sphere(20000, 5)));
  check_neighbours_exchanged(delaunay(scatter(20000, 5), Surface::periodic({1, 1})));
}

TEST_CASE("large meshes are checked patch by patch if their sites are in random order") {
  const Mesh mesh = calotte::delaunay(random_sphere(530000, 6));
  const Mesh along = mesh_detail::in_order(mesh, mesh_detail::curve_order(mesh.points));
  REQUIRE(curve_detail::are_scattered(mesh.neighbours));
  REQUIRE_FALSE(curve_detail::are_scattered(along.neighbours));
  CHECK(check(along).passed());
  const double area = check(mesh).area;
  CHECK(area == doctest::Approx(check(along).area).epsilon(1e-13));
  tbb::task_arena(1).execute([&] { CHECK(check(mesh).area == area); }); // bit for bit
  check_neighbours_exchanged(mesh, 4);
}

// Slow: a mesh counts as scattered from half a million triangles on.
TEST_CASE("the same of periodic boxes of any size [slow]") {
  for (const double scale : {1e-29, 1.0, 1e29}) {
    const Mesh box = delaunay(scale * scatter(530000, 5), Surface::periodic({scale, scale}));
    REQUIRE(curve_detail::are_scattered(box.neighbours));
    check_neighbours_exchanged(box, 4);
  }
}

TEST_CASE("planar arrays of nonsense do not crash") {
  Random random(53);
  for (int round = 0; round < 3000; ++round) {
    const int n = random.integer(0, 6), m = random.integer(0, 8);
    Mesh mesh{.points = Points3::Zero(3, n), .surface = Surface::plane()};
    for (Eigen::Index i = 0; i < 2 * n; ++i)
      mesh.points(i % 2, i / 2) = random.integer(-1, 1);
    mesh.triangles.resize(3, m);
    mesh.neighbours.resize(3, m);
    for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
      mesh.triangles.data()[i] = random.integer(0, n);
      mesh.neighbours.data()[i] = random.integer(-1, m);
    }
    if (round % 2 == 0)
      mesh.surface = domain_detail::UncheckedSurface::of_plane(
          {}, {random.integer(0, 2), random.integer(0, 2)});
    CHECK_FALSE(check(mesh).passed());
  }
}
