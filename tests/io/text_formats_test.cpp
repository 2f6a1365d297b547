// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

using calotte::Error;
using calotte::ErrorCode;
using calotte::Mesh;
using calotte::Points3;
using calotte::Surface;
using calotte::oracle::Triple;
using nlohmann::json;
using namespace calotte::test;

namespace {

std::string all_replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// A canonical mesh of which one edge is flipped, so that it is not Delaunay but closed.
Mesh flipped_lattice() {
  const Mesh mesh = calotte::delaunay(calotte::lat_lon_sphere(4, 6));
  std::vector<Triple> triangles;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    triangles.push_back({mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)});
  // The quadrangle of four cocircular sites of two rows.
  const auto row = [](std::int32_t site) { return site / 6; };
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t u = mesh.neighbours(i, t), a = mesh.triangles(i, t),
                         b = mesh.triangles((i + 1) % 3, t), c = mesh.triangles((i + 2) % 3, t);
      int j = 0;
      while (mesh.neighbours(j, u) != t)
        ++j;
      const std::int32_t d = mesh.triangles(j, u);
      if (row(a) != row(d) && row(b) != row(c) && (row(a) == row(b) || row(a) == row(c))) {
        triangles[std::size_t(t)] = {a, b, d};
        triangles[std::size_t(u)] = {a, d, c};
        return calotte::oracle::mesh_of(mesh.points, triangles);
      }
    }
  FAIL("no quadrangle");
  return mesh;
}

} // namespace

// ---- JIGSAW

TEST_CASE("JIGSAW: meshes come back bit for bit") {
  const Scratch scratch;
  for (const auto& [name, mesh] : all_meshes()) {
    CAPTURE(name);
    calotte::write(scratch / "mesh.msh", mesh);
    check_equal(calotte::read_mesh(scratch / "mesh.msh"), mesh);
    CHECK(equal_bits(calotte::read_sites(scratch / "mesh.msh"), mesh.points));
  }
  const Mesh flipped = flipped_lattice();
  calotte::write(scratch / "mesh.msh", flipped);
  check_equal(calotte::read_mesh(scratch / "mesh.msh"), flipped);
}

TEST_CASE("JIGSAW: the file is what its readers expect") {
  const Scratch scratch;
  calotte::write(scratch / "mesh.msh", calotte::delaunay(octahedron()));
  const std::string text = calotte::test::read_file(scratch / "mesh.msh");
  CHECK(has(text, "\nMSHID=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT=6\n1;0;0;0\n"));
  CHECK(has(text, "\nTRIA3=8\n0;1;2;0\n"));
}

TEST_CASE("JIGSAW: keywords in any case, comments, line ends and other sections change nothing") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.msh";
  const Mesh mesh = calotte::delaunay(octahedron());
  calotte::write(path, mesh);
  const std::string text = calotte::test::read_file(path);
  const auto reads_as = [&](const std::string& changed) {
    write_text(path, changed);
    check_equal(calotte::read_mesh(path), mesh);
  };
  reads_as(all_replaced(text, "\n", "\r\n"));
  reads_as(all_replaced(text, "\n", " # so\n\n"));
  reads_as(text.substr(0, text.size() - 1));
  reads_as(all_replaced(all_replaced(text, "EUCLIDEAN-MESH", "euclidean-mesh"), "POINT", "point"));
  reads_as(
      all_replaced(text, "TRIA3", "EDGE2=2\n0;1;0\n1;2;0\nWEIGHT=6;1\n0\n0\n0\n0\n0\n0\nTRIA3"));
  reads_as(text + "VALUE=6;1\n1\n2\n3\n4\n5\n6\n");
  reads_as(text.substr(0, text.find("TRIA3"))); // points alone are triangulated
}

TEST_CASE("JIGSAW: longitudes and latitudes in radians") {
  const Scratch scratch;
  const Points3 points = calotte::random_sphere(40, 5);
  std::ostringstream text;
  text.precision(17);
  text << "mshid=3;ellipsoid-mesh\nRADII=6371;6371;6371\nNDIMS=2\nPOINT=40\n";
  for (int i = 0; i < 40; ++i)
    text << std::atan2(points(1, i), points(0, i)) << ';' << std::asin(points(2, i)) << ";0\n";
  write_text(scratch / "mesh.msh", text.str());
  const Points3 read = calotte::read_sites(scratch / "mesh.msh");
  REQUIRE(read.cols() == 40);
  CHECK((read / 6371 - points).colwise().norm().maxCoeff() < 1e-14);
  write_text(scratch / "mesh.msh", "MSHID=3;ELLIPSOID-MESH\nNDIMS=2\nPOINT=1\n0;2;0\n");
  CHECK(code_of([&] { calotte::read_sites(scratch / "mesh.msh"); }) == ErrorCode::parse);
}

TEST_CASE(
    "JIGSAW: a file cut short is refused, or gives the points' mesh where only these are left") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.msh";
  for (const Mesh& mesh : {calotte::delaunay(octahedron()), open_meshes()[1].mesh}) {
    calotte::write(path, mesh);
    const int done = done_when_cut(path, [&] { check_equal(calotte::read_mesh(path), mesh); });
    CHECK(done > 0);
    CHECK(done < 7); // before POWER, EDGE2 and TRIA3
  }
}

TEST_CASE("JIGSAW: errors name the defect") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.msh", head = "MSHID=3;EUCLIDEAN-MESH\nNDIMS=3\n",
                    points = "POINT=3\n1;0;0;0\n0;1;0;0\n0;0;1;0\n";
  const auto error = [&](const std::string& text) {
    write_text(path, text);
    return error_of([&] { calotte::read_mesh(path); });
  };
  CHECK(error("").code() == ErrorCode::parse);
  CHECK(error(head).code() == ErrorCode::parse);
  CHECK(error("NDIMS=3\n" + points).code() == ErrorCode::parse);
  CHECK(error(head + points + "TRIA3=1\n0;1;3;0\n").code() == ErrorCode::parse);
  CHECK(error(head + points + "TRIA3=1\n0;1;-1;0\n").index() == 8);
  CHECK(error(head + points + "TRIA3=1\n0;1;3000000000;0\n").index() == 8);
  CHECK(error(head + points + "TRIA3=2\n0;1;2;0\n").code() == ErrorCode::parse);
  CHECK(error(head + points + "TRIA3=1\n0;1;2\n").index() == 8);
  CHECK(error(head + points + "TRIA3=x\n").index() == 7);
  CHECK(error(head + "POINT=4\n1;0;0;0\n0;1;x;0\n").index() == 5);
  CHECK(error(head + "POINT=99999999999\n1;0;0;0\n").code() == ErrorCode::parse);
  CHECK(error(head + all_replaced(points, "1;0;0;0", "0;0;0;0")).index() == 0);
  CHECK(error("MSHID=3;ELLIPSOID-GRID\nNDIMS=2\nCOORD=1;2\n0\n1\n").code() == ErrorCode::parse);
  CHECK(has(error(head + "POINT=2\n1;0;0;0\n0;1;0;0\n").what(), "at least 3"));
}

// ---- MPI-SCVT

TEST_CASE("MPI-SCVT: meshes come back bit for bit, and the density stands beside them") {
  const Scratch scratch;
  const calotte::Density density = calotte::tanh_bump({1, 0, 0.5}, 0.5, 0.2, 0.01);
  for (const char* name : {"SaveVertices", "SaveVertices.150", "SaveVertices_7.txt"}) {
    const std::string path = scratch / name;
    for (const auto& [kind, mesh] : all_meshes()) {
      CAPTURE(kind);
      calotte::write(path, mesh, {.density = density});
      check_equal(calotte::read_mesh(path), mesh);
      CHECK(equal_bits(calotte::read_sites(path), mesh.points));
      CHECK(equal_bits(calotte::read_points(path), mesh.points));
      std::istringstream lines(
          calotte::test::read_file(all_replaced(path, "SaveVertices", "SaveDensity")));
      Points3 units = mesh.points;
      for (Eigen::Index i = 0; i < units.cols(); ++i)
        units.col(i).stableNormalize();
      const Eigen::VectorXd expected = calotte::evaluate(density, units);
      double value = 0;
      for (Eigen::Index i = 0; i < expected.size(); ++i) {
        REQUIRE(bool(lines >> value));
        REQUIRE(value == doctest::Approx(expected[i]).epsilon(1e-13));
      }
      CHECK_FALSE(bool(lines >> value));
      CHECK((calotte::read_mesh_file(path).density - expected).norm() < 1e-13 * expected.norm());
      const std::string densities = all_replaced(path, "SaveVertices", "SaveDensity");
      write_text(densities, calotte::test::read_file(densities) + "1\n");
      CHECK(calotte::read_mesh_file(path).density.size() == 0);
      CHECK(calotte::read_mesh_file(path).ignored == std::vector<std::string>{"SaveDensity"});
    }
  }
  CHECK(scratch.files() == 9);
}

TEST_CASE("MPI-SCVT: triangles are taken where they close the sphere, in either turning") {
  const Scratch scratch;
  const std::string path = scratch / "SaveVertices", triangles = scratch / "SaveTriangles";
  const Mesh mesh = flipped_lattice(), delaunay = calotte::delaunay(mesh.points);
  CHECK_FALSE(equal_bits(mesh.triangles, delaunay.triangles));
  calotte::write(path, mesh);
  check_equal(calotte::read_mesh(path), mesh);

  // MPI-SCVT sorts each triangle's ids.
  std::ostringstream sorted;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    Triple ids{mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
    std::sort(ids.begin(), ids.end());
    sorted << ids[0] << ' ' << ids[1] << ' ' << ids[2]
           << (t + 1 < mesh.triangles.cols() ? "\n" : "");
  }
  write_text(triangles, sorted.str());
  const Mesh read = calotte::read_mesh(path);
  CHECK(equal_bits(read.triangles, mesh.triangles));

  const std::string whole = calotte::test::read_file(triangles);
  for (const std::string& other :
       {std::string(), std::string("0 1\n"), std::string("0 1 99\n"), whole + "0 1 2\n",
        whole.substr(0, whole.rfind('\n')), whole.substr(0, whole.rfind('\n')) + "\n0 0 1\n",
        all_replaced(whole, "\n5 ", "\n6 ")}) {
    write_text(triangles, other);
    check_equal(calotte::read_mesh(path), delaunay);
  }
  std::filesystem::remove(triangles);
  check_equal(calotte::read_mesh(path), delaunay);
}

TEST_CASE("MPI-SCVT: triangles cut short are not taken") {
  const Scratch scratch;
  const std::string path = scratch / "SaveVertices";
  const Mesh mesh = flipped_lattice(), delaunay = calotte::delaunay(mesh.points);
  calotte::write(path, mesh);
  done_when_cut(scratch / "SaveTriangles",
                [&] { check_equal(calotte::read_mesh(path), delaunay); });
}

TEST_CASE("MPI-SCVT: a missing final newline and CRLF lose nothing; what is no point is named") {
  const Scratch scratch;
  const std::string path = scratch / "SaveVertices";
  write_text(path, "1 0 0\n0 1 0\n0 0 1\n-1 -1 -1");
  CHECK(calotte::read_mesh(path).points.cols() == 4);
  write_text(path, "1 0 0\r\n0 1 0\r\n0 0 1\r\n-1 -1 -1");
  CHECK(calotte::read_mesh(path).triangles.cols() == 4);
  write_text(path, "1 0 0\n0 1 0\n0 0 1\n-1 -1");
  CHECK(error_of([&] { calotte::read_mesh(path); }).index() == 4);
  write_text(path, "1 0 0\n0 1 0\n");
  const Error few = error_of([&] { calotte::read_mesh(path); });
  CHECK(few.code() == ErrorCode::too_few_sites);
  CHECK(std::string(few.what()).starts_with(path));
  CHECK(code_of([&] { calotte::read_mesh(scratch / "SaveVertices.absent"); }) == ErrorCode::file);
}

TEST_CASE("MPI-SCVT: a file that cannot be written leaves none of the three") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  std::filesystem::create_directory(scratch / "SaveTriangles");
  CHECK(code_of([&] { calotte::write(scratch / "SaveVertices", mesh); }) == ErrorCode::file);
  CHECK(scratch.files() == 1);
}

// ---- GeoJSON

namespace {

using Ring = std::vector<std::pair<double, double>>;

std::vector<Ring> rings_of(const json& geometry) {
  const bool several = geometry["type"] == "MultiPolygon";
  CHECK((several || geometry["type"] == "Polygon"));
  std::vector<Ring> rings;
  for (const json& polygon : several ? geometry["coordinates"] : json{geometry["coordinates"]}) {
    REQUIRE(polygon.size() == 1);
    Ring ring;
    for (const json& position : polygon[0])
      ring.emplace_back(position.at(0).get<double>(), position.at(1).get<double>());
    rings.push_back(ring);
  }
  CHECK(rings.size() == (several ? 2 : 1));
  return rings;
}

double area_of(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    twice += ring[i - 1].first * ring[i].second - ring[i].first * ring[i - 1].second;
  return twice / 2;
}

bool is_inside(const Ring& ring, double x, double y) {
  bool inside = false;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const auto [ax, ay] = ring[i - 1];
    const auto [bx, by] = ring[i];
    if ((ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax))
      inside = !inside;
  }
  return inside;
}

json geojson_of(const Scratch& scratch, const Mesh& mesh,
                const calotte::WriteOptions& options = {}) {
  calotte::write(scratch / "cells.geojson", mesh, options);
  return json::parse(calotte::test::read_file(scratch / "cells.geojson"));
}

} // namespace

TEST_CASE("GeoJSON: sites come back bit for bit, and with them the mesh") {
  const Scratch scratch;
  for (const auto& [name, mesh] : closed_meshes()) {
    CAPTURE(name);
    calotte::write(scratch / "cells.geojson", mesh);
    check_equal(calotte::read_mesh(scratch / "cells.geojson"), mesh);
    CHECK(equal_bits(calotte::read_sites(scratch / "cells.geojson"), mesh.points));
  }
}

TEST_CASE("GeoJSON: closed counter-clockwise rings that tile the plane of longitude and latitude") {
  const Scratch scratch;
  for (const auto& [name, mesh] : closed_meshes()) {
    CAPTURE(name);
    double sum = 0;
    const json file = geojson_of(scratch, mesh);
    CHECK(file["type"] == "FeatureCollection");
    REQUIRE(file["features"].size() == std::size_t(mesh.points.cols()));
    for (const json& feature : file["features"]) {
      CHECK(feature["type"] == "Feature");
      for (const Ring& ring : rings_of(feature["geometry"])) {
        CAPTURE(feature.dump());
        REQUIRE(ring.size() >= 4);
        CHECK(ring.front() == ring.back());
        for (std::size_t i = 0; i < ring.size(); ++i) {
          CHECK(std::abs(ring[i].first) <= 180);
          CHECK(std::abs(ring[i].second) <= 90);
          if (i > 0 && std::abs(ring[i].second) < 90)
            CHECK(std::abs(ring[i].first - ring[i - 1].first) <= 180);
        }
        if (mesh.points.cols() > 4) // arcs of hemispheres are far from straight lines
          CHECK(area_of(ring) > 0);
        sum += area_of(ring);
      }
    }
    CHECK(sum == doctest::Approx(360 * 180).epsilon(1e-9));
  }
}

TEST_CASE("GeoJSON: a cell is around its site") {
  const Scratch scratch;
  // Sites that are far from their cells' edges, which are arcs there and straight lines here.
  const Mesh mesh = calotte::delaunay(calotte::fibonacci_sphere(800));
  const json features = geojson_of(scratch, mesh)["features"];
  const double degrees = 180 / std::numbers::pi;
  int cut = 0, poles = 0;
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    const Eigen::Vector3d p = mesh.points.col(i);
    const std::vector<Ring> rings = rings_of(features[std::size_t(i)]["geometry"]);
    cut += rings.size() > 1;
    poles += std::any_of(rings[0].begin(), rings[0].end(),
                         [](const auto& position) { return std::abs(position.second) == 90; });
    if (const double latitude = std::asin(p.z()) * degrees; std::abs(latitude) < 80)
      CHECK(std::count_if(rings.begin(), rings.end(), [&](const Ring& ring) {
              return is_inside(ring, std::atan2(p.y(), p.x()) * degrees, latitude);
            }) == 1);
  }
  CHECK(cut > 10);
  CHECK(poles == 2);
}

TEST_CASE("GeoJSON: the properties are the cell's fields") {
  const Scratch scratch;
  const calotte::Density density = calotte::tanh_bump({1, 0, 0.5}, 0.5, 0.2, 0.01);
  const Mesh mesh = calotte::delaunay(calotte::random_sphere(90, 8));
  const json file = geojson_of(scratch, mesh, {.density = density});
  const calotte::CellFields fields = calotte::cell_fields(calotte::voronoi(mesh), density);
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    const json& properties = file["features"][std::size_t(i)]["properties"];
    CHECK(properties["id"] == i);
    CHECK(properties["x"].get<double>() == mesh.points(0, i));
    CHECK(properties["area"].get<double>() == fields.area[i]);
    CHECK(properties["density"].get<double>() == fields.density[i]);
    CHECK(properties["spacing"].get<double>() == fields.spacing[i]);
    CHECK(properties["quality"].get<double>() == fields.quality[i]);
    CHECK(properties["degree"] == fields.degree[i]);
  }
}

TEST_CASE("GeoJSON: points are sites; members in any order") {
  const Scratch scratch;
  write_text(scratch / "points.geojson",
             R"({"features": [
                 {"geometry": {"coordinates": [0, 90], "type": "Point"}, "type": "Feature"},
                 {"type": "Feature", "geometry": {"type": "Point", "coordinates": [270, 0, 12]},
                  "properties": null},
                 {"type": "Feature", "geometry": null, "properties": {"z": 0, "y": 1, "x": -0.0}}],
                 "crs": {"properties": {"x": 1, "type": "Feature", "y": 2, "z": 3}}, "none": [{}],
                 "type": "FeatureCollection"})");
  const Points3 sites = calotte::read_sites(scratch / "points.geojson");
  CHECK(sites == (Points3(3, 3) << 0, 0, 0, 0, -1, 1, 1, 0, 0).finished());
  CHECK(std::signbit(sites(0, 2)));
}

TEST_CASE("GeoJSON: a file cut short is refused") {
  const Scratch scratch;
  calotte::write(scratch / "cells.geojson",
                 calotte::delaunay(columns({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}})));
  CHECK(done_when_cut(scratch / "cells.geojson",
                      [&] { calotte::read_mesh(scratch / "cells.geojson"); }) == 0);
}

TEST_CASE("GeoJSON: errors name the defect") {
  const Scratch scratch;
  const std::string path = scratch / "cells.geojson";
  const auto error = [&](const std::string& text) {
    write_text(path, text);
    return error_of([&] { calotte::read_mesh(path); });
  };
  const auto collection = [](const std::string& features) {
    return R"({"type":"FeatureCollection","features":[)" + features + "]}";
  };
  const std::string good = R"({"type":"Feature","properties":{"x":1,"y":0,"z":0}})";
  for (const std::string& text :
       {std::string(""), std::string("[]"), std::string("3"), std::string("\"text\""), good,
        std::string(R"({"type":"FeatureCollection"})"), collection(""),
        std::string(R"({"type":7,"features":[]})"), collection("[]"), collection("3"),
        std::string(20'000, '['), std::string("{\"a\":1e999}"), std::string("\xff\xfe")}) {
    CAPTURE(text);
    CHECK(error(text).code() == ErrorCode::parse);
  }
  for (
      const std::string bad :
      {R"({"type":"Feature","properties":{"x":1,"y":0}})",
       R"({"type":"Feature","properties":{"x":1,"y":0,"z":null}})",
       R"({"type":"Feature","properties":{"x":1,"y":0,"z":"0"}})", R"({"type":"Feature"})",
       R"({"type":"Feature","properties":[1,2,3],"geometry":[]})",
       R"({"type":"Feature","geometry":{"type":"Point","coordinates":[1]}})",
       R"({"type":"Feature","geometry":{"type":"Point","coordinates":[1,91]}})",
       R"({"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}})"}) {
    CAPTURE(bad);
    CHECK(error(collection(good + "," + good + "," + bad)).index() == 2);
  }
  CHECK(error(collection(good)).code() == ErrorCode::too_few_sites);
  CHECK(error(collection(R"({"type":"Feature","properties":{"x":0,"y":0,"z":0}})")).index() == 0);
}

// ---- The plane

namespace {

/// Five sites in general position, one of them at the origin.
Mesh planar_mesh() {
  calotte::Points2 points(2, 5);
  points << 0, 3, 2, -1, 1, 0, 0.1, 2.5, 2, 1.25;
  return calotte::delaunay(points, calotte::Surface::plane());
}

void check_same_plane(const Mesh& a, const Mesh& b) {
  CHECK(equal_bits(a.points, b.points));
  CHECK(equal_bits(a.triangles, b.triangles));
  CHECK(equal_bits(a.neighbours, b.neighbours));
}

bool names(const Error& error, const std::string& words) {
  const std::string text = error.what();
  CAPTURE(text);
  const bool found = text.find(words) != std::string::npos;
  CHECK(found);
  return found;
}

} // namespace

TEST_CASE("a planar mesh comes back bit for bit from all that writes one") {
  const Scratch scratch;
  const Mesh mesh = planar_mesh();
  for (const std::string name : {"a.vtp", "a.vtu", "a.off", "a.ply", "a.msh"}) {
    CAPTURE(name);
    calotte::write(scratch / name, mesh);
    check_same_plane(calotte::read_mesh(scratch / name), mesh);
    const Error error = error_of([&] { calotte::read_sites(scratch / name); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    names(error, "holds a mesh of the plane, not of the sphere; read it with read_mesh()");
  }
  calotte::write(scratch / "a.tri", mesh);
  check_same_plane(calotte::read_mesh(scratch / "a.tri", &mesh.points), mesh);
  names(error_of([&] { calotte::read_mesh(scratch / "a.tri"); }), "give the points they refer to");
  // Triangles refer to the columns that were triangulated: one that is there twice is one site.
  calotte::Points3 twice(3, 6);
  twice << mesh.points, mesh.points.col(2);
  const Mesh merged = calotte::read_mesh(scratch / "a.tri", &twice);
  check_same_plane(merged, mesh);
  CHECK(merged.site_of_input == std::vector<std::int32_t>{0, 1, 2, 3, 4, 2});
}

TEST_CASE("a file of the sphere, or of no place, is no planar mesh") {
  const Scratch scratch;
  calotte::write(scratch / "s.off", calotte::delaunay(octahedron()));
  CHECK(calotte::read_mesh(scratch / "s.off").surface.is_sphere());
  calotte::write(scratch / "s.geojson", calotte::delaunay(octahedron()));
  CHECK(calotte::read_mesh(scratch / "s.geojson").surface.is_sphere());
  calotte::write(scratch / "s.nc", calotte::delaunay(octahedron()));
  CHECK(calotte::read_mesh(scratch / "s.nc").surface.is_sphere());
  write_text(scratch / "x.off", "OFF\n3 1 0\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n");
  names(error_of([&] { calotte::read_mesh(scratch / "x.off"); }), "point 1 has no place");
  write_text(scratch / "flat.msh",
             "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=3\n0;0;0\n1;0;0\n0;1;0\n");
  CHECK(calotte::read_mesh(scratch / "flat.msh").triangles.cols() == 1);
}

TEST_CASE("domains: text and GeoJSON say the same rings") {
  const Scratch scratch;
  const auto text = [&](const std::string& words) {
    write_text(scratch / "d.txt", words);
    return calotte::read_domain(scratch / "d.txt");
  };
  const Surface plain = text("x y\n0 0\n4 0\n4 3 # a corner\n# no end of the ring\n0 3\n0 0\n"
                             "\n\n1 1\n2 1\n1,2\n");
  REQUIRE(plain.rings().size() == 2);
  CHECK(plain.rings()[0].cols() == 4);
  CHECK(plain.rings()[1].cols() == 3);
  CHECK(plain.area() == 11.5);
  const auto same = [&](const Surface& other) {
    REQUIRE(other.rings().size() == 2);
    CHECK(equal_bits(other.rings()[0], plain.rings()[0]));
    CHECK(equal_bits(other.rings()[1], plain.rings()[1]));
  };
  same(text("> outer\r\n0\t0\r\n4\t0\r\n4 3\r\n0 3\r\n >\r\n1 1\r\n2 1\r\n1 2\r\n1 1"));
  const std::string outer = "[[0,0],[4,0],[4,3],[0,3],[0,0]]",
                    hole = "[[1,1,9],[2,1],[1,2],[1,1,7]]";
  const std::string polygon = R"({"type":"Polygon","coordinates":[)" + outer + "," + hole + "]}";
  const std::string feature = R"({"type":"Feature","properties":null,"geometry":)";
  for (const std::string& geojson :
       {polygon, feature + polygon + "}",
        R"({"type":"MultiPolygon","coordinates":[[)" + outer + "],[" + hole + "]]}",
        R"({"type":"FeatureCollection","features":[)" + feature + "null}," + feature + polygon +
            "}]}",
        R"({"type":"GeometryCollection","geometries":[)" + polygon + "]}"}) {
    CAPTURE(geojson);
    write_text(scratch / "d.JSON", geojson);
    same(calotte::read_domain(scratch / "d.JSON"));
  }
}

TEST_CASE("domains: errors name the defect, in one line") {
  const Scratch scratch;
  const auto refused = [&](const std::string& file, const std::string& words) {
    write_text(scratch / file, words);
    return error_of([&] { calotte::read_domain(scratch / file); });
  };
  names(error_of([&] { calotte::read_domain(scratch / "absent.txt"); }), "absent.txt");
  names(refused("d.txt", ""), "no corners");
  names(refused("d.txt", "\n\n# nothing\n>\n"), "no corners");
  CHECK(refused("d.txt", "0 0\n1 0\nfar away\n").index() == 3);
  names(refused("d.txt", "0 0\n1\n0 1\n"), "line 2: 1 column only");
  names(refused("d.txt", "0 0\n1 0\n1e999 1\n"), "line 3");
  names(refused("d.txt", "0 0\n1 0\nnan 1\n"), "ring 0, corner 2 is not finite");
  names(refused("d.txt", "0 0\n4 0\n4 4\n\n1 1\n2 1\n1 1\n"), "ring 1 has 2 corners");
  names(refused("d.txt", "0 0\n4 0\n4 4\n\n1 1\n2 1\n2 1\n"), "(ring 1 begins in line 5)");
  names(refused("d.txt", "0 0\n4 4\n4 0\n0 4\n"), "meet"); // a bow tie
  names(refused("d.txt", "0 0\n4 0\n4 4\n\n3 1\n9 1\n9 2\n"), "meet");
  const auto collection = [](const std::string& rings) {
    return R"({"type":"FeatureCollection","features":[{"type":"Feature","geometry":)"
           R"({"type":"Polygon","coordinates":)" +
           rings + "}}]}";
  };
  for (const std::string& geojson :
       {std::string(), std::string("[]"), std::string("7"), std::string("{}"),
        std::string(R"({"type":"Polygon"})"), std::string(R"({"type":"Po\nint"})"),
        std::string(R"({"type":"Polygon","coordinates":{}})"), std::string(20'000, '['),
        std::string(R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1e999,1]]]})"),
        collection("[]"), collection("[[]]"), collection("[[[0,0],[1,0]]]"), collection("[7]"),
        collection("[[[0,0],[1,0],7]]"), collection(R"([[[0,0],[1,0],["1",1]]])")}) {
    CAPTURE(geojson);
    CHECK(refused("d.json", geojson).code() == ErrorCode::parse);
  }
  names(refused("d.json", collection("[[[0,0],[1,0],[1,1]],[[0,0],[1],[2,0]]]")),
        "feature 0: position 1 of ring 1 is not a position [x, y]");
  names(refused("d.json", collection("[[[0,0],[1,0],[1,1]],[[0.5,0.1],[0.5,0.1],[2,0]]]")),
        "(ring 1 is in the file: feature 0: ring 1)");
}

TEST_CASE("domains: a file cut short gives a smaller domain, or is refused") {
  const Scratch scratch;
  write_text(scratch / "d.txt", "0 0\n40 0\n40 30\n0 30\n\n10 10\n20 10\n10 20\n");
  CHECK(done_when_cut(scratch / "d.txt", [&] { calotte::read_domain(scratch / "d.txt"); }) > 0);
  write_text(scratch / "d.json", R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,3],[0,3]]]})");
  CHECK(done_when_cut(scratch / "d.json", [&] { calotte::read_domain(scratch / "d.json"); }) == 0);
}
