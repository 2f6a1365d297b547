// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "mesh/adjacency.h"
#include "support/files.h"
#include "support/oracle.h"
#include "support/random.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// Open meshes for FESOM: each triangle has two neighbours or three, each node a triangle.

using namespace calotte;
using namespace calotte::test;
using oracle::Triple;

namespace {

std::set<Triple> triangles_of(const Mesh& mesh) {
  std::set<Triple> all;
  for (const auto& t : mesh.triangles.colwise())
    all.insert({t[0], t[1], t[2]});
  return all;
}

/// By the rule, sweep after sweep, from the triangles' corners alone.
std::set<Triple> left_by_the_rule(std::set<Triple> all) {
  for (bool changed = true; changed;) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
    const auto sides = [](const Triple& t) {
      return std::array{std::minmax(t[0], t[1]), std::minmax(t[1], t[2]), std::minmax(t[2], t[0])};
    };
    for (const Triple& t : all)
      for (const auto& [a, b] : sides(t))
        ++uses[{a, b}];
    changed = std::erase_if(all, [&](const Triple& t) {
                int neighbours = 0;
                for (const auto& [a, b] : sides(t))
                  neighbours += uses.at({a, b}) - 1;
                return neighbours < 2;
              }) > 0;
  }
  return all;
}

/// A mesh that has lost triangles at random, with values that tell its sites and triangles.
MeshFile ragged(int sites, double share, std::uint64_t seed) {
  const Mesh whole = delaunay(fibonacci_sphere(sites));
  Random random(seed);
  std::vector<std::int32_t> kept;
  for (std::int32_t t = 0; t < whole.triangles.cols(); ++t)
    if (random.real(0, 1) > share)
      kept.push_back(t);
  Triangles triangles(3, std::ssize(kept));
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    triangles.col(t) = whole.triangles.col(kept[static_cast<std::size_t>(t)]);
  MeshFile file;
  file.mesh = mesh_detail::mesh_of_columns(whole.points, triangles);
  const std::int64_t n = file.mesh->points.cols();
  file.density = Eigen::VectorXd::LinSpaced(n, 1, 2);
  file.fields.push_back({.name = "z", .values = file.mesh->points.row(2)});
  file.fields.push_back({.name = "lowest",
                         .location = FieldLocation::vertices,
                         .values = triangles.row(0).cast<double>()});
  return file;
}

} // namespace

TEST_CASE("what is left is the largest part in which each triangle has two neighbours") {
  for (const double share : {0.05, 0.15, 0.25})
    for (const std::uint64_t seed : {1, 2, 3}) {
      CAPTURE(share);
      CAPTURE(seed);
      const MeshFile before = ragged(500, share, seed);
      const auto [after, report] = without_ears(before);
      const Mesh& mesh = *after.mesh;
      std::map<double, std::int32_t> old; // by z, which differs from site to site
      for (std::int32_t i = 0; i < before.mesh->points.cols(); ++i)
        old[before.mesh->points(2, i)] = i;
      std::set<Triple> left;
      for (const auto& t : mesh.triangles.colwise())
        left.insert({old.at(mesh.points(2, t[0])), old.at(mesh.points(2, t[1])),
                     old.at(mesh.points(2, t[2]))});
      CHECK(left == left_by_the_rule(triangles_of(*before.mesh)));
      CHECK(report.triangles == before.mesh->triangles.cols() - mesh.triangles.cols());
      CHECK(report.sites == before.mesh->points.cols() - mesh.points.cols());
      CHECK(report.triangles > 0);
      CHECK((mesh.neighbours == mesh_detail::neighbours_of(mesh.triangles, mesh.points.cols())));
      for (const auto& t : mesh.neighbours.colwise())
        CHECK((t.array() >= 0).count() >= 2);
      std::set<std::int32_t> used(mesh.triangles.reshaped().begin(),
                                  mesh.triangles.reshaped().end());
      CHECK(std::ssize(used) == mesh.points.cols());
    }
}

TEST_CASE("density and fields follow") {
  const MeshFile before = ragged(400, 0.1, 5), after = without_ears(before).file;
  const Mesh& mesh = *after.mesh;
  REQUIRE(after.fields.size() == 2);
  CHECK(after.fields[0].values == mesh.points.row(2).transpose());
  REQUIRE(after.density.size() == mesh.points.cols());
  REQUIRE(after.fields[1].values.size() == mesh.triangles.cols());
  const auto old_of = [&](std::int32_t site) {
    Eigen::Index old = 0;
    (before.mesh->points.row(2).array() - mesh.points(2, site)).abs().minCoeff(&old);
    return old;
  };
  for (std::int32_t i = 0; i < mesh.points.cols(); ++i)
    CHECK(after.density[i] == before.density[old_of(i)]);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    CHECK(after.fields[1].values[t] == static_cast<double>(old_of(mesh.triangles(0, t))));
}

TEST_CASE("a closed mesh stays, and a mesh of ears alone is refused") {
  MeshFile closed;
  closed.mesh = delaunay(fibonacci_sphere(50));
  const auto [file, removed] = without_ears(closed);
  CHECK(file.mesh->triangles == closed.mesh->triangles);
  CHECK(removed.triangles == 0);
  CHECK(removed.sites == 0);
  MeshFile strip; // three triangles in a row
  strip.mesh = delaunay(Points3{{1, 1, 1, 1, 1}, {0, 0.1, 0.2, 0.05, 0.15}, {0, 0, 0, 0.1, 0.1}});
  REQUIRE(strip.mesh->triangles.cols() == 3);
  CHECK(code_of([&] { without_ears(strip); }) == ErrorCode::invalid_argument);
  CHECK(code_of([] { without_ears(MeshFile{}); }) == ErrorCode::invalid_argument);
}

TEST_CASE("FESOM's depths: levels and bottoms below 0, in the order of the nodes") {
  const Scratch scratch;
  const Mesh mesh = delaunay(fibonacci_sphere(40));
  for (const double sign : {1.0, -1.0})
    for (const Numbering numbering : {Numbering::input, Numbering::curve}) {
      WriteOptions options{.format = Format::fesom, .numbering = numbering};
      options.depth_levels = sign * Eigen::Vector4d(0, 10, 25.5, 4000);
      options.site_depth = 1000 * (mesh.points.row(2).transpose().array() + 2);
      write(scratch / "nod2d.out", mesh, options);
      std::istringstream depths(test::read_file(scratch / "aux3d.out")),
          nodes(test::read_file(scratch / "nod2d.out"));
      double value = 0;
      for (const double expected : {4.0, 0.0, -10.0, -25.5, -4000.0}) {
        depths >> value;
        CHECK(value == expected);
      }
      int count = 0, id = 0, coast = 0;
      nodes >> count;
      REQUIRE(count == 40);
      for (double longitude = 0, latitude = 0; count > 0; --count) {
        nodes >> id >> longitude >> latitude >> coast;
        depths >> value;
        CHECK(value == doctest::Approx(-1000 * (std::sin(latitude * std::acos(-1.0) / 180) + 2)));
      }
      CHECK(!(depths >> value));
    }
}

TEST_CASE("depths that FESOM refuses are refused before any file is written") {
  const Scratch scratch;
  const Mesh mesh = delaunay(fibonacci_sphere(40));
  WriteOptions good{.format = Format::fesom};
  good.depth_levels = Eigen::Vector3d(0, 10, 100);
  good.site_depth = Eigen::VectorXd::Constant(40, 50);
  const auto refuses = [&](const WriteOptions& options) {
    CHECK(code_of([&] { write(scratch / "nod2d.out", mesh, options); }) ==
          ErrorCode::invalid_argument);
    CHECK(scratch.files() == 0);
  };
  for (const std::vector<double>& levels : std::vector<std::vector<double>>{
           {0, 10}, {5, 10, 20}, {0, 10, 10}, {0, 10, -20}, {0, 10, 12000}, {0, 20, 10}}) {
    WriteOptions bad = good;
    bad.depth_levels = Eigen::Map<const Eigen::VectorXd>(levels.data(), std::ssize(levels));
    refuses(bad);
  }
  WriteOptions few = good;
  few.site_depth.conservativeResize(39);
  refuses(few);
  WriteOptions deep = good;
  deep.site_depth[7] = std::numeric_limits<double>::quiet_NaN();
  refuses(deep);
  write(scratch / "nod2d.out", mesh, good);
  CHECK(scratch.files() == 3);
}
