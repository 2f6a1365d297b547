// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/draw.h"
#include "draw/legend.h"
#include "draw/raster.h"
#include "draw/values.h"
#include "draw/vector.h"
#include "support/constants.h"
#include "support/pictures.h"
#include "tools/draw/projections.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <cairo.h>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::tools;
namespace fs = std::filesystem;

namespace {

constexpr std::array both_shapes = {Shapes::triangles, Shapes::cells};
constexpr std::array all_shapes = {Shapes::triangles, Shapes::cells, Shapes::both};
constexpr std::array all_colourings = {Colouring::spacing, Colouring::angle,   Colouring::valence,
                                       Colouring::area,    Colouring::quality, Colouring::density,
                                       Colouring::none};

/// Four sites, made by hand.
Mesh tetrahedron() {
  Mesh mesh;
  mesh.points.resize(3, 4);
  mesh.points << 1, 1, -1, -1, /**/ 1, -1, 1, -1, /**/ 1, -1, -1, 1;
  mesh.triangles.resize(3, 4);
  mesh.triangles << 0, 0, 0, 1, /**/ 1, 2, 3, 3, /**/ 2, 3, 1, 2;
  mesh.neighbours.resize(3, 4);
  mesh.neighbours << 3, 3, 3, 1, /**/ 1, 2, 0, 0, /**/ 2, 0, 1, 2;
  return mesh;
}

/// Sites within 40 degrees of the north pole.
Mesh polar_cap() {
  const Points3 all = fibonacci_sphere(1000);
  Eigen::Index count = 0;
  while (all(2, count) > std::cos(40 * degree)) {
    ++count;
  }
  return delaunay(all.leftCols(count));
}

/// Calls visit(pixel) for those of the map's image that are within 0.97 of its radius, or for all
/// of a plate carree.
void for_each_map_pixel(const Painting& painting, Projection projection, int width,
                        const std::function<void(std::uint32_t)>& visit) {
  const MapSize size = map_size(projection, width);
  cairo_surface_t* image = raster_map(painting, projection, size);
  REQUIRE(cairo_image_surface_get_width(image) == size.width);
  const unsigned char* data = cairo_image_surface_get_data(image);
  const double radius = size.width / 2.0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (projection == Projection::plate_carree ||
          std::hypot(x + 0.5 - radius, y + 0.5 - radius) < 0.97 * radius) {
        const auto* row =
            data + static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(image);
        visit(reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff);
      }
    }
  }
  cairo_surface_destroy(image);
}

Painting painting_of(const Mesh& mesh, Shapes shapes, Colouring colouring, const LonLat& view) {
  Painting painting;
  painting.scene = make_scene(mesh, shapes, view);
  painting.values = values_of(painting.scene, colouring);
  painting.widths = widths_of(painting.scene, shapes);
  painting.scale = make_scale(painting.values, colouring);
  return painting;
}

} // namespace

TEST_CASE("a picture has its format's signature, and is the only file that appears") {
  const Folder folder;
  const Mesh mesh = delaunay(random_sphere(300));
  for (const char* name : {"a.png", "a.svg", "a.PDF"}) {
    draw(folder.file(name), mesh, {.look = {.size = 300}});
  }
  CHECK(bytes_of(folder.file("a.png")).starts_with("\x89PNG\r\n\x1a\n"));
  CHECK(bytes_of(folder.file("a.svg")).starts_with("<?xml"));
  CHECK(bytes_of(folder.file("a.svg")).ends_with("</svg>\n"));
  CHECK(bytes_of(folder.file("a.PDF")).starts_with("%PDF-"));
  CHECK(bytes_of(folder.file("a.PDF")).ends_with("%%EOF\n"));
  CHECK(folder.count() == 3);
}

TEST_CASE("a picture that cannot be drawn is refused, and leaves no file") {
  const Folder folder;
  const Mesh mesh = tetrahedron();
  for (const char* name : {"a.jpg", "a", "png", ".", "a.png/"}) {
    CAPTURE(name);
    CHECK(code_of([&] { draw(folder.file(name), mesh); }) == ErrorCode::invalid_argument);
  }
  CHECK(code_of([&] { draw(folder.file("a.png"), mesh, {.look = {.size = 63}}); }) ==
        ErrorCode::invalid_argument);
  CHECK(code_of([&] { draw(folder.file("a.png"), mesh, {.look = {.size = 16385}}); }) ==
        ErrorCode::invalid_argument);
  CHECK(code_of([&] { draw(folder.file("none/a.png"), mesh); }) == ErrorCode::file);
  CHECK(folder.count() == 0);
}

TEST_CASE("a full disk is an error in every format") {
  const Folder folder;
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    CAPTURE(name);
    fs::create_symlink("/dev/full", folder.file(name));
    CHECK(code_of([&] { draw(folder.file(name), tetrahedron(), {.look = {.size = 300}}); }) ==
          ErrorCode::file);
  }
  CHECK(folder.count() == 3); // the links
}

TEST_CASE("four sites, an open mesh and a usual one can be drawn in every way") {
  const Folder folder;
  for (const Mesh& mesh : {tetrahedron(), polar_cap(), delaunay(random_sphere(100))}) {
    for (const Shapes shapes : all_shapes) {
      for (const Colouring colouring : all_colourings) {
        if (!mesh.closed() && shapes != Shapes::triangles &&
            (colouring == Colouring::area || colouring == Colouring::quality)) {
          continue;
        }
        for (const Projection projection : all_projections) {
          if (projection == Projection::plate_carree && colouring != Colouring::spacing) {
            continue; // shapes and colours are independent
          }
          const DrawOptions options = {.look = {.projection = projection, .size = 100},
                                       .shapes = shapes,
                                       .colouring = colouring};
          draw(folder.file("a.png"), mesh, options);
          const Picture picture(folder.file("a.png"));
          CHECK(picture.width() == 100);
          CHECK(picture.height() >= 50);
          CHECK(picture.at(0, 0) == 0xffffff);
          CHECK(picture.at(50, 40) != 0xffffff);
        }
      }
    }
  }
}

TEST_CASE("paths are drawn of all shapes, on both maps, and many shapes become an image") {
  const Folder folder;
  const auto has_image = [&](const Mesh& mesh, Projection projection, Shapes shapes) {
    draw(folder.file("a.svg"), mesh,
         {.look = {.projection = projection, .size = 100}, .shapes = shapes});
    const std::string text = bytes_of(folder.file("a.svg"));
    CHECK(text.ends_with("</svg>\n"));
    return text.find("<image") != std::string::npos;
  };
  for (const Mesh& mesh : {tetrahedron(), polar_cap(), delaunay(random_sphere(100))}) {
    for (const Projection projection : all_projections) {
      for (const Shapes shapes : all_shapes) {
        CHECK(!has_image(mesh, projection, shapes));
      }
    }
  }
  const Mesh large = delaunay(fibonacci_sphere(16000)); // 31 996 triangles
  CHECK(has_image(large, Projection::plate_carree, Shapes::triangles));
}

TEST_CASE("the hidden side is not drawn, and the near side is") {
  const Mesh cap = polar_cap();
  const std::uint32_t bare = packed(globe_colour);
  for (const double latitude : {-90., 90.}) {
    const Painting painting = painting_of(cap, Shapes::triangles, Colouring::none,
                                          {.longitude = 0, .latitude = latitude});
    CHECK(visible_shapes(painting, Projection::globe) == (latitude > 0 ? cap.triangles.cols() : 0));
    std::int64_t painted = 0;
    std::int64_t all = 0;
    for_each_map_pixel(painting, Projection::globe, 200, [&](std::uint32_t pixel) {
      painted += pixel != bare ? 1 : 0;
      ++all;
    });
    // The cap's picture takes sin(40 deg)^2 = 0.41 of the disk, less a spacing along its rim.
    const double share = static_cast<double>(painted) / static_cast<double>(all);
    CHECK((latitude > 0 ? share > 0.3 && share < 0.5 : share == 0));
  }
}

TEST_CASE("shapes leave no gap: a sample that none covers would change its pixel's mean") {
  const Mesh mesh = delaunay(fibonacci_sphere(30000)); // too small here for outlines
  for (const Shapes shapes : both_shapes) {
    for (const Projection projection : all_projections) {
      const Painting painting =
          painting_of(mesh, shapes, Colouring::none, {.longitude = 7, .latitude = 3});
      const std::uint32_t fill = packed(painting.scale.colour(0));
      std::int64_t others = 0;
      for_each_map_pixel(painting, projection, 180,
                         [&](std::uint32_t pixel) { others += pixel != fill ? 1 : 0; });
      CHECK(others == 0);
    }
  }
}

TEST_CASE("sites are directions: their norms change no byte of the picture") {
  const Folder folder;
  Mesh mesh = delaunay(random_sphere(200));
  draw(folder.file("a.png"), mesh, {.look = {.size = 300}, .shapes = Shapes::cells});
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    mesh.points.col(i) *= std::ldexp(1.0, static_cast<int>(i * 6) - 600); // to 1e-180 and 1e179
  }
  draw(folder.file("b.png"), mesh, {.look = {.size = 300}, .shapes = Shapes::cells});
  CHECK(bytes_of(folder.file("a.png")) == bytes_of(folder.file("b.png")));
}

TEST_CASE("values: the icosahedron's are known, and 6 - valence sums to 12") {
  const Mesh icosahedron = delaunay(bisected_icosahedron(0));
  const Mesh random = delaunay(random_sphere(1000));
  const LonLat view = {.longitude = 40, .latitude = -20};
  for (const Shapes shapes : both_shapes) {
    const Scene scene = make_scene(icosahedron, shapes, view);
    for (const double spacing : values_of(scene, Colouring::spacing)) {
      CHECK(spacing == doctest::Approx(std::atan(2)).epsilon(1e-14)); // angle subtended by a side
    }
    for (const double angle : values_of(scene, Colouring::angle)) {
      CHECK(angle == doctest::Approx(72 * degree).epsilon(1e-14));
    }
    for (const double valence : values_of(scene, Colouring::valence)) {
      CHECK(valence == 5);
    }
    for (const double quality : values_of(scene, Colouring::quality)) {
      CHECK(quality == doctest::Approx(1).epsilon(1e-14));
    }
    const Scene random_scene = make_scene(random, shapes, view);
    const std::vector<double> areas = values_of(random_scene, Colouring::area);
    CHECK(std::accumulate(areas.begin(), areas.end(), 0.0) ==
          doctest::Approx(4 * pi).epsilon(1e-12));
  }
  const auto valences = values_of(make_scene(random, Shapes::cells, view), Colouring::valence);
  double sum = 0;
  for (const double valence : valences) {
    sum += 6 - valence;
  }
  CHECK(sum == 12);
  std::int64_t counted = 0;
  for (const ValueClass& c : classes_of(valences, Colouring::valence)) {
    counted += c.count;
  }
  CHECK(counted == random.points.cols());
}

TEST_CASE("cells of an open boundary have no value and no outline") {
  const Mesh cap = polar_cap();
  const Scene scene = make_scene(cap, Shapes::cells, {.longitude = 0, .latitude = 90});
  const auto boundary = (cap.neighbours.array() < 0).count();
  CHECK(boundary > 0);
  std::int64_t open = 0;
  std::vector<Eigen::Vector3d> corners;
  const std::vector<double> values = values_of(scene, Colouring::spacing);
  for (std::size_t i = 0; i < values.size(); ++i) {
    outline_of(scene, Shapes::cells, static_cast<std::int64_t>(i), corners);
    CHECK(corners.empty() == std::isnan(values[i]));
    open += corners.empty() ? 1 : 0;
  }
  CHECK(open == boundary); // a closed curve has as many vertices as edges
}

TEST_CASE("a scale runs from 0 to 1, rises, and its ticks lie on it") {
  for (const auto& [low, high] : {std::pair{0.01, 0.012}, {0.001, 0.5}, {1e-7, 1.0}, {0.2, 0.2}}) {
    const Scale scale = make_scale({low, high, std::nan("")}, Colouring::spacing);
    CAPTURE(low);
    CHECK(scale.position(scale.low) == 0);
    CHECK(scale.position(scale.high) == doctest::Approx(1));
    CHECK(scale.position(0.5 * (scale.low + scale.high)) > 0);
    const AxisTicks ticks = bar_ticks(scale, 7).ticks;
    CHECK(ticks.labelled.size() >= 2);
    CHECK(ticks.labelled.size() <= 7);
    double last = -1e-6;
    for (const Tick& tick : ticks.labelled) {
      CHECK(tick.position > last);
      last = tick.position;
    }
    CHECK(last <= 1 + 1e-6);
  }
}

TEST_CASE("labels of a bar say the values at their places, in degrees or powers of ten") {
  const auto label_value = [](const std::string& label) {
    return std::strtod(label.c_str(), nullptr);
  };
  for (const auto& [low, high] : {std::pair{2e7, 5e7}, {1e-9, 1.4e-9}, {-0.02, 0.04}, {3., 9.}}) {
    const Scale scale = make_scale({low, high}, Colouring::field);
    const BarTicks bar = bar_ticks(scale, 6);
    for (const Tick& tick : bar.ticks.labelled) {
      CAPTURE(tick.label);
      if (!tick.label.starts_with("\u2212")) {
        const double value = label_value(tick.label) * std::pow(10, bar.exponent);
        CHECK(scale.position(value) == doctest::Approx(tick.position).epsilon(1e-9));
        CHECK(label_value(tick.label) < 1e4); // a short label
      }
    }
  }
  Scale angles = make_scale({5, 7}, Colouring::angle);
  angles.degrees = true;
  for (const Tick& tick : bar_ticks(angles, 6).ticks.labelled) {
    CHECK(tick.label.ends_with("\u00b0"));
    CHECK(angles.position(label_value(tick.label)) == doctest::Approx(tick.position).epsilon(1e-9));
  }
}

TEST_CASE("a colouring that a mesh does not support is refused, and leaves no file") {
  const Folder folder;
  const auto refused = [&](const Mesh& mesh, const DrawOptions& options) {
    CHECK(code_of([&] { draw(folder.file("a.png"), mesh, options); }) ==
          ErrorCode::invalid_argument);
    CHECK(folder.count() == 0);
  };
  for (const Colouring colouring : {Colouring::area, Colouring::quality}) {
    refused(polar_cap(), {.shapes = Shapes::cells, .colouring = colouring});
  }
  DrawOptions field = {.colouring = Colouring::field};
  field.field.values = Eigen::VectorXd::Ones(5);
  refused(tetrahedron(), field); // of four sites
  DrawOptions density = {.colouring = Colouring::density};
  density.density.kind = Density::Kind::callable;
  density.density.callable = [](const auto&, Eigen::Ref<Eigen::VectorXd> rho) { rho.setZero(); };
  refused(tetrahedron(), density);
}
