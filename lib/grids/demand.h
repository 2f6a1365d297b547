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
  /// \param own widths of the mesh; the demand of a region is a fraction of these.
  Demand(const WidthDemand& demand, Way way, const Mesh& mesh, const DoubleVector& own);
  Demand(const Demand&) = delete; // one part refers to another
  Demand& operator=(const Demand&) = delete;

  /// The demanded widths at positions: infinite where nothing finer is demanded, 0 where nothing
  /// coarser is.
  DoubleVector at(const Points3& points) const;

  /// By site of a mesh, the finest demand on its cell: that at the site, or at a position in the
  /// triangles around it, increased by the gradient times the distance. The positions are a lattice
  /// in each triangle, as dense as the least demand, up to sixteen times as dense as the sites and
  /// some millions in all. For a region they lie along its boundary.
  /// \param own widths of that mesh.
  /// \param may_change by site; infinite for others.
  DoubleVector on_cells(const Mesh& mesh, const DoubleVector& own, const Marks& may_change,
                        double gradient) const;

  /// The widths anywhere, for finer cells; null where they are known at sites only.
  const FineWidths* fine() const { return fine_ ? &*fine_ : nullptr; }

private:
  DoubleVector of_region(const Points3& points) const;
  DoubleVector within_region(const Points3& points) const; ///< at positions inside the region

  const WidthDemand& demand_;
  const DoubleVector& own_;
  std::optional<Locator> sites_; ///< of the original mesh, for a region
  std::optional<Widths> widths_; ///< on the sphere that they refer to
  double unit_;                  ///< the unit of a width, in that of the mesh
  double factor_;
  double nothing_; ///< the value for no demand
  std::optional<FineWidths> fine_;
};

} // namespace calotte::grids_detail
