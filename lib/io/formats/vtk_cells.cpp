// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/mesh_intake.h"
#include "io/cells/model_grid.h"
#include "io/cells/polygons.h"
#include "io/formats/vtk_cell_types.h"
#include "io/formats/vtk_xml.h"

namespace calotte::io_detail {
namespace {

constexpr const char* cell_data = "CellData Scalars=\"spacing\"";

/// Adds points, connectivity, offsets and types.
void add_shapes(const Points3& corners, const Polygons& cells, VtkHead& head,
                std::vector<VtkContent>& contents) {
  add_points(corners.cols(), head);
  contents.push_back(make_content(corners));
  add_cells(cells.ids.items.size(), head);
  contents.emplace_back([&cells](Writer& out) {
    for (const std::int32_t corner : cells.ids.items)
      out.raw(std::int64_t{corner});
  });
  contents.emplace_back([&cells](Writer& out) {
    for (std::int64_t i = 1; i <= cells.size(); ++i)
      out.raw(cells.ids.begin[i]);
  });
  if (head.flavour.types)
    contents.emplace_back([&cells](Writer& out) {
      out.text(std::string(static_cast<std::size_t>(cells.size()), char{polygon_type}));
    });
}

} // namespace

void put_vtk_cells(const Sink& sink, const Mesh& mesh, const WriteOptions& options,
                   const VtkFlavour& flavour) {
  Voronoi voronoi = calotte::voronoi(mesh);
  const CellFields fields = make_cell_fields(voronoi, options);
  const Polygons cells = polygons_of(std::move(voronoi));
  const Points3 corners = find_radius(mesh.points) * cells.corners;
  VtkHead head{flavour, corners.cols(), cells.size(), {}};
  std::vector<VtkContent> contents;
  head.arrays.push_back({"PointData", "Int32", "triangle", head.points, 3});
  contents.emplace_back(
      [&](Writer& out) { out.text(bytes_of(mesh.triangles.data(), mesh.triangles.size())); });
  add_fields("PointData", options.fields, FieldLocation::vertices, head, contents);
  add_field_arrays("CellData", head.cells, head);
  add_field_contents(fields, contents);
  head.arrays.push_back({cell_data, "Float64", "site", head.cells, 3});
  contents.push_back(make_content(mesh.points));
  add_fields(cell_data, options.fields, FieldLocation::cells, head, contents);
  add_shapes(corners, cells, head, contents);
  put_vtk(sink, head, contents);
}

void put_vtk_cells(const Sink& sink, const Polygons& polygons, const WriteOptions& options,
                   const VtkFlavour& flavour) {
  const DoubleVector areas = areas_of(polygons);
  VtkHead head{flavour, polygons.corners.cols(), polygons.size(), {}};
  std::vector<VtkContent> contents;
  add_fields("PointData", options.fields, FieldLocation::vertices, head, contents);
  const std::vector<MeshField> own{{.name = "area", .values = areas}};
  add_fields("CellData", own, FieldLocation::cells, head, contents);
  if (polygons.centres.cols() > 0) {
    head.arrays.push_back({"CellData", "Float64", "site", head.cells, 3});
    contents.push_back(make_content(polygons.centres));
  }
  add_fields("CellData", options.fields, FieldLocation::cells, head, contents);
  add_shapes(polygons.corners, polygons, head, contents);
  put_vtk(sink, head, contents);
}

} // namespace calotte::io_detail
