// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "io/format_files.h"
#include "io/polygon_file.h"
#include "support/constants.h"
#include "support/files.h"
#include "support/open_mpas.h"
#include "support/text.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

// Cells of a part of the sphere stay the file's. Triangles are those around corners of three cells,
// never those of the centres' hull.

using namespace calotte;
using namespace calotte::test;
using open_mpas::Cut;
using open_mpas::open_file;

namespace {

const std::vector<FormatFile> targets{{"a.nc", Format::ugrid},      {"b.nc", Format::scrip},
                                      {"c.nc", Format::esmf},       {"d.vtp", Format::vtp_cells},
                                      {"e.vtu", Format::vtu_cells}, {"f.geojson", Format::geojson}};

/// rows x columns cells between parallels and meridians, in degrees. \param four_corners whether
/// inner corners have four cells; otherwise rows are shifted by half a cell, and they have three.
Polygons patch(int rows, int columns, double west, double south, double step, bool four_corners) {
  Polygons out;
  std::vector<double> lon, lat;
  std::vector<std::int32_t> ids;
  std::vector<std::int64_t> begin{0};
  const auto node = [&](double x, double y) {
    for (std::size_t k = 0; k < lon.size(); ++k)
      if (std::abs(lon[k] - x) < 1e-9 && std::abs(lat[k] - y) < 1e-9)
        return static_cast<std::int32_t>(k);
    lon.push_back(x);
    lat.push_back(y);
    return static_cast<std::int32_t>(lon.size()) - 1;
  };
  std::vector<double> centre_lon, centre_lat;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double x = west + step * (column + (four_corners ? 0 : 0.5 * (row % 2))),
                   y = south + step * row;
      const double half = step / 2;
      for (const double a :
           four_corners ? std::vector<double>{0, step} : std::vector<double>{0, half, step})
        ids.push_back(node(x + a, y));
      for (const double a :
           four_corners ? std::vector<double>{step, 0} : std::vector<double>{step, half, 0})
        ids.push_back(node(x + a, y + step));
      begin.push_back(std::ssize(ids));
      centre_lon.push_back(x + half);
      centre_lat.push_back(y + half);
    }
  const auto directions = [](const std::vector<double>& x, const std::vector<double>& y) {
    Points3 points(3, std::ssize(x));
    for (std::size_t k = 0; k < x.size(); ++k)
      points.col(static_cast<Eigen::Index>(k))
          << std::cos(pi / 180 * y[k]) * std::cos(pi / 180 * x[k]),
          std::cos(pi / 180 * y[k]) * std::sin(pi / 180 * x[k]), std::sin(pi / 180 * y[k]);
    return points;
  };
  out.corners = directions(lon, lat);
  out.centres = directions(centre_lon, centre_lat);
  out.ids = {Eigen::Map<const Offsets>(begin.data(), std::ssize(begin)),
             Eigen::Map<const Ids>(ids.data(), std::ssize(ids))};
  return out;
}

/// By the definition of the excess, without differences: good to 1e-13.
double area_of_quadrilateral(const Points3& p, const std::array<std::int32_t, 4>& id) {
  double sum = -2 * pi;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3d a = p.col(id[(k + 3) % 4]), b = p.col(id[k]), c = p.col(id[(k + 1) % 4]);
    const Eigen::Vector3d to_a = b.cross(a).normalized(), to_c = b.cross(c).normalized();
    sum += std::acos(std::clamp(to_a.dot(to_c), -1.0, 1.0));
  }
  return sum;
}

std::set<std::array<std::int32_t, 3>> set_of(const Triangles& triangles) {
  std::set<std::array<std::int32_t, 3>> all;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    all.insert({triangles(0, t), triangles(1, t), triangles(2, t)});
  return all;
}

} // namespace

TEST_CASE("an open MPAS mesh has its triangles and cells in each format of cells, and back") {
  const Scratch scratch;
  for (const double lowest : {-0.5, 0.2, 0.8}) {
    open_file(scratch, fibonacci_sphere(400), lowest)
        .create(scratch / "open.nc", NC_DOUBLE, open_mpas::put_attributes);
    const MeshFile source = read_mesh_file(scratch / "open.nc");
    REQUIRE(source.mesh);
    const Eigen::VectorXd area = areas(*source.polygons);
    const double count = static_cast<double>(source.mesh->triangles.cols());
    CHECK(delaunay(source.mesh->points).triangles.cols() > count); // what it is not
    for (const FormatFile& target : targets) {
      CAPTURE(target.name);
      CHECK(write(scratch / target.name, source, {.format = target.format}).dropped.empty());
      const MeshFile copy = read_mesh_file(scratch / target.name);
      REQUIRE(copy.mesh);
      REQUIRE(copy.polygons);
      CHECK(set_of(copy.mesh->triangles) == set_of(source.mesh->triangles));
      CHECK(check_surface(*copy.mesh).passed());
      CHECK((areas(*copy.polygons) - area).cwiseAbs().maxCoeff() < 1e-12);
      write(scratch / "triangles.off", copy);
      CHECK(set_of(read_mesh_file(scratch / "triangles.off").mesh->triangles) ==
            set_of(source.mesh->triangles));
    }
  }
}

TEST_CASE("GeoJSON of Voronoi cells of which some were left out holds a part of the sphere") {
  const Scratch scratch;
  const Mesh mesh = delaunay(fibonacci_sphere(500));
  write(scratch / "whole.geojson", mesh);
  CHECK(!read_mesh_file(scratch / "whole.geojson").polygons);
  nlohmann::json all = nlohmann::json::parse(test::read_file(scratch / "whole.geojson"));
  for (const double angle : {0.0, 1.0, 2.5, pi}) { // also across the meridian of 180 degrees
    nlohmann::json part = all;
    part["features"].clear();
    std::vector<std::int32_t> number(500, -1);
    std::int32_t count = 0;
    double area = 0;
    for (std::size_t i = 0; i < all["features"].size(); ++i)
      if (const nlohmann::json& p = all["features"][i]["properties"];
          double(p["x"]) * std::cos(angle) + double(p["y"]) * std::sin(angle) > 0.5) {
        part["features"].push_back(all["features"][i]);
        area += double(p["area"]);
        number[i] = count++;
      }
    test::write_text(scratch / "part.geojson", part.dump());
    const MeshFile file = read_mesh_file(scratch / "part.geojson");
    REQUIRE(file.mesh);
    REQUIRE(file.polygons);
    CHECK(areas(*file.polygons).sum() == doctest::Approx(area).epsilon(1e-9));
    std::int64_t triangles = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
      bool kept = true;
      for (const std::int32_t site : mesh.triangles.col(t))
        kept = kept && number[static_cast<std::size_t>(site)] >= 0;
      triangles += kept ? 1 : 0;
    }
    CHECK(file.mesh->triangles.cols() == triangles);
    for (const MeshField& field : file.fields)
      CHECK(field.name == "id"); // in the whole file
  }
}

TEST_CASE("cells of a region that make no triangles stay cells: measured and written as they are") {
  const Scratch scratch;
  for (const bool four : {true, false}) {
    const Polygons cells = patch(6, 7, 10, 40, 0.25, four);
    const PolygonShapes measured = shapes(cells);
    // Neighbours on one meridian are one step apart, those on a parallel less.
    CHECK(measured.spacing.max ==
          doctest::Approx((four ? 1 : 1.01) * 0.25 * pi / 180).epsilon(1e-2));
    CHECK(measured.spacing.max < 0.3 * pi / 180);
    CHECK(measured.without_area == 0);
    if (four)
      for (std::int64_t i = 0; i < cells.size(); ++i) {
        const auto ids = cells.ids[i];
        const double expected =
            area_of_quadrilateral(cells.corners, {ids[0], ids[1], ids[2], ids[3]});
        CHECK(areas(cells)[i] == doctest::Approx(expected).epsilon(1e-6));
      }
    for (const FormatFile& target : targets) {
      CAPTURE(target.name);
      write(scratch / target.name, file_of(cells), {.format = target.format});
      const MeshFile read = read_mesh_file(scratch / target.name);
      CHECK(!read.mesh);
      CHECK(read.not_voronoi.fault == CellFault::not_circumcentres);
      REQUIRE(read.polygons);
      CHECK((areas(*read.polygons) - areas(cells)).cwiseAbs().maxCoeff() < 1e-12);
      for (const char* other : {"x.vtp", "x.vtu", "x.off", "x.ply"}) {
        CAPTURE(other);
        write(scratch / other, read);
        const MeshFile again = read_mesh_file(scratch / other);
        REQUIRE(again.polygons);
        CHECK(again.polygons->size() == cells.size());
        CHECK((areas(*again.polygons) - areas(cells)).cwiseAbs().maxCoeff() < 1e-12);
      }
      const Error error = error_of([&] { write(scratch / "x.msh", read); });
      CHECK(has(error.what(), "the format holds triangles"));
      CHECK(has(message_of([&] { write(scratch / "mpas.nc", read); }), "MPAS needs Voronoi cells"));
    }
  }
}

TEST_CASE("a field at corners goes where the format holds it, and is left out by name elsewhere") {
  const Scratch scratch;
  open_file(scratch, fibonacci_sphere(300), 0.1)
      .create(scratch / "open.nc", NC_DOUBLE, open_mpas::put_attributes);
  std::vector<MeshFile> files{read_mesh_file(scratch / "open.nc"),
                              file_of(patch(5, 4, 170, -30, 5, true))};
  for (MeshFile& file : files) {
    file.fields = {{.name = "depth",
                    .location = FieldLocation::vertices,
                    .values = file.polygons->corners.row(2).transpose()}};
    for (const FormatFile& target : {targets[0], targets[2], targets[3], targets[4]}) {
      CAPTURE(target.name);
      CHECK(write(scratch / target.name, file, {.format = target.format}).dropped.empty());
      MeshFile read = read_mesh_file(scratch / target.name);
      const auto field = std::find_if(read.fields.begin(), read.fields.end(),
                                      [](const MeshField& other) { return other.name == "depth"; });
      REQUIRE(field != read.fields.end());
      CHECK((field->values - read.polygons->corners.row(2).transpose()).norm() < 1e-13);
      read.fields = {*field};
      const std::vector<std::string> depth{"depth"};
      CHECK(write(scratch / "x.off", read).dropped == depth);
      CHECK(write(scratch / "x.geojson", read).dropped == depth);
      CHECK(write(scratch / "x.vtp", read).dropped ==
            (read.mesh ? depth : std::vector<std::string>{}));
    }
  }
}

TEST_CASE("cells without area are counted, and no neighbour overlaps them") {
  const Scratch scratch;
  for (const std::int64_t cell : {0, 9, 13}) {
    Polygons cells = patch(5, 4, 0, 10, 1, true);
    const auto ids = cells.ids[cell];
    ids[2] = ids[1];
    ids[3] = ids[0]; // both long sides are the southern one
    CHECK(shapes(cells).without_area == 1);
    CHECK(shapes(cells).first_without_area == cell);
    Polygons moved = patch(5, 4, 0, 10, 1, true); // the same with corners of its own
    moved.corners.conservativeResize(3, moved.corners.cols() + 2);
    for (const int k : {0, 1}) {
      const auto corner = static_cast<std::int32_t>(moved.corners.cols()) - 2 + k;
      moved.corners.col(corner) = moved.corners.col(moved.ids.items[4 * cell + 1 - k]);
      moved.ids.items[4 * cell + 2 + k] = corner;
    }
    CHECK(shapes(moved).without_area == 1);
    for (const FormatFile& target : {targets[0], targets[1], targets[2]}) {
      CAPTURE(target.name);
      write(scratch / target.name, file_of(target.format == Format::scrip ? cells : moved),
            {.format = target.format});
      const MeshFile read = read_mesh_file(scratch / target.name);
      REQUIRE(read.polygons);
      const PolygonShapes found = shapes(*read.polygons);
      CHECK(found.without_area == 1);
      CHECK(found.first_without_area == cell);
    }
  }
}

TEST_CASE("clipped cells of a plane are written as their own triangles, not as those of the hull") {
  const Scratch scratch;
  const Surface domain = rectangle({0, 0}, {3, 2});
  const Mesh mesh = delaunay(random_points(60, domain, {}, 4), domain);
  write(scratch / "plane.nc", mesh);
  const MeshFile file = read_mesh_file(scratch / "plane.nc");
  REQUIRE(file.polygons);
  std::vector<int> cells_at(static_cast<std::size_t>(file.polygons->corners.cols()));
  for (const std::int32_t id : file.polygons->ids.items)
    ++cells_at[static_cast<std::size_t>(id)];
  const auto inner = std::count(cells_at.begin(), cells_at.end(), 3);
  CHECK(inner < mesh.triangles.cols()); // some circumcentres are outside
  write(scratch / "plane.vtp", file);
  CHECK(read_mesh_file(scratch / "plane.vtp").mesh->triangles.cols() == inner);
}
