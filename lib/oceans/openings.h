// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/line_distance.h"
#include "oceans/coast_sides.h"
#include "oceans/room.h"
#include "oceans/shore_points.h"

#include <calotte/mesh.h>
#include <calotte/widths.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

/// The openings of the sea and of the land of mathematical morphology (Serra, Image Analysis and
/// Mathematical Morphology, 1982) by level sets: what is left of a set that discs of half a width
/// within it cover. Functions have a value for each site of a mesh.
namespace calotte::oceans_detail {

/// The sea ends this part of a width before the coast, before its corners are moved to it: land of
/// any thinness is then wider than two points are apart.
inline constexpr double margin = 1.0 / 6;

/// The part of a width beyond which a point is too far from a core to belong to its opening.
inline constexpr double beyond = 0.6;

/// A coast and the mesh of the points around it.
struct ShoreMesh {
  Seas seas;
  LineDistance coast;                   ///< and the boundary of the seas' part of the sphere
  std::optional<LineDistance> passages; ///< if there are any
  ShorePoints at;                       ///< the sites
  Mesh mesh;
  IdLists neighbours;

  /// \param lines passages. \param within see GeneraliseOptions.
  /// \throws Error as shore_points().
  ShoreMesh(const Coast& from, const Widths& widths, const std::vector<Points3>& lines,
            const Surface& within);

  std::int64_t size() const { return at.size(); }
  double from_coast(std::int64_t site) const {
    return at.from_coast[static_cast<std::size_t>(site)];
  }
  double width(std::int64_t site) const { return at.widths[static_cast<std::size_t>(site)]; }
  double area(std::int64_t site) const { return at.areas[static_cast<std::size_t>(site)]; }
  /// Positive in the core of the sea.
  double core(std::int64_t site) const { return from_coast(site) - 0.5 * width(site); }
  /// Whether a site belongs to the sea's core, or to that of a passage.
  bool is_open(std::int64_t site) const {
    return core(site) >= 0 || at.from_passage[static_cast<std::size_t>(site)] <= 0.5 * width(site);
  }
};

/// Sites, by number.
using SiteTest = std::function<bool(std::int64_t)>;

/// Distances of all sites from the core of the sea, up to one and a half widths, positive inside
/// it.
/// \param is_core(site) of the sites where core() is not negative.
/// \throws Error invalid_argument for a sea without a core.
std::vector<double> from_core(const ShoreMesh& shore, const SiteTest& is_core);

/// The opening of the sea, less a margin, together with passages: values that are positive in it.
/// \param inside distances from the sea's core. \param from_passage from connected passages.
std::vector<double> sea_values(const ShoreMesh& shore, const std::vector<double>& inside,
                               const std::vector<double>& from_passage);

/// Leaves capes out of the land: what is farther from its core than the core is from the sea, and
/// touches the rest on one side. Isthmuses touch it on two, and islands on none.
void remove_capes(const ShoreMesh& shore, std::vector<double>& values);

/// Leaves out of the sea what is not connected with sites, and of the land what has fewer cells.
void remove_pieces(const ShoreMesh& shore, const SiteTest& is_kept, double least_cells,
                   std::vector<double>& values);

} // namespace calotte::oceans_detail
