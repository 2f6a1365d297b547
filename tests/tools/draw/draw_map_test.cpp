// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/degrees.h"
#include "draw/page.h"
#include "draw/plane.h"
#include "draw/raster.h"
#include "draw/values.h"
#include "draw/vector.h"
#include "draw/view.h"
#include "io/netcdf/netcdf_writer.h"
#include "options/domain_option.h"
#include "support/clouds.h"
#include "support/constants.h"
#include "support/pictures.h"
#include "support/text.h"
#include "tools/draw/projections.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <cairo.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::tools;
using Eigen::Vector3d;

namespace {

using Image = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

std::uint32_t pixel(const Image& image, int x, int y) {
  const auto* row = cairo_image_surface_get_data(image.get()) +
                    static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(image.get());
  return reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff;
}

Vector3d on_earth(double longitude, double latitude) {
  return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude)};
}

/// The point on the earth of the middle of a pixel, by the textbook's formulas; none outside the
/// globe, or so near to its limb that a pixel is wide.
std::optional<Vector3d> point_of_pixel(const MapSize& size, Projection projection,
                                       const LonLat& view, double x, double y) {
  const double u = (x + 0.5) / size.width * 2 - 1;
  const double v = 1 - (y + 0.5) / size.height * 2;
  const double lon = view.longitude * degree;
  const double lat = view.latitude * degree;
  if (projection == Projection::plate_carree) {
    return on_earth(lon + u * pi, v * pi / 2);
  }
  const double r = std::hypot(u, v);
  if (r > 0.95) {
    return std::nullopt;
  }
  const double c = std::asin(r); // Snyder, Map Projections, 1987, Eqs. 20-14, 20-15
  const double phi = std::asin(std::cos(c) * std::sin(lat) + v * std::cos(lat));
  return on_earth(lon + std::atan2(u, std::cos(lat) * std::cos(c) - v * std::sin(lat)), phi);
}

/// The shape that contains a point, by its definition: the cell of the nearest site, or the
/// triangle all of whose sides have the point to their left; -1 if rounding leaves it undecided.
class ShapeSearch {
public:
  ShapeSearch(const Mesh& mesh, Shapes shapes)
      : sites_(mesh.points.colwise().normalized()), shapes_(shapes) {
    for (Eigen::Index t = 0; shapes == Shapes::triangles && t < mesh.triangles.cols(); ++t) {
      const Vector3d a = sites_.col(mesh.triangles(0, t));
      const Vector3d b = sites_.col(mesh.triangles(1, t));
      const Vector3d c = sites_.col(mesh.triangles(2, t));
      sides_.push_back({a.cross(b), b.cross(c), c.cross(a)});
    }
  }

  int at(const Vector3d& point) const {
    if (shapes_ == Shapes::cells) {
      int nearest = 0;
      (sites_.transpose() * point).maxCoeff(&nearest);
      return nearest;
    }
    const auto holds = [&](const std::array<Vector3d, 3>& sides) {
      return sides[0].dot(point) > 0 && sides[1].dot(point) > 0 && sides[2].dot(point) > 0;
    };
    const auto found = std::find_if(sides_.begin(), sides_.end(), holds);
    return found == sides_.end() ? -1 : static_cast<int>(found - sides_.begin());
  }

private:
  Points3 sites_;
  Shapes shapes_;
  std::vector<std::array<Vector3d, 3>> sides_;
};

/// A painting in which neighbours differ in colour.
Painting painting_by_number(const Mesh& mesh, Shapes shapes, const LonLat& view) {
  Painting painting;
  painting.scene = make_scene(mesh, shapes, view);
  const Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(
      mesh.points.cols(), 0, static_cast<double>(mesh.points.cols() - 1));
  painting.values = values_of(painting.scene, Colouring::field, numbers);
  painting.widths = widths_of(painting.scene, painting.scene.shapes);
  painting.scale = make_scale(painting.values, Colouring::field);
  if (shapes == Shapes::both) {
    painting.triangle_widths = widths_of(painting.scene, Shapes::triangles);
  }
  return painting;
}

Image raster(const Painting& painting, Projection projection, const MapSize& size) {
  return {raster_map(painting, projection, size), cairo_surface_destroy};
}

Image vector(const Painting& painting, const MapWindow& window, const MapSize& size) {
  Image image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height),
              cairo_surface_destroy);
  cairo_t* context = cairo_create(image.get());
  cairo_translate(context, size.width / 2.0, size.height / 2.0);
  vector_map(context, painting, window, size.width);
  cairo_destroy(context);
  return image;
}

constexpr int near = 2; ///< pixels that a line may reach

/// The shape at each pixel, or -1; with `near` rows beyond either pole, which are on its far side.
Eigen::ArrayXXi shapes_at(const Mesh& mesh, Shapes shapes, Projection projection,
                          const LonLat& view, const MapSize& size) {
  const ShapeSearch search(mesh, shapes);
  Eigen::ArrayXXi result = Eigen::ArrayXXi::Constant(size.width, size.height + 2 * near, -1);
  for (int row = 0; row < result.cols(); ++row) {
    for (int x = 0; x < size.width; ++x) {
      if (const auto point = point_of_pixel(size, projection, view, x, row - near)) {
        result(x, row) = search.at(*point);
      }
    }
  }
  return result;
}

/// Visits all pixels whose surroundings lie in one shape, so that no line touches them; returns
/// their number.
template <class Visit>
int for_each_inner_pixel(const Mesh& mesh, Shapes shapes, Projection projection, const LonLat& view,
                         const MapSize& size, Visit visit) {
  const Eigen::ArrayXXi shape = shapes_at(mesh, shapes, projection, view, size);
  int count = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const int own = shape(x, y + near);
      bool inner = own >= 0;
      for (int dx = -near; inner && dx <= near; ++dx) {
        const int column = (x + dx + size.width) % size.width; // continues beyond the seam
        inner = (shape.row(column).segment(y, 2 * near + 1) == own).all();
      }
      if (inner) {
        visit(x, y, own);
        ++count;
      }
    }
  }
  return count;
}

Rgb colour_of_shape(const Painting& painting, int shape) {
  return painting.scale.colour(painting.values[static_cast<std::size_t>(shape)]);
}

/// Meshes with sites and corners on poles and on the seam, sides along meridians, wide triangles.
std::vector<Mesh> hard_meshes() {
  return {delaunay(random_sphere(60, 5)), delaunay(octahedron()),
          delaunay(lat_lon_sphere(5, 12, true)), delaunay(cubed_sphere(3)),
          delaunay(bisected_icosahedron(0))};
}

} // namespace

TEST_CASE("each pixel has the colour of the cell of the nearest site, or of its triangle") {
  for (const Mesh& mesh : hard_meshes()) {
    for (const Shapes shapes : {Shapes::triangles, Shapes::cells}) {
      for (const Projection projection : all_projections) {
        const bool globe = projection == Projection::globe; // which may be tilted
        for (const LonLat& view :
             {LonLat{0, globe ? 25. : 0.}, LonLat{-77, 0}, LonLat{40, globe ? 90. : 0.}}) {
          CAPTURE(mesh.points.cols());
          CAPTURE(static_cast<int>(shapes));
          CAPTURE(static_cast<int>(projection));
          CAPTURE(view.longitude);
          const MapSize size = map_size(projection, 100);
          const Painting painting = painting_by_number(mesh, shapes, view);
          const Image pixels = raster(painting, projection, size);
          const Image paths = vector(painting, projection, size);
          int wrong_pixels = 0;
          int wrong_paths = 0;
          const auto look = [&](int x, int y, int shape) {
            const Rgb colour = colour_of_shape(painting, shape);
            wrong_pixels += has_colour(pixel(pixels, x, y), colour) ? 0 : 1;
            wrong_paths += has_colour(pixel(paths, x, y), colour) ? 0 : 1;
          };
          CHECK(for_each_inner_pixel(mesh, shapes, projection, view, size, look) > 200);
          CHECK(wrong_pixels == 0);
          CHECK(wrong_paths == 0);
        }
      }
    }
  }
}

TEST_CASE("an enlarged map shows the cells of the nearest sites") {
  const Mesh mesh = delaunay(random_sphere(400, 5));
  const ShapeSearch search(mesh, Shapes::cells);
  for (const MapWindow& window :
       {MapWindow(Projection::globe, 1.2, 0), MapWindow(Projection::globe, 5, 0),
        MapWindow(Projection::plate_carree, 4, 0.7)}) {
    const Projection projection = window.projection;
    const LonLat view = {170, projection == Projection::globe ? 60. : 0.};
    const MapSize size = map_size(projection, 160);
    const Painting painting = painting_by_number(mesh, Shapes::cells, view);
    const Image pixels(raster_map(painting, window, size), cairo_surface_destroy);
    const Image paths = vector(painting, window, size);
    const auto shape_at = [&](double x, double y) {
      const double up = window.middle / pi * size.height;
      const auto point = point_of_pixel(
          size, projection, view,
          (x + 0.5 - size.width / 2.0) / window.zoom + size.width / 2.0 - 0.5,
          (y + 0.5 - size.height / 2.0) / window.zoom + size.height / 2.0 - 0.5 - up);
      return point ? search.at(*point) : -1;
    };
    int wrong = 0, inner = 0;
    for (int x = 0; x < size.width; ++x) {
      for (int y = 0; y < size.height; ++y) {
        const int own = shape_at(x, y);
        if (own >= 0 && shape_at(x - 3, y) == own && shape_at(x + 3, y) == own &&
            shape_at(x, y - 3) == own && shape_at(x, y + 3) == own) {
          ++inner;
          wrong += has_colour(pixel(pixels, x, y), colour_of_shape(painting, own)) ? 0 : 1;
          wrong += has_colour(pixel(paths, x, y), colour_of_shape(painting, own)) ? 0 : 1;
        }
      }
    }
    CHECK(inner > 2000);
    CHECK(wrong < inner / 100); // where three cells meet
  }
}

TEST_CASE("a mesh of a small part of the sphere fills the picture, another one does not") {
  const auto cap = [](double radius, const LonLat& centre) {
    const Points3 all = fibonacci_sphere(4000);
    Points3 inside(3, 4000);
    Eigen::Index count = 0;
    for (const auto& x : all.colwise()) {
      if (x.dot(direction_of(centre)) > std::cos(radius * degree)) {
        inside.col(count++) = x;
      }
    }
    return Points3(inside.leftCols(count));
  };
  for (const LonLat& centre : {LonLat{20, 40}, LonLat{179, -30}, LonLat{0, 90}}) {
    CAPTURE(centre.longitude);
    for (const double radius : {10., 20., 80., 170.}) {
      CAPTURE(radius);
      const View view = view_around({}, {centre}, cap(radius, centre));
      CHECK(view.window.whole() == (radius > 30));
      CHECK(direction_of(view.middle).dot(direction_of(centre)) > std::cos(1.5 * degree));
      if (radius < 30) {
        CHECK(view.window.zoom ==
              doctest::Approx(1 / (1.07 * std::sin(radius * degree))).epsilon(0.2));
      }
    }
    const View flat =
        view_around({.projection = Projection::plate_carree}, {centre}, cap(10, centre));
    CHECK(flat.window.whole() == (centre.latitude == 90));
    CHECK(flat.middle.latitude == 0);
    CHECK(view_around({.zoom = 1}, {centre}, cap(10, centre)).window.whole());
  }
}

TEST_CASE("labels of an enlarged map stand where their degrees are") {
  for (const LonLat& middle : {LonLat{-105, 40}, LonLat{180, -18}, LonLat{0, 90}}) {
    for (const double zoom : {1.6, 5., 300.}) {
      CAPTURE(middle.longitude);
      CAPTURE(zoom);
      const Eigen::Matrix3d frame = frame_of(middle);
      const Degrees degrees = degrees_of({Projection::globe, zoom, 0}, frame);
      CHECK(degrees.lines.size() >= 4);
      CHECK(degrees.labels.size() >= 3);
      CHECK(degrees.labels.size() <= 40);
      for (const DegreeLabel& label : degrees.labels) {
        CAPTURE(label.text);
        Vector3d p;
        REQUIRE(Orthographic::direction(label.point, p));
        p = frame.transpose() * p;
        const double number = std::stod(label.text);
        const bool latitude = label.text.ends_with("N") || label.text.ends_with("S") ||
                              (label.at == DegreeLabel::At::left && middle.latitude < 90);
        const double value = latitude ? std::asin(p.z()) : std::atan2(p.y(), p.x());
        CHECK(std::abs(value) / degree == doctest::Approx(number).epsilon(0.02));
      }
    }
  }
}

TEST_CASE("an enlarged globe tells where its lines are bent, so that labels alone mislead") {
  const auto bent = [](Projection projection, const LonLat& middle, double zoom) {
    return degrees_of({projection, zoom, 0}, frame_of(middle)).bent;
  };
  CHECK(bent(Projection::globe, {18, 42}, 4)); // a meridian runs aside by a tenth of the width
  CHECK(bent(Projection::globe, {0, 90}, 20));
  CHECK(bent(Projection::globe, {0, 0}, 1.6));
  CHECK_FALSE(bent(Projection::globe, {18, 42}, 100));
  CHECK_FALSE(bent(Projection::globe, {-60, 0}, 20));
  CHECK_FALSE(bent(Projection::plate_carree, {18, 0}, 2));
}

TEST_CASE("both: the picture of the cells, except for lines along the triangles' edges") {
  const Mesh mesh = delaunay(random_sphere(60, 5));
  for (const Projection projection : all_projections) {
    const LonLat view = {33, 0};
    const MapSize size = map_size(projection, 200);
    const Image cells = raster(painting_by_number(mesh, Shapes::cells, view), projection, size);
    const Image both = raster(painting_by_number(mesh, Shapes::both, view), projection, size);
    const auto differs = [&](int x, int y) { return pixel(both, x, y) != pixel(cells, x, y); };
    int changed_inside = 0;
    for_each_inner_pixel(mesh, Shapes::triangles, projection, view, size,
                         [&](int x, int y, int) { changed_inside += differs(x, y) ? 1 : 0; });
    CHECK(changed_inside == 0);
    int changed = 0;
    for (int at = 0; at < size.width * size.height; ++at) {
      changed += differs(at % size.width, at / size.width) ? 1 : 0;
    }
    CHECK(changed > 500);
  }
}

TEST_CASE("a field of the sphere is evaluated at each pixel, on both maps") {
  // Smooth, and without symmetry.
  const auto values = [](const Points3& x) -> Eigen::VectorXd {
    return (x.row(0) + 0.5 * x.row(1) - 0.7 * x.row(2)).transpose();
  };
  for (const Projection projection : all_projections) {
    for (const LonLat& view : {LonLat{0, 0}, LonLat{100, 0}}) {
      FieldPainting painting = {values, {}, frame_of(view)};
      painting.scale = make_scale({-1.4, 1.4}, Colouring::density);
      const MapSize size = map_size(projection, 240);
      const Image image(raster_map(painting, projection, size), cairo_surface_destroy);
      int wrong = 0;
      for (int at = 0; at < size.width * size.height; at += 7) {
        const int x = at % size.width;
        const int y = at / size.width;
        if (const auto point = point_of_pixel(size, projection, view, x, y)) {
          const Rgb colour = painting.scale.colour(values(*point)[0]);
          wrong += has_colour(pixel(image, x, y), colour) ? 0 : 1;
        }
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("a graticule changes only the map") {
  const Folder folder;
  const Mesh mesh = delaunay(random_sphere(60, 5));
  for (const int size : {100, 300}) {
    DrawOptions options = {.look = {.projection = Projection::plate_carree, .size = size}};
    draw(folder.file("a.png"), mesh, options);
    options.look.graticule = true;
    draw(folder.file("b.png"), mesh, options);
    const Picture without(folder.file("a.png"));
    const Picture with(folder.file("b.png"));
    REQUIRE(with.height() == without.height());
    int inside = 0;
    int beside = 0;
    for (int y = 0; y < with.height(); ++y) {
      for (int x = 0; x < with.width(); ++x) {
        if (with.at(x, y) != without.at(x, y)) {
          ++inside;
          beside += without.at(x, y) == 0xffffff ? 1 : 0;
        }
      }
    }
    CHECK(inside > size);
    CHECK(beside == 0);
  }
}

TEST_CASE("a parallel meets the rim of a globe at its latitude, on the left, or not at all") {
  for (const double latitude : {-60., -30., 0., 30., 60.}) {
    for (const LonLat& view : {LonLat{15, 25}, LonLat{-100, -80}, LonLat{70, 0}, LonLat{0, 90}}) {
      CAPTURE(latitude);
      CAPTURE(view.latitude);
      const std::optional<MapPoint> point = rim_point(view, latitude);
      // Seen from a pole, the equator is the rim.
      CHECK(point.has_value() ==
            (latitude == 0 || std::abs(latitude) < 90 - std::abs(view.latitude)));
      if (point) {
        const Vector3d rim(point->u, point->v, 0);
        CHECK(rim.norm() == doctest::Approx(1));
        CHECK(rim.x() < 0);
        const Vector3d on_earth = frame_of(view).transpose() * rim;
        CHECK(std::asin(on_earth.z()) == doctest::Approx(latitude * degree));
      }
    }
  }
}

TEST_CASE("the labels of a globe's latitudes stand outside its rim and inside the page") {
  const Folder folder;
  const SphereField field = {
      [](const Points3& x) -> Eigen::VectorXd { return x.row(2).transpose(); }, "", ""};
  for (const int size : {300, 1200}) {
    Look look = {.view = LonLat{0, 0}, .graticule = true, .size = size};
    draw(folder.file("a.png"), field, look);
    const Picture picture(folder.file("a.png"));
    const Page page = page_of(look, true);
    int beside = 0;
    for (int y = static_cast<int>(page.text * 2.6); y < page.legend_top - page.text; ++y) {
      CHECK(picture.at(1, y) == 0xffffff);
      CHECK(picture.at(size - 2, y) == 0xffffff);
      for (int x = 0; x < page.middle_x; ++x) {
        const double r = std::hypot(x + 0.5 - page.middle_x, y + 0.5 - page.middle_y);
        beside += r > page.map.width / 2.0 + 3 && picture.at(x, y) != 0xffffff ? 1 : 0;
      }
    }
    CHECK(beside > 5 * page.text); // five labels
  }
}

// ---- Fields of files

namespace {

constexpr int cells = 42;

/// A file with a field of each kind: values 10, 11, ...; -9, 2, 3 ..., where -9 is a fill value;
/// and such that are none.
void write_sample_fields(const std::string& path) {
  using namespace io_detail;
  NetcdfWriter file(path);
  const int n = file.dimension("nCells", cells);
  const int other = file.dimension("nEdges", 120);
  const int time = file.dimension("Time", 1);
  const int depth = file.variable("depth", NetcdfType::float64, {n},
                                  {{"units", "m"}, {"long_name", "depth of the sea"}});
  const int index = file.variable("index", NetcdfType::int32, {time, n}, {{"_FillValue", -9}});
  const int edges = file.variable("edges", NetcdfType::float64, {other});
  const int pairs = file.variable("pairs", NetcdfType::float64, {n, other});
  file.begin();
  file.put(depth, [](std::int64_t begin, std::int64_t end, double* out) {
    for (std::int64_t i = begin; i < end; ++i)
      *out++ = 10 + static_cast<double>(i);
  });
  file.put(index, [](std::int64_t, std::int64_t, std::int32_t* out) {
    for (int i = 0; i < cells; ++i)
      out[i] = i == 0 ? -9 : i + 1;
  });
  const auto zeros = [](std::int64_t row) {
    return [row](std::int64_t begin, std::int64_t end, double* out) {
      std::fill_n(out, (end - begin) * row, 0.0);
    };
  };
  file.put(edges, zeros(1));
  file.put(pairs, zeros(120));
  file.commit();
}

} // namespace

TEST_CASE("a field of a file has its values, name and units; a fill value becomes NaN") {
  const Folder folder;
  write_sample_fields(folder.file("a.nc"));
  const CellField depth = read_cell_field(folder.file("a.nc"), "depth", cells);
  CHECK(depth.values == Eigen::VectorXd::LinSpaced(cells, 10, 10 + cells - 1));
  CHECK(depth.units == "m");
  CHECK(depth.long_name == "depth of the sea");
  const CellField index = read_cell_field(folder.file("a.nc"), "index", cells);
  CHECK(std::isnan(index.values[0]));
  CHECK(index.values.tail(cells - 1) == Eigen::VectorXd::LinSpaced(cells - 1, 2, cells));
  CHECK(index.units.empty());
}

TEST_CASE("an unknown field is refused with the names of the fields in the file") {
  const Folder folder;
  const std::string path = folder.file("a.nc");
  write_sample_fields(path);
  const auto message = [&](const std::string& name, std::int64_t count) {
    const Error error = error_of([&] { read_cell_field(path, name, count); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    return std::string(error.what());
  };
  CHECK(message("deep", cells) == path + ": no variable deep; there are depth, index, pairs");
  CHECK(message("edges", cells) ==
        path +
            ": edges has 120 values, not one for each of 42 cells; there are depth, index, pairs");
  CHECK(message("pairs", cells) == path + ": pairs has several numbers for each cell: nEdges "
                                          "(120); choose one index of each: nEdges=0");
  CHECK(message("depth", 41) == path + ": depth has 42 values, not one for each of 41 cells; no "
                                       "variable of the file has: give the "
                                       "mesh of these fields");
}

TEST_CASE("each cell shows its own value of a field, and every cell is painted") {
  const Folder folder;
  const Mesh mesh = delaunay(fibonacci_sphere(cells));
  write_sample_fields(folder.file("a.nc"));
  const CellField field = read_cell_field(folder.file("a.nc"), "index", cells);
  const Scene scene = make_scene(mesh, Shapes::cells, {});
  const std::vector<double> values = values_of(scene, Colouring::field, field.values);
  CHECK(std::isnan(values[0]));
  for (std::size_t i = 1; i < values.size(); ++i) {
    CHECK(values[i] == field.values[static_cast<Eigen::Index>(i)]);
  }
  const Scene triangles = make_scene(mesh, Shapes::triangles, {});
  const std::vector<double> means = values_of(triangles, Colouring::field, field.values);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const auto id = mesh.triangles.col(t);
    const double mean = (field.values[id[0]] + field.values[id[1]] + field.values[id[2]]) / 3;
    CHECK((std::isnan(mean) ? std::isnan(means[static_cast<std::size_t>(t)])
                            : means[static_cast<std::size_t>(t)] == mean));
  }
  DrawOptions options = {
      .look = {.size = 200}, .shapes = Shapes::cells, .colouring = Colouring::field};
  options.field = field;
  options.field_name = "index";
  draw(folder.file("a.png"), mesh, options);
  CHECK(folder.count() == 2);
}

// ---- The plane

namespace {

/// A rectangle of 2 x 1 with a hole.
Surface holed() {
  const Surface box = rectangle({0, 0}, {2, 1});
  Surface::Rings rings = box.rings();
  Points2 hole(2, 4);
  hole << 0.8, 1.2, 1.2, 0.8, 0.4, 0.4, 0.6, 0.6;
  rings.emplace_back(hole);
  return Surface::plane().within(std::move(rings));
}

struct PlaneCase {
  Mesh mesh;
  Surface part;  ///< where cells are drawn
  double margin; ///< of the window around it
};

/// Sites whose hull is an octagon that touches the sides of a rectangle of 2 x 1.
PlaneCase case_of_hull() {
  Points2 corners(2, 8);
  corners << 0, 0.5, 1.5, 2, 2, 1.5, 0.5, 0, 0.3, 0, 0, 0.3, 0.7, 1, 1, 0.7;
  const Surface octagon = Surface::plane().within({corners});
  Points3 points = Points3::Zero(3, 80);
  points.leftCols(72) = random_points(72, octagon, {}, 4);
  points.rightCols(8).topRows<2>() = corners;
  return {delaunay(points, Surface::plane()), octagon, 0.08};
}

std::vector<PlaneCase> plane_cases() {
  const Surface box = Surface::periodic({2, 1});
  return {{delaunay(random_points(80, holed(), {}, 2), holed()), holed(), 0.02},
          {delaunay(random_points(80, box, {}, 3), box), box, 0},
          case_of_hull()};
}

DrawOptions coloured_by_number(const Mesh& mesh, Shapes shapes) {
  DrawOptions options;
  options.look.size = 600;
  options.shapes = shapes;
  options.colouring = Colouring::field;
  options.field.values = Eigen::VectorXd::LinSpaced(mesh.points.cols(), 1, 2);
  options.field_name = "number";
  return options;
}

/// The same colour, up to the rounding to bytes.
bool alike(std::uint32_t a, std::uint32_t b) {
  const auto channel = [](std::uint32_t rgb, int shift) { return int(rgb >> shift & 0xff); };
  return std::abs(channel(a, 16) - channel(b, 16)) <= 1 &&
         std::abs(channel(a, 8) - channel(b, 8)) <= 1 &&
         std::abs(channel(a, 0) - channel(b, 0)) <= 1;
}

/// The site nearest to a point, and how much farther the next one is.
struct Nearest {
  Eigen::Index site;
  double lead;
};

Nearest nearest(const PlaneCase& c, const Eigen::Vector2d& point) {
  Eigen::VectorXd distances(c.mesh.points.cols());
  for (Eigen::Index i = 0; i < distances.size(); ++i) {
    Eigen::Vector2d way = c.mesh.points.col(i).head<2>() - point;
    for (int k = 0; k < 2 && c.mesh.surface.is_box(); ++k)
      way[k] = std::remainder(way[k], c.mesh.surface.period()[k]);
    distances[i] = way.norm();
  }
  Eigen::Index site = 0;
  const double least = distances.minCoeff(&site);
  distances[site] = 1e9;
  return {site, distances.minCoeff() - least};
}

} // namespace

TEST_CASE("a plane's cells are those of the nearest sites, cut off at the domain or the hull") {
  const Folder folder;
  for (const PlaneCase& c : plane_cases()) {
    const DrawOptions options = coloured_by_number(c.mesh, Shapes::cells);
    draw(folder.file("plane.png"), c.mesh, options);
    const Picture picture(folder.file("plane.png"));
    const double width = 2 + 2 * c.margin, height = 1 + 2 * c.margin;
    const Page page = page_of_plane(600, height / width, true);
    REQUIRE(picture.width() == page.width);
    REQUIRE(picture.height() == page.height);
    const Eigen::VectorXd& values = options.field.values;
    const Scale scale =
        make_scale({values.data(), values.data() + values.size()}, Colouring::field);
    const double unit = page.map.width / width; // pixels
    int seen = 0, beyond = 0;
    for (int y = 0; y < page.map.height; y += 3)
      for (int x = 0; x < page.map.width; x += 3) {
        const Eigen::Vector2d point((x + 0.5) / unit - c.margin, 1 + c.margin - (y + 0.5) / unit);
        const int px = static_cast<int>(page.middle_x - page.map.width / 2.0) + x,
                  py = static_cast<int>(page.middle_y - page.map.height / 2.0) + y;
        const auto inside = [&](double dx, double dy) {
          return c.part.contains({point.x() + dx / unit, point.y() + dy / unit, 0});
        };
        const int around = inside(3, 3) + inside(-3, 3) + inside(3, -3) + inside(-3, -3);
        if (around == 0) {
          ++beyond;
          CHECK(picture.at(px, py) == 0xffffff);
        } else if (const Nearest near = nearest(c, point); around == 4 && near.lead > 6 / unit) {
          ++seen;
          CHECK(alike(picture.at(px, py), packed(scale.colour(values[near.site]))));
        }
      }
    CHECK(seen > 5000);
    CHECK((beyond > 50) == !c.mesh.surface.is_box());
  }
}

TEST_CASE("a plane's pictures are written in every format, shape and colouring") {
  const Folder folder;
  for (const PlaneCase& c : plane_cases())
    for (const Shapes shapes : {Shapes::triangles, Shapes::cells, Shapes::both, Shapes::points})
      for (const Colouring colouring :
           {Colouring::spacing, Colouring::angle, Colouring::valence, Colouring::area,
            Colouring::quality, Colouring::density, Colouring::field, Colouring::none}) {
        DrawOptions options = coloured_by_number(c.mesh, shapes);
        options.colouring = colouring;
        options.density = tanh_bump({0.5, 0.5, 0}, 0.3, 0.2, 0.1);
        options.look.size = 200;
        const bool of_cells = colouring == Colouring::area || colouring == Colouring::quality;
        if (of_cells && shapes != Shapes::triangles && !c.mesh.closed()) {
          const Error error = error_of([&] { draw(folder.file("a.png"), c.mesh, options); });
          CHECK(has(error.what(), "open boundary"));
          continue;
        }
        Mesh mesh = c.mesh;
        if (!mesh.closed())
          mesh.surface = Surface::plane();
        for (const std::string name : {"a.png", "a.svg", "a.pdf"}) {
          draw(folder.file(name), mesh, options);
          CHECK(bytes_of(folder.file(name)).size() > 1000);
        }
      }
  const Mesh mesh = plane_cases().front().mesh;
  DrawOptions options = coloured_by_number(mesh, Shapes::cells);
  options.field.values.resize(3);
  CHECK(code_of([&] { draw(folder.file("b.png"), mesh, options); }) == ErrorCode::invalid_argument);
  options.colouring = Colouring::density;
  options.density.kind = Density::Kind::maximum; // of no bumps
  CHECK(code_of([&] { draw(folder.file("b.png"), mesh, options); }) == ErrorCode::invalid_argument);
  CHECK(!fs::exists(folder.file("b.png")));
}

namespace {

/// Pixels of a map that are black, and points at which they are.
struct Dots {
  int black = 0, seen = 0;
};

Dots dots_in(const std::string& path, const Page& page,
             const std::vector<Eigen::Vector2d>& points) {
  const Picture picture(path);
  REQUIRE(picture.width() == page.width);
  Dots dots;
  for (int y = static_cast<int>(page.middle_y) - page.map.height / 2;
       y < static_cast<int>(page.middle_y) + page.map.height / 2; ++y)
    for (int x = 0; x < picture.width(); ++x)
      dots.black += (picture.at(x, y) & 0xff) < 0x80;
  for (const Eigen::Vector2d& point : points)
    dots.seen += (picture.at(static_cast<int>(page.middle_x + point.x()),
                             static_cast<int>(page.middle_y - point.y())) &
                  0xff) < 0x80;
  return dots;
}

} // namespace

TEST_CASE("points are black dots of one size at the sites, on white") {
  const Folder folder;
  DrawOptions options;
  options.look.size = 600;
  options.look.coastlines = false;
  options.shapes = Shapes::points;
  options.colouring = Colouring::none;
  std::vector<Eigen::Vector2d> points;
  Dots dots;
  const auto check = [&](std::size_t count) {
    CHECK(dots.seen == static_cast<int>(count));
    const double area = static_cast<double>(dots.black) / static_cast<double>(count);
    CHECK(area > 3); // pixels of each dot
    CHECK(area < 200);
  };
  for (const PlaneCase& c : {plane_cases()[0], plane_cases()[2]}) {
    draw(folder.file("a.png"), c.mesh, options);
    const double width = 2 + 2 * c.margin;
    const Page page = page_of_plane(600, (1 + 2 * c.margin) / width, false);
    points.clear();
    for (Eigen::Index i = 0; i < c.mesh.points.cols(); ++i)
      points.emplace_back(page.map.width / width *
                          (c.mesh.points.col(i).head<2>() - Eigen::Vector2d(1, 0.5)));
    dots = dots_in(folder.file("a.png"), page, points);
    if (!c.mesh.surface.is_bounded())
      check(points.size());
    else
      CHECK(dots.seen == 80); // its boundary is black, too
  }
  const Mesh globe = delaunay(fibonacci_sphere(500));
  options.look.view = LonLat{0, 90};
  draw(folder.file("a.png"), globe, options);
  const Page page = page_of(options.look, false);
  points.clear();
  for (Eigen::Index i = 0; i < globe.points.cols(); ++i)
    if (const Eigen::Vector3d p = globe.points.col(i); p.z() > 0.2) // x is down, y right
      points.emplace_back(page.map.width / 2.0 * Eigen::Vector2d(p.y(), -p.x()));
  dots = dots_in(folder.file("a.png"), page, points);
  check(points.size());
}

TEST_CASE("nothing is drawn beyond the triangles of a plane, whose boundary may be concave") {
  const Folder folder;
  std::ofstream(folder.file("l.off")) // an L
      << "OFF\n6 4 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n"
         "3 0 1 3\n3 1 2 3\n3 0 3 5\n3 3 4 5\n";
  const Mesh mesh = read_mesh(folder.file("l.off"));
  REQUIRE(mesh.triangles.cols() == 4);
  for (const Shapes shapes : {Shapes::triangles, Shapes::cells}) {
    draw(folder.file("l.png"), mesh, coloured_by_number(mesh, shapes));
    const Picture picture(folder.file("l.png"));
    const Page page = page_of_plane(600, 1, true);
    const double unit = page.map.width / 2.16; // pixels
    const auto at = [&](double x, double y) {
      return picture.at(static_cast<int>(page.middle_x + unit * (x - 1)),
                        static_cast<int>(page.middle_y - unit * (y - 1)));
    };
    CHECK(at(1.5, 1.5) == 0xffffff);
    CHECK(at(-0.05, 1) == 0xffffff);
    CHECK(at(1.5, 0.6) != 0xffffff);
    CHECK(at(0.4, 1.9) != 0xffffff);
  }
}

TEST_CASE("a domain of another period is not one of the mesh") {
  for (const PlaneCase& c : plane_cases())
    for (const Surface& domain : {holed(), Surface::periodic({2, 1}), Surface::periodic({2, 2})}) {
      Mesh mesh = c.mesh;
      if (domain.period() == mesh.surface.period()) {
        set_surface(mesh, domain);
        CHECK(mesh.surface == domain);
      } else {
        CHECK(code_of([&] { set_surface(mesh, domain); }) == ErrorCode::invalid_argument);
        CHECK(mesh.surface == c.mesh.surface);
      }
    }
}
