// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/refine.h>

#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "cvt/shape.h"
#include "domain/near_boundary.h"
#include "domain/surface.h"
#include "exact/space.h"
#include "grids/demand.h"
#include "grids/patch_run.h"
#include "mesh/adjacency.h"
#include "mesh/canonical_order.h"
#include "mesh/connectivity.h"
#include "mesh/renumber.h"
#include "mesh/rows.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/locate.h>
#include <calotte/mesh.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace grids_detail {
namespace {

using base_detail::require;
using base_detail::shortly;

void require_range(double value, double least, double most, const std::string& name,
                   const char* unit = "") {
  require(value >= least && value <= most, "the {} is {}; give {} to {}{}", name, value, least,
          most, unit);
}

void require_demand(const Mesh& mesh, const WidthDemand& demand, Way way,
                    const RefineOptions& options) {
  require(demand.widths.has_value() != demand.region.has_value(),
          demand.widths ? "the demand has widths and a region; give one of them"
                        : "the demand has neither widths nor a region; give one of them");
  require(!demand.region || demand.region->is_sphere() == mesh.surface.is_sphere(),
          "the region is not of the mesh's kind of surface; give one of the " +
              std::string(mesh.surface.is_sphere() ? "sphere" : "plane"));
  require(!demand.widths || !demand.widths->is_of_plane() || !mesh.surface.is_sphere(),
          "the widths are those of a plane, and the mesh is one of the sphere; give widths in km");
  if (demand.region) {
    require(demand.factor > 1, "the factor is {}; give more than 1", demand.factor);
    require_range(demand.factor, 1, 100, "factor");
  }
  require(demand.radius_km > 0 && std::isfinite(demand.radius_km),
          "the radius is {}; give a positive number of km", demand.radius_km);
  require_range(options.tolerance, 0.01, 0.5, "tolerance", ", a share of the width");
  const double met = way == Way::finer ? 1 / (1 - options.tolerance) : 1 + options.tolerance;
  require(!demand.region || demand.factor > met,
          "the factor {} is met by all cells within the tolerance {}; give a factor above {}, or a "
          "smaller tolerance",
          demand.factor, options.tolerance, met);
  require_range(options.gradient, 0.001, 1, "gradient", ", the change of the width by distance");
  require(mesh.triangles.cols() > 0 && mesh.neighbours.cols() == mesh.triangles.cols(),
          "the mesh lacks triangles or neighbours; give one of delaunay() or read_mesh()");
}

/// The sites of the new mesh.
struct NewSites {
  Points3 points;
  Ids new_of_old, old_of_new;
  std::vector<std::vector<std::int32_t>> added; ///< by patch: the new ids of its new sites
};

/// The sites that stay, then the new ones along the curve.
template <Space S>
NewSites new_sites(const Mesh& mesh, const S& space, const std::vector<PatchRegion>& patches,
                   const std::vector<Replacement>& replacements) {
  NewSites out;
  out.new_of_old = Ids::Zero(mesh.points.cols());
  std::int64_t added = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (const std::int32_t site : patches[p].free_sites())
      out.new_of_old[site] = -1;
    added += replacements[p].change.added;
  }
  std::int32_t kept = 0;
  for (std::int32_t& id : out.new_of_old)
    if (id == 0)
      id = kept++;

  // On the sphere new columns get the norm of the old ones.
  Points3 positions(3, added);
  std::int64_t next = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const std::int64_t fixed = patches[p].fixed;
    const double length =
        S::on_sphere && fixed > 0 ? norm(column(mesh.points, patches[p].part.sites.front())) : 1;
    const double scale = std::abs(length - 1) < 1e-9 ? 1 : length;
    for (std::int64_t k = fixed; k < replacements[p].mesh.points.cols(); ++k)
      set_column(positions, next++, scale * space.wrapped(column(replacements[p].mesh.points, k)));
  }
  const Array<std::int32_t> order = mesh_detail::curve_order(positions, mesh.surface);
  std::vector<std::int32_t> rank(static_cast<std::size_t>(added));
  out.points.resize(3, kept + added);
  out.old_of_new = Ids::Constant(kept + added, -1);
  for (std::int32_t i = 0; i < out.new_of_old.size(); ++i)
    if (const std::int32_t id = out.new_of_old[i]; id >= 0) {
      out.points.col(id) = mesh.points.col(i);
      out.old_of_new[id] = i;
    }
  for (std::int32_t r = 0; r < added; ++r) {
    rank[static_cast<std::size_t>(order[r])] = kept + r;
    out.points.col(kept + r) = positions.col(order[r]);
  }
  auto at = rank.begin();
  for (const Replacement& replacement : replacements) {
    out.added.emplace_back(at, at + replacement.change.added);
    at += replacement.change.added;
  }
  return out;
}

/// Refuses new sites outside the surface: where a patch touches itself across a narrow gap in the
/// surface, they may lie in the gap.
void require_inside(const Mesh& mesh, const std::vector<PatchRegion>& patches,
                    const NewSites& sites) {
  if (!mesh.surface.is_bounded())
    return;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (const std::int32_t site : sites.added[p])
      if (!mesh.surface.contains(sites.points.col(site)))
        throw Error(ErrorCode::invalid_argument,
                    base_detail::message("the patch around site {} would reach across the boundary "
                                         "of the surface; give a part that is farther from it",
                                         patches[p].free_sites().front()),
                    patches[p].free_sites().front());
}

/// The triangles beside the patches, and those of the replacements.
Triangles new_triangles(const Mesh& mesh, const std::vector<PatchRegion>& patches,
                        const std::vector<Replacement>& replacements, const NewSites& sites) {
  std::vector<std::uint8_t> replaced(static_cast<std::size_t>(mesh.triangles.cols()), 0);
  Eigen::Index count = mesh.triangles.cols();
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (const std::int32_t t : patches[p].part.triangles)
      replaced[static_cast<std::size_t>(t)] = 1;
    count += replacements[p].mesh.triangles.cols() - std::ssize(patches[p].part.triangles);
  }
  Triangles out(3, count);
  Eigen::Index next = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    if (replaced[static_cast<std::size_t>(t)] == 0) {
      for (int i = 0; i < 3; ++i)
        out(i, next) = sites.new_of_old[mesh.triangles(i, t)];
      ++next;
    }
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const std::int32_t fixed = patches[p].fixed;
    for (const auto& triangle : replacements[p].mesh.triangles.colwise()) {
      for (int i = 0; i < 3; ++i)
        out(i, next) =
            triangle(i) < fixed
                ? sites.new_of_old[patches[p].part.sites[static_cast<std::size_t>(triangle(i))]]
                : sites.added[p][static_cast<std::size_t>(triangle(i) - fixed)];
      ++next;
    }
  }
  return out;
}

/// Whether all edges of triangles with a site of a patch are Delaunay.
template <Space S>
bool is_delaunay(const Mesh& mesh, const S& space, const std::vector<std::uint8_t>& of_patch) {
  return base_detail::holds_for_blocks(mesh.triangles.cols(), [&](std::int64_t begin,
                                                                  std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t) {
      const auto id = [&](int i) { return mesh.triangles(i, t); };
      if ((of_patch[static_cast<std::size_t>(id(0))] | of_patch[static_cast<std::size_t>(id(1))] |
           of_patch[static_cast<std::size_t>(id(2))]) == 0)
        continue;
      const auto a = space.position(column(mesh.points, id(0)));
      const auto b = space.near(column(mesh.points, id(1)), a),
                 c = space.near(column(mesh.points, id(2)), a);
      for (int i = 0; i < 3; ++i) {
        const std::int32_t beyond = mesh.neighbours(i, t);
        if (beyond < 0)
          continue;
        const int across = mesh_detail::vertex_across(mesh.neighbours, beyond, t);
        const auto d =
            space.near(column(mesh.points, mesh.triangles(across, beyond)), i == 0 ? b : a);
        if (space.in_circle_resolved(a, b, c, d) > 0)
          return false;
      }
    }
    return true;
  });
}

/// Triangulates all sites again, where a patch does not fit: around irregular cells, circumcircles
/// may extend beyond the rows that stay, so that these rows get other triangles, too.
/// \throws Error invalid_argument, for a mesh that is not Delaunay where it changes, and for an
///         open one, whose boundary the sites do not tell.
template <Space S>
void triangulate_anew(const Mesh& old, const S& space, const std::vector<PatchRegion>& patches,
                      Mesh& mesh) {
  std::vector<std::uint8_t> of_patch(static_cast<std::size_t>(old.points.cols()), 0);
  for (const PatchRegion& patch : patches)
    for (const std::int32_t site : patch.part.sites)
      of_patch[static_cast<std::size_t>(site)] = 1;
  require(is_delaunay(old, space, of_patch),
          "the mesh is no Delaunay triangulation where it is to change; triangulate its sites");
  require(old.closed(),
          "the cells beside the part that is to change are too irregular for it, in a mesh with a "
          "boundary; give another part, or a mesh that was made more regular");
  mesh = delaunay(std::move(mesh.points), mesh.surface);
}

/// Assembles the mesh with the replacements instead of the patches.
template <Space S>
ChangedMesh assembled(const Mesh& mesh, const S& space, const std::vector<PatchRegion>& patches,
                      std::vector<Replacement>&& replacements) {
  NewSites sites = new_sites(mesh, space, patches, replacements);
  require_inside(mesh, patches, sites);
  ChangedMesh out;
  out.mesh.surface = mesh.surface;
  out.mesh.triangles = new_triangles(mesh, patches, replacements, sites);
  out.mesh.points = std::move(sites.points);
  out.mesh.neighbours = mesh_detail::neighbours_of(out.mesh.triangles, out.mesh.points.cols());
  mesh_detail::make_canonical(out.mesh.triangles, out.mesh.neighbours);
  out.mesh.site_of_input = base_detail::themselves(out.mesh.points.cols());

  std::vector<std::uint8_t> of_patch(static_cast<std::size_t>(out.mesh.points.cols()), 0);
  std::int64_t more_on_boundary = 0;
  for (std::size_t p = 0; p < replacements.size(); ++p) {
    more_on_boundary += replacements[p].on_boundary - std::ssize(patches[p].on_boundary());
    for (const std::int32_t site : patches[p].fixed_sites())
      of_patch[static_cast<std::size_t>(sites.new_of_old[site])] = 1;
    for (const std::int32_t site : sites.added[p])
      of_patch[static_cast<std::size_t>(site)] = 1;
    out.patches.push_back(std::move(replacements[p].change));
  }
  const auto open_edges = [](const Triangles& neighbours) {
    return (neighbours.array() < 0).count();
  };
  if (open_edges(out.mesh.neighbours) != open_edges(mesh.neighbours) + more_on_boundary ||
      !is_delaunay(out.mesh, space, of_patch))
    triangulate_anew(mesh, space, patches, out.mesh);
  out.width_ratio = DoubleVector::Ones(out.mesh.points.cols());
  for (std::size_t p = 0; p < replacements.size(); ++p)
    for (std::size_t k = 0; k < sites.added[p].size(); ++k)
      out.width_ratio[sites.added[p][k]] =
          replacements[p].width_ratio[static_cast<Eigen::Index>(k)];
  out.new_of_old = std::move(sites.new_of_old);
  out.old_of_new = std::move(sites.old_of_new);
  return out;
}

/// A mesh with its neighbours, widths, and the sites that stay: those at the boundary and their
/// neighbours, so that no triangle there changes, unless it ends at generators.
struct Given {
  Given(const Mesh& of, Boundary boundary) : mesh(of), around(neighbours(mesh)) {
    const Marks at_boundary = sites_at_boundary(mesh);
    own = own_widths(mesh, at_boundary);
    if (boundary == Boundary::generators)
      complete_widths(mesh, around, own);
    stays = boundary == Boundary::generators ? Marks(at_boundary.size(), 0)
                                             : mesh_detail::grown(around, at_boundary, 1);
  }

  const Mesh& mesh;
  IdLists around; ///< neighbours of the sites
  DoubleVector own;
  Marks stays;
};

WantedWidths want_widths(const Given& given, const DoubleVector& demanded, Way way,
                         const RefineOptions& options) {
  return wanted_widths(given.mesh, given.around, given.stays, given.own, demanded, way,
                       options.tolerance, options.gradient);
}

ChangedMesh changed_once(const Given& given, const Demand& demand, const WantedWidths& wanted,
                         const RefineOptions& options) {
  const Mesh& mesh = given.mesh;
  // Beside sites that stay a polish has little freedom; more rows that adapt give it more.
  constexpr int first_rows = 3, last_rows = 7;
  for (int rows = first_rows;; rows += 2) {
    const std::vector<PatchRegion> patches =
        find_patches(mesh, given.around, given.own, wanted, rows);
    std::vector<Replacement> replacements;
    for (const PatchRegion& patch : patches)
      replacements.push_back(
          make_replacement(mesh, patch, given.own, wanted.width, demand.fine(), options));
    if (rows < last_rows && !std::ranges::all_of(replacements, [](const Replacement& made) {
          return made.change.report.well_centred;
        }))
      continue;
    ChangedMesh out = in_space_of(mesh.surface, [&](const Space auto& space) {
      return assembled(mesh, space, patches, std::move(replacements));
    });
    out.held = wanted.held;
    return out;
  }
}

/// The number of cells that are wider than wanted by more than the irregularity of cells explains.
std::int64_t missed(const DoubleVector& own, const WantedWidths& wanted) {
  constexpr double irregular = 1.3;
  return (own.array() > irregular * wanted.width.array()).count();
}

/// The number of cells that are narrower than demanded, if all cells with a coarser demand are:
/// widths grow from the cells around the part, and a small part ends before they are wide.
std::int64_t nowhere_as_wide(const DoubleVector& own, const DoubleVector& demanded,
                             const WantedWidths& wanted, double tolerance) {
  const auto coarser = demanded.array() > (1 + tolerance) * own.array(),
             narrower = demanded.array() > (1 + tolerance) * wanted.width.array();
  return (coarser && !narrower).any() ? 0 : (coarser && narrower).count();
}

/// The number of new sites whose cells are beyond the limits of shapes, for any demanded spacing.
std::int64_t bad_shapes(const ChangedMesh& changed) {
  using namespace cvt_detail;
  return in_space_of(changed.mesh.surface, [&]<Space S>(const S& space) {
    const Mesh& mesh = changed.mesh;
    const Cells<S> cells(mesh.surface);
    const mesh_detail::Connectivity faces{mesh.triangles, mesh.neighbours};
    std::vector<Vec3> points;
    std::vector<std::uint8_t> stays;
    for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
      points.push_back(measured_point(space, column(mesh.points, i)));
      stays.push_back(changed.old_of_new[i] >= 0 ? pinned_on_line : std::uint8_t{0});
    }
    for (const std::int32_t site : boundary_loops(mesh).items)
      if (std::uint8_t& pin = stays[static_cast<std::size_t>(site)]; pin == 0)
        pin = sliding;
    const DoubleVector no_spacing = DoubleVector::Zero(mesh.points.cols());
    const ShapeInput<S> input{{cells, faces, points}, no_spacing, shape_limits, stays};
    Points3 unused = Points3::Zero(3, mesh.points.cols());
    return add_shape_terms(input, distorted(input), {}, unused).generators;
  });
}

/// Combines two consecutive changes to one change of the first mesh: the sites that stayed, then
/// the new ones along the curve.
ChangedMesh joined(ChangedMesh&& first, ChangedMesh&& second) {
  ChangedMesh out;
  out.held = first.held;
  const Eigen::Index count = second.old_of_new.size();
  DoubleVector ratio = second.width_ratio;
  Ids old_of_new(count);
  std::vector<Eigen::Index> added, last; // of both changes, of the second
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::int32_t between = second.old_of_new[k];
    old_of_new[k] = between < 0 ? -1 : first.old_of_new[between];
    if (between < 0)
      last.push_back(k);
    else
      ratio[k] *= first.width_ratio[between];
    if (old_of_new[k] < 0)
      added.push_back(k);
  }
  const Ids nearest = Locator(first.mesh).nearest(Points3(second.mesh.points(Eigen::all, last)));
  for (std::size_t k = 0; k < last.size(); ++k)
    ratio[last[k]] *= first.width_ratio[nearest[static_cast<Eigen::Index>(k)]];
  Array<std::int32_t> order(count);
  std::int32_t next = 0;
  for (std::int32_t k = 0; k < count; ++k)
    if (old_of_new[k] >= 0)
      order[next++] = k;
  const Array<std::int32_t> along =
      mesh_detail::curve_order(Points3(second.mesh.points(Eigen::all, added)), second.mesh.surface);
  for (std::int64_t k = 0; k < along.size(); ++k)
    order[next++] = static_cast<std::int32_t>(added[static_cast<std::size_t>(along[k])]);
  out.mesh = mesh_detail::in_order(second.mesh, order);
  out.mesh.site_of_input = base_detail::themselves(count);
  out.old_of_new.resize(count);
  out.width_ratio.resize(count);
  out.new_of_old = Ids::Constant(first.new_of_old.size(), -1);
  for (std::int32_t k = 0; k < count; ++k) {
    out.old_of_new[k] = old_of_new[order[k]];
    out.width_ratio[k] = ratio[order[k]];
    if (out.old_of_new[k] >= 0)
      out.new_of_old[out.old_of_new[k]] = k;
  }
  // Shapes that the second change has repaired do not count.
  const bool was_bad = std::ranges::any_of(
      first.patches, [](const ChangedPatch& patch) { return !patch.report.well_centred; });
  const bool is_good = was_bad && bad_shapes(out) == 0;
  for (ChangedPatch& patch : first.patches) {
    if (is_good) {
      patch.report.well_centred = true;
      patch.report.cells_beyond_limits = 0;
    }
    out.patches.push_back(std::move(patch));
  }
  for (ChangedPatch& patch : second.patches)
    out.patches.push_back(std::move(patch));
  return out;
}

Marks new_sites(const ChangedMesh& changed) {
  Marks marks(static_cast<std::size_t>(changed.old_of_new.size()));
  std::transform(changed.old_of_new.begin(), changed.old_of_new.end(), marks.begin(),
                 [](std::int32_t old) { return static_cast<std::uint8_t>(old < 0); });
  return marks;
}

/// Refuses a mesh that does not end at generators, see RefineOptions::boundary.
void require_end_at_generators(const Mesh& mesh) {
  constexpr double near = 0.1; // of an outer edge
  require(!mesh.closed(), "the mesh has no boundary; leave the boundary out");
  if (!mesh.surface.is_bounded())
    return;
  const IdLists loops = boundary_loops(mesh);
  in_space_of(mesh.surface, [&]<Space S>(const S& space) {
    const auto& outline = *domain_detail::outline_of<S>(mesh.surface);
    for (std::int64_t loop = 0; loop < loops.size(); ++loop)
      for (std::size_t k = 0; k < loops[loop].size(); ++k) {
        const std::int32_t site = loops[loop][k], next = loops[loop][(k + 1) % loops[loop].size()];
        const Vec3 x = measured_point(space, column(mesh.points, site));
        const double reach =
            near * norm(space.offset(x, measured_point(space, column(mesh.points, next))));
        bool found = false;
        domain_detail::for_each_edge_near<S>(
            outline, x, reach, [&](const domain_detail::Arc& edge) {
              found = found || norm(domain_detail::nearest_point<S>(edge, x) - x) <= reach;
            });
        if (!found)
          base_detail::refuse_at(site,
                                 "site {} at the end of the mesh is not on the boundary of its "
                                 "surface; give a mesh that ends at generators, or leave the "
                                 "boundary out");
      }
  });
}

/// Changes a mesh. Finer cells are made in steps where the demand lies between sites: the new sites
/// of a step sample the demand of the next.
ChangedMesh changed(const Mesh& mesh, const WidthDemand& wanted, Way way,
                    const RefineOptions& options) {
  const Given given(mesh, options.boundary);
  const Demand demand(wanted, way, mesh, given.own);
  if (way == Way::coarser) {
    const DoubleVector demanded = demand.at(mesh.points);
    require(!wanted.region || (demanded.array() > 0).any(),
            "the region holds the centre of no cell, so that none becomes coarser; give a larger "
            "one");
    const WantedWidths widths = want_widths(given, demanded, way, options);
    ChangedMesh out = changed_once(given, demand, widths, options);
    out.missed = nowhere_as_wide(given.own, demanded, widths, options.tolerance);
    return out;
  }
  const auto demanded_on = [&](const Given& now, const Marks& may_change) {
    return demand.on_cells(now.mesh, now.own, may_change, options.gradient);
  };
  const Marks all(static_cast<std::size_t>(mesh.points.cols()), 1);
  const DoubleVector demanded = demanded_on(given, all);
  require(!wanted.region || (demanded.array() < given.own.array()).any(),
          "the region holds no cells of the mesh; give a region inside the mesh");
  ChangedMesh out =
      changed_once(given, demand, want_widths(given, demanded, way, options), options);
  constexpr int most_steps = 4;
  for (int step = 1; !out.patches.empty(); ++step) {
    const Given now(out.mesh, options.boundary);
    const WantedWidths widths = want_widths(now, demanded_on(now, new_sites(out)), way, options);
    out.missed = missed(now.own, widths);
    if (out.missed == 0 || step == most_steps)
      break;
    ChangedMesh next = changed_once(now, demand, widths, options);
    if (next.patches.empty())
      break;
    out = joined(std::move(out), std::move(next));
  }
  return out;
}

/// The mesh, which ends at its outer edges: its surface has no rings.
Mesh without_rings(Mesh mesh) {
  const Eigen::Vector2d period = mesh.surface.period();
  mesh.surface = mesh.surface.is_sphere() ? Surface::sphere()
                 : period.isZero(0)       ? Surface::plane()
                                          : Surface::periodic(period);
  return mesh;
}

ChangedMesh changed_to_its_end(const Mesh& mesh, const WidthDemand& wanted, Way way,
                               const RefineOptions& options) {
  require_demand(mesh, wanted, way, options);
  if (options.boundary != Boundary::generators)
    return changed(mesh, wanted, way, options);
  require(way == Way::finer, "cells at the boundary do not become coarser; leave it out");
  require_end_at_generators(mesh);
  return mesh.surface.is_bounded() ? changed(without_rings(mesh), wanted, way, options)
                                   : changed(mesh, wanted, way, options);
}

} // namespace
} // namespace grids_detail

double radius_of_widths(std::optional<double> planet_km, double sphere_radius, double given_km) {
  const bool given = given_km != earth_radius_km;
  if (planet_km && (sphere_radius != 1 || (!given && !is_earth(*planet_km))))
    return *planet_km;
  return given_km;
}

ChangedMesh refine(const Mesh& mesh, const WidthDemand& demand, const RefineOptions& options) {
  return grids_detail::changed_to_its_end(mesh, demand, grids_detail::Way::finer, options);
}

ChangedMesh coarsen(const Mesh& mesh, const WidthDemand& demand, const RefineOptions& options) {
  return grids_detail::changed_to_its_end(mesh, demand, grids_detail::Way::coarser, options);
}

} // namespace calotte
