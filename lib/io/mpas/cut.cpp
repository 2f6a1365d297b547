// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cut.h>

#include "base/require.h"
#include "io/cells/limited_area_masks.h"
#include "io/mpas/mpas_part.h"
#include "io/mpas/mpas_subset.h"
#include "io/mpas/mpas_variables.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte {
namespace io_detail {
namespace {

Ids make_cell_mask(const MpasSource& source,
                   const std::function<bool(const Eigen::Vector3d&)>& inside, int rings) {
  return limited_area_mask(source.lists(mpas::cells_on_cell, source.cells()),
                           flag_points(source.generators(), inside), rings);
}

/// The masks of the kept cells, edges and vertices.
struct Masks {
  Ids cells, edges, vertices;
};

Masks make_masks(const MpasPart& part, const Ids& of_all) {
  Masks masks{Ids(part.cells.count()), {}, {}};
  for (std::int64_t i = 0; i < part.cells.count(); ++i)
    masks.cells[i] = of_all[part.cells.old[i]];
  masks.edges = least_mask(part.edges_on_cell, masks.cells, part.edges.count());
  masks.vertices = least_mask(part.vertices_on_cell, masks.cells, part.vertices.count());
  return masks;
}

void add_masks(const Masks& masks, int rings, NetcdfSubset& subset) {
  const auto add = [&](const MpasKind& kind, const Ids& mask, const std::string& name,
                       const std::string& meaning) {
    subset.left_out.push_back(name); // left by an earlier cut
    subset.added.push_back(
        {name, kind.dimension(), meaning, [&mask](std::int64_t i) { return mask[i]; }});
  };
  add(mpas_cell, masks.cells, cell_mask, cell_mask_meaning(rings));
  add(mpas_edge, masks.edges, edge_mask.name, edge_mask.meaning);
  add(mpas_vertex, masks.vertices, vertex_mask.name, vertex_mask.meaning);
}

// ---- Density

/// The values of a variable at the kept cells; empty if the file has no such variable with a value
/// for each cell.
DoubleVector kept_values(const MpasSource& source, const std::string& name, const Kept& kept) {
  const NetcdfReader& file = source.netcdf();
  if (!file.has_variable(name) || file.shape_of(name) != std::vector<std::int64_t>{source.cells()})
    return {};
  const std::vector<double> all = file.doubles(name, {source.cells()});
  DoubleVector values(kept.count());
  for (std::int64_t i = 0; i < kept.count(); ++i)
    values[i] = all[static_cast<std::size_t>(kept.old[i])];
  return values;
}

/// Scales the density to the maximum 1 over the kept cells, and sets the nominal spacing that
/// belongs to it.
void add_density(const MpasSource& source, const MpasPart& part, double radius,
                 NetcdfSubset& subset) {
  DoubleVector density = kept_values(source, mpas::mesh_density, part.cells);
  const double greatest = density.size() > 0 ? density.maxCoeff() : 0;
  if (!(greatest > 0 && std::isfinite(greatest)))
    return;
  density /= greatest;
  add_division(source, mpas::mesh_density, greatest, subset);
  if (source.netcdf().find(mpas::nominal_min_dc) >= 0)
    return add_division(source, mpas::nominal_min_dc, std::pow(greatest, 0.25), subset);
  const DoubleVector area = kept_values(source, mpas::area_cell, part.cells);
  if (area.size() > 0)
    subset.numbers.push_back(
        {mpas::nominal_min_dc, "m",
         "nominal distance of neighbouring generators where meshDensity is 1",
         nominal_spacing({area, density, {}, {}, {}}) * radius / source.radius()});
}

// ---- The file

void add_attributes(const MpasSource& source, double radius, NetcdfSubset& subset) {
  set_sphere(source, radius, subset);
  subset.attributes["is_periodic"] = {"is_periodic", std::string("NO")};
  subset.attributes["mesh_spec"] = {"mesh_spec", std::string("1.1")};
}

CutReport make_report(const MpasPart& part, const Masks& masks, int rings) {
  CutReport report{.cells = part.cells.count(),
                   .edges = part.edges.count(),
                   .vertices = part.vertices.count(),
                   .cells_by_mask = {},
                   .left_out = {}};
  report.cells_by_mask.resize(static_cast<std::size_t>(rings) + 1);
  for (const std::int32_t mask : masks.cells)
    ++report.cells_by_mask[static_cast<std::size_t>(mask)];
  return report;
}

} // namespace
} // namespace io_detail

CutReport cut(const std::string& source, const std::string& target, const Surface& region,
              const CutOptions& options) {
  const std::function<bool(const Eigen::Vector3d&)> inside = [&](const Eigen::Vector3d& point) {
    return region.contains(point);
  };
  return cut(source, target, inside, options);
}

CutReport cut(const std::string& path, const std::string& target,
              const std::function<bool(const Eigen::Vector3d&)>& inside,
              const CutOptions& options) {
  using namespace io_detail;
  const MpasSource source(path);
  const double radius = options.sphere_radius.value_or(source.radius());
  require(radius > 0 && std::isfinite(radius),
          "the radius of the sphere is not positive and finite; give another");
  const VertexOrder order = options.vertex_order.value_or(source.vertex_order());
  const Ids mask = make_cell_mask(source, inside, options.rings);
  const MpasPart part = select_part(source, mask);
  const Masks masks = make_masks(part, mask);
  NetcdfSubset subset = make_subset(source, part);
  add_masks(masks, options.rings, subset);
  add_radius(source, radius, subset);
  add_vertex_order(source, part, order, subset);
  add_density(source, part, radius, subset);
  add_attributes(source, radius, subset);
  subset.dimensions = options.dimensions;
  add_history(source, part, options.history, subset);
  CutReport report = make_report(part, masks, options.rings);
  report.sphere_radius = radius;
  report.vertex_order = order;
  report.left_out = write_part(source, part, subset, target, options.progress);
  return report;
}

} // namespace calotte
