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

/// Determines the parts of a mesh that change when cells are to have other widths.
namespace calotte::grids_detail {

/// Flags by site or by triangle.
using Marks = std::vector<std::uint8_t>;

/// Sites at the mesh's boundary, sites of thin triangles beside it, and sites whose cells the rings
/// of a plane clip.
Marks sites_at_boundary(const Mesh& mesh);

/// The width of each cell, that of a hexagon of its area, smoothed over its neighbours: radians, in
/// a plane its unit. Cells at the boundary are not measured: they get the mean of their neighbours,
/// or 0 without measured neighbours.
DoubleVector own_widths(const Mesh& mesh, const Marks& at_boundary);

/// Sets the widths that are 0, as in a strait of two rows of sites, to the mean distance of the
/// neighbours.
void complete_widths(const Mesh& mesh, const IdLists& neighbours, DoubleVector& widths);

/// A point in the form that measures require: on the sphere a unit vector, as points of files may
/// have other norms.
template <Space S> Vec3 measured_point(const S&, const Vec3& x) {
  if constexpr (S::on_sphere)
    return domain_detail::as_unit(x);
  else
    return x;
}

/// Whether cells become finer or coarser.
enum class Way { finer, coarser };

/// The widths that cells shall have.
struct WantedWidths {
  DoubleVector width; ///< by site; the mesh's own width where nothing changes
  Marks stays;        ///< as given
  /// The number of sites where the demand is not met because of sites that stay.
  std::int64_t held = 0;
};

/// Adopts a demand where it is not met, and limits the gradient of widths around: finer cells
/// spread outwards, and coarser cells begin beside those that keep their widths. The gradient of
/// widths is limited from sites that stay, too. \param neighbours of the mesh's sites. \param stays
/// the sites whose cells keep their widths. \param own from own_widths(). \param demanded by site,
/// in the same unit. \param tolerance share of a width within which it meets the demand. \param
/// gradient greatest change of the width by distance.
WantedWidths wanted_widths(const Mesh& mesh, const IdLists& neighbours, Marks stays,
                           const DoubleVector& own, const DoubleVector& demanded, Way way,
                           double tolerance, double gradient);

/// A connected part of a mesh, bounded by simple rings of edges. Along its boundary, two rows of
/// sites stay, so that the triangles there stay, too. Only at the mesh's own boundary may sites of
/// the rings move.
struct PatchRegion {
  mesh_detail::Submesh
      part; ///< triangles ascend; sites: first those that stay, then others, each ascending
  std::int32_t fixed = 0; ///< number of the sites that stay; the others move, or vanish
  /// Sites along the boundary, by their numbers in the part, with the patch to the left; none for a
  /// patch that is the whole of a closed mesh.
  std::vector<std::vector<std::int32_t>> rings = {};

  /// The sites that stay, by their ids in the mesh.
  std::span<const std::int32_t> fixed_sites() const { return std::span(part.sites).first(size()); }
  std::span<const std::int32_t> free_sites() const { return std::span(part.sites).subspan(size()); }

  /// The sites of the rings that move, by their numbers in the part.
  std::vector<std::int32_t> on_boundary() const;

private:
  std::size_t size() const { return static_cast<std::size_t>(fixed); }
};

/// The patches of a mesh whose widths change, ordered by their lowest triangle.
/// \param own, wanted as above.
/// \param rows_that_adapt of cells around those whose widths change.
/// \throws Error invalid_argument, with the index of a site where the mesh's boundary meets itself,
///         if a patch would contain triangles on both sides of it.
std::vector<PatchRegion> find_patches(const Mesh& mesh, const IdLists& neighbours,
                                      const DoubleVector& own, const WantedWidths& wanted,
                                      int rows_that_adapt);

} // namespace calotte::grids_detail
