// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/boundary_pieces.h"

#include "domain/arcs.h"
#include "domain/spherical_area.h"
#include "io/bytes/file_error.h"
#include "mesh/boundary_loops.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <utility>

namespace calotte::io_detail {
namespace {

using namespace mesh_detail;

/// The number of the connected part of each triangle.
std::vector<std::int32_t> parts_of(const Faces& faces) {
  std::vector<std::int32_t> part(static_cast<std::size_t>(faces.triangles()), -1);
  std::int32_t parts = 0;
  std::vector<std::int64_t> stack;
  for (std::int64_t start = 0; start < faces.triangles(); ++start) {
    if (part[static_cast<std::size_t>(start)] >= 0)
      continue;
    part[static_cast<std::size_t>(start)] = parts;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::int64_t t = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i)
        if (const std::int32_t other = faces.neighbour(t, i);
            other >= 0 && part[static_cast<std::size_t>(other)] < 0) {
          part[static_cast<std::size_t>(other)] = parts;
          stack.push_back(other);
        }
    }
    ++parts;
  }
  return part;
}

/// The area beyond a loop, to the right of it; of a plane infinite around the mesh.
double area_beyond(const Mesh& mesh, const std::vector<std::int32_t>& loop) {
  if (!mesh.surface.is_sphere()) {
    double twice = 0;
    std::int32_t before = loop.back();
    for (const std::int32_t site : loop) {
      twice += mesh.points(0, before) * mesh.points(1, site) -
               mesh.points(0, site) * mesh.points(1, before);
      before = site;
    }
    return twice > 0 ? std::numeric_limits<double>::infinity() : -twice / 2;
  }
  std::vector<Vec3> corners; // in reverse, as the area is to the left
  for (auto site = loop.rbegin(); site != loop.rend(); ++site)
    corners.push_back(domain_detail::as_unit(column(mesh.points, *site)));
  std::vector<domain_detail::Arc> arcs;
  for (std::size_t k = 0; k < corners.size(); ++k)
    arcs.push_back({corners[k], corners[(k + 1) % corners.size()]});
  return domain_detail::area_to_the_left(arcs);
}

std::vector<std::int32_t> sites_of(const Faces& faces, std::span<const std::int64_t> edges) {
  std::vector<std::int32_t> sites;
  for (const std::int64_t edge : edges)
    sites.push_back(start_of(faces, edge));
  return sites;
}

/// Whether each loop has the largest area beyond it in its connected part.
std::vector<bool> find_mainlands(const Mesh& mesh, const EdgeLoops& loops) {
  const Faces faces = faces_of(mesh);
  const std::vector<std::int32_t> parts = parts_of(faces);
  std::map<std::int32_t, std::pair<double, std::size_t>> largest; // by part: its area, its loop
  for (std::int64_t k = 0; k < loops.size(); ++k) {
    const double area = area_beyond(mesh, sites_of(faces, loops[k]));
    const std::int32_t part = parts[static_cast<std::size_t>(loops[k][0] / 3)];
    const auto [known, is_first] = largest.try_emplace(part, area, k);
    if (!is_first && area > known->second.first)
      known->second = {area, static_cast<std::size_t>(k)};
  }
  std::vector<bool> is_mainland(static_cast<std::size_t>(loops.size()));
  for (const auto& [part, loop] : largest)
    is_mainland[loop.second] = true;
  return is_mainland;
}

/// Cuts a loop where open and other edges meet. \pre both occur.
/// \param is_open by edge of the loop, from a site to the next one.
void cut_loop(const std::vector<std::int32_t>& loop, const std::vector<bool>& is_open,
              std::vector<BoundaryPiece>& pieces) {
  const std::size_t n = loop.size();
  std::size_t first = 0;
  while (is_open[first] == is_open[(first + n - 1) % n])
    ++first;
  for (std::size_t k = first; k < first + n; ++k) {
    if (k == first || is_open[k % n] != is_open[(k - 1) % n])
      pieces.push_back({.kind = is_open[k % n] ? BoundaryKind::open : BoundaryKind::land,
                        .sites = {loop[k % n]}});
    pieces.back().sites.push_back(loop[(k + 1) % n]);
  }
}

} // namespace

std::vector<BoundaryPiece> boundary_pieces(const Mesh& mesh, const Ids& open_sites) {
  const Faces faces = faces_of(mesh);
  const EdgeLoops loops = edge_loops(faces);
  const std::vector<bool> is_mainland = find_mainlands(mesh, loops);
  std::vector<bool> is_site(static_cast<std::size_t>(mesh.points.cols()));
  for (const std::int32_t site : open_sites)
    is_site[static_cast<std::size_t>(site)] = true;
  std::vector<BoundaryPiece> pieces;
  for (std::int64_t k = 0; k < loops.size(); ++k) {
    std::vector<std::int32_t> sites = sites_of(faces, loops[k]);
    std::vector<bool> is_open;
    for (const std::int64_t edge : loops[k])
      is_open.push_back(is_site[static_cast<std::size_t>(start_of(faces, edge))] &&
                        is_site[static_cast<std::size_t>(end_of(faces, edge))]);
    const auto open = std::ranges::count(is_open, true);
    if (open > 0 && open < std::ssize(sites)) {
      cut_loop(sites, is_open, pieces);
      continue;
    }
    pieces.push_back({.kind = open > 0                                   ? BoundaryKind::open
                              : is_mainland[static_cast<std::size_t>(k)] ? BoundaryKind::land
                                                                         : BoundaryKind::island,
                      .closed = true,
                      .sites = std::move(sites)});
  }
  std::ranges::stable_sort(pieces, {}, &BoundaryPiece::kind);
  return pieces;
}

std::vector<BoundaryPiece> halved(std::vector<BoundaryPiece> pieces,
                                  const std::vector<BoundaryKind>& kinds) {
  std::vector<BoundaryPiece> out;
  for (BoundaryPiece& piece : pieces) {
    if (!piece.closed || std::ranges::find(kinds, piece.kind) == kinds.end()) {
      out.push_back(std::move(piece));
      continue;
    }
    piece.sites.push_back(piece.sites.front());
    const auto middle = piece.sites.begin() + std::ssize(piece.sites) / 2;
    out.push_back({.kind = piece.kind, .sites = {piece.sites.begin(), middle + 1}});
    out.push_back({.kind = piece.kind, .sites = {middle, piece.sites.end()}});
  }
  return out;
}

void require_simple_boundary(const std::string& path, const Mesh& mesh, const char* model) {
  const Faces faces = faces_of(mesh);
  std::vector<bool> is_used(static_cast<std::size_t>(mesh.points.cols())), is_start = is_used;
  for (std::int64_t t = 0; t < faces.triangles(); ++t)
    for (int i = 0; i < 3; ++i) {
      is_used[static_cast<std::size_t>(faces.vertex(t, i))] = true;
      const std::int32_t start = start_of(faces, 3 * t + i);
      if (faces.neighbour(t, i) < 0 && is_start[static_cast<std::size_t>(start)])
        refuse_path(path,
                    "the boundary passes site {} more than once, which {} refuses; widen the sea "
                    "there, as calotte coast does",
                    start, model);
      if (faces.neighbour(t, i) < 0)
        is_start[static_cast<std::size_t>(start)] = true;
    }
  if (const auto unused = std::ranges::find(is_used, false); unused != is_used.end())
    refuse_path(path, "site {} is in no triangle, which {} refuses; leave the point out",
                unused - is_used.begin(), model);
}

} // namespace calotte::io_detail
