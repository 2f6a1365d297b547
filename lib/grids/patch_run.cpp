// SPDX-License-Identifier: GPL-3.0-or-later
#include "grids/patch_run.h"

#include "base/points.h"
#include "base/require.h"
#include "cvt/stages.h"
#include "density/demanded_spacing.h"
#include "domain/arcs.h"
#include "exact/space.h"
#include "generators/boundary.h"
#include "grids/schedule.h"
#include "mesh/edges.h"

#include <calotte/delaunay.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace calotte::grids_detail {
namespace {

using base_detail::require;
using density_detail::DemandedSpacing;
using mesh_detail::Submesh;

/// The sites of a patch: on the sphere unit columns, in a periodic plane unwrapped.
/// \throws Error invalid_argument for a patch that leads around a periodic plane.
template <Space S> Points3 local_points(const Mesh& mesh, const S& space, const Submesh& part) {
  Points3 out(3, std::ssize(part.sites));
  const auto given = [&](std::int32_t own) {
    return column(mesh.points, part.sites[static_cast<std::size_t>(own)]);
  };
  if constexpr (S::on_sphere) {
    for (std::int32_t k = 0; k < out.cols(); ++k)
      set_column(out, k, domain_detail::as_unit(given(k)));
  } else {
    // Visits triangle after triangle; each corner is the copy nearest to the previous corners.
    const auto& [triangles, neighbours] = part.faces;
    std::vector<std::uint8_t> is_set(part.sites.size(), 0);
    const auto set_corner = [&](std::int32_t k, const auto& beside) {
      const auto position = space.near(given(k), beside);
      const Vec3 here = space.coordinates(position);
      require(std::exchange(is_set[static_cast<std::size_t>(k)], std::uint8_t{1}) == 0 ||
                  norm(column(out, k) - here) == 0,
              "a patch leads around the periodic plane; give a smaller region, or make a new grid");
      set_column(out, k, here);
      return position;
    };
    std::vector<std::optional<typename S::Position>> first(part.triangles.size()); // by triangle
    std::vector<std::int32_t> queue{0};
    first[0] = space.position(given(triangles(0, 0)));
    for (std::size_t q = 0; q < queue.size(); ++q) {
      const std::int32_t t = queue[q];
      const auto at = *first[static_cast<std::size_t>(t)];
      for (int i = 0; i < 3; ++i) {
        const auto corner = set_corner(triangles(i, t), at);
        for (int across = 0; across < 3; ++across)
          if (const std::int32_t beyond = neighbours(across, t);
              across != i && beyond >= 0 && !first[static_cast<std::size_t>(beyond)]) {
            first[static_cast<std::size_t>(beyond)] = corner;
            queue.push_back(beyond);
          }
      }
    }
  }
  return out;
}

/// A patch as a mesh of its own.
Mesh local_mesh(const Mesh& mesh, const Submesh& part) {
  Mesh out = as_mesh(part, mesh);
  out.points = in_space_of(
      mesh.surface, [&](const Space auto& space) { return local_points(mesh, space, part); });
  out.surface = mesh.surface.is_sphere() ? Surface::sphere() : Surface::plane();
  return out;
}

/// The density of widths, interpolated between sites; it is 1 at the least width.
Density density_between(const Mesh& local, const DoubleVector& width) {
  return interpolated_density(local, (width / width.minCoeff()).array().pow(-4).matrix());
}

/// The density of widths at sites, and of finer widths between them. Where sites beside a boundary
/// have wider cells than demanded, the positions around them do, too.
Density make_density(const Mesh& local, const DoubleVector& width, const FineWidths* fine,
                     double tolerance) {
  const double least = width.minCoeff();
  const Density between = density_between(local, width);
  if (fine == nullptr)
    return between;
  // Widths may be finer between the sites than at them.
  const double met = fine->scale / (1 - tolerance);
  const DoubleVector wider =
      (width.array() / (met * evaluate(fine->widths, local.points)).array()).max(1);
  const Density beside = interpolated_density(local, wider.array().pow(-4).matrix());
  const bool is_wider = wider.maxCoeff() > 1;
  Density result;
  result.kind = Density::Kind::callable;
  const double scale = met / least;
  result.callable = [between, beside, is_wider, widths = fine->widths,
                     scale](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    between.callable(x, rho);
    const DoubleVector narrow = evaluate(widths, x);
    DoubleVector share = DoubleVector::Ones(x.cols());
    if (is_wider)
      beside.callable(x, share);
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      rho[i] = std::max(rho[i], share[i] * std::pow(scale * narrow[i], -4));
  };
  return result;
}

/// The widths of a density divided by the mesh's old widths, at some positions.
/// \param least width at which the density is 1.
DoubleVector width_ratio(const Mesh& local, const DoubleVector& own, const Density& density,
                         double least, const Points3& positions) {
  if (positions.cols() == 0)
    return {};
  const DoubleVector now = evaluate(density, positions, local.surface),
                     before = evaluate(density_between(local, own), positions, local.surface);
  return least / own.minCoeff() * (before.array() / now.array()).pow(0.25);
}

/// The surface that the rings of a patch bound.
Surface make_surface(const Mesh& mesh, const PatchRegion& patch, const Mesh& local) {
  Surface::Rings rings;
  const bool sphere = mesh.surface.is_sphere();
  for (const std::vector<std::int32_t>& ring : patch.rings) {
    DoubleMatrix corners(sphere ? 3 : 2, std::ssize(ring));
    for (Eigen::Index k = 0; k < corners.cols(); ++k)
      corners.col(k) = local.points.col(ring[static_cast<std::size_t>(k)]).head(corners.rows());
    rings.push_back(std::move(corners));
  }
  return rings.empty() ? mesh.surface : local.surface.within(std::move(rings));
}

/// The sites of a patch that bound it: those that stay, and generators instead of the others.
struct Bounds {
  std::vector<Vec3> points;       ///< the generators, numbered after the sites that stay
  std::vector<std::int32_t> next; ///< along the rings, see Schedule::next_on_boundary

  auto on_boundary() const { return static_cast<std::int32_t>(points.size()); }
};

/// The sites on a ring from one that stays on, if there is one.
std::vector<std::int32_t> from_fixed(const PatchRegion& patch, std::vector<std::int32_t> ring) {
  const auto first = std::ranges::find_if(ring, [&](auto site) { return site < patch.fixed; });
  std::rotate(ring.begin(), first == ring.end() ? ring.begin() : first, ring.end());
  return ring;
}

Bounds make_bounds(const PatchRegion& patch, const Mesh& local, const Surface& surface,
                   const DemandedSpacing& spacing) {
  Bounds out;
  out.next.assign(static_cast<std::size_t>(patch.rings.empty() ? 0 : patch.fixed), -1);
  for (const std::vector<std::int32_t>& given : patch.rings) {
    const std::vector<std::int32_t> ring = from_fixed(patch, given);
    const bool closed = ring.front() >= patch.fixed; // none stays
    std::vector<std::int32_t> order;
    for (std::size_t k = 0; k < ring.size();) {
      if (!closed)
        order.push_back(ring[k++]);
      std::vector<Vec3> corners;
      for (; k < ring.size() && ring[k] >= patch.fixed; ++k)
        corners.push_back(column(local.points, ring[k]));
      if (corners.empty())
        continue;
      if (!closed) {
        corners.insert(corners.begin(), column(local.points, order.back()));
        corners.push_back(column(local.points, ring[k % ring.size()]));
      }
      for (const Vec3& point :
           generators_detail::points_along_boundary(surface, corners, closed, spacing)) {
        order.push_back(patch.fixed + out.on_boundary());
        out.points.push_back(point);
        out.next.push_back(-1);
      }
    }
    for (std::size_t k = 0; k < order.size(); ++k)
      out.next[static_cast<std::size_t>(order[k])] = order[(k + 1) % order.size()];
  }
  return out;
}

/// The number of sites of the new patch. One on the boundary has half a cell.
std::int64_t choose_count(const PatchRegion& patch, const DoubleVector& own,
                          const DoubleVector& wanted, std::int32_t on_boundary) {
  double sum = -0.5 * on_boundary;
  const auto add = [&](std::int32_t site, double cells) {
    const double ratio = own[site] / wanted[site];
    sum += cells * ratio * ratio;
  };
  for (const std::int32_t site : patch.free_sites())
    add(site, 1);
  for (const std::int32_t own_number : patch.on_boundary())
    add(patch.part.sites[static_cast<std::size_t>(own_number)], -0.5);
  return patch.fixed + on_boundary + std::max<std::int64_t>(std::llround(sum), 1);
}

/// The sites that stay, the generators on the boundary, and the free sites inside.
Points3 first_points(const PatchRegion& patch, const Mesh& local, const Bounds& bounds) {
  std::vector<std::uint8_t> is_inside(patch.part.sites.size(), 1);
  for (const std::int32_t site : patch.on_boundary())
    is_inside[static_cast<std::size_t>(site)] = 0;
  std::vector<Eigen::Index> inside;
  for (Eigen::Index k = patch.fixed; k < local.points.cols(); ++k)
    if (is_inside[static_cast<std::size_t>(k)] != 0)
      inside.push_back(k);
  Points3 along(3, bounds.on_boundary());
  for (Eigen::Index k = 0; k < along.cols(); ++k)
    set_column(along, k, bounds.points[static_cast<std::size_t>(k)]);
  Points3 all(3, patch.fixed + along.cols() + std::ssize(inside));
  all << local.points.leftCols(patch.fixed), along, local.points(Eigen::all, inside);
  return all;
}

/// Points, with midpoints of edges that are too long, added repeatedly; none between fixed ones.
/// Midpoints keep the directions of the rows of cells, so that few dislocations are needed beside
/// the patch.
/// \param surface of the patch, whose rings may be concave: edges across them have none.
/// \param least width at which the density is 1.
Points3 with_midpoints(Points3&& points, const Surface& surface, std::int64_t fixed,
                       const Density& density, double least) {
  constexpr double longest = 1.5; // widths
  constexpr int most_passes = 8;
  const Surface whole = surface.is_sphere() ? Surface::sphere() : Surface::plane();
  Mesh mesh = delaunay(std::move(points), whole);
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<std::array<Vec3, 2>> edges;
    mesh_detail::for_each_edge(mesh, [&](std::int32_t a, std::int32_t b) {
      if (std::max(a, b) >= fixed)
        edges.push_back({column(mesh.points, a), column(mesh.points, b)});
    });
    Points3 middles(3, std::ssize(edges));
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const auto& [a, b] = edges[k];
      set_column(middles, static_cast<std::int64_t>(k),
                 mesh.surface.is_sphere() ? Sphere::midpoint(a, b) : Plane().midpoint(a, b));
    }
    const DoubleVector rho = evaluate(density, middles, mesh.surface);
    std::vector<Eigen::Index> chosen;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const auto index = static_cast<Eigen::Index>(k);
      if (norm(edges[k][1] - edges[k][0]) > longest * least * std::pow(rho[index], -0.25) &&
          surface.contains(middles.col(index)))
        chosen.push_back(index);
    }
    if (chosen.empty())
      break;
    Points3 all(3, mesh.points.cols() + std::ssize(chosen));
    all << mesh.points, middles(Eigen::all, chosen);
    mesh = delaunay(std::move(all), whole);
  }
  return std::move(mesh.points);
}

/// The schedule of a patch's run from given points.
/// \param points the fixed ones first: those that stay, then those on the boundary.
Schedule make_schedule(const Surface& surface, const Density& density, std::int64_t cells,
                       const Bounds& bounds, std::int64_t fixed, const Points3& points) {
  constexpr double tolerance = 1e-4;
  constexpr int rounds = 3;
  Schedule schedule;
  Recipe& recipe = schedule.recipe;
  schedule.density = density;
  schedule.on_boundary = bounds.on_boundary();
  schedule.next_on_boundary = bounds.next;
  recipe.cells = cells;
  recipe.surface = surface;
  recipe.boundary = surface.is_bounded() ? Boundary::generators : Boundary::clip;
  recipe.fixed = points.leftCols(fixed);
  recipe.start.kind = CvtStart::Kind::points;
  recipe.start.points = points.rightCols(points.cols() - fixed);
  recipe.start.insertion_rounds = rounds;
  recipe.stop.tolerance = tolerance;
  recipe.stop.well_centred = true;
  schedule.first = recipe.start.kind;
  schedule.actions = actions_of(recipe, {.kind = recipe.start.kind, .cells = points.cols()}, 0,
                                schedule.on_boundary);
  return schedule;
}

} // namespace

Replacement make_replacement(const Mesh& mesh, const PatchRegion& patch, const DoubleVector& own,
                             const DoubleVector& wanted, const FineWidths* fine,
                             const RefineOptions& options) {
  const Mesh local = local_mesh(mesh, patch.part);
  const DoubleVector width = wanted(patch.part.sites);
  const Density density = make_density(local, width, fine, options.tolerance);
  const double least = width.minCoeff();
  const Surface surface = make_surface(mesh, patch, local);
  const Bounds bounds =
      make_bounds(patch, local, surface, DemandedSpacing::of_width(surface, density, least));
  const std::int32_t on_boundary = bounds.on_boundary();
  const std::int64_t fixed = patch.fixed + on_boundary;
  const Schedule schedule = make_schedule(
      surface, density, choose_count(patch, own, wanted, on_boundary), bounds, fixed,
      with_midpoints(first_points(patch, local, bounds), surface, fixed, density, least));
  RunOptions run;
  run.decomposition = options.decomposition;
  run.progress = options.progress;
  Cvt grid = make_grid(schedule, std::move(run));
  const std::int64_t added = grid.mesh.points.cols() - patch.fixed;
  const Points3 positions = grid.mesh.points.rightCols(added);
  Replacement out;
  out.on_boundary = on_boundary;
  out.width_ratio = width_ratio(local, own(patch.part.sites), density, least, positions);
  out.change = {std::ssize(patch.free_sites()), added, std::move(grid.report)};
  out.mesh = std::move(grid.mesh);
  return out;
}

} // namespace calotte::grids_detail
