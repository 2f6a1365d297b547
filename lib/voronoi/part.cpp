// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/part.h"

#include "base/lists.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "exact/space.h"
#include "mesh/stars.h"
#include "voronoi/open.h"
#include "voronoi/stages.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace calotte {
namespace voronoi_detail {
namespace {

/// The triangles and neighbours around kept sites, counter-clockwise from the lowest neighbour on:
/// triangle k lies between neighbours k and k + 1.
struct KeptStars {
  std::vector<std::int32_t> site;
  IdLists triangles, neighbours; ///< both with the same `begin`
};

KeptStars kept_stars(const Mesh& mesh, const Ids& mask) {
  const Faces faces = faces_of(mesh);
  const mesh_detail::Stars stars(faces);
  KeptStars out;
  std::vector<std::int64_t> begin{0};
  for (std::int32_t site = 0; site < mask.size(); ++site) {
    if (mask[site] < 0)
      continue;
    int corners = 0;
    const bool closed = stars.for_each_corner(site, [&](Corner) { ++corners; });
    if (!closed || corners != stars.size(site)) // the triangles form several fans
      refuse_at(site, "site {} is to have a cell, but triangles do not surround it; leave it "
                      "out, or mesh more points around it");
    out.site.push_back(site);
    begin.push_back(begin.back() + stars.size(site));
  }
  out.triangles.begin = out.neighbours.begin =
      Eigen::Map<const Offsets>(begin.data(), std::ssize(begin));
  out.triangles.items.resize(begin.back());
  out.neighbours.items.resize(begin.back());
  for_each_block(std::ssize(out.site), [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const auto triangles = out.triangles[i], neighbours = out.neighbours[i];
      std::size_t k = 0;
      stars.for_each_corner(out.site[static_cast<std::size_t>(i)], [&](Corner corner) {
        triangles[k] = corner.triangle;
        neighbours[k++] = following_site(faces, corner);
      });
      const auto lowest = std::ranges::min_element(neighbours) - neighbours.begin();
      std::rotate(triangles.begin(), triangles.begin() + lowest, triangles.end());
      std::rotate(neighbours.begin(), neighbours.begin() + lowest, neighbours.end());
    }
  });
  return out;
}

/// The triangles of the stars, ascending. \param lists ids of triangles, replaced by indices in the
/// result.
std::vector<std::int32_t> number_triangles(const Mesh& mesh, IdLists& lists) {
  std::vector<std::int32_t> vertex(static_cast<std::size_t>(mesh.triangles.cols()), none), used;
  for (const std::int32_t t : lists.items)
    vertex[static_cast<std::size_t>(t)] = 0;
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    if (std::int32_t& id = vertex[static_cast<std::size_t>(t)]; id >= 0) {
      id = static_cast<std::int32_t>(used.size());
      used.push_back(t);
    }
  for (std::int32_t& id : lists.items)
    id = vertex[static_cast<std::size_t>(id)];
  return used;
}

/// The midpoints of edges half way to a missing cell; NaN for other edges.
template <class S>
Points3 cut_edges(const S& space, const IdLists& neighbours, const Points3& sites,
                  const Voronoi& cells) {
  Points3 cut =
      Points3::Constant(3, cells.cells_on_edge.cols(), std::numeric_limits<double>::quiet_NaN());
  for (std::int64_t i = 0; i < cells.cells_on_cell.size(); ++i)
    for (std::size_t k = 0; k < cells.cells_on_cell[i].size(); ++k)
      if (cells.cells_on_cell[i][k] < 0)
        set_column(cut, cells.edges_on_cell[i][k],
                   space.midpoint(column(cells.cells, i), column(sites, neighbours[i][k])));
  return cut;
}

} // namespace

CellPart part_of(const Mesh& mesh, const Ids& mask) {
  KeptStars stars = kept_stars(mesh, mask);
  const Points3 sites = checked_centres(mesh);
  CellPart out{.voronoi = {}, .site = std::move(stars.site)};
  Voronoi& cells = out.voronoi;
  cells.surface = mesh.surface.is_sphere() ? Surface{} : mesh.surface;
  cells.cells = sites(Eigen::all, out.site);
  const std::vector<std::int32_t> used = number_triangles(mesh, stars.triangles);
  cells.vertices_on_cell = std::move(stars.triangles);
  cells.vertices.resize(3, std::ssize(used));
  in_space_of(mesh.surface, [&](const auto& space) {
    for_each_block(std::ssize(used), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t v = begin; v < end; ++v) {
        const auto corners = mesh.triangles.col(used[static_cast<std::size_t>(v)]);
        set_column(cells.vertices, v,
                   space.circumcentre(column(sites, corners[0]), column(sites, corners[1]),
                                      column(sites, corners[2])));
      }
    });
    connect_open(cells);
    measure_open(cells, cut_edges(space, stars.neighbours, sites, cells));
  });
  return out;
}

} // namespace voronoi_detail

Voronoi voronoi(const Mesh& mesh, const Ids& mask) {
  using namespace voronoi_detail;
  require(mask.size() == mesh.points.cols(), "there are {} masks for {} sites; give one for each",
          mask.size(), mesh.points.cols());
  require(mask.size() > 0 && mask.maxCoeff() >= 0, "no site is to have a cell; keep at least one");
  require(mesh.surface.is_sphere() || !mesh.surface.is_bounded(),
          "the boundary of the plane clips cells, of which no part can be kept; keep all");
  neighbours(mesh); // throws unless the arrays fit
  return part_of(mesh, mask).voronoi;
}

} // namespace calotte
