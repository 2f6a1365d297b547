// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/repair.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

using namespace calotte;
using namespace calotte::cvt_detail;

namespace {

std::vector<Vec3> vectors(const Points3& points) {
  std::vector<Vec3> out;
  for (const auto& p : points.colwise())
    out.push_back({p.x(), p.y(), p.z()});
  return out;
}

std::set<Ends> edges_of(const Connectivity& mesh) {
  std::set<Ends> edges;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      edges.insert(std::minmax({mesh.triangles(v, t), mesh.triangles((v + 1) % 3, t)}));
  return edges;
}

/// A mesh with its positions.
struct Sites {
  std::vector<Vec3> points;
  Connectivity mesh;

  explicit Sites(const Points3& given) : points(vectors(given)) {
    Mesh made = delaunay(given);
    mesh = {std::move(made.triangles), std::move(made.neighbours)};
  }
  SitePositions<Sphere> positions() const { return {{}, points}; }
};

/// The edges that are neither Delaunay nor constraints.
std::int64_t faults(const Sites& sites, const std::vector<Ends>& constraints) {
  Faults all;
  for (std::int32_t t = 0; t < sites.mesh.triangles.cols(); ++t)
    add_faults(sites.mesh, sites.positions(), t, all);
  CHECK(all.overturned.empty());
  return std::count_if(all.edges.begin(), all.edges.end(), [&](const TriangleEdge& edge) {
    const Ends ends = std::minmax({sites.mesh.triangles((edge.across + 1) % 3, edge.triangle),
                                   sites.mesh.triangles((edge.across + 2) % 3, edge.triangle)});
    return !std::binary_search(constraints.begin(), constraints.end(), ends);
  });
}

} // namespace

TEST_CASE("constrain: a mesh gets the edges of a long polygon, and is Delaunay beside them") {
  Sites sites(random_sphere(3000, 5));
  // A star of arcs from site 0, as long as a quarter of the sphere: they meet in it alone.
  std::vector<Ends> star;
  for (std::int32_t other = 1; star.size() < 40; ++other)
    if (dot(sites.points[0], sites.points[static_cast<std::size_t>(other)]) > 0)
      star.emplace_back(0, other);
  const std::set<Ends> before = edges_of(sites.mesh);
  CHECK(std::count_if(star.begin(), star.end(),
                      [&](const Ends& edge) { return !before.contains(edge); }) > 30);
  CHECK(constrain(sites.mesh, sites.positions(), star) == 0);
  const std::set<Ends> after = edges_of(sites.mesh);
  CHECK(after.size() == before.size());
  for (const Ends& edge : star)
    CHECK(after.contains(edge));
  CHECK(faults(sites, star) == 0);
}

TEST_CASE("constrain: edges that the mesh has change nothing") {
  Sites sites(random_sphere(500, 1));
  const Triangles before = sites.mesh.triangles;
  const std::set<Ends> all = edges_of(sites.mesh);
  CHECK(constrain(sites.mesh, sites.positions(), {all.begin(), all.end()}) == 0);
  CHECK((sites.mesh.triangles == before));
}

TEST_CASE("constrain: of edges that cross one is missing, and one through a site") {
  Points3 points(3, 6);
  points << 1, -1, 0, 0, 0, 0, //
      0, 0, 1, -1, 0, 0,       //
      0, 0, 0, 0, 1, -1;
  points.col(0) = Eigen::Vector3d(1, -0.4, 0).normalized();
  points.col(1) = Eigen::Vector3d(1, 0.4, 0).normalized();
  Points3 more(3, 9);
  more << points, Eigen::Vector3d(1, 0, 0.4).normalized(), Eigen::Vector3d(1, 0, -0.4).normalized(),
      Eigen::Vector3d(-1, 0, 0);
  {
    Sites sites(more);
    const std::vector<Ends> crossing{{0, 1}, {6, 7}};
    CHECK(constrain(sites.mesh, sites.positions(), crossing) == 1);
    CHECK(edges_of(sites.mesh).contains(crossing[0]));
    CHECK(faults(sites, crossing) == 0);
  }
  more.col(8) = Eigen::Vector3d(1, 0, 0); // between 0 and 1
  Sites sites(more);
  CHECK(constrain(sites.mesh, sites.positions(), {{0, 1}}) == 1);
  CHECK(faults(sites, {}) == 0);
}
