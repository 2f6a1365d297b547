// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "io/command.h"
#include "io/geojson_text.h"
#include "io/read_text.h"
#include "support/constants.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>

#include <Eigen/Geometry>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

using calotte::ErrorCode;
using calotte::MeshFile;
using calotte::Points3;
using calotte::Polygons;
using calotte::PolygonShapes;
using calotte::Surface;
using namespace calotte::test;

namespace {

/// All values after one another.
template <class... Values> std::string concatenated(const Values&... values) {
  std::ostringstream text;
  text.precision(9);
  (text << ... << values);
  return text.str();
}

std::string cell(const std::string& ring, const std::string& properties = "{}",
                 const std::string& type = "Polygon") {
  return feature(R"({"type":")" + type + R"(","coordinates":)" + ring + "}", properties);
}

/// The eighths of the sphere, as boxes of longitude and latitude; those of the south clockwise.
std::vector<std::string> eighths() {
  std::vector<std::string> features;
  for (const std::string north : {"90", "-90"})
    for (int k = 0; k < 4; ++k) {
      const int west = 90 * k - 180, east = west + 90;
      const std::string ring = concatenated("[[[", west, ",0],[", east, ",0],[", east, ",", north,
                                            "],[", west, ",", north, "],[", west, ",0]]]");
      const std::string depth = k == 2 ? "null" : concatenated(k, ".5");
      const std::string properties =
          concatenated(R"({"name":"k","height":)", k, R"(,"depth":)", depth, "}");
      features.push_back(cell(ring, properties));
    }
  return features;
}

/// Without the path.
std::string problem_with_features(const std::string& path,
                                  const std::vector<std::string>& features) {
  return problem_of(path, collection(features)).substr(path.size() + 2);
}

/// A regular polygon around the direction of a vector.
Polygons regular(const Eigen::Vector3d& around, int corners, double radius) {
  const Eigen::Vector3d p = around.normalized(),
                        u = p.cross(Eigen::Vector3d(0.3, 0.4, 0.5)).normalized(), v = p.cross(u);
  Polygons polygon;
  polygon.corners.resize(3, corners);
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * k / corners;
    polygon.corners.col(k) =
        std::cos(radius) * p + std::sin(radius) * (std::cos(angle) * u + std::sin(angle) * v);
  }
  polygon.ids = {calotte::Offsets{{0, corners}}, calotte::Ids::LinSpaced(corners, 0, corners - 1)};
  polygon.centres = p;
  return polygon;
}

/// The integral of the position over a triangle, by ever smaller parts.
Eigen::Vector3d moment(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                       int depth) {
  if (depth == 0) {
    const double area = 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
    return area * (a + b + c).normalized();
  }
  const Eigen::Vector3d ab = (a + b).normalized(), bc = (b + c).normalized(),
                        ca = (c + a).normalized();
  return moment(a, ab, ca, depth - 1) + moment(ab, b, bc, depth - 1) +
         moment(ca, bc, c, depth - 1) + moment(ab, bc, ca, depth - 1);
}

} // namespace

TEST_CASE("GeoJSON: polygons are cells of either orientation, their numbers fields") {
  const Scratch scratch;
  write_text(scratch / "cells.geojson", collection(eighths()));
  const MeshFile file = calotte::read_mesh_file(scratch / "cells.geojson");
  REQUIRE(file.polygons);
  CHECK(!file.mesh);
  CHECK(file.not_voronoi.fault == calotte::CellFault::no_centres);
  CHECK(file.changes == std::vector<std::string>{"turned 4 clockwise cells"});
  CHECK(file.polygons->corners.cols() == 6);
  for (const double area : calotte::areas(*file.polygons))
    CHECK(area == doctest::Approx(pi / 2));
  REQUIRE(file.fields.size() == 2);
  CHECK(file.fields[0].name == "depth");
  CHECK(file.fields[0].values[3] == 3.5);
  CHECK(std::isnan(file.fields[0].values[2]));
  CHECK(file.fields[1].name == "height");
  CHECK(file.fields[1].integer);
  CHECK(file.fields[1].values[7] == 3);
  CHECK(file.ignored == std::vector<std::string>{"name"});
  calotte::write(scratch / "scrip.nc", file, {.format = calotte::Format::scrip});
  const calotte::Points3 centroids = calotte::read_sites(scratch / "scrip.nc"); // of octants
  CHECK(centroids.cols() == 8);
  CHECK((centroids.cwiseAbs().array() - 1 / std::sqrt(3)).abs().maxCoeff() < 1e-12);
  calotte::write(scratch / "cells.nc", file, {.format = calotte::Format::esmf});
  const MeshFile back = calotte::read_mesh_file(scratch / "cells.nc");
  CHECK((calotte::areas(*back.polygons) - calotte::areas(*file.polygons)).norm() < 1e-13);
  CHECK(back.fields.size() == 2);
}

TEST_CASE("GeoJSON: a ring around a pole, from any of its places on") {
  const Scratch scratch;
  const std::vector<std::string> positions{"[-180,80]", "[-60,80]", "[60,80]",
                                           "[180,80]",  "[180,90]", "[-180,90]"};
  for (std::size_t first = 0; first < positions.size(); ++first) {
    std::string ring = "[[";
    for (std::size_t k = 0; k <= positions.size(); ++k)
      ring += (k > 0 ? "," : "") + positions[(first + k) % positions.size()];
    CAPTURE(ring);
    write_text(scratch / "cap.geojson", collection({cell(ring + "]]")}));
    const MeshFile file = calotte::read_mesh_file(scratch / "cap.geojson");
    REQUIRE(file.polygons);
    CHECK(file.polygons->ids.items.size() == 3);
    CHECK(file.polygons->corners.row(2).minCoeff() == doctest::Approx(std::sin(80 * pi / 180)));
    CHECK(calotte::areas(*file.polygons)[0] > 0);
  }
}

TEST_CASE("GeoJSON: cells with a place are compared with the Voronoi cells of their places") {
  const Scratch scratch;
  const calotte::Mesh mesh = calotte::delaunay(
      columns({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}));
  // The faces of a cube, of which two are cut by the meridian of 180 degrees, in whole rings.
  const double latitude = 180 / pi * std::asin(1 / std::sqrt(3.0));
  const auto at = [&](int east, int side) {
    return concatenated("[", east, ",", side * latitude, "]");
  };
  std::vector<std::string> faces;
  for (int k = 0; k < 4; ++k) {
    const int west = 90 * k - 45, east = west + 90;
    const std::string ring = concatenated("[[", at(west, -1), ",", at(east, -1), ",", at(east, 1),
                                          ",", at(west, 1), ",", at(west, -1), "]]");
    faces.push_back(cell(ring, concatenated(R"({"x":)", mesh.points(0, k), R"(,"y":)",
                                            mesh.points(1, k), R"(,"z":0,"density":2})")));
  }
  for (const int side : {1, -1})
    faces.push_back(cell(concatenated("[[", at(45, side), ",", at(135, side), ",", at(225, side),
                                      ",", at(315, side), ",", at(45, side), "]]"),
                         concatenated(R"({"x":0,"y":0,"z":)", side, R"(,"density":2})")));
  write_text(scratch / "cube.geojson", collection(faces));
  const MeshFile cube = calotte::read_mesh_file(scratch / "cube.geojson");
  REQUIRE(cube.mesh);
  CHECK(!cube.polygons); // six digits of a degree are enough
  CHECK(cube.density == Eigen::VectorXd::Constant(6, 2));
  faces[0] =
      cell(concatenated("[[", at(-45, -1), ",", at(45, -1), ",", at(45, 1), ",", at(-45, 1), "]]"),
           R"({"x":1,"y":0.1,"z":0,"density":2})");
  write_text(scratch / "cube.geojson", collection(faces));
  CHECK(calotte::read_mesh_file(scratch / "cube.geojson").polygons);
}

TEST_CASE("GeoJSON: Voronoi cells that calotte writes come back with density and fields") {
  const Scratch scratch;
  const calotte::Mesh mesh = calotte::delaunay(calotte::random_sphere(60, 2));
  calotte::WriteOptions options;
  options.site_density = 1 + mesh.points.row(0).transpose().array();
  options.fields = {{.name = "height", .values = mesh.points.row(1).transpose()}};
  calotte::write(scratch / "cells.geojson", mesh, options);
  const MeshFile file = calotte::read_mesh_file(scratch / "cells.geojson");
  CHECK(equal_bits(file.mesh->points, mesh.points));
  CHECK(file.density == options.site_density / options.site_density.maxCoeff());
  REQUIRE(file.fields.size() == 1);
  CHECK(file.fields[0].values == options.fields[0].values);
}

TEST_CASE("GeoJSON: what is no cell of one ring is refused by its feature") {
  const Scratch scratch;
  const std::string path = scratch / "cells.geojson", ring = "[[0,0],[9,0],[9,9],[0,0]]";
  const std::string good = cell("[" + ring + "]");
  const std::string apart = "[[20,0],[29,0],[29,9],[20,0]]";
  const auto refused = [&](const std::vector<std::string>& features, const std::string& words) {
    CHECK(has(problem_with_features(path, features), words));
  };
  refused({good, cell("[[" + apart + "],[" + ring + "]]", "{}", "MultiPolygon")},
          "feature 1 is a MultiPolygon whose parts do not share one side; only cells of one ring "
          "are read");
  refused({cell("[" + ring + "," + ring + "]")}, "feature 0 has a hole; only cells of one ring");
  refused({good, good, cell("[[[0,0],[9,0],[0,0]]]")},
          "feature 2 has a ring of fewer than 3 places");
  refused({cell("[[[0,0],[9,91],[9,9],[0,0]]]")},
          "feature 0 has a position that is no longitude and");
  refused({cell("[]")}, "feature 0 has no ring of positions; give GeoJSON as RFC 7946 has it");
  refused({good, cell("[0,0]", "{}", "Point")}, "feature 1 is no polygon, unlike those before it");
  refused({cell("[0,0]", "{}", "Point"), good}, "feature 1 is a cell, unlike those before it");
  refused({cell("[[0,0],[9,9]]", "{}", "LineString")},
          "feature 0 is neither a polygon nor a point");
  refused({good, good}, "cell 0 and cell 1 overlap");
}

TEST_CASE("shapes: convex cells, and how far centres are from centroids") {
  for (const double radius : {0.3, 1e-4}) {
    CAPTURE(radius);
    Polygons hexagon = regular({1, -2, 3}, 6, radius);
    const double width = std::sqrt(calotte::areas(hexagon)[0]);
    CHECK(calotte::shapes(hexagon).not_convex == 0);
    CHECK(calotte::shapes(hexagon).not_centroidal == 0);
    CHECK(calotte::shapes(hexagon).off_centring < 1e-6);
    const Eigen::Vector3d aside = hexagon.centres.col(0).cross(hexagon.corners.col(1)).normalized();
    hexagon.centres.col(0) = (hexagon.centres.col(0) + 0.01 * width * aside).normalized();
    const PolygonShapes shifted = calotte::shapes(hexagon);
    CHECK(shifted.not_centroidal == 1);
    CHECK(shifted.off_centring == doctest::Approx(0.01).epsilon(1e-4));
    CHECK(shifted.worst_centred == 0);
    hexagon.corners.col(2) = regular({1, -2, 3}, 6, 0.3 * radius).corners.col(2); // a notch
    CHECK(calotte::shapes(hexagon).not_convex == 1);
    CHECK(calotte::shapes(hexagon).first_not_convex == 0);
  }
  Polygons triangle = regular({0, 1, 1}, 3, 0.5);
  triangle.corners.col(0) = Eigen::Vector3d(0.5, 0.1, 0.9).normalized();
  if (calotte::areas(triangle)[0] < 0)
    std::swap(triangle.ids[0][1], triangle.ids[0][2]);
  const auto ids = triangle.ids[0];
  triangle.centres = moment(triangle.corners.col(ids[0]), triangle.corners.col(ids[1]),
                            triangle.corners.col(ids[2]), 7)
                         .normalized();
  CHECK(calotte::shapes(triangle).off_centring < 1e-5);
  triangle.centres.resize(3, 0);
  CHECK(calotte::shapes(triangle).worst_centred == -1);
  CHECK(calotte::shapes(Polygons{}).not_convex == 0);
}

TEST_CASE("shapes in a plane: the corners of an L, its notch and its centroid") {
  Polygons cell;
  cell.surface = Surface::plane();
  cell.corners.resize(3, 6);
  cell.corners << 0, 2, 2, 1, 1, 0, 0, 0, 1, 1, 2, 2, 0, 0, 0, 0, 0, 0;
  cell.ids = {calotte::Offsets{{0, 6}}, calotte::Ids::LinSpaced(6, 0, 5)};
  cell.centres = Eigen::Vector3d(5. / 6, 5. / 6, 0); // of three unit squares
  CHECK(calotte::shapes(cell).not_convex == 1);
  CHECK(calotte::shapes(cell).off_centring < 1e-15);
  cell.centres(0, 0) += 0.1 * std::sqrt(3.0);
  CHECK(calotte::shapes(cell).off_centring == doctest::Approx(0.1));
}

TEST_CASE("lines: features, collections and single geometries") {
  const Scratch scratch;
  const std::string path = scratch / "a.geojson";
  const auto read = [&](const std::string& text) {
    calotte::write_file(path, text);
    return calotte::read_lines(path);
  };
  const std::string one = R"({"type":"LineString","coordinates":[[0,0],[90,0],[0,90]]})";
  const std::string two =
      R"({"type":"MultiLineString","coordinates":[[[180,0,7]],[[-90,0],[270,0]]]})";
  const auto feature = [](const std::string& geometry) {
    return R"({"type":"Feature","properties":{},"geometry":)" + geometry + "}";
  };
  const Points3 corner = Points3::Identity(3, 3);
  const std::vector<Points3> alone = read(one);
  REQUIRE(alone.size() == 1);
  CHECK((alone[0] - corner).cwiseAbs().maxCoeff() < 1e-15);

  const std::string both = one + "," + two;
  for (const std::string& text :
       {collection({feature(one), feature(two)}), collection({one, two}),
        collection({feature(R"({"type":"GeometryCollection","geometries":[)" + both + "]}")})}) {
    const std::vector<Points3> lines = read(text);
    REQUIRE(lines.size() == 3);
    CHECK((lines[0] - corner).cwiseAbs().maxCoeff() < 1e-15);
    CHECK((lines[1] - Eigen::Vector3d(-1, 0, 0)).norm() < 1e-15);
    REQUIRE(lines[2].cols() == 2);
    CHECK((lines[2].col(0) - lines[2].col(1)).norm() < 1e-15);
  }
}

TEST_CASE("shapes: lines and the shores of polygons, of one file or of two") {
  const Scratch scratch;
  const std::string path = scratch / "a.geojson";
  const auto read = [&](const std::string& text) {
    calotte::write_file(path, text);
    return calotte::read_shapes(path);
  };
  const std::string line = R"({"type":"LineString","coordinates":[[0,0],[90,0],[0,90]]})";
  const std::string polygon = R"({"type":"Polygon","coordinates":[[[5,5],[6,5],[5,6],[5,5]]]})";
  const std::vector<Points3> of_line = read(line);
  CHECK(of_line == calotte::read_lines(path));
  const std::vector<Points3> of_polygon = read(polygon);
  CHECK(of_polygon == calotte::shores(calotte::read_coast(path)));
  CHECK(read(collection({line, polygon})).size() == 4);
  const auto message = [&](const std::string& text) {
    return message_of([&] { read(text); }).substr(path.size() + 2);
  };
  CHECK(message(collection({})) == "no points, lines or polygons; give geometries of these");
  CHECK(message(collection({polygon, R"({"type":"Polygon","coordinates":[[[5,5],[6,5]]]})"})) ==
        "feature 1: ring 0 has fewer than 3 places; leave it out");
}

TEST_CASE("lines that are refused, by their feature") {
  const Scratch scratch;
  const std::string path = scratch / "a.geojson";
  const auto message = [&](const std::string& text) {
    calotte::write_file(path, text);
    const calotte::Error error = error_of([&] { calotte::read_lines(path); });
    CHECK(error.code() == ErrorCode::parse);
    return std::string(error.what()).substr(path.size() + 2);
  };
  const auto line = [](const std::string& positions) {
    return R"({"type":"Feature","geometry":{"type":"LineString","coordinates":)" + positions + "}}";
  };
  const std::string good = line("[[0,0],[1,1]]");
  CHECK(message(collection({})) == "no lines; give LineString or MultiLineString geometries");
  CHECK(message(collection({good, line("[]")})) ==
        "feature 1: a line without places; leave it out");
  CHECK(message(collection({good, line("[[0,0],[1,91]]")})) ==
        "feature 1: [1,91] is no position [longitude, latitude]; give degrees");
  CHECK(message(line("[[\"0\",0]]")) ==
        "[\"0\",0] is no position [longitude, latitude]; give degrees");
  CHECK(message(line("7")) == "no array \"coordinates\"; give GeoJSON as RFC 7946 has it");
  CHECK(message(R"({"type":"Point","coordinates":[0,0]})") ==
        "an object of the type \"Point\" is no line; give LineString or MultiLineString");
  CHECK(message("[]") == "no GeoJSON object; give features or a geometry");
}
