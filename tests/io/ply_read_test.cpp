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

#include <array>
#include <random>
#include <string>
#include <vector>

using calotte::ErrorCode;
using calotte::Mesh;
using calotte::MeshFile;
using namespace calotte::test;

namespace {

/// How a .ply file is written.
struct PlyStyle {
  std::string format = "ascii";
  std::string coordinate = "double", count = "uchar", id = "int";
  std::string corners = "vertex_indices";
  bool extra = false; ///< properties and elements besides those of a mesh, the faces first
};

std::string number_text(const PlyStyle& style, const std::string& type, double value) {
  return style.format == "ascii"
             ? text_of({value})
             : bytes_of(vtk_types.at(type), {value}, style.format == "binary_big_endian");
}

std::string vertices(const PlyStyle& style, const Faces& faces) {
  std::string text;
  for (const auto& point : faces.points.colwise()) {
    if (style.extra)
      text += number_text(style, "uchar", 200) + number_text(style, style.coordinate, point[2]) +
              number_text(style, "short", 2) + number_text(style, "float", 0.5) +
              number_text(style, "float", 1.5);
    for (int i = 0; i < (style.extra ? 2 : 3); ++i)
      text += number_text(style, style.coordinate, point[i]);
  }
  return text;
}

std::string face_rows(const PlyStyle& style, const Faces& faces) {
  std::string text;
  std::size_t k = 0;
  for (const double end : faces.ends) {
    if (style.extra)
      text += number_text(style, "double", 0.25);
    text += number_text(style, style.count, end - double(k));
    for (; double(k) < end; ++k)
      text += number_text(style, style.id, faces.ids[k]);
    if (style.extra)
      text += number_text(style, "int", 0) + number_text(style, "uchar", 7);
  }
  return text;
}

std::string ply_text(const Faces& faces, const PlyStyle& style) {
  const std::string type = "property " + style.coordinate + " ";
  const std::string vertex =
      "element vertex " + std::to_string(faces.points.cols()) + "\n" +
      (style.extra ? "property uchar red\n" + type + "z\nproperty list short float texture\n"
                   : "") +
      type + "x\n" + type + "y\n" + (style.extra ? "" : type + "z\n");
  const std::string face =
      "element face " + std::to_string(faces.ends.size()) + "\n" +
      (style.extra ? "property double weight\n" : "") + "property list " + style.count + " " +
      style.id + " " + style.corners + "\n" +
      (style.extra ? "property list int uchar empty\nproperty uchar flag\n" : "");
  const std::string edge = "element edge 2\nproperty int vertex1\nproperty float length\n";
  const std::string head = "ply\nformat " + style.format + " 1.0\ncomment made by a test\n";
  if (!style.extra)
    return head + vertex + face + "end_header\n" + vertices(style, faces) + face_rows(style, faces);
  return head + "obj_info a b\n" + face + edge + vertex + "element none 5\nend_header\n" +
         face_rows(style, faces) + number_text(style, "int", 3) + number_text(style, "float", 2) +
         number_text(style, "int", 4) + number_text(style, "float", 1) + vertices(style, faces);
}

const std::vector<std::string> ply_formats{"ascii", "binary_little_endian", "binary_big_endian"};

} // namespace

TEST_CASE("PLY: a mesh comes back bit for bit from every format and type") {
  const Scratch scratch;
  for (const NamedMesh& mesh : {closed_meshes()[0], closed_meshes()[4], open_meshes()[0]})
    for (const std::string& format : ply_formats)
      for (const bool extra : {false, true})
        for (const std::array<std::string, 4>& types :
             {std::array<std::string, 4>{"double", "uchar", "int", "vertex_indices"},
              {"float64", "uint8", "uint32", "vertex_index"},
              {"double", "int8", "ushort", "vertex_index"},
              {"double", "int32", "int16", "vertex_indices"}}) {
          CAPTURE(mesh.name);
          CAPTURE(format);
          const MeshFile file =
              read_text(scratch / "mesh.ply",
                        ply_text(faces_of(mesh.mesh),
                                 {format, types[0], types[1], types[2], types[3], extra}));
          check_equal(*file.mesh, mesh.mesh);
          CHECK(file.fields.empty());
          CHECK(file.ignored == (extra ? std::vector<std::string>{"weight", "empty", "flag", "edge",
                                                                  "red", "texture", "none"}
                                       : std::vector<std::string>{}));
        }
}

TEST_CASE("PLY: single precision, CRLF in the head, and points alone") {
  const Scratch scratch;
  const Mesh mesh = closed_meshes()[0].mesh;
  Faces faces = faces_of(mesh);
  faces.points = faces.points.cast<float>().cast<double>();
  for (const std::string& format : ply_formats) {
    const MeshFile file =
        read_text(scratch / "mesh.ply", ply_text(faces, {.format = format, .coordinate = "float"}));
    CHECK(equal_bits(file.mesh->points, faces.points));
    std::string text = ply_text({mesh.points, {}, {}}, {.format = format});
    for (const char* line : {"ply\n", "1.0\n", "end_header\n"})
      text = replaced(text, line, std::string(line, std::strlen(line) - 1) + "\r\n");
    check_equal(*read_text(scratch / "mesh.ply", text).mesh, mesh);
  }
}

TEST_CASE("PLY: polygons are cells with unit corners") {
  const Scratch scratch;
  const Faces faces = prism();
  for (const std::string& format : ply_formats) {
    const MeshFile file =
        read_text(scratch / "mesh.ply", ply_text(faces, {.format = format, .extra = true}));
    REQUIRE(file.polygons);
    CHECK(!file.mesh);
    CHECK(file.polygons->size() == 7);
    CHECK(values_of(file.polygons->ids.items) == faces.ids);
    CHECK((file.polygons->corners - faces.points.colwise().normalized()).norm() < 1e-15);
  }
}

TEST_CASE("PLY: what is not a mesh is refused by name") {
  const Scratch scratch;
  const std::string text = ply_text(faces_of(calotte::delaunay(octahedron())), {});
  const std::vector<std::array<std::string, 2>> cases{
      {"plx\n" + text, "does not start with the line \"ply\""},
      {replaced(text, "ascii", "ebcdic"), "format \"ebcdic\""},
      {replaced(text, "double", "quad"), "\"quad\" is not a type"},
      {replaced(text, "comment", "remark"), "\"remark\" is not a keyword"},
      {replaced(text, "vertex 6", "vertex -6"), "\"vertex\" is \"-6\""},
      {replaced(text, "vertex 6", "vertex 99999999999"), "\"99999999999\""},
      {replaced(text, "vertex 6", "vertex 2147483647"), "ends before its 2147483647 rows"},
      {replaced(text, "face 8", "face 2147483647"), "ends before its 2147483647 rows"},
      {replaced(text, "face 8", "face 9"), "element \"face\", row 8 (0-based): the file ends"},
      {replaced(text, "face 8", "face 7"), "bytes follow after its last element"},
      {replaced(text, "double z", "double w"), "the properties x, y and z"},
      {replaced(text, "double z", "double x"), ""},
      {replaced(text, "vertex_indices", "corners"), "one list vertex_indices or vertex_index"},
      {replaced(text, "end_header", "end"), "\"end\" is not a keyword"},
      {replaced(text, "element face", "element tristrips"), "triangle strips"}};
  for (const auto& [bad, part] : cases) {
    CAPTURE(part);
    CHECK(has(problem_of(scratch / "mesh.ply", bad), part));
  }
}

TEST_CASE("PLY: ids out of range and invalid numbers of corners name their face") {
  const Scratch scratch;
  for (const std::string& format : ply_formats) {
    const auto error = [&](std::size_t index, double value) {
      Faces faces = faces_of(calotte::delaunay(octahedron()));
      faces.ids[index] = value;
      write_text(scratch / "mesh.ply", ply_text(faces, {.format = format}));
      return error_of([&] { calotte::read_mesh_file(scratch / "mesh.ply"); });
    };
    for (const double bad : {6., -1., 2147483647.})
      CHECK(error(16, bad).index() == 5);
    Faces two = faces_of(calotte::delaunay(octahedron()));
    two.ends[4] -= 1;
    const std::string problem = problem_of(scratch / "mesh.ply", ply_text(two, {.format = format}));
    CHECK(has(problem, "array \"face\": polygon 4 runs from 12 to 14"));
    for (const char* count : {"char", "int"}) {
      Faces faces = faces_of(calotte::delaunay(octahedron()));
      std::string text = ply_text(faces, {.format = format, .count = count});
      const bool big = format == "binary_big_endian";
      const std::string three = number_text({.format = format}, count, 3);
      const std::size_t last =
          text.size() - face_rows({.format = format, .count = count}, faces).size();
      text.replace(last, three.size(),
                   format == "ascii" ? std::string("-3\n")
                                     : bytes_of(vtk_types.at(count), {-3}, big));
      CHECK(has(problem_of(scratch / "mesh.ply", text), "\"vertex_indices\" is invalid"));
    }
  }
}

TEST_CASE("PLY: a file that is cut anywhere, or whose bytes change, is read or refused") {
  const Scratch scratch;
  std::mt19937 random(2);
  for (const std::string& format : ply_formats)
    for (const bool extra : {false, true}) {
      const std::string path = scratch / "mesh.ply",
                        text = ply_text(faces_of(calotte::delaunay(octahedron())),
                                        {.format = format, .extra = extra});
      write_text(path, text);
      const int done = done_when_cut(path, [&] { calotte::read_mesh(path); });
      CHECK(done <= (format == "ascii" ? 2 : 0)); // white space, or digits of the last number
      for (int k = 0; k < 500; ++k) {
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
