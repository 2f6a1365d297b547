// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "memory.h"
#include "tessellation.h"

#include <calotte/cvt.h>

namespace calotte::detail {

/// What one generator adds to an evaluation's sums.
struct SiteTerms {
  double energy;
  double square; ///< of its distance from its centroid
  double slope;  ///< of its gradient, squared
};

/// The CVT energy E of n generators x, and what descends from there.
struct Evaluation {
  CvtIteration iteration; ///< energy, norms, effort
  Points3 centroids;      ///< Lloyd's map M/|M|, 3 x n
  Points3 gradient;       ///< dE/dx = -2 (M - (M.x) x), tangential; where it was asked for
  Array<double> mass;     ///< |M|, the cells' masses but for h^2; where the gradient was asked for
  Array<SiteTerms> terms;
};

/// The energy as a function of the generators, over cells that are kept from call to call.
class Functional {
public:
  /// \throws Error as Tessellation's.
  Functional(const Points3& points, const CvtOptions& options);

  /// \param points unit columns. \param final_rule by the finer of the two rules.
  /// \throws Error bad_option for a density that is zero or infinite over a cell; too_few_sites.
  void evaluate(const Points3& points, bool final_rule, bool with_gradient, Evaluation& out);

  /// Tells how far any point may have moved since the last evaluation.
  void moved(double farthest) { tessellation_.moved(farthest); }

  std::vector<CvtRegion> regions() const { return tessellation_.regions(); }

private:
  Tessellation tessellation_;
  Integrand coarse_, fine_;
  int rule_, final_rule_; ///< their numbers of points, 0 where none is used
};

} // namespace calotte::detail
