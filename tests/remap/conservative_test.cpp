// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/remap.h>
#include <calotte/voronoi.h>

#include "base/lonlat.h"
#include "delaunay/delaunay.h"
#include "support/errors.h"
#include "support/random.h"

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

using namespace calotte;

namespace {

Polygons cells_of(const Mesh& mesh) { return polygons_of(voronoi(mesh)); }
Polygons cells_of(const Points3& points) { return cells_of(delaunay(points)); }

DoubleVector steps(double first, double step, Eigen::Index n) {
  return DoubleVector::LinSpaced(n, first, first + step * static_cast<double>(n - 1));
}

/// Rotates so that a direction comes to the north pole, or to a direction near it.
Points3 with_pole_at(const Points3& points, const Eigen::Vector3d& direction,
                     const Eigen::Vector3d& pole = {0, 0, 1}) {
  return Eigen::Quaterniond::FromTwoVectors(direction, pole).toRotationMatrix() * points;
}

/// Meshes with a site, a vertex and an edge at a pole, and with cells on the date line.
std::vector<Polygons> closed_cells() {
  const Points3 octahedron = cubed_sphere(1), random = random_sphere(60);
  std::vector<Polygons> all{cells_of(random),
                            cells_of(fibonacci_sphere(200)),
                            cells_of(cubed_sphere(4)),
                            cells_of(lat_lon_sphere(6, 12, true)),
                            cells_of(lat_lon_sphere(6, 12, false)),
                            cells_of(bisected_icosahedron(1)),
                            cells_of(octahedron)};
  Polygons vertex = cells_of(random), edge = vertex;
  vertex.corners = with_pole_at(vertex.corners, vertex.corners.col(7));
  vertex.corners.col(7) = Eigen::Vector3d(0, 0, 1);
  all.push_back(vertex);
  const Eigen::Vector3d middle =
      (edge.corners.col(edge.ids[5][0]) + edge.corners.col(edge.ids[5][1])).normalized();
  edge.corners = with_pole_at(edge.corners, middle, {0, 0, -1});
  all.push_back(edge);
  return all;
}

std::vector<LonLatBoxes> closed_boxes() {
  DoubleVector gauss(6);
  gauss << -68, -40.5, -13.5, 13.5, 40.5, 68;
  return {lon_lat_boxes(36, 18),
          lon_lat_boxes(7, 5),
          lon_lat_boxes(3, 1),
          lon_lat_boxes(steps(-180, 10, 37), steps(90, -10, 19)), // the first meridian repeated
          lon_lat_boxes(steps(-177.5, 5, 72), steps(-87.5, 5, 36)),
          lon_lat_boxes(steps(0, 22.5, 16), gauss)};
}

/// A smooth field of cells.
DoubleVector values_of(std::int64_t n) {
  DoubleVector values(n);
  for (std::int64_t i = 0; i < n; ++i)
    values[i] = 2 + std::sin(0.7 * static_cast<double>(i));
  return values;
}

/// The laws of any overlap, and for grids that cover the same whole area.
void check_laws(const GridWeights& found, double whole) {
  const Weights& weights = found.weights;
  REQUIRE(weights.rows() == found.target_area.size());
  REQUIRE(weights.cols() == found.source_area.size());
  CHECK(std::abs(found.source_area.sum() - whole) < 1e-12 * whole);
  CHECK(std::abs(found.target_area.sum() - whole) < 1e-12 * whole);
  for (Eigen::Index i = 0; i < weights.rows(); ++i) {
    double sum = 0;
    std::int64_t last = -1;
    for (Weights::InnerIterator entry(weights, i); entry; ++entry) {
      CHECK(entry.value() > 0);
      CHECK(entry.col() > last);
      last = entry.col();
      sum += entry.value();
    }
    CHECK(std::abs(sum - 1) < 1e-12);
  }
  CHECK((found.source_fraction.array() - 1).abs().maxCoeff() < 1e-12);
  CHECK((found.target_fraction.array() - 1).abs().maxCoeff() < 1e-12);
  const DoubleVector values = values_of(weights.cols());
  const DoubleVector moved = interpolate(weights, values);
  CHECK(std::abs(found.target_area.dot(moved) - found.source_area.dot(values)) < 1e-12 * 3 * whole);
}

/// A box as a polygon with many corners on its parallels.
Polygons fine_polygons(const LonLatBoxes& boxes, int parts) {
  Polygons polygons;
  std::vector<Eigen::Vector3d> corners;
  const Eigen::Index columns = boxes.longitudes.size();
  polygons.ids.begin.resize(boxes.size() + 1);
  polygons.ids.begin[0] = 0;
  const auto add = [&](double longitude, double latitude) {
    const double x = longitude * std::numbers::pi / 180, y = latitude * std::numbers::pi / 180;
    corners.emplace_back(std::cos(y) * std::cos(x), std::cos(y) * std::sin(x), std::sin(y));
  };
  for (Eigen::Index k = 0; k < boxes.size(); ++k) {
    const Eigen::Index i = k % columns, j = k / columns;
    for (int p = 0; p <= parts; ++p)
      add(std::lerp(boxes.meridians[i], boxes.meridians[i + 1], double(p) / parts),
          boxes.parallels[j]);
    for (int p = parts; p >= 0; --p)
      add(std::lerp(boxes.meridians[i], boxes.meridians[i + 1], double(p) / parts),
          boxes.parallels[j + 1]);
    polygons.ids.begin[k + 1] = static_cast<std::int64_t>(corners.size());
  }
  polygons.corners.resize(3, static_cast<Eigen::Index>(corners.size()));
  polygons.ids.items.resize(static_cast<Eigen::Index>(corners.size()));
  for (std::size_t c = 0; c < corners.size(); ++c) {
    polygons.corners.col(static_cast<Eigen::Index>(c)) = corners[c];
    polygons.ids.items[static_cast<Eigen::Index>(c)] = static_cast<std::int32_t>(c);
  }
  return polygons;
}

Eigen::MatrixXd dense(const Weights& weights) { return weights; }

/// Where corners of a partition lie in relation to the lines of a raster.
enum class Nudge { none, ulps, tiny };

/// A unit vector near another.
Eigen::Vector3d nudged(const Eigen::Vector3d& x, Nudge nudge, test::Random& random) {
  Eigen::Vector3d out = x;
  for (double& value : out) {
    if (nudge == Nudge::none || random.integer(0, 1) == 0)
      continue;
    value = nudge == Nudge::ulps
                ? std::nextafter(value, random.integer(0, 1) == 0 ? -2.0 : 2.0)
                : value + random.real(-1, 1) * std::pow(10, -random.integer(8, 15));
  }
  return nudge == Nudge::tiny ? out.normalized() : out;
}

/// Quadrilaterals, and triangles at the poles, between whole multiples of steps of longitude and
/// latitude, with great circles as sides; corners are off these by as little as rounding. Their
/// corners are shared, so they are a partition of the sphere.
Polygons graticule_cells(int columns, int rows, Nudge nudge, std::uint64_t seed) {
  test::Random random(seed);
  Polygons cells;
  const auto corner_id = [&](int i, int j) {
    return j == 0 ? 0 : j == rows ? 1 : 2 + (j - 1) * columns + (i % columns + columns) % columns;
  };
  cells.corners.resize(3, 2 + columns * (rows - 1));
  cells.corners.col(0) = Eigen::Vector3d(0, 0, -1);
  cells.corners.col(1) = Eigen::Vector3d(0, 0, 1);
  for (int j = 1; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto x = base_detail::from_lonlat(360.0 * i / columns, 180.0 * j / rows - 90);
      cells.corners.col(corner_id(i, j)) = nudged({x.x, x.y, x.z}, nudge, random);
    }
  std::vector<std::int32_t> ids;
  std::vector<std::int64_t> begin{0};
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      for (const int id :
           {corner_id(i, j), corner_id(i + 1, j), corner_id(i + 1, j + 1), corner_id(i, j + 1)})
        if (static_cast<std::int64_t>(ids.size()) == begin.back() || ids.back() != id)
          ids.push_back(id);
      begin.push_back(static_cast<std::int64_t>(ids.size()));
    }
  cells.ids.begin = Eigen::Map<const Offsets>(begin.data(), std::ssize(begin));
  cells.ids.items = Eigen::Map<const Ids>(ids.data(), std::ssize(ids));
  return cells;
}

/// A cubed sphere of n x n cells a face, of equal angles, with its corners on a parallel or a
/// meridian in many cells.
Polygons cubed_cells(int n, Nudge nudge, std::uint64_t seed) {
  test::Random random(seed);
  Polygons cells;
  std::map<std::array<std::int64_t, 3>, std::int32_t> known;
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::int32_t> ids;
  const auto corner = [&](int face, int i, int j) {
    const double a = std::tan((static_cast<double>(2 * i) / n - 1) * std::numbers::pi / 4),
                 b = std::tan((static_cast<double>(2 * j) / n - 1) * std::numbers::pi / 4);
    const Eigen::Vector3d faces[] = {{1, a, b},  {-a, 1, b}, {-1, -a, b},
                                     {a, -1, b}, {-b, a, 1}, {b, a, -1}};
    const Eigen::Vector3d x = faces[face].normalized();
    const std::array<std::int64_t, 3> key{std::llround(x.x() * 1e9), std::llround(x.y() * 1e9),
                                          std::llround(x.z() * 1e9)};
    const auto [at, is_new] = known.emplace(key, static_cast<std::int32_t>(corners.size()));
    if (is_new)
      corners.push_back(nudged(x, nudge, random));
    return at->second;
  };
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        ids.insert(ids.end(), {corner(face, i, j), corner(face, i + 1, j),
                               corner(face, i + 1, j + 1), corner(face, i, j + 1)});
  cells.corners.resize(3, std::ssize(corners));
  for (std::size_t k = 0; k < corners.size(); ++k)
    cells.corners.col(static_cast<Eigen::Index>(k)) = corners[k];
  cells.ids.items = Eigen::Map<const Ids>(ids.data(), std::ssize(ids));
  cells.ids.begin = Offsets::LinSpaced(6 * n * n + 1, 0, 4 * 6 * n * n);
  return cells;
}

} // namespace

TEST_CASE("shares of a partition sum to the areas where corners lie on parallels and meridians") {
  for (const Nudge nudge : {Nudge::none, Nudge::ulps, Nudge::tiny})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      std::vector<Polygons> all;
      for (const auto& [columns, rows] : {std::pair(36, 18), {30, 15}, {60, 30}, {24, 6}})
        all.push_back(graticule_cells(columns, rows, nudge, seed));
      for (const int n : {3, 10, 18})
        all.push_back(cubed_cells(n, nudge, seed));
      for (const Polygons& cells : all)
        for (const LonLatBoxes& boxes :
             {lon_lat_boxes(36, 18), lon_lat_boxes(60, 30), lon_lat_boxes(80, 45),
              lon_lat_boxes(steps(-180, 5, 72), steps(90, -5, 37))}) {
          CAPTURE(static_cast<int>(nudge));
          CAPTURE(seed);
          CAPTURE(cells.size());
          CAPTURE(boxes.size());
          check_laws(conservative_weights(boxes, cells), 4 * std::numbers::pi);
          check_laws(conservative_weights(cells, boxes), 4 * std::numbers::pi);
        }
    }
}

TEST_CASE("a cell between the lines of a raster shares its area with that box but for its bulges") {
  for (const Nudge nudge : {Nudge::none, Nudge::ulps, Nudge::tiny})
    for (const auto& [columns, rows] : {std::pair(180, 90), {90, 45}, {72, 36}}) {
      const Polygons cells = graticule_cells(columns, rows, nudge, 4);
      const Weights weights = conservative_weights(lon_lat_boxes(columns, rows), cells).weights;
      double least = 1;
      for (Eigen::Index k = 0; k < weights.rows(); ++k)
        least = std::min(least, weights.coeff(k, k));
      CHECK(least > 0.98);
    }
}

TEST_CASE("cells and boxes share all of the sphere, in both directions") {
  for (const Polygons& cells : closed_cells())
    for (const LonLatBoxes& boxes : closed_boxes()) {
      CAPTURE(cells.size());
      CAPTURE(boxes.size());
      check_laws(conservative_weights(cells, boxes), 4 * std::numbers::pi);
      check_laws(conservative_weights(boxes, cells), 4 * std::numbers::pi);
    }
}

TEST_CASE("cells and cells, boxes and boxes share all of the sphere") {
  const std::vector<Polygons> cells = closed_cells();
  for (std::size_t k = 0; k < cells.size(); ++k)
    check_laws(conservative_weights(cells[k], cells[(k + 1) % cells.size()]), 4 * std::numbers::pi);
  const std::vector<LonLatBoxes> boxes = closed_boxes();
  for (std::size_t k = 0; k < boxes.size(); ++k)
    check_laws(conservative_weights(boxes[k], boxes[(k + 1) % boxes.size()]), 4 * std::numbers::pi);
}

TEST_CASE("the areas of boxes are exact, and those at a pole are sectors of its cap") {
  const LonLatBoxes boxes = lon_lat_boxes(1440, 720);
  const DoubleVector found = areas(boxes);
  CHECK(std::abs(found.sum() - 4 * std::numbers::pi) < 1e-12 * 4 * std::numbers::pi);
  const double step = std::numbers::pi / 720, half = std::sin(step / 2);
  CHECK(std::abs(found[0] - 2 * step * half * half) < 1e-15 * found[0]);
  const double third =
      step * (std::sin(std::numbers::pi / 6) - std::sin(std::numbers::pi / 6 - step));
  CHECK(std::abs(found[1440 * 479] - third) < 1e-13 * third);
}

TEST_CASE("a mesh to itself is the unit matrix") {
  for (const Polygons& cells : closed_cells()) {
    const Eigen::MatrixXd weights = dense(conservative_weights(cells, cells).weights);
    CHECK((weights - Eigen::MatrixXd::Identity(cells.size(), cells.size())).cwiseAbs().maxCoeff() <
          1e-12);
  }
  for (const LonLatBoxes& boxes : closed_boxes()) {
    const Eigen::MatrixXd weights = dense(conservative_weights(boxes, boxes).weights);
    CHECK((weights - Eigen::MatrixXd::Identity(boxes.size(), boxes.size())).cwiseAbs().maxCoeff() <
          1e-12);
  }
}

TEST_CASE("parallels are small circles: polygons with ever more corners on them agree") {
  const LonLatBoxes boxes = lon_lat_boxes(steps(3, 30, 12), steps(-75, 30, 6));
  for (const Polygons& cells : closed_cells()) {
    const Eigen::MatrixXd exact = dense(conservative_weights(cells, boxes).weights);
    const auto difference = [&](int parts) {
      return (dense(conservative_weights(cells, fine_polygons(boxes, parts)).weights) - exact)
          .cwiseAbs()
          .maxCoeff();
    };
    const double coarse = difference(4), fine = difference(16);
    CHECK(coarse > 1e-4);
    CHECK(fine < coarse / 12); // 16, but for rows that are divided by their sums
  }
}

TEST_CASE("cells that hold many boxes, and boxes that hold many cells") {
  check_laws(conservative_weights(cells_of(cubed_sphere(1)), lon_lat_boxes(360, 180)),
             4 * std::numbers::pi);
  check_laws(conservative_weights(lon_lat_boxes(360, 180), cells_of(bisected_icosahedron(0))),
             4 * std::numbers::pi);
  check_laws(conservative_weights(cells_of(fibonacci_sphere(20000)), lon_lat_boxes(4, 2)),
             4 * std::numbers::pi);
  check_laws(conservative_weights(cells_of(fibonacci_sphere(20000)), cells_of(cubed_sphere(1))),
             4 * std::numbers::pi);
}

TEST_CASE("a part of the sphere: what is shared, and rows outside that are empty") {
  const Polygons cells = cells_of(fibonacci_sphere(300));
  const LonLatBoxes part = lon_lat_boxes(steps(170, 2, 21), steps(-10, 2, 41));
  const GridWeights to = conservative_weights(part, cells),
                    from = conservative_weights(cells, part);
  CHECK((from.target_fraction.array() - 1).abs().maxCoeff() < 1e-12);
  const double area = from.target_area.sum(), width = 42 * std::numbers::pi / 180;
  CHECK(std::abs(area - width * (std::sin(71 * std::numbers::pi / 180) +
                                 std::sin(11 * std::numbers::pi / 180))) < 1e-13);
  CHECK(std::abs(to.target_fraction.dot(to.target_area) - area) < 1e-13);
  CHECK(std::abs(from.source_fraction.dot(from.source_area) - area) < 1e-13);
  const DoubleVector values = values_of(part.size()), moved = interpolate(to.weights, values);
  double kept = 0;
  std::int64_t outside = 0;
  for (Eigen::Index i = 0; i < moved.size(); ++i) {
    CHECK(std::isnan(moved[i]) == (to.target_fraction[i] == 0));
    outside += std::isnan(moved[i]) ? 1 : 0;
    if (!std::isnan(moved[i]))
      kept += moved[i] * to.target_area[i] * to.target_fraction[i];
  }
  CHECK(outside > 150);
  CHECK(std::abs(kept - to.source_area.dot(values)) < 1e-12);
}

TEST_CASE("concave cells count what they hold") {
  // An L of three squares, and the square that completes it.
  Polygons shape, whole;
  shape.corners.resize(3, 8);
  shape.corners << 1, 1, 1, 1, 1, 1, 1, 1, //
      0, .2, .2, .1, .1, 0, .2, 0,         //
      0, 0, .1, .1, .2, .2, .2, .1;
  shape.corners.colwise().normalize();
  shape.ids.begin.resize(3);
  shape.ids.begin << 0, 6, 10;
  shape.ids.items.resize(10);
  shape.ids.items << 0, 1, 2, 3, 4, 5, 3, 2, 6, 4;
  whole.corners = shape.corners;
  whole.ids.begin.resize(2);
  whole.ids.begin << 0, 4;
  whole.ids.items.resize(4);
  whole.ids.items << 0, 1, 6, 5;
  for (const GridWeights& found :
       {conservative_weights(shape, whole), conservative_weights(whole, shape)}) {
    CHECK((found.source_fraction.array() - 1).abs().maxCoeff() < 1e-12);
    CHECK((found.target_fraction.array() - 1).abs().maxCoeff() < 1e-12);
  }
  CHECK(
      (dense(conservative_weights(shape, shape).weights) - Eigen::MatrixXd::Identity(2, 2)).norm() <
      1e-12);
  const LonLatBoxes boxes = lon_lat_boxes(360, 180);
  const GridWeights found = conservative_weights(shape, boxes);
  CHECK((found.source_fraction.array() - 1).abs().maxCoeff() < 1e-12);
}

TEST_CASE("polygons in the plane, and round its periods") {
  const Surface square = rectangle({0, 0}, {3, 2});
  const auto clipped = [&](std::uint64_t seed) {
    return cells_of(delaunay(random_points(200, square, {}, seed), square));
  };
  check_laws(conservative_weights(clipped(1), clipped(2)), 6);
  const auto periodic = [](std::uint64_t seed) {
    const Surface box = Surface::periodic({3, 2});
    return cells_of(delaunay(random_points(150, box, {}, seed), box));
  };
  check_laws(conservative_weights(periodic(1), periodic(2)), 6);
  CHECK_THROWS_AS(conservative_weights(clipped(1), periodic(2)), Error);
  CHECK_THROWS_AS(conservative_weights(clipped(1), lon_lat_boxes(4, 2)), Error);
}

TEST_CASE("the weights are the same for any number of threads") {
  const Polygons cells = cells_of(random_sphere(9000)), others = cells_of(fibonacci_sphere(7000));
  const LonLatBoxes boxes = lon_lat_boxes(144, 72);
  const auto same = [](const Weights& a, const Weights& b) {
    return a.nonZeros() == b.nonZeros() &&
           std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr()) &&
           std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
  };
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return std::vector<Weights>{conservative_weights(cells, boxes).weights,
                                conservative_weights(boxes, cells).weights,
                                conservative_weights(cells, others).weights};
  };
  const std::vector<Weights> one = with(1), four = with(4);
  for (std::size_t k = 0; k < one.size(); ++k)
    CHECK(same(one[k], four[k]));
}

TEST_CASE("positions in rasters") {
  const Points3 at = random_sphere(3000, 5);
  for (const LonLatBoxes& boxes : closed_boxes()) {
    const Points3 of_boxes = nodes(boxes);
    const Weights linear = interpolation_weights(boxes, at, Interpolation::linear),
                  nearest = interpolation_weights(boxes, at, Interpolation::nearest);
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
      CHECK(std::abs(linear.row(i).sum() - 1) < 1e-12);
      CHECK(nearest.row(i).nonZeros() == 1);
    }
    // Bilinear fields of latitude, and of longitude away from where it jumps.
    DoubleVector latitudes(boxes.size()), longitudes(boxes.size());
    for (Eigen::Index k = 0; k < boxes.size(); ++k) {
      latitudes[k] = boxes.latitudes[k / boxes.longitudes.size()];
      longitudes[k] = boxes.longitudes[k % boxes.longitudes.size()];
    }
    const DoubleVector y = interpolate(linear, latitudes), x = interpolate(linear, longitudes);
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
      const double latitude = std::asin(at(2, i)) * 180 / std::numbers::pi;
      double longitude = std::atan2(at(1, i), at(0, i)) * 180 / std::numbers::pi;
      if (longitude < boxes.longitudes[0])
        longitude += 360;
      if (std::abs(latitude) > boxes.latitudes.cwiseAbs().maxCoeff())
        continue;
      CHECK(std::abs(y[i] - latitude) < 1e-9);
      if (longitude <= boxes.longitudes.tail(1)[0])
        CHECK(std::abs(x[i] - longitude) < 1e-9);
    }
    // At nodes both have the node's own value, unless the raster repeats it.
    if (boxes.longitudes.tail(1)[0] < boxes.longitudes[0] + 360 &&
        boxes.latitudes.cwiseAbs().maxCoeff() < 90) {
      const DoubleVector values = values_of(boxes.size());
      for (const Interpolation kind : {Interpolation::linear, Interpolation::nearest})
        CHECK((interpolate(interpolation_weights(boxes, of_boxes, kind), values) - values)
                  .cwiseAbs()
                  .maxCoeff() < 1e-9);
    }
  }
  const LonLatBoxes part = lon_lat_boxes(steps(10, 1, 20), steps(40, -1, 20));
  const Weights nearest = interpolation_weights(part, at, Interpolation::nearest),
                linear = interpolation_weights(part, at, Interpolation::linear);
  for (Eigen::Index i = 0; i < at.cols(); ++i) {
    const double latitude = std::asin(at(2, i)) * 180 / std::numbers::pi,
                 longitude = std::atan2(at(1, i), at(0, i)) * 180 / std::numbers::pi;
    const bool inside = longitude > 9.5 && longitude < 29.5 && latitude > 20.5 && latitude < 40.5;
    CHECK(nearest.row(i).nonZeros() == (inside ? 1 : 0));
    CHECK(std::abs(linear.row(i).sum() - (inside ? 1 : 0)) < 1e-12);
  }
}

TEST_CASE("a raster of one box") {
  LonLatBoxes box;
  box.longitudes = box.latitudes = DoubleVector::Constant(1, 10);
  box.meridians = box.parallels = DoubleVector::LinSpaced(2, 0, 20);
  const Points3 at = nodes(box);
  for (const Interpolation kind : {Interpolation::linear, Interpolation::nearest}) {
    CHECK(interpolation_weights(box, at, kind).coeff(0, 0) == 1);
    CHECK(interpolation_weights(box, Points3(-at), kind).nonZeros() == 0);
  }
  const GridWeights weights = conservative_weights(box, cells_of(fibonacci_sphere(500)));
  CHECK(std::abs(weights.source_fraction[0] - 1) < 1e-12);
}

TEST_CASE("near a pole linear weights go over to the mean of the last row") {
  const LonLatBoxes boxes = lon_lat_boxes(8, 4);
  const DoubleVector values = values_of(boxes.size());
  Points3 pole(3, 2);
  pole << 0, 0, 0, 0, 2, -3;
  const DoubleVector there =
      interpolate(interpolation_weights(boxes, pole, Interpolation::linear), values);
  CHECK(std::abs(there[0] - values.tail(8).mean()) < 1e-14);
  CHECK(std::abs(there[1] - values.head(8).mean()) < 1e-14);
}

TEST_CASE("what is wrong with boxes is said") {
  const Polygons cells = cells_of(cubed_sphere(1));
  CHECK_THROWS_WITH_AS(lon_lat_boxes(2, 5), doctest::Contains("2 x 5"), Error);
  CHECK_THROWS_WITH_AS(lon_lat_boxes(steps(0, -30, 12), steps(-75, 30, 6)),
                       "longitude[1] = -30 does not follow 0; sort the raster along it", Error);
  CHECK_THROWS_WITH_AS(lon_lat_boxes(steps(0, 30, 12), steps(-95, 30, 6)),
                       "latitude[0] = -95 is outside -90 to 90; give degrees", Error);
  CHECK_THROWS_WITH_AS(lon_lat_boxes(steps(0, 31, 13), steps(-75, 30, 6)),
                       doctest::Contains("span"), Error);
  LonLatBoxes boxes = lon_lat_boxes(4, 2);
  boxes.meridians.conservativeResize(3);
  CHECK_THROWS_WITH_AS(conservative_weights(cells, boxes),
                       doctest::Contains("give one more of each"), Error);
  Polygons bad = cells;
  bad.ids.items[3] = 99;
  CHECK_THROWS_WITH_AS(conservative_weights(bad, cells),
                       doctest::Contains("polygon 0 has corner 99"), Error);
  CHECK_THROWS_AS(
      interpolation_weights(lon_lat_boxes(4, 2), cells.centres, Interpolation::natural_neighbours),
      Error);
  CHECK_THROWS_AS(
      interpolation_weights(delaunay(cubed_sphere(2)), cells.centres, Interpolation::conservative),
      Error);
}

// ---- Fields

namespace {

/// A source of four cells, of which the third target cell has none.
GridWeights small_weights() {
  GridWeights out{.weights = Weights(3, 4),
                  .source_area = DoubleVector::Ones(4),
                  .target_area = DoubleVector::Ones(3),
                  .source_fraction = DoubleVector::Ones(4),
                  .target_fraction = DoubleVector::Ones(3)};
  out.weights.insert(0, 0) = 0.5;
  out.weights.insert(0, 1) = 0.25;
  out.weights.insert(0, 2) = 0.25;
  out.weights.insert(1, 3) = 1;
  out.weights.makeCompressed();
  out.target_fraction[0] = 0.8;
  out.target_fraction[2] = 0;
  return out;
}

MeshField field_of(std::initializer_list<double> values, bool integer = false) {
  MeshField field{.name = "f", .integer = integer};
  field.values =
      Eigen::Map<const DoubleVector>(values.begin(), static_cast<Eigen::Index>(values.size()));
  return field;
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

} // namespace

TEST_CASE("missing values do not count, and cells need the least cover") {
  const GridWeights weights = small_weights();
  const DoubleVector all = interpolate(weights, field_of({1, 2, 4, 8})).values;
  CHECK(all[0] == 2);
  CHECK(all[1] == 8);
  CHECK(std::isnan(all[2]));
  const MeshField gap = field_of({1, none, 4, none});
  const DoubleVector rest = interpolate(weights, gap).values; // 0.6 of the first cell
  CHECK(std::abs(rest[0] - 1.5 / 0.75) < 1e-15);
  CHECK(std::isnan(rest[1]));
  CHECK(std::isnan(interpolate(weights, gap, 0.61).values[0]));
  CHECK(!std::isnan(interpolate(weights, gap, 0.6).values[0]));
  CHECK_THROWS_AS(interpolate(weights, gap, 1.5), Error);
  CHECK_THROWS_WITH_AS(interpolate(weights, field_of({1, 2, 3})),
                       "the field f has 3 values for 4 cells of the source; give 1 for each",
                       Error);
}

TEST_CASE("categories are those of the greatest weight, of equal ones the lowest") {
  const GridWeights weights = small_weights();
  CHECK(interpolate(weights, field_of({7, 5, 5, 3}, true)).values[0] == 5);
  CHECK(interpolate(weights, field_of({3, 5, 5, 3}, true)).values[0] == 3);
  CHECK(interpolate(weights, field_of({9, 4, 6, 3}, true)).values[0] == 9);
  CHECK(interpolate(weights, field_of({none, 4, 6, 3}, true)).values[0] == 4);
  CHECK(interpolate(weights, field_of({9, 4, 6, 3}, true)).integer);
}

TEST_CASE("fields of several numbers for each cell") {
  const GridWeights weights = small_weights();
  MeshField field = field_of({1, 10, 2, 20, 4, none, 8, 80});
  field.dimensions = {{"level", 2}};
  const MeshField found = interpolate(weights, field);
  REQUIRE(found.values.size() == 6);
  CHECK(found.values[0] == 2);
  CHECK(std::abs(found.values[1] - 10 / 0.75) < 1e-14);
  CHECK(found.values[3] == 80);
}

TEST_CASE("the cell that holds a position") {
  for (const Polygons& cells : {cells_of(random_sphere(400)), cells_of(cubed_sphere(3))}) {
    const Points3 at = random_sphere(500, 8);
    const Ids found = cells_at(cells, at);
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
      Eigen::Index nearest = 0;
      (cells.centres.transpose() * at.col(i)).maxCoeff(&nearest);
      CHECK(found[i] == nearest);
    }
  }
  const Surface periodic = Surface::periodic({3, 2});
  const Polygons box = cells_of(delaunay(random_points(80, periodic), periodic));
  const Points3 inside = random_points(200, periodic, {}, 4);
  const Ids here = cells_at(box, inside),
            there = cells_at(box, inside.colwise() + Eigen::Vector3d(6, -4, 0));
  CHECK(here.minCoeff() >= 0);
  CHECK(here == there);
  Polygons part = cells_of(random_sphere(400));
  part.ids.begin.conservativeResize(201);
  const Ids found = cells_at(part, random_sphere(500, 8));
  CHECK(found.minCoeff() == -1);
  CHECK(found.maxCoeff() < 200);
  CHECK((found.array() < 0).count() > 150);
}

TEST_CASE("the positions whose cells are asked for are those of locate()") {
  const Surface periodic = Surface::periodic({3, 2});
  for (const Surface& surface : {Surface::sphere(), periodic}) {
    const Polygons cells = cells_of(delaunay(random_points(80, surface), surface));
    Points3 at = random_points(3, surface);
    at(1, 2) = std::nan("");
    const Error error = test::error_of([&] { cells_at(cells, at); });
    CHECK(error.code() == ErrorCode::not_finite);
    CHECK(error.index() == 2);
    CHECK(std::string(error.what()) == "position 2 is not finite; leave it out");
  }
}
