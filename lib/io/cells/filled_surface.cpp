// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/surface.h"
#include "io/cells/polygons.h"

#include <calotte/error.h>
#include <calotte/mesh_file.h>

#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

/// For each corner of polygons, the next one along their boundary; -1 for inner corners. None if
/// the boundary passes a corner more than once.
std::optional<std::vector<std::int32_t>> find_boundary(const Polygons& polygons) {
  const Sides sides(polygons);
  std::vector<std::int32_t> next(static_cast<std::size_t>(sides.from.size()), -1);
  for (std::int32_t from = 0; from < sides.from.size(); ++from)
    for (const auto& side : sides.from[from]) {
      if (sides.polygon_of(side.to, from) >= 0)
        continue;
      std::int32_t& after = next[static_cast<std::size_t>(from)];
      if (after >= 0)
        return std::nullopt;
      after = side.to;
    }
  return next;
}

/// The part of the plane that this boundary encloses.
Surface domain_in(std::vector<std::int32_t> next, const Polygons& polygons) {
  Surface::Rings rings;
  for (std::size_t start = 0; start < next.size(); ++start) {
    std::vector<std::int32_t> ring;
    for (auto at = static_cast<std::int32_t>(start); next[static_cast<std::size_t>(at)] >= 0;) {
      ring.push_back(at);
      at = std::exchange(next[static_cast<std::size_t>(at)], -1);
    }
    if (!ring.empty())
      rings.emplace_back(polygons.corners(Eigen::all, ring).topRows<2>());
  }
  return domain_detail::UncheckedSurface::of_plane(std::move(rings), {0, 0});
}

/// Whether the polygons are the Voronoi cells of the mesh, clipped to a part of the plane.
bool clips_to(const Surface& part, Mesh mesh, const Polygons& polygons) {
  try {
    mesh.surface = part;
    return part.is_bounded() && are_areas_of(polygons, voronoi(mesh).cell_area);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_argument) // a cell in several parts, or rings that touch
      throw;
    return false;
  }
}

} // namespace

std::optional<Surface> filled_surface(const MeshFile& file) {
  const Mesh* plane = file.plane();
  if (!plane)
    return std::nullopt;
  if (plane->surface.is_bounded() || plane->closed())
    return plane->surface;
  if (!file.polygons || plane->surface.period().maxCoeff() > 0)
    return std::nullopt;
  std::optional<std::vector<std::int32_t>> next = find_boundary(*file.polygons);
  if (!next)
    return std::nullopt;
  const Surface part = domain_in(*std::move(next), *file.polygons);
  return clips_to(part, *plane, *file.polygons) ? std::optional(part) : std::nullopt;
}

} // namespace calotte
