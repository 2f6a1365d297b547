// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/repair.h"
#include "cvt/room.h"
#include "delaunay/sites.h"
#include "integrals/moments.h"
#include "integrals/patches.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace calotte::cvt_detail {

/// The Voronoi cells of points that move, divided into regions, each with a task of its own. The
/// mesh is kept between evaluations and mended where points have moved out of it; the regions are
/// chosen anew when points have drifted.
///
/// \tparam Cells SphericalCells, or PlanarCells: what the cells are in their space.
template <class Cells> class Tessellation {
public:
  /// \param points 3 x n.
  /// \throws Error as Cells::Signs::triangulate().
  Tessellation(Cells cells, const Points3& points, const DelaunayOptions& partition);

  /// What a region's task hands over: moments by local number, whole for the patch's own sites.
  using Receiver = std::function<void(const Patch& patch, const Array<Vec3>& x,
                                      const Array<CellMoments>& moments)>;

  /// Where the receiver writes: `take` is called before the regions' tasks; `give_up` before points
  /// are sorted or triangulated anew, which takes more memory than all else, and what has been
  /// received is worthless then.
  struct Room {
    std::function<void()> take, give_up;
  };

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
  /// \throws Error as Cells::Signs::triangulate().
  Effort evaluate(const Points3& points, const Integrand& integrand, const Receiver& receive,
                  const Room& room);

  const Cells& cells() const { return cells_; }

  /// Tells how far any point may have moved since the last evaluation.
  void moved(double farthest) { drift_ += farthest; }

  /// The regions, with their seconds since they were chosen.
  std::vector<CvtRegion> regions() const;

private:
  /// What a region's task found and took. Positions and moments live no longer than the task: the
  /// threads' few stay in cache, where those of all regions would be a third of the memory.
  struct Work {
    std::vector<std::int32_t> suspects;
    Faults faults;
    Effort effort;
    CvtRegion report;
  };

  /// Who owns each place of the mesh, and what each region would exchange.
  struct Division {
    Array<std::int32_t> owner;
    std::vector<CvtRegion> reports;
  };

  std::optional<Division> divided() const;
  void divide();
  Array<Vec3> exchange(const Patch& patch) const;
  void find_faults(const Patch& patch, Work& work) const;
  template <class Task> Faults run_tasks(const Task& task, Effort& effort);
  void mend(const Faults& faults, const Room& room, Effort& effort);

  Cells cells_;
  std::int64_t generators_;
  DelaunayOptions partition_;
  Connectivity mesh_;
  Ownership ownership_;
  std::vector<Patch> patches_;
  std::vector<Work> work_;
  double drift_ = 0;     ///< bound of how far points have moved since the regions were chosen
  bool restless_ = true; ///< the mesh did not hold last time: look before integrating
};

} // namespace calotte::cvt_detail
