// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "base/first_fault.h"
#include "base/message.h"
#include "base/points.h"
#include "base/require.h"
#include "integrals/moments.h"
#include "mesh/stars.h"
#include "quality/eigenvalues.h"
#include "quality/error_norms.h"
#include "quality/flat_hull.h"
#include "quality/sides.h"
#include "quality/truncation.h"
#include "quality/voronoi_mesh.h"
#include "voronoi/cell_fields.h"
#include "voronoi/part.h"

#include <calotte/check.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace calotte {
namespace quality_detail {
namespace {

void set_position(const Points3& cells, ErrorNorms& norms) {
  if (norms.cell >= 0)
    norms.position = cells.col(norms.cell);
}

/// Measures all errors except off_centroid.
OperatorErrors measure_errors(const Voronoi& cells) {
  OperatorErrors out;
  set_truncation(cells, out);
  out.primal_eigenvalue = primal_eigenvalue(cells);
  out.dual_eigenvalue = dual_eigenvalue(cells);
  return out;
}

/// \param first(i) the first moment of a cell; zero to skip the cell.
template <class First> ErrorNorms off_centroid(const Voronoi& cells, const First& first) {
  ErrorNorms norms = distance_norms(cells.cells.cols(), [&](std::int64_t i) {
    const Vec3 moment = first(i);
    return norm((1 / norm(moment)) * moment - column(cells.cells, i)) / spacing_at(cells, i);
  });
  set_position(cells.cells, norms);
  return norms;
}

/// \returns whether the mesh covers the sphere.
bool require_delaunay(const Mesh& mesh) {
  const CheckReport found = require_surface(mesh);
  if (const std::int64_t edges = count_edges(mesh).not_delaunay; edges > 0)
    refuse(message("{} edges are not Delaunay, so that the mesh has no Voronoi cells; "
                   "triangulate the points anew",
                   edges));
  return found.boundary_edges == 0;
}

// ---- The whole sphere

OperatorErrors of_closed(const Mesh& mesh, const Density& density) {
  const Voronoi cells = voronoi(mesh);
  OperatorErrors out = measure_errors(cells);
  const Moments moments = mesh_moments(mesh, density);
  FirstFault fault;
  out.off_centroid = off_centroid(cells, [&](std::int64_t i) {
    if (!(norm(moments.first[i]) > 0))
      fault.at(i);
    return moments.first[i];
  });
  fault.refuse("site", "has a cell over which the density is zero: make it positive everywhere");
  return out;
}

// ---- A part of it

/// The first moment of a cell of uniform density: half the sum over its neighbours of dv times the
/// unit chord from each. Zero at the boundary.
Vec3 first_moment(const Voronoi& cells, std::int64_t i) {
  Vec3 sum{0, 0, 0};
  const std::span<const std::int32_t> edges = cells.edges_on_cell[i],
                                      others = cells.cells_on_cell[i];
  for (std::size_t k = 0; k != edges.size(); ++k) {
    if (others[k] < 0)
      return {0, 0, 0};
    const Vec3 chord = column(cells.cells, i) - column(cells.cells, others[k]);
    sum = sum + (0.5 * cells.dv[edges[k]] / norm(chord)) * chord;
  }
  return sum;
}

/// Replaces numbers of cells by those of their sites.
void renumber(const std::vector<std::int32_t>& site, std::int64_t sites, OperatorErrors& out) {
  for (ErrorNorms* norms :
       {&out.divergence, &out.gradient, &out.laplacian, &out.curl, &out.tangential,
        &out.kinetic_energy, &out.off_centroid, &out.off_midpoint})
    if (norms->cell >= 0)
      norms->cell = site[static_cast<std::size_t>(norms->cell)];
  OperatorErrorsByCell& by_cell = out.by_cell;
  for (DoubleVector* values : {&by_cell.divergence, &by_cell.gradient, &by_cell.laplacian,
                               &by_cell.curl, &by_cell.tangential, &by_cell.kinetic_energy}) {
    DoubleVector of_sites = DoubleVector::Constant(sites, no_value);
    for (std::size_t i = 0; i < site.size(); ++i)
      of_sites[site[i]] = (*values)[static_cast<Eigen::Index>(i)];
    *values = std::move(of_sites);
  }
}

/// The mask of sites that are surrounded by triangles. \throws Error invalid_argument if there is
/// none.
Ids surrounded(const Mesh& mesh) {
  const mesh_detail::Stars stars(faces_of(mesh));
  Ids mask(mesh.points.cols());
  for (std::int32_t site = 0; site < mask.size(); ++site)
    mask[site] = stars.is_closed(site) ? 0 : none;
  require(mask.maxCoeff() >= 0,
          "triangles surround no site of the open mesh, so that it has no whole cell");
  return mask;
}

OperatorErrors of_open(const Mesh& mesh) {
  const voronoi_detail::CellPart whole = voronoi_detail::part_of(mesh, surrounded(mesh));
  OperatorErrors out = measure_errors(whole.voronoi);
  out.off_centroid =
      off_centroid(whole.voronoi, [&](std::int64_t i) { return first_moment(whole.voronoi, i); });
  renumber(whole.site, mesh.points.cols(), out);
  return out;
}

OperatorErrors in_plane(const Mesh& mesh, const Density& density) {
  const DoubleVector off = cell_measures(mesh, density).off_centroid;
  const Voronoi cells = voronoi(mesh);
  OperatorErrors out = measure_errors(cells);
  out.off_centroid = distance_norms(off.size(), [&](std::int64_t i) { return off[i]; });
  set_position(cells.cells, out.off_centroid);
  return out;
}

} // namespace
} // namespace quality_detail

OperatorErrors operator_errors(const Mesh& mesh, const Density& density) {
  using namespace quality_detail;
  if (!mesh.surface.is_sphere())
    return in_plane(mesh, density);
  evaluate(density, Points3(Eigen::Vector3d::UnitZ())); // throws if the density is ill-formed
  const bool closed = require_delaunay(mesh);
  const Mesh unit = without_flat_hull(with_unit_columns(mesh)).mesh;
  return closed ? of_closed(unit, density) : of_open(unit);
}

} // namespace calotte
