// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/draw.h"

#include "draw/legend_of.h"
#include "draw/markers.h"
#include "draw/page.h"
#include "draw/painting.h"
#include "draw/picture.h"
#include "draw/plane.h"
#include "draw/raster.h"
#include "draw/text.h"
#include "draw/title.h"
#include "draw/values.h"
#include "draw/vector.h"
#include "draw/view.h"
#include "text/text.h"

#include <calotte/generators.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calotte::tools {

namespace {

constexpr std::int64_t most_paths = 30000;     ///< a vector file with more shapes opens slowly
constexpr std::int64_t field_samples = 100000; ///< whose extremes define the colour bar

bool has_boundary(const Mesh& mesh) { return (mesh.neighbours.array() < 0).any(); }

std::string title_of(const Scene& scene, const DrawOptions& options) {
  const Mesh& mesh = *scene.mesh;
  const std::string parts =
      counts_of(mesh, options.shapes) + (has_boundary(mesh) ? ", open boundary" : "");
  return mesh_title(options, parts, "spacing", mean_distances(scene));
}

std::string field_caption(const DrawOptions& options) {
  const CellField& field = options.field;
  return unmarked(options.field_name) +
         (field.long_name.empty() ? "" : ": " + unmarked(field.long_name)) +
         (is_unit(field.units) ? ", " + unit_text(field.units) : "");
}

/// \param mean of the values.
std::string caption_of(const DrawOptions& options, double mean, bool plane) {
  const bool cells = options.shapes != Shapes::triangles;
  const std::string corners = cells ? "" : ", mean of the corners";
  switch (options.colouring) {
  case Colouring::spacing:
    return std::string(cells ? "mean distance to the neighbours" : "mean side of the triangle") +
           (plane                            ? ""
            : options.unit.name == "degrees" ? ", degrees (1\u00b0 = 0.01745 radians)"
                                             : ", " + options.unit.name);
  case Colouring::angle:
    return cells ? "smallest angle around the site, degrees"
                 : "smallest angle of the triangle, degrees";
  case Colouring::valence:
    return cells ? "neighbours of the site: cells of each kind"
                 : "neighbours of the corner furthest from 6: triangles of each kind";
  case Colouring::area:
    return std::string("area of the ") + (cells ? "cell" : "triangle") + " over the mean, " +
           (plane ? number_text(mean, 3)
                  : number_text(options.unit.of_steradian * mean, 3) + " " + options.unit.area);
  case Colouring::quality:
    return cells ? "shortest over longest side of the cell"
                 : "quality of the triangle: 1 when equilateral";
  case Colouring::density:
    return "density over its greatest at a site" + corners;
  case Colouring::field:
    return field_caption(options) + corners;
  case Colouring::region:
    return "bdyMaskCell: in the region 0, relaxation zone 1 to 5, specified zone 6 and 7";
  case Colouring::none:
    break;
  }
  return {};
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  double count = 0;
  for (const double value : values) {
    if (!std::isnan(value)) {
      sum += value;
      ++count;
    }
  }
  return sum / std::max(count, 1.0);
}

} // namespace

Legend make_legend(Painting& painting, const DrawOptions& options) {
  constexpr double degrees = 180 / std::numbers::pi;
  const bool flat = painting.scene.flat;
  const bool lengths = options.colouring == Colouring::spacing && !flat;
  const bool angles = options.colouring == Colouring::angle;
  const double mean = mean_of(painting.values);
  const double unit = options.colouring == Colouring::area ? 1 / mean
                      : lengths                            ? options.unit.of_radian
                      : angles                             ? degrees
                                                           : 1;
  std::for_each(painting.values.begin(), painting.values.end(), [unit](double& v) { v *= unit; });
  painting.scale = make_scale(painting.values, options.colouring, options.look);
  painting.scale.degrees = angles || (lengths && options.unit.name == "degrees");
  return {painting.scale, classes_of(painting.values, options.colouring),
          caption_of(options, mean, flat)};
}

namespace {

/// \throws Error invalid_argument unless the field has one value for each site.
void require_field(const DrawOptions& options, std::int64_t sites) {
  if (options.field.values.size() != sites) {
    refuse(message("{} has {} values for {} sites; give a field of the mesh's cells",
                   options.field_name, options.field.values.size(), sites));
  }
}

/// A density is periodic in a box only.
DoubleVector density_at_sites(const Mesh& mesh, const Density& density) {
  if (!mesh.surface.is_sphere()) {
    return evaluate(density, mesh.points, mesh.closed() ? mesh.surface : Surface::plane());
  }
  Points3 sites(3, mesh.points.cols());
  for (Eigen::Index i = 0; i < sites.cols(); ++i) {
    sites.col(i) = direction_of(Eigen::Vector3d(mesh.points.col(i)));
  }
  return evaluate(density, sites);
}

} // namespace

DoubleVector by_site(const Mesh& mesh, const DrawOptions& options) {
  if (options.colouring == Colouring::field || options.colouring == Colouring::region) {
    require_field(options, mesh.points.cols());
    return options.field.values;
  }
  if (options.colouring != Colouring::density) {
    return {};
  }
  const DoubleVector rho = density_at_sites(mesh, options.density);
  const double greatest = rho.maxCoeff();
  if (!(greatest > 0)) {
    refuse("the density is zero at every site; give one that is positive somewhere");
  }
  return rho / greatest;
}

namespace {

constexpr LonLat usual_middle = {15, 25};

View view_of_mesh(const DrawOptions& options, const Mesh& mesh) {
  if (!has_boundary(mesh)) {
    return view_of(options.look, usual_middle);
  }
  const bool cells = options.cells != nullptr && options.shapes != Shapes::triangles;
  return view_around(options.look, middle(mesh), cells ? options.cells->corners : mesh.points);
}

/// \throws Error invalid_argument unless there is a cell for each site.
void require_cells(const DrawOptions& options, const Mesh& mesh) {
  if (options.cells != nullptr && options.cells->size() != mesh.points.cols()) {
    refuse(message("there are {} cells for {} sites; give the cells of the mesh",
                   options.cells->size(), mesh.points.cols()));
  }
}

Painting make_painting(const Mesh& mesh, const DrawOptions& options, const LonLat& view) {
  Painting painting;
  painting.scene = make_scene(mesh, options.shapes, view, options.cells);
  painting.values = values_of(painting.scene, options.colouring, by_site(mesh, options));
  painting.widths = widths_of(painting.scene, painting.scene.shapes);
  if (options.shapes == Shapes::both) {
    painting.triangle_widths = widths_of(painting.scene, Shapes::triangles);
  }
  painting.of_points = options.shapes == Shapes::points;
  if (options.colouring == Colouring::valence) {
    painting.markers = markers_of(painting.scene, site_valences(painting.scene),
                                  widths_of(painting.scene, Shapes::cells));
  }
  return painting;
}

/// The values of cells of any shape.
std::vector<double> polygon_values(const Polygons& polygons, const DrawOptions& options) {
  const auto by_cell = [](const DoubleVector& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  switch (options.colouring) {
  case Colouring::area:
    return by_cell(areas(polygons));
  case Colouring::field:
  case Colouring::region:
    require_field(options, polygons.size());
    return by_cell(options.field.values);
  case Colouring::valence:
  case Colouring::none: {
    std::vector<double> sides;
    for (std::int64_t i = 0; i < polygons.size(); ++i) {
      sides.push_back(static_cast<double>(polygons.ids.count(i)));
    }
    return sides;
  }
  default:
    refuse("the cells are not Voronoi cells, which alone have that "
           "colouring; colour them by area, valence, field:NAME or "
           "none");
  }
}

/// A vector file may be printed at any size: its image gets twice the pixels.
MapSize image_size(cairo_t* context, const MapSize& map) {
  const bool raster_page =
      cairo_surface_get_type(cairo_get_target(context)) == CAIRO_SURFACE_TYPE_IMAGE;
  const int scale = raster_page || map.width > 8192 ? 1 : 2;
  return {scale * map.width, scale * map.height};
}

void paint_mesh(cairo_t* context, const Page& page, const Painting& painting,
                const MapWindow& window, bool paths) {
  if (painting.of_points) {
    draw_points(context, painting, window, page.map.width, point_radius(page));
    return;
  }
  if (paths) {
    vector_map(context, painting, window, page.map.width);
  } else {
    paint_image(context, page.map, raster_map(painting, window, image_size(context, page.map)));
  }
  draw_markers(context, painting, window, page.map.width, marker_radius(page));
}

/// Writes a page with a map of the sphere.
/// \param paint draws the map, of the window, around the origin.
void write_map(const std::string& path, const Look& asked, const View& view,
               const Eigen::Matrix3d& frame, const std::string& title, const Legend& legend,
               const std::function<void(cairo_t*, const Page&)>& paint) {
  Look look = asked;
  look.view = view.middle;
  const Page page = page_of(look, legend.scale.colouring != Colouring::none, view.window);
  write_picture(path, page.width, page.height, [&](cairo_t* context) {
    draw_page(context, page, {look, frame, title, legend, view.window},
              [&] { paint(context, page); });
  });
}

void draw_painting(const std::string& path, Painting& painting, const DrawOptions& options,
                   const View& view, const std::string& title) {
  const Legend legend = make_legend(painting, options);
  const bool paths = picture_format(path) != PictureFormat::png &&
                     visible_shapes(painting, view.window) <= most_paths;
  write_map(path, options.look, view, painting.scene.frame, title, legend,
            [&](cairo_t* context, const Page& page) {
              paint_mesh(context, page, painting, view.window, paths);
            });
}

void draw_sphere(const std::string& path, const Mesh& mesh, const DrawOptions& options) {
  const View view = view_of_mesh(options, mesh);
  Painting painting = make_painting(mesh, options, view.middle);
  draw_painting(path, painting, options, view, title_of(painting.scene, options));
}

} // namespace

void draw(const std::string& path, const Mesh& mesh, const DrawOptions& options) {
  require_picture(path, options.look.size);
  require_cells(options, mesh);
  if (mesh.surface.is_sphere()) {
    draw_sphere(path, mesh, options);
  } else {
    draw_plane(path, mesh, options);
  }
}

void draw(const std::string& path, const Polygons& polygons, const DrawOptions& asked) {
  require_picture(path, asked.look.size);
  DrawOptions options = asked;
  options.shapes = Shapes::cells;
  if (options.colouring == Colouring::spacing) {
    options.colouring = Colouring::area;
  }
  const View view = view_around(options.look, usual_middle, polygons.corners);
  Painting painting;
  painting.scene = make_scene(polygons, view.middle);
  painting.values = polygon_values(polygons, options);
  painting.widths = widths_of(painting.scene, Shapes::cells);
  if (options.colouring == Colouring::valence) {
    painting.markers = markers_of(painting.scene, painting.values, painting.widths);
  }
  const std::string title = mesh_title(options, grouped(polygons.size()) + " cells", "width",
                                       {painting.widths.begin(), painting.widths.end()});
  draw_painting(path, painting, options, view, title);
}

void draw(const std::string& path, const SphereField& field, const Look& look) {
  require_picture(path, look.size);
  const View view = view_of(look, usual_middle);
  const DoubleVector samples = field.values(fibonacci_sphere(field_samples));
  const Scale scale =
      make_scale({samples.data(), samples.data() + samples.size()}, Colouring::density, look);
  const FieldPainting painting = {field.values, scale, frame_of(view.middle)};
  write_map(path, look, view, painting.frame,
            unmarked(look.title.empty() ? field.title : look.title), {scale, {}, field.caption},
            [&](cairo_t* context, const Page& page) {
              paint_image(context, page.map,
                          raster_map(painting, view.window, image_size(context, page.map)));
            });
}

} // namespace calotte::tools
