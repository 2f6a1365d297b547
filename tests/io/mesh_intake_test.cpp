// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "io/format_files.h"
#include "io/polygon_file.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/mesh_file.h>
#include <calotte/quality.h>
#include <calotte/voronoi.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using calotte::ErrorCode;
using calotte::FieldLocation;
using calotte::Format;
using calotte::Mesh;
using calotte::MeshFile;
using calotte::Points3;
using calotte::Polygons;
using calotte::Triangles;
using namespace calotte::test;

namespace {

/// The text of an .off file, made here and not by the library.
std::string off_text(const Points3& points, const Triangles& triangles) {
  std::string text =
      "OFF\n" + std::to_string(points.cols()) + " " + std::to_string(triangles.cols()) + " 0\n";
  char line[128];
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", points(0, i), points(1, i),
                  points(2, i));
    text += line;
  }
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    std::snprintf(line, sizeof line, "3 %d %d %d\n", triangles(0, t), triangles(1, t),
                  triangles(2, t));
    text += line;
  }
  return text;
}

Triangles clockwise(Triangles triangles) {
  triangles.row(1).swap(triangles.row(2));
  return triangles;
}

/// In another order, each from another vertex on.
Triangles shuffled(const Triangles& triangles, unsigned seed) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(triangles.cols()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::mt19937 random(seed);
  std::shuffle(order.begin(), order.end(), random);
  Triangles out(3, triangles.cols());
  for (Eigen::Index t = 0; t < out.cols(); ++t)
    for (Eigen::Index i = 0; i < 3; ++i)
      out((i + t) % 3, t) = triangles(i, order[static_cast<std::size_t>(t)]);
  return out;
}

MeshFile read_off(const Scratch& scratch, const Points3& points, const Triangles& triangles) {
  write_text(scratch / "mesh.off", off_text(points, triangles));
  return calotte::read_mesh_file(scratch / "mesh.off");
}

/// The six faces of a cube, each cut into n x n quadrilaterals, and their centres.
Polygons cube_of_quads(int n) {
  Polygons quads;
  std::vector<double> corners, centres;
  const auto add = [](std::vector<double>& list, const Eigen::Vector3d& p) {
    const Eigen::Vector3d unit = p.normalized();
    list.insert(list.end(), unit.data(), unit.data() + 3);
  };
  std::vector<std::int32_t> ids;
  std::vector<Eigen::Vector3d> known;
  const auto id_of = [&](const Eigen::Vector3d& p) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const Eigen::Vector3d& other) {
      return (other - p).norm() < 1e-9;
    });
    if (found != known.end())
      return static_cast<std::int32_t>(found - known.begin());
    known.push_back(p);
    add(corners, p);
    return static_cast<std::int32_t>(known.size()) - 1;
  };
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double sign = face % 2 == 0 ? 1 : -1;
    const auto point = [&](double u, double v) {
      Eigen::Vector3d p;
      p[axis] = sign;
      p[(axis + 1) % 3] = sign * u; // counter-clockwise from outside on either face
      p[(axis + 2) % 3] = v;
      return p;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double u = -1 + 2.0 * i / n, v = -1 + 2.0 * j / n, step = 2.0 / n;
        for (const auto& [du, dv] : {std::pair{0., 0.}, {step, 0.}, {step, step}, {0., step}})
          ids.push_back(id_of(point(u + du, v + dv)));
        add(centres, point(u + step / 2, v + step / 2));
      }
  }
  const auto count = static_cast<Eigen::Index>(centres.size() / 3);
  quads.corners = Eigen::Map<const Points3>(corners.data(), 3, Eigen::Index(corners.size() / 3));
  quads.centres = Eigen::Map<const Points3>(centres.data(), 3, count);
  quads.ids.begin = calotte::Offsets::LinSpaced(count + 1, 0, 4 * count);
  quads.ids.items = Eigen::Map<const calotte::Ids>(ids.data(), Eigen::Index(ids.size()));
  return quads;
}

const std::vector<FormatFile> polygon_files{
    {"cells.nc", Format::ugrid}, {"cells.nc", Format::scrip}, {"cells.nc", Format::esmf}};

} // namespace

TEST_CASE("triangles in any order, from any vertex on, and all clockwise give the canonical mesh") {
  const Scratch scratch;
  for (const auto& [name, mesh] : all_meshes()) {
    CAPTURE(name);
    const auto same = [&](const Triangles& triangles) {
      const MeshFile file = read_off(scratch, mesh.points, triangles);
      CHECK(equal_bits(file.mesh->points, mesh.points));
      CHECK(equal_bits(file.mesh->triangles, mesh.triangles));
      CHECK(equal_bits(file.mesh->neighbours, mesh.neighbours));
      return file.changes;
    };
    CHECK(same(mesh.triangles).empty());
    const std::string count = std::to_string(mesh.triangles.cols());
    CHECK(same(shuffled(mesh.triangles, 1)) ==
          std::vector<std::string>{"sorted " + count + " triangles"});
    CHECK(same(shuffled(clockwise(mesh.triangles), 2)).front() ==
          "turned " + count + " clockwise triangles");
  }
}

TEST_CASE("triangles of both orientations are refused, and the first of the rarer is named") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(calotte::random_sphere(60, 5));
  Triangles mixed = mesh.triangles;
  std::swap(mixed(1, 17), mixed(2, 17));
  const auto refused = [&](const Triangles& triangles) {
    write_text(scratch / "mesh.off", off_text(mesh.points, triangles));
    const calotte::Error error = error_of([&] { calotte::read_mesh(scratch / "mesh.off"); });
    CHECK(error.code() == ErrorCode::parse);
    CHECK(error.index() == 17);
    return std::string(error.what());
  };
  CHECK(has(refused(mixed), " runs clockwise, but 115 triangles run the other way"));
  CHECK(has(refused(clockwise(mixed)),
            " runs counter-clockwise, but 115 triangles run the other way"));
}

TEST_CASE("triangles that share an edge on one side, or a vertex with themselves, are refused") {
  const Scratch scratch;
  const Points3 points = columns({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0.6, 0.6, 0.5}});
  const auto problem = [&](const Triangles& triangles) {
    write_text(scratch / "mesh.off", off_text(points, triangles));
    return message_of([&] { calotte::read_mesh(scratch / "mesh.off"); });
  };
  CHECK(has(problem((Triangles(3, 2) << 0, 0, 1, 1, 2, 4).finished()),
            "the edge from 0 to 1 of triangle 0 (0, 1, 2)"));
  CHECK(has(problem((Triangles(3, 2) << 0, 2, 1, 2, 2, 3).finished()), "has a vertex twice"));
}

TEST_CASE("cells that are no Voronoi cells keep their shapes from format to format") {
  const Scratch scratch;
  const Polygons quads = cube_of_quads(5);
  const Eigen::VectorXd expected = calotte::areas(quads);
  CHECK(expected.minCoeff() > 0);
  CHECK(expected.sum() == doctest::Approx(4 * std::numbers::pi).epsilon(1e-12));
  for (const FormatFile& from : polygon_files) {
    CAPTURE(int(from.format));
    const std::string path = scratch / from.name;
    calotte::write(path, file_of(quads), {.format = from.format});
    const MeshFile read = calotte::read_mesh_file(path);
    REQUIRE(read.polygons);
    CHECK(read.not_voronoi.fault == calotte::CellFault::other_corner);
    CHECK(read.changes.empty());
    CHECK(read.fields.empty());
    CHECK(read.polygons->corners.cols() == quads.corners.cols());
    REQUIRE(read.polygons->size() == quads.size());
    CHECK((calotte::areas(*read.polygons) - expected).cwiseAbs().maxCoeff() < 1e-13);
    for (const FormatFile& to : polygon_files) {
      calotte::write(scratch / "other.nc", read, {.format = to.format});
      const MeshFile again = calotte::read_mesh_file(scratch / "other.nc");
      CHECK((calotte::areas(*again.polygons) - expected).cwiseAbs().maxCoeff() < 1e-13);
    }
    for (const auto& [format, name] :
         {std::pair{Format::mpas, "full.nc"}, {Format::msh, "mesh.msh"}}) {
      const calotte::Error error =
          error_of([&] { calotte::write(scratch / name, read, {.format = format}); });
      CHECK(error.code() == ErrorCode::invalid_argument);
      CHECK(has(error.what(), "away from that of the Voronoi cell"));
    }
    for (const char* name : {"mesh.vtp", "mesh.vtu", "mesh.off", "mesh.ply"}) { // other faces
      CAPTURE(name);
      calotte::write(scratch / name, read);
      const MeshFile again = calotte::read_mesh_file(scratch / name);
      CHECK((calotte::areas(*again.polygons) - expected).cwiseAbs().maxCoeff() < 1e-13);
    }
    CHECK(code_of([&] { calotte::read_mesh(path); }) == ErrorCode::invalid_argument);
  }
}

TEST_CASE("values at the corners of cells that are no Voronoi cells go along") {
  const Scratch scratch;
  MeshFile file = file_of(cube_of_quads(3));
  file.fields = {{.name = "height",
                  .location = FieldLocation::vertices,
                  .values = file.polygons->corners.row(2).transpose()},
                 {.name = "part",
                  .values = Eigen::VectorXd::LinSpaced(file.polygons->size(), 0, 53),
                  .dimensions = {},
                  .leading = 0,
                  .integer = true}};
  for (const auto& [format, name] : {std::pair{Format::ugrid, "a.nc"},
                                     {Format::esmf, "b.nc"},
                                     {Format::exodus, "c.g"},
                                     {Format::vtp_cells, "d.vtp"},
                                     {Format::vtu_cells, "e.vtu"}}) {
    CAPTURE(name);
    CHECK(calotte::write(scratch / name, file, {.format = format}).dropped.empty());
    file = calotte::read_mesh_file(scratch / name);
    REQUIRE(file.polygons);
    REQUIRE(file.fields.size() == 2);
    CHECK((file.fields[0].values - file.polygons->corners.row(2).transpose()).norm() < 1e-13);
    CHECK(file.fields[1].values == Eigen::VectorXd::LinSpaced(file.polygons->size(), 0, 53));
  }
  CHECK(calotte::write(scratch / "f.geojson", file).dropped == std::vector<std::string>{"height"});
}

TEST_CASE("polygons: all clockwise are turned, both orientations and overlaps are refused") {
  const Scratch scratch;
  const auto turn = [](Polygons& quads, Eigen::Index cell) {
    const auto ids = quads.ids[cell];
    std::reverse(ids.begin(), ids.end());
  };
  for (const FormatFile& format : polygon_files) {
    CAPTURE(int(format.format));
    const std::string path = scratch / format.name;
    Polygons quads = cube_of_quads(3);
    const Eigen::VectorXd expected = calotte::areas(quads);
    for (Eigen::Index i = 0; i < quads.size(); ++i)
      turn(quads, i);
    calotte::write(path, file_of(quads), {.format = format.format});
    const MeshFile read = calotte::read_mesh_file(path);
    CHECK(read.changes == std::vector<std::string>{"turned 54 clockwise cells"});
    CHECK((calotte::areas(*read.polygons) - expected).cwiseAbs().maxCoeff() < 1e-13);

    Polygons mixed = cube_of_quads(3);
    turn(mixed, 20);
    calotte::write(path, file_of(mixed), {.format = format.format});
    const calotte::Error error = error_of([&] { calotte::read_mesh_file(path); });
    CHECK(error.index() == 20);
    CHECK(has(error.what(), "cell 20 runs clockwise"));

    Polygons doubled = cube_of_quads(3);
    std::copy_n(doubled.ids[0].begin(), 4, doubled.ids[7].begin());
    calotte::write(path, file_of(doubled), {.format = format.format});
    CHECK(has(message_of([&] { calotte::read_mesh_file(path); }), "cell 0 and cell 7 overlap"));
  }
}

TEST_CASE("fields and densities go from format to format in the order of the cells") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(calotte::random_sphere(300, 6));
  calotte::WriteOptions options;
  options.site_density = 1 + mesh.points.row(0).transpose().array();
  options.fields = {{.name = "height", .units = "m", .values = mesh.points.row(1).transpose()},
                    {.name = "turning",
                     .location = FieldLocation::vertices,
                     .values = calotte::voronoi(mesh).vertices.row(2).transpose()}};
  const auto check_values = [&](const MeshFile& file, double scale) {
    const Points3& points = file.mesh->points;
    CHECK((file.density - scale * (1 + points.row(0).transpose().array()).matrix())
              .cwiseAbs()
              .maxCoeff() < 1e-14);
    const auto height =
        std::find_if(file.fields.begin(), file.fields.end(),
                     [](const calotte::MeshField& field) { return field.name == "height"; });
    REQUIRE(height != file.fields.end());
    CHECK(height->units == "m");
    CHECK((height->values - points.row(1).transpose()).cwiseAbs().maxCoeff() < 1e-15);
    const auto turning =
        std::find_if(file.fields.begin(), file.fields.end(),
                     [](const calotte::MeshField& field) { return field.name == "turning"; });
    REQUIRE(turning != file.fields.end());
    CHECK((turning->values - calotte::voronoi(*file.mesh).vertices.row(2).transpose())
              .cwiseAbs()
              .maxCoeff() < 1e-14);
  };
  const double scale = 1 / options.site_density.maxCoeff();
  calotte::write(scratch / "full.nc", mesh, options);
  const MeshFile full = calotte::read_mesh_file(scratch / "full.nc");
  check_values(full, scale);
  CHECK(calotte::write(scratch / "minimal.nc", full, {.format = Format::mpas_minimal})
            .dropped.empty());
  check_values(calotte::read_mesh_file(scratch / "minimal.nc"), scale);
  CHECK(calotte::write(scratch / "cells.nc", full, {.format = Format::scrip}).dropped ==
        std::vector<std::string>{"turning"});
  const MeshFile scrip = calotte::read_mesh_file(scratch / "cells.nc");
  CHECK(scrip.mesh);
  CHECK(!scrip.polygons);
  CHECK(calotte::write(scratch / "mesh.off", full).dropped ==
        std::vector<std::string>{"height", "turning"});
}

TEST_CASE("values of another number than the mesh's sites are refused") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  const auto refused = [&](const calotte::WriteOptions& options) {
    CHECK(code_of([&] { calotte::write(scratch / "mesh.nc", mesh, options); }) ==
          ErrorCode::invalid_argument);
    CHECK(scratch.files() == 0);
  };
  refused({.site_density = Eigen::VectorXd::Ones(5)});
  refused({.site_density = Eigen::VectorXd::Zero(6)});
  refused({.site_density = -Eigen::VectorXd::Ones(6)});
  refused({.fields = {{.name = "f", .values = Eigen::VectorXd::Ones(7)}}});
}

TEST_CASE("edges: cocircular diagonals are no fault, others are counted and named") {
  const Mesh mesh = calotte::delaunay(signs_of({1, 1, 1})); // a cube's corners
  CHECK(calotte::count_edges(mesh).not_delaunay == 0);
  CHECK(calotte::count_edges(mesh).cocircular == 0);
  const Mesh random = calotte::delaunay(calotte::random_sphere(100, 7));
  const Scratch scratch;
  // The other diagonal of two triangles.
  const auto flipped = [&](const Mesh& from, Eigen::Index t, int i) {
    Triangles triangles = from.triangles;
    const std::int32_t other = from.neighbours(i, t);
    const std::int32_t a = triangles((i + 1) % 3, t), b = triangles((i + 2) % 3, t),
                       c = triangles(i, t);
    std::int32_t d = -1;
    for (const std::int32_t site : triangles.col(other))
      if (site != a && site != b)
        d = site;
    triangles.col(t) << c, a, d;
    triangles.col(other) << c, d, b;
    return read_off(scratch, from.points, triangles);
  };
  // The diagonal of a square face.
  std::int64_t squares = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols() && squares == 0; ++t)
    for (int i = 0; i < 3; ++i) {
      const double a = (mesh.points.col(mesh.triangles((i + 1) % 3, t)) -
                        mesh.points.col(mesh.triangles((i + 2) % 3, t)))
                           .norm();
      if (a < 2.5) // the squares' sides are 2 long
        continue;
      const MeshFile file = flipped(mesh, t, i);
      const calotte::EdgeCounts edges = calotte::count_edges(*file.mesh);
      CHECK(edges.not_delaunay == 0);
      CHECK(edges.cocircular == 1);
      CHECK(!calotte::check(*file.mesh).passed());
      CHECK(calotte::check_surface(*file.mesh).passed());
      calotte::quality(*file.mesh);
      calotte::write(scratch / "cells.nc", file);
      ++squares;
      break;
    }
  CHECK(squares == 1);
  const MeshFile file = flipped(random, 20, 0);
  const calotte::EdgeCounts edges = calotte::count_edges(*file.mesh);
  CHECK(edges.not_delaunay == 1);
  CHECK(edges.shortest < 0);
  CHECK(calotte::check_surface(*file.mesh).passed());
  const std::string problem = error_of([&] { calotte::write(scratch / "bad.nc", file); }).what();
  CHECK(has(problem, "the mesh has 1 edges that are not Delaunay (the first is from site " +
                         std::to_string(edges.first[0]) + " to "));
}

TEST_CASE("an open mesh that is not convex is a surface with counted boundaries") {
  const Scratch scratch;
  const Mesh whole = calotte::delaunay(calotte::random_sphere(400, 8));
  std::vector<std::int32_t> kept;
  for (std::int32_t t = 0; t < whole.triangles.cols(); ++t) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const std::int32_t site : whole.triangles.col(t))
      centre += whole.points.col(site);
    centre.normalize();
    const bool near = centre.z() > -0.8, hole = centre.x() > 0.9;
    if (near && !hole)
      kept.push_back(t);
  }
  const Triangles part = whole.triangles(Eigen::all, kept);
  const MeshFile file = read_off(scratch, whole.points, part);
  CHECK(!calotte::check(*file.mesh).passed());
  CHECK(calotte::check_surface(*file.mesh).passed());
  const calotte::EdgeCounts edges = calotte::count_edges(*file.mesh);
  CHECK(edges.not_delaunay == 0);
  CHECK(edges.loops == 2);
  CHECK(edges.boundary > 10);
  CHECK(edges.not_convex > 0);
  CHECK(edges.unused_sites > 0);
  const calotte::Quality quality = calotte::triangle_quality(*file.mesh);
  CHECK(quality.triangles == static_cast<std::int64_t>(kept.size()));
  CHECK(quality.triangles_area < 1);
  CHECK(quality.cell_area.max == 0);
}

TEST_CASE("an interpolated density has the values of its sites, and lies between them elsewhere") {
  const Mesh mesh = calotte::delaunay(calotte::random_sphere(500, 9));
  const calotte::Density bump =
      calotte::tanh_bump(Eigen::Vector3d(0.2, 0.5, 0.7), 0.5, 0.3, 1.0 / 256);
  const Eigen::VectorXd rho = calotte::evaluate(bump, mesh.points);
  const calotte::Density density = calotte::interpolated_density(mesh, rho);
  const Eigen::VectorXd at_sites = calotte::evaluate(density, mesh.points);
  CHECK(((at_sites - rho).array().abs() <= 1e-12 * rho.array()).all());
  const Points3 others = calotte::random_sphere(2000, 10);
  const Eigen::VectorXd between = calotte::evaluate(density, others);
  CHECK(between.minCoeff() >= rho.minCoeff() * (1 - 1e-12));
  CHECK(between.maxCoeff() <= rho.maxCoeff() * (1 + 1e-12));
  // Cell widths: the transition is a few cells wide, so that linear interpolation is near.
  const Eigen::VectorXd exact = calotte::evaluate(bump, others);
  CHECK((between.array().pow(-0.25) - exact.array().pow(-0.25)).abs().maxCoeff() < 0.4);
  CHECK(code_of([&] { calotte::interpolated_density(mesh, rho.head(10)); }) ==
        ErrorCode::invalid_argument);
}

TEST_CASE("Exodus holds cells of any shape, and FESOM the triangles of open and closed meshes") {
  const Scratch scratch;
  const Polygons quads = cube_of_quads(4);
  calotte::write(scratch / "quads.g", file_of(quads));
  const MeshFile read = calotte::read_mesh_file(scratch / "quads.g");
  CHECK(read.format == "Exodus");
  REQUIRE(read.polygons);
  CHECK(read.not_voronoi.fault == calotte::CellFault::no_centres);
  CHECK(equal_bits(read.polygons->corners, quads.corners));
  CHECK(equal_bits(read.polygons->ids.items, quads.ids.items));
  for (const auto& [name, mesh] : all_meshes()) {
    CAPTURE(name);
    if (mesh.closed()) {
      calotte::write(scratch / "cells.exo", mesh, {.numbering = calotte::Numbering::input});
      const MeshFile cells = calotte::read_mesh_file(scratch / "cells.exo");
      const double sum =
          cells.polygons ? calotte::areas(*cells.polygons).sum() : 4 * std::numbers::pi;
      CHECK(sum == doctest::Approx(4 * std::numbers::pi).epsilon(1e-9));
    }
    calotte::write(scratch / "nod2d.out", mesh);
    const MeshFile fesom = calotte::read_mesh_file(scratch / "nod2d.out");
    REQUIRE(fesom.mesh);
    CHECK(equal_bits(fesom.mesh->triangles, mesh.triangles));
    CHECK((fesom.mesh->points - mesh.points.colwise().normalized()).cwiseAbs().maxCoeff() < 1e-15);
    CHECK((fesom.fields[0].values.maxCoeff() == 1) == !mesh.closed());
  }
  write_text(scratch / "nod2d.out", "2\n1 0 0 0\n3 90 0 0\n");
  CHECK(has(message_of([&] { calotte::read_mesh_file(scratch / "nod2d.out"); }),
            "line 3: node 2 has another id"));
  write_text(scratch / "nod2d.out", "3\n1 0 0 0\n2 90 0 0\n3 0 90 0\n");
  for (const std::string id : {"0", "4", "-9223372036854775808"}) {
    write_text(scratch / "elem2d.out", "1\n1 2 " + id + "\n");
    CHECK(has(message_of([&] { calotte::read_mesh_file(scratch / "nod2d.out"); }),
              "id " + id + " is not one of the 3 points; ids count from 1"));
  }
}

TEST_CASE("JIGSAW's longitudes and latitudes stand on the sphere of the file's radius") {
  const Scratch scratch;
  const auto write_mesh = [&](const std::string& radii) {
    write_text(scratch / "mesh.msh", "MSHID=3;ELLIPSOID-MESH\n" + radii +
                                         "NDIMS=2\nPOINT=6\n0;0;0\n1.5707963267948966;0;0\n"
                                         "3.141592653589793;0;0\n-1.5707963267948966;0;0\n"
                                         "0;1.5707963267948966;0\n0;-1.5707963267948966;0\n");
  };
  for (const auto& [radii, radius] :
       {std::pair{"", 1.0}, {"RADII=6371;6371;6371\n", 6371.0}, {"RADII=2.5\n", 2.5}}) {
    write_mesh(radii);
    const MeshFile file = calotte::read_mesh_file(scratch / "mesh.msh");
    CHECK(file.sphere_radius == radius);
    CHECK(file.mesh->closed());
  }
  write_mesh("RADII=6378;6378;6357\n");
  CHECK(
      has(message_of([&] { calotte::read_mesh_file(scratch / "mesh.msh"); }), "the radii differ"));
  write_mesh("RADII=0\n");
  CHECK(code_of([&] { calotte::read_mesh_file(scratch / "mesh.msh"); }) == ErrorCode::parse);
}
