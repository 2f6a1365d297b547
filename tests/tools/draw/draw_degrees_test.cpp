// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/markers.h"
#include "draw/page.h"
#include "draw/plane.h"
#include "draw/projection.h"
#include "draw/values.h"
#include "support/clouds.h"
#include "support/pictures.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/quality.h>

#include <cairo.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::tools;

namespace {

/// Number of values of each kind.
std::map<double, std::int64_t> number_of_each(const std::vector<double>& values) {
  std::map<double, std::int64_t> counts;
  for (const double value : values) {
    ++counts[value];
  }
  return counts;
}

std::vector<double> degrees_of_cells(const Mesh& mesh) {
  return PlaneMap(mesh, {.shapes = Shapes::cells, .colouring = Colouring::valence}).painting.values;
}

Surface ring(double turn) {
  Surface::Rings rings;
  for (const double radius : {1.0, 0.3}) {
    Points2 corners(2, 5);
    for (int i = 0; i < 5; ++i) {
      const double angle = turn + 2 * std::numbers::pi * i / 5;
      corners.col(i) = radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    rings.emplace_back(corners);
  }
  return Surface::plane().within(std::move(rings));
}

} // namespace

TEST_CASE("a planar map of degrees has the counts of quality(), and cells at the boundary apart") {
  for (const double turn : {0.0, 0.4}) {
    const Surface domain = ring(turn);
    const Mesh mesh = delaunay(random_points(600, domain, {}, 7), domain);
    const auto counts = number_of_each(degrees_of_cells(mesh));
    const std::vector<std::int64_t> degrees = quality(mesh).degrees;
    std::int64_t whole = 0;
    for (std::size_t degree = 1; degree < degrees.size(); ++degree) {
      const auto found = counts.find(static_cast<double>(degree));
      CHECK((found == counts.end() ? 0 : found->second) == degrees[degree]);
      whole += degrees[degree];
    }
    CHECK(counts.at(boundary_valence) == 600 - whole);
    CHECK(whole > 400);
  }
  const Surface periodic = Surface::periodic({2, 1});
  const Mesh box = delaunay(random_points(200, periodic, {}, 3), periodic);
  const auto counts = number_of_each(degrees_of_cells(box));
  CHECK(!counts.contains(boundary_valence));
  const std::vector<std::int64_t> degrees = quality(box).degrees;
  for (const auto& [degree, count] : counts) {
    CHECK(degrees[static_cast<std::size_t>(degree)] == count);
  }
}

TEST_CASE("a planar map has the triangles that quality() measures, none across bays and islands") {
  for (const double turn : {0.0, 0.4}) {
    const Surface domain = ring(turn);
    Mesh mesh = delaunay(random_points(600, domain, {}, 7), domain);
    const auto drawn = [&] {
      const PlaneMap map(mesh, {.shapes = Shapes::triangles});
      return std::count_if(map.painting.values.begin(), map.painting.values.end(),
                           [](double side) { return std::isfinite(side); });
    };
    CHECK(drawn() == quality(mesh).triangles);
    CHECK(drawn() < mesh.triangles.cols());
    mesh.surface = Surface::plane();
    CHECK(drawn() == mesh.triangles.cols());
  }
}

TEST_CASE("a lattice in a rectangle shows no defects, as cells or as triangles") {
  const Folder folder;
  const Surface domain = rectangle({0, 0}, {3, 2});
  Mesh mesh = delaunay(hexagonal_lattice(300, domain), domain);
  const auto counts = number_of_each(degrees_of_cells(mesh));
  CHECK(counts.size() == 2);
  CHECK(counts.contains(6));
  CHECK(counts.contains(boundary_valence));
  const Scale scale = make_scale({5, 6, 7}, Colouring::valence);
  for (const Shapes shapes : {Shapes::triangles, Shapes::cells}) {
    for (const Surface& surface : {domain, Surface::plane()}) {
      mesh.surface = surface;
      const DrawOptions options = {
          .look = {.size = 200}, .shapes = shapes, .colouring = Colouring::valence};
      draw(folder.file("a.png"), mesh, options);
      const Picture picture(folder.file("a.png"));
      int defects = 0;
      for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
          for (const double degree : {3, 4, 5, 7, 8, 9}) {
            defects += has_colour(picture.at(x, y), scale.colour(degree)) ? 1 : 0;
          }
        }
      }
      CHECK(defects == 0);
    }
  }
}

TEST_CASE("each pentagon is seen where cells are smaller than a pixel") {
  const Folder folder;
  const Mesh mesh = delaunay(bisected_icosahedron(7)); // 163 842 cells
  const Look look = {.view = LonLat{10, 0}, .coastlines = false, .size = 300};
  const Rgb pentagon = make_scale({5, 6}, Colouring::valence).colour(5);
  for (const Shapes shapes : {Shapes::triangles, Shapes::cells}) {
    draw(folder.file("a.png"), mesh,
         {.look = look, .shapes = shapes, .colouring = Colouring::valence});
    const Picture picture(folder.file("a.png"));
    const Page page = page_of(look, true);
    const Eigen::Matrix3d frame = frame_of({10, 0});
    const Mesh corners = delaunay(bisected_icosahedron(0));
    int visible = 0;
    for (const auto& corner : corners.points.colwise()) {
      const Vector3d p = frame * corner;
      if (p.z() < 0.1) {
        continue;
      }
      ++visible;
      const int x = static_cast<int>(page.middle_x + page.map.width / 2.0 * p.x());
      const int y = static_cast<int>(page.middle_y - page.map.width / 2.0 * p.y());
      int seen = 0;
      for (int dx = -2; dx <= 2; ++dx) {
        for (int dy = -2; dy <= 2; ++dy) {
          const std::uint32_t pixel = picture.at(x + dx, y + dy);
          seen +=
              std::abs(static_cast<int>(pixel & 0xff) - std::lround(255 * pentagon.b)) < 20 &&
                      std::abs(static_cast<int>(pixel >> 16) - std::lround(255 * pentagon.r)) < 40
                  ? 1
                  : 0;
        }
      }
      CAPTURE(x);
      CAPTURE(y);
      CHECK(seen >= 3);
    }
    CHECK(visible >= 4);
  }
}

TEST_CASE("dots cover at most a fifth of a map, and none is too small to see") {
  for (const std::int64_t n : {3000, 200000}) {
    const Mesh mesh = delaunay(random_sphere(n)); // two of three cells are defects
    for (const Projection projection : {Projection::globe, Projection::plate_carree}) {
      Painting painting;
      painting.scene = make_scene(mesh, Shapes::cells, {});
      painting.markers = markers_of(painting.scene, site_valences(painting.scene),
                                    widths_of(painting.scene, Shapes::cells));
      painting.scale = make_scale({5, 6}, Colouring::valence);
      CHECK(painting.markers.size() > static_cast<std::size_t>(n) / 2);
      constexpr int size = 400;
      cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_A8, size, size);
      cairo_t* context = cairo_create(image);
      cairo_translate(context, size / 2.0, size / 2.0);
      draw_markers(context, painting, projection, size, 5);
      cairo_destroy(context);
      double cover = 0;
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          cover +=
              cairo_image_surface_get_data(image)[y * cairo_image_surface_get_stride(image) + x] /
              255.0;
        }
      }
      cairo_surface_destroy(image);
      const double area =
          size * size * (projection == Projection::globe ? std::numbers::pi / 4 : 0.5);
      CAPTURE(n);
      CHECK(cover < 0.25 * area); // the rims reach a little farther
      CHECK((cover == 0) == (n == 200000));
    }
  }
}
