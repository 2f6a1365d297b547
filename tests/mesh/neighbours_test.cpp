// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/faces.h"
#include "mesh/rows.h"
#include "mesh/stars.h"
#include "support/clouds.h"
#include "support/errors.h"
#include "support/meshes.h"
#include "support/parts.h"
#include "support/random.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh.h>
#include <calotte/voronoi.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

using Pair = std::array<std::int32_t, 2>;

/// A box of columns x rows sites, each with six neighbours; of two by two sites, each with three
/// neighbours, twice.
Mesh torus(std::int32_t columns, std::int32_t rows) {
  const auto place = [&](std::int32_t x, std::int32_t y) {
    return (x + columns) % columns + columns * ((y + rows) % rows);
  };
  Mesh mesh;
  mesh.surface = Surface::periodic({columns, rows});
  mesh.points.resize(3, columns * rows);
  mesh.triangles.resize(3, 2 * columns * rows);
  mesh.neighbours.resize(3, 2 * columns * rows);
  for (std::int32_t y = 0; y < rows; ++y)
    for (std::int32_t x = 0; x < columns; ++x) {
      const std::int32_t here = place(x, y), right = place(x + 1, y), above = place(x, y + 1);
      mesh.points.col(here) << x, y, 0;
      mesh.triangles.col(2 * here) << here, right, above;
      mesh.triangles.col(2 * here + 1) << right, place(x + 1, y + 1), above;
      mesh.neighbours.col(2 * here) << 2 * here + 1, 2 * place(x - 1, y) + 1,
          2 * place(x, y - 1) + 1;
      mesh.neighbours.col(2 * here + 1) << 2 * above, 2 * here, 2 * right;
    }
  return mesh;
}

/// Meshes of all kinds, of which some have sites where the boundary passes more than once, and
/// sites in no triangle.
std::vector<NamedMesh> meshes() {
  std::vector<NamedMesh> all = meshes_of_all_surfaces();
  all.push_back({"2 x 2 sites of a box", torus(2, 2)});
  all.push_back({"2 x 5 sites of a box", torus(2, 5)});
  Random random(7);
  for (const std::size_t k : {std::size_t{0}, all.size() - 3, all.size() - 1})
    all.push_back({"a part of " + all[k].name,
                   part_of(all[k].mesh, [&](std::int64_t) { return random.integer(0, 9) < 6; })});
  return all;
}

/// The other ends of the edges at each site, ascending, an edge once, by the triangles alone.
std::vector<std::vector<std::int32_t>> ends_by_definition(const Mesh& mesh) {
  std::vector<std::vector<std::int32_t>> ends(static_cast<std::size_t>(mesh.points.cols()));
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.neighbours(i, t) < t) { // the later of its triangles, or the only one
        const std::int32_t a = mesh.triangles((i + 1) % 3, t), b = mesh.triangles((i + 2) % 3, t);
        ends[static_cast<std::size_t>(a)].push_back(b);
        ends[static_cast<std::size_t>(b)].push_back(a);
      }
  for (auto& list : ends)
    std::sort(list.begin(), list.end());
  return ends;
}

/// The sites that follow each other in the triangles at a site.
std::multiset<Pair> pairs_around(const Mesh& mesh, std::int32_t site) {
  std::multiset<Pair> pairs;
  for (const auto& t : mesh.triangles.colwise())
    for (int i = 0; i < 3; ++i)
      if (t(i) == site)
        pairs.insert({t((i + 1) % 3), t((i + 2) % 3)});
  return pairs;
}

} // namespace

TEST_CASE("the neighbours of a site are the other ends of its edges, counter-clockwise") {
  for (const auto& [name, mesh] : meshes()) {
    CAPTURE(name);
    const IdLists lists = neighbours(mesh);
    const std::vector<std::vector<std::int32_t>> ends = ends_by_definition(mesh);
    REQUIRE(lists.size() == mesh.points.cols());
    for (std::int32_t i = 0; i < lists.size(); ++i) {
      CAPTURE(i);
      const std::vector<std::int32_t> list(lists[i].begin(), lists[i].end());
      std::vector<std::int32_t> sorted = list;
      std::sort(sorted.begin(), sorted.end());
      CHECK(sorted == ends[static_cast<std::size_t>(i)]);
      // One after another they make the triangles, but for the ends of fans.
      std::multiset<Pair> left = pairs_around(mesh, i);
      const std::size_t triangles = left.size();
      std::size_t fans = list.size() - triangles;
      if (fans == 0 && !list.empty())
        CHECK(list.front() == sorted.front());
      for (std::size_t k = 0; k < list.size(); ++k) {
        const auto at = left.find({list[k], list[(k + 1) % list.size()]});
        if (at != left.end())
          left.erase(at);
        else
          --fans;
      }
      CHECK(left.empty());
      CHECK(fans == 0);
      if (list.size() == triangles + 1) // one fan: it begins and ends at open edges
        CHECK(!pairs_around(mesh, i).contains({list.back(), list.front()}));
    }
  }
}

TEST_CASE("a walk around a site meets its triangles and its neighbours, of several fans one") {
  for (const auto& [name, mesh] : meshes()) {
    CAPTURE(name);
    const mesh_detail::Faces faces = mesh_detail::faces_of(mesh);
    const mesh_detail::Stars stars(faces);
    const IdLists lists = neighbours(mesh);
    for (std::int32_t i = 0; i < lists.size(); ++i) {
      CAPTURE(i);
      const auto triangles = static_cast<std::int64_t>(pairs_around(mesh, i).size());
      CHECK(stars.size(i) == triangles);
      CHECK(stars.is_closed(i) == (triangles > 0 && lists.count(i) == triangles));
      std::vector<std::int32_t> walked;
      std::int64_t corners = 0;
      const bool closed =
          stars.for_each_neighbour(i, [&](std::int32_t other) { walked.push_back(other); });
      CHECK(closed == stars.is_closed(i));
      CHECK(closed == stars.for_each_corner(i, [&](mesh_detail::Corner corner) {
        CHECK(site_at(faces, corner) == i);
        ++corners;
      }));
      CHECK(std::ssize(walked) == corners + (closed || corners == 0 ? 0 : 1));
      if (closed)
        std::rotate(walked.begin(), std::ranges::min_element(walked), walked.end());
      if (lists.count(i) > triangles + 1) // several fans
        CHECK(!std::ranges::search(lists[i], walked).empty());
      else if (std::ranges::count(lists[i], lists[i].empty() ? -1 : lists[i].front()) <= 1)
        CHECK(std::ranges::equal(lists[i], walked));
    }
  }
}

TEST_CASE("the loops of the boundary have each outer edge once, and turn around a fan") {
  for (const auto& [name, mesh] : meshes()) {
    CAPTURE(name);
    std::multiset<Pair> outer;
    for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
      for (int i = 0; i < 3; ++i)
        if (mesh.neighbours(i, t) < 0)
          outer.insert({mesh.triangles((i + 1) % 3, t), mesh.triangles((i + 2) % 3, t)});
    const IdLists loops = boundary_loops(mesh);
    CHECK((loops.size() == 0) == outer.empty());
    for (std::int64_t k = 0; k < loops.size(); ++k) {
      const auto loop = loops[k];
      CHECK(loop.front() == *std::ranges::min_element(loop));
      CHECK(loop.size() >= 3);
      for (std::size_t j = 0; j < loop.size(); ++j) {
        const std::int32_t before = loop[j], site = loop[(j + 1) % loop.size()],
                           after = loop[(j + 2) % loop.size()];
        const auto edge = outer.find({before, site});
        REQUIRE(edge != outer.end());
        outer.erase(edge);
        // The fan that starts at the edge to `after` ends at the edge from `before`.
        std::multiset<Pair> pairs = pairs_around(mesh, site);
        std::int32_t end = after;
        for (auto pair = pairs.lower_bound({end, -1}); pair != pairs.end() && (*pair)[0] == end;
             pair = pairs.lower_bound({end, -1})) {
          end = (*pair)[1];
          pairs.erase(pair);
        }
        if (!mesh.surface.is_box()) // where two sites may share several edges
          CHECK(end == before);
      }
    }
    CHECK(outer.empty());
  }
}

TEST_CASE("a boundary that passes a site twice makes loops that touch there") {
  Mesh mesh; // two triangles of the plane that share one corner
  mesh.surface = Surface::plane();
  mesh.points.resize(3, 5);
  mesh.points << 0, 1, 1, -1, -1, 0, -1, 1, 1, -1, 0, 0, 0, 0, 0;
  mesh.triangles.resize(3, 2);
  mesh.triangles << 0, 0, 1, 3, 2, 4;
  mesh.neighbours = Triangles::Constant(3, 2, -1);
  const IdLists loops = boundary_loops(mesh);
  REQUIRE(loops.size() == 2);
  CHECK(std::ranges::equal(loops[0], std::array{0, 1, 2}));
  CHECK(std::ranges::equal(loops[1], std::array{0, 3, 4}));
}

TEST_CASE("in a closed mesh they are the cells on each cell") {
  for (const auto& [name, mesh] : closed_meshes()) {
    CAPTURE(name);
    const IdLists lists = neighbours(mesh), cells = voronoi(mesh).cells_on_cell;
    CHECK(equal_bits(lists.begin, cells.begin));
    CHECK(equal_bits(lists.items, cells.items));
  }
}

TEST_CASE("neighbours that do not fit are refused, with the index of the triangle") {
  const Mesh mesh = delaunay(random_sphere(50, 1));
  const auto index_of = [](const Mesh& broken) {
    return error_of([&] { neighbours(broken); }).index();
  };
  Mesh broken = mesh;
  broken.triangles(2, 9) = 50;
  CHECK(index_of(broken) == 9);
  broken = mesh;
  broken.triangles(2, 9) = broken.triangles(0, 9);
  CHECK(index_of(broken) == 9);
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    for (const std::int32_t wrong : {-2, t, (t + 50) % 96, 96}) {
      if (wrong == mesh.neighbours(1, t))
        continue;
      broken = mesh;
      broken.neighbours(1, t) = wrong;
      const std::int64_t index = index_of(broken);
      CHECK((index == t || index == mesh.neighbours(1, t)));
    }
  broken = mesh;
  broken.neighbours.resize(3, 0);
  CHECK(code_of([&] { neighbours(broken); }) == ErrorCode::invalid_argument);
  CHECK(code_of([&] { boundary_loops(broken); }) == ErrorCode::invalid_argument);
}

TEST_CASE("marks grow to all that is within some rows of them") {
  Random random(3);
  for (const auto& [name, mesh] : meshes()) {
    CAPTURE(name);
    const std::vector<std::vector<std::int32_t>> ends = ends_by_definition(mesh);
    const IdLists lists = neighbours(mesh);
    std::vector<std::uint8_t> marks(ends.size(), 0);
    std::vector<int> distance(ends.size(), 1000);
    std::deque<std::size_t> queue;
    for (int k = 0; k < 2; ++k) {
      const auto site = static_cast<std::size_t>(random.integer(0, int(ends.size()) - 1));
      marks[site] = 1;
      distance[site] = 0;
      queue.push_back(site);
    }
    for (; !queue.empty(); queue.pop_front())
      for (const std::int32_t end : ends[queue.front()]) {
        const auto other = static_cast<std::size_t>(end);
        if (distance[other] > distance[queue.front()] + 1) {
          distance[other] = distance[queue.front()] + 1;
          queue.push_back(other);
        }
      }
    for (int rows = 0; rows < 5; ++rows) {
      const std::vector<std::uint8_t> found = mesh_detail::grown(lists, marks, rows);
      for (std::size_t i = 0; i < ends.size(); ++i)
        CHECK((found[i] != 0) == (distance[i] <= rows));
    }
  }
}
