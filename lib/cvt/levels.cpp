// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/levels.h"

#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/split_mix.h"
#include "curve/hilbert.h"
#include "curve/radix_sort.h"
#include "cvt/cells.h"
#include "cvt/darts.h"
#include "cvt/inner_mesh.h"
#include "cvt/stages.h"
#include "delaunay/sites.h"
#include "density/demanded_spacing.h"
#include "density/hexagons.h"
#include "domain/arcs.h"
#include "domain/near_boundary.h"
#include "domain/surface.h"
#include "exact/space.h"
#include "mesh/canonical_order.h"
#include "mesh/edges.h"
#include "mesh/subdivide.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {
namespace {

// ---- Distinct generators

/// A hash of a direction's bits on the cube, which are the same for equal directions.
std::uint64_t hash_direction(const Vec3& direction) {
  const curve_detail::CubePoint on_cube = curve_detail::to_cube(direction);
  auto hash = static_cast<std::uint64_t>(on_cube.face);
  for (const double x : {on_cube.u, on_cube.v})
    hash = hash_with(hash, std::bit_cast<std::uint64_t>(x + 0.0)); // -0 as 0
  return hash >> (64 - curve_detail::key_bits);
}

/// Whether two of n directions are equal. Equal ones need not follow each other along a curve.
template <class At> bool have_equal(std::int64_t n, const At& at) {
  Array<std::uint64_t> keys(n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      keys[i] = hash_direction(at(i));
  });
  const curve_detail::Order order = curve_detail::order_by_key(std::move(keys));
  for (std::int64_t i = 1; i < n; ++i)
    for (std::int64_t k = i; k > 0 && order.keys[k - 1] == order.keys[i]; --k)
      if (exact_detail::same_direction(at(order.items[k - 1]), at(order.items[i])))
        return true;
  return false;
}

/// The sites of a start, which are distinct after normalisation: directions that differ by less
/// than rounding are duplicates, too. \throws Error as make_sites().
Sites distinct_units(Sites&& sites, const Recipe& recipe) {
  const auto unit = [&](std::int64_t rank) {
    const std::int32_t id = sites.id[rank];
    return id < recipe.fixed.cols() ? as_unit(sites.given(id)) : sites.unit[rank];
  };
  if (!have_equal(sites.size(), unit))
    return std::move(sites);
  Points3 units(3, sites.size());
  for (std::int64_t r = 0; r < sites.size(); ++r)
    set_column(units, sites.id[r], unit(r));
  std::vector<std::int32_t> before = std::move(sites.site_of_input);
  Sites merged = make_sites(std::move(units), recipe.duplicates, recipe.merge_within);
  for (std::int32_t& site : before)
    site = merged.site_of_input[static_cast<std::size_t>(site)];
  merged.site_of_input = std::move(before);
  // They are not normalised again: that might make others equal.
  for (std::int64_t r = 0; r < merged.size(); ++r)
    merged.unit[r] = merged.given(merged.id[r]);
  merged.boxes = delaunay_detail::SiteBoxes(merged.unit);
  return merged;
}

/// Refuses a start whose fixed generators merged, see begin().
void require_fixed(const Sites& sites, std::int64_t fixed) {
  const std::vector<std::int32_t>& site_of_input = sites.site_of_input;
  for (std::int64_t i = 0; i < fixed; ++i)
    if (const std::int32_t site = site_of_input[static_cast<std::size_t>(i)]; site != i)
      throw Error(
          ErrorCode::duplicate,
          message("fixed generator {} merges with fixed generator {}: give it once", i, site), i);
}

/// Cells of generators on one line exist, but a mesh of them does not.
void require_triangle(const Sites& sites) {
  const auto given = [&](std::int32_t id) { return Vec2{sites.given(id).x, sites.given(id).y}; };
  for (std::int32_t id = 2; id < sites.size(); ++id)
    if (orientation(given(0), given(1), given(id)) != 0)
      return;
  throw Error(ErrorCode::degenerate,
              "all generators lie on one line: add one off it, they span no triangle");
}

void require_enough(const Sites& sites, const Surface& surface) {
  const std::int64_t fewest = fewest_generators(surface);
  if (sites.size() < fewest)
    throw Error(
        ErrorCode::too_few_sites,
        message("there are {} distinct generators: give at least {}", sites.size(), fewest));
}

// ---- The state of sites

/// Sets the generators of a state, in the order of the sites. On the sphere, a fixed generator
/// keeps its given bits if it is a unit vector up to round-off.
void set_points(State& state, const Sites& sites) {
  const std::int64_t n = sites.size();
  state.points.resize(3, n);
  state.id.resize(static_cast<std::size_t>(n));
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r != end; ++r) {
      const std::int32_t id = sites.id[r];
      set_column(state.points, r,
                 sites.frame        ? sites.given(id)
                 : id < state.fixed ? as_unit(sites.given(id))
                                    : sites.unit[r]);
      state.id[static_cast<std::size_t>(r)] = id;
    }
  });
}

State make_start_state(Sites& sites, const Recipe& recipe) {
  require_fixed(sites, recipe.fixed.cols());
  State state;
  state.fixed = recipe.fixed.cols();
  set_points(state, sites);
  state.site_of_input = std::move(sites.site_of_input);
  return state;
}

/// The sites with their ranks as ids, the numbering of the state.
Sites by_rank(Sites&& sites) {
  sites.site_of_input = {};
  std::iota(sites.id.begin(), sites.id.end(), 0);
  return std::move(sites);
}

/// A bisection's triangles, renamed from ids to ranks.
Connectivity bisected_mesh(const Triangles& triangles, const Triangles& neighbours,
                           std::int64_t points, const Sites& sites) {
  Connectivity mesh = subdivided(triangles, neighbours, points);
  std::vector<std::int32_t> rank(static_cast<std::size_t>(sites.size()));
  for_each_block(sites.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r != end; ++r)
      rank[static_cast<std::size_t>(sites.id[r])] = static_cast<std::int32_t>(r);
  });
  make_canonical(mesh.triangles, mesh.neighbours, rank);
  return mesh;
}

/// Begins a run on the whole sphere. The first level uses the sorted sites.
Begun begun_at(Sites&& sites, const Recipe& recipe) {
  require_enough(sites, Surface::sphere());
  State state = make_start_state(sites, recipe);
  sites.points = state.points;
  return {std::move(state), {by_rank(std::move(sites)), std::nullopt}};
}

Sites make_distinct_sites(const Points3& points, const Surface& surface) {
  return surface.is_sphere() ? make_sites(points, Duplicates::refuse, 0)
                             : make_planar_sites(points.topRows<2>(), Duplicates::refuse, 0);
}

/// The points of a mesh of a bounded surface, then the midpoints that a bisection adds.
template <Space S>
Points3 bisected_inside(const State& state, const Mesh& coarse, const OutlineOf<S>& outline,
                        const DemandedSpacing& spacing) {
  std::vector<Vec3> inside;
  mesh_detail::for_each_edge(coarse, [&](std::int32_t a, std::int32_t b) {
    const Vec3 &from = column(coarse.points, a), &to = column(coarse.points, b);
    const Vec3 middle = S{}.midpoint(from, to);
    if (std::max(a, b) < state.fixed && is_full_gap(&outline, spacing, S{}, from, to))
      return;
    if (side_of<S>(&outline, middle) == Side::inside)
      inside.push_back(middle);
  });
  Points3 points(3, coarse.points.cols() + std::ssize(inside));
  points.leftCols(coarse.points.cols()) = coarse.points;
  for (std::size_t k = 0; k < inside.size(); ++k)
    set_column(points, coarse.points.cols() + static_cast<Eigen::Index>(k), inside[k]);
  return points;
}

/// The widths of cells of the zone along a boundary, where a bisection leaves too many points or
/// too few: generators of the boundary are as dense at all levels, and a cell of a coarse level
/// that a strait divides reaches into the seas on both sides, so that one of them lacks its points.
constexpr double zone = 4, beside_zone = 5.5;

/// Candidates in the zone: random points in triangles of a coarse mesh, in any order.
/// \param width_at the width of cells at a point.
template <Space S, class Width>
Candidates candidates_in_zone(const Mesh& coarse, const OutlineOf<S>& outline,
                              const Width& width_at) {
  constexpr double for_each_cell = 20;
  std::vector<std::vector<Vec3>> found(static_cast<std::size_t>(coarse.triangles.cols()));
  for_each_block(coarse.triangles.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t) {
      const auto corner = [&](int v) { return column(coarse.points, coarse.triangles(v, t)); };
      const Vec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
      const Vec3 middle = a + (1.0 / 3) * (ab + ac);
      const double width = width_at(middle), size = std::sqrt(std::max(dot(ab, ab), dot(ac, ac)));
      if (!is_near_boundary(coarse.surface, middle, zone * width + size))
        continue;
      const double cells = norm(cross(ab, ac)) / 2 / hexagon_area(width);
      SplitMix random(static_cast<std::uint64_t>(t));
      for (auto left = std::ceil(for_each_cell * std::min(cells, 1e3)); left > 0; --left) {
        double u = random.unit(), v = random.unit();
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        Vec3 x = a + u * ab + v * ac;
        if constexpr (S::on_sphere)
          x = normalised(x);
        if (is_near_boundary(coarse.surface, x, zone * width_at(x)) &&
            side_of<S>(&outline, x) == Side::inside)
          found[static_cast<std::size_t>(t)].push_back(x);
      }
    }
  });
  std::vector<Vec3> all;
  for (const std::vector<Vec3>& some : found)
    all.insert(all.end(), some.begin(), some.end());
  std::vector<std::uint64_t> draw(all.size()), keys(all.size());
  std::iota(keys.begin(), keys.end(), 0);
  std::sort(keys.begin(), keys.end(), [](std::uint64_t i, std::uint64_t j) {
    return std::pair(hash_with(1, i), i) < std::pair(hash_with(1, j), j);
  });
  const auto n = std::ssize(all);
  Candidates out{Points3(3, n), DoubleVector(n), std::move(keys)};
  for (std::int64_t i = 0; i < n; ++i) {
    const Vec3& x = all[out.keys[static_cast<std::size_t>(i)]];
    set_column(out.points, i, x);
    out.width[i] = width_at(x);
  }
  return out;
}

/// The points of a bisection outside the zone along the boundary, and others in it.
/// \param points after a bisection, the fixed ones first.
template <Space S>
Points3 thrown_along_boundary(const State& state, const Mesh& coarse, const OutlineOf<S>& outline,
                              const Points3& points, const DemandedSpacing& spacing,
                              std::int64_t cells) {
  const auto width_at = [&](const Vec3& x) {
    const double h = spacing.at(x);
    return hexagon_width(h * h);
  };
  const Candidates candidates = candidates_in_zone<S>(coarse, outline, width_at);
  Darts darts(candidates, coarse.surface);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3 x = S::on_sphere ? normalised(column(points, i)) : Vec3(column(points, i));
    const double width = width_at(x);
    if (i >= state.fixed && is_near_boundary(coarse.surface, x, zone * width))
      continue;
    kept.push_back(i);
    if (i < state.fixed || is_near_boundary(coarse.surface, x, beside_zone * width))
      darts.put(x, width);
  }
  const std::vector<std::int64_t> thrown =
      darts.take(std::max<std::int64_t>(cells - std::ssize(kept), 0));
  if (!state.slides() && std::ssize(kept) + std::ssize(thrown) < cells)
    return points; // too few candidates, as in a strip as wide as a coarse cell
  Points3 out(3, std::ssize(kept) + std::ssize(thrown));
  out.leftCols(std::ssize(kept)) = points(Eigen::all, kept);
  out.rightCols(std::ssize(thrown)) = candidates.points(Eigen::all, thrown);
  return out;
}

Points3 bisected_points(const State& state, const Mesh& coarse, const Density& density,
                        std::int64_t cells) {
  if (!coarse.surface.is_bounded())
    return bisect(coarse);
  return in_space_of(coarse.surface, [&](const auto& space) {
    using S = std::decay_t<decltype(space)>;
    const OutlineOf<S>& outline = *outline_of<S>(coarse.surface);
    const DemandedSpacing of_all(coarse.surface, density, static_cast<double>(cells));
    Points3 points = bisected_inside<S>(state, coarse, outline, of_all);
    if (!state.slides() && !has(state, CvtAction::Kind::insert))
      return points; // as many as bisections make
    const double halves =
        std::ldexp(static_cast<double>(state.on_boundary()), -bisections_left(state)) / 2;
    const DemandedSpacing of_whole(coarse.surface, density,
                                   static_cast<double>(cells - state.on_boundary()) + halves);
    return thrown_along_boundary<S>(state, coarse, outline, points, of_whole, cells);
  });
}

/// The generators inside a periodic box.
Points3 wrapped(Points3&& points, const Surface& surface) {
  if (!surface.period().isZero(0)) {
    const Plane plane(surface.period());
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      set_column(points, i, plane.wrapped(column(points, i)));
  }
  return std::move(points);
}

/// The mesh of generators in a bounded part of the sphere. They are triangulated with the hull;
/// only the triangles between generators are kept.
Mesh mesh_in_region(Points3&& points, const Surface& surface) {
  Cells<Sphere> cells(surface);
  cells.move(points);
  return without_hull(std::move(points), cells.triangulate().triangles, surface);
}

} // namespace

std::int64_t fewest_generators(const Surface& surface) {
  return !surface.is_sphere() ? 3 : surface.is_bounded() ? 4 : 12;
}

std::int64_t bisected(const Surface& surface, std::int64_t n, int bisections) {
  for (int k = 0; k < bisections; ++k)
    n = surface.is_whole_sphere() ? 4 * n - 6 : 4 * n;
  return n;
}

std::int64_t halved(const Surface& surface, std::int64_t n) {
  return surface.is_whole_sphere() ? (n + 8) / 4 : (n + 2) / 4;
}

std::int64_t generators_of_level(const Surface& surface, std::int64_t n, int bisections,
                                 std::int64_t on_boundary) {
  if (on_boundary == 0) {
    for (; bisections > 0; --bisections)
      n = halved(surface, n);
    return n;
  }
  const auto edges = static_cast<double>(on_boundary);
  const double whole = static_cast<double>(n) - edges / 2, scale = std::ldexp(1, -bisections);
  return on_boundary + std::llround(scale * scale * whole - scale * edges / 2);
}

Begun begin(Points3&& start, const Recipe& recipe) {
  const Surface& surface = recipe.surface;
  if (!surface.is_sphere()) {
    const Points2Ref points = base_detail::plane_points_of(start);
    require_inside(base_detail::with_z(points), surface);
    Sites sites = make_planar_sites(points, recipe.duplicates, recipe.merge_within);
    require_triangle(sites);
    return {make_start_state(sites, recipe), {}};
  }
  const auto sites_of_start = [&](auto&& points) {
    return distinct_units(
        make_sites(std::forward<decltype(points)>(points), recipe.duplicates, recipe.merge_within),
        recipe);
  };
  if (!surface.is_bounded())
    return begun_at(sites_of_start(std::move(start)), recipe);
  Sites sites = sites_of_start(start);
  require_inside(start, surface, recipe.fixed.cols());
  require_enough(sites, surface);
  return {make_start_state(sites, recipe), {}};
}

void refuse_state() {
  throw Error(
      ErrorCode::invalid_argument,
      "the state is not one that a run has left: its points must be unit vectors, or points "
      "of the domain, and its ids a permutation");
}

void require_points(const State& state, const Surface& surface) {
  const Points3& points = state.points;
  if (points.cols() < fewest_generators(surface))
    throw Error(ErrorCode::invalid_argument,
                message("the state has {} generators, and a run on the surface has at least {}; "
                        "give the surface of the run that left it",
                        points.cols(), fewest_generators(surface)));
  const auto good = [&] {
    if (!points.allFinite())
      return false;
    return surface.is_sphere() ? ((points.colwise().squaredNorm().array() - 1).abs() < 1e-12).all()
                               : points.row(2).isZero(0);
  };
  if (!good())
    refuse_state();
  try {
    if (surface.is_bounded())
      require_inside(points, surface);
    else // they may leave a periodic box
      in_space_of(surface,
                  [&](const Space auto& space) { require_positions(space, points, "generator"); });
  } catch (const Error&) {
    refuse_state();
  }
}

Mesh mesh_of_run(const State& state, const Surface& surface,
                 std::optional<Connectivity>&& connectivity) {
  Points3 points = wrapped(in_order(state), surface);
  if (surface.is_sphere() && surface.is_bounded())
    return mesh_in_region(std::move(points), surface);
  if (!connectivity)
    return delaunay(std::move(points), surface);
  make_canonical(connectivity->triangles, connectivity->neighbours, state.id);
  std::vector<std::int32_t> sites = themselves(points.cols());
  return {std::move(points), std::move(connectivity->triangles),
          std::move(connectivity->neighbours), std::move(sites), surface};
}

Level set_bisected(State& state, const Mesh& coarse, const Density& density, std::int64_t cells) {
  Sites sites = make_distinct_sites(bisected_points(state, coarse, density, cells), coarse.surface);
  set_points(state, sites);
  if (coarse.surface.is_bounded()) // a part of the midpoints
    return {};
  Connectivity mesh =
      bisected_mesh(coarse.triangles, coarse.neighbours, coarse.points.cols(), sites);
  if (!coarse.surface.is_sphere())
    return {std::nullopt, std::move(mesh)};
  sites.points = {}; // with the mesh they have served
  return {by_rank(std::move(sites)), std::move(mesh)};
}

Level set_split_and_collapsed(State& state, const Mesh& mesh, const Density& density,
                              const EdgeChanges& changes) {
  Sites sites = make_distinct_sites(split_and_collapsed(mesh, density, changes), mesh.surface);
  set_points(state, sites);
  if (!mesh.surface.is_whole_sphere() ||
      have_equal(sites.size(), [&](std::int64_t rank) { return column(state.points, rank); }))
    return {}; // the tessellation of equal ones refuses them
  sites.points = state.points;
  return {by_rank(std::move(sites)), std::nullopt};
}

} // namespace calotte::cvt_detail
