// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/errors.h"
#include "support/files.h"
#include "support/random.h"
#include "support/shuffled.h"

#include "base/lonlat.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/field_grid.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr Interpolation linear = Interpolation::linear, nearest = Interpolation::nearest,
                        natural = Interpolation::natural_neighbours;

MeshField field(const std::string& name, const DoubleVector& values) {
  MeshField made{.name = name};
  made.values = values;
  return made;
}

/// Positions with z = 0 are of a plane.
FieldGrid positions(const Points3& points, bool plane = false) {
  FieldGrid grid{.name = "points"};
  grid.positions = Positions{.surface = plane ? Surface::plane() : Surface::sphere(),
                             .points = points,
                             .coordinates = points.topRows<2>()};
  return grid;
}

/// Random points of a square, or on the sphere.
Points3 random_places(std::int64_t n, bool plane, Random& random) {
  Points3 points(3, n);
  for (std::int64_t i = 0; i < n; ++i) {
    const base_detail::Vec3 p =
        plane ? base_detail::Vec3{random.real(-3, 4), random.real(2, 9), 0} : random.direction();
    points.col(i) << p.x, p.y, p.z;
  }
  return points;
}

DoubleVector random_values(std::int64_t n, Random& random) {
  return DoubleVector::NullaryExpr(n, [&](Eigen::Index) { return random.real(-5, 5); });
}

DoubleVector at(const FieldGrid& source, const Points3& places, Interpolation kind) {
  return interpolate_scattered(source, positions(places, !source.positions->surface.is_sphere()),
                               kind)
      .fields.at(0)
      .values;
}

bool same_bits(const DoubleVector& a, const DoubleVector& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return x == y || (std::isnan(x) && std::isnan(y));
         });
}

FieldGrid read(const std::string& text, const ColumnChoice& choice = {}) {
  std::istringstream in(text);
  return read_positions(in, "obs.csv", choice);
}

std::string refusal(const std::string& text, const ColumnChoice& choice = {}) {
  return message_of([&] { read(text, choice); });
}

} // namespace

TEST_CASE("scattered: linear functions of a plane are exact, by linear and natural") {
  Random random(1);
  FieldGrid source = positions(random_places(500, true, random), true);
  const auto exact = [](const Points3& at) -> DoubleVector {
    return (2 - 3 * at.row(0).array() + 0.5 * at.row(1).array()).transpose();
  };
  source.fields = {field("f", exact(source.positions->points))};
  const Points3 places = random_places(4000, true, random);
  for (const Interpolation kind : {linear, natural}) {
    const DoubleVector found = at(source, places, kind), known = exact(places);
    std::int64_t inside = 0;
    for (Eigen::Index i = 0; i < found.size(); ++i)
      if (!std::isnan(found[i])) {
        ++inside;
        CHECK(std::abs(found[i] - known[i]) < 1e-12 * 20);
      }
    CHECK(inside > 3700);
    CHECK(inside < 4000); // the hull is not the square
  }
}

TEST_CASE("scattered: on the sphere linear values of the direction point to the position") {
  Random random(2);
  FieldGrid source = positions(random_places(300, false, random));
  for (int k = 0; k < 3; ++k)
    source.fields.push_back(
        field(std::string(1, "xyz"[k]), source.positions->points.row(k).transpose()));
  const Points3 places = random_places(2000, false, random);
  const ScatteredFields found = interpolate_scattered(source, positions(places), linear);
  REQUIRE(found.fields.size() == 3);
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const Eigen::Vector3d v(found.fields[0].values[i], found.fields[1].values[i],
                            found.fields[2].values[i]);
    CHECK(v.cross(Eigen::Vector3d(places.col(i))).norm() < 1e-13);
    CHECK(v.norm() > 0.5);
    CHECK(v.norm() < 1 + 1e-12);
  }
}

TEST_CASE("scattered: values at the data are the data, and natural is continuous across edges") {
  Random random(3);
  for (const bool plane : {false, true}) {
    FieldGrid source = positions(random_places(400, plane, random), plane);
    const Points3& points = source.positions->points;
    source.fields = {field("f", random_values(400, random))};
    for (const Interpolation kind : {linear, natural, nearest})
      CHECK((at(source, points, kind) - source.fields[0].values).cwiseAbs().maxCoeff() < 1e-12);
    const Mesh mesh = delaunay(points, source.positions->surface);
    std::vector<Eigen::Vector3d> sides;
    constexpr double step = 1e-9;
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
      for (int v = 0; v < 3; ++v) {
        if (mesh.neighbours(v, t) < t) // once each; none at the boundary
          continue;
        const Eigen::Vector3d a = mesh.points.col(mesh.triangles((v + 1) % 3, t)),
                              b = mesh.points.col(mesh.triangles((v + 2) % 3, t)),
                              middle = 0.7 * a + 0.3 * b,
                              up = plane ? Eigen::Vector3d(0, 0, 1) : middle.normalized(),
                              across = (b - a).cross(up).normalized();
        sides.push_back(middle - step * across);
        sides.push_back(middle + step * across);
      }
    REQUIRE(sides.size() > 2000);
    Points3 places(3, std::ssize(sides));
    for (std::size_t i = 0; i < sides.size(); ++i)
      places.col(static_cast<Eigen::Index>(i)) = sides[i];
    for (const Interpolation kind : {linear, natural}) {
      const DoubleVector found = at(source, places, kind);
      for (Eigen::Index i = 0; i < found.size(); i += 2)
        CHECK(std::abs(found[i] - found[i + 1]) < 1e-4); // slopes of 1e4 and less, random values
    }
  }
}

TEST_CASE("scattered: nearest is that of all, also outside of the hull") {
  Random random(4);
  for (const bool plane : {false, true}) {
    Points3 points = random_places(200, plane, random);
    if (!plane)
      points.row(2) = points.row(2).cwiseAbs(); // a hemisphere
    FieldGrid source = positions(points, plane);
    source.fields = {field("f", DoubleVector::LinSpaced(200, 0, 199))};
    Points3 places = random_places(3000, plane, random);
    if (plane)
      places *= 1.5;
    const DoubleVector found = at(source, places, nearest);
    std::int64_t outside = at(source, places, linear).array().isNaN().count();
    CHECK(outside > 300);
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
      Eigen::Index best;
      (points.colwise() - places.col(i)).colwise().squaredNorm().minCoeff(&best);
      CHECK(found[i] == static_cast<double>(best));
    }
  }
}

TEST_CASE("scattered: the order of the rows and the number of threads change no bit") {
  Random random(5);
  FieldGrid source = positions(random_places(5000, false, random));
  for (Eigen::Index i = 0; i < 2000; ++i) // duplicates, some of another norm
    source.positions->points.col(3000 + i) =
        (i % 3 == 0 ? 4.0 : 1.0) * source.positions->points.col(i % 700);
  source.fields = {field("a", random_values(5000, random)),
                   field("b", random_values(5000, random))};
  for (Eigen::Index i = 0; i < 5000; i += 7)
    source.fields[1].values[i] = none;
  FieldGrid other = source;
  const std::vector<std::int32_t> order = permutation(5000, random);
  other.positions->points = source.positions->points(Eigen::all, order);
  for (MeshField& one : other.fields)
    one.values = DoubleVector(one.values(order));
  const FieldGrid target = positions(random_places(2000, false, random));
  for (const Interpolation kind : {linear, natural, nearest}) {
    const ScatteredFields known = interpolate_scattered(source, target, kind);
    CHECK(known.merged == 2000);
    for (const std::size_t threads : {1, 3}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const ScatteredFields found = interpolate_scattered(other, target, kind);
      CHECK(found.merged == known.merged);
      for (std::size_t k = 0; k < 2; ++k)
        CHECK(same_bits(found.fields[k].values, known.fields[k].values));
    }
  }
}

TEST_CASE("scattered: what is missing in a column leaves its row out for that column alone") {
  Random random(6);
  const Points3 points = random_places(60, false, random);
  FieldGrid both = positions(points);
  both.fields = {field("a", random_values(60, random)), field("b", random_values(60, random)),
                 field("c", random_values(60, random))};
  for (Eigen::Index i = 0; i < 20; ++i)
    both.fields[1].values[3 * i] = none;
  std::vector<Eigen::Index> with;
  for (Eigen::Index i = 0; i < 60; ++i)
    if (!std::isnan(both.fields[1].values[i]))
      with.push_back(i);
  FieldGrid part = positions(points(Eigen::all, with));
  part.fields = {field("b", both.fields[1].values(with))};
  const FieldGrid target = positions(random_places(500, false, random));
  const ScatteredFields found = interpolate_scattered(both, target, natural);
  CHECK(found.merged == 0);
  CHECK(same_bits(found.fields[1].values,
                  interpolate_scattered(part, target, natural).fields[0].values));
  FieldGrid alone = both;
  alone.fields = {both.fields[2]};
  CHECK(same_bits(found.fields[2].values,
                  interpolate_scattered(alone, target, natural).fields[0].values));
}

TEST_CASE("scattered: rows at one position are averaged: at poles, across the seam, by any norm") {
  const FieldGrid source =
      read("lon,lat,v\n0,90,1\n77,90,2\n-120,90,6\n180,10,4\n-180,10,8\n540,10,"
           "12\n0,-10,1\n90,-5,2\n-90,-5,3\n0,-90,7\n");
  const FieldGrid target = read("lon,lat\n5,90\n180,10\n0,-90\n", {.fields = {{}}});
  CHECK(target.fields.empty());
  for (const Interpolation kind : {linear, natural, nearest}) {
    const ScatteredFields found = interpolate_scattered(source, target, kind);
    CHECK(found.merged == 4);
    CHECK(found.fields[0].values[0] == 3);
    CHECK(found.fields[0].values[1] == 8);
    CHECK(found.fields[0].values[2] == 7);
  }
  // equal values of a pole stay what they are, however many
  std::string grid = "lon,lat,v\n";
  for (int lat = -90; lat <= 90; lat += 10)
    for (int lon = -180; lon <= 180; lon += 10)
      grid += std::to_string(lon) + "," + std::to_string(lat) + "," +
              (std::abs(lat) == 90 ? "0.1" : "0.3") + "\n";
  const ScatteredFields found = interpolate_scattered(read(grid), target, natural);
  CHECK(found.merged == 2 * 36 + 17);
  CHECK(found.fields[0].values[0] == 0.1);
}

TEST_CASE("scattered: three rows, none distinct, and all on a great circle or a line") {
  const FieldGrid target = *raster_of("36x18");
  const ScatteredFields three =
      interpolate_scattered(read("lon lat v\n0 0 2\n90 0 2\n0 90 2\n"), target, linear);
  for (const double value : three.fields[0].values)
    CHECK((std::isnan(value) || std::abs(value - 2) < 1e-14));
  CHECK(three.fields[0].values.array().isNaN().count() == 648 - 81);
  const auto fault = [&](const std::string& rows, bool plane = false) {
    const FieldGrid source = read((plane ? "x y v\n" : "lon lat v\n") + rows, {.plane = plane});
    return message_of([&] { interpolate_scattered(source, plane ? source : target, linear); });
  };
  CHECK(fault("5 5 1\n5 5 2\n365 5 3\n") ==
        "obs.csv: the 3 rows with v have fewer than 3 distinct positions; give more");
  CHECK(fault("0 0 1\n10 0 2\n20 0 3\n200 0 3\n") ==
        "obs.csv: the 4 rows with v are all on one great circle; give positions beside it, too");
  CHECK(fault("0 0 1\n1 1 2\n2 2 3\n", true) ==
        "obs.csv: the 3 rows with v are all on one line; give positions beside it, too");
  CHECK(fault("0 0 NaN\n1 1 NA\n2 3 nan\n") == "obs.csv: v has no values; leave it out");
  FieldGrid bad = positions(Points3::Random(3, 5));
  bad.fields = {field("f", DoubleVector::Ones(5))};
  bad.positions->points.col(3).setZero();
  CHECK(error_of([&] { interpolate_scattered(bad, target, linear); }).index() == 3);
  bad.positions->points(1, 2) = none;
  CHECK(error_of([&] { interpolate_scattered(bad, target, linear); }).index() == 2);
  CHECK(refusal_of([&] { interpolate_scattered(target, target, linear); }).find("has cells") !=
        std::string::npos);
  CHECK(refusal_of([&] {
          interpolate_scattered(three.fields.empty() ? target : read("0 0 1\n1 0 2\n0 3 4\n"),
                                target, Interpolation::conservative);
        }).find("give linear, nearest or natural") != std::string::npos);
  CHECK(refusal_of([&] {
          interpolate_scattered(read("x y v\n0 0 1\n1 0 2\n0 3 4\n", {.plane = true}), target,
                                linear);
        }).find("give grids of one surface") != std::string::npos);
}

TEST_CASE("scattered: fields of meshes and rasters go to positions") {
  FieldGrid raster = *raster_of("72x36");
  raster.fields = {field("z", nodes(*raster.boxes).row(2).transpose())};
  FieldGrid mesh{.name = "mesh"};
  mesh.mesh.mesh = delaunay(fibonacci_sphere(2000));
  mesh.fields = {field("z", mesh.mesh.mesh->points.row(2).transpose())};
  Random random(7);
  const FieldGrid target = positions(random_places(300, false, random));
  for (const FieldGrid& source : {raster, mesh}) {
    const GridWeights weights = interpolation_weights(source, target, linear);
    const DoubleVector found = interpolate(weights, source.fields[0]).values;
    CHECK((found - target.positions->points.row(2).transpose()).cwiseAbs().maxCoeff() < 5e-3);
    CHECK(refusal_of([&] {
            interpolation_weights(source, target, Interpolation::conservative);
          }).find("give linear, nearest or natural") != std::string::npos);
  }
  CHECK(refusal_of([&] {
          interpolation_weights(target, mesh, linear);
        }).find("interpolate_scattered()") != std::string::npos);
}

TEST_CASE("positions: separators, headers and choices of columns") {
  const FieldGrid known = read("lon,lat,t,u\n10,20,1,5\n-30,40,2.5,\n50,-60,NA,7\n");
  REQUIRE(known.fields.size() == 2);
  CHECK(known.fields[0].name == "t");
  CHECK(same_bits(known.fields[0].values, Eigen::Vector3d(1, 2.5, none)));
  CHECK(same_bits(known.fields[1].values, Eigen::Vector3d(5, none, 7)));
  CHECK(known.positions->coordinates(0, 1) == -30);
  const base_detail::Vec3 p = base_detail::from_lonlat(50, -60);
  CHECK(Eigen::Vector3d(known.positions->points.col(2)) == Eigen::Vector3d(p.x, p.y, p.z));
  const ColumnChoice by_number{.position = {"3", "2"}, .fields = {{"1", "4"}}};
  for (const auto& [text, choice] : std::vector<std::pair<std::string, ColumnChoice>>{
           {"Longitude;Latitude;t;u\r\n10;20;1;5\r\n-30;40;2.5;NaN\r\n50;-60;na;7", {}},
           {"\"lat\"\t\"lon\"\t\"t\"\t\"u\"\n20\t10\t1\t5\n40\t-30\t2.5\t\n-60\t50\tNaN\t7\n", {}},
           {"# lon lat t u\n10  20 1 5\n\n-30 40 2.5 NaN # a remark\n 50 -60 nan +7\n", {}},
           {"# of some day\nt lat_deg LON u\n1 20 10 5\n2.5 40 -30 NaN\nNA -60 50 7\n", {}},
           {"1,20,10,5\n2.5,40,-30,\nNaN,-60,50,7\n", by_number},
           {"t,a,b,u\n1,20,10,5\n2.5,40,-30,\nNaN,-60,50,7\n", {.position = {"B", "a"}}},
           {"name,lon,lat,t,u\nA b,10,20,1,5\nC,-30,40,2.5,\n,50,-60,,7\n",
            {.fields = {{"T", "u"}}}},
           {",lon,lat,t,u\n0,10,20,1,5\n1,-30,40,2.5,\n2,50,-60,,7\n", {}},
           {"# lat lon t u\n# of a day\n20 10 1 5\n40 -30 2.5 NaN\n-60 50 NaN 7\n", {}},
           {"lat,lon,2024,2025\n20,10,1,5\n40,-30,2.5,\n-60,50,NaN,7\n", {}},
           {"name,lon,lat,t,u\n\"A, b # c\",10,20,1,5\n \"C\" ,-30,40,2.5,\n\"\"\"D\"\", "
            "e\",50,-60,,7 # f\n",
            {.fields = {{"t", "u"}}}},
           {"\"a, b\";lon;lat;t;u\nc;10;20;1;5\nd;-30;40;2.5;\n\"e;\";50;-60;;7\n",
            {.fields = {{"t", "u"}}}},
           {"name lon lat t u\n\"A b\" 10 20 1 5\nC -30 40 2.5 NaN\nD 50 -60 NaN 7\n",
            {.fields = {{"t", "u"}}}}}) {
    CAPTURE(text);
    const FieldGrid found = read(text, choice);
    CHECK(found.positions->coordinates == known.positions->coordinates);
    REQUIRE(found.fields.size() == 2);
    CHECK(same_bits(found.fields[0].values, known.fields[0].values));
    CHECK(same_bits(found.fields[1].values, known.fields[1].values));
  }
  CHECK(read("1 2 3 4\n5 6 7 8\n3 3 3 3\n").fields[1].name == "column4");
  const FieldGrid plane = read("x,y,v\n1000,2000,5\n", {.plane = true});
  CHECK(!plane.positions->surface.is_sphere());
  CHECK(plane.positions->points.col(0) == Eigen::Vector3d(1000, 2000, 0));
}

TEST_CASE("positions: a long text is read in parts, and its faults have their lines") {
  Random random(8);
  std::string text = "lon,lat,a,b\n";
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i)
    text += std::to_string(random.real(-180, 180)) + "," + std::to_string(random.real(-90, 90)) +
            "," + std::to_string(i) + "," + (i % 2 == 0 ? "" : std::to_string(-i)) + "\n";
  const FieldGrid found = read(text);
  REQUIRE(found.size() == n);
  CHECK(same_bits(found.fields[0].values, DoubleVector::LinSpaced(n, 0, n - 1)));
  CHECK(std::isnan(found.fields[1].values[n - 2]));
  CHECK(found.fields[1].values[n - 1] == 1 - n);
  CHECK(refusal(text + "1,2,x,3\n").starts_with("obs.csv line 100002: \"x\" is not a number"));
}

TEST_CASE("positions: bad rows name their line and the remedy") {
  const std::string good = "lon,lat,t\n0,0,1\n";
  CHECK(refusal(good + "1,2\n") == "obs.csv line 3: 2 columns, and the header has 3; give each row "
                                   "the same columns, with NaN where there is no value");
  CHECK(refusal("0 0 1\n1 2 3 4\n") == "obs.csv line 2: 4 columns, and line 1 has 3; give each row "
                                       "the same columns, with NaN where there is no value");
  CHECK(refusal(good + "1,2,abc\n") ==
        "obs.csv line 3: \"abc\" is not a number, in the column t; write a number, or NaN where "
        "there is none, or choose columns of numbers (--fields)");
  CHECK(refusal(good + "1,95,3\n").starts_with("obs.csv line 3: latitude 95 is outside -90 to 90"));
  CHECK(refusal(good + "nan,5,3\n").starts_with("obs.csv line 3: NaN gives no direction; remove"));
  CHECK(refusal(good + "inf,5,3\n").starts_with("obs.csv line 3: an infinite number gives no"));
  CHECK(refusal(good + ",5,3\n") ==
        "obs.csv line 3: the column lon of the position is empty; write "
        "a number, or remove the row");
  CHECK(refusal(good + "a,5,3\n")
            .starts_with("obs.csv line 3: \"a\" is not a number, in the column "
                         "lon of the position; write a number"));
  CHECK(refusal(good + "1,2,inf\n").starts_with("obs.csv line 3: \"inf\" is not finite"));
  CHECK(refusal(good + "1,2,1e999\n").starts_with("obs.csv line 3: \"1e999\" is out of range"));
  CHECK(refusal("lon;lat;t\n0;0;1,5\n").find("write numbers with decimal points") !=
        std::string::npos);
  CHECK(refusal("") == "obs.csv: no rows of numbers in 0 lines; write longitude and latitude in "
                       "degrees and values on each line");
  CHECK(refusal("lon,lat,t\n").starts_with("obs.csv: no rows of numbers in 1 line;"));
  CHECK(refusal("lon,lat\n1,2\n").find("no columns of values besides the position") !=
        std::string::npos);
  CHECK(refusal("a,b,t\n1,2,3\n") == "obs.csv line 1: the header names a, b, t, and no longitude "
                                     "and latitude (lon, lat); name the columns of the position "
                                     "(--position)");
  CHECK(
      refusal("lon,lat,t,t\n1,2,3,4\n").starts_with("obs.csv line 1: two columns have the name t"));
  CHECK(refusal(good, {.fields = {{"u"}}}) ==
        "obs.csv line 1: no column u; the header names lon, lat, t");
  CHECK(refusal("1 2 3\n", {.fields = {{"4"}}}) ==
        "obs.csv: no column 4; without a header columns have the numbers 1 to 3");
  CHECK(refusal(good, {.position = {"lon"}}).starts_with("the position has 1 columns; name two"));
  CHECK(refusal(good, {.position = {"lon", "1"}}).find("the same column twice") !=
        std::string::npos);
  CHECK(refusal("1 10.5 50 2\n2 11 51 3\n3 12 49 4\n").find("the first column counts the lines") !=
        std::string::npos);
  CHECK(refusal("1\n2\n").find("1 column only") != std::string::npos);
  CHECK(read("# lon and lat here\n20 9 40 3\n30 1 2 3\n").fields[0].name == "column3");
  CHECK(refusal("lon;lat;v\n10,5;20,5;3\n").find("decimal points") != std::string::npos);
  CHECK(
      refusal("lon,lat,v,v\n1,2,3,4\n", {.fields = {{"v"}}}).find("two columns have the name v") !=
      std::string::npos);
}

TEST_CASE("positions: text and NetCDF of fields read back") {
  const Scratch scratch;
  FieldGrid grid = read("lon,lat,v,w x\n10.3,20.1,0.1,\n-30,40,2.5,4\n50,-60,-7,1e-30\n");
  for (const std::string name : {"out.csv", "out.txt"}) {
    const std::string path = scratch.folder / name;
    write_fields(path, grid, grid.fields);
    const FieldGrid found = read_positions(path);
    CHECK(found.positions->coordinates == grid.positions->coordinates);
    CHECK(found.fields[1].name == "w_x");
    for (std::size_t k = 0; k < 2; ++k)
      CHECK(same_bits(found.fields[k].values, grid.fields[k].values));
  }
  write_fields(scratch.folder / "out.nc", grid, grid.fields);
  CHECK(refusal_of([&] {
          write_fields(scratch.folder / "out.vtp", grid, grid.fields);
        }).find("ends in .csv, .txt or .nc") != std::string::npos);
  MeshField times = grid.fields[0];
  times.dimensions = {{"time", 2}};
  times.values = DoubleVector::Zero(6);
  CHECK(refusal_of([&] {
          write_fields(scratch.folder / "times.csv", grid, {times});
        }).find("several numbers for each position") != std::string::npos);
  CHECK(!std::filesystem::exists(scratch.folder / "times.csv"));
  for (const std::string name : {"w,x", "lat", "", "v"}) {
    grid.fields[0].name = name;
    grid.fields[1].name = name == "v" ? "v" : "w x";
    CHECK(refusal_of([&] {
            write_fields(scratch.folder / "names.csv", grid, grid.fields);
          }).find("and there is one, or that is no name; rename it") != std::string::npos);
  }
  CHECK(!std::filesystem::exists(scratch.folder / "names.csv"));
}

TEST_CASE("scattered: cells that a mask leaves out are missing, and infinite values refused") {
  Random random(11);
  FieldGrid source = positions(random_places(200, false, random));
  source.fields = {field("v", random_values(200, random))};
  FieldGrid target = positions(random_places(50, false, random));
  const DoubleVector whole = interpolate_scattered(source, target, nearest).fields[0].values;
  target.mask = Ids::Ones(50);
  target.mask[7] = 0;
  const DoubleVector masked = interpolate_scattered(source, target, nearest).fields[0].values;
  for (Eigen::Index i = 0; i < 50; ++i)
    CHECK((i == 7 ? std::isnan(masked[i]) : masked[i] == whole[i]));
  source.fields[0].values[3] = std::numeric_limits<double>::infinity();
  CHECK(refusal_of([&] { interpolate_scattered(source, target, nearest); }) ==
        "value 3 of v is infinite; give a number, or NaN for none");
}
