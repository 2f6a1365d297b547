// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/plane.h"

#include "draw/legend_of.h"
#include "draw/markers.h"
#include "draw/page.h"
#include "draw/picture.h"
#include "draw/text.h"
#include "draw/title.h"
#include "draw/values.h"
#include "draw/vector.h"

#include <calotte/error.h>
#include <calotte/quality.h>
#include <calotte/surface.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace calotte::tools {

namespace {

using Eigen::Vector2d;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Omits lines of triangles with a far site.
void hide_far_triangles(const Drawn& drawn, std::vector<float>& widths) {
  for (std::size_t t = 0; t < widths.size(); ++t) {
    for (const std::int32_t place : drawn.mesh.triangles.col(static_cast<Eigen::Index>(t))) {
      if (drawn.site[static_cast<std::size_t>(place)] < 0) {
        widths[t] = 0;
      }
    }
  }
}

/// Whose cells lack a neighbour.
std::vector<bool> sites_at_walls(const Mesh& mesh) {
  std::vector<bool> at_wall(static_cast<std::size_t>(mesh.points.cols()), true);
  for (const std::int32_t site : mesh.triangles.reshaped()) {
    at_wall[static_cast<std::size_t>(site)] = false;
  }
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    for (int i = 0; i < 3; ++i) {
      for (int end = 1; mesh.neighbours(i, t) < 0 && end < 3; ++end) {
        at_wall[static_cast<std::size_t>(mesh.triangles((i + end) % 3, t))] = true;
      }
    }
  }
  return at_wall;
}

/// Whose cells the boundary clips. Without one, the box around the sites does.
std::vector<bool> sites_at_boundary(const Mesh& mesh) {
  if (has_walls(mesh)) {
    return sites_at_walls(mesh);
  }
  if (mesh.surface.is_bounded()) {
    return clipped_cells(mesh);
  }
  Mesh boxed;
  boxed.points = mesh.points;
  boxed.surface = rectangle(mesh.points.topRows<2>().rowwise().minCoeff(),
                            mesh.points.topRows<2>().rowwise().maxCoeff());
  return clipped_cells(boxed);
}

Painting make_painting(const Mesh& mesh, const Drawn& drawn, const DrawOptions& options,
                       const Surface& part, const Window& window) {
  Painting painting;
  painting.scene = scene_of(drawn, options.shapes, window);
  std::vector<bool> clipped;
  if (options.colouring == Colouring::valence && !mesh.closed()) {
    clipped = sites_at_boundary(mesh);
  }
  if (options.shapes == Shapes::triangles) {
    painting.values = values_of_triangles(mesh, options, clipped, drawn, painting.scene, window);
  } else {
    const std::vector<double> values =
        values_of_cells(mesh, options, part, clipped, painting.scene, window);
    for (const std::int32_t site : drawn.site) {
      painting.values.push_back(site < 0 ? nothing : values[static_cast<std::size_t>(site)]);
    }
  }
  painting.widths = widths_of(painting.scene, painting.scene.shapes);
  if (options.shapes == Shapes::both) {
    painting.triangle_widths = widths_of(painting.scene, Shapes::triangles);
    hide_far_triangles(drawn, painting.triangle_widths);
  }
  if (options.colouring == Colouring::valence) {
    std::vector<double> valences = site_valences(painting.scene, by_place(drawn, clipped));
    valences.resize(static_cast<std::size_t>(mesh.points.cols())); // without copies and far sites
    painting.markers =
        markers_of(painting.scene, valences, widths_of(painting.scene, Shapes::cells));
  }
  return painting;
}

/// The values of the mesh's own shapes, without those of copies beside the period: cells of its
/// sites, and triangles with their middle within the window.
std::vector<double> own_values(const Mesh& mesh, const Painting& painting, const Drawn& drawn,
                               const Window& window) {
  std::vector<double> values;
  for (std::size_t i = 0; i < painting.values.size(); ++i) {
    const auto shape = static_cast<Eigen::Index>(i);
    if (painting.scene.shapes == Shapes::triangles) {
      Vector2d sum = Vector2d::Zero();
      for (const std::int32_t place : drawn.mesh.triangles.col(shape)) {
        sum += drawn.mesh.points.col(place).head<2>();
      }
      const auto inside =
          sum.array() / 3 >= window.low.array() && sum.array() / 3 < window.high.array();
      if (!(mesh.surface.period().array() == 0 || inside).all()) {
        continue;
      }
    } else if (shape >= mesh.points.cols()) {
      break;
    }
    values.push_back(painting.values[i]);
  }
  return values;
}

/// The spacing is that of the cells for triangles too, as some of these reach across bays.
std::string title_of(const Mesh& mesh, const DrawOptions& asked, const Surface& part,
                     const Window& window) {
  DrawOptions options = asked;
  options.colouring = Colouring::spacing;
  const Drawn drawn = drawn_of(mesh, Shapes::cells, window);
  const Scene scene = scene_of(drawn, Shapes::cells, window);
  const std::string parts =
      grouped(mesh.points.cols()) + " cells" +
      (options.shapes == Shapes::triangles ? ", " + grouped(mesh.triangles.cols()) + " triangles"
                                           : "") +
      (mesh.surface.period().maxCoeff() > 0 ? ", periodic" : "");
  return mesh_title(options, parts, "spacing",
                    values_of_cells(mesh, options, part, {}, scene, window), true);
}

// ---- The map

void add_window(cairo_t* context, const Window& window, double scale) {
  const Vector2d extent = scale * window.extent();
  cairo_rectangle(context, -extent.x() / 2, -extent.y() / 2, extent.x(), extent.y());
}

/// The rings of a part of the plane, or the window's sides, as a path.
void add_outline(cairo_t* context, const Surface& part, const Window& window, double scale) {
  if (!part.is_bounded()) {
    add_window(context, window, scale);
  }
  for (const DoubleMatrix& ring : part.rings()) {
    cairo_new_sub_path(context);
    for (const auto& corner : ring.colwise()) {
      const Vector2d place = scale * (corner - window.middle());
      cairo_line_to(context, place.x(), -place.y());
    }
    cairo_close_path(context);
  }
}

/// \param cut clips by the rings of the part.
void paint_plane(cairo_t* context, const Page& page, const Painting& painting, const Surface& part,
                 const Window& window, bool cut) {
  const double scale = page.map.width / window.extent().x();
  cairo_save(context);
  cairo_set_fill_rule(context, CAIRO_FILL_RULE_EVEN_ODD);
  add_window(context, window, scale);
  cairo_clip(context);
  add_outline(context, cut ? part : Surface::plane(), window, scale);
  set_colour(context, globe_colour);
  cairo_fill_preserve(context);
  cairo_clip(context);
  const double unit = scale * window.extent().maxCoeff() / 2; // of the scene
  flat_map(context, painting, unit);
  draw_flat_markers(context, painting, unit, scale * scale * window.extent().prod(),
                    marker_radius(page));
  cairo_restore(context);
  cairo_save(context);
  if (part.is_bounded()) { // walls go on beyond the window
    add_window(context, window, scale);
    cairo_clip(context);
  }
  add_outline(context, part, window, scale);
  set_colour(context, part.is_bounded() ? text_colour : map_border_colour);
  cairo_set_line_width(context, std::max(0.8, 0.06 * page.text));
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_stroke(context);
  cairo_restore(context);
}

} // namespace

void set_domain(Mesh& mesh, const Surface& domain) {
  if (domain.period() != mesh.surface.period()) {
    throw Error(ErrorCode::invalid_argument,
                "the domain is not the one that the mesh was made for: one of the two is periodic, "
                "or both with other periods; leave the domain out");
  }
  mesh.surface = domain;
}

void draw_plane(const std::string& path, const Mesh& mesh, const DrawOptions& options) {
  const Surface part =
      has_walls(mesh) && options.cells != nullptr ? walls_of(*options.cells) : mesh.surface;
  const Window window = window_of(mesh, part);
  const Drawn drawn = drawn_of(mesh, options.shapes, window);
  Painting painting = make_painting(mesh, drawn, options, part, window);
  Legend legend = make_legend(painting, options);
  if (options.colouring == Colouring::valence && mesh.surface.period().maxCoeff() > 0) {
    legend.classes = valence_classes(own_values(mesh, painting, drawn, window));
  }
  const std::string title = title_of(mesh, options, part, window);
  const Page page = page_of_plane(options.look.size, window.extent().y() / window.extent().x(),
                                  options.colouring != Colouring::none);
  write_picture(path, page.width, page.height, [&](cairo_t* context) {
    draw_page(context, page, title, legend, [&] {
      paint_plane(context, page, painting, part, window, options.shapes != Shapes::triangles);
    });
  });
}

} // namespace calotte::tools
