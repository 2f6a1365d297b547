// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/whole_cells.h"

#include "base/points.h"
#include "exact/predicates.h"
#include "mesh/stars.h"
#include "voronoi/open.h"

#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace calotte::quality_detail {
namespace {

Vec3 circumcentre_of(const Mesh& mesh, std::int32_t t) {
  const Vec3 a = column(mesh.points, mesh.triangles(0, t)),
             b = column(mesh.points, mesh.triangles(1, t)),
             c = column(mesh.points, mesh.triangles(2, t));
  return normalised(cross(b - a, c - a));
}

} // namespace

WholeCells whole_cells(const Mesh& mesh) {
  const mesh_detail::Stars stars(faces_of(mesh));
  std::vector<std::int32_t> ring, used; // triangles, by entry of a cell
  std::vector<std::int64_t> begin{0};
  WholeCells out;
  for (std::int32_t site = 0; site < mesh.points.cols(); ++site)
    if (stars.is_closed(site)) {
      ring.clear();
      stars.for_each_corner(site, [&](Corner corner) { ring.push_back(corner.triangle); });
      std::rotate(ring.begin(), std::max_element(ring.begin(), ring.end()), ring.end());
      used.insert(used.end(), ring.begin(), ring.end());
      begin.push_back(std::ssize(used));
      out.site.push_back(site);
    }
  if (out.site.empty())
    throw Error(ErrorCode::invalid_argument,
                "triangles surround no site of the open mesh, so that it has no whole cell");
  std::vector<std::int32_t> vertex(static_cast<std::size_t>(mesh.triangles.cols()), -1);
  for (const std::int32_t t : used)
    vertex[static_cast<std::size_t>(t)] = 0;
  std::int32_t vertices = 0;
  for (std::int32_t& id : vertex)
    if (id == 0)
      id = vertices++;

  Voronoi& cells = out.voronoi;
  cells.cells.resize(3, std::ssize(out.site));
  for (std::size_t i = 0; i < out.site.size(); ++i)
    cells.cells.col(static_cast<Eigen::Index>(i)) = mesh.points.col(out.site[i]);
  cells.vertices_on_cell.begin = Eigen::Map<const Offsets>(begin.data(), std::ssize(begin));
  cells.vertices_on_cell.items.resize(std::ssize(used));
  std::transform(used.begin(), used.end(), cells.vertices_on_cell.items.begin(),
                 [&](std::int32_t t) { return vertex[static_cast<std::size_t>(t)]; });
  cells.vertices.resize(3, vertices);
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    if (const std::int32_t id = vertex[static_cast<std::size_t>(t)]; id >= 0)
      set_column(cells.vertices, id, circumcentre_of(mesh, t));
  connect_open(cells);
  measure_open(cells);
  return out;
}

} // namespace calotte::quality_detail
