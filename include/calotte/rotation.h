// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/matrices.h>
#include <calotte/mesh.h>

#include <Eigen/Core>

/// Rotations of the sphere.
CALOTTE_API_BEGIN
namespace calotte {

/// A rotation of the sphere about its centre. It is a matrix of about 106 bits that is orthogonal
/// within 1e-30. A rotated point is the exact one, rounded: there and back a unit vector returns
/// within 3e-16 in each coordinate, and norms stay up to rounding.
///
///     const Rotation rotation({0, 90}, {-105, 40});   // the north pole moves to Boulder
///     const Mesh there = rotated(mesh, rotation), back = rotated(there, rotation.inverse());
class Rotation {
public:
  Rotation() = default; ///< the identity, which keeps all bits

  /// The rotation that moves one point to another. What is north of `from` is then, seen from `to`,
  /// in the direction of the bearing. North at a pole is the direction along the meridian of the
  /// given longitude, northward where that reaches the pole: at the north pole towards the opposite
  /// longitude, at the south pole towards the given one. Equal points and a bearing of 0 give the
  /// identity. Multiples of 90 degrees are exact. Two points may be opposite to each other.
  /// \param from, to longitude (any) and latitude (-90 to 90), degrees.
  /// \param bearing clockwise from north, seen from outside, degrees. Default: 0.
  /// \throws Error invalid_argument for a latitude out of range, and numbers that are not finite.
  Rotation(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double bearing = 0);

  /// The rotated point, of any norm.
  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const;
  /// 3 x n, each column rotated.
  Points3 operator()(const Points3& points) const;

  /// The rotation back.
  Rotation inverse() const;
  /// Whether all points keep their bits.
  bool is_identity() const;
  /// The matrix, rounded to doubles.
  const Eigen::Matrix3d& matrix() const { return high_; }

private:
  Eigen::Matrix3d high_ = Eigen::Matrix3d::Identity(), low_ = Eigen::Matrix3d::Zero();
};

/// The same mesh at another place: its points, and the rings of its surface, are rotated. Ids,
/// triangles and neighbours stay as they are. Rounding may decide another diagonal between
/// cocircular sites, see EdgeCounts::cocircular; the mesh then has the same Voronoi cells.
/// \throws Error invalid_argument for a mesh of a plane; as Surface::within(), for rings with edges
///         as short as rounding.
Mesh rotated(Mesh mesh, const Rotation& rotation);

} // namespace calotte
CALOTTE_API_END
