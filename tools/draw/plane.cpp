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
#include "text/text.h"

#include <calotte/delaunay.h>
#include <calotte/quality.h>
#include <calotte/surface.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace calotte::tools {

namespace {

using Eigen::Vector2d;
using Side = std::array<Vector2d, 2>;

// ---- The cells

/// Whether a side of two cells is at least partly inside; tests some points of it.
bool reaches(const Surface& part, const Side& side) {
  constexpr int steps = 16;
  for (int i = 0; i <= steps && part.is_bounded(); ++i) {
    const Vector2d point = side[0] + (i / double(steps)) * (side[1] - side[0]);
    if (part.contains({point.x(), point.y(), 0}))
      return true;
  }
  return !part.is_bounded();
}

/// Calls visit(side, cell, other) for each side of the cells, with the cell across it, or -1.
template <class Visit> void each_side(const Polygons& cells, const Visit& visit) {
  const auto between = [&](std::int32_t from, std::int32_t to) -> Side {
    const Vector2d start = cells.corners.col(from).head<2>();
    Vector2d way = cells.corners.col(to).head<2>() - start;
    for (int k = 0; k < 2; ++k)
      if (const double period = cells.surface.period()[k]; period > 0)
        way[k] = std::remainder(way[k], period);
    return {start, start + way};
  };
  std::map<std::array<std::int32_t, 2>, std::int64_t> open;
  for (std::int64_t i = 0; i < cells.size(); ++i) {
    const auto ids = cells.ids[i];
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const std::int32_t from = ids[k], to = ids[(k + 1) % ids.size()];
      if (const auto other = open.extract({to, from}))
        visit(between(from, to), i, other.mapped());
      else
        open.insert({{from, to}, i});
    }
  }
  for (const auto& [ids, cell] : open)
    visit(between(ids[0], ids[1]), cell, std::int64_t{-1});
}

/// For each site the mean distance to the neighbours: sites whose cells meet its own inside a part
/// of the plane, as triangles reach across bays and islands. NaN for a cell that meets
/// no other.
std::vector<double> spacings(const Mesh& mesh, const Surface& part, const Polygons& cells) {
  const auto n = static_cast<std::size_t>(mesh.points.cols());
  const Vector2d period = mesh.surface.period();
  std::vector<double> sums(n), counts(n);
  each_side(cells, [&](const Side& side, std::int64_t cell, std::int64_t other) {
    if (other < 0 || !reaches(part, side))
      return;
    Vector2d way = (mesh.points.col(other) - mesh.points.col(cell)).head<2>();
    for (int k = 0; k < 2; ++k)
      way[k] = period[k] > 0 ? std::remainder(way[k], period[k]) : way[k];
    for (const std::int64_t end : {cell, other}) {
      sums[static_cast<std::size_t>(end)] += way.norm();
      ++counts[static_cast<std::size_t>(end)];
    }
  });
  std::transform(sums.begin(), sums.end(), counts.begin(), sums.begin(), std::divides<>());
  return sums;
}

/// The tessellation of the whole plane, in a rectangle that holds the window and the sites.
Voronoi cut_off(const Mesh& mesh, const Window& window) {
  const auto sites = mesh.points.topRows<2>();
  return voronoi(
      delaunay(mesh.points, rectangle(window.low.cwiseMin(sites.rowwise().minCoeff()),
                                      window.high.cwiseMax(sites.rowwise().maxCoeff()))));
}

/// The boundary of the triangles: of a triangulation of points their convex hull. None where it
/// passes a site twice, and where triangles overlap.
Surface hull_of(const Mesh& mesh) {
  std::map<std::int32_t, std::int32_t> next;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int k = 0; k < 3; ++k)
      if (mesh.neighbours(k, t) < 0 &&
          !next.emplace(mesh.triangles((k + 1) % 3, t), mesh.triangles((k + 2) % 3, t)).second)
        return Surface::plane();
  Surface::Rings rings;
  while (!next.empty()) {
    std::vector<std::int32_t> ring;
    for (auto at = next.begin(); at != next.end(); at = next.find(ring.back())) {
      ring.push_back(at->second);
      next.erase(at);
    }
    rings.emplace_back(mesh.points(Eigen::seqN(0, 2), ring));
  }
  try {
    return Surface::plane().within(std::move(rings));
  } catch (const Error&) { // the triangles overlap
    return Surface::plane();
  }
}

/// What clips the cells.
Surface part_of(const Mesh& mesh, bool cut) {
  return cut && mesh.surface == Surface::plane() ? hull_of(mesh) : mesh.surface;
}

// ---- The scene

/// The triangles whose circumcentre lies outside the mesh's part of the plane, such as those across
/// bays and islands: they have no corner of a cell there.
std::vector<bool> triangles_outside(const Mesh& mesh) {
  std::vector<bool> outside;
  for (Eigen::Index t = 0; mesh.surface.is_bounded() && t < mesh.triangles.cols(); ++t) {
    const auto corner = [&](int k) -> Vector2d {
      return mesh.points.col(mesh.triangles(k, t)).head<2>();
    };
    Eigen::Matrix2d sides;
    sides << (corner(1) - corner(0)).transpose(), (corner(2) - corner(0)).transpose();
    const Vector2d centre = corner(0) + sides.inverse() * sides.rowwise().squaredNorm() / 2;
    outside.push_back(!mesh.surface.contains({centre.x(), centre.y(), 0}));
  }
  return outside;
}

/// Where shapes are drawn again: a period away in each direction that has one.
std::vector<Vector3d> copies_of(const Vector2d& period) {
  std::vector<Vector3d> shifts;
  for (const int i : {-1, 0, 1})
    for (const int j : {-1, 0, 1})
      if ((i == 0 || period.x() > 0) && (j == 0 || period.y() > 0))
        shifts.emplace_back(i * period.x(), j * period.y(), 0);
  return shifts;
}

Scene scene_of(const Mesh& mesh, Shapes shapes, const Window& window, const Polygons& cells) {
  Scene scene = make_flat_scene(
      mesh, shapes, (mesh.points.topRows<2>().colwise() - window.middle()) / window.half(),
      mesh.surface.period() / window.half(), cells);
  scene.reach = window.extent() / (2 * window.half());
  scene.copies = copies_of(scene.period);
  scene.outside = triangles_outside(mesh);
  return scene;
}

/// The sites whose cells a part of the plane clips, or without one the box around the sites.
std::vector<bool> sites_at_boundary(const Mesh& mesh, const Surface& part) {
  Mesh clipped;
  clipped.points = mesh.points;
  clipped.surface = part.is_bounded() ? part
                                      : rectangle(mesh.points.topRows<2>().rowwise().minCoeff(),
                                                  mesh.points.topRows<2>().rowwise().maxCoeff());
  return clipped_cells(clipped);
}

/// The power of the scene's unit in a quantity: 1 for lengths, 2 for areas, otherwise 0.
int power_of(Colouring colouring) {
  return colouring == Colouring::spacing ? 1 : colouring == Colouring::area ? 2 : 0;
}

std::vector<double> in_unit(std::vector<double> values, double unit) {
  std::for_each(values.begin(), values.end(), [unit](double& value) { value *= unit; });
  return values;
}

} // namespace

Window window_of(const Mesh& mesh, const Polygons* cells) {
  Points2 points = mesh.points.topRows<2>();
  if (cells != nullptr) {
    points = cells->corners.topRows<2>();
  } else if (mesh.surface.is_bounded()) {
    points.resize(2, 0);
    for (const DoubleMatrix& ring : mesh.surface.rings()) {
      points.conservativeResize(Eigen::NoChange, points.cols() + ring.cols());
      points.rightCols(ring.cols()) = ring;
    }
  }
  Window window{points.rowwise().minCoeff(), points.rowwise().maxCoeff()};
  const double share = cells != nullptr || mesh.surface.is_bounded() ? 0.01 : 0.04;
  const Vector2d margin = Vector2d::Constant(share * window.extent().maxCoeff());
  const Eigen::Array2d period = mesh.surface.period();
  window.low = (period > 0).select(Vector2d::Zero(), window.low - margin);
  window.high = (period > 0).select(period.matrix(), window.high + margin);
  return window;
}

PlaneMap::PlaneMap(const Mesh& mesh, const DrawOptions& options)
    : given(mesh.closed() ? nullptr : options.cells), window(window_of(mesh, given)),
      part(part_of(mesh, given == nullptr && !mesh.closed())) {
  const bool cut = given == nullptr && !mesh.closed();
  const bool by_triangles = options.shapes == Shapes::triangles;
  if (cut && !by_triangles)
    require_closed_cells(options.colouring);
  cells = given != nullptr ? *given : polygons_of(cut ? cut_off(mesh, window) : voronoi(mesh));
  spacing = spacings(mesh, part, cells);
  cells = unwrapped(std::move(cells));
  const Vector2d middle = window.middle();
  cells.corners.topRows<2>() = (cells.corners.topRows<2>().colwise() - middle) / window.half();
  painting.scene = scene_of(mesh, options.shapes, window, cells);
  const Scene& scene = painting.scene;
  const bool clips = cut && options.colouring == Colouring::valence;
  const std::vector<bool> clipped = clips ? sites_at_boundary(mesh, part) : std::vector<bool>();
  painting.values =
      options.colouring == Colouring::spacing && !by_triangles
          ? spacing
          : in_unit(values_of(scene, options.colouring, by_site(mesh, options), clipped),
                    std::pow(window.half(), power_of(options.colouring)));
  painting.widths = widths_of(scene, scene.shapes);
  if (options.shapes == Shapes::both)
    painting.triangle_widths = widths_of(scene, Shapes::triangles);
  painting.of_points = options.shapes == Shapes::points;
  if (options.colouring == Colouring::valence)
    painting.markers =
        markers_of(scene, site_valences(scene, clipped), widths_of(scene, Shapes::cells));
}

namespace {

// ---- The picture

/// A map around the origin, with these pixels per unit of the scene.
struct Sheet {
  const Page& page;
  const PlaneMap& map;
  const Mesh& mesh;
  const DrawOptions& options;
  double unit = 0;

  Vector2d at(const Vector2d& point) const {
    const Vector2d scaled = unit / map.window.half() * (point - map.window.middle());
    return {scaled.x(), -scaled.y()};
  }
};

/// \param margin pixels.
void add_window(cairo_t* context, const Sheet& sheet, double margin = 0) {
  const Vector2d low = sheet.at(sheet.map.window.low) + margin * Vector2d(-1, 1),
                 high = sheet.at(sheet.map.window.high) + margin * Vector2d(1, -1);
  cairo_rectangle(context, low.x(), high.y(), high.x() - low.x(), low.y() - high.y());
}

void add_rings(cairo_t* context, const Sheet& sheet) {
  for (const DoubleMatrix& ring : sheet.map.part.rings()) {
    cairo_new_sub_path(context);
    for (const auto& corner : ring.colwise())
      cairo_line_to(context, sheet.at(corner).x(), sheet.at(corner).y());
    cairo_close_path(context);
  }
}

/// The sides that belong to one cell: walls, or the boundary of a domain.
void add_open_sides(cairo_t* context, const Sheet& sheet) {
  each_side(*sheet.map.given, [&](const Side& side, std::int64_t, std::int64_t other) {
    if (other >= 0)
      return;
    for (const Vector3d& copy : sheet.map.painting.scene.copies) {
      const Vector2d shift = sheet.map.window.half() * copy.head<2>();
      const Vector2d from = sheet.at(side[0] + shift), to = sheet.at(side[1] + shift);
      cairo_move_to(context, from.x(), from.y());
      cairo_line_to(context, to.x(), to.y());
    }
  });
}

/// White beyond the part of the plane. A clip path of the rings would stand in an SVG file
/// once for each shape.
void cover_outside(cairo_t* context, const Sheet& sheet) {
  cairo_set_fill_rule(context, CAIRO_FILL_RULE_EVEN_ODD);
  add_window(context, sheet, 1);
  add_rings(context, sheet);
  set_colour(context, {1, 1, 1});
  cairo_fill(context);
}

void paint_points(cairo_t* context, const Sheet& sheet) {
  cairo_save(context);
  add_window(context, sheet);
  cairo_clip(context);
  draw_flat_points(context, sheet.map.painting, sheet.unit, point_radius(sheet.page));
  cairo_restore(context);
}

/// Cells end at the mesh's part of the plane; triangles may reach beyond it, but not beyond their
/// hull.
void paint_shapes(cairo_t* context, const Sheet& sheet) {
  const bool cells = sheet.options.shapes != Shapes::triangles;
  const bool bounded = sheet.map.part.is_bounded(),
             hull = bounded && !sheet.mesh.surface.is_bounded();
  cairo_save(context);
  add_window(context, sheet);
  cairo_clip(context);
  if (!cells || sheet.map.given == nullptr) { // those of a file leave no gap
    set_colour(context, globe_colour);
    cairo_paint(context);
  }
  const Vector2d extent = sheet.unit / sheet.map.window.half() * sheet.map.window.extent();
  flat_map(context, sheet.map.painting, sheet.unit);
  draw_flat_markers(context, sheet.map.painting, sheet.unit, extent.prod(),
                    marker_radius(sheet.page));
  cairo_restore(context);
  if (bounded && (cells || hull))
    cover_outside(context, sheet);
}

void stroke_boundary(cairo_t* context, const Sheet& sheet) {
  const bool bounded = sheet.map.part.is_bounded();
  if (bounded)
    add_rings(context, sheet);
  else if (sheet.map.given != nullptr)
    add_open_sides(context, sheet);
  else
    add_window(context, sheet);
  set_colour(context, bounded || sheet.map.given != nullptr ? text_colour : map_border_colour);
  cairo_set_line_width(context, std::max(0.8, 0.06 * sheet.page.text));
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_stroke(context);
}

/// The spacing is that of the cells for triangles too.
std::string title_of(const Sheet& sheet) {
  const Mesh& mesh = sheet.mesh;
  const std::string parts = counts_of(mesh, sheet.options.shapes) +
                            (mesh.surface.period().maxCoeff() > 0 ? ", periodic" : "");
  return mesh_title(sheet.options, parts, "spacing", sheet.map.spacing, true);
}

} // namespace

void draw_plane(const std::string& path, const Mesh& mesh, const DrawOptions& options) {
  PlaneMap map(mesh, options);
  const Legend legend = make_legend(map.painting, options);
  const Vector2d extent = map.window.extent();
  const Page page = page_of_plane(options.look.size, extent.y() / extent.x(),
                                  options.colouring != Colouring::none);
  const Sheet sheet{page, map, mesh, options, page.map.width * map.window.half() / extent.x()};
  write_picture(path, page.width, page.height, [&](cairo_t* context) {
    draw_page(context, page, title_of(sheet), legend, [&] {
      const bool points = options.shapes == Shapes::points;
      (points ? paint_points : paint_shapes)(context, sheet);
      if (points && mesh.surface == Surface::plane() && map.given == nullptr)
        return; // nothing bounds them
      cairo_save(context);
      if (map.given != nullptr) { // walls go on beyond the window
        add_window(context, sheet);
        cairo_clip(context);
      }
      stroke_boundary(context, sheet);
      cairo_restore(context);
    });
  });
}

} // namespace calotte::tools
