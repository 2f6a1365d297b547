// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/errors.h"
#include "support/files.h"
#include "support/made.h"

#include <calotte/coastal_cells.h>
#include <calotte/mesh_file.h>
#include <calotte/write_grid.h>

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

// Files of cells that end at a coast.

using namespace calotte;
using namespace calotte::test;

namespace {

Recipe in_a_circle() {
  return {.cells = 150, .surface = circle({1, 2, 2}, 0.3, 24), .stop = {.iterations = 20}};
}

const Made& made() {
  static const Made value(in_a_circle());
  return value;
}

GridFile write_made(const std::string& path, const WriteOptions& options = {}) {
  return write_grid(path, made().mesh, made().recipe, made().schedule, options);
}

} // namespace

TEST_CASE("files of coastal cells are those of their tessellation, and pass their checks") {
  const Voronoi cells = coastal_cells(made().mesh).voronoi;
  for (const Format format : {Format::mpas, Format::ugrid, Format::scrip, Format::esmf,
                              Format::exodus, Format::geojson}) {
    CAPTURE(int(format));
    const Scratch scratch;
    const std::string path = scratch / (format == Format::geojson  ? "sea.geojson"
                                        : format == Format::exodus ? "sea.exo"
                                                                   : "sea.nc");
    const GridFile file = write_made(path, {.format = format});
    CHECK(file.cells == 150);
    const MeshFile read = read_mesh_file(path);
    REQUIRE(read.polygons);
    CHECK(read.polygons->size() == 150);
    CHECK(read.not_voronoi.passed() == (format != Format::exodus)); // which has no centres
    CHECK((check(*read.polygons).failure == "") == read.not_voronoi.passed());
    CHECK(check(*read.polygons).area / cells.cell_area.sum() ==
          doctest::Approx(1).epsilon(1e-9)); // GeoJSON has degrees
    for (const Deviation& deviation : check_file(path, read))
      FAIL_CHECK(deviation.text);
  }
}

TEST_CASE("an MPAS file of coastal cells is written again from itself") {
  const Scratch scratch;
  write_made(scratch / "sea.nc", {.sphere_radius = 6371220});
  const MeshFile file = read_mesh_file(scratch / "sea.nc");
  const Voronoi read = voronoi(file);
  const Voronoi cells = coastal_cells(made().mesh).voronoi;
  CHECK(read.cell_area.sum() / cells.cell_area.sum() == doctest::Approx(1).epsilon(1e-12));
  CHECK(read.dv.size() == cells.dv.size());
  write(scratch / "again.nc", file);
  CHECK(check_file(scratch / "again.nc", read_mesh_file(scratch / "again.nc")).empty());
}

TEST_CASE("values at coastal cells follow them into the file's order") {
  const Scratch scratch;
  const Mesh& mesh = made().mesh;
  const MeshField height{.name = "height", .values = mesh.points.row(2).transpose()};
  write_made(scratch / "sea.nc", {.fields = {height}});
  const MeshFile file = read_mesh_file(scratch / "sea.nc");
  REQUIRE(file.fields.size() >= 1);
  bool found = false;
  for (const MeshField& field : file.fields)
    if (field.name == "height") {
      found = true;
      CHECK((field.values - file.polygons->centres.row(2).transpose()).cwiseAbs().maxCoeff() <
            1e-15);
    }
  CHECK(found);
}

TEST_CASE("formats and fields that coastal cells do not have are refused in one line") {
  const Scratch scratch;
  CHECK(refusal_of([&] {
          write_made(scratch / "sea.nc", {.format = Format::mpas_minimal});
        }).find("the boundary of a region clips") != std::string::npos);
  const MeshField at_triangles{.name = "curl",
                               .location = FieldLocation::vertices,
                               .values = DoubleVector::Zero(made().mesh.triangles.cols())};
  CHECK(refusal_of([&] {
          write_made(scratch / "sea.nc", {.fields = {at_triangles}});
        }).find("vertices") != std::string::npos);
  CHECK(scratch.files() == 0);
}
