// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/voronoi.h>

#include "delaunay/delaunay.h"
#include "mesh/adjacency.h"
#include "mesh/canonical_order.h"
#include "support/clouds.h"
#include "support/errors.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/quality.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr double pi = std::numbers::pi, epsilon = std::numeric_limits<double>::epsilon();

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

struct Case {
  std::string name;
  Voronoi v;
};

/// Random, clustered, cocircular, thin and the smallest sets; with equal unit columns among them.
std::vector<Case> sphere_cases() {
  std::vector<Case> out;
  for (const std::vector<Cloud>& clouds : {small_clouds(), large_clouds()})
    for (const Cloud& cloud : clouds)
      if (cloud.closed)
        out.push_back({cloud.name, voronoi(delaunay(cloud.points))});
  const Points3 close = columns({{1, 1e-170, 2e-171}, {1, -3e-171, 1e-170}, {1, 1e-90, 0}});
  out.push_back({"as near as squares vanish", voronoi(delaunay(joined(octahedron(), close)))});
  return out;
}

/// Hexagons whose sites are moved by up to a part of their spacing; still Delaunay for 0.1.
Mesh uneven_hexagons(std::int64_t columns, std::int64_t rows, double spacing, double part) {
  Mesh mesh = hexagonal_box(columns, rows, spacing);
  Random random(7);
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      double& x = mesh.points(axis, i);
      x += random.real(0, 2 * part * spacing);
      if (x >= mesh.surface.period()[axis])
        x -= mesh.surface.period()[axis];
    }
  return mesh;
}

std::vector<Case> plane_cases() {
  return {{"smallest hexagons", voronoi(hexagonal_box(3, 4, 1))},
          {"hexagons", voronoi(hexagonal_box(20, 16, 30e3))},
          {"uneven hexagons", voronoi(uneven_hexagons(9, 8, 1e-3, 0.1))}};
}

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = [] {
    std::vector<Case> out = sphere_cases();
    for (Case& c : plane_cases())
      out.push_back(std::move(c));
    return out;
  }();
  return cases;
}

/// The index of a cell among those of a vertex.
int place_of(const Voronoi& v, std::int32_t vertex, std::int32_t cell) {
  for (int j = 0; j < 3; ++j)
    if (v.cells_on_vertex(j, vertex) == cell)
      return j;
  FAIL("a vertex without the cell");
  return 0;
}

/// The offset from a place to the nearest copy of another.
Vector difference(const Voronoi& v, const Vector& from, const Vector& to) {
  Vector d = to - from;
  for (int axis = 0; axis < 2 && !v.surface.is_sphere(); ++axis)
    d[axis] -= v.surface.period()[axis] * std::round(d[axis] / v.surface.period()[axis]);
  return d;
}

Vector cell(const Voronoi& v, std::int32_t i) {
  const Vector x = v.cells.col(i).cast<Real>();
  return v.surface.is_sphere() ? Vector(x.normalized()) : x;
}

/// True if some sites are equal up to rounding.
bool equal_sites(const Voronoi& v) {
  return v.cell_area.minCoeff() < 1e-9 * v.cell_area.maxCoeff();
}

Real sum(const Eigen::Ref<const Eigen::VectorXd>& values) { return values.cast<Real>().sum(); }

template <class Matrix> bool same(const Matrix& a, const Matrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a.array() == b.array()).all();
}

bool same(const IdLists& a, const IdLists& b) {
  return same(a.begin, b.begin) && same(a.items, b.items);
}

bool identical(const Voronoi& a, const Voronoi& b) {
  return same(a.cells, b.cells) && same(a.edges, b.edges) && same(a.vertices, b.vertices) &&
         same(a.edges_on_cell, b.edges_on_cell) && same(a.vertices_on_cell, b.vertices_on_cell) &&
         same(a.cells_on_cell, b.cells_on_cell) && same(a.cells_on_vertex, b.cells_on_vertex) &&
         same(a.edges_on_vertex, b.edges_on_vertex) && same(a.cells_on_edge, b.cells_on_edge) &&
         same(a.vertices_on_edge, b.vertices_on_edge) && same(a.dc, b.dc) && same(a.dv, b.dv) &&
         same(a.angle, b.angle) && same(a.cell_area, b.cell_area) &&
         same(a.vertex_area, b.vertex_area) && same(a.kites, b.kites);
}

void with_threads(std::size_t threads, const std::function<void()>& body) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  body();
}

// ---- Definitions

Real arc(const Vector& a, const Vector& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

/// Signed area of the spherical triangle.
Real triangle_area(const Vector& a, const Vector& b, const Vector& c) {
  const Vector p = b - a, q = c - a;
  return 2 * std::atan2(a.dot(p.cross(q)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// A triangle on the sphere by its definition.
struct Triangle {
  Vector corner[3], centre;
  Real radius, shortest, longest;
  /// Error bound of its circumcentre: some dozen roundoffs over the sine of the largest angle and
  /// the cosine of half the longest side; and here, because the corners are rounded to long
  /// doubles, the error of a normal that their norms tilt.
  Real error;

  Triangle(const Voronoi& v, std::int32_t t) {
    Real sides[3] = {};
    for (int j = 0; j < 3; ++j)
      corner[j] = cell(v, v.cells_on_vertex(j, t));
    for (int j = 0; j < 3; ++j)
      sides[j] = (corner[j] - corner[(j + 1) % 3]).norm();
    std::sort(sides, sides + 3);
    const Vector normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    centre = normal.normalized();
    radius = arc(centre, corner[0]);
    shortest = sides[0];
    longest = sides[2];
    error = (64 * epsilon * radius * sides[0] * sides[1] +
             4 * std::numeric_limits<Real>::epsilon() * longest) /
            (normal.norm() * std::sqrt(1 - longest * longest / 4));
  }

  /// Vertex, middle of the edge from the cell before, cell, middle of the edge to the next one.
  Real kite(int j) const {
    const Vector &o = corner[j], &next = corner[(j + 1) % 3], &before = corner[(j + 2) % 3];
    return triangle_area(o, (o + next).normalized(), centre) +
           triangle_area(o, centre, (o + before).normalized());
  }
};

} // namespace

// ---- Connectivity

TEST_CASE("laws: Euler's counts, and edges in the order of their cells") {
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    CAPTURE(c.name);
    const std::int64_t n = v.cells.cols(), e = v.edges.cols(), m = v.vertices.cols();
    CHECK(n - e + m == (v.surface.is_sphere() ? 2 : 0));
    CHECK(2 * e == 3 * m);
    for (const IdLists* lists : {&v.edges_on_cell, &v.vertices_on_cell, &v.cells_on_cell}) {
      REQUIRE(lists->size() == n);
      CHECK(lists->begin[0] == 0);
      CHECK(lists->begin[n] == 2 * e);
      CHECK(lists->items.size() == 2 * e);
      CHECK(same(lists->begin, v.edges_on_cell.begin));
    }
    for (const Eigen::Index size :
         {v.kites.size(), v.cells_on_vertex.size(), v.edges_on_vertex.size()})
      CHECK(size == 2 * e);
    for (const Eigen::Index size : {v.cells_on_edge.cols(), v.vertices_on_edge.cols(), v.dc.size(),
                                    v.dv.size(), v.angle.size()})
      CHECK(size == e);
    for (Eigen::Index k = 0; k < e; ++k) {
      REQUIRE(v.cells_on_edge(0, k) < v.cells_on_edge(1, k));
      if (k > 0)
        REQUIRE(std::pair(v.cells_on_edge(0, k - 1), v.cells_on_edge(1, k - 1)) <
                std::pair(v.cells_on_edge(0, k), v.cells_on_edge(1, k)));
    }
  }
}

TEST_CASE(
    "laws: an edge's left vertex runs from its first cell to its second, the right one back") {
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    CAPTURE(c.name);
    for (std::int32_t e = 0; e < v.dc.size(); ++e)
      for (const int side : {0, 1}) {
        const std::int32_t vertex = v.vertices_on_edge(side, e),
                           from = v.cells_on_edge(1 - side, e), to = v.cells_on_edge(side, e);
        const int j = place_of(v, vertex, from);
        REQUIRE(v.cells_on_vertex((j + 1) % 3, vertex) == to);
        REQUIRE(v.edges_on_vertex((j + 1) % 3, vertex) == e); // cell j between edges j and j + 1
      }
  }
}

TEST_CASE("laws: around a cell edge k lies between vertices k - 1 and k, neighbour k across it") {
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    CAPTURE(c.name);
    for (std::int32_t i = 0; i < v.cells.cols(); ++i) {
      const auto edges = v.edges_on_cell[i], vertices = v.vertices_on_cell[i],
                 cells = v.cells_on_cell[i];
      REQUIRE(edges.size() >= 3);
      std::int32_t before = vertices.back();
      for (std::size_t k = 0; k < edges.size(); ++k) {
        const std::int32_t e = edges[k], j = cells[k], vertex = vertices[k];
        REQUIRE(cells.front() <= j);
        const int first = i < j ? 0 : 1; // seen from this cell, right is left for the other
        REQUIRE(v.cells_on_edge(first, e) == i);
        REQUIRE(v.cells_on_edge(1 - first, e) == j);
        REQUIRE(v.vertices_on_edge(first, e) == before);
        REQUIRE(v.vertices_on_edge(1 - first, e) == vertex);
        before = vertex;
      }
    }
  }
}

// ---- Geometry

TEST_CASE("laws: cells, vertices and kites fill the sphere or the box") {
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    CAPTURE(c.name);
    const double whole = v.surface.is_sphere() ? 4 * pi : v.surface.period().prod();
    CHECK(std::abs(sum(v.cell_area) / whole - 1) < 1e-12L);
    CHECK(std::abs(sum(v.vertex_area) / whole - 1) < 1e-12L);
    CHECK(std::abs(sum(v.kites.reshaped()) / whole - 1) < 1e-12L);
    CHECK((v.kites.colwise().sum().transpose() - v.vertex_area).cwiseAbs().maxCoeff() <
          1e-15 * whole);
    CHECK(v.cell_area.minCoeff() > -1e-15 * whole);
    CHECK(v.dv.minCoeff() >= 0);
    CHECK(v.edges.allFinite());
    CHECK(v.vertices.allFinite());
    CHECK(v.angle.allFinite());
    CHECK(v.dc.allFinite());
    if (v.surface.is_sphere())
      for (const Points3* places : {&v.cells, &v.edges, &v.vertices})
        CHECK((places->colwise().norm().array() - 1).abs().maxCoeff() < 4 * epsilon);
    else
      for (const Points3* places : {&v.cells, &v.edges, &v.vertices}) {
        CHECK(places->minCoeff() >= 0);
        CHECK((places->topRows(2).rowwise().maxCoeff().array() < v.surface.period().array()).all());
        CHECK(places->row(2).maxCoeff() == 0);
      }
  }
}

TEST_CASE("circumcentres, kites and lengths agree with their definitions") {
  std::int64_t compared = 0;
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    if (!v.surface.is_sphere())
      continue;
    CAPTURE(c.name);
    std::vector<Triangle> triangles;
    const auto measurable = [](const Triangle& t) { // beyond, long doubles fail as well
      return t.shortest > 1e-9L && t.error < 1e-8L;
    };
    for (std::int32_t t = 0; t < v.vertices.cols(); ++t) {
      const Triangle& own = triangles.emplace_back(v, t);
      if (!measurable(own))
        continue;
      ++compared;
      REQUIRE((own.centre - v.vertices.col(t).cast<Real>()).norm() < 2 * epsilon + own.error);
      for (int j = 0; j < 3; ++j)
        REQUIRE(std::abs(own.kite(j) - v.kites(j, t)) <= own.longest * own.error);
    }
    for (std::int32_t e = 0; e < v.dc.size(); ++e) {
      const Vector a = cell(v, v.cells_on_edge(0, e)), b = cell(v, v.cells_on_edge(1, e));
      const Triangle &right = triangles[static_cast<std::size_t>(v.vertices_on_edge(0, e))],
                     &left = triangles[static_cast<std::size_t>(v.vertices_on_edge(1, e))];
      if (!measurable(right) || !measurable(left))
        continue;
      const Real length = arc(a, b);
      REQUIRE(std::abs(length - v.dc[e]) <
              8 * epsilon * length + 4 * std::numeric_limits<Real>::epsilon());
      REQUIRE((v.edges.col(e).cast<Real>() - (a + b).normalized()).norm() <
              4 * epsilon / (a + b).norm());
      REQUIRE(std::abs(arc(right.centre, left.centre) - v.dv[e]) < right.error + left.error);
    }
  }
  CHECK(compared > 50000);
}

TEST_CASE("laws: edges and vertices run counter-clockwise, normals and tangents are right-handed") {
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    CAPTURE(c.name);
    for (std::int32_t e = 0; e < v.dc.size(); ++e) {
      if (v.dv[e] < 1e-3 * v.dc[e] || v.dc[e] < 1e-9)
        continue;
      const Vector normal =
          difference(v, cell(v, v.cells_on_edge(0, e)), cell(v, v.cells_on_edge(1, e)));
      const Vector tangent = difference(v, v.vertices.col(v.vertices_on_edge(0, e)).cast<Real>(),
                                        v.vertices.col(v.vertices_on_edge(1, e)).cast<Real>());
      const Vector up =
          v.surface.is_sphere() ? Vector(v.edges.col(e).cast<Real>()) : Vector::UnitZ();
      REQUIRE(normal.cross(tangent).dot(up) > 0);
    }
    for (std::int32_t i = 0; i < v.cells.cols(); ++i) {
      const Vector centre = cell(v, i),
                   up = v.surface.is_sphere() ? centre : Vector(Vector::UnitZ());
      const auto cells = v.cells_on_cell[i];
      for (std::size_t k = 0; k < cells.size(); ++k) {
        const Vector d = difference(v, centre, cell(v, cells[k])),
                     f = difference(v, centre, cell(v, cells[(k + 1) % cells.size()]));
        if (std::min(d.norm(), f.norm()) >
            1e-12L * (v.surface.is_sphere() ? 1 : v.surface.period()[0]))
          REQUIRE(d.cross(f).dot(up) > -16 * epsilon * d.norm() * f.norm());
      }
    }
  }
}

TEST_CASE("angles are those of the normal from east, or from x") {
  const auto check_angle = [](double angle, Real expected) {
    REQUIRE(std::abs(std::remainder(angle - expected, 2 * std::numbers::pi_v<Real>)) < 1e-14L);
  };
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    if (!v.surface.is_sphere())
      continue;
    CAPTURE(c.name);
    CHECK(v.angle.cwiseAbs().maxCoeff() <= pi);
    for (std::int32_t e = 0; e < v.dc.size(); ++e) {
      const Vector normal = cell(v, v.cells_on_edge(1, e)) - cell(v, v.cells_on_edge(0, e)),
                   up = v.edges.col(e).cast<Real>();
      if (normal.norm() < 1e-3L)
        continue;
      const bool pole = up[0] == 0 && up[1] == 0;
      const Vector east = pole ? Vector::UnitY() : Vector(-up[1], up[0], 0).normalized();
      check_angle(v.angle[e], std::atan2(normal.dot(up.cross(east)), normal.dot(east)));
    }
  }
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    if (v.surface.is_sphere())
      continue;
    CAPTURE(c.name);
    CHECK(v.angle.minCoeff() >= 0);
    CHECK(v.angle.maxCoeff() < 2 * pi);
    for (std::int32_t e = 0; e < v.dc.size(); ++e) {
      const Vector normal =
          difference(v, cell(v, v.cells_on_edge(0, e)), cell(v, v.cells_on_edge(1, e)));
      check_angle(v.angle[e], std::atan2(normal[1], normal[0]));
    }
  }
}

TEST_CASE("quality() gives the same spacings, areas, degrees and shapes") {
  for (const Points3& points : {random_sphere(300, 1), fibonacci_sphere(200), cubed_sphere(5)}) {
    const Mesh mesh = delaunay(points);
    const Voronoi v = voronoi(mesh);
    const CellFields fields = cell_fields(v);
    const Quality q = quality(mesh);
    const auto check_range = [](const Eigen::VectorXd& values, const ValueRange& range) {
      CHECK(std::abs(values.minCoeff() - range.min) < 1e-12);
      CHECK(std::abs(values.mean() - range.mean) < 1e-12);
      CHECK(std::abs(values.maxCoeff() - range.max) < 1e-12);
    };
    check_range(v.dc, q.spacing);
    check_range(v.cell_area, q.cell_area);
    check_range(fields.quality, q.cell_quality);
    for (std::size_t degree = 0; degree < q.degrees.size(); ++degree)
      CHECK((fields.degree.array() == static_cast<std::int32_t>(degree)).count() ==
            q.degrees[degree]);
  }
}

TEST_CASE("the edge between opposite cells lies at the vertex to its left") {
  Mesh mesh{octahedron(), Triangles(3, 8), {}, {0, 1, 2, 3, 4, 5}};
  mesh.triangles << 0, 0, 2, 0, 0, 1, 3, 0, //
      1, 3, 3, 2, 5, 5, 5, 4,               //
      3, 2, 4, 4, 1, 3, 4, 5;
  mesh.neighbours = mesh_detail::neighbours_of(mesh.triangles, 6);
  const Voronoi v = voronoi(mesh);
  for (Eigen::Index e = 0; e < v.cells_on_edge.cols(); ++e)
    if (v.cells_on_edge(0, e) == 0 && v.cells_on_edge(1, e) == 3) {
      CHECK(v.dc[e] == doctest::Approx(pi));
      CHECK(v.edges.col(e) == v.vertices.col(v.vertices_on_edge(1, e)));
    } else {
      CHECK(v.dc[e] == doctest::Approx(pi / 2));
    }
  CHECK(v.edges.allFinite());
}

TEST_CASE("regular hexagons are exact up to rounding") {
  for (const double spacing : {1e-3, 1.0, 30e3}) {
    const Mesh mesh = hexagonal_box(8, 6, spacing);
    const Voronoi v = voronoi(mesh);
    const double area = std::sqrt(3) / 2 * spacing * spacing;
    const auto check_all = [](const auto& values, double expected) {
      CHECK((values.reshaped().array() / expected - 1).abs().maxCoeff() < 1e-13);
    };
    CHECK(v.cells.cols() == 48);
    for (std::int64_t i = 0; i < 48; ++i)
      CHECK(v.edges_on_cell.count(i) == 6);
    check_all(v.dc, spacing);
    check_all(v.dv, spacing / std::sqrt(3));
    check_all(v.cell_area, area);
    check_all(v.vertex_area, area / 2);
    check_all(v.kites, area / 6);
    CHECK(nominal_spacing(cell_fields(v)) == doctest::Approx(spacing).epsilon(1e-13));
  }
}

TEST_CASE("a plane of hexagons is canonical, and its columns and rows are where they should be") {
  for (const auto& [columns, rows] :
       {std::pair<std::int64_t, std::int64_t>{3, 4}, {4, 4}, {7, 10}}) {
    const Mesh mesh = hexagonal_box(columns, rows, 2);
    CHECK(mesh.points.cols() == columns * rows);
    CHECK(mesh.points.col(columns + 1).isApprox(Eigen::Vector3d(3, std::sqrt(3), 0)));
    CHECK(mesh.points.minCoeff() == 0);
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
      CHECK(mesh.triangles(0, t) == mesh.triangles.col(t).minCoeff());
      if (t > 0)
        CHECK(std::lexicographical_compare(
            mesh.triangles.col(t - 1).begin(), mesh.triangles.col(t - 1).end(),
            mesh.triangles.col(t).begin(), mesh.triangles.col(t).end()));
    }
  }
  CHECK_THROWS_WITH_AS(hexagonal_box(2, 4, 1), doctest::Contains("columns is 2"), Error);
  CHECK_THROWS_WITH_AS(hexagonal_box(3, 2, 1), doctest::Contains("rows is 2"), Error);
  CHECK_THROWS_WITH_AS(hexagonal_box(3, 5, 1), doctest::Contains("even"), Error);
  CHECK_THROWS_WITH_AS(hexagonal_box(1 << 20, 1 << 20, 1), doctest::Contains("fewer rows"), Error);
  for (const double spacing : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_WITH_AS(hexagonal_box(3, 4, spacing), doctest::Contains("spacing"), Error);
}

TEST_CASE("flat triangles of equal sites give finite results that fill the box") {
  Mesh mesh = hexagonal_box(6, 6, 1);
  mesh.points.col(8) = mesh.points.col(7);
  const Voronoi v = voronoi(mesh);
  for (std::int32_t t = 0; t < v.vertices.cols(); ++t) { // the widest has sides of 1, sqrt 3 and 2
    const Vector apart =
        difference(v, v.vertices.col(t).cast<Real>(), cell(v, v.cells_on_vertex(0, t)));
    CHECK(apart.norm() < 1.01L);
  }
  CHECK(v.kites.allFinite());
  CHECK(v.dv.allFinite());
  CHECK(tangential_weights(v, 0, v.dc.size()).weights.allFinite());
  CHECK(sum(v.cell_area) == doctest::Approx(mesh.surface.area()));
}

TEST_CASE("unit columns keep their bits, and norms have no effect") {
  const Points3 points = random_sphere(500, 3);
  const Mesh mesh = delaunay(points);
  const Voronoi v = voronoi(mesh);
  CHECK(same(v.cells, mesh.points));
  Mesh scaled = mesh;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    scaled.points.col(i) *= std::pow(2.0, i % 1300 - 640);
  const Voronoi w = voronoi(scaled);
  CHECK((w.cells - v.cells).cwiseAbs().maxCoeff() < 4 * epsilon);
  CHECK((w.dc - v.dc).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((w.cell_area - v.cell_area).cwiseAbs().maxCoeff() < 1e-13);
  CHECK(same(w.edges_on_cell, v.edges_on_cell));
}

TEST_CASE("the same bits for any number of threads") {
  const Mesh mesh = delaunay(random_sphere(40000, 5));
  Voronoi one;
  TangentialWeights weights;
  with_threads(1, [&] {
    one = voronoi(mesh);
    weights = tangential_weights(one, 0, one.dc.size());
  });
  for (const std::size_t threads : {2, 4})
    with_threads(threads, [&] {
      CHECK(identical(voronoi(mesh), one));
      const TangentialWeights other = tangential_weights(one, 0, one.dc.size());
      CHECK(same(other.weights, weights.weights));
      CHECK(same(other.edges, weights.edges));
    });
}

// ---- Tangential weights

TEST_CASE("weights are of the other edges of both cells, counter-clockwise from the edge on") {
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    CAPTURE(c.name);
    const TangentialWeights w = tangential_weights(v, 0, v.dc.size());
    for (std::int32_t e = 0; e < v.dc.size(); ++e) {
      std::vector<std::int32_t> expected;
      for (const int side : {0, 1}) {
        const auto edges = v.edges_on_cell[v.cells_on_edge(side, e)];
        std::vector<std::int32_t> ring(edges.begin(), edges.end());
        std::rotate(ring.begin(), std::find(ring.begin(), ring.end(), e), ring.end());
        expected.insert(expected.end(), ring.begin() + 1, ring.end());
      }
      const auto others = w.edges[e];
      REQUIRE(std::vector(others.begin(), others.end()) == expected);
    }
  }
}

TEST_CASE("law: weight dc_e / dv_e' is antisymmetric, so that energy is conserved") {
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    CAPTURE(c.name);
    const TangentialWeights w = tangential_weights(v, 0, v.dc.size());
    CHECK(w.weights.allFinite());
    if (equal_sites(v))
      continue;
    // The kites around a cell sum to its area up to the rounding of the largest.
    const double tolerance =
        64 * epsilon * std::max(1.0, v.kites.cwiseAbs().maxCoeff() / v.cell_area.minCoeff());
    for (std::int32_t e = 0; e < v.dc.size(); ++e)
      for (std::int64_t k = w.edges.begin[e]; k < w.edges.begin[e + 1]; ++k) {
        const std::int32_t f = w.edges.items[k];
        const auto of_other = w.edges[f];
        const std::int64_t back =
            w.edges.begin[f] + (std::find(of_other.begin(), of_other.end(), e) - of_other.begin());
        REQUIRE(back < w.edges.begin[f + 1]);
        const double here = w.weights[k] * v.dc[e] * v.dv[e],
                     there = w.weights[back] * v.dc[f] * v.dv[f];
        REQUIRE(std::abs(here + there) <= tolerance * v.dv[e] * v.dv[f]);
      }
  }
}

/// Thuburn et al. (2009): the tangential fluxes out of a triangle sum to the divergences of
/// its cells, weighted by the kites.
TEST_CASE(
    "law: the reconstruction's divergence on a triangle is that of its cells, by their kites") {
  Random random(3);
  for (const Case& c : all_cases()) {
    const Voronoi& v = c.v;
    CAPTURE(c.name);
    if (equal_sites(v))
      continue;
    const std::int64_t n = v.cells.cols(), edges = v.dc.size();
    const TangentialWeights w = tangential_weights(v, 0, edges);
    Eigen::VectorXd normal(edges), divergence = Eigen::VectorXd::Zero(n), tangential(edges);
    for (double& u : normal)
      u = random.real(-1, 1);
    for (Eigen::Index e = 0; e < edges; ++e) {
      divergence[v.cells_on_edge(0, e)] += normal[e] * v.dv[e];
      divergence[v.cells_on_edge(1, e)] -= normal[e] * v.dv[e];
      tangential[e] = 0;
      for (std::int64_t k = w.edges.begin[e]; k < w.edges.begin[e + 1]; ++k)
        tangential[e] += w.weights[k] * normal[w.edges.items[k]];
    }
    divergence.array() /= v.cell_area.array();
    for (std::int32_t t = 0; t < v.vertices.cols(); ++t) {
      double flux = 0, expected = 0, scale = 0;
      for (int j = 0; j < 3; ++j) {
        const std::int32_t e = v.edges_on_vertex(j, t), i = v.cells_on_vertex(j, t);
        const double out = (v.vertices_on_edge(0, e) == t ? 1 : -1) * v.dc[e] * tangential[e];
        const double share = v.kites(j, t) * divergence[i];
        flux += out;
        expected += share;
        scale += std::abs(out) + std::abs(share);
      }
      REQUIRE(std::abs(flux - expected) <= 1e-9 * scale);
    }
  }
}

TEST_CASE("hexagons reconstruct a uniform field's tangential component") {
  const Voronoi v = voronoi(hexagonal_box(6, 8, 30e3));
  const TangentialWeights w = tangential_weights(v, 0, v.dc.size());
  for (Eigen::Index e = 0; e < v.dc.size(); ++e) {
    double tangential = 0;
    for (std::int64_t k = w.edges.begin[e]; k < w.edges.begin[e + 1]; ++k) {
      const double along = std::cos(v.angle[w.edges.items[k]] - 0.7); // of a unit vector at 0.7
      tangential += w.weights[k] * along;
    }
    CHECK(std::abs(tangential - std::sin(0.7 - v.angle[e])) < 1e-13);
  }
}

TEST_CASE("chunks of weights are parts of the whole") {
  const Voronoi v = voronoi(delaunay(random_sphere(300, 4)));
  const TangentialWeights whole = tangential_weights(v, 0, v.dc.size());
  std::int64_t at = 0;
  for (const auto& [first, last] :
       {std::pair<std::int64_t, std::int64_t>{0, 1}, {1, 1}, {1, 500}, {500, v.dc.size()}}) {
    const TangentialWeights part = tangential_weights(v, first, last);
    const std::int64_t size = part.weights.size();
    CHECK(same(part.weights, DoubleVector(whole.weights.segment(at, size))));
    CHECK(same(part.edges.items, Ids(whole.edges.items.segment(at, size))));
    const auto begin = whole.edges.begin.segment(first, last - first + 1);
    CHECK((part.edges.begin.array() + at == begin.array()).all());
    at += size;
  }
  CHECK(at == whole.weights.size());
}

// ---- Fields of the cells

TEST_CASE("cell fields use the edges of the cell, and the density is relative") {
  const Density density = tanh_bump({1, 2, 3}, 0.5, 0.3, 0.01);
  const Voronoi v = voronoi(delaunay(random_sphere(400, 6)));
  const CellFields fields = cell_fields(v, density), uniform = cell_fields(v);
  CHECK(same(fields.area, v.cell_area));
  CHECK(fields.density.maxCoeff() == 1);
  CHECK(uniform.density.cwiseEqual(1).all());
  const Eigen::VectorXd rho = evaluate(density, v.cells);
  CHECK(fields.density.isApprox(rho / rho.maxCoeff(), 1e-15));
  std::vector<std::vector<Eigen::Index>> edges(400);
  for (Eigen::Index e = 0; e < v.dc.size(); ++e)
    for (const int side : {0, 1})
      edges[static_cast<std::size_t>(v.cells_on_edge(side, e))].push_back(e);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    CHECK(fields.degree[at] == std::ssize(edges[i]));
    CHECK(fields.spacing[at] == doctest::Approx(v.dc(edges[i]).mean()));
    CHECK(fields.quality[at] == v.dv(edges[i]).minCoeff() / v.dv(edges[i]).maxCoeff());
  }
}

TEST_CASE("the nominal spacing is that of hexagons that follow the density") {
  CellFields fields; // hexagons of spacing 3 where the density is 1, 6 where it is 1/16
  fields.density = Eigen::VectorXd{{1, 1.0 / 16, 1, 1, 1.0 / 16}};
  fields.area = std::sqrt(3) / 2 * 9 * fields.density.array().pow(-0.5);
  CHECK(nominal_spacing(fields) == doctest::Approx(3).epsilon(1e-14));
}

// ---- Sites in a hemisphere

namespace {

Points3 in_a_cap(std::int64_t n, double radius, std::uint64_t seed) {
  Points3 points = random_sphere(n, seed);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double height = 1 - (1 - std::cos(radius)) * (1 - points(2, i)) / 2,
                 ring = std::sqrt((1 - height * height) / (1 - points(2, i) * points(2, i)));
    points.col(i) << ring * points(0, i), ring * points(1, i), height;
  }
  return points;
}

Points3 from_degrees(const std::vector<std::pair<double, double>>& places) {
  Points3 out(3, std::ssize(places));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double lon = places[i].first * pi / 180, lat = places[i].second * pi / 180;
    out.col(static_cast<Eigen::Index>(i)) << std::cos(lat) * std::cos(lon),
        std::cos(lat) * std::sin(lon), std::sin(lat);
  }
  return out;
}

/// The part of random places that are nearest to each site.
Eigen::VectorXd sampled_areas(const Points3& sites, std::int64_t samples) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(sites.cols());
  const Points3 places = random_sphere(samples, 77);
  for (Eigen::Index i = 0; i < samples; ++i) {
    Eigen::Index nearest = 0;
    (sites.transpose() * places.col(i)).maxCoeff(&nearest);
    areas[nearest] += 4 * pi / static_cast<double>(samples);
  }
  return areas;
}

} // namespace

TEST_CASE("sites in a hemisphere have bounded cells that fill the sphere") {
  Points3 equator(3, 9); // on the border of the hemisphere, and some inside
  equator << 1, 0, -1, 0, 0.6, -0.8, 0, 0.48, -0.6, //
      0, 1, 0, -1, 0.8, -0.6, 0, 0.6, 0.64,         //
      0, 0, 0, 0, 0, 0, 1, 0.64, 0.48;
  const std::vector<std::pair<std::string, Points3>> sets{
      {"four around the pole and one",
       from_degrees({{0, 50}, {90, 50}, {180, 50}, {270, 50}, {30, 70}})},
      {"four on a circle", from_degrees({{0, 50}, {90, 50}, {180, 50}, {270, 50}})},
      {"four", from_degrees({{0, 10}, {80, 20}, {200, 15}, {40, 80}})},
      {"equator", equator},
      {"a cap", in_a_cap(60, 1.2, 4)},
      {"a small cap", in_a_cap(200, 1e-3, 5)},
      {"half of the sphere", in_a_cap(500, 1.57, 6)}};
  for (const auto& [name, sites] : sets) {
    CAPTURE(name);
    const Mesh mesh = delaunay(sites);
    REQUIRE(!mesh.closed());
    const Voronoi cells = voronoi(mesh);
    const Eigen::Index n = sites.cols();
    CHECK(cells.vertices.cols() == 2 * n - 4);
    CHECK(cells.cells_on_edge.cols() == 3 * n - 6);
    CHECK(std::abs(cells.cell_area.sum() - 4 * pi) < 1e-11);
    CHECK(cells.cell_area.minCoeff() > 0);
    for (Eigen::Index v = 0; v < cells.vertices.cols(); ++v) { // no site is nearer than its three
      const Eigen::VectorXd nearness = cells.cells.transpose() * cells.vertices.col(v);
      for (const std::int32_t cell : cells.cells_on_vertex.col(v))
        CHECK(nearness[cell] > nearness.maxCoeff() - 1e-9);
    }
    if (n > 100)
      continue; // too many for few places
    const std::int64_t samples = 40000;
    const Eigen::VectorXd expected = sampled_areas(cells.cells, samples);
    const double error = 5 * 4 * pi * 0.5 / std::sqrt(static_cast<double>(samples));
    CHECK((cells.cell_area - expected).cwiseAbs().maxCoeff() < error);
  }
}

TEST_CASE("the cells of sites in a hemisphere do not depend on the order of the sites") {
  const Points3 sites = in_a_cap(300, 0.4, 8);
  const Points3 turned = sites.rowwise().reverse();
  const Voronoi a = voronoi(delaunay(sites)), b = voronoi(delaunay(turned));
  CHECK((a.cell_area - b.cell_area.reverse()).cwiseAbs().maxCoeff() < 1e-12);
}

// ---- Refusals

TEST_CASE("an input that is no closed mesh is refused in one line that names the place") {
  const auto check_refused = [](const auto& mesh, std::int64_t index, const std::string& words) {
    CAPTURE(words);
    const Error error = test::error_of([&] { voronoi(mesh); });
    const std::string message = error.what();
    CAPTURE(message);
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(error.index() == index);
    CHECK(has(message, words));
  };
  const Mesh good = delaunay(random_sphere(50, 2));
  check_refused(Mesh{}, -1, "open");
  Mesh bitten = delaunay(upper_half(50, 1)); // without a triangle of its boundary
  Eigen::Index outer = 0;
  while (bitten.neighbours.col(outer).minCoeff() >= 0)
    ++outer;
  bitten.triangles.col(outer) = bitten.triangles.rightCols(1).eval();
  bitten.triangles.conservativeResize(3, bitten.triangles.cols() - 1);
  mesh_detail::make_canonical(bitten.triangles, bitten.neighbours = Triangles(3, 0));
  bitten.neighbours = mesh_detail::neighbours_of(bitten.triangles, 50);
  CHECK(has(test::message_of([&] { voronoi(bitten); }), "not the hull of its sites"));
  const auto check_changed = [&](std::int64_t index, const std::string& words,
                                 const std::function<void(Mesh&)>& change) {
    Mesh mesh = good;
    change(mesh);
    check_refused(mesh, index, words);
  };
  check_changed(-1, "neighbours of 95", [](Mesh& m) { m.neighbours.conservativeResize(3, 95); });
  check_changed(7, "outside", [](Mesh& m) { m.triangles(1, 7) = 50; });
  check_changed(7, "outside", [](Mesh& m) { m.triangles(1, 7) = -1; });
  check_changed(7, "twice", [](Mesh& m) { m.triangles(1, 7) = m.triangles(0, 7); });
  for (const std::int32_t neighbour : {-1, 3, 96})
    check_changed(3, "triangle 3 has a neighbour",
                  [&](Mesh& m) { m.neighbours(0, 3) = neighbour; });
  check_changed(4, "site 4 has no direction", [](Mesh& m) { m.points.col(4).setZero(); });
  check_changed(4, "site 4 has no direction", [](Mesh& m) { m.points(1, 4) = std::nan(""); });
  Mesh pinched; // two tetrahedra that share two sites: the number of triangles is that of a closed
                // mesh
  pinched.points = random_sphere(6, 1);
  const Triangles tetrahedron{{0, 0, 0, 1}, {1, 2, 3, 3}, {2, 3, 1, 2}},
      beside{{3, 3, 3, 1}, {1, 2, 0, 0}, {2, 0, 1, 2}};
  pinched.triangles.resize(3, 8);
  pinched.triangles << tetrahedron,
      (tetrahedron.array() < 2).select(tetrahedron, tetrahedron.array() + 2);
  pinched.neighbours.resize(3, 8);
  pinched.neighbours << beside, beside.array() + 4;
  check_refused(pinched, 0, "one ring");

  Mesh plane = hexagonal_box(4, 4, 1);
  plane.points(0, 5) = 4;
  check_refused(plane, 5, "outside the periodic box");
  plane.points(0, 5) = std::nan("");
  check_refused(plane, 5, "outside the periodic box");
  plane.surface = Surface::periodic({4, 0});
  check_refused(plane, -1, "the box");
  plane = hexagonal_box(4, 4, 1);
  plane.triangles.conservativeResize(3, 31);
  check_refused(plane, -1, "31 triangles");
}

TEST_CASE("a box so narrow that neighbours meet twice is refused") {
  Mesh plane; // two by two squares, each of two triangles
  plane.points = Points3{{0, 0.5, 0, 0.5}, {0, 0, 0.5, 0.5}, {0, 0, 0, 0}};
  plane.surface = Surface::periodic({1, 1});
  plane.triangles.resize(3, 8);
  plane.neighbours.resize(3, 8);
  for (Eigen::Index i = 0; i < 4; ++i) {
    const Eigen::Index beside = i ^ 1, above = i ^ 2, across = i ^ 3;
    plane.triangles.col(2 * i) << i, beside, across;
    plane.neighbours.col(2 * i) << 2 * beside + 1, 2 * i + 1, 2 * above + 1;
    plane.triangles.col(2 * i + 1) << i, across, above;
    plane.neighbours.col(2 * i + 1) << 2 * above, 2 * beside, 2 * i;
  }
  CHECK(has(test::refusal_of([&] { voronoi(plane); }), "shares two edges"));
}

TEST_CASE("densities that do not fit are refused") {
  const Voronoi plane = voronoi(hexagonal_box(3, 4, 1)),
                sphere = voronoi(delaunay(random_sphere(20, 1)));
  const Density bump = tanh_bump({1, 2, 3}, 0.5, 0.3, 0.01);
  CHECK_THROWS_WITH_AS(cell_fields(plane, bump), doctest::Contains("plane"), Error);
  CHECK_THROWS_WITH_AS(cell_fields(sphere, tanh_bump({0, 0, 0}, 0.5, 0.3, 0.01)),
                       doctest::Contains("centre"), Error);
  Density zero;
  zero.kind = Density::Kind::callable;
  zero.callable = [](const auto&, Eigen::Ref<Eigen::VectorXd> rho) { rho.setZero(); };
  CHECK_THROWS_WITH_AS(cell_fields(sphere, zero), doctest::Contains("zero at every cell"), Error);
}
