// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw.h"

#include "draw_globe.h"
#include "draw_picture.h"
#include "draw_text.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace calotte::tools {

namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

constexpr Rgb limb_colour = {0.45, 0.48, 0.52};
constexpr std::int64_t most_paths = 30000; ///< a vector file of more shapes is slow to open

/// Where things stand, in pixels. A title, the globe, a legend, from top to bottom.
struct Page {
  Page(int size, bool with_legend)
      : width(size), text(std::clamp(size / 46.0, 7.0, 40.0)),
        radius(static_cast<int>(0.465 * size)), middle_y(2.6 * text + radius),
        bar_y(middle_y + radius + 1.6 * text),
        height(static_cast<int>(std::ceil(middle_y + radius + (with_legend ? 6.0 : 1.2) * text))) {}
  double middle_x() const { return 0.5 * width; }

  int width;
  double text; ///< size of the letters
  int radius;
  double middle_y, bar_y;
  int height;
};

bool has_boundary(const Mesh& mesh) { return (mesh.neighbours.array() < 0).any(); }

std::string title_of(const Mesh& mesh) {
  return grouped(mesh.points.cols()) + " sites, " + grouped(mesh.triangles.cols()) + " triangles" +
         (has_boundary(mesh) ? ", open boundary" : "");
}

std::string caption_of(const Painting& painting) {
  const bool cells = painting.scene.shapes == Shapes::cells;
  switch (painting.scale.colouring) {
  case Colouring::spacing:
    return std::string(cells ? "mean distance to the neighbours" : "mean side of the triangle") +
           ", degrees (1\u00b0 = 0.01745 radians)";
  case Colouring::angle:
    return cells ? "smallest angle around the site, degrees"
                 : "smallest angle of the triangle, degrees";
  case Colouring::valence:
    return cells ? "neighbours of the site: cells of each kind"
                 : "neighbours of the corner furthest from 6: triangles of each kind";
  case Colouring::none:
    break;
  }
  return {};
}

/// The bar, with an arrow at an end beyond which values lie.
void bar_path(cairo_t* context, const Scale& scale, double left, double top, double width,
              double height) {
  cairo_new_path(context);
  cairo_move_to(context, left, top);
  cairo_line_to(context, left + width, top);
  if (scale.above) {
    cairo_line_to(context, left + width + height, top + height / 2);
  }
  cairo_line_to(context, left + width, top + height);
  cairo_line_to(context, left, top + height);
  if (scale.below) {
    cairo_line_to(context, left - height, top + height / 2);
  }
  cairo_close_path(context);
}

void colour_bar(cairo_t* context, const Page& page, const Scale& scale) {
  const double width = 0.62 * page.width;
  const double left = page.middle_x() - width / 2;
  const double height = 0.9 * page.text;
  cairo_pattern_t* pattern = cairo_pattern_create_linear(left, 0, left + width, 0);
  for (int i = 0; i <= 10; ++i) {
    const Rgb c = viridis(i / 10.0);
    cairo_pattern_add_color_stop_rgb(pattern, i / 10.0, c.r, c.g, c.b);
  }
  bar_path(context, scale, left, page.bar_y, width, height);
  cairo_set_source(context, pattern);
  cairo_fill_preserve(context);
  cairo_pattern_destroy(pattern);
  set_colour(context, limb_colour);
  cairo_set_line_width(context, 0.06 * page.text);
  cairo_stroke(context);
  set_colour(context, text_colour);
  const double bottom = page.bar_y + height;
  for (const Tick& tick : degree_ticks(scale)) {
    const double x = left + tick.place * width;
    cairo_move_to(context, x, bottom);
    cairo_line_to(context, x, bottom + 0.3 * page.text);
    cairo_stroke(context);
    centred_text(context, x, bottom + 1.35 * page.text, tick.label);
  }
}

/// A swatch, its name and its count for each class, in one line that is made to fit.
void class_legend(cairo_t* context, const Page& page, const Painting& painting) {
  const std::vector<ValenceClass> classes = valence_classes(painting.values);
  const double gap = 1.3;    // between classes; these in letter sizes
  const double indent = 1.4; // of the label from its swatch's left
  std::vector<std::string> labels;
  double length = -gap;
  for (const ValenceClass& c : classes) {
    labels.push_back(c.label + ": " + grouped(c.count));
    length += indent + text_width(context, labels.back()) / page.text + gap;
  }
  const double text = page.text * std::min(1.0, 0.96 * page.width / (length * page.text));
  cairo_set_font_size(context, 0.92 * text);
  const double baseline = page.bar_y + 1.2 * page.text;
  double x = page.middle_x() - length * text / 2;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    cairo_rectangle(context, x, baseline - 0.85 * text, 0.95 * text, 0.95 * text);
    set_colour(context, classes[i].colour);
    cairo_fill_preserve(context);
    set_colour(context, limb_colour);
    cairo_set_line_width(context, 0.06 * text);
    cairo_stroke(context);
    set_colour(context, text_colour);
    cairo_move_to(context, x + indent * text, baseline);
    cairo_show_text(context, labels[i].c_str());
    x += indent * text + text_width(context, labels[i]) + gap * text;
  }
  cairo_set_font_size(context, 0.92 * page.text);
}

void legend(cairo_t* context, const Page& page, const Painting& painting) {
  cairo_set_font_size(context, 0.92 * page.text);
  if (painting.scale.colouring == Colouring::valence) {
    class_legend(context, page, painting);
  } else {
    colour_bar(context, page, painting.scale);
  }
  set_colour(context, text_colour);
  centred_text(context, page.middle_x(), page.bar_y + 3.5 * page.text, caption_of(painting));
}

void globe(cairo_t* context, const Page& page, const Painting& painting, bool paths) {
  cairo_save(context);
  cairo_translate(context, std::floor(page.middle_x()), std::floor(page.middle_y));
  if (paths) {
    vector_globe(context, painting, page.radius);
  } else {
    // In a vector file the picture is printed at any size: give it twice the pixels.
    const bool raster_page =
        cairo_surface_get_type(cairo_get_target(context)) == CAIRO_SURFACE_TYPE_IMAGE;
    const int scale = raster_page || page.radius > 4096 ? 1 : 2;
    const Surface image(raster_globe(painting, scale * page.radius), cairo_surface_destroy);
    cairo_save(context);
    cairo_scale(context, 1.0 / scale, 1.0 / scale);
    cairo_set_source_surface(context, image.get(), -scale * page.radius, -scale * page.radius);
    cairo_paint(context);
    cairo_restore(context);
  }
  cairo_arc(context, 0, 0, page.radius, 0, 2 * std::numbers::pi);
  set_colour(context, limb_colour);
  cairo_set_line_width(context, std::max(0.8, 0.05 * page.text));
  cairo_stroke(context);
  cairo_restore(context);
}

void compose(cairo_t* context, const Page& page, const Painting& painting, bool paths) {
  globe(context, page, painting, paths);
  select_font(context, 1.1 * page.text);
  set_colour(context, text_colour);
  centred_text(context, page.middle_x(), 1.65 * page.text, title_of(*painting.scene.mesh));
  if (painting.scale.colouring != Colouring::none) {
    legend(context, page, painting);
  }
}

Painting make_painting(const Mesh& mesh, const DrawOptions& options) {
  const LonLat front = has_boundary(mesh) ? middle(mesh) : LonLat{15, 25};
  Painting painting;
  painting.scene = make_scene(mesh, options.shapes, options.view.value_or(front));
  painting.values = values_of(painting.scene, options.colouring);
  painting.widths = widths_of(painting.scene);
  painting.scale = make_scale(painting.values, options.colouring);
  return painting;
}

} // namespace

void draw(const std::string& path, const Mesh& mesh, const DrawOptions& options) {
  require_picture(path, options.size);
  const Painting painting = make_painting(mesh, options);
  const Page page(options.size, options.colouring != Colouring::none);
  const bool paths =
      picture_format(path) != PictureFormat::png && visible_shapes(painting) <= most_paths;
  write_picture(path, page.width, page.height,
                [&](cairo_t* context) { compose(context, page, painting, paths); });
}

} // namespace calotte::tools
