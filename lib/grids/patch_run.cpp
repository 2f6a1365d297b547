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
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

namespace calotte::grids_detail {
namespace {

using base_detail::require;
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

/// The number of sites of the new patch.
std::int64_t choose_count(const PatchRegion& patch, const DoubleVector& own,
                          const DoubleVector& wanted) {
  double sum = 0;
  for (const std::int32_t site : patch.free_sites()) {
    const double ratio = own[site] / wanted[site];
    sum += ratio * ratio;
  }
  return patch.fixed + std::max<std::int64_t>(std::llround(sum), 1);
}

/// The sites, with midpoints of edges that are too long, added repeatedly; none between fixed
/// sites. Midpoints keep the directions of the rows of cells, so that few dislocations are needed
/// beside the patch.
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

/// The schedule of a patch's run from given points.
Schedule make_schedule(const Surface& surface, const Density& density, std::int64_t cells,
                       std::int64_t fixed, const Points3& points) {
  constexpr double tolerance = 1e-4;
  constexpr int rounds = 3;
  Schedule schedule;
  Recipe& recipe = schedule.recipe;
  schedule.density = density;
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
  schedule.actions = actions_of(recipe, {.kind = recipe.start.kind, .cells = points.cols()});
  return schedule;
}

/// The Delaunay triangles of a patch's sites within its rings: those reached from the left of the
/// rings without crossing them. The fixed sites come first. Where rings are straight up to
/// rounding, a triangle's centre would not decide.
Mesh mesh_within(Points3&& points, const Submesh& part, const Surface& surface) {
  const auto key = [](std::int32_t from, std::int32_t to) {
    return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
  };
  std::unordered_set<std::uint64_t> rim;
  for (const Submesh::RimEdge& edge : part.rim)
    rim.insert(key(edge.from, edge.to));
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

Replacement make_replacement(const Mesh& mesh, const PatchRegion& patch, const DoubleVector& own,
                             const DoubleVector& wanted, const FineWidths* fine,
                             const RefineOptions& options) {
  const Mesh local = local_mesh(mesh, patch.part);
  const DoubleVector width = wanted(patch.part.sites);
  const Density density = make_density(local, width, fine, options.tolerance);
  const std::int64_t fixed = patch.fixed;
  const Surface surface = make_surface(mesh, patch, local);
  const Schedule schedule =
      make_schedule(surface, density, choose_count(patch, own, wanted), fixed,
                    with_midpoints(local, surface, fixed, density, width.minCoeff()));
  RunOptions run;
  run.decomposition = options.decomposition;
  run.progress = options.progress;
  Cvt grid = make_grid(schedule, std::move(run));
  const std::int64_t added = grid.mesh.points.cols() - fixed;
  const Points3 positions = grid.mesh.points.rightCols(added);
  Replacement out;
  out.width_ratio = width_ratio(local, own(patch.part.sites), density, width.minCoeff(), positions);
  out.change = {std::ssize(patch.free_sites()), added, std::move(grid.report)};
  out.mesh = patch.rings.empty()
                 ? std::move(grid.mesh)
                 : mesh_within(std::move(grid.mesh.points), patch.part, local.surface);
  return out;
}

} // namespace calotte::grids_detail
