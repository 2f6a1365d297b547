// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "cvt/cvt.h"
#include "delaunay/delaunay.h"
#include "quality/long_doubles.h"
#include "support/clouds.h"
#include "support/constants.h"
#include "support/errors.h"
#include "support/laws.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/voronoi.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

struct Case {
  const char* name;
  Mesh mesh;
};

/// Lattices have cocircular sites and obtuse triangles; random sets have thin ones and circumcaps
/// near a hemisphere.
std::vector<Case> cases() {
  std::vector<Case> out;
  out.push_back({"cube", delaunay(signs_of({1, 1, 1}))});
  out.push_back({"icosahedron", delaunay(bisected_icosahedron(0))});
  out.push_back({"162 bisected", delaunay(bisected_icosahedron(2))});
  out.push_back({"lat-lon", delaunay(lat_lon_sphere(7, 12, true))});
  out.push_back({"cubed sphere", delaunay(cubed_sphere(5))});
  out.push_back({"spiral", delaunay(spiral_sphere(100))});
  out.push_back({"random 15", delaunay(random_sphere(15, 5))});
  out.push_back({"random 200", delaunay(random_sphere(200, 6))});
  return out;
}

/// All measures that are no counts, except off-centring.
std::vector<double> measures(const Quality& q) {
  std::vector<double> out{q.residual, q.energy, q.cells_area, q.triangles_area};
  for (const ValueRange& range :
       {q.spacing, q.sigma, q.cell_quality, q.cell_area, q.triangle_quality, q.angles})
    out.insert(out.end(), {range.min, range.mean, range.max});
  return out;
}

std::vector<double> off_centring(const Quality& q) {
  return {q.off_centring.min, q.off_centring.mean, q.off_centring.max};
}

/// Equal up to rounding.
void check_same(const Quality& a, const Quality& b) {
  constexpr double epsilon = 1e-11;
  CHECK(a.cells == b.cells);
  CHECK(a.triangles == b.triangles);
  CHECK(a.obtuse == b.obtuse);
  CHECK(a.degrees == b.degrees);
  const std::vector<double> of_a = measures(a), of_b = measures(b);
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    CAPTURE(k);
    CHECK(std::abs(of_a[k] - of_b[k]) <= epsilon * std::max(1.0, std::abs(of_a[k])));
  }
  // A length l of rounding error e in the denominator of r = d/l makes an error e r / l = e r^2 /
  // d.
  const double largest = std::max(1.0, a.off_centring.max);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(std::abs(off_centring(a)[k] - off_centring(b)[k]) <= epsilon * largest * largest);
}

// ---- The measures by their definitions, in long doubles

/// Smallest, mean and largest.
ValueRange range_of(const std::vector<Real>& values) {
  if (values.empty())
    return {};
  Real sum = 0;
  for (const Real value : values)
    sum += value;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {static_cast<double>(*least), static_cast<double>(sum / static_cast<Real>(values.size())),
          static_cast<double>(*most)};
}

struct ShapesByDefinition {
  const Mesh& mesh;
  std::vector<Vector> site, centre; ///< unit; circumcentres of the triangles
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> triangle_of_edge;

  explicit ShapesByDefinition(const Mesh& of) : mesh(of) {
    for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
      site.push_back(mesh.points.col(i).cast<Real>().normalized());
    for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
      const Triple v = triple(mesh, t);
      const Vector a = at(v[0]), b = at(v[1]), c = at(v[2]);
      centre.push_back((b - a).cross(c - a).normalized());
      for (std::size_t i = 0; i < 3; ++i)
        triangle_of_edge[{v[i], v[(i + 1) % 3]}] = t;
    }
  }

  const Vector& at(std::int32_t i) const { return site[static_cast<std::size_t>(i)]; }

  /// The ends of the Voronoi edge from right to left of the way from i to j.
  std::pair<Vector, Vector> voronoi_edge(std::int32_t i, std::int32_t j) const {
    return {centre[static_cast<std::size_t>(triangle_of_edge.at({j, i}))],
            centre[static_cast<std::size_t>(triangle_of_edge.at({i, j}))]};
  }
  Real voronoi_length(std::int32_t i, std::int32_t j) const {
    const auto [from, to] = voronoi_edge(i, j);
    const Real length = arc(from, to);
    return length < 1e-9L * arc(at(i), at(j)) ? 0 : length;
  }

  void measure_triangles(Quality& out) const {
    std::vector<Real> shapes, angles;
    Real area = 0;
    for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
      const Triple v = triple(mesh, t);
      const Vector p[3] = {at(v[0]), at(v[1]), at(v[2])};
      const Real a = arc(p[1], p[2]), b = arc(p[2], p[0]), c = arc(p[0], p[1]);
      shapes.push_back((b + c - a) * (c + a - b) * (a + b - c) / (a * b * c));
      Real largest = 0;
      for (int i = 0; i < 3; ++i) {
        const Real angle =
            arc((p[(i + 1) % 3] - p[i]).normalized(), (p[(i + 2) % 3] - p[i]).normalized()) * 180 /
            std::numbers::pi_v<Real>;
        angles.push_back(angle);
        largest = std::max(largest, angle);
      }
      out.obtuse += largest > 90 + 1e-6L;
      const Real s = (a + b + c) / 2; // L'Huilier
      area += 4 * std::atan(std::sqrt(std::max<Real>(0, std::tan(s / 2) * std::tan((s - a) / 2) *
                                                            std::tan((s - b) / 2) *
                                                            std::tan((s - c) / 2))));
    }
    out.triangle_quality = range_of(shapes);
    out.angles = range_of(angles);
    out.triangles_area = static_cast<double>(area / (4 * std::numbers::pi_v<Real>));
  }

  void measure_edges(Quality& out) const {
    std::vector<Real> spacings, offsets;
    for (const auto& [edge, t] : triangle_of_edge) {
      const auto [i, j] = edge;
      if (i > j)
        continue;
      spacings.push_back(arc(at(i), at(j)));
      const auto [from, to] = voronoi_edge(i, j);
      if (voronoi_length(i, j) > 0)
        offsets.push_back(arc((from + to).normalized(), (at(i) + at(j)).normalized()) /
                          arc(from, to));
    }
    out.spacing = range_of(spacings);
    out.off_centring = range_of(offsets);
  }

  /// The first moment of a spherical polygon is half the sum over its sides of their arcs times
  /// their great circles' unit normals; the area is the sum of triangles to the site.
  void measure_cells(Quality& out) const {
    std::vector<Real> sigmas, qualities, areas;
    Real energy = 0, squares = 0;
    out.degrees.assign(site.size(), 0);
    for (std::int32_t i = 0; i < std::ssize(site); ++i) {
      std::vector<Real> arcs, lengths;
      Vector first = Vector::Zero();
      Real area = 0;
      for (auto edge = triangle_of_edge.lower_bound({i, -1});
           edge != triangle_of_edge.end() && edge->first.first == i; ++edge) {
        const std::int32_t j = edge->first.second;
        const auto [from, to] = voronoi_edge(i, j);
        arcs.push_back(arc(at(i), at(j)));
        lengths.push_back(voronoi_length(i, j));
        if (lengths.back() == 0)
          continue;
        first += arc(from, to) / 2 * from.cross(to).normalized();
        area += 2 * std::atan2(at(i).dot(from.cross(to)),
                               1 + at(i).dot(from) + from.dot(to) + to.dot(at(i)));
      }
      ++out.degrees[arcs.size()];
      sigmas.push_back(*std::min_element(arcs.begin(), arcs.end()) /
                       *std::max_element(arcs.begin(), arcs.end()));
      qualities.push_back(*std::min_element(lengths.begin(), lengths.end()) /
                          *std::max_element(lengths.begin(), lengths.end()));
      areas.push_back(area);
      energy += 2 * (area - first.dot(at(i)));
      squares += (first.normalized() - at(i)).squaredNorm();
    }
    while (out.degrees.back() == 0)
      out.degrees.pop_back();
    const Real n = static_cast<Real>(site.size()), sphere = 4 * std::numbers::pi_v<Real>;
    out.sigma = range_of(sigmas);
    out.cell_quality = range_of(qualities);
    out.cell_area = range_of(areas);
    out.cells_area = out.cell_area.mean * static_cast<double>(n / sphere);
    out.energy = static_cast<double>(energy);
    out.residual = static_cast<double>(std::sqrt(squares / n / (sphere / n)));
  }

  Quality quality() const {
    Quality out;
    out.cells = std::ssize(site);
    out.triangles = mesh.triangles.cols();
    measure_triangles(out);
    measure_edges(out);
    measure_cells(out);
    return out;
  }
};

Density bump(const Eigen::Vector3d& centre) { return tanh_bump(centre, 0.6, 0.5, 0.1); }

} // namespace

TEST_CASE("every measure agrees with its definition") {
  std::vector<Case> all = cases();
  all.push_back({"several blocks", delaunay(random_sphere(20000, 4))});
  for (const Case& c : all) {
    CAPTURE(c.name);
    check_same(quality(c.mesh), ShapesByDefinition(c.mesh).quality());
  }
}

TEST_CASE("shapes to which models object are counted alone as among all measures") {
  const auto check = [](const Mesh& mesh, const Quality& all) {
    const BadShapes found = count_bad_shapes(mesh);
    CHECK(found.obtuse == all.obtuse);
    CHECK(found.short_edges == all.short_edges);
  };
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    check(c.mesh, quality(c.mesh));
  }
  for (const std::int64_t n : {1000, 20000}) {
    const Mesh random = delaunay(random_sphere(n, 3));
    CHECK(count_bad_shapes(random).short_edges > n / 3);
    check(random, quality(random));
    const Mesh even = make_grid({.cells = n}).mesh;
    CHECK(count_bad_shapes(even).short_edges == 0);
    check(even, quality(even));
  }
  const Mesh part = delaunay(random_points(300, circle({1, 0, 0}, 0.5)));
  check(part, open_quality(part));
  const Surface box = Surface::periodic({2, 1});
  const Mesh plane = delaunay(random_points(300, box), box);
  check(plane, quality(plane));
}

TEST_CASE("laws: Euler's counts, areas of the sphere, means within their bounds") {
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const Quality q = quality(c.mesh);
    std::int64_t cells = 0, ends_of_edges = 0;
    for (std::size_t degree = 0; degree < q.degrees.size(); ++degree) {
      cells += q.degrees[degree];
      ends_of_edges += static_cast<std::int64_t>(degree) * q.degrees[degree];
    }
    CHECK(cells == q.cells);
    CHECK(ends_of_edges == 3 * q.triangles);
    CHECK(q.cells - ends_of_edges / 2 + q.triangles == 2);
    CHECK(std::abs(q.cells_area - 1) * 4 * pi < 1e-12);
    CHECK(std::abs(q.triangles_area - 1) * 4 * pi < 1e-12);
    CHECK(q.cell_area.mean == doctest::Approx(4 * pi / static_cast<double>(q.cells)));
    CHECK(q.angles.mean == doctest::Approx(60));
    CHECK((q.obtuse > 0) == (q.angles.max > 90 + 1e-6));
    for (const ValueRange& range : {q.spacing, q.sigma, q.cell_quality, q.cell_area,
                                    q.triangle_quality, q.angles, q.off_centring}) {
      CHECK(range.min >= 0);
      CHECK(range.min <= range.mean * (1 + 1e-14));
      CHECK(range.mean <= range.max * (1 + 1e-14));
    }
    for (const ValueRange& range : {q.sigma, q.cell_quality, q.triangle_quality})
      CHECK(range.max <= 1 + 1e-14);
  }
}

TEST_CASE(
    "the unit of lengths is km where the radius is known, else degrees, or the one asked for") {
  const Unit km = unit_of({}, 6371), degrees = unit_of({}, {});
  CHECK(km.name == "km");
  CHECK(km.of_radian == 6371);
  CHECK(km.area == "km^2");
  CHECK(km.of_steradian == 6371.0 * 6371);
  CHECK(degrees.name == "degrees");
  CHECK(degrees.of_radian == 180 / pi);
  CHECK(degrees.area == "steradians");
  CHECK(degrees.of_steradian == 1);
  CHECK(unit_of("degrees", 6371).of_radian == degrees.of_radian);
  CHECK(unit_of("radians", 6371).of_radian == 1);
  CHECK_THROWS_WITH_AS(unit_of("km", {}),
                       "km need the radius of the sphere; give it, or the unit degrees", Error);
  CHECK_THROWS_WITH_AS(unit_of("miles", 1),
                       "the unit \"miles\" is unknown; give km, degrees or radians", Error);
  for (const double radius : {-1.0, 0.0, HUGE_VAL, std::nan("")})
    CHECK_THROWS_AS(unit_of({}, radius), Error);
  CHECK_THROWS_WITH_AS(unit_of("degrees", -1),
                       "the radius of the sphere is -1 km; give a positive number", Error);
}

TEST_CASE("the icosahedron is perfect") {
  const Quality q = quality(delaunay(bisected_icosahedron(0)));
  CHECK(q.degrees == std::vector<std::int64_t>{0, 0, 0, 0, 0, 12});
  CHECK(q.obtuse == 0);
  const auto check_all = [](const ValueRange& range, double value) {
    for (const double v : {range.min, range.mean, range.max})
      CHECK(std::abs(v - value) < 1e-13);
  };
  check_all(q.spacing, std::atan(2));
  check_all(q.sigma, 1);
  check_all(q.cell_quality, 1);
  check_all(q.cell_area, pi / 3);
  check_all(q.triangle_quality, 1);
  check_all({q.angles.min / 60, q.angles.mean / 60, q.angles.max / 60}, 1);
  check_all(q.off_centring, 0);
  CHECK(q.residual < 1e-15);
}

TEST_CASE(
    "right angles are not obtuse, and cocircular sites have no Voronoi edge, however they lie") {
  for (int round = 0; round < 20; ++round) {
    Random random(static_cast<std::uint64_t>(round));
    const Vec3 axis = random.direction();
    const Eigen::AngleAxisd turn(random.real(0, 2 * pi), Eigen::Vector3d(axis.x, axis.y, axis.z));
    const Quality q = quality(delaunay(turn.toRotationMatrix() * signs_of({1, 1, 1})));
    CHECK(q.obtuse == 0);
    CHECK(q.angles.max == doctest::Approx(90));
    CHECK(q.cell_quality.min == 0);
    CHECK(q.off_centring.max < 1e-12);
    CHECK(q.residual < 1e-14);
  }
}

TEST_CASE("rotation, permutation and the norms of the directions do not affect the measures") {
  for (const std::uint64_t seed : {7, 8, 9}) {
    const Points3 points = random_sphere(300, seed);
    const Eigen::Vector3d centre(1, 2, -1);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1 + static_cast<double>(seed),
                          centre.cross(Eigen::Vector3d::UnitX()).normalized())
            .toRotationMatrix();
    std::vector<std::int32_t> order(300);
    std::iota(order.begin(), order.end(), 0);
    Random random(seed);
    random.shuffle(order);
    Points3 other(3, 300);
    for (Eigen::Index i = 0; i < 300; ++i)
      other.col(order[static_cast<std::size_t>(i)]) =
          std::exp(random.real(-20, 20)) * (turn * points.col(i));
    check_same(quality(delaunay(points)), quality(delaunay(other)));
    check_same(quality(delaunay(points), bump(centre)),
               quality(delaunay(other), bump(turn * centre)));
  }
}

TEST_CASE("the residual and the energy are those of the next step of the iteration") {
  for (const Density& density : {Density{}, bump({1, 0, 1})}) {
    const Points3 start = random_sphere(500, 3);
    const Quality q = quality(delaunay(start), density);
    const Schedule schedule =
        plan({.resolution = density, .start = {.points = start}, .stop = {.max_iterations = 1}});
    const Cvt next = cvt(start, schedule, {.quadrature = {.rule = 6}});
    CHECK(q.residual == doctest::Approx(next.report.residual).epsilon(1e-10));
    CHECK(q.energy == doctest::Approx(next.report.iterations[0].energy).epsilon(1e-12));
  }
}

TEST_CASE("the residual vanishes for centroidal meshes of the same density alone") {
  const Points3 start = bisected_icosahedron(2);
  CHECK(quality(delaunay(start)).residual > 1e-3);
  Recipe recipe{.start = {.points = start}, .stop = {.tolerance = 1e-12}};
  CHECK(quality(make_grid(recipe).mesh).residual < 1e-12);
  // Slow: only the discreteness of the triangles prevents the grid from rotating about the bump's
  // axis.
  recipe.stop.tolerance = 1e-4;
  const Density density = bump({1, 0, 1});
  recipe.resolution = density;
  CHECK(quality(delaunay(start), density).residual > 1e-2);
  const Mesh grid = make_grid(recipe).mesh;
  CHECK(quality(grid, density).residual < 1e-4);
  CHECK(quality(grid).residual > 1e-2);
}

TEST_CASE("ties of cocircular sites do not affect Voronoi measures") {
  const Points3 points = cubed_sphere(6);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Quality a = quality(delaunay(points)), b = quality(delaunay(turn * points));
  for (const auto& [one, other] :
       {std::pair(a.cell_area, b.cell_area), std::pair(a.off_centring, b.off_centring)}) {
    CHECK(one.min == doctest::Approx(other.min).scale(1).epsilon(1e-11));
    CHECK(one.mean == doctest::Approx(other.mean).epsilon(1e-11));
    CHECK(one.max == doctest::Approx(other.max).epsilon(1e-11));
  }
  CHECK(a.residual == doctest::Approx(b.residual).epsilon(1e-11));
  CHECK(a.energy == doctest::Approx(b.energy).epsilon(1e-11));
}

TEST_CASE("the same bits for any number of threads") {
  const Mesh mesh = delaunay(random_sphere(40000, 5));
  const auto with = [&](std::size_t threads, const Density& density) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return quality(mesh, density);
  };
  for (const Density& density : {Density{}, bump({1, 0, 1})}) {
    const Quality one = with(1, density), four = with(4, density);
    CHECK(measures(one) == measures(four));
    CHECK(off_centring(one) == off_centring(four));
    CHECK(one.degrees == four.degrees);
    CHECK(one.obtuse == four.obtuse);
  }
}

TEST_CASE(
    "what has no Voronoi tessellation, and densities that are none, are refused in one line") {
  const auto check_refused = [](const Mesh& mesh, const Density& density,
                                const std::string& words) {
    CAPTURE(words);
    const Error error = test::error_of([&] { quality(mesh, density); });
    const std::string message = error.what();
    CAPTURE(message);
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(
        has(message, words.ends_with("of site ") ? words + std::to_string(error.index()) : words));
  };
  const Mesh good = delaunay(random_sphere(50, 2));
  check_refused(Mesh{}, {}, "no triangle");
  Points3 half = random_sphere(50, 2);
  half.row(2) = half.row(2).cwiseAbs();
  check_refused(delaunay(half), {}, "the mesh is open");
  Mesh lonely = good;
  lonely.points.conservativeResize(3, 51);
  lonely.points.col(50) << 1, 2, 3;
  check_refused(lonely, {}, "site 50 is not a vertex");
  Mesh moved = good;
  moved.points.col(7) = -moved.points.col(7);
  check_refused(moved, {}, "not the Delaunay triangulation");
  Mesh cut = good;
  cut.neighbours(0, 3) = -1;
  check_refused(cut, {}, "not the Delaunay triangulation");
  check_refused(good, tanh_bump({0, 0, 1}, 0.5, 0.2, 0), "gamma");
  Density density;
  density.kind = Density::Kind::callable;
  check_refused(good, density, "callable");
  const auto check_callable = [&](double south, const std::string& words) {
    density.callable = [=](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
      rho = (x.row(2).array() < 0)
                .select(Eigen::RowVectorXd::Constant(x.cols(), south), 1)
                .transpose();
    };
    check_refused(good, density, words);
  };
  check_callable(0, "over the whole cell of site ");
  check_callable(std::numeric_limits<double>::infinity(), "infinite");
  check_callable(-1, "negative");
  check_callable(std::nan(""), "NaN");
  density.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (x.row(0).array() < 0.5).cast<double>().matrix().transpose();
  };
  for (const Surface& plane : {Surface::periodic({1, 1}), rectangle({0, 0}, {1, 1})})
    check_refused(delaunay(random_points(200, plane), plane), density,
                  "over the whole cell of site ");
}

TEST_CASE("rings of the sphere have no effect on a closed mesh") {
  Mesh mesh = delaunay(random_sphere(200, 2));
  const std::vector<double> whole = measures(quality(mesh));
  mesh.surface = circle({0, 0, 1}, 0.5);
  CHECK(measures(quality(mesh)) == whole);
}

// Slow: full descents on up to 40 962 generators.
TEST_CASE("uniform grids by continuation from the icosahedron have the known quality [slow]") {
  struct Known {
    double sigma_min, sigma_mean, cell_min, cell_mean, q_min, q_mean, angle_min, angle_max,
        area_ratio, energy;
  };
  const std::map<std::int64_t, Known> table{
      {2562, {.8510, .9140, .606, .764, .9694, .99309, 53.46, 71.96, 1.332, 25.44900}},
      {10242, {.8507, .9157, .604, .768, .9692, .99336, 53.38, 71.99, 1.414, 25.44443}},
      {40962, {.8507, .9168, .604, .772, .9692, .99345, 53.37, 72.00, 1.502, 25.44310}}};
  const auto check_digits = [](double value, double known, int decimals) {
    CAPTURE(value);
    CAPTURE(known);
    CHECK(std::abs(value - known) <= 0.5000001 * std::pow(10, -decimals));
  };
  Recipe recipe{.start = {.points = bisected_icosahedron(3)},
                .stop = {.tolerance = 1e-8, .max_iterations = 5000}};
  for (int level = 3; level <= 6; ++level) {
    const Cvt grid = make_grid(recipe);
    REQUIRE(grid.report.converged);
    recipe.start.points = bisect(grid.mesh);
    if (level == 3)
      continue;
    const Quality q = quality(grid.mesh);
    const Known& known = table.at(q.cells);
    CAPTURE(q.cells);
    check_digits(q.sigma.min, known.sigma_min, 4);
    check_digits(q.sigma.mean, known.sigma_mean, 4);
    check_digits(q.cell_quality.min, known.cell_min, 3);
    check_digits(q.cell_quality.mean, known.cell_mean, 3);
    check_digits(q.triangle_quality.min, known.q_min, 4);
    check_digits(q.triangle_quality.mean, known.q_mean, 5);
    check_digits(q.angles.min, known.angle_min, 2);
    check_digits(q.angles.max, known.angle_max, 2);
    check_digits(q.cell_area.max / q.cell_area.min, known.area_ratio, 3);
    check_digits(q.energy * static_cast<double>(q.cells), known.energy, 5);
    CHECK(q.residual <= *recipe.stop.tolerance);
    CHECK(q.obtuse == 0);
    CHECK(q.degrees == std::vector<std::int64_t>{0, 0, 0, 0, 0, 12, q.cells - 12});
    for (const CvtIteration& iteration : grid.report.iterations)
      CHECK(iteration.flips + iteration.rebuilt == 0);
  }
}
