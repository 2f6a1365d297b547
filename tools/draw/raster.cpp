// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/raster.h"

#include "draw/projection.h"

namespace calotte::tools {

namespace {

constexpr int most_samples = 8192; ///< in a row, where that leaves one a pixel

/// Samples of a map, row by row from the top.
template <class Map> struct Samples {
  Samples(const MapSize& size, int samples, const MapWindow& part)
      : window(part), per_pixel(samples), columns(size.width * samples),
        rows(size.height * samples), rays(columns, rows, part),
        rgb(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
            bytes_of(globe_colour)) {}

  /// Samples in the map's unit.
  double scale() const { return window.template scale<Map>(columns); }
  int column_of(double u) const {
    return clamped((u / window.template half_width<Map>() + 1) / 2, columns);
  }
  int row_of(double v) const {
    return clamped((1 - (v - window.middle) / window.template half_height<Map>()) / 2, rows);
  }
  bool shows(const Bounds& b) const {
    const double half = window.template half_width<Map>();
    return b.left < half && b.right > -half;
  }
  std::uint32_t& at(int row, int column) {
    return rgb[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column)];
  }
  std::uint32_t at(int row, int column) const {
    return const_cast<Samples*>(this)->at(row, column);
  }
  static int clamped(double part, int count) {
    return static_cast<int>(std::clamp(std::floor(part * count), 0.0, count - 1.0));
  }

  MapWindow window;
  int per_pixel; ///< along one axis
  int columns, rows;
  typename Map::Rays rays;
  std::vector<std::uint32_t> rgb;
};

// ---- Shapes

/// The paint of a shape. The shape is convex, so that the great circles of its sides do not enter
/// it, and the distance to the nearest of them is that to its outline.
struct Paint {
  Paint(const Line& outline, const std::vector<Vector3d>& corners) : line(outline) {
    for (std::size_t i = 0; line.alpha > 0 && i < corners.size(); ++i) {
      const Vector3d normal = corners[i].cross(corners[(i + 1) % corners.size()]);
      // A side of negligible length, as between cocircular sites, has no direction.
      if (normal.squaredNorm() > 1e-14) {
        sides.push_back(normal);
      }
    }
  }

  bool filled = false;
  Rgb fill;
  std::uint32_t packed = 0; ///< fill
  Line line;
  std::vector<Vector3d> sides; ///< normals of the outline's great circles; none without an outline
};

/// The distance of a point to the shape's outline, in samples. f = normal . p vanishes on a side,
/// and |f| over the length of its gradient on the map is the distance to first order.
template <class Map>
double distance_to_outline(const Paint& paint, const Vector3d& p, double scale) {
  if (paint.sides.empty()) {
    return HUGE_VAL;
  }
  const Tangents tangents = Map::tangents(p);
  double least = HUGE_VAL;
  for (const Vector3d& normal : paint.sides) {
    const double gradient = std::hypot(normal.dot(tangents.across), normal.dot(tangents.up));
    least = std::min(least, std::abs(normal.dot(p)) / gradient);
  }
  return scale * least;
}

/// \param under the sample's colour so far, in packed form.
std::uint32_t sample_colour(const Paint& paint, double distance, double per_pixel,
                            std::uint32_t under) {
  const double cover = std::clamp(paint.line.width * per_pixel / 2 - distance + 0.5, 0.0, 1.0);
  if (cover == 0) {
    return paint.filled ? paint.packed : under;
  }
  const double t = paint.line.alpha * cover;
  const Rgb base = paint.filled ? paint.fill : colour_of(under);
  const Rgb& line = paint.line.colour;
  return bytes_of(
      {std::lerp(base.r, line.r, t), std::lerp(base.g, line.g, t), std::lerp(base.b, line.b, t)});
}

/// Paints the samples within bounds whose direction lies in the facet. Two facets that share a side
/// compute negated signs for it to the last bit, so no sample between them is missed.
template <class Map>
void paint_within(Samples<Map>& samples, const Bounds& bounds, const Facet& f, const Paint& paint) {
  const Vector3d normal[3] = {f.b.cross(f.c), f.c.cross(f.a), f.a.cross(f.b)};
  const int last_row = samples.row_of(bounds.bottom);
  const int last_column = samples.column_of(bounds.right);
  for (int row = samples.row_of(bounds.top); row <= last_row; ++row) {
    for (int column = samples.column_of(bounds.left); column <= last_column; ++column) {
      Vector3d p;
      if (!samples.rays.at(row, column, p) || normal[0].dot(p) < 0 || normal[1].dot(p) < 0 ||
          normal[2].dot(p) < 0) {
        continue;
      }
      std::uint32_t& sample = samples.at(row, column);
      sample = sample_colour(paint, distance_to_outline<Map>(paint, p, samples.scale()),
                             samples.per_pixel, sample);
    }
  }
}

/// A facet that crosses the map's seam has a part on each side.
template <class Map>
void paint_facet(Samples<Map>& samples, const Facet& facet, const Paint& paint) {
  const Bounds bounds = Map::bounds(facet);
  if (samples.shows(bounds)) {
    paint_within(samples, bounds, facet, paint);
  }
  for (const double shift : {-Map::period, Map::period}) {
    const Bounds copy = {bounds.left + shift, bounds.right + shift, bounds.bottom, bounds.top};
    if (shift != 0 && samples.shows(copy)) {
      paint_within(samples, copy, facet, paint);
    }
  }
}

template <class Map>
void paint_layer(Samples<Map>& samples, const Painting& painting, const Layer& layer) {
  const double scale = samples.scale() / samples.per_pixel;
  for_each_visible<Map>(
      painting, layer, samples.window,
      [&](std::size_t shape, const std::vector<Vector3d>& corners) {
        Paint paint(layer.line(shape, scale, Map::height(corners)), corners);
        if (layer.filled) {
          paint.filled = true;
          paint.fill = painting.scale.colour(painting.values[shape]);
          paint.packed = bytes_of(paint.fill);
        } else if (paint.sides.empty()) {
          return;
        }
        if (layer.shapes == Shapes::triangles) {
          paint_facet(samples, {corners[0], corners[1], corners[2]}, paint);
          return;
        }
        const Vector3d site = painting.scene.sites.col(static_cast<Eigen::Index>(shape));
        for (std::size_t k = 0; k < corners.size(); ++k) {
          paint_facet(samples, {site, corners[k], corners[(k + 1) % corners.size()]}, paint);
        }
      });
}

// ---- Fields

/// The columns of a row that are on the map, and their directions.
template <class Map>
Points3 rays_of(const Samples<Map>& samples, int row, std::vector<int>& columns) {
  Points3 rays(3, samples.columns);
  columns.clear();
  for (int column = 0; column < samples.columns; ++column) {
    if (Vector3d p; samples.rays.at(row, column, p)) {
      rays.col(static_cast<Eigen::Index>(columns.size())) = p;
      columns.push_back(column);
    }
  }
  return rays.leftCols(static_cast<Eigen::Index>(columns.size()));
}

template <class Map> void paint_field(Samples<Map>& samples, const FieldPainting& painting) {
  std::vector<int> columns;
  for (int row = 0; row < samples.rows; ++row) {
    const Points3 rays = rays_of(samples, row, columns);
    if (columns.empty()) {
      continue;
    }
    const Points3 points = (painting.frame.transpose() * rays).colwise().normalized();
    const DoubleVector values = painting.values(points);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      samples.at(row, columns[i]) =
          bytes_of(painting.scale.colour(values[static_cast<Eigen::Index>(i)]));
    }
  }
}

// ---- Pixels

/// Averages the samples of one pixel that are on the map; premultiplied ARGB.
template <class Map>
std::uint32_t pixel_of(const Samples<Map>& samples, int pixel_row, int pixel_column) {
  const int s = samples.per_pixel;
  std::uint32_t sum[4] = {};
  for (int row = pixel_row * s; row < (pixel_row + 1) * s; ++row) {
    for (int column = pixel_column * s; column < (pixel_column + 1) * s; ++column) {
      if (Vector3d p; !samples.rays.at(row, column, p)) {
        continue;
      }
      const std::uint32_t rgb = samples.at(row, column);
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

template <class Map> cairo_surface_t* average(const Samples<Map>& samples, const MapSize& size) {
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size.width, size.height);
  unsigned char* data = cairo_image_surface_get_data(surface);
  for (int row = 0; data != nullptr && row < size.height; ++row) {
    auto* line = reinterpret_cast<std::uint32_t*>(
        data + static_cast<std::ptrdiff_t>(row) * cairo_image_surface_get_stride(surface));
    for (int column = 0; column < size.width; ++column) {
      line[column] = pixel_of(samples, row, column);
    }
  }
  cairo_surface_mark_dirty(surface);
  return surface;
}

template <class Map>
cairo_surface_t* raster(const Painting& painting, const MapWindow& window, const MapSize& size) {
  Samples<Map> samples(size, std::clamp(most_samples / size.width, 1, 4), window);
  for (const Layer& layer : layers_of(painting)) {
    paint_layer(samples, painting, layer);
  }
  return average(samples, size);
}

template <class Map>
cairo_surface_t* raster(const FieldPainting& painting, const MapWindow& window,
                        const MapSize& size) {
  Samples<Map> samples(size, std::clamp(most_samples / size.width, 1, 2), window);
  paint_field(samples, painting);
  return average(samples, size);
}

} // namespace

MapSize map_size(Projection projection, int width) {
  return projection == Projection::globe ? MapSize{width / 2 * 2, width / 2 * 2}
                                         : MapSize{width / 4 * 4, width / 4 * 2};
}

cairo_surface_t* raster_map(const Painting& painting, const MapWindow& window,
                            const MapSize& size) {
  return with_map(window.projection,
                  [&]<class Map>() { return raster<Map>(painting, window, size); });
}

cairo_surface_t* raster_map(const FieldPainting& painting, const MapWindow& window,
                            const MapSize& size) {
  return with_map(window.projection,
                  [&]<class Map>() { return raster<Map>(painting, window, size); });
}

} // namespace calotte::tools
