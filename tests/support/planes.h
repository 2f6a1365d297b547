// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/planar_domain.h"
#include "domain/region.h"
#include "mesh/planar_mesh.h"

#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/operators.h>
#include <calotte/quality.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <functional>
#include <string>
#include <vector>

/// The library's functions for meshes and places of the plane with two rows of coordinates, and
/// for parts of the sphere and the plane as their rings, for tests of the code that has these.
namespace calotte {

// ---- Parts of the sphere and of the plane

inline void require_region(const Region& region) {
  if (!region.whole())
    Surface::sphere().within({region.rings.begin(), region.rings.end()});
}
inline double area(const Surface& surface) { return surface.area(); }
inline bool contains(const Surface& surface, const Eigen::Vector3d& place) {
  return surface.contains(place);
}
inline std::function<bool(const Eigen::Vector3d&)> containing(const Surface& surface) {
  return [surface](const Eigen::Vector3d& at) { return surface.contains(at); };
}
inline std::function<bool(const Eigen::Vector2d&)> containing(const PlanarDomain& domain) {
  return [surface = Surface(domain)](const Eigen::Vector2d& at) {
    return surface.contains({at.x(), at.y(), 0});
  };
}
inline bool contains(const PlanarDomain& domain, const Eigen::Vector2d& place) {
  return containing(domain)(place);
}

inline PlanarDomain periodic_box(const Eigen::Vector2d& period) {
  return Surface::periodic(period);
}

// ---- Places

inline Points2 random_places(std::int64_t n, const PlanarDomain& domain, const Density& density,
                             std::uint64_t seed = 1) {
  return random_points(n, domain, density, seed).topRows<2>();
}
inline Points2 random_places(std::int64_t n, const PlanarDomain& domain, std::uint64_t seed = 1) {
  return random_places(n, domain, Density{}, seed);
}
inline Points2 lattice_places(std::int64_t n, const PlanarDomain& domain) {
  return hexagonal_lattice(n, domain).topRows<2>();
}

// ---- Meshes

/// A mesh in its domain.
inline Mesh in_domain(const PlanarDomain& domain, const PlanarMesh& mesh) {
  return mesh_detail::spatial(PlanarMesh(mesh), domain);
}

inline PlanarMesh periodic_hexagons(std::int64_t columns, std::int64_t rows, double spacing) {
  return mesh_detail::planar(hexagonal_box(columns, rows, spacing));
}

namespace test {

/// \throws Error invalid_argument for a mesh of the sphere.
inline PlanarMesh read_planar_mesh(const std::string& path, const Points2* points = nullptr) {
  Points3 places;
  if (points != nullptr)
    places = base_detail::with_z(*points);
  Mesh mesh = read_mesh(path, points != nullptr ? &places : nullptr);
  if (mesh.surface.is_sphere())
    throw Error(ErrorCode::invalid_argument, path + " holds a mesh of the sphere");
  return mesh_detail::planar(std::move(mesh));
}

} // namespace test
} // namespace calotte
