// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/types.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace calotte {

/// How far n generators moved in an iteration, x to x', on the unit sphere. The first two are as
/// printed by Jacobsen et al., 2013, Sect. 2.2; MPI-SCVT divides outside the root.
enum class Norm {
  l2,          ///< sqrt( (1/n) sum |x - x'|^2 )
  linf,        ///< max |x - x'|
  l2_scaled,   ///< l2 over h = sqrt(4 pi / n)
  linf_scaled, ///< linf over h
};

struct CvtOptions {
  Density density = {};
  Norm norm = Norm::l2_scaled;
  double tolerance = 1e-6;   ///< stop when the norm is at most this; > 0
  int max_iterations = 1000; ///< >= 0
  int rule = 3; ///< quadrature points on each half kite: 1, 3, 6, 7, 13 or 19; not used for uniform
                ///< density
  int final_rule = 6;         ///< the same once the norm is within ten times the tolerance
  int triangle_divisions = 1; ///< each half kite is first cut into that many squared; >= 1
};

/// One iteration: what the mesh was before the move, and the move.
struct CvtIteration {
  double l2 = 0, linf = 0; ///< on the unit sphere, not scaled
  double energy = 0;       ///< sum over cells of the integral of rho |x - x_i|^2, before the move
  std::int64_t flips = 0;  ///< of edges, after the move
  bool rebuilt = false;    ///< after the move, the mesh was triangulated anew
  double seconds_moments = 0, seconds_repair = 0;
};

struct CvtReport {
  bool converged = false;
  double residual = 0; ///< the norm of the last move
  std::vector<CvtIteration> iterations;
  double seconds = 0;
};

/// A centroidal Voronoi tessellation: generators that are the centroids of their Voronoi cells.
struct Cvt {
  Mesh mesh; ///< Delaunay triangulation of the generators, unit columns, in the order of the start
  CvtReport report;
};

/// Lloyd's iteration on the unit sphere: each generator moves to its cell's constrained centroid
/// M/|M|, M the integral of rho x over the cell (Jacobsen et al., 2013, Sect. 3.3), until the norm
/// is within the tolerance.
///
/// The same start gives the same bits for any number of threads. Not converging within
/// max_iterations is reported, not an error.
///
/// \param start 3 x n directions, 12 distinct at least, not within a hemisphere; equal ones merge.
///
/// \param stop asked after each iteration with its report so far; true ends the run there.
///
/// \throws Error as delaunay(); too_few_sites for fewer than 12 generators, or when generators
/// meet; bad_option for a tolerance <= 0, an unknown rule, or a density that is ill-formed,
/// negative or NaN somewhere, or zero over a whole cell.
Cvt cvt(const Points3& start, const CvtOptions& options = {},
        const std::function<bool(const CvtReport&)>& stop = {});

} // namespace calotte
