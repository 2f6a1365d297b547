// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtk_xml.h"

#include "io/binary.h"

namespace calotte::io_detail {
namespace {

constexpr std::uint8_t polygon_type = 7;

/// Three cells meet in a corner.
VtkHead head_of(const VtkHead& counts) {
  VtkHead head = counts;
  head.arrays.push_back({"PointData", "Int32", "triangle", head.points, 3});
  add_field_arrays("CellData", head.cells, head);
  head.arrays.push_back({"CellData Scalars=\"spacing\"", "Float64", "site", head.cells, 3});
  add_points(head.points, head);
  add_cells(3 * head.points, head);
  return head;
}

} // namespace

void put_vtk_cells(const Sink& sink, const Mesh& mesh, const WriteOptions& options,
                   const VtkFlavour& flavour) {
  const Voronoi cells = voronoi(mesh);
  const CellFields fields = cell_fields(cells, options.density);
  const std::int64_t count = mesh.points.cols();
  std::vector<VtkContent> contents;
  contents.emplace_back(
      [&](Writer& out) { out.text(bytes_of(mesh.triangles.data(), mesh.triangles.size())); });
  add_field_contents(fields, contents);
  contents.push_back(content_of(mesh.points));
  contents.push_back(content_of(cells.vertices));
  contents.emplace_back([&](Writer& out) {
    for (const std::int32_t corner : cells.vertices_on_cell)
      out.raw(std::int64_t{corner});
  });
  contents.emplace_back([&](Writer& out) {
    for (std::int64_t i = 1; i <= count; ++i)
      out.raw(cells.begin[i]);
  });
  if (flavour.types)
    contents.emplace_back(
        [&](Writer& out) { out.text(std::string(static_cast<std::size_t>(count), polygon_type)); });
  put_vtk(sink, head_of({flavour, cells.vertices.cols(), count, {}}), contents);
}

std::optional<Soup> vtk_cells(std::string_view content, const std::string& name,
                              const VtkHead& counts) {
  const auto blocks = vtk_blocks(content, name, head_of(counts));
  if (!blocks)
    return std::nullopt;
  const std::string_view triangles = blocks->front(), sites = (*blocks)[6];
  Soup soup{Points3(3, counts.cells), Triangles(3, counts.points)};
  std::memcpy(soup.points.data(), sites.data(), sites.size());
  std::memcpy(soup.triangles.data(), triangles.data(), triangles.size());
  return soup;
}

} // namespace calotte::io_detail
