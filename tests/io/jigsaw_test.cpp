// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command.h"
#include "io/shapes/jigsaw.h"
#include "support/constants.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/text.h"

#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using io_detail::JigsawFile;

namespace {

/// A square with a square hole, a line in it that touches neither, and a point alone.
const std::string square_with_hole =
    "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=12\n"
    "0;0;0\n9;0;0\n9;9;0\n0;9;0\n4;4;0\n6;4;0\n6;6;0\n4;6;0\n"
    "1;1;0\n2;1;0\n2;2;0\n8;8;0\n"
    "EDGE2=10\n0;1;0\n1;2;0\n2;3;0\n3;0;0\n4;5;0\n5;6;0\n6;7;0\n7;4;0\n"
    "8;9;0\n9;10;0\n";

std::string jigsaw_file(const Scratch& scratch, const std::string& text) {
  write_text(scratch / "file.msh", text);
  return scratch / "file.msh";
}

JigsawFile grid(const std::string& kind, int nx, int ny, double step,
                const std::function<double(double, double)>& value) {
  JigsawFile file{.kind = kind, .dimensions = 2};
  for (int i = 0; i < nx; ++i)
    file.x_grid.push_back(i * step);
  for (int j = 0; j < ny; ++j)
    file.y_grid.push_back(j * step - (kind == "ellipsoid-grid" ? pi / 2 : 0));
  for (const double x : file.x_grid)
    for (const double y : file.y_grid)
      file.values.push_back(value(x, y));
  return file;
}

} // namespace

TEST_CASE("jigsaw: closed rings of edges bound a domain, others are lines") {
  const Scratch scratch;
  const JigsawGeometry geometry = read_jigsaw_geometry(jigsaw_file(scratch, square_with_hole));
  CHECK(geometry.surface.area() == 81 - 4);
  REQUIRE(geometry.lines.size() == 2);
  CHECK(geometry.lines[0].cols() + geometry.lines[1].cols() == 4);
  CHECK(read_domain(scratch / "file.msh") == geometry.surface);
}

TEST_CASE("jigsaw: a line that ends at a ring leaves it a ring") {
  const Scratch scratch;
  std::string river = square_with_hole; // from the outer ring to the hole, with a branch
  river.replace(river.find("EDGE2=10"), 8, "EDGE2=13");
  const JigsawGeometry geometry =
      read_jigsaw_geometry(jigsaw_file(scratch, river + "10;4;0\n8;0;0\n9;11;0\n"));
  CHECK(geometry.surface.rings().size() == 2);
  CHECK(geometry.surface.area() == 81 - 4);
  Eigen::Index points = 0;
  for (const Points3& line : geometry.lines)
    points += line.cols();
  CHECK(points >= 5);
}

TEST_CASE("jigsaw: an ellipsoid with equal radii is a sphere, its edges lines") {
  const Scratch scratch;
  const std::string text = "MSHID=3;ELLIPSOID-MESH\nRADII=6371;6371;6371\nNDIMS=2\nPOINT=3\n"
                           "0;0;0\n0.5;0;0\n3.0;1.5;-1\nEDGE2=1\n0;1;0\n";
  const JigsawGeometry geometry = read_jigsaw_geometry(jigsaw_file(scratch, text));
  CHECK(geometry.surface.is_whole_sphere());
  CHECK(geometry.radius == 6371);
  REQUIRE(geometry.lines.size() == 2);
  CHECK(geometry.lines[0].cols() == 2);
  CHECK(geometry.lines[0](0, 1) == doctest::Approx(std::cos(0.5)));
  CHECK(geometry.lines[1].cols() == 1);
  const JigsawPoints points = read_jigsaw_points(scratch / "file.msh", false);
  CHECK(points.fixed == std::vector<bool>{false, false, true});
  CHECK(has(message_of([&] { read_domain(scratch / "file.msh"); }), "geometry of the sphere"));
  CHECK(
      has(message_of([&] { read_jigsaw_points(scratch / "file.msh", true); }), "give those of a"));
}

TEST_CASE("jigsaw: geometries that cannot be meshed are refused") {
  const Scratch scratch;
  const auto refused = [&](const std::string& text, const std::string& words) {
    CAPTURE(words);
    const std::string path = jigsaw_file(scratch, text);
    CHECK(has(message_of([&] { read_jigsaw_geometry(path); }), words));
  };
  refused("MSHID=3;ELLIPSOID-MESH\nRADII=1;1;2\n", "the radii differ");
  refused("MSHID=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT=1\n0;0;1;0\n", "only a sphere");
  refused("MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=2\n0;0;0\n1;0;0\nEDGE2=1\n0;1;0\n",
          "no closed ring of edges");
  const std::string corners = "POINT=5\n0;0;0\n1;0;0\n0;1;0\n-1;0;0\n0;-1;0\n";
  refused("MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\n" + corners +
              "EDGE2=6\n0;1;0\n1;2;0\n2;0;0\n0;3;0\n3;4;0\n4;0;0\n",
          "rings of edges touch at the point 0 0");
  refused(square_with_hole + "BOUND=8\n0;0;2\n0;1;2\n0;2;2\n0;3;2\n1;4;2\n1;5;2\n1;6;2\n1;7;2\n",
          "a geometry of 2 parts (BOUND)");
  refused("MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=2\n0;0;0\n1;0;0\nEDGE2=1\n0;7;0\n",
          "edge 0 has the point 7");
  refused("MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=2\n0;0;0\n1;0;0\nEDGE2=1\n0;-7;0\n", "line 7");
}

TEST_CASE("jigsaw: widths of a plane on a grid and at points") {
  const Scratch scratch;
  const auto linear = [](double x, double y) { return 1 + 0.1 * x + 0.02 * y; };
  io_detail::write_jigsaw_grid(scratch / "grid.msh", grid("euclidean-grid", 5, 3, 0.5, linear));
  const Raster on_grid = read_cell_width(scratch / "grid.msh", {}, Surface::plane());
  CHECK(on_grid.x.size() == 5);
  CHECK(on_grid.values(4, 0) == doctest::Approx(1.2));
  CHECK(on_grid.values(0, 2) == doctest::Approx(1.02));

  const Points3 sites = hexagonal_lattice(400, rectangle({0, 0}, {2, 1}));
  std::ostringstream text;
  text << "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=" << sites.cols() << "\n";
  for (const auto& p : sites.colwise())
    text << p.x() << ";" << p.y() << ";0\n";
  text << "VALUE=" << sites.cols() << ";1\n";
  for (const auto& p : sites.colwise())
    text << linear(p.x(), p.y()) << "\n";
  const Raster at_points = read_cell_width(jigsaw_file(scratch, text.str()), {}, Surface::plane());
  double worst = 0;
  for (Eigen::Index i = 1; i + 1 < at_points.x.size(); ++i)
    for (Eigen::Index j = 1; j + 1 < at_points.y.size(); ++j)
      worst = std::max(worst,
                       std::abs(at_points.values(i, j) - linear(at_points.x[i], at_points.y[j])));
  CHECK(worst < 0.01); // beyond the hull of the points the nearest one's
  CHECK(has(message_of([&] {
              read_cell_width(jigsaw_file(scratch, "MSHID=3;ELLIPSOID-GRID\nNDIMS=2\n"), {},
                              Surface::plane());
            }),
            "no cell widths of a plane"));
}

TEST_CASE("jigsaw: a limited grid keeps its nodes, and is a cone around a low value") {
  const Scratch scratch;
  const std::string path = scratch / "grid.msh";
  for (const bool sphere : {true, false}) {
    CAPTURE(sphere);
    const double step = sphere ? pi / 36 : 0.5, radius = sphere ? 2 : 1, slope = 0.3;
    JigsawFile file = grid(sphere ? "ellipsoid-grid" : "euclidean-grid", sphere ? 73 : 21,
                           sphere ? 37 : 21, step, [](double, double) { return 9; });
    const std::size_t ny = file.y_grid.size(), source = 10 * ny + 8;
    file.values[source] = 1;
    file.slopes = {slope};
    if (sphere)
      file.radii = {radius, radius, radius};
    io_detail::write_jigsaw_grid(path, file);
    limit_jigsaw_values(path, 1);
    const JigsawFile limited = io_detail::read_jigsaw(path);
    CHECK(limited.x_grid == file.x_grid);
    CHECK(limited.slopes == file.slopes);
    CHECK(limited.radii == file.radii);
    for (std::size_t k = 0; k < file.values.size(); ++k) {
      const double x = file.x_grid[k / ny], y = file.y_grid[k % ny], x0 = file.x_grid[10],
                   y0 = file.y_grid[8];
      const double distance =
          sphere
              ? radius * std::acos(std::min(1.0, std::sin(y) * std::sin(y0) +
                                                     std::cos(y) * std::cos(y0) * std::cos(x - x0)))
              : std::hypot(x - x0, y - y0);
      CHECK(limited.values[k] ==
            doctest::Approx(std::min(9.0, 1 + slope * distance)).epsilon(1e-6));
    }
  }
}

TEST_CASE("jigsaw: slopes that are missing or differ are refused, and the file stays") {
  const Scratch scratch;
  const std::string path = scratch / "grid.msh";
  JigsawFile file = grid("euclidean-grid", 3, 3, 1, [](double, double) { return 9; });
  io_detail::write_jigsaw_grid(path, file);
  const std::string before = calotte::test::read_file(path);
  CHECK(has(message_of([&] { limit_jigsaw_values(path, 1); }), "no SLOPE section"));
  CHECK(calotte::test::read_file(path) == before);
  file.slopes.assign(9, 0.1);
  file.slopes[4] = 0.2;
  io_detail::write_jigsaw_grid(path, file);
  CHECK(has(message_of([&] { limit_jigsaw_values(path, 1); }), "SLOPE differs"));
}
