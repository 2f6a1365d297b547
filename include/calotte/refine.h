// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/progress.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <cstdint>
#include <optional>
#include <vector>

/// Finer or coarser cells in a part of a mesh. The other parts stay unchanged.
CALOTTE_API_BEGIN
namespace calotte {

/// The demanded widths of cells. Elsewhere cells keep their widths.
struct WidthDemand {
  /// Widths in km, in a plane in its unit: refine() makes wider cells finer, and coarsen() makes
  /// narrower ones coarser. Where no rule gives a width, cells stay.
  std::optional<Widths> widths = {};
  /// Instead of widths: the part of the surface where cells become `factor` times as narrow or as
  /// wide as they are.
  std::optional<Surface> region = {};
  double factor = 1;                  ///< of a region; > 1, at most 100
  double radius_km = earth_radius_km; ///< of the sphere that widths refer to; > 0 and finite
};

/// The radius to which widths and lengths in km refer in a change of a mesh of a file, for
/// WidthDemand: that of the file's planet, unless the mesh is of the unit sphere, and the planet is
/// the Earth or another radius is given.
/// \param planet_km of the file, see MeshFile::planet_radius, if it is known.
/// \param sphere_radius of the mesh, see MeshFile::sphere_radius.
/// \param given_km that the user gives; earth_radius_km stands for none.
double radius_of_widths(std::optional<double> planet_km, double sphere_radius,
                        double given_km = earth_radius_km);

/// Options of refine() and coarsen().
struct RefineOptions {
  /// Share of a cell's width within which the demand is met: such cells stay where they are, if
  /// they are beyond the transition. 0.01 to 0.5.
  double tolerance = 0.1;
  /// Greatest change of the width by distance in the transition around finer cells, and around
  /// those that stay beside coarser ones; 0.001 to 1. Models take up to 0.12 of a cell's width from
  /// one cell to the next.
  double gradient = 0.05;
  /// How an open mesh ends. By default sites at its boundary, those whose cells the rings of a
  /// plane clip, and those next to either stay. With Boundary::generators, for a mesh that ends at
  /// its sites, such as one of a run with it, finer cells reach the boundary: generators along the
  /// outer edges, as those of boundary_points(), replace its sites, and the
  /// result has a surface without rings. Of refine() alone.
  Boundary boundary = Boundary::clip;
  Decomposition decomposition = {}; ///< affects time and memory, not the result
  ProgressCallback progress = {};   ///< stage: descend
};

/// A part of a mesh that changed.
struct ChangedPatch {
  std::int64_t removed = 0; ///< sites of the old mesh
  std::int64_t added = 0;   ///< sites of the new mesh that replace them
  CvtReport report;         ///< of the patch's run, which includes the sites around it that stayed
};

/// A mesh after a change of a part of it.
struct ChangedMesh {
  /// The sites that stayed, in their order and with their bits, then the new ones along the
  /// space-filling curve.
  Mesh mesh = {};
  Ids new_of_old = {}; ///< by site of the old mesh; -1 for none
  Ids old_of_new = {}; ///< by site of the new mesh; -1 for none
  /// By site of the new mesh, the demanded width of its cell over the width of the old mesh there;
  /// 1 for sites that stayed.
  DoubleVector width_ratio = {};
  /// The patches, step by step; patches of one step do not touch. None if the demand is met.
  std::vector<ChangedPatch> patches = {};
  /// Sites of the old mesh where the demand is not met because sites at the mesh's boundary, and
  /// those next to them, stay: these, and finer ones beside them, whose widths change at the
  /// gradient.
  std::int64_t held = 0;
  /// Sites of the new mesh that are wider than a finer demand on their cells by more than 0.3,
  /// apart from those that `held` counts. Of a coarser demand that is met nowhere, since its part
  /// is small for the gradient: the sites of the old mesh to which it applies.
  std::int64_t missed = 0;
};

/// Makes cells finer where they are wider than demanded. A demand counts anywhere in a cell, not at
/// its site alone: it is sampled at points as dense as its least width, up to sixteen times as
/// dense as the sites, and along a region's boundary. Where it lies between the sites there are up
/// to four steps, each with patches of its own. The cells around grow from there at the gradient up
/// to their own widths; with three rows of cells more, up to seven where shapes need them, these
/// form the patches that change. Each patch is a centroidal Voronoi tessellation of its own, by the
/// rules of make_grid() for fixed generators, in which two rows of sites around it stay. All other
/// sites keep their bits. The time beyond a few passes over the mesh, and voronoi() of a plane with
/// rings, is that of the patches.
///
/// The result is the Delaunay triangulation of its sites, and has the same bits for any number of
/// threads. Patches do not depend on each other: two demands whose patches do not touch, one after
/// the other, give the same sites in either order.
/// \param mesh a Delaunay triangulation, at the boundary as far as its edges there allow.
/// \throws Error invalid_argument for a demand with widths and region or neither, a value out of
///         range, a surface of another kind, Boundary::generators for a mesh that does not end at
///         generators, and a mesh that is not Delaunay where it changes; with
///         the index of a site, where the boundary of an open mesh meets itself and a patch would
///         reach both sides; for a patch that leads around a periodic plane, or across a ring;
///         as make_grid(), and in a plane with rings as voronoi().
ChangedMesh refine(const Mesh& mesh, const WidthDemand& demand, const RefineOptions& options = {});

/// The same for cells that are narrower than demanded, which become wider. Their widths grow at the
/// gradient from those of the cells around them that stay.
/// \throws Error as refine(); invalid_argument for a region that contains no site.
ChangedMesh coarsen(const Mesh& mesh, const WidthDemand& demand, const RefineOptions& options = {});

} // namespace calotte
CALOTTE_API_END
