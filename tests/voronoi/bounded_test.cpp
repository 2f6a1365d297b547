// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/errors.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

// The Voronoi cells of a bounded plane. The truth is made here: of each ring of the boundary the
// part nearer to one site than to all others, by cutting the ring along all bisectors.

using namespace calotte;

namespace {

using Place = Eigen::Vector2d;
using Ring = std::vector<Place>;

Eigen::MatrixXd matrix_of(const Ring& ring) {
  Eigen::MatrixXd matrix(2, std::ssize(ring));
  for (std::size_t k = 0; k < ring.size(); ++k)
    matrix.col(static_cast<Eigen::Index>(k)) = ring[k];
  return matrix;
}

Surface domain_of(const std::vector<Ring>& rings) {
  Surface::Rings matrices;
  for (const Ring& ring : rings)
    matrices.push_back(matrix_of(ring));
  return Surface::plane().within(matrices);
}

/// An L with a hole near its reflex corner, in any orientation.
Surface bent() {
  return domain_of({{{0, 0}, {0, 2}, {1, 2}, {1, 1}, {3, 1}, {3, 0}},
                    {{0.4, 0.3}, {0.9, 0.35}, {0.8, 0.8}, {0.35, 0.7}}});
}

/// Two pools, one of them with an island that has a pond.
Surface pools() {
  const auto square = [](double x, double y, double side) {
    return Ring{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
  };
  return domain_of({square(0, 0, 10), square(3, 3, 5), square(4, 4, 3), square(12, 1, 4)});
}

double twice_area(const Ring& ring) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const Place a = ring[k] - ring[0], b = ring[k + 1] - ring[0];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

/// The part of a ring nearer to a than to b; where it falls apart, along lines of no width.
Ring nearer(const Ring& ring, const Place& a, const Place& b) {
  const auto over = [&](const Place& p) { return (a - b).dot(p - 0.5 * (a + b)); };
  Ring part;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Place &p = ring[k], &q = ring[(k + 1) % ring.size()];
    const double at_p = over(p), at_q = over(q);
    if (at_p >= 0)
      part.push_back(p);
    if ((at_p < 0) != (at_q < 0))
      part.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return part;
}

Place at(const Points3& points, std::int64_t i) { return points.col(i).head<2>(); }

/// The sign of a ring's area in a domain: holes count less.
double sign_of(const Surface& domain, std::size_t r) {
  Surface::Rings others = domain.rings();
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(r));
  const auto& corners = domain.rings()[r];
  const bool hole = !others.empty() &&
                    Surface::plane().within(others).contains({corners(0, 0), corners(1, 0), 0});
  return hole ? -1 : 1;
}

std::vector<double> areas_by_cutting(const Points3& sites, const Surface& domain) {
  std::vector<double> areas(static_cast<std::size_t>(sites.cols()), 0);
  for (std::size_t r = 0; r < domain.rings().size(); ++r) {
    Ring whole;
    for (const auto corner : domain.rings()[r].colwise())
      whole.emplace_back(corner);
    const double sign = sign_of(domain, r);
    for (Eigen::Index i = 0; i < sites.cols(); ++i) {
      Ring part = whole;
      for (Eigen::Index j = 0; j < sites.cols(); ++j)
        if (j != i && !part.empty())
          part = nearer(part, at(sites, i), at(sites, j));
      if (!part.empty())
        areas[static_cast<std::size_t>(i)] += sign * std::abs(twice_area(part)) / 2;
    }
  }
  return areas;
}

double perimeter(const Surface& domain) {
  double sum = 0;
  for (const DoubleMatrix& ring : domain.rings())
    for (Eigen::Index k = 0; k < ring.cols(); ++k)
      sum += (ring.col((k + 1) % ring.cols()) - ring.col(k)).norm();
  return sum;
}

double cross(const Place& a, const Place& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Of the largest coordinate, and of the domain.
double size_of(const Surface& domain) {
  double size = 0;
  for (const DoubleMatrix& ring : domain.rings())
    size = std::max(size, ring.cwiseAbs().maxCoeff());
  return size;
}

void check_areas(const Voronoi& v, const Points3& sites, const Surface& domain) {
  const double whole = domain.area();
  CHECK(std::abs(v.cell_area.sum() - whole) <= 1e-12 * whole);
  CHECK(std::abs(v.kites.sum() - whole) <= 1e-12 * whole);
  CHECK(std::abs(v.vertex_area.sum() - whole) <= 1e-12 * whole);
  const std::vector<double> truth = areas_by_cutting(sites, domain);
  for (std::size_t i = 0; i < truth.size(); ++i)
    CHECK(std::abs(v.cell_area[static_cast<Eigen::Index>(i)] - truth[i]) <= 1e-10 * whole);
}

/// The lists name each other, as those of a closed mesh do.
void check_lists(const Voronoi& v) {
  for (const IdLists* lists : {&v.edges_on_cell, &v.vertices_on_cell, &v.cells_on_cell}) {
    REQUIRE(lists->size() == v.cells.cols());
    CHECK(lists->items.size() == lists->begin[v.cells.cols()]);
    CHECK(lists->begin == v.edges_on_cell.begin);
  }
  for (Eigen::Index i = 0; i < v.cells.cols(); ++i) {
    const auto edges = v.edges_on_cell[i], vertices = v.vertices_on_cell[i],
               others = v.cells_on_cell[i];
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const std::int32_t e = edges[k];
      const bool first = v.cells_on_edge(0, e) == i;
      REQUIRE(v.cells_on_edge(first ? 0 : 1, e) == i);
      CHECK(v.cells_on_edge(first ? 1 : 0, e) == others[k]);
      CHECK(v.vertices_on_edge(first ? 0 : 1, e) == vertices[(k > 0 ? k : vertices.size()) - 1]);
      CHECK(v.vertices_on_edge(first ? 1 : 0, e) == vertices[k]);
    }
  }
  for (Eigen::Index vertex = 0; vertex < v.vertices.cols(); ++vertex)
    for (int j = 0; j < 3; ++j) {
      const std::int32_t e = v.edges_on_vertex(j, vertex), cell = v.cells_on_vertex(j, vertex);
      if (e >= 0)
        CHECK((v.vertices_on_edge.col(e).array() == vertex).any());
      if (cell < 0)
        continue;
      REQUIRE(e >= 0);
      CHECK((v.cells_on_edge.col(e).array() == cell).any());
      CHECK((v.cells_on_edge.col(v.edges_on_vertex((j + 1) % 3, vertex)).array() == cell).any());
    }
}

/// Vertices are as far from all their cells, boundary edges lie on the boundary.
void check_duality(const Voronoi& v, const Surface& domain) {
  const double rounding = 1e-11 * size_of(domain);
  for (Eigen::Index vertex = 0; vertex < v.vertices.cols(); ++vertex) {
    const Place p = at(v.vertices, vertex);
    double nearest = 1e300;
    for (const auto site : v.cells.colwise())
      nearest = std::min(nearest, (site.head<2>() - p).norm());
    for (const std::int32_t cell : v.cells_on_vertex.col(vertex))
      if (cell >= 0)
        CHECK(std::abs((at(v.cells, cell) - p).norm() - nearest) <= rounding);
  }
  double along = 0;
  for (Eigen::Index e = 0; e < v.cells_on_edge.cols(); ++e) {
    const Place right = at(v.vertices, v.vertices_on_edge(0, e)),
                left = at(v.vertices, v.vertices_on_edge(1, e));
    CHECK(std::abs(v.dv[e] - (left - right).norm()) <= rounding);
    const bool inner = v.cells_on_edge(1, e) >= 0;
    if (!inner)
      along += v.dv[e];
    const Place from = at(v.cells, v.cells_on_edge(0, e));
    const Place normal = inner ? Place(at(v.cells, v.cells_on_edge(1, e)) - from)
                               : Place((left - right).y(), -(left - right).x());
    CHECK(cross(normal, left - right) >= -rounding * normal.norm());
    CHECK(std::abs(cross(normal, Place(std::cos(v.angle[e]), std::sin(v.angle[e])))) <=
          1e-12 * normal.norm());
    CHECK(normal.dot(Place(std::cos(v.angle[e]), std::sin(v.angle[e]))) >= 0);
    CHECK(std::abs(v.dc[e] - (inner ? normal.norm() : std::sqrt(3) * v.dv[e])) <= rounding);
    const Place middle = inner ? Place(from + normal / 2) : Place((right + left) / 2);
    CHECK((at(v.edges, e) - middle).norm() <= rounding);
  }
  CHECK(along == doctest::Approx(perimeter(domain)).epsilon(1e-12));
}

void check_weights(const Voronoi& v) {
  const TangentialWeights weights = tangential_weights(v, 0, v.dc.size());
  for (Eigen::Index e = 0; e < v.dc.size(); ++e) {
    std::set<std::int32_t> others;
    for (std::int64_t k = weights.edges.begin[e]; k < weights.edges.begin[e + 1]; ++k) {
      const std::int32_t other = weights.edges.items[k];
      REQUIRE(other >= 0);
      others.insert(other);
      CHECK(std::isfinite(weights.weights[k]));
    }
    CHECK(!others.contains(static_cast<std::int32_t>(e)));
  }
}

Voronoi checked(const PointsRef& places, const Surface& domain) {
  const Mesh mesh = delaunay(places, domain);
  const Voronoi v = voronoi(mesh);
  CHECK(!v.surface.is_sphere());
  check_areas(v, mesh.points, domain);
  check_lists(v);
  check_duality(v, domain);
  check_weights(v);
  return v;
}

/// Vertices less edges and cells, on a surface of parts with holes.
std::int64_t euler(const Voronoi& v) { return v.vertices.cols() - v.dc.size() + v.cells.cols(); }

TEST_CASE("random sites in a rectangle, few and many") {
  const Surface domain = rectangle({-1, 2}, {2, 3});
  for (const std::int64_t n : {3, 4, 5, 8, 30, 400})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(n);
      CAPTURE(seed);
      CHECK(euler(checked(random_points(n, domain, {}, seed), domain)) == 1);
    }
}

/// Evenly spread, so that the boundary cuts no cell into parts.
Points3 relaxed(std::int64_t n, const Surface& domain, std::uint64_t seed) {
  return make_grid({.surface = domain,
                    .start = {.points = random_points(n, domain, {}, seed)},
                    .stop = {.max_iterations = 40}})
      .mesh.points;
}

/// Where a cell is no polygon, that is said of the right one.
bool is_refused(const PointsRef& places, const Surface& domain) {
  try {
    voronoi(delaunay(places, domain));
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(test::has(error.what(), "island"));
    CHECK(error.index() >= 0);
    return true;
  }
  return false;
}

TEST_CASE("a domain with a hole and a reflex corner, and one of several parts") {
  for (const auto& [domain, characteristic] : {std::pair(bent(), 0), std::pair(pools(), 0 + 1 + 1)})
    for (const std::int64_t n : {60, 200})
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        CAPTURE(n);
        CAPTURE(seed);
        CHECK(euler(checked(relaxed(n, domain, seed), domain)) == characteristic);
        const Points3 places = random_points(n, domain, {}, seed);
        if (!is_refused(places, domain))
          checked(places, domain);
      }
}

TEST_CASE("few sites around a hole") {
  const Surface domain = bent();
  Points2 places(2, 5);
  places << 0.2, 0.95, 0.6, 0.5, 2.4, 0.5, 0.6, 0.15, 1.4, 0.5;
  CHECK(euler(checked(places, domain)) == 0);
  Points2 apart(2, 3);
  apart << 0.1, 0.2, 2.8, 1.8, 0.1, 0.1;
  CHECK(is_refused(apart, domain));
}

Points3 inside(const Points3& places, const Surface& domain) {
  Points3 kept(3, 0);
  for (const auto place : places.colwise())
    if (domain.contains(place)) {
      kept.conservativeResize(3, kept.cols() + 1);
      kept.col(kept.cols() - 1) = place;
    }
  return kept;
}

/// All is cocircular; the boundary runs through vertices, along edges and across both.
TEST_CASE("lattices that the boundary cuts at vertices and along edges") {
  Points3 lattice(3, 36);
  for (int i = 0; i < 36; ++i)
    lattice.col(i) << i % 6, i / 6, 0;
  for (const double low : {-0.5, -0.25, 0.0, -1.0})
    checked(lattice, rectangle({low, low}, {5.5, 5.25}));
  // A frame around the cell of site 14, along its edges.
  const Surface framed = domain_of({{{-0.5, -0.5}, {5.5, -0.5}, {5.5, 5.5}, {-0.5, 5.5}},
                                    {{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}, {1.5, 2.5}}});
  Points3 without(3, 35);
  without << lattice.leftCols(14), lattice.rightCols(21);
  const Voronoi v = checked(without, framed);
  CHECK(euler(v) == 0);
  // A rhombus through corners of cells.
  const Surface rhombus = domain_of({{{2.5, -0.5}, {5.5, 2.5}, {2.5, 5.5}, {-0.5, 2.5}}});
  checked(inside(lattice, rhombus), rhombus);
}

TEST_CASE("sites and corners of the boundary at random places of a lattice") {
  const Surface domains[] = {
      rectangle({0, 0}, {6, 5}), domain_of({{{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 6}, {0, 6}}}),
      domain_of({{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{2, 2}, {2, 4}, {4, 4}, {4, 2}}}),
      domain_of({{{0, 3}, {3, 0}, {6, 3}, {3, 6}}, {{2.5, 2.5}, {2.5, 3.5}, {3.5, 3.5}}})};
  int cells = 0;
  for (const Surface& domain : domains)
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      CAPTURE(seed);
      Points3 places = random_points(25, rectangle({0, 0}, {6, 6}), {}, seed);
      places = inside((places * 2).array().round() / 2, domain);
      if (is_refused(places, domain))
        continue;
      checked(places, domain);
      ++cells;
    }
  CHECK(cells >= 220); // of 240
}

TEST_CASE("sites on the boundary and at its corners") {
  Points2 places(2, 5);
  places << 0, 1, 1, 0, 0.5, 0, 0, 1, 1, 0.5;
  const Voronoi v = checked(places, rectangle({0, 0}, {1, 1}));
  CHECK(euler(v) == 1);
  CHECK(v.cell_area[4] == doctest::Approx(0.5).epsilon(1e-14));
}

TEST_CASE("the example's lake, far from the origin") {
  Surface::Rings rings = read_domain(CALOTTE_FIXTURES "/../../tools/examples/lake.geojson").rings();
  for (DoubleMatrix& ring : rings)
    ring.colwise() += Place(5e3, -2e3);
  const Surface domain = Surface::plane().within(rings);
  // Sites at random leave cells in several parts around its capes.
  CHECK(euler(checked(relaxed(500, domain, 1), domain)) == 1 - 3); // three islands
}

TEST_CASE("what does not fit is refused") {
  const Mesh mesh = delaunay(random_points(9, rectangle({0, 0}, {1, 1}), {}, 3), Surface::plane());
  const auto message = [](Mesh given, const Surface& domain) {
    given.surface = domain;
    return test::refusal_of([&] { voronoi(given); });
  };
  CHECK(test::has(message(mesh, rectangle({0, 0}, {0.5, 1})), "is outside of the domain"));
  Mesh spoilt = mesh;
  spoilt.triangles(0, 0) = 9;
  CHECK(test::has(message(spoilt, rectangle({0, 0}, {1, 1})),
                  "an id that is not one of its 9 points"));
  spoilt = mesh;
  spoilt.triangles.col(1) = spoilt.triangles.col(0);
  CHECK(test::has(message(spoilt, rectangle({0, 0}, {1, 1})), "several triangles on one side"));
}

} // namespace
