// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/model_grid.h"
#include "io/formats/vtk_cell_types.h"
#include "io/formats/vtk_xml.h"

namespace calotte::io_detail {
namespace {

/// Whether each cell has all its corners.
bool has_fields(const Mesh& mesh) {
  return mesh.closed() && mesh.neighbours.cols() == mesh.triangles.cols() &&
         mesh.neighbours.minCoeff() >= 0;
}

} // namespace

void put_vtk_triangles(const Sink& sink, const Mesh& mesh, const WriteOptions& options,
                       const VtkFlavour& flavour) {
  const std::int64_t triangles = mesh.triangles.cols();
  std::vector<VtkContent> contents;
  VtkHead head{flavour, mesh.points.cols(), triangles, {}};
  CellFields fields;
  if (has_fields(mesh)) {
    fields = make_cell_fields(voronoi(mesh), options);
    add_field_arrays("PointData", head.points, head);
    add_field_contents(fields, contents);
  }
  add_fields(head.arrays.empty() ? "PointData" : "PointData Scalars=\"spacing\"", options.fields,
             FieldLocation::cells, head, contents);
  add_fields("CellData", options.fields, FieldLocation::vertices, head, contents);
  add_points(head.points, head);
  add_cells(3 * head.cells, head);
  contents.push_back(make_content(mesh.points));
  contents.emplace_back([&](Writer& out) {
    for (std::int64_t i = 0; i < 3 * triangles; ++i)
      out.raw(std::int64_t{mesh.triangles.data()[i]});
  });
  contents.emplace_back([&](Writer& out) {
    for (std::int64_t t = 0; t < triangles; ++t)
      out.raw(3 * (t + 1));
  });
  if (flavour.types)
    contents.emplace_back([&](Writer& out) {
      out.text(std::string(static_cast<std::size_t>(triangles), char{triangle_type}));
    });
  put_vtk(sink, head, contents);
}

} // namespace calotte::io_detail
