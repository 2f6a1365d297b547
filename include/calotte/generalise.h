// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/ocean.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

/// Coasts for grids that end at them: the sea without what is finer than a cell.
CALOTTE_API_BEGIN
namespace calotte {

/// What the sea of a grid keeps.
struct GeneraliseOptions {
  /// Islands and lakes of fewer cells, by the width at their first corner, do not count; from 0.25
  /// on. Default 1.
  double least_island = 1;
  /// Lines along which the sea is a cell wide at least, also over land, such as straits, and from
  /// their ends on to where the sea is as wide. Each 3 x points, directions, joined by arcs shorter
  /// than a half circle. Default: none.
  std::vector<Points3> passages = {};
  /// The part of the sphere to which the sea belongs; its boundary counts as a coast, and is an
  /// open one for a model. Default: the whole sphere.
  Surface within = {};
  /// The sea is what is connected with one of these directions. Default: none, the largest part.
  Points3 seeds = {};
};

/// A part of the sea that became land.
struct ClosedSea {
  Eigen::Vector3d position; ///< the point of it that is farthest from the coast, a unit vector
  double area;              ///< steradians, of squares with sides of a sixth of a cell
};

/// The sea at the widths of a grid.
struct GeneralisedSea {
  Surface sea;                       ///< to the left of its rings, which do not meet
  std::int64_t islands = 0;          ///< left out, of all closed lines of the coast
  std::int64_t lakes = 0;            ///< left out in the same way
  std::vector<ClosedSea> parts = {}; ///< as wide as a cell, without a seed; largest first
  /// Between the sea and another part of it, or one that is left out, narrower than a cell; largest
  /// first. Those narrower than a third of a cell may be missing.
  std::vector<ClosedSea> straits = {};
  /// Those that reach no sea, and have no effect; without those outside GeneraliseOptions::within.
  std::vector<std::int64_t> stranded_passages = {};
  double land_to_sea = 0; ///< steradians, by squares and lost islands
  double sea_to_land = 0; ///< steradians, by squares
  /// The largest distance of the rings from the coast in local widths, away from passages, at ends
  /// and thirds of their arcs.
  double displacement = 0;
  double usual_displacement = 0; ///< the distance that 95% of these points keep within
};

/// The sea of a coast at the widths of a grid. With the local width w, the sea keeps the points
/// that are nearer than w/2 to one whose distance from the coast is w/2 or more: bays and straits
/// that are narrower than a cell become land. (This is the opening of mathematical morphology;
/// Serra, Image Analysis and Mathematical Morphology, 1982.) Of the land, capes go in the same way.
/// Islands stay, and so does land between two parts of the sea, however narrow it is. The rings
/// have corners about a width apart, on the coast where it is within w/2.
///
/// The boundary is the level set of a function that is linear on the Delaunay triangles of points a
/// sixth of a width apart, so that its rings are simple and nested. Arcs between the corners that
/// meet others, in exact arithmetic, are refined back to it. The result has the same bits for any
/// number of threads.
///
/// \param coast land to the left of its rings, which may be simplified, see Coast.
/// \param widths of the sphere, a demand everywhere.
/// \throws Error invalid_argument: an option out of range, such as a part of a plane; a coast
/// without shores, or whose land is
///         all smaller than the least island; naming ring and corner as shores(); widths of a
///         plane, naming a point without a demand; widths that require more than 20 million points;
///         naming the seed, one on land or in a part that becomes land; widths wider than the sea.
GeneralisedSea generalised_sea(const Coast& coast, const Widths& widths,
                               const GeneraliseOptions& options = {});

} // namespace calotte
CALOTTE_API_END
