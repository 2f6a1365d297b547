// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/mesh_intake.h"

#include "base/points.h"
#include "base/require.h"
#include "delaunay/delaunay.h"
#include "io/bytes/file_error.h"
#include "io/cells/field_order.h"
#include "io/cells/polygons.h"
#include "io/cells/voronoi_cells.h"
#include "mesh/adjacency.h"
#include "mesh/canonical_order.h"
#include "mesh/orientation.h"

#include <calotte/delaunay.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace calotte::io_detail {
namespace {

void require_ids(const std::string& name, const Triangles& triangles, std::int64_t points) {
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (triangles(i, t) < 0 || triangles(i, t) >= points)
        fail_file(name, t,
                  "triangle {} has an id that is not one of the {} points; make the file again", t,
                  points);
}

std::string triangle_name(const Triangles& triangles, std::int64_t t) {
  return message("triangle {} ({}, {}, {})", t, triangles(0, t), triangles(1, t), triangles(2, t));
}

// ---- Canonical form

void require_one_orientation(const std::string& name, const Triangles& triangles,
                             const Orientations& found) {
  if (!found.contradict())
    return;
  const std::int64_t t = found.first_exception();
  const bool clockwise = t == found.first_clockwise;
  fail_file(name, t,
            "{} runs {}, but {} triangles run the other way, so the file contradicts itself; make "
            "the file again",
            triangle_name(triangles, t), clockwise ? "clockwise" : "counter-clockwise",
            clockwise ? found.counter_clockwise : found.clockwise);
}

/// Turns clockwise triangles.
void orient(const std::string& name, Triangles& triangles, const Orientations& found,
            std::vector<std::string>& changes) {
  require_one_orientation(name, triangles, found);
  if (found.clockwise == 0)
    return;
  reverse(triangles);
  changes.push_back(message("turned {} clockwise triangles", found.clockwise));
}

/// Reorders the corners of polygons. Each corner belongs to one triangle.
void reorder_corners(Polygons& polygons, const CanonicalOrder& places) {
  if (polygons.corners.cols() != places.index.size())
    return;
  const Points3 old = polygons.corners;
  for (Eigen::Index v = 0; v < old.cols(); ++v)
    polygons.corners.col(places.index[v]) = old.col(v);
  for (std::int32_t& id : polygons.ids.items)
    id = places.index[id];
}

void sort(Triangles& triangles, Polygons* polygons, MeshFile& file) {
  if (is_canonical(triangles))
    return;
  Triangles sorted;
  const CanonicalOrder places = order_triangles(triangles, {}, sorted);
  triangles = std::move(sorted);
  move_vertex_values(file.fields, {places.index.begin(), places.index.end()});
  if (polygons != nullptr)
    reorder_corners(*polygons, places);
  file.changes.push_back(message("sorted {} triangles", triangles.cols()));
}

void require_one_surface(const std::string& name, const Triangles& triangles,
                         const Triangles& neighbours) {
  const SharedEdge edge = first_shared_edge(triangles, neighbours);
  if (edge.triangle >= 0)
    fail_file(name, edge.triangle,
              "the edge from {} to {} of {} belongs to more than two triangles, or to two on the "
              "same side of it, so the triangles overlap; make the file again",
              edge.from, edge.to, triangle_name(triangles, edge.triangle));
}

void require_distinct_vertices(const std::string& name, const Triangles& triangles) {
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    if (triangles(0, t) == triangles(1, t) || triangles(1, t) == triangles(2, t) ||
        triangles(2, t) == triangles(0, t))
      fail_file(name, t, "{} has a vertex twice; make the file again", triangle_name(triangles, t));
}

/// Sets orientation, order and neighbours.
/// \pre ids are in range.
/// \param polygons whose corners belong to the triangles, or none.
Triangles canonical(const std::string& name, Triangles& triangles, std::int64_t points,
                    const Orientations& found, MeshFile& file, Polygons* polygons = nullptr) {
  require_distinct_vertices(name, triangles);
  orient(name, triangles, found, file.changes);
  sort(triangles, polygons, file);
  Triangles neighbours = neighbours_of(triangles, points);
  require_one_surface(name, triangles, neighbours);
  return neighbours;
}

/// Sets all but the points of a mesh from the triangles of a file.
/// \param polygons as for canonical().
void complete(const std::string& name, Mesh& mesh, MeshFile& file, Polygons* polygons = nullptr) {
  mesh.neighbours =
      canonical(name, mesh.triangles, mesh.points.cols(),
                orientations_of(mesh.points, mesh.triangles, mesh.surface), file, polygons);
  mesh.site_of_input = themselves(mesh.points.cols());
}

// ---- Cells

/// Converts values by corner to values by triangle.
void move_to_triangles(const Voronoi& cells, const Polygons& polygons,
                       std::vector<MeshField>& fields) {
  const auto is_by_corner = [&](const MeshField& field) {
    return field.location == FieldLocation::vertices &&
           has_values_for(field, polygons.corners.cols());
  };
  if (std::none_of(fields.begin(), fields.end(), is_by_corner))
    return;
  const Ids corners = corners_of_vertices(cells, polygons);
  for (MeshField& field : fields)
    if (is_by_corner(field))
      select_values(field, {corners.data(), static_cast<std::size_t>(corners.size())});
}

void turn_cells(const std::string& name, Polygons& polygons, bool each, MeshFile& file) {
  const std::int64_t turned = turn_counter_clockwise(polygons, name, each);
  if (turned > 0)
    file.changes.push_back(message("turned {} clockwise cells", turned));
}

/// Requires a site in each cell of a plane. Only the file has its boundary, and its corners are not
/// triangles.
void require_one_site_each(const std::string& name, const Mesh& mesh) {
  const auto& sites = mesh.site_of_input;
  for (std::int32_t i = 0; i < std::ssize(sites); ++i)
    if (const std::int32_t site = sites[static_cast<std::size_t>(i)]; site != i)
      fail_file(name, i, "cell {} and cell {} have one centre; make the file again", i, site);
}

void ignore_other_fields(MeshFile& file) {
  std::erase_if(file.fields, [&](const MeshField& field) {
    if (field.location != FieldLocation::cells)
      file.ignored.push_back(field.name);
    return field.location != FieldLocation::cells;
  });
}

/// Keeps the polygons unless they are the Voronoi cells of a mesh.
void take_cells(const std::string& name, RawMesh raw, MeshFile& file) {
  ComparedCells found =
      file.mesh
          ? compare_cells(*std::move(file.mesh), raw.polygons, raw.corner_rounding)
          : compare_cells(std::move(raw.points), raw.polygons, raw.corner_rounding, file.fields);
  file.mesh = std::move(found.mesh);
  file.not_voronoi = std::move(found.answer);
  if (file.not_voronoi.fault == CellFault::none) {
    if (found.voronoi)
      move_to_triangles(*found.voronoi, raw.polygons, file.fields);
    return;
  }
  require_no_overlap(raw.polygons, name);
  if (file.not_voronoi.fault == CellFault::clipped)
    ignore_other_fields(file);
  file.polygons = std::move(raw.polygons);
}

/// Converts values by input column to values by site. A site has those of its lowest column.
void merge_values(const Mesh& mesh, MeshFile& file) {
  const auto columns = std::ssize(mesh.site_of_input);
  if (columns == mesh.points.cols())
    return;
  std::vector<std::int32_t> lowest(static_cast<std::size_t>(mesh.points.cols()));
  for (auto i = columns; i-- > 0;)
    lowest[static_cast<std::size_t>(mesh.site_of_input[static_cast<std::size_t>(i)])] =
        static_cast<std::int32_t>(i);
  if (file.density.size() == columns)
    file.density = DoubleVector(file.density(lowest));
  for (MeshField& field : file.fields)
    if (field.location == FieldLocation::cells && has_values_for(field, columns))
      select_values(field, lowest);
}

MeshFile mesh_file_without_mesh(const std::string& format, RawMesh& raw) {
  MeshFile file;
  file.format = format;
  file.has_cells = raw.has_cells || raw.polygons.size() > 0;
  file.vertex_order = raw.vertex_order;
  file.density = std::move(raw.density);
  file.fields = std::move(raw.fields);
  file.ignored = std::move(raw.ignored);
  return file;
}

void require_planar_points(const std::string& name, const Points3& points) {
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!points.col(i).allFinite())
      fail_file(name, i, "point {} has no place (NaN or infinite); make the file again", i);
    if (points(2, i) != 0)
      refuse(
          message("{}: it says that its mesh is planar, but z is not 0 at point {}; make the file "
                  "again",
                  name, i),
          i);
  }
}

/// The mesh of the file's triangles.
Mesh mesh_of_triangles(const std::string& name, RawMesh& raw, MeshFile& file) {
  require_ids(name, raw.triangles, raw.points.cols());
  Mesh mesh{std::move(raw.points), std::move(raw.triangles), {}, {}, raw.surface};
  complete(name, mesh, file, &raw.polygons);
  reorder_edge_fields(mesh.triangles, raw.edges, file.fields, file.changes, file.ignored);
  return mesh;
}

/// The mesh of points, or of the centres of cells in a plane, if the file has no triangles.
Mesh mesh_of_points(const std::string& name, const RawMesh& raw, MeshFile& file) {
  Mesh mesh = named(name, [&] { return delaunay(raw.points, raw.surface); });
  if (raw.polygons.size() > 0) {
    require_one_site_each(name, mesh);
  } else if (raw.surface.is_sphere()) {
    merge_values(mesh, file);
    file.changes.push_back(message("triangulated {} points", raw.points.cols()));
  }
  return mesh;
}

} // namespace

bool lies_in_plane(const Points3& points) {
  return points.cols() >= 3 && (points.row(2).array() == 0).all();
}

void require_directions(const std::string& name, const Points3& points) {
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (!points.col(i).allFinite() || (points.col(i).array() == 0).all())
      fail_file(name, i, "point {} has no direction (NaN, infinite or zero); make the file again",
                i);
}

double find_radius(const Points3& points) {
  constexpr double rounding = 1e-6;
  if (points.cols() == 0)
    return 1;
  const DoubleVector norms = points.colwise().stableNorm();
  const double mean = norms.mean();
  if (!((norms.array() - mean).abs() <= rounding * mean).all())
    return 1;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.12g", mean);
  return std::strtod(text.data(), nullptr);
}

void require_points(const std::string& name, RawMesh& raw) {
  if (raw.surface.is_sphere()) {
    if (lies_in_plane(raw.points))
      refuse_path(name, "z is 0 at all points, which makes a mesh of the plane, and the format has "
                        "none; give a file of another format");
    require_directions(name, raw.points);
  } else if (raw.surface.period().isZero(0)) {
    require_planar_points(name, raw.points);
    raw.points.row(2).setZero(); // not -0
    if (raw.triangles.cols() == 0 && raw.polygons.size() > 0 && raw.polygons.surface.is_sphere())
      refuse_path(name, "it holds cells of the sphere; of a plane only triangles are read");
  }
}

MeshFile make_mesh_file(const std::string& name, const std::string& format, RawMesh raw) {
  require_points(name, raw);
  MeshFile file = mesh_file_without_mesh(format, raw);
  const bool sphere = raw.surface.is_sphere(), has_cells = raw.polygons.size() > 0,
             has_triangles = raw.triangles.cols() > 0 || !raw.surface.period().isZero(0);
  if (has_cells)
    turn_cells(name, raw.polygons, raw.turns_each, file);
  if (has_triangles)
    file.mesh = mesh_of_triangles(name, raw, file);
  else if (!sphere || !has_cells)
    file.mesh = mesh_of_points(name, raw, file);
  if (has_cells)
    take_cells(name, std::move(raw), file);
  if (sphere && file.mesh)
    file.sphere_radius = find_radius(file.mesh->points);
  return file;
}

namespace {

Mesh mesh_of_columns_in_order(const std::string& name, const Points3& points, Triangles& triangles,
                              const Surface& surface, MeshFile& file) {
  require_ids(name, triangles, points.cols());
  canonical(name, triangles, points.cols(), orientations_of(points, triangles, surface), file);
  return mesh_of_columns(points, triangles, surface);
}

} // namespace

MeshFile make_mesh_file_on_points(const std::string& name, const Points3& points,
                                  Triangles triangles) {
  MeshFile file;
  file.format = "triangles";
  if (lies_in_plane(points)) {
    require_planar_points(name, points);
    file.mesh = mesh_of_columns_in_order(name, points, triangles, Surface::plane(), file);
    file.mesh->points.row(2).setZero(); // not -0
    return file;
  }
  require_directions(name, points);
  file.mesh = mesh_of_columns_in_order(name, points, triangles, {}, file);
  file.sphere_radius = find_radius(points);
  return file;
}

} // namespace calotte::io_detail
