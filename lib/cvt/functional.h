// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "cvt/laplacian.h"
#include "cvt/room.h"
#include "cvt/tessellation.h"

#include <calotte/cvt.h>
#include <calotte/domain.h>

#include <memory>
#include <optional>
#include <vector>

namespace calotte::cvt_detail {

/// What one generator adds to an evaluation's sums.
struct SiteTerms {
  double energy;
  double square; ///< of its distance from its centroid
  double slope;  ///< of its gradient, squared
};

/// The CVT energy E of n generators x, and what descends from there.
struct Evaluation {
  CvtIteration iteration; ///< energy, norms, effort
  Points3 centroids;      ///< Lloyd's map, 3 x n
  Points3 gradient;       ///< dE/dx, tangential; where it was asked for
  Array<double> mass;     ///< the cells' masses but for h^2; where the gradient was asked for
  Array<SiteTerms> terms;
};

/// The energy as a function of the generators, over cells that are kept from call to call; and the
/// motions that generators can make.
class Functional {
public:
  virtual ~Functional() = default;

  /// \param points 3 x n. \param final_rule by the finer of the two rules.
  /// \throws Error bad_option for a density that is zero or infinite over a cell; too_few_sites.
  virtual void evaluate(const Points3& points, bool final_rule, bool with_gradient,
                        Evaluation& out) = 0;

  virtual std::vector<CvtRegion> regions() const = 0;

  /// The connectivity of the generators' Delaunay triangulation where they are now, gone from here:
  /// no evaluation may follow. Empty where there is none but by a new triangulation, as in a
  /// bounded plane, whose mesh here has a hull of its own.
  virtual std::optional<Connectivity> take_mesh(const Points3& points) = 0;

  /// x + step d, brought back to where generators can be.
  virtual Points3 retract(const Points3& x, double step, const Points3& d) const = 0;
  /// Takes from each vector what is no motion at x.
  virtual void make_tangential(Points3& vectors, const Points3& x) const = 0;
  /// See laplacian.h.
  virtual SparseMatrix laplacian(const Points3& points) = 0;
};

/// On the sphere: of unit columns, with Lloyd's map M/|M| and dE/dx = -2 (M - (M.x) x).
/// \throws Error as Tessellation's.
std::unique_ptr<Functional> make_functional(const Points3& points, const CvtOptions& options,
                                            Level&& level = {});

/// In a planar domain: of columns with z = 0, which may leave a periodic box.
/// \pre the options' density is that of planar_density().
std::unique_ptr<Functional> make_functional(const Points3& points, const PlanarDomain& domain,
                                            const CvtOptions& options, Level&& level = {});

} // namespace calotte::cvt_detail
