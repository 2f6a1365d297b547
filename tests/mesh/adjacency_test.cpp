// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "mesh/adjacency.h"
#include "mesh/faces.h"
#include "mesh/vertex_rings.h"
#include "support/clouds.h"
#include "support/laws.h"
#include "support/random.h"
#include "support/shuffled.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

using calotte::Mesh;
using calotte::Triangles;
using namespace calotte::test;
namespace mesh_detail = calotte::mesh_detail;

namespace {

/// neighbours_of() by its definition: from all half-edges of the same two ends.
Triangles neighbours_by_definition(const Triangles& triangles) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int64_t>> edges;
  const auto from = [&](std::int64_t h) { return triangles((h + 1) % 3, h / 3); };
  const auto to = [&](std::int64_t h) { return triangles((h + 2) % 3, h / 3); };
  for (std::int64_t h = 0; h < triangles.size(); ++h)
    edges[std::minmax({from(h), to(h)})].push_back(h);
  Triangles neighbours = Triangles::Constant(3, triangles.cols(), -1);
  for (const auto& [ends, sides] : edges)
    if (sides.size() == 2 && from(sides[0]) == to(sides[1]) && to(sides[0]) == from(sides[1]))
      for (const std::size_t i : {0U, 1U})
        neighbours.data()[sides[i]] = std::int32_t(sides[1 - i] / 3);
  return neighbours;
}

} // namespace

TEST_CASE("neighbours are rebuilt from triangles alone") {
  Random random(1);
  std::vector<Cloud> clouds = small_clouds();
  clouds.push_back({"of many blocks", calotte::random_sphere(20'000, 1)});
  clouds.push_back({"open", upper_half(3000, 3), false});
  clouds.push_back({"a hub", calotte::lat_lon_sphere(5, 900, true)});
  for (const Cloud& cloud : clouds) {
    CAPTURE(cloud.name);
    const Mesh mesh = calotte::delaunay(cloud.points);
    Triangles triangles = mesh.triangles, neighbours = mesh.neighbours;
    CHECK(same_bits(mesh_detail::neighbours_of(triangles, mesh.points.cols()), neighbours));
    shuffle_triangles(triangles, neighbours, random);
    const Triangles found = tbb::task_arena(1).execute(
        [&] { return mesh_detail::neighbours_of(triangles, mesh.points.cols()); });
    CHECK(same_bits(found, neighbours));
  }
}

TEST_CASE("no neighbour along an edge of one triangle, of three, or of two of equal direction") {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    CAPTURE(round);
    const int points = random.integer(1, 12);
    Triangles triangles(3, random.integer(0, 20));
    for (std::int32_t& id : triangles.reshaped())
      id = random.integer(0, points - 1);
    CHECK(same_bits(mesh_detail::neighbours_of(triangles, points),
                    neighbours_by_definition(triangles)));
  }
}

TEST_CASE("a walk visits each corner at a site once, or those from a boundary on") {
  const Mesh mesh = calotte::delaunay(calotte::random_sphere(500, 3));
  const mesh_detail::Faces faces = mesh_detail::faces_of(mesh);
  const mesh_detail::VertexRings rings = mesh_detail::make_vertex_rings(mesh);
  CHECK(rings.items.size() == mesh.triangles.size());
  for (std::int64_t i = 0; i < mesh.points.cols(); ++i) {
    const auto ring = rings[i];
    const mesh_detail::Corner first = ring.front();
    std::size_t place = 0;
    const mesh_detail::Corner last = walk_around(faces, first, [&](mesh_detail::Corner corner) {
      REQUIRE(site_at(faces, corner) == i);
      REQUIRE(following_site(faces, corner) >= following_site(faces, first));
      REQUIRE(place < ring.size());
      REQUIRE(ring[place].triangle == corner.triangle);
      ++place;
    });
    CHECK(!exists(last));
    CHECK(place == ring.size());
  }

  const Mesh open = calotte::delaunay(upper_half(300, 4));
  const mesh_detail::Faces half = mesh_detail::faces_of(open);
  for (std::int32_t t = 0; t < open.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (open.neighbours(mesh_detail::next_vertex(v), t) < 0) {
        const mesh_detail::Corner last =
            walk_around(half, mesh_detail::Corner{t, v}, [](mesh_detail::Corner) {});
        CHECK(last.triangle == t);
      }
}
