// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/cells.h"
#include "cvt/options.h"
#include "cvt/positioned_mesh.h"
#include "cvt/room.h"
#include "mesh/connectivity.h"

#include <calotte/cvt.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

namespace calotte::cvt_detail {

/// From this value on CvtStop::most_off_midpoint limits nothing.
inline constexpr double any_off_midpoint = CvtStop().most_off_midpoint;

/// The limits of shape that a polish keeps. All shapes within them suit models: a triangle must not
/// be obtuse, and a short Voronoi edge reduces the stable time step for diffusion of vorticity. A
/// CVT without polish has few shapes beyond them, all near pairs of cells with 5 and 7 neighbours.
struct ShapeLimits {
  /// Cotangents of the triangles' flat angles: 87 to 38 degrees.
  double least_cotangent = 0.05, most_cotangent = 1.3;
  /// Voronoi edge over Delaunay edge, which is the mean of the two cotangents across.
  double least_edge = 0.21, most_edge = 1.1;
  /// Delaunay edge over the spacing that the density demands there; see CvtStop::least_spacing.
  /// With the accepted excess they are 0.80 to 1.26, which grids of E3SM have to be within. 0.8 to
  /// 1.3: no other time and errors of a model's operators, but lengths of 0.79 to 1.31.
  double least_spacing = CvtStop().least_spacing, most_spacing = 1.23;
  /// The distance between the midpoints of a Delaunay edge and of its Voronoi edge, over the
  /// Delaunay edge; see CvtStop::most_off_midpoint. A penalty has terms for what is beyond, but
  /// this is no shape that models refuse: it counts in no excess.
  double most_off_midpoint = CvtStop().most_off_midpoint;
};
inline constexpr ShapeLimits shape_limits;

/// ShapeLimits::most_spacing of runs with fixed generators, which leave others less choice: the
/// first row from those on a boundary may be 1.32 times the demanded spacing away.
inline constexpr double most_spacing_beside_fixed = 1.3;

/// The same limits along a boundary, where generators start from 5/8 to 5/4 of that apart.
inline constexpr double least_along_boundary = 0.6, most_along_boundary = 1.3;

/// Whether values are valid as a run's CvtStop::least_spacing and CvtStop::most_off_midpoint.
inline bool is_least_spacing(double spacing) { return spacing >= 0 && spacing <= 0.95; }
inline bool is_most_off_midpoint(double offset) { return offset > 0 && offset <= any_off_midpoint; }

// How far beyond its limit the worst cotangent or ratio may be:
inline constexpr double polished_excess = 0.02;  ///< where a polish ends
inline constexpr double accepted_excess = 0.03;  ///< in a well-centred mesh
inline constexpr double reachable_excess = 0.11; ///< where a raised penalty still helps

/// The limits of an early glide, slightly narrower than shape_limits, so that few shapes come near
/// those.
constexpr ShapeLimits early_glide_limits() {
  constexpr double edge_margin = 0.03, cotangent_margin = 0.08;
  ShapeLimits limits = shape_limits;
  limits.least_edge += edge_margin;
  limits.least_cotangent += cotangent_margin;
  return limits;
}

/// How firmly a generator is pinned; 0 for one that moves. Those on the boundary slide along it in
/// subdomains. A polish releases some of those on lines, and later of those at their ends and
/// confluences.
inline constexpr std::uint8_t sliding = 1, pinned_on_line = 2, pinned_at_end = 3, pinned = 4;

/// The factors of squared excesses in a penalty.
struct ShapeFactors {
  double shapes = 0;       ///< of angles, ratios and lengths; 0 for no penalty
  double off_midpoint = 0; ///< beyond ShapeLimits::most_off_midpoint
};

/// A penalty: factors times the squared excesses beyond limits.
struct ShapePenalty {
  ShapeFactors factors;
  double spacing = 1; ///< that the density demands, times rho^(1/4)
  ShapeLimits limits;
};

/// The penalty for shapes beyond the limits.
struct ShapeTerms {
  double value = 0;                  ///< of the penalty
  double off_midpoint = 0;           ///< the part of it for midpoints
  double worst = 0;                  ///< the largest such excess
  std::int32_t worst_generator = -1; ///< one of the worst shape
  std::int64_t generators = 0;       ///< of all shapes with more than the accepted excess
};

/// The mesh whose shapes are measured, with the demanded spacing.
template <Space S> struct ShapeInput {
  PositionedMesh<S> mesh;
  const DoubleVector& inverse_spacing; ///< 1/h by generator, h the spacing that the density demands
  const ShapeLimits& limits;
  const std::vector<std::uint8_t>& fixed; ///< by generator, whether it is pinned; empty if none is
};

/// Computes the penalty, and adds its derivatives to the gradient. The result has the same bits for
/// any number of threads and any order of the triangles. In the plane, triangles with their
/// circumcentre outside the domain do not count, see Cells::has_centre(), nor do their edges'
/// ratios; shapes of fixed generators alone do not count either.
///
/// \param triangles all that may be beyond a limit; each once.
template <Space S>
ShapeTerms add_shape_terms(const ShapeInput<S>& input, std::vector<std::int32_t> triangles,
                           const ShapeFactors& factors, Points3& gradient);

/// The largest excess of a triangle beyond the limits, and of its edges.
template <Space S> double shape_excess(const ShapeInput<S>& input, std::int32_t triangle);

/// The triangles that may be beyond a limit, each once, in any order.
template <Space S> std::vector<std::int32_t> distorted(const ShapeInput<S>& input);

} // namespace calotte::cvt_detail
