// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "io/cells/model_grid.h"
#include "io/formats/formats.h"
#include "support/files.h"
#include "support/meshes.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

bool is_empty(const Mesh& mesh) {
  return mesh.points.size() == 0 && mesh.triangles.size() == 0 && mesh.neighbours.size() == 0 &&
         mesh.site_of_input.empty();
}

WriteOptions options_with_bump(Format format, Numbering numbering) {
  WriteOptions options;
  options.format = format;
  options.numbering = numbering;
  options.sphere_radius = 6371229;
  options.density = tanh_bump({0, 0, 1}, 0.5, 0.2, 1.0 / 4096);
  return options;
}

} // namespace

TEST_CASE("a mesh that is handed over gives the same file, and is empty then") {
  const Scratch scratch;
  const Mesh mesh = delaunay(random_sphere(3'000, 1));
  for (const auto& [format, suffix] :
       {std::pair{Format::mpas, ".nc"}, std::pair{Format::mpas_minimal, ".nc"},
        std::pair{Format::ugrid, ".nc"}, std::pair{Format::scrip, ".nc"},
        std::pair{Format::vtp_cells, ".vtp"}, std::pair{Format::off, ".off"}})
    for (const Numbering numbering : {Numbering::input, Numbering::curve}) {
      CAPTURE(suffix);
      const WriteOptions options = options_with_bump(format, numbering);
      write(scratch / std::string("kept").append(suffix), mesh, options);
      Mesh given = mesh;
      write(scratch / std::string("given").append(suffix), std::move(given), options);
      CHECK(is_empty(given)); // NOLINT(bugprone-use-after-move): as documented
      CHECK(test::read_file(scratch / std::string("given").append(suffix)) ==
            test::read_file(scratch / std::string("kept").append(suffix)));
      if (format == Format::mpas)
        CHECK(test::read_file(scratch / "given.graph.info") ==
              test::read_file(scratch / "kept.graph.info"));
    }
}

TEST_CASE("a mesh that is refused remains") {
  const Scratch scratch;
  Mesh mesh = delaunay(random_sphere(100, 1));
  const Points3 points = mesh.points;
  CHECK(code_of([&] { write(scratch / "mesh.unknown", std::move(mesh)); }) ==
        ErrorCode::invalid_argument);
  CHECK(mesh.points == points); // NOLINT(bugprone-use-after-move): as documented
  CHECK(mesh.closed());
}

TEST_CASE("an MPAS file that is computed while it is written has the bits of the tessellation") {
  const Scratch scratch;
  std::vector<NamedMesh> meshes = closed_meshes();
  meshes.push_back({"many", delaunay(random_sphere(20'000, 2))});
  const WriteOptions options = options_with_bump(Format::mpas, Numbering::input);
  for (auto& [name, mesh] : meshes) {
    CAPTURE(name);
    io_detail::write_mpas(scratch / "computed.nc", mesh, options);
    mesh.points = io_detail::on_sphere(mesh.points, options.sphere_radius);
    io_detail::write_mpas(scratch / "stored.nc", voronoi(mesh), mesh.points, options);
    CHECK(test::read_file(scratch / "computed.nc") == test::read_file(scratch / "stored.nc"));
  }
  const Surface box = Surface::periodic({1, 1});
  const Mesh plane = delaunay(hexagonal_lattice(100, box), box);
  io_detail::write_mpas(scratch / "computed.nc", plane, {});
  io_detail::write_mpas(scratch / "stored.nc", voronoi(plane), {}, {});
  CHECK(test::read_file(scratch / "computed.nc") == test::read_file(scratch / "stored.nc"));
}
