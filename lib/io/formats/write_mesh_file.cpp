// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/cells/centroids.h"
#include "io/cells/dual.h"
#include "io/cells/field_order.h"
#include "io/cells/limited_area_masks.h"
#include "io/cells/model_grid.h"
#include "io/cells/open_cells.h"
#include "io/cells/polygons.h"
#include "io/cells/written_fields.h"
#include "io/formats/format_table.h"
#include "io/formats/write_mesh.h"
#include "io/mpas/mpas.h"

#include "base/monitor.h"

#include <calotte/check.h>
#include <calotte/mesh_file.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

/// \throws Error invalid_argument, if the format does not support cells of any shape.
void require_polygon_format(const std::string& path, const MeshFile& file, Format format) {
  const std::string why = message("{}; write {}", file.not_voronoi.text(),
                                  polygon_formats(file.polygons->surface.is_sphere()));
  if (format == Format::mpas_minimal)
    refuse_path(path, "minimal MPAS files need Voronoi cells without a boundary, but {}", why);
  if (!find_row(format).polygons_as)
    refuse_path(path, "the format holds triangles, but the mesh consists of cells, and {}", why);
  for (std::int64_t i = 0; i < file.polygons->size(); ++i)
    if (file.polygons->ids.count(i) == 0)
      refuse_path(
          path,
          "cell {} has an incomplete boundary, which no format of cells can hold; write the "
          "triangles ({})",
          i, triangle_formats(", "));
}

/// The generators. Points of the mesh, if they correspond to the centres, keep their bits. None in
/// a plane.
Points3 make_generators(const MeshFile& file, double radius) {
  const Points3& centres = file.polygons->centres;
  if (!file.polygons->surface.is_sphere())
    return {};
  const bool same = file.mesh && file.mesh->points.cols() == centres.cols();
  return on_sphere(same ? file.mesh->points : centres, radius);
}

void write_open_mpas(const std::string& path, const MeshFile& file, const WriteOptions& options) {
  const OpenCells cells = open_cells(file);
  if (!cells.problem.passed())
    refuse_path(path, "MPAS needs Voronoi cells, but {}; write {}", cells.problem.text(),
                polygon_formats(file.polygons->surface.is_sphere()));
  write_mpas(path, cells.voronoi, make_generators(file, options.sphere_radius), options);
}

/// Whether a field is at the cells or at the corners of polygons. Corners do not count in MPAS,
/// which numbers them differently, and in a periodic plane.
bool is_on_polygons(const Polygons& polygons, const MeshField& field, Format format) {
  return field.location == FieldLocation::cells ||
         (field.location == FieldLocation::vertices && format != Format::mpas &&
          !(polygons.surface.period().maxCoeff() > 0) &&
          has_values_for(field, polygons.corners.cols()));
}

void write_polygons(const std::string& path, const MeshFile& file, WriteOptions options) {
  require_options(path, options);
  require_polygon_format(path, file, options.format);
  for (const MeshField& field : options.fields)
    if (field.location == FieldLocation::cells && !has_values_for(field, file.polygons->size()))
      refuse_path(path, "the field {} has {} values for {} cells; give {} for each", field.name,
                  field.values.size(), file.polygons->size(), field.count());
  const bool has_density = file.density.size() == file.polygons->size();
  if (options.format == Format::mpas) {
    if (has_density && options.density.uniform() && options.site_density.size() == 0)
      options.site_density = file.density;
    write_open_mpas(path, file, options);
  } else {
    if (has_density)
      options.fields.push_back({.name = "density", .values = file.density});
    Polygons polygons = unwrapped(*file.polygons);
    if (options.format == Format::scrip && polygons.centres.cols() == 0)
      polygons.centres = centroids_of(polygons);
    const FormatRow& format = find_row(options.format);
    if (!polygons.surface.is_sphere() && !format.planes.clipped && format.info.cells)
      refuse_path(path,
                  "the format holds cells of the sphere, but the mesh is planar; write {}, or mpas",
                  polygon_formats(false));
    format.write_polygons(path, cell_grid(polygons), options);
  }
  Monitor(options.progress).finish("write");
}

/// The part of the contents that a format supports: polygons, or a mesh.
struct WrittenShape {
  bool polygons = false;
  std::optional<Mesh> inner = {}; ///< triangles of the clipped cells of a plane
};

/// Cells are written as they are, but to formats of triangles only if the file has no triangles.
WrittenShape shape_for(const MeshFile& file, Format format) {
  if (!file.polygons || info_of(format).cells)
    return {.polygons = file.polygons && !file.is_clipped()};
  if (file.other_cells())
    return {.polygons = true};
  if (file.sphere() || file.mesh->surface.period().maxCoeff() > 0)
    return {};
  std::optional<Mesh> inner = planar_mesh_of_cells(file.mesh->points, *file.polygons);
  return {.polygons = !inner, .inner = std::move(inner)};
}

/// Requires a Delaunay triangulation, without which there are no Voronoi cells. Edges between
/// cocircular sites may differ.
void require_voronoi(const std::string& path, const Mesh& mesh, Format format) {
  if (!info_of(format).cells)
    return;
  const EdgeCounts edges = count_edges(mesh);
  if (edges.not_delaunay > 0)
    refuse_path(path,
                "the mesh has {} edges that are not Delaunay (the first is from site {} to {}), so "
                "it has no Voronoi cells; write its triangles ({}), or triangulate its points anew",
                edges.not_delaunay, edges.first[0], edges.first[1], triangle_formats(", "));
}

/// Whether a field has values at all corners of the cells of the file, not only at those that are
/// triangles of the mesh.
bool is_at_corners(const MeshFile& file, const MeshField& field) {
  return field.location == FieldLocation::vertices && file.mesh && file.polygons &&
         !has_values_for(field, file.mesh->triangles.cols());
}

/// Why a file of a format cannot have a field.
FieldFault find_fault_on(const MeshFile& file, const MeshField& field, Format format,
                         bool polygons) {
  if (const FieldFault fault = find_fault(format, field); fault != FieldFault::none)
    return fault;
  const bool clipped = !polygons && file.is_clipped() && info_of(format).cells;
  const bool elsewhere =
      polygons ? !is_on_polygons(*file.polygons, field, format)
               : is_at_corners(file, field) || (clipped && field.location != FieldLocation::cells);
  return elsewhere ? FieldFault::location : FieldFault::none;
}

/// Whether a file has values of its own for a field: masks, which MPAS files derive at edges and
/// vertices, and what formats for graphics programs compute at Voronoi cells.
bool is_replaced(const MeshFile& file, const MeshField& field, Format format, bool polygons) {
  const bool computes = !polygons && (file.mesh->closed() || file.is_clipped());
  return (format == Format::mpas && is_derived_mask(field.name, file.fields)) ||
         (computes && is_computed(format, field));
}

/// Masks at edges and vertices that only MPAS files have.
std::vector<std::string> lost_masks(const MeshFile& file, Format format, bool polygons) {
  std::vector<std::string> lost;
  for (const std::string name : {edge_mask.name, vertex_mask.name})
    if (polygons && format != Format::mpas && is_derived_mask(name, file.fields) &&
        std::ranges::none_of(file.fields,
                             [&](const MeshField& field) { return field.name == name; }))
      lost.push_back(name);
  return lost;
}

/// How a file is written.
struct WritePlan {
  WriteOptions options; ///< with a known format, and the fields that are stored
  WrittenShape shape;
  WrittenFields fields;
};

/// \throws Error invalid_argument, for a field of the options that cannot be stored. Others are
///         dropped.
WritePlan plan(const std::string& path, const MeshFile& file, const WriteOptions& options) {
  WritePlan out{.options = options, .shape = {}, .fields = {}};
  Format& format = out.options.format;
  format = format_of(path, options.format);
  out.shape = shape_for(file, format);
  const bool polygons = out.shape.polygons;
  if (polygons)
    format = find_row(format).polygons_as.value_or(format);
  std::vector<MeshField> all = options.fields;
  all.insert(all.end(), file.fields.begin(), file.fields.end());
  if (info_of(format).netcdf)
    out.fields.renamed = replace_names(all);
  out.options.fields.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool asked = i < options.fields.size();
    const bool replaced = is_replaced(file, all[i], format, polygons);
    const FieldFault fault = replaced ? FieldFault::name
                             : !polygons && is_coast_field(all[i], format)
                                 ? FieldFault::none
                                 : find_fault_on(file, all[i], format, polygons);
    if (fault == FieldFault::none)
      out.options.fields.push_back(std::move(all[i]));
    else if (asked)
      refuse_field(path, format, all[i], fault);
    else if (!replaced)
      out.fields.dropped.push_back(file.fields[i - options.fields.size()].name);
  }
  for (std::string& name : lost_masks(file, format, polygons))
    out.fields.dropped.push_back(std::move(name));
  return out;
}

} // namespace

void require_storable(const std::string& path, const MeshFile& file, const WriteOptions& options) {
  plan(path, file, options);
}

WrittenFields write(const std::string& path, const MeshFile& file, const WriteOptions& options) {
  WritePlan planned = plan(path, file, options);
  WriteOptions& resolved = planned.options;
  if (!options.planet_radius)
    resolved.planet_radius = file.planet_radius;
  if (planned.shape.polygons) {
    write_polygons(path, file, resolved);
  } else {
    if (options.density.uniform() && options.site_density.size() == 0)
      resolved.site_density = file.density;
    if (file.sphere())
      require_voronoi(path, *file.mesh, resolved.format);
    write(path, planned.shape.inner ? *planned.shape.inner : *file.mesh, resolved);
  }
  return std::move(planned.fields);
}

} // namespace calotte
