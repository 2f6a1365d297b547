// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cut.h>

#include "base/monitor.h"
#include "io/cells/limited_area_masks.h"
#include "io/cells/model_grid.h"
#include "io/formats/write_mesh.h"
#include "io/mpas/mpas.h"
#include "voronoi/part.h"

#include <calotte/mesh.h>
#include <calotte/write.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

/// The cells of the area, and the mask of each.
struct Area {
  Voronoi cells;
  MeshField mask;
};

Area make_area(const Mesh& mesh, const Surface& region, Numbering numbering) {
  const Mesh sorted = renumbered(mesh, numbering);
  const Ids mask = limited_area_mask(
      neighbours(sorted),
      flag_points(sorted.points, [&](const Eigen::Vector3d& x) { return region.contains(x); }));
  CellPart part = voronoi_detail::part_of(sorted, mask);
  Area area{std::move(part.voronoi),
            {.name = cell_mask,
             .long_name = cell_mask_meaning(limited_area_rings),
             .units = "1",
             .integer = true}};
  area.mask.values = mask(part.site).cast<double>();
  return area;
}

CutReport make_report(const Area& area, const WriteOptions& options) {
  CutReport report;
  report.cells = area.cells.cells.cols();
  report.edges = area.cells.cells_on_edge.cols();
  report.vertices = area.cells.vertices.cols();
  report.sphere_radius = options.sphere_radius;
  report.vertex_order = *options.vertex_order;
  for (int mask = 0; mask <= limited_area_rings; ++mask)
    report.cells_by_mask.push_back((area.mask.values.array() == mask).count());
  return report;
}

} // namespace

CutReport write_limited_area(const std::string& target, const Mesh& mesh, const Surface& region,
                             const WriteOptions& options) {
  WriteOptions resolved = options;
  resolved.format = Format::mpas;
  resolved.vertex_order = options.vertex_order.value_or(VertexOrder::before_edges);
  resolved.site_density = {};
  require_options(target, resolved);
  Area area = make_area(mesh, region, choose_numbering(resolved));
  const CutReport report = make_report(area, resolved);
  resolved.fields = {std::move(area.mask)};
  Points3 points = on_sphere(area.cells.cells, resolved.sphere_radius);
  write_mpas(target, std::move(area.cells), std::move(points), resolved);
  Monitor(options.progress).finish("write");
  return report;
}

} // namespace calotte
