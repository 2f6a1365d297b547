// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "moments.h"
#include "patches.h"
#include "repair.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/types.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace calotte::detail {

/// The Voronoi cells of points that move, divided into regions, each with a task of its own. The
/// mesh is kept between evaluations and mended where points have moved out of it; the regions are
/// chosen anew when points have drifted.
class Tessellation {
public:
  /// \param points 3 x n unit columns.
  /// \throws Error as triangulate_closed().
  Tessellation(const Points3& points, const DelaunayOptions& partition);

  /// What a region's task hands over: moments by local number, whole for the patch's own sites.
  using Receiver = std::function<void(const Patch& patch, const Array<Vec3>& x,
                                      const Array<CellMoments>& moments)>;

  /// What an evaluation took; seconds as CvtIteration's.
  struct Effort {
    std::int64_t flips = 0;
    bool rebuilt = false;
    double seconds_exchange = 0, seconds_repair = 0, seconds_moments = 0;
  };

  /// Mends the mesh for the points where they are now, and integrates over the cells.
  ///
  /// The receiver is called in each region's task. Where a region only then turns out to be no
  /// longer Delaunay, all are called again: what it writes must be slots that a later call
  /// overwrites.
  /// \throws Error too_few_sites as repair().
  Effort evaluate(const Points3& points, const Integrand& integrand, const Receiver& receive);

  /// Tells how far any point may have moved since the last evaluation.
  void moved(double farthest) { drift_ += farthest; }

  /// The regions, with their seconds since they were chosen.
  std::vector<CvtRegion> regions() const;

private:
  /// A region's data between evaluations.
  struct Work {
    Array<Vec3> x;
    Array<CellMoments> moments;
    std::vector<std::int32_t> suspects;
    Faults faults;
    Effort effort;
    CvtRegion report;
  };

  void divide(const Points3& points);
  void exchange(const Patch& patch, const Points3& points, Work& work) const;
  void find_faults(const Patch& patch, const Points3& points, Work& work) const;
  template <class Task> Faults run_tasks(const Task& task, Effort& effort);
  void mend(const Points3& points, const Faults& faults, Effort& effort);

  DelaunayOptions partition_;
  Connectivity mesh_;
  Ownership ownership_;
  std::vector<Patch> patches_;
  std::vector<Work> work_;
  double drift_ = 0;     ///< bound of how far points have moved since the regions were chosen
  bool restless_ = true; ///< the mesh did not hold last time: look before integrating
};

} // namespace calotte::detail
