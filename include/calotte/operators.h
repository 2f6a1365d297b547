// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/surface.h>
#include <calotte/types.h>
#include <calotte/voronoi.h>

#include <cmath>
#include <cstdint>

/// The errors that the operators of a C-grid model have on a mesh.
CALOTTE_API_BEGIN
namespace calotte {

/// Norms of an error over cells, edges or vertices; all 0 if there is nothing to measure.
struct ErrorNorms {
  double l2 = 0;  ///< root of the mean square
  double max = 0; ///< the greatest value
  /// A cell at the greatest value: the cell itself, the lower cell of an edge, the
  /// first of a vertex; -1 if there is none.
  std::int64_t cell = -1;
  Eigen::Vector3d position{0, 0, 0}; ///< of the greatest value: a unit vector; in the plane z = 0
};

/// Errors by cell, relative as in OperatorErrors. A cell has the greatest error of its edges or
/// vertices. NaN where a stencil is not complete.
struct OperatorErrorsByCell {
  DoubleVector divergence;     ///< n
  DoubleVector gradient;       ///< n; of its edges
  DoubleVector laplacian;      ///< n
  DoubleVector curl;           ///< n; of its vertices
  DoubleVector tangential;     ///< n; of its edges
  DoubleVector kinetic_energy; ///< n
};

/// What a C-grid model sees of a mesh: errors of the operators of TRiSK (Ringler, Thuburn, Klemp
/// and Skamarock, J. Comput. Phys. 229, 2010) for smooth fields, and their stability.
///
/// The scalars s are harmonics of one norm: on the sphere the five real ones of degree 2, x y, y z,
/// z x, (x^2 - y^2)/2 and (3 z^2 - 1)/(2 sqrt 3), so that a rotation of the mesh leaves the errors
/// of linear operators; in the plane the cosine and the sine of the longest wave in x and in y, in
/// the periodic box or in the box around a bounded domain. The velocities are grad s and k x grad
/// s. Discrete fields are values at the sites, and normal components at the edges' midpoints; the
/// result is compared with the exact values at the site, the edge's midpoint or the vertex.
///
/// The error at a point is the root of the sum over all fields of squared errors. l2 is its root
/// mean square, weighted by area (of an edge dc dv), and both norms are divided by the root mean
/// square of the exact values. Only points with a complete stencil count: cells that no boundary
/// clips, edges between two of them, vertices between three.
struct OperatorErrors {
  ErrorNorms divergence;     ///< of a velocity, at cells
  ErrorNorms gradient;       ///< of a scalar, at edges
  ErrorNorms laplacian;      ///< divergence of the gradient, at cells
  ErrorNorms curl;           ///< of a velocity, at vertices
  ErrorNorms tangential;     ///< velocity along an edge, by tangential_weights()
  ErrorNorms kinetic_energy; ///< at cells: the sum over edges of dc dv u^2 / 4, over the area

  /// Distance of a site from the centroid of its cell, over the mean distance to its neighbours.
  ErrorNorms off_centroid;
  /// Distance between the midpoints of a Delaunay edge and of its Voronoi edge, over dc.
  ErrorNorms off_midpoint;

  /// Largest eigenvalue of the negative Laplacian at cells (divergence of the gradient), within 1
  /// percent, over the square of the unit of length. It bounds the time step of gravity waves and
  /// of the diffusion of divergence.
  double primal_eigenvalue = 0;
  /// The same at vertices: curl of the rotated gradient. It bounds the time step of what diffuses
  /// vorticity. Short Voronoi edges raise it; infinite where one has no length.
  double dual_eigenvalue = 0;

  OperatorErrorsByCell by_cell; ///< the errors of each cell
};

/// The longest stable step of gravity waves with the classical Runge-Kutta method of order 4:
/// sqrt(8) / (speed sqrt(eigenvalue)).
/// \param speed sqrt(g H), in the unit of length a unit of time.
inline double wave_step(const OperatorErrors& errors, double speed) {
  return std::sqrt(8 / errors.primal_eigenvalue) / speed;
}

/// The longest stable step of a diffusion with Euler's forward method: 2 / (viscosity eigenvalue).
/// \param eigenvalue OperatorErrors::primal_eigenvalue for divergence, dual_eigenvalue for
///        vorticity.
/// \param viscosity in the square of the unit of length a unit of time.
inline double diffusion_step(double eigenvalue, double viscosity) {
  return 2 / (viscosity * eigenvalue);
}

/// Measures a mesh of the sphere, in radians, or of a box or a bounded part of the plane, in the
/// unit of the points. Of an open mesh of the sphere, such as a limited area, it measures the cells
/// that triangles surround. The result has the same bits for any number of threads.
/// \param mesh the Delaunay triangulation of its points: on the sphere directions of any norm, in
///        the plane as in quality().
/// \param density weights the centroids, as in quality(). Default: uniform. Without effect on an
///        open mesh of the sphere.
/// \throws Error invalid_argument as voronoi() and quality(), but open meshes of the sphere are
///         measured; for a mesh that fails check_surface() or has edges that are not Delaunay, see
///         count_edges(); for an open mesh of the sphere no site of which is surrounded by
///         triangles.
OperatorErrors operator_errors(const Mesh& mesh, const Density& density = {});

} // namespace calotte
CALOTTE_API_END
