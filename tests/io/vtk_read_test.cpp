// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "io/read_text.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/polyhedra.h"
#include "support/text.h"
#include "support/vtk_text.h"

#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

using calotte::ErrorCode;
using calotte::FieldLocation;
using calotte::Mesh;
using calotte::MeshFile;
using calotte::Points3;
using namespace calotte::test;

namespace {

std::string path_of(const Scratch& scratch, const std::string& type) {
  return scratch / (type == "PolyData" ? "mesh.vtp" : "mesh.vtu");
}

const std::vector<std::string> both_types{"PolyData", "UnstructuredGrid"};

} // namespace

TEST_CASE("VTK: a mesh comes back bit for bit from each way to store it") {
  const Scratch scratch;
  for (const NamedMesh& mesh : {closed_meshes()[0], closed_meshes()[4], open_meshes()[0]})
    for (const std::string& type : both_types)
      for (const Style& style : styles()) {
        CAPTURE(mesh.name);
        CAPTURE(describe(style));
        write_text(path_of(scratch, type), vtk_text(type, faces_of(mesh.mesh), style));
        Mesh expected = mesh.mesh;
        check_equal(calotte::read_mesh(path_of(scratch, type)), expected);
      }
}

TEST_CASE("VTK: every type of points and ids is read") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  const Points3 rounded = mesh.points.cast<float>().cast<double>();
  for (const std::string& type : both_types)
    for (const Data data : {Data::ascii, Data::raw})
      for (const std::string ids : {"Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64"})
        for (const std::string points : {"Float32", "Float64"}) {
          CAPTURE(ids);
          Faces faces = faces_of(mesh);
          if (points == "Float32")
            faces.points = rounded;
          const MeshFile file =
              read_text(path_of(scratch, type),
                        vtk_text(type, faces, {.data = data, .points = points, .ids = ids}));
          CHECK(equal_bits(file.mesh->points, faces.points));
          CHECK(equal_bits(file.mesh->triangles, mesh.triangles));
        }
}

TEST_CASE("VTK: polygons are cells, with unit corners, and centres if there are any") {
  const Scratch scratch;
  const Faces faces = prism();
  Points3 centres(3, 7);
  centres.col(0) << 0, 0, 1;
  centres.col(6) << 0, 0, -1;
  for (int k = 1; k < 6; ++k)
    centres.col(k) = (faces.points.col(k - 1) + faces.points.col(5 + k % 5)) / 2;
  for (const std::string& type : both_types)
    for (const Data data : {Data::ascii, Data::binary, Data::raw})
      for (const std::string name : {"", "site", "Center"}) {
        const MeshFile file = read_text(
            path_of(scratch, type), vtk_text(type, faces, {.data = data}, {}, [&](VtkText& text) {
              if (!name.empty())
                text.array("Float64", name, values_of(centres), 3);
            }));
        REQUIRE(file.polygons);
        CHECK(file.polygons->size() == 7);
        CHECK((file.polygons->corners - faces.points.colwise().normalized()).norm() < 1e-15);
        CHECK(values_of(file.polygons->ids.items) == faces.ids);
        CHECK(file.polygons->centres.cols() == (name.empty() ? 0 : 7));
        if (!name.empty())
          CHECK((file.polygons->centres - centres.colwise().normalized()).norm() < 1e-15);
        CHECK(!file.mesh); // they are not Voronoi cells
      }
  CHECK(code_of([&] { calotte::read_mesh(scratch / "mesh.vtp"); }) == ErrorCode::invalid_argument);
  write_text(scratch / "mesh.vtp", vtk_text("PolyData", faces, {}));
  CHECK(has(message_of([&] { calotte::read_sites(scratch / "mesh.vtp"); }), "no centres"));
}

TEST_CASE("VTK: arrays of one component are fields at the cells or at the vertices") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  const auto count = [](double from, Eigen::Index n) {
    Values values;
    for (Eigen::Index i = 0; i < n; ++i)
      values.push_back(from + double(i));
    return values;
  };
  for (const std::string& type : both_types)
    for (const Style& style : styles()) {
      const auto arrays = [&](VtkText& text, double from, Eigen::Index n) {
        text.array("Float64", from == 1 ? "height" : "flux", count(from, n));
        text.array("UInt8", from == 1 ? "mask" : "flag", Values(std::size_t(n), 1));
        text.array("Float32", "density", count(2, n));
        text.array("Float64", "area", count(0, n));
        text.array("Float64", "velocity", count(0, 3 * n), 3);
        text.line("<Array type=\"String\" Name=\"label\" format=\"ascii\"> 65 0 </Array>");
      };
      CAPTURE(describe(style));
      const MeshFile file =
          read_text(path_of(scratch, type),
                    vtk_text(
                        type, faces_of(mesh), style,
                        [&](VtkText& text) { arrays(text, 1, mesh.points.cols()); },
                        [&](VtkText& text) { arrays(text, 5, mesh.triangles.cols()); }));
      CHECK(values_of(file.density) == count(2, mesh.points.cols()));
      std::string names;
      for (const calotte::MeshField& field : file.fields)
        names += field.name + (field.location == FieldLocation::cells ? "@cells " : "@vertices ");
      CHECK(names == "height@cells mask@cells flux@vertices flag@vertices area@vertices ");
      CHECK(values_of(file.fields[0].values) == count(1, mesh.points.cols()));
      CHECK(values_of(file.fields[2].values) == count(5, mesh.triangles.cols()));
      CHECK(file.ignored == std::vector<std::string>{"made by", "velocity", "label", "velocity",
                                                     "label", "density"});
    }
  const MeshFile cells = read_text(
      scratch / "cells.vtu", vtk_text(
                                 "UnstructuredGrid", prism(), {},
                                 [&](VtkText& text) { text.array("Int32", "p", count(3, 10)); },
                                 [&](VtkText& text) { text.array("Int32", "c", count(4, 7)); }));
  REQUIRE(cells.fields.size() == 2);
  CHECK(cells.fields[0].location == FieldLocation::vertices);
  CHECK(cells.fields[1].location == FieldLocation::cells);
}

TEST_CASE("VTK: cells that calotte writes come back with density and fields") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  const Eigen::VectorXd cells = Eigen::VectorXd::LinSpaced(mesh.points.cols(), 1, 2),
                        vertices = Eigen::VectorXd::LinSpaced(mesh.triangles.cols(), 3, 4);
  for (const char* name : {"a.vtp", "a.vtu"})
    for (const calotte::Format format :
         {calotte::format_of(name),
          name[4] == 'p' ? calotte::Format::vtp_cells : calotte::Format::vtu_cells}) {
      calotte::WriteOptions options;
      options.format = format;
      options.site_density = cells;
      options.fields = {{.name = "c", .location = FieldLocation::cells, .values = cells},
                        {.name = "v", .location = FieldLocation::vertices, .values = vertices}};
      calotte::write(scratch / name, mesh, options);
      const MeshFile file = calotte::read_mesh_file(scratch / name);
      check_equal(*file.mesh, mesh);
      CHECK(!file.polygons);
      CHECK(file.ignored.empty());
      CHECK(equal_bits(file.density, Eigen::VectorXd(cells / 2)));
      REQUIRE(file.fields.size() == 2);
      for (const calotte::MeshField& field : file.fields)
        CHECK(equal_bits(field.values, field.name == "c" ? cells : vertices));
    }
}

TEST_CASE(
    "VTK: cells that are Voronoi cells become a mesh, with values of corners at its triangles") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  const calotte::Voronoi cells = calotte::voronoi(mesh);
  Faces faces{cells.vertices.rowwise().reverse(), {}, {}}; // the corners in another order
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    Values corners;
    for (const std::int32_t vertex : cells.vertices_on_cell[i])
      corners.push_back(double(cells.vertices.cols() - 1 - vertex));
    faces.add(corners);
  }
  const Eigen::VectorXd z = faces.points.row(2);
  for (const std::string points : {"Float64", "Float32"}) {
    const MeshFile file = read_text(
        scratch / "mesh.vtp",
        vtk_text(
            "PolyData", faces, {.points = points},
            [&](VtkText& text) { text.array("Float64", "z", values_of(z)); },
            [&](VtkText& text) { text.array("Float64", "site", values_of(mesh.points), 3); }));
    CAPTURE(file.not_voronoi.text());
    REQUIRE(!file.polygons);
    check_equal(*file.mesh, mesh);
    CHECK((file.fields.at(0).values - cells.vertices.row(2).transpose()).norm() < 1e-13);
  }
  CHECK(calotte::read_mesh(scratch / "mesh.vtp").surface.is_sphere());
}

TEST_CASE("VTK: points alone are triangulated; empty pieces, vertices and lines are passed over") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  check_equal(
      *read_text(scratch / "mesh.vtp", vtk_text("PolyData", {mesh.points, {}, {}}, {})).mesh, mesh);
  const std::string text =
      vtk_text("PolyData", faces_of(mesh), {.data = Data::ascii}, {}, [&](VtkText& file) {
        file.array("Float64", "c", Values(std::size_t(mesh.triangles.cols()) + 2, 7));
      });
  const MeshFile file = read_text(
      scratch / "mesh.vtp",
      replaced(replaced(text, "NumberOfVerts=\"0\"", "NumberOfVerts=\"1\" NumberOfLines=\"1\""),
               "<Piece", "<Piece NumberOfPoints=\"0\" NumberOfPolys=\"0\"/><Piece"));
  check_equal(*file.mesh, mesh);
  CHECK(file.fields.at(0).values.size() == mesh.triangles.cols());
}

TEST_CASE("VTK: what is not read is refused by name") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  const std::string grid = vtk_text("UnstructuredGrid", faces_of(mesh), {.data = Data::ascii}),
                    poly = vtk_text("PolyData", faces_of(mesh), {.data = Data::ascii}),
                    zip = vtk_text("PolyData", faces_of(mesh), {.compressed = true}),
                    raw = vtk_text("PolyData", faces_of(mesh), {});
  const std::string types = "5  5  5  5  5  5  5\n5";
  const std::vector<std::array<std::string, 2>> cases{
      {replaced(grid, types, "5 5 12 10 5 5 5 5"), "cell 2 has the type 12 (hexahedron)"},
      {replaced(grid, types, "5 5 5 5 5 5 5 9"), "cell 7 has the type 9 but 3 corners"},
      {replaced(poly, "NumberOfVerts", "NumberOfStrips=\"2\" NumberOfVerts"), "2 triangle strips"},
      {replaced(poly, "</Piece>", "</Piece><Piece NumberOfPoints=\"1\"></Piece>"), "2 pieces"},
      {replaced(zip, "ZLib", "LZ4"), "compressed by \"vtkLZ4DataCompressor\""},
      {replaced(poly, "LittleEndian", "Middle"), "\"Middle\""},
      {replaced(raw, "UInt64", "UInt16"), "header_type \"UInt16\""},
      {replaced(poly, "type=\"PolyData\"", "type=\"ImageData\""), "of type \"ImageData\""},
      {replaced(poly, "VTKFile", "Collada"), "not well-formed"},
      {replaced(raw, "\"raw\"", "\"hex\""), "encoding \"hex\""},
      {replaced(poly, "<VTK", "<!DOCTYPE a [<!ENTITY b \"c\">]><VTK"), "document type"},
      {replaced(poly, "\"3\" format=\"ascii\"", "\"3\" format=\"zip\""),
       "\"Points\": its format \"zip\""},
      {replaced(poly, "Float64", "String"), "\"Points\": its type \"String\""},
      {replaced(poly, "Components=\"3\"", "Components=\"2\""), "\"Points\": its NumberOfComp"},
      {replaced(poly, "\"connectivity\"", "\"connect\""), "\"connectivity\": it is not among"},
      {replaced(poly, "<Polys>", "<Poly>"), "not well-formed at line"},
      {"1 2 3", "it does not start with XML"}};
  for (const auto& [text, part] : cases) {
    CAPTURE(part);
    CHECK(has(problem_of(scratch / "mesh.vtp", text), part));
  }
}

TEST_CASE("VTK: ids, offsets and sizes that contradict each other are refused by array") {
  const Scratch scratch;
  const Faces whole = faces_of(calotte::delaunay(octahedron()));
  for (const Style& style : styles()) {
    for (const auto& [spoil, part] :
         std::vector<std::pair<std::function<void(Faces&)>, std::string>>{
             {[](Faces& f) { f.ids[7] = 6; }, "\"connectivity\": polygon 2 has a corner"},
             {[](Faces& f) { f.ids[7] = -1; }, "\"connectivity\": polygon 2 has a corner"},
             {[](Faces& f) { f.ids[7] = 1e12; }, "\"connectivity\": polygon 2 has a corner"},
             {[](Faces& f) { f.ids.pop_back(); }, "\"offsets\": polygon 7 ends at 24"},
             {[](Faces& f) { f.ids.push_back(0); }, "\"connectivity\": it has 25 corners"},
             {[](Faces& f) { f.ends[3] = 1; }, "\"offsets\": polygon 3 runs from 9 to 1"},
             {[](Faces& f) { f.ends[3] = -3; }, "\"offsets\": polygon 3 runs from 9 to "},
             {[](Faces& f) { f.ends[3] = 4e18; }, "\"offsets\": polygon 3 ends at 4"}}) {
      Faces faces = whole;
      spoil(faces);
      CAPTURE(part);
      CHECK(has(problem_of(scratch / "mesh.vtp", vtk_text("PolyData", faces, style)), part));
    }
    const std::string text = vtk_text("PolyData", whole, style);
    for (const char* count : {"NumberOfPoints=\"6\"", "NumberOfPolys=\"8\""})
      for (const char* other : {"0", "5", "9", "-1", "x", "2147483647", "99999999999"})
        problem_of(scratch / "mesh.vtp",
                   replaced(text, count, std::string(count, 15) + "\"" + other + "\""));
  }
}

TEST_CASE("VTK: cells that another program changed are not taken for Voronoi cells") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  calotte::write(scratch / "a.vtp", mesh, {.format = calotte::Format::vtp_cells});
  std::string text = calotte::test::read_file(scratch / "a.vtp");
  std::swap(text[text.find("\n_") + 2 + 8], text[text.find("\n_") + 2 + 8 + 1200]);
  CHECK(has(problem_of(scratch / "a.vtp", text), "array \"triangle\": "));
}

TEST_CASE("VTK: a file that is cut anywhere, or whose bytes change, is read or refused") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  std::mt19937 random(1);
  for (const Style& style : styles()) {
    CAPTURE(describe(style));
    const std::string path = scratch / "mesh.vtu",
                      text = vtk_text("UnstructuredGrid", faces_of(mesh), style);
    write_text(path, text);
    CHECK(done_when_cut(path, [&] { calotte::read_mesh(path); }) == 0);
    for (int k = 0; k < 100; ++k) {
      std::string other = text;
      for (int changes = 0; changes < 3; ++changes)
        other[random() % other.size()] = static_cast<char>(random());
      write_text(path, other);
      try {
        calotte::read_mesh_file(path);
      } catch (const calotte::Error& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
      }
    }
  }
}
