// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/functional.h"
#include "cvt/multigrid.h"
#include "cvt/options.h"
#include "cvt/room.h"
#include "cvt/state.h"
#include "density/density_evaluator.h"

#include <calotte/cvt.h>

#include <optional>
#include <vector>

namespace calotte::cvt_detail {

/// The methods of optimisation, over a functional. Each step goes from evaluated generators to
/// others whose energy is not higher, except for rounding. The state's report records every
/// evaluation, and the state holds the memory of the method.
class Descent {
public:
  /// \param density as surface_density() gives it.
  Descent(State& state, const DescentOptions& options, const Density& density,
          Functional& functional);

  /// Evaluates the state's points. The report records it unless the state has been evaluated there
  /// before.
  void begin();

  /// Makes one step. The state's points are then the new ones, evaluated.
  void step();

  /// Evaluates the state's points after the caller has changed them.
  void restart();

  /// The evaluation at the state's points.
  const Evaluation& here() const { return here_; }

  /// Moves the state's points to the centroids of their cells; no step may follow.
  /// \pre no penalty.
  void end_at_centroids();

private:
  /// Properties of the direction that a line search needs.
  struct Line {
    double slope;
    double longest; ///< the step that moves a generator by half of its cell's width
  };

  Method method() const;
  bool uses_gradients() const;
  void evaluate(const Points3& points, Evaluation& out);
  void accept();
  void lloyd_step();
  void quasi_newton_step();
  Line set_direction();
  void precondition(Points3& vectors);
  void divide_by_masses(Points3& vectors) const;
  void make_laplacian();
  void remember();
  void forget();
  double greatest_motion(base_detail::Part part) const;
  bool search(const Line& line);

  State& state_;
  const DescentOptions& options_;
  Functional& functional_;
  DensityEvaluator density_;
  bool uniform_;                              ///< the density
  Evaluation here_, there_;                   ///< at the state's points, and at a trial's
  Points3 trial_, direction_;                 ///< kept for their memory
  std::vector<std::vector<double>> products_; ///< of each change with the steps before it
  std::optional<Multigrid> laplacian_;
};

} // namespace calotte::cvt_detail
