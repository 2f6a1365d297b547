// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/arcs.h"
#include "exact/space.h"
#include "grids/room.h"
#include "mesh/submesh.h"

#include <calotte/matrices.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <span>
#include <vector>

/// Which part of a mesh changes when cells are to have other widths, and what of the mesh it needs.
namespace calotte::grids_detail {

/// By site: whether something holds.
using Marks = std::vector<std::uint8_t>;

/// Sites at the mesh's boundary, of thin triangles beside it, and those whose cells the rings of a
/// plane clip.
Marks sites_at_boundary(const Mesh& mesh);

/// The width of each cell, that of a hexagon of its area, smoothed over its neighbours: radians, in
/// a plane its unit. Cells at the boundary do not count: they have the mean of their neighbours; 0
/// where there is none.
DoubleVector own_widths(const Mesh& mesh, const Marks& at_boundary);

/// A position for measures: on the sphere a unit vector, as files may give other norms.
template <Space S> Vec3 measured_point(const S&, const Vec3& x) {
  if constexpr (S::on_sphere)
    return domain_detail::as_unit(x);
  else
    return x;
}

/// Whether cells become finer or coarser.
enum class Way { finer, coarser };

/// The widths that cells are to have.
struct WantedWidths {
  DoubleVector width; ///< by site; that of the mesh where nothing changes
  Marks stays;        ///< at the boundary, or next to a site there
  /// Sites where the demand is not met because of those that stay.
  std::int64_t held = 0;
};

/// Takes a demand over where it is not met, and limits how widths change beside it: finer cells
/// spread outwards, and coarser ones begin at those that keep their widths. Sites at the
/// boundary stay, and those next to them, so that no triangle at a boundary changes; widths change
/// from there at the gradient, too. \param neighbours of the mesh's sites. \param own as
/// own_widths(). \param demanded by site, in the same unit. \param tolerance share of a width
/// within which it meets the demand. \param gradient greatest change of the width by distance.
WantedWidths wanted_widths(const Mesh& mesh, const IdLists& neighbours, const Marks& at_boundary,
                           const DoubleVector& own, const DoubleVector& demanded, Way way,
                           double tolerance, double gradient);

/// A part of a mesh whose triangles hang together, bounded by simple rings of edges. Beside the
/// boundary there are two rows of sites that stay, so that its triangles stay, too.
struct PatchRegion {
  mesh_detail::Submesh
      part;               ///< ascending triangles; first the sites that stay, each kind ascending
  std::int32_t fixed = 0; ///< number of the sites that stay; the others move, or vanish
  /// Sites along the boundary, by their numbers in the part, with the patch to the left; none for a
  /// patch that is the whole of a closed mesh.
  std::vector<std::vector<std::int32_t>> rings = {};

  /// In the mesh.
  std::span<const std::int32_t> fixed_sites() const { return std::span(part.sites).first(size()); }
  std::span<const std::int32_t> free_sites() const { return std::span(part.sites).subspan(size()); }

private:
  std::size_t size() const { return static_cast<std::size_t>(fixed); }
};

/// The patches of a mesh whose widths change, by their lowest triangle.
/// \param own, wanted as above.
/// \param rows_that_adapt of cells around those whose widths change.
/// \throws Error invalid_argument, with the index of a site where the mesh's boundary meets itself,
///         if a patch would hold triangles on both sides of it.
std::vector<PatchRegion> find_patches(const Mesh& mesh, const IdLists& neighbours,
                                      const DoubleVector& own, const WantedWidths& wanted,
                                      int rows_that_adapt);

} // namespace calotte::grids_detail
