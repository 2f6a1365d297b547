// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/adjacency.h"
#include "mesh/connectivity.h"
#include "mesh/submesh.h"
#include "support/meshes.h"
#include "support/random.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using mesh_detail::Submesh;

namespace {

/// Some triangles, in any order.
std::vector<std::int32_t> some_triangles(const Mesh& mesh, Random& random) {
  const int share = random.integer(1, 10);
  std::vector<std::int32_t> some;
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    if (random.integer(1, 10) <= share)
      some.push_back(t);
  random.shuffle(some);
  return some;
}

/// The laws of the numbers of a part, both ways.
void check_numbers(const Submesh& part, const Mesh& mesh) {
  const auto in_mesh = [&](std::int32_t site) {
    return part.sites[static_cast<std::size_t>(site)];
  };
  std::int64_t open = 0;
  for (Eigen::Index k = 0; k < part.faces.triangles.cols(); ++k) {
    const std::int32_t t = part.triangles[static_cast<std::size_t>(k)];
    for (int i = 0; i < 3; ++i) {
      REQUIRE(in_mesh(part.faces.triangles(i, k)) == mesh.triangles(i, t));
      const std::int32_t own = part.faces.neighbours(i, k), beyond = mesh.neighbours(i, t);
      if (own >= 0)
        REQUIRE(part.triangles[static_cast<std::size_t>(own)] == beyond);
      else
        REQUIRE(std::ranges::count(part.triangles, beyond) == 0);
      open += own < 0;
    }
  }
  REQUIRE(std::ssize(part.rim) == open);
  for (const Submesh::RimEdge& edge : part.rim) {
    CHECK(std::ranges::count(part.triangles, edge.triangle) == 1);
    CHECK(in_mesh(edge.from) == mesh.triangles((edge.across + 1) % 3, edge.triangle));
    CHECK(in_mesh(edge.to) == mesh.triangles((edge.across + 2) % 3, edge.triangle));
  }
  CHECK(std::ranges::is_sorted(
      part.rim, {}, [](const Submesh::RimEdge& edge) { return std::pair(edge.from, edge.to); }));
}

} // namespace

TEST_CASE("a part has numbers both ways, and its sites ascend until some are put first") {
  Random random(1);
  for (const auto& [name, mesh] : meshes_of_all_surfaces())
    for (int round = 0; round < 5; ++round) {
      CAPTURE(name);
      Submesh part =
          mesh_detail::extract(mesh.triangles, mesh.neighbours, some_triangles(mesh, random));
      check_numbers(part, mesh);
      std::vector<std::int32_t> sites;
      for (const std::int32_t t : part.triangles)
        sites.insert(sites.end(), mesh.triangles.col(t).begin(), mesh.triangles.col(t).end());
      std::sort(sites.begin(), sites.end());
      sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
      CHECK(part.sites == sites);

      const auto is_first = [](std::int32_t site) { return site % 3 == 0; };
      std::vector<std::uint8_t> marks(sites.size());
      std::transform(sites.begin(), sites.end(), marks.begin(), is_first);
      CHECK(put_first(part, marks) == std::count(marks.begin(), marks.end(), 1));
      check_numbers(part, mesh);
      std::stable_partition(sites.begin(), sites.end(), is_first);
      CHECK(part.sites == sites);
    }
}

TEST_CASE("a part that is put back leaves the mesh as it was, in any order of parts") {
  Random random(2);
  for (const auto& [name, mesh] : meshes_of_all_surfaces())
    for (int round = 0; round < 5; ++round) {
      CAPTURE(name);
      const Submesh one =
          mesh_detail::extract(mesh.triangles, mesh.neighbours, some_triangles(mesh, random));
      std::vector<std::int32_t> others;
      for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
        if (std::ranges::count(one.triangles, t) == 0)
          others.push_back(t);
      Submesh rest = mesh_detail::extract(mesh.triangles, mesh.neighbours, others);
      put_first(rest, std::vector<std::uint8_t>(rest.sites.size(), 1));
      mesh_detail::Connectivity back{mesh.triangles, mesh.neighbours};
      splice(one, back);
      CHECK((back.triangles == mesh.triangles));
      CHECK((back.neighbours == mesh.neighbours));
      back.triangles.setConstant(-1); // all that the two parts do not put back
      splice(rest, back);
      splice(one, back);
      CHECK((back.triangles == mesh.triangles));
      CHECK((back.neighbours == mesh.neighbours));
    }
}

TEST_CASE("a flip inside a part reaches the mesh, and the triangles beyond the rim") {
  const Mesh mesh = delaunay(random_sphere(100, 4));
  const IdLists lists = neighbours(mesh);
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v) {
      const std::int32_t u = mesh.neighbours(v, t);
      Submesh part = mesh_detail::extract(mesh.triangles, mesh.neighbours, {t, u});
      // The edge ab of both gives way to cd.
      auto& [triangles, neighbours] = part.faces;
      const int i = mesh_detail::vertex_across(neighbours, 0, 1),
                j = mesh_detail::vertex_across(neighbours, 1, 0);
      const std::int32_t a = triangles((i + 1) % 3, 0), b = triangles((i + 2) % 3, 0),
                         c = triangles(i, 0), d = triangles(j, 1);
      const auto site = [&](std::int32_t own) { return part.sites[static_cast<std::size_t>(own)]; };
      if (std::ranges::count(lists[site(c)], site(d)) > 0)
        continue; // there is an edge cd beyond a site of three triangles
      triangles.col(0) << c, a, d;
      triangles.col(1) << d, b, c;
      neighbours.col(0) << -1, 1, -1;
      neighbours.col(1) << -1, 0, -1;
      mesh_detail::Connectivity back{mesh.triangles, mesh.neighbours};
      splice(part, back);
      CHECK((back.neighbours == mesh_detail::neighbours_of(back.triangles, mesh.points.cols())));
    }
}

TEST_CASE("a part is a mesh of its own") {
  Random random(3);
  for (const auto& [name, mesh] : meshes_of_all_surfaces()) {
    CAPTURE(name);
    std::vector<std::int32_t> some = some_triangles(mesh, random);
    if (some.empty())
      continue;
    std::sort(some.begin(), some.end());
    const Submesh part = mesh_detail::extract(mesh.triangles, mesh.neighbours, some);
    const Mesh alone = as_mesh(part, mesh);
    CHECK(check_surface(alone).failure.empty());
    CHECK(check_surface(alone).triangles == std::ssize(some));
    for (Eigen::Index i = 0; i < alone.points.cols(); ++i)
      CHECK((alone.points.col(i) == mesh.points.col(part.sites[static_cast<std::size_t>(i)])));
  }
}
