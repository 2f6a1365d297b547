// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "mesh/canonical_order.h"
#include "support/clouds.h"
#include "support/laws.h"
#include "support/random.h"
#include "support/shuffled.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <cstdint>
#include <string>
#include <vector>

using calotte::Mesh;
using calotte::Triangles;
using namespace calotte::test;
namespace mesh_detail = calotte::mesh_detail;

namespace {

/// Triangles in canonical order and their neighbours.
struct Connected {
  std::string name;
  Triangles triangles, neighbours;
  std::int64_t sites;
};

Connected connected(const std::string& name, const Mesh& mesh) {
  return {name, mesh.triangles, mesh.neighbours, mesh.points.cols()};
}

std::vector<Connected> samples() {
  std::vector<Connected> out;
  for (const Cloud& cloud : small_clouds())
    out.push_back(connected(cloud.name, calotte::delaunay(cloud.points)));
  out.push_back(connected("of many blocks", calotte::delaunay(calotte::random_sphere(20'000, 1))));
  out.push_back(connected("open", calotte::delaunay(upper_half(3000, 3))));
  out.push_back(connected("a hub", calotte::delaunay(calotte::lat_lon_sphere(5, 900, true))));
  const calotte::Surface box = calotte::Surface::periodic({2, 1});
  out.push_back(connected("periodic", calotte::delaunay(calotte::random_points(2000, box), box)));
  return out;
}

/// Renames the vertices at random.
struct Renamed {
  Connected mesh;
  std::vector<std::int32_t> back; ///< the original name of each vertex
};

Renamed renamed(const Connected& mesh, Random& random) {
  const std::vector<std::int32_t> back = permutation(mesh.sites, random);
  const std::vector<std::int32_t> name = inverse_of(back);
  Renamed out{mesh, back};
  for (std::int32_t& id : out.mesh.triangles.reshaped())
    id = name[std::size_t(id)];
  return out;
}

} // namespace

TEST_CASE("shuffled and rotated triangles return to the same bits") {
  Random random(1);
  for (const Connected& mesh : samples()) {
    CAPTURE(mesh.name);
    Triangles triangles = mesh.triangles, neighbours = mesh.neighbours;
    shuffle_triangles(triangles, neighbours, random);
    CHECK(mesh_detail::is_canonical(triangles) == same_bits(triangles, mesh.triangles));
    mesh_detail::make_canonical(triangles, neighbours);
    CHECK(same_bits(triangles, mesh.triangles));
    CHECK(same_bits(neighbours, mesh.neighbours));
    CHECK(mesh_detail::is_canonical(triangles));
    mesh_detail::make_canonical(triangles, neighbours);
    CHECK(same_bits(triangles, mesh.triangles));
    CHECK(same_bits(neighbours, mesh.neighbours));
  }
}

TEST_CASE("renamed vertices regain their names") {
  Random random(2);
  for (const Connected& mesh : samples()) {
    CAPTURE(mesh.name);
    Renamed other = renamed(mesh, random);
    auto& [name, triangles, neighbours, sites] = other.mesh;
    shuffle_triangles(triangles, neighbours, random);
    mesh_detail::make_canonical(triangles, neighbours, other.back);
    CHECK(same_bits(triangles, mesh.triangles));
    CHECK(same_bits(neighbours, mesh.neighbours));
  }
}

TEST_CASE("triangles alone are ordered without neighbours") {
  Random random(3);
  for (const Connected& mesh : samples()) {
    CAPTURE(mesh.name);
    Triangles triangles = mesh.triangles, neighbours = mesh.neighbours;
    shuffle_triangles(triangles, neighbours, random);
    neighbours.resize(3, 0);
    mesh_detail::make_canonical(triangles, neighbours);
    CHECK(same_bits(triangles, mesh.triangles));
    CHECK(neighbours.cols() == 0);
  }
}

TEST_CASE("one thread and many give the same order") {
  Random random(4);
  Connected mesh = connected("", calotte::delaunay(calotte::random_sphere(40'000, 5)));
  const Connected before = mesh;
  shuffle_triangles(mesh.triangles, mesh.neighbours, random);
  tbb::task_arena(1).execute([&] { mesh_detail::make_canonical(mesh.triangles, mesh.neighbours); });
  CHECK(same_bits(mesh.triangles, before.triangles));
  CHECK(same_bits(mesh.neighbours, before.neighbours));
}

TEST_CASE("equal and degenerate triangles, which a file may contain, keep their order") {
  Triangles triangles(3, 5), neighbours(3, 5);
  triangles << 5, 2, 7, 1, 2, //
      1, 2, 5, 7, 5,          //
      7, 5, 1, 5, 2;
  neighbours << 0, 1, 2, 3, -1, //
      -1, 4, 0, 1, 2,           //
      3, -1, 1, 0, 4;
  mesh_detail::make_canonical(triangles, neighbours);
  Triangles expected(3, 5), across(3, 5);
  expected << 1, 1, 1, 2, 2, // the triangles 0, 2, 3, 1, 4
      7, 7, 7, 2, 2,         //
      5, 5, 5, 5, 5;
  across << -1, 3, 2, 3, 4, //
      2, 1, 3, 4, -1,       //
      0, 0, 0, -1, 1;
  CHECK(same_bits(triangles, expected));
  CHECK(same_bits(neighbours, across));
  CHECK(mesh_detail::is_canonical(triangles));
}

TEST_CASE("an empty list of triangles stays empty") {
  Triangles triangles(3, 0), neighbours(3, 0);
  mesh_detail::make_canonical(triangles, neighbours);
  CHECK(triangles.cols() == 0);
  const std::vector<std::int32_t> names = {2, 0, 1};
  mesh_detail::make_canonical(triangles, neighbours, names);
  CHECK(neighbours.cols() == 0);
  CHECK(mesh_detail::is_canonical(triangles));
}
