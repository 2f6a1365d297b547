// SPDX-License-Identifier: GPL-3.0-or-later
#include "grids/patch_run.h"

#include "base/points.h"
#include "base/require.h"
#include "cvt/stages.h"
#include "domain/arcs.h"
#include "exact/space.h"
#include "grids/schedule.h"
#include "mesh/edges.h"

#include <calotte/delaunay.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace calotte::grids_detail {
namespace {

using base_detail::require;

/// Sites of a patch by themselves: in a periodic plane, in one without periods.
struct LocalSites {
  std::vector<std::int32_t> site; ///< of the mesh; first those that stay
  std::unordered_map<std::int32_t, std::int32_t> local;
  Points3 points; ///< on the sphere unit columns

  std::int32_t of(std::int32_t id) const { return local.at(id); }
};

/// \throws Error invalid_argument for a patch that leads around a periodic plane.
template <Space S>
LocalSites local_sites(const Mesh& mesh, const S& space, const PatchRegion& patch) {
  LocalSites out;
  out.site = patch.fixed;
  out.site.insert(out.site.end(), patch.free.begin(), patch.free.end());
  for (const std::int32_t site : out.site)
    out.local.emplace(site, static_cast<std::int32_t>(out.local.size()));
  out.points.resize(3, std::ssize(out.site));
  if constexpr (S::on_sphere) {
    for (std::size_t k = 0; k < out.site.size(); ++k)
      set_column(out.points, static_cast<std::int64_t>(k),
                 domain_detail::as_unit(column(mesh.points, out.site[k])));
  } else {
    // From one triangle to the next, each corner in the copy nearest to the corners before.
    std::vector<std::uint8_t> placed(out.site.size(), 0);
    const auto place = [&](std::int32_t id, const auto& beside) {
      const std::int32_t k = out.of(id);
      const auto position = space.near(column(mesh.points, id), beside);
      const Vec3 here = space.coordinates(position);
      require(std::exchange(placed[static_cast<std::size_t>(k)], std::uint8_t{1}) == 0 ||
                  norm(column(out.points, k) - here) == 0,
              "a patch leads around the periodic plane; give a smaller region, or make a new grid");
      set_column(out.points, k, here);
      return position;
    };
    std::unordered_map<std::int32_t, typename S::Position> first; // by triangle
    std::vector<std::int32_t> queue{patch.triangles.front()};
    first.emplace(queue.front(), space.position(column(mesh.points, mesh.triangles(0, queue[0]))));
    const auto inside = [&](std::int32_t t) {
      return t >= 0 && std::binary_search(patch.triangles.begin(), patch.triangles.end(), t);
    };
    for (std::size_t q = 0; q < queue.size(); ++q) {
      const std::int32_t t = queue[q];
      const auto at = first.at(t);
      for (int i = 0; i < 3; ++i) {
        const auto corner = place(mesh.triangles(i, t), at);
        for (int across = 0; across < 3; ++across)
          if (const std::int32_t beyond = mesh.neighbours(across, t);
              across != i && inside(beyond) && !first.contains(beyond)) {
            first.emplace(beyond, corner);
            queue.push_back(beyond);
          }
      }
    }
  }
  return out;
}

/// The triangles of a patch, with its sites by themselves.
Mesh local_mesh(const Mesh& mesh, const PatchRegion& patch, const LocalSites& sites) {
  Mesh out;
  out.points = sites.points;
  out.surface = mesh.surface.is_sphere() ? Surface::sphere() : Surface::plane();
  const auto count = static_cast<Eigen::Index>(patch.triangles.size());
  out.triangles.resize(3, count);
  out.neighbours.resize(3, count);
  std::unordered_map<std::int32_t, std::int32_t> local;
  for (const std::int32_t t : patch.triangles)
    local.emplace(t, static_cast<std::int32_t>(local.size()));
  for (Eigen::Index k = 0; k < count; ++k)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t t = patch.triangles[static_cast<std::size_t>(k)];
      out.triangles(i, k) = sites.of(mesh.triangles(i, t));
      const auto beyond = local.find(mesh.neighbours(i, t));
      out.neighbours(i, k) = beyond == local.end() ? -1 : beyond->second;
    }
  return out;
}

DoubleVector at_sites(const DoubleVector& of_mesh, const LocalSites& sites) {
  DoubleVector out(std::ssize(sites.site));
  for (Eigen::Index k = 0; k < out.size(); ++k)
    out[k] = of_mesh[sites.site[static_cast<std::size_t>(k)]];
  return out;
}

/// The density of widths, whose least has the density 1.
Density density_between(const Mesh& local, const DoubleVector& width) {
  return interpolated_density(local, (width / width.minCoeff()).array().pow(-4).matrix());
}

/// The density of widths at sites, and of finer ones between them. Where sites beside a boundary
/// are to be wider than demanded, so are the places around them.
Density density_of(const Mesh& local, const DoubleVector& width, const FineWidths* fine,
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
  const bool is_held = wider.maxCoeff() > 1;
  Density result;
  result.kind = Density::Kind::callable;
  const double scale = met / least;
  result.callable = [between, beside, is_held, widths = fine->widths,
                     scale](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    between.callable(x, rho);
    const DoubleVector narrow = evaluate(widths, x);
    DoubleVector share = DoubleVector::Ones(x.cols());
    if (is_held)
      beside.callable(x, share);
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      rho[i] = std::max(rho[i], share[i] * std::pow(scale * narrow[i], -4));
  };
  return result;
}

/// The widths of a density over those that the mesh had, at some places.
/// \param least width at which the density is 1.
DoubleVector width_ratio(const Mesh& local, const DoubleVector& own, const Density& density,
                         double least, const Points3& places) {
  if (places.cols() == 0)
    return {};
  const DoubleVector now = evaluate(density, places, local.surface),
                     before = evaluate(density_between(local, own), places, local.surface);
  return least / own.minCoeff() * (before.array() / now.array()).pow(0.25);
}

/// The surface that the rings of a patch bound.
Surface surface_of(const Mesh& mesh, const PatchRegion& patch, const LocalSites& sites) {
  Surface::Rings rings;
  const bool sphere = mesh.surface.is_sphere();
  for (const std::vector<std::int32_t>& ring : patch.rings) {
    DoubleMatrix corners(sphere ? 3 : 2, std::ssize(ring));
    for (Eigen::Index k = 0; k < corners.cols(); ++k)
      corners.col(k) =
          sites.points.col(sites.of(ring[static_cast<std::size_t>(k)])).head(corners.rows());
    rings.push_back(std::move(corners));
  }
  const Surface whole = sphere ? Surface::sphere() : Surface::plane();
  return rings.empty() ? mesh.surface : whole.within(std::move(rings));
}

/// The number of sites that a patch is to have.
std::int64_t count_of(const PatchRegion& patch, const DoubleVector& own,
                      const DoubleVector& wanted) {
  double sum = 0;
  for (const std::int32_t site : patch.free) {
    const double ratio = own[site] / wanted[site];
    sum += ratio * ratio;
  }
  return std::ssize(patch.fixed) + std::max<std::int64_t>(std::llround(sum), 1);
}

/// Midpoints of the edges that are too long, again and again; none between fixed sites. They keep
/// the directions of the rows of cells, so that few dislocations are needed beside the patch.
/// \param local the patch. \param surface of the patch, whose rings may be concave: edges across
/// them have none. \param least width at which the density is 1.
Points3 with_midpoints(const Mesh& local, const Surface& surface, std::int64_t fixed,
                       const Density& density, double least) {
  constexpr double longest = 1.5; // widths
  constexpr int most_passes = 8;
  Mesh mesh = local;
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
    mesh = delaunay(std::move(all), mesh.surface);
  }
  return std::move(mesh.points);
}

/// The run of a patch from points, whose choices are made here.
Schedule schedule_of(const Surface& surface, const Density& density, std::int64_t cells,
                     std::int64_t fixed, const Points3& points) {
  constexpr double tolerance = 1e-4;
  constexpr int rounds = 3;
  Schedule schedule;
  Recipe& recipe = schedule.recipe;
  recipe.cells = cells;
  recipe.density = density;
  recipe.surface = surface;
  recipe.boundary = surface.is_bounded() ? Boundary::generators : Boundary::clip;
  recipe.fixed = points.leftCols(fixed);
  recipe.start.kind = Start::Kind::points;
  recipe.start.points = points.rightCols(points.cols() - fixed);
  recipe.start.insertion_rounds = rounds;
  recipe.stop.tolerance = tolerance;
  recipe.stop.well_centred = true;
  schedule.first = recipe.start.kind;
  schedule.levels.resize(1);
  schedule.levels = levels_of(surface, points.cols(), 0, options_of(schedule));
  return schedule;
}

/// The Delaunay triangles of the sites of a patch, of which the fixed ones come first, within its
/// rings: what is reached from their left without crossing them. Where the rings are straight up to
/// rounding, it takes more than a triangle's centre to tell.
Mesh mesh_within(Points3&& points, const PatchRegion& patch, const LocalSites& sites,
                 const Surface& surface) {
  const auto key = [](std::int32_t from, std::int32_t to) {
    return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
  };
  std::unordered_set<std::uint64_t> rim;
  for (const std::vector<std::int32_t>& ring : patch.rings)
    for (std::size_t k = 0; k < ring.size(); ++k)
      rim.insert(key(sites.of(ring[k]), sites.of(ring[(k + 1) % ring.size()])));
  Mesh mesh = delaunay(std::move(points), surface);
  std::vector<std::uint8_t> reached(static_cast<std::size_t>(mesh.triangles.cols()), 0);
  std::vector<Eigen::Index> inside;
  const auto reach = [&](std::int32_t t) {
    if (t >= 0 && std::exchange(reached[static_cast<std::size_t>(t)], std::uint8_t{1}) == 0)
      inside.push_back(t);
  };
  const auto edge = [&](Eigen::Index t, int i, bool forwards) {
    const std::int32_t from = mesh.triangles(next_vertex(i), t),
                       to = mesh.triangles(previous_vertex(i), t);
    return forwards ? key(from, to) : key(to, from);
  };
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (rim.contains(edge(t, i, true)))
        reach(t);
  for (std::size_t k = 0; k < inside.size(); ++k)
    for (int i = 0; i < 3; ++i)
      if (!rim.contains(edge(inside[k], i, true)) && !rim.contains(edge(inside[k], i, false)))
        reach(mesh.neighbours(i, inside[k]));
  mesh.triangles = Triangles(mesh.triangles(Eigen::all, inside));
  mesh.neighbours.resize(3, 0);
  return mesh;
}

} // namespace

Replacement replacement_of(const Mesh& mesh, const PatchRegion& patch, const DoubleVector& own,
                           const DoubleVector& wanted, const FineWidths* fine,
                           const RefineOptions& options) {
  const LocalSites sites = in_space_of(
      mesh.surface, [&](const Space auto& space) { return local_sites(mesh, space, patch); });
  const Mesh local = local_mesh(mesh, patch, sites);
  const DoubleVector width = at_sites(wanted, sites);
  const Density density = density_of(local, width, fine, options.tolerance);
  const std::int64_t fixed = std::ssize(patch.fixed);
  const Surface surface = surface_of(mesh, patch, sites);
  const Schedule schedule =
      schedule_of(surface, density, count_of(patch, own, wanted), fixed,
                  with_midpoints(local, surface, fixed, density, width.minCoeff()));
  RunOptions run;
  run.partition = options.partition;
  run.progress = options.progress;
  Cvt grid = make_grid(schedule, std::move(run));
  const std::int64_t added = grid.mesh.points.cols() - fixed;
  const Points3 places = grid.mesh.points.rightCols(added);
  Replacement out;
  out.width_ratio = width_ratio(local, at_sites(own, sites), density, width.minCoeff(), places);
  out.change = {std::ssize(patch.free), added, std::move(grid.report)};
  out.mesh = patch.rings.empty()
                 ? std::move(grid.mesh)
                 : mesh_within(std::move(grid.mesh.points), patch, sites, local.surface);
  return out;
}

} // namespace calotte::grids_detail
