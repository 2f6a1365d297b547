// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "cvt/cvt.h"
#include "domain/surface.h"

#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/operators.h>
#include <calotte/quality.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <concepts>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// The library's functions for meshes and places of the plane with two rows of coordinates, and
/// for parts of the sphere and the plane as their rings, for tests of the code that has these.
namespace calotte {

// ---- Parts of the sphere and of the plane as rings; their surfaces are not checked

struct Region {
  std::vector<Points3> rings; ///< none for the whole sphere

  Region() = default;
  Region(std::vector<Points3> all) : rings(std::move(all)) {}
  Region(const Surface& surface) {
    domain_detail::require_sphere(surface, "a region is");
    rings.assign(surface.rings().begin(), surface.rings().end());
  }
  operator Surface() const { return domain_detail::UncheckedSurface::of_sphere(surface_rings()); }
  Surface::Rings surface_rings() const { return {rings.begin(), rings.end()}; }
  bool whole() const { return rings.empty(); }
};

struct PlanarDomain {
  std::vector<DoubleMatrix> rings; ///< none for a periodic box
  Eigen::Vector2d period{0, 0};

  PlanarDomain() = default;
  PlanarDomain(std::vector<DoubleMatrix> all, const Eigen::Vector2d& box = {0, 0})
      : rings(std::move(all)), period(box) {}
  PlanarDomain(const Surface& surface) : rings(surface.rings()), period(surface.period()) {
    domain_detail::require_plane(surface, "a domain is");
  }
  operator Surface() const { return domain_detail::UncheckedSurface::of_plane(rings, period); }

  bool periodic() const { return rings.empty(); }
};

/// A Mesh of the plane with two rows of coordinates, and without the rings that clip its cells.
struct PlanarMesh {
  Points2 points;
  Triangles triangles, neighbours;
  std::vector<std::int32_t> site_of_input;
  Eigen::Vector2d period{0, 0};

  PlanarMesh() = default;
  PlanarMesh(Points2 sites, Triangles corners, Triangles beyond, std::vector<std::int32_t> inputs,
             const Eigen::Vector2d& box = {0, 0})
      : points(std::move(sites)), triangles(std::move(corners)), neighbours(std::move(beyond)),
        site_of_input(std::move(inputs)), period(box) {}
  explicit PlanarMesh(const Mesh& mesh)
      : PlanarMesh(mesh.points.topRows<2>(), mesh.triangles, mesh.neighbours, mesh.site_of_input,
                   mesh.surface.period()) {}
  operator Mesh() const {
    return in(period.maxCoeff() > 0 ? Surface::periodic(period) : Surface::plane());
  }
  Mesh in(const Surface& surface) const {
    return {base_detail::with_z(points), triangles, neighbours, site_of_input, surface};
  }
  bool closed() const { return period.minCoeff() > 0 && triangles.cols() == 2 * points.cols(); }
};

// ---- Triangulations and tessellations of one kind of surface each

template <class Result, class Points>
Result triangulated(Points&& points, const Surface& surface, const DelaunayOptions& options,
                    DelaunayReport* report) {
  Triangulation out = triangulate(std::forward<Points>(points), surface, options);
  if (report != nullptr)
    *report = std::move(out.report);
  return Result(std::move(out.mesh));
}

template <class Points>
Mesh spherical_delaunay(Points&& points, const DelaunayOptions& options = {},
                        DelaunayReport* report = nullptr) {
  return triangulated<Mesh>(std::forward<Points>(points), Surface::sphere(), options, report);
}
inline PlanarMesh planar_delaunay(const PointsRef& points, const DelaunayOptions& options = {},
                                  DelaunayReport* report = nullptr) {
  return triangulated<PlanarMesh>(points, Surface::plane(), options, report);
}
inline PlanarMesh periodic_delaunay(const PointsRef& points, const Eigen::Vector2d& period,
                                    const DelaunayOptions& options = {},
                                    DelaunayReport* report = nullptr) {
  return triangulated<PlanarMesh>(points, PlanarDomain({}, period), options, report);
}

struct PlanarCvt {
  PlanarMesh mesh;
  CvtReport report;

  PlanarCvt() = default;
  PlanarCvt(Cvt&& cvt) : mesh(cvt.mesh), report(std::move(cvt.report)) {}
};

/// \param start points, or the state of a run.
template <class Start>
Cvt spherical_cvt(Start&& start, const CvtOptions& options = {}, const CvtCallback& callback = {}) {
  return cvt(std::forward<Start>(start), Surface::sphere(), options, callback);
}
template <class Start>
Cvt spherical_cvt(Start&& start, const Region& region, const CvtOptions& options = {},
                  const CvtCallback& callback = {}) {
  return cvt(std::forward<Start>(start), region, options, callback);
}
template <class Start>
PlanarCvt planar_cvt(Start&& start, const PlanarDomain& domain, const CvtOptions& options = {},
                     const CvtCallback& callback = {}) {
  return cvt(std::forward<Start>(start), domain, options, callback);
}

inline void require_region(const Region& region) {
  if (!region.rings.empty())
    Surface::sphere().within({region.rings.begin(), region.rings.end()});
}
inline void require_domain(const PlanarDomain& domain) {
  if (domain.periodic())
    domain_detail::require_finite_plane(domain);
  else
    Surface::plane().within(domain.rings);
}
/// The sum of the triangles of a mesh of a plane, counter-clockwise ones > 0.
inline double area_of_triangles(const Mesh& mesh) {
  double area = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const Eigen::Vector3d a = mesh.points.col(mesh.triangles(0, t)),
                          u = mesh.points.col(mesh.triangles(1, t)) - a,
                          v = mesh.points.col(mesh.triangles(2, t)) - a;
    area += (u.x() * v.y() - u.y() * v.x()) / 2;
  }
  return area;
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
  return mesh.in(domain);
}

inline PlanarMesh periodic_hexagons(std::int64_t columns, std::int64_t rows, double spacing) {
  return PlanarMesh(hexagonal_box(columns, rows, spacing));
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
  return PlanarMesh(mesh);
}

} // namespace test
} // namespace calotte
