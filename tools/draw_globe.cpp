// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_globe.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calotte::tools {

namespace {

using Eigen::Vector3d;

/// How a shape's outline is drawn.
struct Line {
  double width = 0; ///< pixels
  double alpha = 0;
};

/// Thin lines that fade as the shapes shrink, and are gone when these are a few pixels wide.
/// \param height the shape's z: towards the limb the lines crowd.
Line line_of(double pixels, double height, Colouring colouring) {
  const double size = pixels * (0.25 + 0.75 * std::clamp(height, 0.0, 1.0));
  const double strength = colouring == Colouring::none ? 0.85 : 0.6;
  return {std::clamp(size / 22, 0.5, 1.4), strength * std::clamp((size - 2.5) / 7.5, 0.0, 1.0)};
}

/// Calls visit(shape, corners) for every painted shape that faces the viewer in part.
template <class Visit> void for_each_visible(const Painting& painting, Visit visit) {
  std::vector<Vector3d> corners;
  for (std::int64_t shape = 0; shape < painting.scene.count(); ++shape) {
    if (std::isnan(painting.values[static_cast<std::size_t>(shape)])) {
      continue;
    }
    outline_of(painting.scene, shape, corners);
    // An arc between two corners behind the limb stays behind it; so does a shape.
    if (std::any_of(corners.begin(), corners.end(), [](const Vector3d& p) { return p.z() > 0; })) {
      visit(shape, corners);
    }
  }
}

double mean_height(const std::vector<Vector3d>& corners) {
  double sum = 0;
  for (const Vector3d& p : corners) {
    sum += p.z();
  }
  return sum / static_cast<double>(corners.size());
}

// ---- Raster

/// Samples of the globe, row by row from the top.
struct Samples {
  Samples(int pixels, int samples)
      : per_pixel(samples), side(pixels * samples),
        rgb(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), pack(globe_colour)) {}

  static std::uint32_t pack(const Rgb& c) {
    const auto byte = [](double x) { return static_cast<std::uint32_t>(std::lround(255 * x)); };
    return byte(c.r) << 16 | byte(c.g) << 8 | byte(c.b);
  }
  double x_of(int column) const { return (2 * column + 1.0) / side - 1; }
  int column_of(double x) const {
    return static_cast<int>(std::clamp(std::floor((x + 1) / 2 * side), 0.0, side - 1.0));
  }

  int per_pixel; ///< along one axis
  int side;
  std::vector<std::uint32_t> rgb;
};

/// A spherical triangle with great-circle sides, counter-clockwise.
struct Facet {
  Vector3d a, b, c;
};

/// How a shape is painted. It is convex, so the great circles of its sides do not enter it, and the
/// distance to the nearest of them is that to its outline.
struct Paint {
  Paint(const Rgb& colour, const Line& outline, const std::vector<Vector3d>& corners)
      : fill(colour), line(outline), packed(Samples::pack(colour)) {
    for (std::size_t i = 0; line.alpha > 0 && i < corners.size(); ++i) {
      const Vector3d normal = corners[i].cross(corners[(i + 1) % corners.size()]);
      // A side of no length to speak of, as between cocircular sites, has no direction either.
      if (normal.squaredNorm() > 1e-14) {
        sides.push_back(normal);
      }
    }
  }

  Rgb fill;
  Line line;
  std::uint32_t packed;
  std::vector<Vector3d> sides; ///< normals of the outline's great circles; none without an outline
};

/// How near the point is to the shape's outline, in samples. f = normal . p vanishes on a side, and
/// |f| over the length of its gradient in the picture's plane is the distance to first order.
double distance_to_outline(const Paint& paint, const Vector3d& p, double radius) {
  double least = HUGE_VAL;
  for (const Vector3d& normal : paint.sides) {
    const double gx = normal.x() - normal.z() * p.x() / p.z();
    const double gy = normal.y() - normal.z() * p.y() / p.z();
    least = std::min(least, std::abs(normal.dot(p)) / std::hypot(gx, gy));
  }
  return radius * least;
}

std::uint32_t sample_colour(const Paint& paint, double distance, double per_pixel) {
  const double cover = std::clamp(paint.line.width * per_pixel / 2 - distance + 0.5, 0.0, 1.0);
  if (cover == 0) {
    return paint.packed;
  }
  const double t = paint.line.alpha * cover;
  return Samples::pack({std::lerp(paint.fill.r, line_colour.r, t),
                        std::lerp(paint.fill.g, line_colour.g, t),
                        std::lerp(paint.fill.b, line_colour.b, t)});
}

/// Paints the samples whose direction lies in the facet. Two facets that share a side compute
/// negated signs for it to the last bit, so no sample between them is missed.
///
/// The facet's points are p/|p| for p in the flat triangle, where |p|^2 >= 1 - L^2/3 for its
/// longest side L; so its picture reaches beyond that of its corners by at most 1 - sqrt(1 -
/// L^2/3).
void paint_facet(Samples& samples, const Facet& f, const Paint& paint) {
  const double longest =
      std::max({(f.a - f.b).squaredNorm(), (f.b - f.c).squaredNorm(), (f.c - f.a).squaredNorm()});
  const double bulge = 1 - std::sqrt(std::max(0.0, 1 - longest / 3));
  const auto [left, right] = std::minmax({f.a.x(), f.b.x(), f.c.x()});
  const auto [bottom, top] = std::minmax({f.a.y(), f.b.y(), f.c.y()});
  const int first_column = samples.column_of(left - bulge);
  const int last_column = samples.column_of(right + bulge);
  const int first_row = samples.column_of(-top - bulge);
  const int last_row = samples.column_of(-bottom + bulge);
  const Vector3d normal[3] = {f.b.cross(f.c), f.c.cross(f.a), f.a.cross(f.b)};
  const double radius = 0.5 * samples.side;
  for (int row = first_row; row <= last_row; ++row) {
    const double y = -samples.x_of(row);
    for (int column = first_column; column <= last_column; ++column) {
      const double x = samples.x_of(column);
      const double z2 = 1 - x * x - y * y;
      if (z2 <= 0) {
        continue;
      }
      const Vector3d p(x, y, std::sqrt(z2));
      if (normal[0].dot(p) < 0 || normal[1].dot(p) < 0 || normal[2].dot(p) < 0) {
        continue;
      }
      samples.rgb[static_cast<std::size_t>(row) * static_cast<std::size_t>(samples.side) +
                  static_cast<std::size_t>(column)] =
          sample_colour(paint, distance_to_outline(paint, p, radius), samples.per_pixel);
    }
  }
}

/// Averages the samples inside the limb of one pixel; premultiplied ARGB.
std::uint32_t pixel_of(const Samples& samples, int pixel_row, int pixel_column) {
  const int s = samples.per_pixel;
  std::uint32_t sum[4] = {};
  for (int row = pixel_row * s; row < (pixel_row + 1) * s; ++row) {
    for (int column = pixel_column * s; column < (pixel_column + 1) * s; ++column) {
      const double x = samples.x_of(column);
      const double y = samples.x_of(row);
      if (1 - x * x - y * y <= 0) {
        continue;
      }
      const std::uint32_t rgb =
          samples.rgb[static_cast<std::size_t>(row) * static_cast<std::size_t>(samples.side) +
                      static_cast<std::size_t>(column)];
      sum[0] += 255;
      sum[1] += rgb >> 16;
      sum[2] += (rgb >> 8) & 0xff;
      sum[3] += rgb & 0xff;
    }
  }
  const auto n = static_cast<std::uint32_t>(s * s);
  std::uint32_t pixel = 0;
  for (const std::uint32_t channel : sum) {
    pixel = pixel << 8 | (channel + n / 2) / n;
  }
  return pixel;
}

cairo_surface_t* average(const Samples& samples) {
  const int side = samples.side / samples.per_pixel;
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, side, side);
  unsigned char* data = cairo_image_surface_get_data(surface);
  for (int row = 0; data != nullptr && row < side; ++row) {
    auto* line = reinterpret_cast<std::uint32_t*>(
        data + static_cast<std::ptrdiff_t>(row) * cairo_image_surface_get_stride(surface));
    for (int column = 0; column < side; ++column) {
      line[column] = pixel_of(samples, row, column);
    }
  }
  cairo_surface_mark_dirty(surface);
  return surface;
}

// ---- Vector

/// The part of a convex spherical polygon on the near side of the limb; the cut runs along the
/// limb.
std::vector<Vector3d> clipped(const std::vector<Vector3d>& polygon) {
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& a = polygon[i];
    const Vector3d& b = polygon[(i + 1) % polygon.size()];
    if (a.z() >= 0) {
      result.push_back(a);
    }
    if ((a.z() >= 0) != (b.z() >= 0)) {
      Vector3d crossing = (b.z() * a - a.z() * b) * (b.z() > a.z() ? 1 : -1);
      crossing.z() = 0;
      result.emplace_back(crossing.normalized());
    }
  }
  return result;
}

/// Adds a closed path of great-circle arcs, subdivided so that a chord is within 0.1 pixels of its
/// arc.
void add_path(cairo_t* context, const std::vector<Vector3d>& polygon, double radius) {
  const double longest = std::sqrt(8 * 0.1 / radius);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& a = polygon[i];
    const Vector3d& b = polygon[(i + 1) % polygon.size()];
    const int parts = std::max(1, static_cast<int>(std::ceil((a - b).norm() * 1.6 / longest)));
    for (int k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const Vector3d p = (1 - t) * a + t * b;
      if (const double norm = p.norm(); norm > 1e-9) {
        cairo_line_to(context, radius * p.x() / norm, -radius * p.y() / norm);
      }
    }
  }
  cairo_close_path(context);
}

} // namespace

std::int64_t visible_shapes(const Painting& painting) {
  std::int64_t count = 0;
  for_each_visible(painting, [&](std::int64_t, const std::vector<Vector3d>&) { ++count; });
  return count;
}

cairo_surface_t* raster_globe(const Painting& painting, int radius) {
  Samples samples(2 * radius, std::clamp(4096 / radius, 1, 4));
  const Scene& scene = painting.scene;
  for_each_visible(painting, [&](std::int64_t shape, const std::vector<Vector3d>& corners) {
    const auto i = static_cast<std::size_t>(shape);
    const Line line =
        line_of(painting.widths[i] * radius, mean_height(corners), painting.scale.colouring);
    const Paint paint(painting.scale.colour(painting.values[i]), line, corners);
    if (scene.shapes == Shapes::triangles) {
      paint_facet(samples, {corners[0], corners[1], corners[2]}, paint);
      return;
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vector3d& next = corners[(k + 1) % corners.size()];
      paint_facet(samples, {scene.sites.col(shape), corners[k], next}, paint);
    }
  });
  return average(samples);
}

void vector_globe(cairo_t* context, const Painting& painting, double radius) {
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_arc(context, 0, 0, radius, 0, 2 * std::numbers::pi);
  cairo_set_source_rgb(context, globe_colour.r, globe_colour.g, globe_colour.b);
  cairo_fill(context);
  for_each_visible(painting, [&](std::int64_t shape, const std::vector<Vector3d>& corners) {
    const Rgb fill = painting.scale.colour(painting.values[static_cast<std::size_t>(shape)]);
    add_path(context, clipped(corners), radius);
    cairo_set_source_rgb(context, fill.r, fill.g, fill.b);
    cairo_fill_preserve(context);
    cairo_set_line_width(context, 0.4); // closes the seams that antialiasing leaves between fills
    cairo_stroke(context);
  });
  for_each_visible(painting, [&](std::int64_t shape, const std::vector<Vector3d>& corners) {
    const double width = painting.widths[static_cast<std::size_t>(shape)];
    const Line line = line_of(width * radius, mean_height(corners), painting.scale.colouring);
    if (line.alpha > 0) {
      add_path(context, clipped(corners), radius);
      // Two shapes draw a shared side, each with half of the strength.
      cairo_set_source_rgba(context, line_colour.r, line_colour.g, line_colour.b,
                            1 - std::sqrt(1 - line.alpha));
      cairo_set_line_width(context, line.width);
      cairo_stroke(context);
    }
  });
}

} // namespace calotte::tools
