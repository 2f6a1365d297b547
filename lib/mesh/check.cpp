// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check_laws.h"
#include "mesh/edge_counts.h"
#include "mesh/planar_check.h"

#include "base/message.h"
#include "base/points.h"
#include "base/spherical_triangle.h"
#include "curve/hilbert.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <vector>

namespace calotte {
namespace {

using base_detail::Array, base_detail::message;
using base_detail::Vec3;
using mesh_detail::Area;

std::string direction_failure(const Mesh& mesh, std::int64_t site) {
  const auto p = mesh.points.col(site);
  const bool good = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]) &&
                    (p[0] != 0 || p[1] != 0 || p[2] != 0);
  return good ? std::string() : message("site {} is not a direction", site);
}

/// The area of a triangle known to be counter-clockwise, and a bound on its error. With p = b-a (or
/// b+a) and q = c-b, half of it is the angle of det = a . p x q and s = (a+b) . (a+c), see
/// half_area().
///
/// The unit vectors' lengths are good to 5 roundoffs u (their directions are free: any move of the
/// sites leaves the sum of the areas as it is). So det errs by 15u and, in its evaluation, by (6
/// sqrt 3 + 2)u times |p| |q|; s by 40u for the lengths and 20u in its evaluation; the angle by
/// (|s| err(det) + det err(s)) / (det^2 + s^2) and, in its evaluation, by 7u of itself.
Area area_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto [sine, s] = base_detail::half_area(a, b, c);
  const double det = std::max(0.0, sine); // not -0, whose angle may be -pi
  const double angle = base_detail::longitude_of(s, det);
  const Vec3 p = dot(a, b) > 0 ? b - a : b + a, q = c - b;
  const double det_error = 32 * exact_detail::roundoff * std::sqrt(dot(p, p) * dot(q, q));
  const double s_error = 96 * exact_detail::roundoff;
  const double angle_error = (std::abs(s) * det_error + det * s_error) / (det * det + s * s) +
                             7 * exact_detail::roundoff * angle;
  return {2 * angle, 2 * std::min(std::numbers::pi, angle_error)};
}

Array<Vec3> unit_vectors(const Points3& points) {
  Array<Vec3> unit(points.cols());
  base_detail::for_each_block(
      points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i != end; ++i)
          unit[i] = exact_detail::normalised({points(0, i), points(1, i), points(2, i)});
      });
  return unit;
}

/// True if all points are unit vectors as accurate as normalised ones, within 5 roundoffs: squares
/// within 6, and known to 3, are within 10.
bool are_unit_vectors(const Points3& points) {
  std::atomic<bool> are{true};
  base_detail::for_each_block(
      points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        bool good = true;
        for (std::int64_t i = begin; i != end; ++i) {
          const Vec3& x = base_detail::column(points, i);
          good = good && std::abs(dot(x, x) - 1) <= 6 * exact_detail::roundoff;
        }
        if (!good)
          are = false;
      });
  return are;
}

/// A mesh with its unit vectors, which the filters of the predicates read.
struct OnSphere : mesh_detail::Faces {
  static constexpr const char* circle = "cap";

  const Mesh& mesh;
  Array<Vec3> normalised; ///< of points that are not: a copy is as large as they are
  const Vec3* unit;

  explicit OnSphere(const Mesh& given)
      : Faces(mesh_detail::faces_of(given)), mesh(given),
        normalised(are_unit_vectors(given.points) ? Array<Vec3>() : unit_vectors(given.points)),
        unit(normalised.size() > 0 ? normalised.begin()
                                   : reinterpret_cast<const Vec3*>(given.points.data())) {}

  Vec3 given(std::int32_t site) const {
    return {mesh.points(0, site), mesh.points(1, site), mesh.points(2, site)};
  }

  int orientation(std::int32_t a, std::int32_t b, std::int32_t c) const {
    const int sign = exact_detail::orientation_filter(unit[a], unit[b], unit[c]);
    return sign != 0 ? sign : exact_detail::orientation(given(a), given(b), given(c));
  }

  int in_circle(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
    const int sign = exact_detail::in_circle_filter(unit[a], unit[b], unit[c], unit[d]);
    return sign != 0 ? sign
                     : exact_detail::in_circle_resolved({}, given(a), given(b), given(c), given(d));
  }

  /// Half the sum of the cotangents of the angles at c and d, but for the sphere's curvature.
  double relative_length(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
    const auto cotangent = [&](const Vec3& p) {
      const Vec3 u = unit[a] - p, v = unit[b] - p;
      return dot(u, v) / base_detail::norm(cross(u, v));
    };
    return (cotangent(unit[c]) + cotangent(unit[d])) / 2;
  }

  const void* stored(std::int32_t site) const { return &unit[site]; }

  static constexpr int cube_faces = 6;
  curve_detail::CubePoint square(std::int32_t site) const {
    return curve_detail::to_cube(unit[site]);
  }

  static std::string own_failure(std::int64_t) { return {}; }
  static std::int64_t euler(std::int64_t boundary_edges) { return boundary_edges == 0 ? 2 : 1; }

  Area area(std::int64_t t) const {
    return area_of(unit[vertex(t, 0)], unit[vertex(t, 1)], unit[vertex(t, 2)]);
  }

  static void set_area(double sum, CheckReport& result) {
    result.area = sum;
    result.expected_area = result.boundary_edges == 0 ? 4 * std::numbers::pi : 0;
  }

  static std::string area_failure(const Area& area, const CheckReport& result) {
    if (result.boundary_edges > 0 || std::abs(result.expected_area - area.value) <= 2 * area.error)
      return {};
    return message("the areas sum to {} instead of 4 pi", area.value);
  }
};

CheckReport prove(const Mesh& mesh, mesh_detail::Proof proof, const ProgressCallback& progress) {
  if (!mesh.surface.is_sphere())
    return mesh_detail::check_in_plane(mesh, proof, progress);
  return mesh_detail::check_laws(
      mesh, [&](std::int64_t site) { return direction_failure(mesh, site); },
      [&] { return OnSphere(mesh); }, proof, progress);
}

} // namespace

EdgeCounts count_edges(const Mesh& mesh) {
  return mesh.surface.is_sphere() ? mesh_detail::count_edges_of(OnSphere(mesh))
                                  : mesh_detail::count_edges_in_plane(mesh);
}

// Why local laws are enough. The triangles are counter-clockwise and turn around each inner site
// once, so the mesh covers the sphere without folds or branch points. Closed, it is a covering of
// the sphere, which is simply connected: each of its parts is one sheet, and Euler's characteristic
// 2 allows one part. Open, it bends at its boundary to the left alone: by Gauss and Bonnet each
// part has the characteristic 1, so there is one; and two points in it over one direction would be
// joined by a shortest path, which is not longer than pi and runs along a great circle: they are
// one point. Such a mesh with Delaunay edges is Delaunay.
CheckReport check(const Mesh& mesh, const ProgressCallback& progress) {
  return prove(mesh, mesh_detail::Proof::delaunay, progress);
}

CheckReport check_surface(const Mesh& mesh, const ProgressCallback& progress) {
  return prove(mesh, mesh_detail::Proof::surface, progress);
}

} // namespace calotte
