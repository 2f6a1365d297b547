// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/cells.h"
#include "cvt/positioned_mesh.h"
#include "cvt/repair.h"
#include "cvt/room.h"
#include "delaunay/regions.h"
#include "delaunay/sites.h"
#include "integrals/moments.h"
#include "integrals/patches.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace calotte::cvt_detail {

/// The data of a level's points at its start: from the sort of the start, or from the previous
/// level.
struct Level {
  std::optional<Sites> sites; ///< whose ids and ranks are the points' columns; with a mesh, their
                              ///< points may be gone
  /// The connectivity of the points, Delaunay except for a few edges.
  std::optional<Connectivity> mesh;
};

/// The cost of evaluations; seconds as in CvtIteration.
struct Effort {
  std::int64_t flips = 0;
  bool rebuilt = false;
  double seconds_exchange = 0, seconds_repair = 0, seconds_moments = 0;
};

/// The findings and costs of a region's task. Positions and moments exist only during the task:
/// those of the active threads fit in cache; those of all regions would take a third of the memory.
struct RegionWork {
  std::vector<std::int32_t> suspects;
  Faults faults;
  Effort effort;
  CvtRegion report;
};

/// The division of a mesh into regions, each with a task.
struct Division {
  Ownership ownership;
  std::vector<Patch> patches;
  std::vector<RegionWork> work;
};

/// The Voronoi cells of points that move, divided into regions, each with a task of its own. The
/// mesh is kept between evaluations and repaired where it is no longer Delaunay. The regions are
/// chosen again when points have drifted.
///
/// An evaluation at new points is
///
///     move -> [ drifted? divide ] -> [ restless? find_faults ]
///          -> [ faults? repair, or else rebuild ] -> integrate, until it finds no faults
///
/// divide() and rebuild() sort or triangulate the points, which takes more memory than all else.
template <Space S> class Tessellation {
public:
  /// \param points 3 x n.
  /// \throws Error as Cells::triangulate().
  Tessellation(Cells<S> cells, const Points3& points, const Decomposition& decomposition,
               Level&& level);

  /// Moves the points.
  void move(const Points3& points) { cells_.move(points); }

  /// True if points have moved so far since the regions were chosen that new regions are better.
  bool drifted() const;

  /// Chooses new regions.
  void divide();

  /// The faults of the mesh at the points.
  Faults find_faults(Effort& effort);

  /// Receives the result of a region's task: moments by local number, complete for the patch's own
  /// sites.
  using Receiver = std::function<void(const Patch& patch, const Array<Vec3>& x,
                                      const Array<CellMoments>& moments)>;

  /// Integrates over the cells and calls the receiver in each region's task. Where the mesh has
  /// faults, it is repaired by flips, or else the points are triangulated anew, and the integration
  /// starts again: the receiver must write slots that a later call overwrites.
  /// \param set_room called with true before each try, to make room for what the receiver writes,
  ///        and with false before the points are triangulated, to free it.
  void integrate_repaired(const Integrand& integrand, const std::function<void(bool)>& set_room,
                          const Receiver& receive, Effort& effort);

  /// Makes the mesh Delaunay, by flips or a new triangulation.
  void make_delaunay(Effort& effort);

  /// The mesh with the positions of its sites.
  PositionedMesh<S> positioned() const {
    return {cells_, mesh_, cells_.positions().points, along_};
  }

  /// Sets where the mesh ends, see PositionedMesh::along. \param along by generator, or empty.
  void end_along(std::vector<std::int32_t> along) {
    along_ = std::move(along);
    if (!along_.empty())
      along_.resize(static_cast<std::size_t>(cells_.site_count()), -1);
  }
  std::span<const std::int32_t> along() const { return along_; }

  /// Moves out the mesh, made Delaunay at the points; empty if flips do not suffice.
  std::optional<Connectivity> take_mesh(const Points3& points);

  const Cells<S>& cells() const { return cells_; }
  const Connectivity& mesh() const { return mesh_; }

  /// Changes triangles of the mesh, and leaves it Delaunay. Returns the numbers of the changed
  /// triangles, which may repeat; nothing if the mesh has become unusable.
  using Change = std::function<std::optional<std::vector<std::int32_t>>(Connectivity&)>;

  /// Lets `change` move the points and change the mesh with them.
  void change_mesh(const Points3& points, const Change& change);

  /// The regions, with their seconds since they were chosen.
  std::vector<CvtRegion> regions() const;

private:
  /// The owner of each site of the mesh.
  struct Owners {
    Array<std::int32_t> owner;
    std::int32_t regions;
  };

  bool repair_faults(const Faults& faults, Effort& effort);
  void rebuild(Effort& effort);
  Faults integrate(const Integrand& integrand, const Receiver& receive, Effort& effort);
  Owners owners_by_site(const Sites& sites, const Regions& regions) const;
  void set_division(Owners&& owners);
  void adopt(Owners&& owners);
  void note_sample();
  Array<Vec3> exchange(const Patch& patch) const;
  void find_faults(const Patch& patch, RegionWork& work) const;
  template <class Task> Faults run_tasks(const Task& task, Effort& effort);

  Cells<S> cells_;
  std::vector<std::int32_t> along_;
  std::int64_t generators_;
  Decomposition decomposition_;
  Connectivity mesh_;
  Division division_;
  Array<Vec3> sample_; ///< sampled points, as they were when the regions were chosen
  bool restless_ = true;
};

} // namespace calotte::cvt_detail
