// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "io/format_files.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/text.h"

#include <calotte/density.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <bit>
#include <cstring>
#include <limits>

using calotte::ErrorCode;
using calotte::Format;
using calotte::Mesh;
using namespace calotte::test;

namespace {

std::string raw(const void* data, std::size_t bytes) {
  const std::uint64_t size = bytes;
  std::string block(8 + bytes, '\0');
  std::memcpy(block.data(), &size, 8);
  std::memcpy(block.data() + 8, data, bytes);
  return block;
}

/// The file that earlier versions wrote, without fields.
std::string without_fields(const Mesh& mesh, bool polygons) {
  const std::size_t points = std::size_t(mesh.points.cols()),
                    cells = std::size_t(mesh.triangles.cols());
  std::vector<std::int64_t> ids, offsets;
  for (const std::int32_t id : mesh.triangles.reshaped())
    ids.push_back(id);
  for (std::size_t t = 1; t <= cells; ++t)
    offsets.push_back(std::int64_t(3 * t));
  const std::string set = polygons ? "PolyData" : "UnstructuredGrid",
                    element = polygons ? "Polys" : "Cells";
  const auto array = [](const std::string& attributes, std::size_t offset) {
    return "        <DataArray " + attributes + " format=\"appended\" offset=\"" +
           std::to_string(offset) + "\"/>\n";
  };
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + set + "\" version=\"1.0\" byte_order=\"" +
      (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian") +
      "\" header_type=\"UInt64\">\n  <" + set + ">\n    <Piece NumberOfPoints=\"" +
      std::to_string(points) + "\" " +
      (polygons ? "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\""
                : "NumberOfCells=\"") +
      std::to_string(cells) + "\">\n      <Points>\n" +
      array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", 0) +
      "      </Points>\n      <" + element + ">\n" +
      array("type=\"Int64\" Name=\"connectivity\"", 8 + 24 * points) +
      array("type=\"Int64\" Name=\"offsets\"", 16 + 24 * points + 24 * cells);
  if (!polygons)
    text += array("type=\"UInt8\" Name=\"types\"", 24 + 24 * points + 32 * cells);
  text += "      </" + element + ">\n    </Piece>\n  </" + set +
          ">\n  <AppendedData encoding=\"raw\">\n_" + raw(mesh.points.data(), 24 * points) +
          raw(ids.data(), 8 * ids.size()) + raw(offsets.data(), 8 * cells);
  if (!polygons)
    text += raw(std::string(cells, '\5').data(), cells);
  return text + "\n  </AppendedData>\n</VTKFile>\n";
}

/// The block of an array, found by the offset that its element announces.
std::string_view block_of(const std::string& file, const std::string& name) {
  const std::size_t element = file.find(" Name=\"" + name + "\"");
  REQUIRE(element != std::string::npos);
  const std::size_t data = file.find("\n_") + 2,
                    offset = data + std::stoull(file.substr(file.find("offset=\"", element) + 8));
  std::uint64_t size = 0;
  std::memcpy(&size, &file[offset], sizeof size);
  return std::string_view(file).substr(offset + 8, size);
}

template <class T> bool has_values(std::string_view block, const T& values) {
  const std::size_t bytes = sizeof(*values.data()) * std::size_t(values.size());
  return block.size() == bytes && std::memcmp(block.data(), values.data(), bytes) == 0;
}

/// Whether the element stands before the other, and both are there.
bool stands_in(const std::string& file, const std::string& name, const std::string& element) {
  const std::size_t begin = file.find("<" + element), offset = file.find("Name=\"" + name + "\""),
                    end = file.find("</" + element + ">");
  return begin < offset && offset < end && end != std::string::npos;
}

void check_cell_fields(const std::string& file, const std::string& element, const Mesh& mesh,
                       const calotte::Density& density) {
  const calotte::CellFields fields = calotte::cell_fields(calotte::voronoi(mesh), density);
  CHECK(has_values(block_of(file, "area"), fields.area));
  CHECK(has_values(block_of(file, "density"), fields.density));
  CHECK(has_values(block_of(file, "spacing"), fields.spacing));
  CHECK(has_values(block_of(file, "quality"), fields.quality));
  CHECK(has_values(block_of(file, "degree"), fields.degree));
  for (const char* name : {"area", "density", "spacing", "quality", "degree"})
    CHECK(stands_in(file, name, element));
}

const std::vector<FormatFile> of_triangles{{"mesh.vtp", Format::vtp}, {"mesh.vtu", Format::vtu}};
const std::vector<FormatFile> of_cells{{"cells.vtp", Format::vtp_cells},
                                       {"cells.vtu", Format::vtu_cells}};

} // namespace

TEST_CASE("VTK: meshes come back bit for bit, of triangles and of cells") {
  const Scratch scratch;
  for (const auto& [name, mesh] : closed_meshes()) {
    CAPTURE(name);
    for (const std::vector<FormatFile>& kinds : {of_triangles, of_cells})
      for (const auto& [file, format] : kinds) {
        CAPTURE(file);
        calotte::write(scratch / file, mesh, {.format = format});
        check_equal(calotte::read_mesh(scratch / file), mesh);
        CHECK(equal_bits(calotte::read_sites(scratch / file), mesh.points));
      }
  }
  for (const auto& [name, mesh] : open_meshes())
    for (const auto& [file, format] : of_triangles) {
      CAPTURE(name);
      calotte::write(scratch / file, mesh);
      check_equal(calotte::read_mesh(scratch / file), mesh);
    }
}

TEST_CASE("VTK: files without fields, as earlier versions wrote them") {
  const Scratch scratch;
  for (const auto& [name, mesh] : all_meshes())
    for (const bool polygons : {true, false}) {
      CAPTURE(name);
      const std::string path = scratch / (polygons ? "mesh.vtp" : "mesh.vtu");
      const std::string earlier = without_fields(mesh, polygons);
      write_text(path, earlier);
      check_equal(calotte::read_mesh(path), mesh);
      if (!mesh.closed()) {
        calotte::write(path, mesh);
        CHECK(calotte::test::read_file(path) == earlier);
      }
    }
}

TEST_CASE("VTK: triangles have the cells' fields at the points of a closed mesh") {
  const Scratch scratch;
  const calotte::Density density = calotte::tanh_bump({1, 0, 0.5}, 0.5, 0.2, 0.01);
  for (const auto& [name, mesh] : closed_meshes())
    for (const auto& [file, format] : of_triangles) {
      CAPTURE(name);
      calotte::write(scratch / file, mesh, {.density = density});
      check_cell_fields(calotte::test::read_file(scratch / file), "PointData", mesh, density);
    }
  for (const auto& [name, mesh] : open_meshes()) {
    calotte::write(scratch / "mesh.vtp", mesh, {.density = density});
    CHECK(!has(calotte::test::read_file(scratch / "mesh.vtp"), "PointData"));
  }
}

TEST_CASE("VTK: cells are counter-clockwise polygons with their fields and sites") {
  const Scratch scratch;
  const calotte::Density density = calotte::tanh_bump({1, 0, 0.5}, 0.5, 0.2, 0.01);
  for (const auto& [name, mesh] : closed_meshes())
    for (const auto& [file, format] : of_cells) {
      CAPTURE(name);
      calotte::write(scratch / file, mesh, {.format = format, .density = density});
      const std::string text = calotte::test::read_file(scratch / file);
      check_cell_fields(text, "CellData", mesh, density);
      const calotte::Voronoi cells = calotte::voronoi(mesh);
      CHECK(stands_in(text, "site", "CellData"));
      CHECK(has_values(block_of(text, "site"), mesh.points));
      CHECK(stands_in(text, "triangle", "PointData"));
      CHECK(has_values(block_of(text, "triangle"), mesh.triangles));
      // On the sites' sphere, where they have one.
      const double radius = name == "tetrahedron" || name == "cube" ? 1.73205080757 : 1;
      CHECK(has_values(block_of(text, "Points"), calotte::Points3(radius * cells.vertices)));
      std::vector<std::int64_t> corners, offsets;
      for (std::int64_t i = 0; i < mesh.points.cols(); ++i) {
        for (const std::int32_t vertex : cells.vertices_on_cell[i])
          corners.push_back(vertex);
        offsets.push_back(std::int64_t(corners.size()));
      }
      CHECK(has_values(block_of(text, "connectivity"), corners));
      CHECK(has_values(block_of(text, "offsets"), offsets));
      if (format == Format::vtu_cells)
        CHECK(has_values(block_of(text, "types"),
                         std::string(std::size_t(mesh.points.cols()), '\7')));
    }
}

TEST_CASE("VTK: a file that is cut short, or has more, is refused") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  for (const auto& [file, format] : {of_triangles[0], of_cells[1]}) {
    CAPTURE(file);
    const std::string path = scratch / file;
    calotte::write(path, mesh, {.format = format});
    CHECK(done_when_cut(path, [&] { calotte::read_mesh(path); }) == 0);
    write_text(path, calotte::test::read_file(path) + "more");
    CHECK(code_of([&] { calotte::read_mesh(path); }) == ErrorCode::parse);
  }
}

TEST_CASE("VTK: other cells and ids out of range are refused") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  const auto error = [&](const FormatFile& kind, const std::function<void(std::string&)>& spoil) {
    calotte::write(scratch / kind.name, mesh, {.format = kind.format});
    std::string text = calotte::test::read_file(scratch / kind.name);
    spoil(text);
    write_text(scratch / kind.name, text);
    return error_of([&] { calotte::read_mesh(scratch / kind.name); });
  };
  for (const std::int64_t bad : {std::int64_t{6}, std::int64_t{-1}, std::int64_t{1} << 32}) {
    for (const FormatFile& kind : of_triangles)
      CHECK(error(kind, [&](std::string& text) {
              const std::size_t offset =
                  std::size_t(block_of(text, "connectivity").data() - text.data());
              std::memcpy(&text[offset + 8 * 16], &bad, 8);
            }).index() == 5);
    if (const auto narrow = std::int32_t(bad); narrow == bad)
      for (const FormatFile& kind : of_cells)
        CHECK(error(kind, [&](std::string& text) {
                const std::size_t offset =
                    std::size_t(block_of(text, "triangle").data() - text.data());
                std::memcpy(&text[offset + 4 * 16], &narrow, 4);
              }).index() == 5);
  }
  const auto tetrahedron = [](std::string& text) {
    text[std::size_t(block_of(text, "types").data() - text.data()) + 3] = 10;
  };
  CHECK(has(error(of_triangles[1], tetrahedron).what(),
            "array \"types\": cell 3 has the type 10 (tetrahedron); only 5 (triangle)"));
}
