// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grids/patch.h"
#include "grids/patch_run.h"
#include "grids/room.h"

#include <calotte/locate.h>
#include <calotte/mesh.h>
#include <calotte/refine.h>

#include <optional>

namespace calotte::grids_detail {

/// A demand as widths at positions, in the unit of a mesh: radians, or that of its plane. The mesh,
/// its widths and the demand must outlive it.
class Demand {
public:
  /// \param own widths of the mesh, of which those of a region are a part.
  Demand(const WidthDemand& demand, Way way, const Mesh& mesh, const DoubleVector& own);
  Demand(const Demand&) = delete; // one part refers to another
  Demand& operator=(const Demand&) = delete;

  /// At positions. Infinite where nothing finer is demanded, 0 where nothing coarser is.
  DoubleVector at(const Points3& points) const;

  /// By site of a mesh the finest demand on its cell: at the site, or, wider by the gradient times
  /// the distance from it, at a position in the triangles around it. The positions are a lattice in
  /// each triangle, as dense as the least demand, up to sixteen times as dense as the sites and
  /// some millions in all; of a region they lie along its boundary. \param own widths of that mesh.
  /// \param may_change by site; infinite for others.
  DoubleVector on_cells(const Mesh& mesh, const DoubleVector& own, const Marks& may_change,
                        double gradient) const;

  /// Of finer cells, widths anywhere; null where they are known at sites only.
  const FineWidths* fine() const { return fine_ ? &*fine_ : nullptr; }

private:
  DoubleVector of_region(const Points3& points) const;
  DoubleVector within_region(const Points3& points) const; ///< at positions that it has

  const WidthDemand& demand_;
  const DoubleVector& own_;
  std::optional<Locator> sites_; ///< of the mesh as it was given, for a region
  std::optional<Widths> widths_; ///< on the sphere that they refer to
  double unit_;                  ///< of a width, in that of the mesh
  double factor_;
  double nothing_; ///< what stands for no demand
  std::optional<FineWidths> fine_;
};

} // namespace calotte::grids_detail
