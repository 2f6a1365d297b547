// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/refine.h>

#include "base/number_text.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "exact/space.h"
#include "grids/patch_run.h"
#include "mesh/adjacency.h"
#include "mesh/canonical_order.h"
#include "mesh/connectivity.h"
#include "mesh/faces.h"
#include "mesh/renumber.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace calotte {
namespace grids_detail {
namespace {

using base_detail::require;
using base_detail::shortly;
using mesh_detail::RingStarts;

void require_range(double value, double least, double most, const std::string& name) {
  require(value >= least && value <= most, "the " + name + " is " + shortly(value) + "; give " +
                                               shortly(least) + " to " + shortly(most));
}

void require_demand(const Mesh& mesh, const WidthDemand& demand, const RefineOptions& options) {
  require(demand.widths.has_value() != demand.region.has_value(),
          demand.widths ? "the demand has widths and a region; give one of them"
                        : "the demand has neither widths nor a region; give one of them");
  require(!demand.region || demand.region->is_sphere() == mesh.surface.is_sphere(),
          "the region is not of the mesh's kind of surface; give one of the " +
              std::string(mesh.surface.is_sphere() ? "sphere" : "plane"));
  require(!demand.widths || !demand.widths->is_of_plane() || !mesh.surface.is_sphere(),
          "the widths are those of a plane, and the mesh is one of the sphere; give widths in km");
  if (demand.region) {
    require(demand.factor > 1, "the factor is " + shortly(demand.factor) + "; give more than 1");
    require_range(demand.factor, 1, 100, "factor");
  }
  require(demand.radius_km > 0 && std::isfinite(demand.radius_km),
          "the radius is " + shortly(demand.radius_km) + "; give a positive number of km");
  require_range(options.tolerance, 0.01, 0.5, "tolerance");
  require_range(options.gradient, 0.001, 1, "gradient");
  require(mesh.triangles.cols() > 0 && mesh.neighbours.cols() == mesh.triangles.cols(),
          "the mesh lacks triangles or neighbours; give one of delaunay() or read_mesh()");
}

/// A demand as widths at places, in the unit of the mesh.
class Demand {
public:
  Demand(const WidthDemand& demand, Way way, const Surface& surface)
      : demand_(demand), way_(way), unit_(surface.is_sphere() ? 1 / demand.radius_km : 1),
        factor_(way == Way::finer ? 1 / demand.factor : demand.factor),
        fine_(demand.widths && way == Way::finer ? std::optional(FineWidths{*demand.widths, unit_})
                                                 : std::nullopt) {}

  /// At sites with their own widths.
  DoubleVector at_sites(const Points3& points, const DoubleVector& own) const {
    if (demand_.widths) {
      DoubleVector widths = unit_ * evaluate(*demand_.widths, points);
      const double silent = 0.5 * unit_ * Widths::no_demand;
      return way_ == Way::coarser ? DoubleVector((widths.array() < silent).select(widths, 0))
                                  : widths;
    }
    DoubleVector widths(own.size());
    base_detail::for_each_block(
        own.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
          for (std::int64_t i = begin; i != end; ++i)
            widths[i] = own[i] * (demand_.region->contains(points.col(i)) ? factor_ : 1);
        });
    return widths;
  }

  /// Of finer cells, widths anywhere; null where they are known at sites only.
  const FineWidths* fine() const { return fine_ ? &*fine_ : nullptr; }

private:
  const WidthDemand& demand_;
  Way way_;
  double unit_; ///< of a width, in that of the mesh
  double factor_;
  std::optional<FineWidths> fine_;
};

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
    for (const std::int32_t site : patches[p].free)
      out.new_of_old[site] = -1;
    added += replacements[p].change.added;
  }
  std::int32_t kept = 0;
  for (std::int32_t& id : out.new_of_old)
    if (id == 0)
      id = kept++;

  // Columns of the sphere have the norm of those beside them.
  Points3 places(3, added);
  std::int64_t next = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const std::int64_t fixed = std::ssize(patches[p].fixed);
    const double length =
        S::on_sphere && fixed > 0 ? norm(column(mesh.points, patches[p].fixed.front())) : 1;
    const double scale = std::abs(length - 1) < 1e-9 ? 1 : length;
    for (std::int64_t k = fixed; k < replacements[p].mesh.points.cols(); ++k)
      set_column(places, next++, scale * space.wrapped(column(replacements[p].mesh.points, k)));
  }
  const Array<std::int32_t> order = mesh_detail::curve_order(places, mesh.surface);
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
    out.points.col(kept + r) = places.col(order[r]);
  }
  auto at = rank.begin();
  for (const Replacement& replacement : replacements) {
    out.added.emplace_back(at, at + replacement.change.added);
    at += replacement.change.added;
  }
  return out;
}

/// Where a patch touches itself across a narrow gap in the surface, it may reach over that.
void require_inside(const Mesh& mesh, const std::vector<PatchRegion>& patches,
                    const NewSites& sites) {
  if (!mesh.surface.is_bounded())
    return;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (const std::int32_t site : sites.added[p])
      if (!mesh.surface.contains(sites.points.col(site)))
        throw Error(ErrorCode::invalid_argument,
                    "the patch around site " + std::to_string(patches[p].free.front()) +
                        " would reach across the boundary of the surface; give a part that is "
                        "farther from it",
                    patches[p].free.front());
}

/// The triangles beside the patches, and those of the replacements.
Triangles new_triangles(const Mesh& mesh, const std::vector<PatchRegion>& patches,
                        const std::vector<Replacement>& replacements, const NewSites& sites) {
  std::vector<std::uint8_t> replaced(static_cast<std::size_t>(mesh.triangles.cols()), 0);
  Eigen::Index count = mesh.triangles.cols();
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (const std::int32_t t : patches[p].triangles)
      replaced[static_cast<std::size_t>(t)] = 1;
    count += replacements[p].mesh.triangles.cols() - std::ssize(patches[p].triangles);
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
    const std::int64_t fixed = std::ssize(patches[p].fixed);
    for (const auto& triangle : replacements[p].mesh.triangles.colwise()) {
      for (int i = 0; i < 3; ++i)
        out(i, next) =
            triangle(i) < fixed
                ? sites.new_of_old[patches[p].fixed[static_cast<std::size_t>(triangle(i))]]
                : sites.added[p][static_cast<std::size_t>(triangle(i) - fixed)];
      ++next;
    }
  }
  return out;
}

/// Whether each edge of a triangle with a site of a patch is Delaunay.
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

/// A patch of a Delaunay triangulation fits.
template <Space S>
[[noreturn]] void refuse_misfit(const Mesh& mesh, const S& space,
                                const std::vector<PatchRegion>& patches) {
  std::vector<std::uint8_t> of_patch(static_cast<std::size_t>(mesh.points.cols()), 0);
  for (const PatchRegion& patch : patches)
    for (const auto* sites : {&patch.fixed, &patch.free})
      for (const std::int32_t site : *sites)
        of_patch[static_cast<std::size_t>(site)] = 1;
  require(is_delaunay(mesh, space, of_patch),
          "the mesh is no Delaunay triangulation where it is to change; triangulate its sites");
  throw Error(ErrorCode::internal,
              "a patch does not fit into the mesh; please report this input as a bug");
}

/// Puts the patches' replacements in their places.
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
  for (std::size_t p = 0; p < replacements.size(); ++p) {
    for (const std::int32_t site : patches[p].fixed)
      of_patch[static_cast<std::size_t>(sites.new_of_old[site])] = 1;
    for (const std::int32_t site : sites.added[p])
      of_patch[static_cast<std::size_t>(site)] = 1;
    out.patches.push_back(std::move(replacements[p].change));
  }
  const auto open_edges = [](const Triangles& neighbours) {
    return (neighbours.array() < 0).count();
  };
  if (open_edges(out.mesh.neighbours) != open_edges(mesh.neighbours) ||
      !is_delaunay(out.mesh, space, of_patch))
    refuse_misfit(mesh, space, patches);
  out.width_ratio = DoubleVector::Ones(out.mesh.points.cols());
  for (std::size_t p = 0; p < replacements.size(); ++p)
    for (std::size_t k = 0; k < sites.added[p].size(); ++k)
      out.width_ratio[sites.added[p][k]] =
          replacements[p].width_ratio[static_cast<Eigen::Index>(k)];
  out.new_of_old = std::move(sites.new_of_old);
  out.old_of_new = std::move(sites.old_of_new);
  return out;
}

ChangedMesh changed(const Mesh& mesh, const WidthDemand& demand, Way way,
                    const RefineOptions& options) {
  require_demand(mesh, demand, options);
  const RingStarts rings = mesh_detail::make_ring_starts(faces_of(mesh));
  const Marks at_boundary = sites_at_boundary(mesh);
  const DoubleVector own = own_widths(mesh, rings, at_boundary);
  const Demand widths(demand, way, mesh.surface);
  const WantedWidths wanted =
      wanted_widths(mesh, rings, at_boundary, own, widths.at_sites(mesh.points, own), way,
                    options.tolerance, options.gradient);
  // Beside sites that stay a polish has less freedom: more rows that adapt give it more.
  constexpr int first_rows = 3, last_rows = 7;
  for (int rows = first_rows;; rows += 2) {
    const std::vector<PatchRegion> patches = patches_of(mesh, own, wanted, rows);
    std::vector<Replacement> replacements;
    for (const PatchRegion& patch : patches)
      replacements.push_back(
          replacement_of(mesh, patch, own, wanted.width, widths.fine(), options));
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

} // namespace
} // namespace grids_detail

ChangedMesh refine(const Mesh& mesh, const WidthDemand& demand, const RefineOptions& options) {
  return grids_detail::changed(mesh, demand, grids_detail::Way::finer, options);
}

ChangedMesh coarsen(const Mesh& mesh, const WidthDemand& demand, const RefineOptions& options) {
  return grids_detail::changed(mesh, demand, grids_detail::Way::coarser, options);
}

} // namespace calotte
