// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "io/read_text.h"
#include "io/vtk_types.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/polyhedra.h"
#include "support/text.h"

#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <array>
#include <random>
#include <string>
#include <vector>

using calotte::ErrorCode;
using calotte::FieldLocation;
using calotte::Format;
using calotte::Mesh;
using calotte::MeshFile;
using namespace calotte::test;

namespace {

/// How a legacy file is written.
struct LegacyStyle {
  bool binary = false, grid = false;
  bool offsets = false; ///< as of version 5.1
  std::string points = "double", ids = "vtktypeint64";
};

std::string numbers(const LegacyStyle& style, const std::string& type, const Values& values) {
  return (style.binary ? bytes_of(vtk_types.at(type), values, true) : text_of(values)) + "\n";
}

std::string cells(const LegacyStyle& style, const std::string& section, const Faces& faces) {
  if (!style.offsets)
    return section + " " + std::to_string(faces.ends.size()) + " " +
           std::to_string(faces.lists().size()) + "\n" + numbers(style, "int", faces.lists());
  Values offsets{0};
  offsets.insert(offsets.end(), faces.ends.begin(), faces.ends.end());
  return section + " " + std::to_string(offsets.size()) + " " + std::to_string(faces.ids.size()) +
         "\nOFFSETS " + style.ids + "\n" + numbers(style, style.ids, offsets) + "CONNECTIVITY " +
         style.ids + "\n" + numbers(style, style.ids, faces.ids);
}

/// \param extra other cells, before the polygons. \param data what follows the cells.
std::string legacy_text(const Faces& faces, const LegacyStyle& style, const std::string& extra = "",
                        const std::string& data = "") {
  const std::string count = std::to_string(faces.ends.size());
  return "# vtk DataFile Version " + std::string(style.offsets ? "5.1" : "3.0") +
         "\na title: DATASET\n" + (style.binary ? "BINARY" : "ASCII") + "\nDATASET " +
         (style.grid ? "UNSTRUCTURED_GRID" : "POLYDATA") + "\nPOINTS " +
         std::to_string(faces.points.cols()) + " " + style.points + "\n" +
         numbers(style, style.points, values_of(faces.points)) +
         "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 1 1\n\n" +
         extra + cells(style, style.grid ? "CELLS" : "POLYGONS", faces) +
         (style.grid ? "\nCELL_TYPES " + count + "\n" + numbers(style, "int", faces.types()) : "") +
         data;
}

std::vector<LegacyStyle> legacy_styles() {
  std::vector<LegacyStyle> all;
  for (const bool binary : {false, true})
    for (const bool grid : {false, true}) {
      all.push_back({.binary = binary, .grid = grid});
      all.push_back({.binary = binary, .grid = grid, .offsets = true});
      all.push_back({.binary = binary, .grid = grid, .offsets = true, .ids = "int"});
    }
  return all;
}

Values counted(double from, std::size_t count) {
  Values values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(from + double(i));
  return values;
}

/// Attributes of every kind. \param n points or cells.
std::string attributes(const LegacyStyle& style, double from, std::size_t n) {
  const std::string count = std::to_string(n), strings = style.binary ? "\xc2hi" : "h%20i\n";
  std::string text =
      "SCALARS first" + std::to_string(int(from)) + " float\nLOOKUP_TABLE default\n" +
      numbers(style, "float", counted(from, n)) + "SCALARS pair double 2\n" +
      "LOOKUP_TABLE colours\n" + numbers(style, "double", counted(0, 2 * n)) +
      "LOOKUP_TABLE colours 2\n" + numbers(style, "unsigned_char", Values(8, 1)) +
      "VECTORS wind double\n" + numbers(style, "double", counted(0, 3 * n)) + "NORMALS up float\n" +
      numbers(style, "float", counted(0, 3 * n)) + "TENSORS stress float\n" +
      numbers(style, "float", counted(0, 9 * n)) + "COLOR_SCALARS rgb 3\n" +
      numbers(style, "unsigned_char", Values(3 * n, 1)) + "TEXTURE_COORDINATES tex 2 float\n" +
      numbers(style, "float", counted(0, 2 * n)) + "FIELD FieldData 4\nnext%20" +
      std::to_string(int(from)) + " 1 " + count + " vtkIdType\n" +
      numbers(style, "vtkIdType", counted(from + 1, n)) +
      "METADATA\nCOMPONENT_NAMES\nX\n\ndensity 1 " + count + " double\n" +
      numbers(style, "double", counted(from + 2, n)) + "label 1 " + count + " string\n";
  for (std::size_t i = 0; i < n; ++i)
    text += strings;
  return text + "\narea 1 " + count + " unsigned_short\n" +
         numbers(style, "unsigned_short", counted(1, n));
}

} // namespace

TEST_CASE("legacy VTK: a mesh comes back bit for bit from every version and encoding") {
  const Scratch scratch;
  for (const NamedMesh& mesh : {closed_meshes()[0], closed_meshes()[4], open_meshes()[0]})
    for (const LegacyStyle& style : legacy_styles()) {
      CAPTURE(mesh.name);
      write_text(scratch / "mesh.vtk", legacy_text(faces_of(mesh.mesh), style));
      check_equal(calotte::read_mesh(scratch / "mesh.vtk"), mesh.mesh);
      CHECK(equal_bits(calotte::read_sites(scratch / "mesh.vtk"), mesh.mesh.points));
    }
}

TEST_CASE("legacy VTK: polygons are cells; single precision; points alone") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  for (LegacyStyle style : legacy_styles()) {
    const MeshFile file = read_text(scratch / "mesh.vtk", legacy_text(prism(), style));
    REQUIRE(file.polygons);
    CHECK(values_of(file.polygons->ids.items) == prism().ids);
    style.points = "float";
    Faces faces = faces_of(mesh);
    faces.points = faces.points.cast<float>().cast<double>();
    CHECK(equal_bits(read_text(scratch / "mesh.vtk", legacy_text(faces, style)).mesh->points,
                     faces.points));
    if (!style.offsets) {
      const std::string text = legacy_text({mesh.points, {}, {}}, {.binary = style.binary});
      check_equal(*read_text(scratch / "mesh.vtk", text).mesh, mesh);
      check_equal(*read_text(scratch / "mesh.vtk", text.substr(0, text.find("POLYGONS"))).mesh,
                  mesh);
    }
  }
}

TEST_CASE("legacy VTK: attributes of one component are fields, all others are passed over") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  const auto points = std::size_t(mesh.points.cols()),
             triangles = std::size_t(mesh.triangles.cols());
  for (const LegacyStyle& style : legacy_styles()) {
    CAPTURE(style.binary);
    const std::string field =
        "FIELD FieldData 1\nTIME 1 1 double\n" + numbers(style, "double", {5});
    const MeshFile file =
        read_text(scratch / "mesh.vtk", legacy_text(faces_of(mesh), style, field,
                                                    "POINT_DATA " + std::to_string(points) + "\n" +
                                                        attributes(style, 1, points) +
                                                        "CELL_DATA " + std::to_string(triangles) +
                                                        "\n" + attributes(style, 5, triangles)));
    check_equal(*file.mesh, mesh);
    std::string names;
    for (const calotte::MeshField& f : file.fields)
      names += f.name + (f.location == FieldLocation::cells ? "@cells " : "@vertices ");
    CHECK(names == "first1@cells next 1@cells first5@vertices next 5@vertices area@vertices ");
    CHECK(values_of(file.density) == counted(3, points));
    CHECK(values_of(file.fields[1].values) == counted(2, points));
    CHECK(values_of(file.fields[2].values) == counted(5, triangles));
    CHECK(file.ignored.front() == "TIME");
    CHECK(file.ignored.size() == 16);
  }
}

TEST_CASE("legacy VTK: data of vertices and lines, which come first, are left out") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  const auto triangles = std::size_t(mesh.triangles.cols());
  for (LegacyStyle style : legacy_styles()) {
    style.grid = false;
    const std::string others = cells(style, "VERTICES", {{}, {0, 1}, {1, 2}}) +
                               cells(style, "LINES", {{}, {0, 1, 2}, {3}});
    const MeshFile file =
        read_text(scratch / "mesh.vtk",
                  legacy_text(faces_of(mesh), style, others,
                              "CELL_DATA " + std::to_string(triangles + 3) + "\nSCALARS c int\n" +
                                  numbers(style, "int", counted(0, triangles + 3))));
    check_equal(*file.mesh, mesh);
    CHECK(values_of(file.fields.at(0).values) == counted(3, triangles));
  }
}

TEST_CASE("legacy VTK: files are not written, and say so") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  const auto problem = [&](const std::string& name, Format format) {
    return refusal_of([&] { calotte::write(scratch / name, mesh, {.format = format}); });
  };
  for (const char* name : {"mesh.vtk", "mesh.VTK", "mesh.data"})
    CHECK(problem(name, Format::vtk)
              .ends_with(": legacy VTK files are read, but not written; write .vtp, .vtu or .nc"));
  CHECK(has(problem("mesh.vtk", Format::by_name), "not written"));
  CHECK(scratch.files() == 0);
}

TEST_CASE("legacy VTK: a mesh of the plane") {
  const Scratch scratch;
  Faces square{calotte::Points3(3, 4), {}, {}};
  square.points << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  square.add({0, 1, 2});
  square.add({0, 2, 3});
  for (const LegacyStyle& style : legacy_styles()) {
    write_text(scratch / "mesh.vtk", legacy_text(square, style));
    CHECK(calotte::read_mesh(scratch / "mesh.vtk").triangles.cols() == 2);
  }
  Faces quad = square;
  quad.ids = {0, 1, 2, 3};
  quad.ends = {4};
  write_text(scratch / "mesh.vtk", legacy_text(quad, {}));
  CHECK(has(message_of([&] { calotte::read_mesh_file(scratch / "mesh.vtk"); }),
            "of a plane only triangles, and cells with an array site"));
}

TEST_CASE("legacy VTK: what is not read, or contradicts itself, is refused by name") {
  const Scratch scratch;
  const Faces faces = faces_of(calotte::delaunay(octahedron()));
  const std::string poly = legacy_text(faces, {}), grid = legacy_text(faces, {.grid = true}),
                    fifth = legacy_text(faces, {.offsets = true}),
                    scalars =
                        legacy_text(faces, {}, "", "POINT_DATA 6\nSCALARS a int\n1 2 3 4 5 6\n");
  const std::vector<std::array<std::string, 2>> cases{
      {"#" + poly, "does not start with"},
      {replaced(poly, "ASCII", "HEX"), "third line is \"HEX\""},
      {replaced(poly, "POLYDATA", "STRUCTURED_GRID"), "it holds \"STRUCTURED_GRID\""},
      {replaced(poly, "POLYGONS", "TRIANGLE_STRIPS"), "8 triangle strips"},
      {replaced(poly, "POLYGONS", "CELLS"), "\"CELLS\" is not a keyword of POLYDATA"},
      {replaced(poly, "POINTS 6", "POINTS 7"), "\"POINTS\": "},
      {replaced(poly, "POINTS 6", "POINTS 5"), "is not a keyword"},
      {replaced(poly, "POINTS 6", "POINTS -6"), "\"-6\" is not the number of points"},
      {replaced(poly, "POINTS 6", "POINTS 2147483647"), "the file ends before its 6442450941"},
      {replaced(poly, "double", "quad"), "\"quad\" is not a type"},
      {replaced(poly, "double", "string"), "\"POINTS\": its type is string"},
      {replaced(poly, "POLYGONS 8", "POLYGONS 2147483647"), "cannot hold 2147483647 cells"},
      {replaced(poly, "POLYGONS 8 32", "POLYGONS 8 2147483647"), "\"POLYGONS\": the file ends"},
      {replaced(poly, "POLYGONS 8 32", "POLYGONS 9 32"), "\"POLYGONS\": cell 7 runs beyond"},
      {replaced(poly, "POLYGONS 8 32", "POLYGONS 7 32"), "but the 7 polygons have 21"},
      {replaced(grid, "CELL_TYPES 8", "CELL_TYPES 7"), "\"5\" is not a keyword"},
      {replaced(grid, "5  5  5  5", "5 5 5 1"), "\"CELL_TYPES\": cell 3 has the type 1 (vertex)"},
      {replaced(fifth, "POLYGONS 9", "POLYGONS 8"), "\"POLYGONS\": "},
      {replaced(fifth, "CONNECTIVITY", "CONNECTED"), "no CONNECTIVITY follows"},
      {replaced(scalars, "POINT_DATA 6", "POINT_DATA 5"), "\"6\" is not a keyword"},
      {replaced(scalars, "POINT_DATA 6\n", ""), "POINT_DATA or CELL_DATA is missing"},
      {replaced(scalars, "POINT_DATA", "CELL_DATA"), "\"a\": it has 6 values for 8 cells"},
      {replaced(scalars, "3 4 5", "3 x 5"), "\"a\": \"x\" at place 3 of 6 is not a number"},
      {legacy_text(faces, {.binary = true}, "FIELD f 1\na 2147483647 2147483647 double\n"),
       "\"a\": the file ends before its data"},
      {legacy_text(faces, {.binary = true}, "FIELD f 1\na 1 9 string\n"), "parse"}};
  for (const auto& [text, part] : cases) {
    CAPTURE(part);
    const std::string problem = problem_of(scratch / "mesh.vtk", text);
    CAPTURE(problem);
    CHECK((part == "parse" || problem.find(part) != std::string::npos));
  }
  for (const LegacyStyle& style : legacy_styles())
    for (const double bad : {6., -1., 2147483647.}) {
      Faces other = faces;
      other.ids[16] = bad;
      write_text(scratch / "mesh.vtk", legacy_text(other, style));
      CHECK(error_of([&] { calotte::read_mesh_file(scratch / "mesh.vtk"); }).index() == 5);
    }
}

TEST_CASE("legacy VTK: a file that is cut anywhere, or whose bytes change, is read or refused") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  std::mt19937 random(3);
  for (const LegacyStyle& style : legacy_styles()) {
    const std::string path = scratch / "mesh.vtk",
                      text = legacy_text(faces_of(mesh), style, "",
                                         "POINT_DATA 6\n" + attributes(style, 1, 6));
    write_text(path, text);
    done_when_cut(path, [&] { calotte::read_mesh(path); });
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
