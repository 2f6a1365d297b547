// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model_grid.h"
#include "io/vtk_xml.h"

#include "io/binary.h"

namespace calotte::io_detail {
namespace {

constexpr std::uint8_t triangle_type = 5;

/// Earlier versions wrote no fields.
VtkHead head_of(const VtkHead& counts, bool fields) {
  VtkHead head = counts;
  if (fields)
    add_field_arrays("PointData", head.points, head);
  add_points(head.points, head);
  add_cells(3 * head.cells, head);
  return head;
}

/// Whether each cell has all its corners.
bool has_fields(const Mesh& mesh) {
  return mesh.closed() && mesh.neighbours.cols() == mesh.triangles.cols() &&
         mesh.neighbours.minCoeff() >= 0;
}

/// Ids beyond an int32 become -1, which read_mesh refuses as it does every id out of range.
Triangles triangles_of(std::string_view connectivity) {
  Triangles triangles(3, static_cast<Eigen::Index>(connectivity.size() / 24));
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    const auto id = load<std::int64_t>(connectivity.data() + 8 * i);
    const auto narrow = static_cast<std::int32_t>(id);
    triangles.data()[i] = narrow == id ? narrow : -1;
  }
  return triangles;
}

void require_triangles(const std::string& name, std::string_view offsets, std::string_view types) {
  for (std::size_t t = 0; t < offsets.size() / 8; ++t)
    if (load<std::int64_t>(offsets.data() + 8 * t) != static_cast<std::int64_t>(3 * (t + 1)) ||
        (!types.empty() && types[t] != triangle_type))
      Bytes(offsets, name)
          .fail("cell " + std::to_string(t) + " is not a triangle; only triangles are read");
}

} // namespace

void put_vtk_triangles(const Sink& sink, const Mesh& mesh, const WriteOptions& options,
                       const VtkFlavour& flavour) {
  const std::int64_t triangles = mesh.triangles.cols();
  std::vector<VtkContent> contents;
  VtkHead head{flavour, mesh.points.cols(), triangles, {}};
  CellFields fields;
  if (has_fields(mesh)) {
    fields = fields_of(voronoi(mesh), options);
    add_field_arrays("PointData", head.points, head);
    add_field_contents(fields, contents);
  }
  add_fields(head.arrays.empty() ? "PointData" : "PointData Scalars=\"spacing\"", options.fields,
             Location::cells, head, contents);
  add_fields("CellData", options.fields, Location::vertices, head, contents);
  add_points(head.points, head);
  add_cells(3 * head.cells, head);
  contents.push_back(content_of(mesh.points));
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
      out.text(std::string(static_cast<std::size_t>(triangles), triangle_type));
    });
  put_vtk(sink, head, contents);
}

std::optional<Soup> vtk_triangles(std::string_view content, const std::string& name,
                                  const VtkHead& counts) {
  for (const bool fields : {true, false}) {
    const VtkHead head = head_of(counts, fields);
    const auto blocks = vtk_blocks(content, name, head);
    if (!blocks)
      continue;
    const std::string_view* const mesh = blocks->data() + (fields ? 5 : 0);
    require_triangles(name, mesh[2], counts.flavour.types ? mesh[3] : std::string_view());
    Soup soup{Points3(3, counts.points), triangles_of(mesh[1])};
    std::memcpy(soup.points.data(), mesh[0].data(), mesh[0].size());
    return soup;
  }
  return std::nullopt;
}

} // namespace calotte::io_detail
