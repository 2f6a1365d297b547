// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/multimesh.h>

#include "base/points.h"
#include "base/require.h"
#include "cvt/levels.h"
#include "cvt/repair.h"
#include "exact/space.h"
#include "generators/boundary.h"
#include "grids/schedule.h"
#include "mesh/edges.h"

#include <calotte/delaunay.h>
#include <calotte/locate.h>
#include <calotte/widths.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

namespace calotte {
namespace grids_detail {
namespace {

using base_detail::require;
using generators_detail::BoundaryPoints;

constexpr int most_levels = 13;

void require_level(int finest) {
  require(finest >= 0 && finest <= most_levels, "the finest level is {}; give 0 to {}", finest,
          most_levels);
}

/// Refuses, before any work, more nodes than a mesh has ids for.
void require_room(const Surface& surface, std::int64_t coarsest, int finest) {
  std::int64_t n = coarsest;
  for (int level = 0; level < finest && n <= most_points; ++level)
    n = cvt_detail::bisected(surface, n);
  require(n <= most_points, "{} bisections of {} nodes give more than {}; give fewer", finest,
          coarsest, most_points);
}

/// \param ends the lower first.
Pairs sorted_pairs(std::vector<cvt_detail::Ends>&& ends) {
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  Pairs out(2, std::ssize(ends));
  for (std::size_t k = 0; k < ends.size(); ++k)
    out.col(static_cast<Eigen::Index>(k)) << ends[k].first, ends[k].second;
  return out;
}

Pairs edges_of(const Mesh& mesh) {
  std::vector<cvt_detail::Ends> ends;
  mesh_detail::for_each_edge(mesh, [&](std::int32_t a, std::int32_t b) {
    ends.push_back(std::minmax({a, b}));
  });
  return sorted_pairs(std::move(ends));
}

void add_level(Multimesh& out, Mesh&& mesh) {
  out.edges.push_back(edges_of(mesh));
  out.meshes.push_back(std::move(mesh));
}

/// Appends the parents of a level's own nodes.
void add_parents(Multimesh& out, const Pairs& parents) {
  const Eigen::Index before = out.parents.cols();
  out.parents.conservativeResize(2, before + parents.cols());
  out.parents.rightCols(parents.cols()) = parents;
}

/// The ends of the edges whose midpoints bisect() adds.
Pairs ends_of_midpoints(const Mesh& mesh, std::int64_t midpoints) {
  Pairs out(2, midpoints);
  Eigen::Index k = 0;
  mesh_detail::for_each_edge(mesh, [&](std::int32_t a, std::int32_t b) {
    out.col(k++) << std::min(a, b), std::max(a, b);
  });
  return out;
}

/// The two nodes of a mesh nearest to each of some positions.
Pairs nearest_two(const Mesh& mesh, const Points3& positions) {
  const IdLists lists = Locator(mesh).nearest_few(positions, 2);
  return Eigen::Map<const Pairs>(lists.items.data(), 2, positions.cols());
}

Pairs no_parents(std::int64_t nodes) { return Pairs::Constant(2, nodes, -1); }

// ---- Levels that follow a density

void require_recipe(const Recipe& recipe, std::int64_t coarsest) {
  require(!recipe.limited_area && !recipe.walls.x && !recipe.walls.y && recipe.lines.empty(),
          "a multimesh has no rings of a limited area, walls or lines; leave them out");
  require(recipe.start.points.cols() == 0,
          "a multimesh of widths or a density starts without points; leave them out");
  require(coarsest == 0 || recipe.cells == 0,
          "there are {} nodes of the coarsest level and {} of the finest; give one of them",
          coarsest, recipe.cells);
}

/// What determines the numbers of nodes.
struct Demanded {
  Density density;
  double nodes = 0; ///< of the finest level; by widths those that have whole cells
};

Demanded demanded_of(const Recipe& recipe) {
  const auto given = static_cast<double>(recipe.cells);
  const auto* const widths = std::get_if<Widths>(&recipe.resolution);
  require(widths != nullptr || given != 0,
          "there is no number of nodes; give that of the coarsest or the finest level, or cell "
          "widths");
  if (widths == nullptr)
    return {std::get<Density>(recipe.resolution), given};
  const WidthField field = width_field(widths->on_sphere(recipe.radius_km), recipe.surface);
  return {density_of(field),
          given != 0 ? given : implied_cells(field, recipe.surface, recipe.radius_km)};
}

std::int64_t in_range(double nodes, const Recipe& recipe, int finest) {
  const std::int64_t fewest = cvt_detail::fewest_generators(recipe.surface);
  const double n = std::round(nodes);
  require(n >= static_cast<double>(fewest) && n <= double(most_points),
          "the finest level's nodes leave {} at the coarsest of {} bisections, which has {} to {}; "
          "give another number of levels or of nodes",
          n, finest, fewest, most_points);
  return static_cast<std::int64_t>(n);
}

/// The number of nodes of level 0, from which bisections lead to about that of the finest.
std::int64_t choose_coarsest(const Recipe& recipe, int finest) {
  const Surface& surface = recipe.surface;
  const auto [density, given] = demanded_of(recipe);
  const double parts = std::ldexp(1, 2 * finest);
  if (!surface.is_bounded()) {
    const double poles = surface.is_sphere() ? 2 : 0;
    return in_range((given - poles) / parts + poles, recipe, finest);
  }
  // b generators on the boundary of level 0 are b 2^k on level k, and each has half a cell.
  std::int64_t n = in_range(std::max(given / parts, 4.0), recipe, finest), on_boundary = 0;
  for (int pass = 0; pass < 3; ++pass) {
    on_boundary = generators_detail::all_boundary_points(surface, n, density).points.cols();
    const double half = static_cast<double>(on_boundary) / 2,
                 inside = recipe.cells == 0 ? given : given - std::ldexp(half, finest);
    n = in_range(inside / parts + half, recipe, finest);
  }
  require(n > on_boundary,
          "the finest level's nodes leave {} at the coarsest of {} bisections, and its boundary "
          "takes {}; give fewer levels or more nodes",
          n, finest, on_boundary);
  return n;
}

constexpr double tolerance = 1e-4; // below it ratios of areas to the demanded ones hardly change

/// Of insertion and contraction on each level but the first. A coarse level that does not resolve
/// the density has its nodes where bisections alone leave too many or too few.
constexpr int rounds = 6;

/// The schedule of level 0. A polish would move nodes on the boundary.
Schedule schedule_of_coarsest(const Recipe& given, std::int64_t cells) {
  Recipe recipe = given;
  recipe.cells = cells;
  recipe.boundary = Boundary::clip;
  recipe.stop.tolerance = given.stop.tolerance.value_or(tolerance);
  if (recipe.surface.is_bounded()) {
    recipe.boundary = Boundary::generators;
    recipe.stop.well_centred = false;
  }
  return plan(std::move(recipe));
}

/// The midpoints of a mesh's edges, without those of its outer ones and those outside.
Points3 inner_midpoints(const Mesh& mesh) {
  std::vector<Vec3> all;
  in_space_of(mesh.surface, [&](const Space auto& space) {
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
      for (int i = 0; i < 3; ++i)
        if (mesh.neighbours(i, t) > t)
          all.push_back(space.midpoint(column(mesh.points, mesh.triangles((i + 1) % 3, t)),
                                       column(mesh.points, mesh.triangles((i + 2) % 3, t))));
  });
  Points3 points(3, std::ssize(all));
  for (std::size_t k = 0; k < all.size(); ++k)
    base_detail::set_column(points, static_cast<std::int64_t>(k), all[k]);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    if (mesh.surface.contains(points.col(k)))
      inside.push_back(k);
  return points(Eigen::all, inside);
}

/// The nodes along the boundary of a bounded surface.
struct BoundaryNodes {
  std::vector<BoundaryPoints> levels; ///< see halved_boundary_points()
  std::vector<std::int32_t> nodes;    ///< the ids of those that are in the mesh

  /// Those of a level that are not among the nodes yet.
  Points3 further(int level) const {
    const Points3& points = levels[static_cast<std::size_t>(level)].points;
    return points.rightCols(points.cols() - std::ssize(nodes));
  }

  /// Gives those of a level ids from `first` on, and returns Schedule::next_on_boundary.
  std::vector<std::int32_t> add(int level, std::int64_t first) {
    const std::vector<std::int32_t>& next = levels[static_cast<std::size_t>(level)].next;
    while (nodes.size() < next.size())
      nodes.push_back(static_cast<std::int32_t>(first++));
    std::vector<std::int32_t> out(static_cast<std::size_t>(first), -1);
    for (std::size_t k = 0; k < next.size(); ++k)
      out[static_cast<std::size_t>(nodes[k])] = nodes[static_cast<std::size_t>(next[k])];
    return out;
  }
};

/// The schedule of a level, in which the nodes of the level before stay.
Schedule schedule_of_level(const Schedule& first, const Mesh& coarse, BoundaryNodes& boundary,
                           int level) {
  Schedule schedule = first;
  Recipe& recipe = schedule.recipe;
  schedule.on_lines = schedule.line_ends = schedule.on_boundary = 0;
  recipe.start = {.kind = CvtStart::Kind::points, .insertion_rounds = rounds};
  recipe.stop.well_centred = false;
  const Eigen::Index n = coarse.points.cols();
  if (recipe.surface.is_bounded()) {
    const Points3 along = boundary.further(level);
    recipe.fixed.resize(3, n + along.cols());
    recipe.fixed << coarse.points, along;
    recipe.start.points = inner_midpoints(coarse);
    schedule.next_on_boundary = boundary.add(level, n);
    schedule.on_boundary = std::ssize(boundary.nodes);
  } else {
    const Points3 all = bisect(coarse);
    recipe.fixed = coarse.points;
    recipe.start.points = all.rightCols(all.cols() - n);
  }
  recipe.cells = recipe.fixed.cols() + recipe.start.points.cols();
  schedule.first = recipe.start.kind;
  schedule.actions =
      actions_of(recipe, {.kind = schedule.first, .cells = recipe.cells}, 0, schedule.on_boundary);
  return schedule;
}

} // namespace
} // namespace grids_detail

using namespace grids_detail;

Multimesh multimesh(int finest, const PointsRef& coarsest) {
  require_level(finest);
  require_room(Surface::sphere(), coarsest.cols(), finest);
  const DelaunayOptions options{.duplicates = Duplicates::refuse};
  Multimesh out;
  add_level(out, delaunay(coarsest, Surface::sphere(), options));
  require(out.meshes[0].closed(), "the coarsest nodes are within a hemisphere, so that their mesh "
                                  "is open; give nodes all round the sphere");
  add_parents(out, no_parents(coarsest.cols()));
  for (int level = 1; level <= finest; ++level) {
    Points3 points = bisect(out.meshes.back());
    add_parents(out, ends_of_midpoints(out.meshes.back(), points.cols() - out.points().cols()));
    add_level(out, delaunay(std::move(points), Surface::sphere(), options));
  }
  return out;
}

Multimesh multimesh(int finest, const Recipe& recipe, std::int64_t coarsest,
                    const RunOptions& options) {
  require_level(finest);
  require_recipe(recipe, coarsest);
  const std::int64_t cells = coarsest != 0 ? coarsest : choose_coarsest(recipe, finest);
  require_room(recipe.surface, cells, finest);
  Multimesh out;
  const auto run = [&](const Schedule& schedule) {
    Cvt grid =
        make_grid(schedule, {.decomposition = options.decomposition, .progress = options.progress});
    add_level(out, std::move(grid.mesh));
    out.reports.push_back(std::move(grid.report));
  };
  const Schedule first = schedule_of_coarsest(recipe, cells);
  BoundaryNodes boundary;
  if (recipe.surface.is_bounded()) {
    boundary.levels =
        generators_detail::halved_boundary_points(recipe.surface, cells, first.density, finest);
    boundary.add(0, first.recipe.fixed.cols() - first.on_boundary);
  }
  run(first);
  add_parents(out, no_parents(out.points().cols()));
  for (int level = 1; level <= finest; ++level) {
    const Schedule schedule = schedule_of_level(first, out.meshes.back(), boundary, level);
    run(schedule);
    const Mesh& coarse = out.meshes[out.meshes.size() - 2];
    add_parents(out, nearest_two(coarse, out.points().rightCols(out.points().cols() -
                                                                coarse.points.cols())));
  }
  return out;
}

Pairs all_edges(const Multimesh& multimesh) {
  std::vector<cvt_detail::Ends> ends;
  for (const Pairs& edges : multimesh.edges)
    for (const auto& edge : edges.colwise())
      ends.push_back({edge[0], edge[1]});
  return sorted_pairs(std::move(ends));
}

} // namespace calotte
