// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/cvt.h"
#include "cvt/worlds.h"
#include "domain/region.h"
#include "domain/spherical_outline.h"

#include <cstdint>
#include <memory>

namespace calotte::cvt_detail {

/// The functions of SphericalWorld for a region of the sphere. Its meshes have the triangles
/// between generators, also those that the region does not contain.
class RegionWorld {
public:
  using Result = Cvt;
  static constexpr std::int64_t fewest = 4;
  static constexpr bool at_sites = true;

  /// \pre not the whole sphere. \throws Error as Surface::within().
  explicit RegionWorld(const Region& region)
      : outline_(std::make_shared<const SphericalOutline>(region)) {}

  /// \throws Error as SphericalWorld; invalid_argument with the index of the first point outside.
  Begun begin(const Points3Ref& start, const CvtOptions& options) const;
  static Density density(const Density& density) { return SphericalWorld::density(density); }
  void require_points(const State& state) const;
  std::unique_ptr<Functional> functional(const Points3& points, const CvtOptions& options,
                                         Level&&) const {
    return make_functional(points, outline_, options);
  }
  static std::int64_t bisected(std::int64_t n) { return 4 * n; } // some midpoints may be outside
  static std::int64_t halved(std::int64_t n) { return (n + 2) / 4; }
  Mesh triangulated(Points3&& points) const;
  Mesh mesh(Points3&& points, Connectivity&&) const { return triangulated(std::move(points)); }
  Level set_bisected(State& state, const Mesh& coarse) const;
  Level set_split_and_collapsed(State& state, const Mesh& mesh, const Density& density,
                                const EdgeChanges& changes) const;

  /// The part of a mesh that the region contains, see Boundary: without triangles that touch the
  /// others at a site in a vertex only.
  Mesh inner(Mesh&& mesh, Boundary boundary) const;

private:
  std::shared_ptr<const SphericalOutline> outline_;
};

} // namespace calotte::cvt_detail
