// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "io/command.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/text.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

using calotte::ErrorCode;
using calotte::Format;
using calotte::Mesh;
using calotte::Numbering;
using calotte::Points3;
using namespace calotte::test;

namespace {

/// A format's name of a file, and whether its files hold cells.
struct ExpectedFormat {
  Format format;
  std::string file;
  bool cells;
  bool netcdf() const { return file == "mesh.nc"; }
};

const std::vector<ExpectedFormat> expected_formats{
    {Format::mpas, "mesh.nc", true},        {Format::mpas_minimal, "mesh.nc", true},
    {Format::ugrid, "mesh.nc", true},       {Format::ugrid_triangles, "mesh.nc", false},
    {Format::scrip, "mesh.nc", true},       {Format::esmf, "mesh.nc", true},
    {Format::vtp, "mesh.vtp", false},       {Format::vtu, "mesh.vtu", false},
    {Format::vtp_cells, "mesh.vtp", true},  {Format::vtu_cells, "mesh.vtu", true},
    {Format::off, "mesh.off", false},       {Format::ply, "mesh.ply", false},
    {Format::triangles, "mesh.tri", false}, {Format::mpi_scvt, "SaveVertices", false},
    {Format::msh, "mesh.msh", false},       {Format::geojson, "mesh.geojson", true},
    {Format::gmsh, "mesh.msh", false},      {Format::schism, "hgrid.gr3", false},
    {Format::adcirc, "fort.14", false},     {Format::sms, "mesh.2dm", false}};

/// Whether the format holds the points as they are.
bool holds_coordinates(Format format) {
  constexpr std::array angles{Format::scrip, Format::esmf, Format::schism, Format::adcirc,
                              Format::sms};
  return std::ranges::find(angles, format) == angles.end();
}

} // namespace

TEST_CASE("a name tells its format, in any case; an option tells it too, and must not contradict") {
  using calotte::format_of;
  CHECK(format_of("a/mesh.nc") == Format::mpas);
  CHECK(format_of("mesh.VTP") == Format::vtp);
  CHECK(format_of("mesh.vtu") == Format::vtu);
  CHECK(format_of("mesh.Off") == Format::off);
  CHECK(format_of("mesh.ply") == Format::ply);
  CHECK(format_of("mesh.MSH") == Format::msh);
  CHECK(format_of("mesh.GeoJSON") == Format::geojson);
  CHECK(format_of("mesh.txt") == Format::triangles);
  CHECK(format_of("mesh.tri") == Format::triangles);
  for (const char* name :
       {"SaveVertices", "a.b/SaveVertices", "SaveVertices.42", "SaveVertices.txt"})
    CHECK(format_of(name) == Format::mpi_scvt);
  CHECK(format_of("SaveVertices.vtp") == Format::vtp);
  CHECK(code_of([&] { format_of("SaveVertices.txt", Format::triangles); }) ==
        ErrorCode::invalid_argument);
  CHECK(format_of("mesh.g") == Format::exodus);
  CHECK(format_of("mesh.EXO") == Format::exodus);
  CHECK(format_of("a/nod2d.out") == Format::fesom);

  for (const ExpectedFormat& kind : expected_formats) {
    CHECK(format_of(kind.file, kind.format) == kind.format);
    if (kind.format != Format::mpi_scvt)
      CHECK(format_of("grid.data", kind.format) == kind.format);
    CHECK(info_of(kind.format).cells == kind.cells);
    for (const ExpectedFormat& other : expected_formats)
      if (kind.file != other.file)
        CHECK(code_of([&] { format_of(other.file, kind.format); }) == ErrorCode::invalid_argument);
  }
  CHECK(code_of([&] { format_of("grid.data", Format::mpi_scvt); }) == ErrorCode::invalid_argument);
  for (const char* name : {"mesh", "mesh.stl", "", "vtp", "a.vtp/mesh", "SaveTriangles"})
    CHECK(code_of([&] { calotte::format_of(name); }) == ErrorCode::invalid_argument);
  CHECK(message_of([&] { format_of("mesh.stl"); }) ==
        "mesh.stl: unknown suffix \".stl\"; a mesh file ends in .nc, .g, .exo, .vtp, .vtu, .vtk "
        "(read only), "
        ".off, .ply, .msh, .geojson, .txt, .tri, .gr3, .ll, .14 or .2dm, or is named SaveVertices "
        "or nod2d.out");
}

TEST_CASE("every format's file is read as the mesh that was written") {
  const Scratch scratch;
  for (const auto& [name, mesh] :
       {NamedMesh{"random", calotte::delaunay(calotte::random_sphere(200, 1))},
        NamedMesh{"cubed sphere", calotte::delaunay(calotte::cubed_sphere(4))}})
    for (const ExpectedFormat& kind : expected_formats) {
      CAPTURE(name);
      CAPTURE(int(kind.format));
      const std::string path = scratch / kind.file;
      calotte::write(path, mesh, {.format = kind.format});
      const Mesh expected =
          calotte::renumbered(mesh, kind.netcdf() ? Numbering::curve : Numbering::input);
      const Mesh read = calotte::read_mesh(path, &mesh.points);
      REQUIRE(read.points.cols() == mesh.points.cols());
      CHECK((read.points - expected.points).colwise().norm().maxCoeff() < 1e-14);
      if (holds_coordinates(kind.format)) {
        CHECK(equal_bits(read.points, expected.points));
        CHECK(equal_bits(read.triangles, expected.triangles));
        CHECK(equal_bits(read.neighbours, expected.neighbours));
      }
      if (kind.format != Format::triangles)
        CHECK(equal_bits(calotte::read_sites(path), read.points));
    }
}

TEST_CASE("numbering: along the curve for NetCDF by default, as selected in every format") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(calotte::random_sphere(120, 2));
  for (const Numbering numbering : {Numbering::curve, Numbering::input})
    for (const ExpectedFormat& kind : expected_formats) {
      CAPTURE(int(kind.format));
      CAPTURE(int(numbering));
      const std::string path = scratch / kind.file;
      calotte::write(path, mesh, {.format = kind.format, .numbering = numbering});
      if (kind.format == Format::triangles) // they refer to the columns of the input in any order
        CHECK(calotte::check(
                  calotte::renumbered(calotte::read_mesh(path, &mesh.points), Numbering::curve))
                  .passed());
      else if (holds_coordinates(kind.format))
        CHECK(equal_bits(calotte::read_sites(path), calotte::renumbered(mesh, numbering).points));
    }
}

TEST_CASE("a NetCDF file's contents tell its kind, whatever its name") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(calotte::random_sphere(100, 3));
  for (const ExpectedFormat& kind : expected_formats)
    if (kind.netcdf()) {
      calotte::write(scratch / "grid.data", mesh, {.format = kind.format});
      CHECK(calotte::read_mesh(scratch / "grid.data").points.cols() == 100);
    }
  write_text(scratch / "mesh.nc", "x y z\n1 2 3\n");
  CHECK(code_of([&] { calotte::read_mesh(scratch / "mesh.nc"); }) == ErrorCode::parse);
  write_text(scratch / "grid.data", "x y z\n1 2 3\n");
  CHECK(code_of([&] { calotte::read_mesh(scratch / "grid.data"); }) == ErrorCode::invalid_argument);
  CHECK(code_of([&] { calotte::read_mesh(scratch / "absent.nc"); }) == ErrorCode::file);
  CHECK(code_of([&] { calotte::read_mesh(scratch / "absent.vtp"); }) == ErrorCode::file);
}

TEST_CASE("options out of range are refused before any file is touched") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  const auto refused = [&](const ExpectedFormat& kind, calotte::WriteOptions options) {
    options.format = kind.format;
    CHECK(code_of([&] { calotte::write(scratch / kind.file, mesh, options); }) ==
          ErrorCode::invalid_argument);
    CHECK(scratch.files() == 0);
  };
  for (const ExpectedFormat& kind : expected_formats) {
    for (const double radius : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
      refused(kind, {.sphere_radius = radius});
    refused(kind, {.density = calotte::tanh_bump({1, 0, 0}, 0.5, 0.2, 2)});
    calotte::Density empty;
    empty.kind = calotte::Density::Kind::callable;
    refused(kind, {.density = empty});
  }
  CHECK(code_of([&] { calotte::write(scratch / "mesh.stl", mesh); }) ==
        ErrorCode::invalid_argument);
  CHECK(scratch.files() == 0);
}

TEST_CASE("cells need a closed mesh, triangles none; ids must be the mesh's") {
  const Scratch scratch;
  for (const auto& [name, mesh] : open_meshes())
    for (const ExpectedFormat& kind : expected_formats) {
      CAPTURE(int(kind.format));
      const auto write = [&, &open = mesh] {
        calotte::write(scratch / kind.file, open, {.format = kind.format});
      };
      if (kind.cells)
        CHECK(has(message_of(write), "the mesh is open"));
      else
        write();
    }
  const Mesh good = calotte::delaunay(octahedron());
  for (const std::int32_t id : {-1, 6, std::numeric_limits<std::int32_t>::max()})
    for (const ExpectedFormat& kind : expected_formats) {
      Mesh bad = good;
      bad.triangles(2, 3) = id;
      const auto write = [&] {
        calotte::write(scratch / "bad.data", bad, {.format = kind.format});
      };
      if (kind.format != Format::mpi_scvt)
        CHECK(code_of(write) == ErrorCode::invalid_argument);
      bad = good;
      bad.site_of_input[3] = id;
      if (kind.format != Format::mpi_scvt)
        CHECK(code_of(write) == ErrorCode::invalid_argument);
    }
  CHECK_FALSE(std::filesystem::exists(scratch / "bad.data"));
}

TEST_CASE(
    "a raw mesh is written as triangles without fields; reading refuses triangles that overlap") {
  const Scratch scratch;
  Mesh raw = calotte::delaunay(octahedron());
  raw.triangles.col(7) = raw.triangles.col(0); // as many as a closed mesh has, but open edges
  raw.neighbours.setConstant(-1);
  for (const char* file : {"mesh.vtp", "mesh.vtu", "mesh.off", "mesh.ply", "mesh.msh"}) {
    calotte::write(scratch / file, raw);
    CHECK(code_of([&] { calotte::read_mesh(scratch / file); }) == ErrorCode::parse);
  }
  raw.neighbours.resize(3, 0);
  raw.site_of_input.clear();
  for (const char* file : {"mesh.vtp", "mesh.vtu", "mesh.off", "mesh.ply", "mesh.msh", "mesh.tri"})
    calotte::write(scratch / file, raw);
  CHECK(code_of([&] { calotte::read_mesh(scratch / "mesh.tri", &raw.points); }) ==
        ErrorCode::parse);
}

TEST_CASE("points without triangles are triangulated, and equal directions merged") {
  const Scratch scratch;
  write_text(scratch / "mesh.off", "OFF\n5 0 0\n1 0 0\n0 1 0\n0 0 1\n-1 -1 -1\n2 0 0\n");
  const Mesh mesh = calotte::read_mesh(scratch / "mesh.off");
  CHECK(mesh.points.cols() == 4);
  CHECK(mesh.triangles.cols() == 4);
  CHECK(mesh.site_of_input == std::vector<std::int32_t>{0, 1, 2, 3, 0});
  CHECK(calotte::read_sites(scratch / "mesh.off").cols() == 5);
  write_text(scratch / "mesh.off", "OFF\n4 0 0\n1 0 0\n0 1 0\n-1 0 0\n-1 -1 0\n");
  CHECK(!calotte::read_mesh(scratch / "mesh.off").surface.is_sphere()); // z is 0 at all points
  write_text(scratch / "mesh.off", "OFF\n4 0 0\n1 0 1\n0 1 0\n-1 0 -1\n-1 -1 -1\n");
  const calotte::Error tilted = error_of([&] { calotte::read_mesh(scratch / "mesh.off"); });
  CHECK(tilted.code() == ErrorCode::degenerate);
  CHECK(std::string(tilted.what()).starts_with(scratch / "mesh.off: "));
}

TEST_CASE("triangles alone are no sites") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  for (const char* file : {"mesh.txt", "mesh.tri"}) {
    calotte::write(scratch / file, mesh);
    CHECK(code_of([&] { calotte::read_sites(scratch / file); }) == ErrorCode::invalid_argument);
    CHECK(code_of([&] { calotte::read_mesh(scratch / file); }) == ErrorCode::invalid_argument);
  }
}

TEST_CASE("a periodic plane is MPAS's or triangles alone, and keeps its numbers") {
  const Scratch scratch;
  const calotte::Mesh plane = calotte::hexagonal_box(6, 8, 1000);
  for (const ExpectedFormat& kind : expected_formats) {
    if (kind.format == Format::triangles)
      continue;
    CAPTURE(int(kind.format));
    const std::string path = scratch / kind.file;
    const auto write = [&](Numbering numbering) {
      calotte::write(path, plane, {.format = kind.format, .numbering = numbering});
    };
    if (kind.format != Format::mpas && kind.format != Format::mpas_minimal) {
      CHECK(code_of([&] { write(Numbering::by_format); }) == ErrorCode::invalid_argument);
      CHECK((kind.netcdf() || !std::filesystem::exists(path)));
      continue;
    }
    CHECK(code_of([&] { write(Numbering::curve); }) == ErrorCode::invalid_argument);
    write(Numbering::by_format);
    const calotte::Mesh read = calotte::read_mesh(path);
    CHECK(equal_bits(read.points, plane.points));
    CHECK(equal_bits(read.triangles, plane.triangles));
    CHECK(read.surface == plane.surface);
  }
  const Mesh sphere = calotte::delaunay(octahedron());
  calotte::write(scratch / "mesh.nc", sphere);
  CHECK(calotte::read_mesh(scratch / "mesh.nc").surface.is_sphere());
  calotte::write(scratch / "mesh.off", sphere);
  CHECK(calotte::read_mesh(scratch / "mesh.off").surface.is_sphere());
}

TEST_CASE("a plane that does not repeat itself is written with z = 0, but not as cells") {
  const Scratch scratch;
  Points3 points(3, 5);
  points << 1, 3, 3, 1, 2, 1, 1, 2, 2, 1.5, 0, 0, 0, 0, 0;
  const calotte::Mesh plane = calotte::delaunay(points, calotte::Surface::plane());
  for (const ExpectedFormat& kind : expected_formats) {
    CAPTURE(int(kind.format));
    const std::string path = scratch / kind.file;
    const auto write = [&] { calotte::write(path, plane, {.format = kind.format}); };
    if (kind.netcdf() || info_of(kind.format).cells || kind.format == Format::mpi_scvt ||
        !holds_coordinates(kind.format)) {
      CHECK(code_of(write) == ErrorCode::invalid_argument);
      continue;
    }
    write();
    if (kind.format == Format::triangles)
      continue;
    const calotte::Mesh read = calotte::read_mesh(path);
    CHECK(equal_bits(read.triangles, plane.triangles));
    CHECK(read.points == points);
    CHECK(read.surface == calotte::Surface::plane());
  }
}
