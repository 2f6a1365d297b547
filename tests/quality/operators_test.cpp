// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "delaunay/delaunay.h"
#include "support/clouds.h"
#include "support/constants.h"
#include "support/densities.h"
#include "support/meshes.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

using Named = std::pair<std::string, const ErrorNorms*>;

std::vector<Named> norms_of(const OperatorErrors& errors) {
  return {{"divergence", &errors.divergence}, {"gradient", &errors.gradient},
          {"laplacian", &errors.laplacian},   {"curl", &errors.curl},
          {"tangential", &errors.tangential}, {"kinetic energy", &errors.kinetic_energy}};
}

std::vector<const DoubleVector*> maps_of(const OperatorErrorsByCell& by_cell) {
  return {&by_cell.divergence, &by_cell.gradient,   &by_cell.laplacian,
          &by_cell.curl,       &by_cell.tangential, &by_cell.kinetic_energy};
}

void check_close(double value, double expected, double epsilon) {
  CHECK(std::abs(value - expected) <= epsilon * std::abs(expected));
}

void check_norms(const OperatorErrors& errors, const std::vector<std::array<double, 2>>& expected,
                 double epsilon) {
  const std::vector<Named> norms = norms_of(errors);
  for (std::size_t k = 0; k < norms.size(); ++k) {
    CAPTURE(norms[k].first);
    check_close(norms[k].second->l2, expected[k][0], epsilon);
    check_close(norms[k].second->max, expected[k][1], epsilon);
  }
}

Matrix3d rotation(double angle, const Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// A mesh of cells of many shapes, all of them acute.
Mesh uneven() {
  Points3 points = bisected_icosahedron(2);
  const Points3 noise = random_sphere(static_cast<std::int32_t>(points.cols()), 4);
  return delaunay(points + 0.02 * noise);
}

// ---- A direct evaluation

/// The quadratic forms p . A p of the smooth fields.
std::array<Matrix3d, 5> forms() {
  std::array<Matrix3d, 5> out;
  out.fill(Matrix3d::Zero());
  for (int m = 0; m < 3; ++m)
    out[static_cast<std::size_t>(m)](m, (m + 1) % 3) =
        out[static_cast<std::size_t>(m)]((m + 1) % 3, m) = 0.5;
  out[3].diagonal() << 0.5, -0.5, 0;
  out[4].diagonal() << -1, -1, 2;
  out[4] /= 2 * std::sqrt(3.0);
  return out;
}

/// Errors at places, one field after the other.
struct Direct {
  DoubleVector weight;
  DoubleVector error, exact; ///< squares by place, summed over the fields

  explicit Direct(DoubleVector weights)
      : weight(std::move(weights)), error(DoubleVector::Zero(weight.size())), exact(error) {}
  void add(const DoubleVector& value, const DoubleVector& expected) {
    error += (value - expected).cwiseAbs2();
    exact += expected.cwiseAbs2();
  }
  std::array<double, 2> norms() const {
    const double mean = weight.dot(exact) / weight.sum();
    return {std::sqrt(weight.dot(error) / weight.sum() / mean), std::sqrt(error.maxCoeff() / mean)};
  }
};

/// The operators as matrices, from the sums over edges.
struct Matrices {
  MatrixXd divergence, gradient, curl, tangential, kinetic_energy;

  explicit Matrices(const Voronoi& of) {
    const Eigen::Index n = of.cells.cols(), e = of.edges.cols(), m = of.vertices.cols();
    divergence = kinetic_energy = MatrixXd::Zero(n, e);
    gradient = MatrixXd::Zero(e, n);
    curl = MatrixXd::Zero(m, e);
    tangential = MatrixXd::Zero(e, e);
    const TangentialWeights weights = tangential_weights(of, 0, e);
    for (Eigen::Index k = 0; k < e; ++k) {
      for (int end = 0; end < 2; ++end) {
        const double sign = end == 0 ? 1 : -1;
        const std::int32_t cell = of.cells_on_edge(end, k), vertex = of.vertices_on_edge(end, k);
        divergence(cell, k) = sign * of.dv[k] / of.cell_area[cell];
        kinetic_energy(cell, k) = of.dc[k] * of.dv[k] / 4 / of.cell_area[cell];
        gradient(k, cell) = -sign / of.dc[k];
        curl(vertex, k) = -sign * of.dc[k] / of.vertex_area[vertex];
      }
      for (std::int64_t j = weights.edges.begin[k]; j != weights.edges.begin[k + 1]; ++j)
        tangential(k, weights.edges.items[j]) += weights.weights[j];
    }
  }
};

/// The components of tangential gradients along directions.
DoubleVector along(const Points3& gradients, const Points3& directions) {
  return gradients.cwiseProduct(directions).colwise().sum();
}

Points3 gradients(const Matrix3d& form, const Points3& places) {
  Points3 out = 2 * form * places;
  for (Eigen::Index i = 0; i < places.cols(); ++i)
    out.col(i) -= out.col(i).dot(places.col(i)) * places.col(i);
  return out;
}

DoubleVector values(const Matrix3d& form, const Points3& places) {
  return along(form * places, places);
}

std::vector<std::array<double, 2>> direct_norms(const Voronoi& of) {
  const Matrices matrix(of);
  Points3 normal(3, of.edges.cols()), tangent(3, of.edges.cols());
  for (Eigen::Index e = 0; e < of.edges.cols(); ++e) {
    const Vector3d across =
        of.cells.col(of.cells_on_edge(1, e)) - of.cells.col(of.cells_on_edge(0, e));
    normal.col(e) = across.normalized();
    tangent.col(e) = Vector3d(of.edges.col(e)).cross(Vector3d(normal.col(e)));
  }
  Direct divergence(of.cell_area), gradient(of.dc.cwiseProduct(of.dv)), laplacian(of.cell_area),
      curl(of.vertex_area), tangential(gradient.weight), energy(of.cell_area);
  for (const Matrix3d& form : forms()) {
    const Points3 slopes = gradients(form, of.edges);
    const DoubleVector u = along(slopes, normal), v = along(slopes, tangent);
    const DoubleVector at_cells = values(form, of.cells), at_vertices = values(form, of.vertices);
    const DoubleVector none_at_cells = 0 * at_cells, none_at_vertices = 0 * at_vertices;
    const DoubleVector speed = gradients(form, of.cells).colwise().squaredNorm() / 2;
    divergence.add(matrix.divergence * u, -6 * at_cells);
    divergence.add(matrix.divergence * -v, none_at_cells);
    gradient.add(matrix.gradient * at_cells, u);
    laplacian.add(matrix.divergence * (matrix.gradient * at_cells), -6 * at_cells);
    curl.add(matrix.curl * u, none_at_vertices);
    curl.add(matrix.curl * -v, -6 * at_vertices);
    tangential.add(matrix.tangential * u, v);
    tangential.add(matrix.tangential * -v, u);
    energy.add(matrix.kinetic_energy * u.cwiseAbs2(), speed);
    energy.add(matrix.kinetic_energy * v.cwiseAbs2(), speed);
  }
  return {divergence.norms(), gradient.norms(),   laplacian.norms(),
          curl.norms(),       tangential.norms(), energy.norms()};
}

/// The greatest eigenvalue of minus the divergence of the gradient, or minus the curl of the
/// rotated gradient, which maps vertices to vertices.
double greatest_eigenvalue(const MatrixXd& matrix) {
  return matrix.eigenvalues().real().maxCoeff();
}

MatrixXd rotated_gradient(const Voronoi& of) {
  MatrixXd out = MatrixXd::Zero(of.edges.cols(), of.vertices.cols());
  for (Eigen::Index e = 0; e < of.edges.cols(); ++e) {
    out(e, of.vertices_on_edge(0, e)) = 1 / of.dv[e];
    out(e, of.vertices_on_edge(1, e)) = -1 / of.dv[e];
  }
  return out;
}

} // namespace

TEST_CASE("the errors are those of a direct evaluation") {
  for (const Mesh& mesh : {delaunay(bisected_icosahedron(2)), uneven()}) {
    const Voronoi of = voronoi(mesh);
    const OperatorErrors errors = operator_errors(mesh);
    check_norms(errors, direct_norms(of), 1e-10);
    CHECK(errors.divergence.max > errors.divergence.l2);
  }
}

TEST_CASE("the eigenvalues are those of the dense matrices, within a percent and not above") {
  const Mesh mesh = uneven();
  const Voronoi of = voronoi(mesh);
  const Matrices matrix(of);
  const OperatorErrors errors = operator_errors(mesh);
  const double primal = greatest_eigenvalue(-matrix.divergence * matrix.gradient);
  CHECK(errors.primal_eigenvalue <= primal * (1 + 1e-9));
  CHECK(errors.primal_eigenvalue >= primal * 0.99);
  const double dual = greatest_eigenvalue(matrix.curl * rotated_gradient(of) * -1.0);
  CHECK(errors.dual_eigenvalue <= dual * (1 + 1e-9));
  CHECK(errors.dual_eigenvalue >= dual * 0.99);
  CHECK(wave_step(errors, 2) == doctest::Approx(std::sqrt(8 / errors.primal_eigenvalue) / 2));
  CHECK(diffusion_step(errors.dual_eigenvalue, 4) == doctest::Approx(0.5 / errors.dual_eigenvalue));
}

TEST_CASE("a rotation of the mesh leaves the errors") {
  const Mesh mesh = uneven();
  const OperatorErrors errors = operator_errors(mesh);
  const Matrix3d turn = rotation(1.1, {1, 2, 3});
  const OperatorErrors turned = operator_errors(delaunay(turn * mesh.points));
  const std::vector<Named> before = norms_of(errors), after = norms_of(turned);
  for (std::size_t k = 0; k < before.size(); ++k) {
    CAPTURE(before[k].first);
    if (before[k].second == &errors.kinetic_energy) // not linear in the fields
      continue;
    check_close(after[k].second->l2, before[k].second->l2, 1e-9);
    check_close(after[k].second->max, before[k].second->max, 1e-9);
    CHECK((after[k].second->position - turn * before[k].second->position).norm() < 1e-9);
  }
  check_close(turned.off_centroid.max, errors.off_centroid.max, 1e-9);
  check_close(turned.off_midpoint.l2, errors.off_midpoint.l2, 1e-9);
}

TEST_CASE("any number of threads gives the same bits") {
  const Mesh mesh = delaunay(random_sphere(20000, 8));
  std::vector<OperatorErrors> results;
  for (const int threads : {1, 4}) {
    tbb::task_arena arena(threads);
    arena.execute([&] { results.push_back(operator_errors(mesh, x8())); });
  }
  const std::vector<Named> one = norms_of(results[0]), four = norms_of(results[1]);
  for (std::size_t k = 0; k < one.size(); ++k) {
    CHECK(one[k].second->l2 == four[k].second->l2);
    CHECK(one[k].second->max == four[k].second->max);
    CHECK(one[k].second->cell == four[k].second->cell);
    CHECK(equal_bits(*maps_of(results[0].by_cell)[k], *maps_of(results[1].by_cell)[k]));
  }
  CHECK(results[0].primal_eigenvalue == results[1].primal_eigenvalue);
  CHECK(results[0].dual_eigenvalue == results[1].dual_eigenvalue);
  CHECK(results[0].off_centroid.l2 == results[1].off_centroid.l2);
}

TEST_CASE("orders of convergence on icosahedral CVTs") {
  std::vector<OperatorErrors> errors;
  for (const int level : {3, 4})
    errors.push_back(
        operator_errors(make_grid({.start = {.points = bisected_icosahedron(level)}}).mesh));
  const auto order = [&](ErrorNorms OperatorErrors::*norms) {
    return std::log2((errors[0].*norms).l2 / (errors[1].*norms).l2);
  };
  CHECK(order(&OperatorErrors::gradient) == doctest::Approx(2).epsilon(0.02));
  CHECK(order(&OperatorErrors::curl) == doctest::Approx(1).epsilon(0.05));
  CHECK(order(&OperatorErrors::divergence) > 1.2);
  CHECK(order(&OperatorErrors::laplacian) > 1.2);
  CHECK(order(&OperatorErrors::tangential) > 1.2);
  CHECK(order(&OperatorErrors::kinetic_energy) > 1.2);
  // Eigenvalues are those of hexagons and triangles of the least spacing, within a third.
  for (const OperatorErrors& of : errors)
    CHECK(of.dual_eigenvalue / of.primal_eigenvalue == doctest::Approx(4).epsilon(0.15));
}

TEST_CASE("by cell: the greatest value is the norm, at the cell that it names") {
  for (const NamedMesh& named : closed_meshes()) {
    if (named.mesh.points.cols() < 12)
      continue;
    CAPTURE(named.name);
    const OperatorErrors errors = operator_errors(named.mesh);
    const std::vector<Named> norms = norms_of(errors);
    const std::vector<const DoubleVector*> maps = maps_of(errors.by_cell);
    for (std::size_t k = 0; k < norms.size(); ++k) {
      CAPTURE(norms[k].first);
      CHECK(maps[k]->maxCoeff() == norms[k].second->max);
      CHECK((*maps[k])[norms[k].second->cell] == norms[k].second->max);
    }
  }
}

TEST_CASE("distances from centroids are those of cell_measures()") {
  const Mesh mesh = uneven();
  for (const Density& density : {Density{}, x8()}) {
    const DoubleVector off = cell_measures(mesh, density).off_centroid;
    const ErrorNorms norms = operator_errors(mesh, density).off_centroid;
    check_close(norms.max, off.maxCoeff(), 1e-9);
    check_close(norms.l2, std::sqrt(off.squaredNorm() / static_cast<double>(off.size())), 1e-9);
    CHECK(off[norms.cell] == doctest::Approx(norms.max));
  }
}

TEST_CASE("an edge without length leaves no stable step for vorticity") {
  const OperatorErrors errors = operator_errors(delaunay(lat_lon_sphere(8, 16, true)));
  CHECK(std::isinf(errors.dual_eigenvalue));
  CHECK(diffusion_step(errors.dual_eigenvalue, 1) == 0);
  CHECK(std::isfinite(errors.primal_eigenvalue));
  CHECK(std::isfinite(errors.tangential.max));
}

namespace {

std::vector<std::int32_t> sites_around(const Mesh& mesh, const Vector3d& centre, double cosine) {
  std::vector<std::int32_t> kept;
  for (std::int32_t i = 0; i < mesh.points.cols(); ++i)
    if (mesh.points.col(i).dot(centre) > cosine)
      kept.push_back(i);
  return kept;
}

/// The triangles between some of the sites.
Mesh part_of(const Mesh& whole, const std::vector<std::int32_t>& sites) {
  std::vector<std::int32_t> site(static_cast<std::size_t>(whole.points.cols()), -1),
      triangle(static_cast<std::size_t>(whole.triangles.cols()), -1);
  Mesh out;
  out.points.resize(3, std::ssize(sites));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    site[static_cast<std::size_t>(sites[i])] = static_cast<std::int32_t>(i);
    out.points.col(static_cast<Eigen::Index>(i)) = whole.points.col(sites[i]);
  }
  const auto at = [](const std::vector<std::int32_t>& ids, std::int32_t id) {
    return id < 0 ? -1 : ids[static_cast<std::size_t>(id)];
  };
  std::int32_t count = 0;
  for (Eigen::Index t = 0; t < whole.triangles.cols(); ++t)
    if (std::all_of(whole.triangles.col(t).begin(), whole.triangles.col(t).end(),
                    [&](std::int32_t id) { return at(site, id) >= 0; }))
      triangle[static_cast<std::size_t>(t)] = count++;
  out.triangles.resize(3, count);
  out.neighbours.resize(3, count);
  for (Eigen::Index t = 0; t < whole.triangles.cols(); ++t)
    if (const std::int32_t id = triangle[static_cast<std::size_t>(t)]; id >= 0)
      for (int v = 0; v < 3; ++v) {
        out.triangles(v, id) = at(site, whole.triangles(v, t));
        out.neighbours(v, id) = at(triangle, whole.neighbours(v, t));
      }
  return out;
}

} // namespace

TEST_CASE("an open mesh: whole cells have the errors that they have in a closed one") {
  const Mesh closed = delaunay(bisected_icosahedron(4));
  const std::vector<std::int32_t> kept = sites_around(closed, Vector3d(1, 2, 3).normalized(), 0.5);
  const Mesh open = part_of(closed, kept);
  REQUIRE(!open.closed());
  const OperatorErrors of_part = operator_errors(open), of_all = operator_errors(closed);
  const std::vector<const DoubleVector*> part = maps_of(of_part.by_cell),
                                         all = maps_of(of_all.by_cell);
  for (std::size_t k = 0; k < part.size(); ++k) {
    CAPTURE(norms_of(of_part)[k].first);
    // They are relative to the mean over another part of the sphere.
    double ratio = 0;
    std::int64_t count = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const double here = (*part[k])[static_cast<Eigen::Index>(i)], there = (*all[k])[kept[i]];
      if (std::isnan(here) || k == 1 || k == 3 || k == 4)
        continue;
      ratio = ratio > 0 ? ratio : here / there;
      check_close(here, ratio * there, 1e-6);
      ++count;
    }
    if (k == 0 || k == 2 || k == 5) {
      CHECK(count > 400);
      CHECK(count < std::ssize(kept));
      CHECK(ratio == doctest::Approx(1).epsilon(0.2));
    }
    const ErrorNorms& norms = *norms_of(of_part)[k].second;
    CHECK((*part[k])[norms.cell] == norms.max);
    CHECK((open.points.col(norms.cell).normalized() - norms.position).norm() < 0.1);
  }
  CHECK(of_part.off_midpoint.max <= of_all.off_midpoint.max * (1 + 1e-6));
  CHECK(of_part.off_centroid.max <= of_all.off_centroid.max * (1 + 1e-6));
  CHECK(of_part.dual_eigenvalue <= of_all.dual_eigenvalue * 1.01);
}

namespace {

using Complex = std::complex<double>;
constexpr Complex i_unit{0, 1};

Vector2d turned_by(const Vector2d& v, double angle) { return Eigen::Rotation2Dd(angle) * v; }

/// Squares of the errors of the operators for the wave exp(i k . x) on regular hexagons, which
/// cosine and sine share.
struct Wave {
  Vector2d k;
  double d; ///< spacing

  Complex slope(const Vector2d& direction, const Vector2d& at) const {
    return i_unit * k.dot(direction) * std::exp(i_unit * k.dot(at));
  }
  Vector2d direction(int j) const { return turned_by({1, 0}, j * pi / 3); }
  Vector2d left(const Vector2d& v) const { return {-v.y(), v.x()}; }

  double divergence() const {
    Complex of_gradient = 0, of_rotated = 0; // sum of u dv / area, with area = sqrt(3)/2 d^2
    for (int j = 0; j < 6; ++j) {
      const Vector2d e = direction(j);
      of_gradient += 2 / (3 * d) * slope(e, d / 2 * e);
      of_rotated -= 2 / (3 * d) * slope(left(e), d / 2 * e);
    }
    return std::norm(of_gradient + k.squaredNorm()) + std::norm(of_rotated);
  }
  double laplacian() const {
    Complex sum = 0;
    for (int j = 0; j < 6; ++j)
      sum += 2 / (3 * d * d) * (std::exp(i_unit * k.dot(d * direction(j))) - 1.0);
    return std::norm(sum + k.squaredNorm());
  }
  /// The mean over the three kinds of edges.
  double gradient() const {
    double sum = 0;
    for (int j = 0; j < 3; ++j) {
      const Vector2d e = direction(j);
      const Complex difference =
          (std::exp(i_unit * k.dot(d / 2 * e)) - std::exp(i_unit * k.dot(-d / 2 * e))) / d;
      sum += std::norm(difference - slope(e, {0, 0})) / 3;
    }
    return sum;
  }
  double curl() const {
    Complex of_gradient = 0, of_rotated = 0; // area sqrt(3)/4 d^2, midpoints d / (2 sqrt 3) away
    for (int j = 0; j < 3; ++j) {
      const Vector2d out = turned_by({0, -1}, 2 * j * pi / 3), at = d / std::sqrt(12.0) * out;
      of_gradient += 4 / (std::sqrt(3.0) * d) * slope(left(out), at);
      of_rotated -= 4 / (std::sqrt(3.0) * d) * slope(left(left(out)), at);
    }
    return std::norm(of_gradient) + std::norm(of_rotated + k.squaredNorm());
  }
  /// The mean over the three kinds of edges; the weights of a regular hexagon are (3 - j) / (6 sqrt
  /// 3) for its j-th other edge.
  double tangential() const {
    double sum = 0;
    for (int j = 0; j < 3; ++j) {
      const Vector2d normal = direction(j);
      Complex of_gradient = 0, of_rotated = 0;
      for (const double side : {1.0, -1.0})
        for (int other = 1; other < 6; ++other) {
          const Vector2d outward = turned_by(side * normal, other * pi / 3),
                         at = d / 2 * (outward - side * normal);
          const double weight = side * (3 - other) / (6 * std::sqrt(3.0));
          of_gradient += weight * slope(outward, at);
          of_rotated -= weight * slope(left(outward), at);
        }
      sum += (std::norm(of_gradient - slope(left(normal), {0, 0})) +
              std::norm(of_rotated - slope(normal, {0, 0}))) /
             3;
    }
    return sum;
  }
};

} // namespace

TEST_CASE("regular hexagons in a periodic plane have the errors of plane waves") {
  const double d = 0.7;
  const Mesh mesh = hexagonal_box(12, 18, d);
  const OperatorErrors errors = operator_errors(mesh);
  const Eigen::Vector2d& period = mesh.surface.period();
  const Wave x{{2 * pi / period[0], 0}, d}, y{{0, 2 * pi / period[1]}, d};
  const auto mean = [&](double (Wave::*error)() const) { return (x.*error)() + (y.*error)(); };
  const double fourth = std::pow(x.k[0], 4) + std::pow(y.k[1], 4),
               square = x.k.squaredNorm() + y.k.squaredNorm();
  check_close(errors.divergence.l2, std::sqrt(mean(&Wave::divergence) / fourth), 1e-9);
  check_close(errors.divergence.max, errors.divergence.l2, 1e-9); // all cells are alike
  check_close(errors.laplacian.l2, std::sqrt(mean(&Wave::laplacian) / fourth), 1e-9);
  check_close(errors.laplacian.max, errors.laplacian.l2, 1e-9);
  check_close(errors.curl.l2, std::sqrt(mean(&Wave::curl) / fourth), 1e-9);
  check_close(errors.gradient.l2, std::sqrt(mean(&Wave::gradient) / (square / 2)), 1e-9);
  check_close(errors.tangential.l2, std::sqrt(mean(&Wave::tangential) / square), 1e-9);
  // The waves with values 1 and -1/2 at the corners of a triangle, and 1 and -1 at vertices.
  check_close(errors.primal_eigenvalue, 6 / (d * d), 0.01);
  check_close(errors.dual_eigenvalue, 24 / (d * d), 0.01);
  CHECK(errors.off_centroid.max < 1e-12);
  CHECK(errors.off_midpoint.max < 1e-12);
}

TEST_CASE("in a bounded plane the cells count that the boundary does not clip") {
  const Points3 random = random_sphere(400, 3);
  const Points2 places = (random.topRows<2>().array() + 1) / 2;
  const Mesh mesh = delaunay(places, rectangle({-0.1, -0.1}, {1.1, 1.2}));
  const OperatorErrors errors = operator_errors(mesh);
  const std::vector<bool> clipped = clipped_cells(mesh);
  for (std::size_t i = 0; i < clipped.size(); ++i)
    CHECK(std::isnan(errors.by_cell.divergence[static_cast<Eigen::Index>(i)]) == clipped[i]);
  CHECK(errors.by_cell.curl[errors.curl.cell] == errors.curl.max);
  CHECK(errors.gradient.l2 < 0.1);
  CHECK(errors.off_centroid.max == cell_measures(mesh).off_centroid.maxCoeff());
}

TEST_CASE("no density, no whole cell and no Voronoi cells are errors") {
  Mesh mesh = delaunay(bisected_icosahedron(1));
  CHECK_THROWS_AS(operator_errors(mesh, tanh_bump({0, 0, 0}, 1, 1, 0.5)), const Error&);
  const Points3 triangle = Points3(Matrix3d::Identity());
  CHECK_THROWS_AS(operator_errors(delaunay(triangle)), const Error&);
  mesh.points.col(30) += 0.9 * (mesh.points.col(31) - mesh.points.col(30)); // the ids stay
  CHECK_THROWS_AS(operator_errors(mesh), const Error&);
  mesh.triangles(0, 3) = 99;
  CHECK_THROWS_AS(operator_errors(mesh), const Error&);
}
