// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/worlds.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/split_mix.h"
#include "curve/hilbert.h"
#include "curve/radix_sort.h"
#include "cvt/cvt.h"
#include "cvt/insertion.h"
#include "cvt/planar_cells.h"
#include "delaunay/delaunay.h"
#include "delaunay/sites.h"
#include "density/planar_density.h"
#include "domain/arcs.h"
#include "domain/periodic_box.h"
#include "domain/planar_domain.h"
#include "mesh/canonical_order.h"
#include "mesh/planar_mesh.h"
#include "mesh/subdivide.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

namespace calotte::cvt_detail {
namespace {

/// The same for equal directions, which have the same bits on the cube.
std::uint64_t hash_of(const Vec3& direction) {
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
      keys[i] = hash_of(at(i));
  });
  const curve_detail::Order order = curve_detail::order_by_key(std::move(keys));
  for (std::int64_t i = 1; i < n; ++i)
    for (std::int64_t k = i; k > 0 && order.keys[k - 1] == order.keys[i]; --k)
      if (exact_detail::same_direction(at(order.items[k - 1]), at(order.items[i])))
        return true;
  return false;
}

/// The sites by rank alone, as the state has them.
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

/// \param sites of places, by id as the domain has them.
void set_places(State& state, const Sites& sites) {
  Array<Vec3> points(sites.size());
  for (std::int64_t r = 0; r < sites.size(); ++r)
    points[r] = sites.given(sites.id[r]);
  set_points(state, sites, points);
}

/// A run on the sphere from its distinct generators.
Begun begun_at(Sites&& sites, const CvtOptions& options) {
  if (sites.size() < 12)
    throw Error(ErrorCode::too_few_sites, "there are " + std::to_string(sites.size()) +
                                              " distinct generators: give at least 12");
  require_fixed(sites, options.fixed);
  State state;
  state.fixed = options.fixed;
  set_points(state, sites, sites.unit);
  state.site_of_input = std::move(sites.site_of_input);
  state.bisections_left = options.bisections;
  sites.points = state.points;
  return {std::move(state), {by_rank(std::move(sites)), std::nullopt}};
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

} // namespace

Sites distinct_units(Sites&& sites, const CvtOptions& options) {
  const auto unit = [&](std::int64_t rank) {
    const std::int32_t id = sites.id[rank];
    return id < options.fixed ? as_unit(sites.given(id)) : sites.unit[rank];
  };
  if (!have_equal(sites.size(), unit))
    return std::move(sites);
  Points3 units(3, sites.size());
  for (std::int64_t r = 0; r < sites.size(); ++r)
    set_column(units, sites.id[r], unit(r));
  std::vector<std::int32_t> before = std::move(sites.site_of_input);
  Sites merged = make_sites(std::move(units), options.duplicates, options.merge_within);
  for (std::int32_t& site : before)
    site = merged.site_of_input[static_cast<std::size_t>(site)];
  merged.site_of_input = std::move(before);
  // Once more normalised, others of them might be equal.
  for (std::int64_t r = 0; r < merged.size(); ++r)
    merged.unit[r] = merged.given(merged.id[r]);
  merged.boxes = delaunay_detail::SiteBoxes(merged.unit);
  return merged;
}

void require_fixed(const Sites& sites, std::int64_t fixed) {
  const std::vector<std::int32_t>& site_of_input = sites.site_of_input;
  if (fixed < 0 || fixed > std::ssize(site_of_input))
    throw Error(ErrorCode::invalid_argument, "fixed is " + std::to_string(fixed) + "; give 0 to " +
                                                 std::to_string(site_of_input.size()) +
                                                 ", the number of generators of the start");
  for (std::int64_t i = 0; i < fixed; ++i)
    if (const std::int32_t site = site_of_input[static_cast<std::size_t>(i)]; site != i)
      throw Error(ErrorCode::duplicate,
                  "fixed generator " + std::to_string(i) + " merges with fixed generator " +
                      std::to_string(site) + ": give it once",
                  i);
}

void set_points(State& state, const Sites& sites, const Array<Vec3>& points) {
  const std::int64_t n = sites.size();
  state.points.resize(3, n);
  state.id.resize(static_cast<std::size_t>(n));
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r != end; ++r) {
      const bool fixed = sites.id[r] < state.fixed;
      set_column(state.points, r,
                 fixed && !sites.frame ? as_unit(sites.given(sites.id[r])) : points[r]);
      state.id[static_cast<std::size_t>(r)] = sites.id[r];
    }
  });
}

void refuse_state() {
  throw Error(
      ErrorCode::invalid_argument,
      "the state is not one that a run has left: its points must be unit vectors, or places "
      "in the domain, and its ids a permutation");
}

// ---- The sphere

Begun SphericalWorld::begin(Points3&& start, const CvtOptions& options) {
  return begun_at(
      distinct_units(make_sites(std::move(start), options.duplicates, options.merge_within),
                     options),
      options);
}

Begun SphericalWorld::begin(const Points3Ref& start, const CvtOptions& options) {
  return begun_at(
      distinct_units(make_sites(start, options.duplicates, options.merge_within), options),
      options);
}

Density SphericalWorld::density(const Density& density) {
  evaluate(density, Points3(Eigen::Vector3d::UnitZ())); // throws if the density is ill-formed
  return density;
}

void SphericalWorld::require_points(const State& state) {
  if (state.points.cols() < 12 ||
      !((state.points.colwise().squaredNorm().array() - 1).abs() < 1e-12).all())
    refuse_state();
}

Mesh SphericalWorld::triangulated(Points3&& points) {
  return spherical_delaunay(std::move(points));
}

Mesh SphericalWorld::mesh(Points3&& points, Connectivity&& canonical) {
  std::vector<std::int32_t> sites = themselves(points.cols());
  return {std::move(points), std::move(canonical.triangles), std::move(canonical.neighbours),
          std::move(sites)};
}

Level SphericalWorld::set_bisected(State& state, const Mesh& coarse) {
  Sites sites = make_sites(bisect(coarse), Duplicates::refuse, 0);
  set_points(state, sites, sites.unit);
  Connectivity mesh =
      bisected_mesh(coarse.triangles, coarse.neighbours, coarse.points.cols(), sites);
  sites.points = {}; // with the mesh they have served
  return {by_rank(std::move(sites)), std::move(mesh)};
}

Level SphericalWorld::set_split_and_collapsed(State& state, const Mesh& mesh,
                                              const Density& density, const EdgeChanges& changes) {
  Sites sites = make_sites(split_and_collapsed(mesh, density, changes), Duplicates::refuse, 0);
  set_points(state, sites, sites.unit);
  if (have_equal(sites.size(), [&](std::int64_t rank) { return column(state.points, rank); }))
    return {}; // its tessellation refuses them
  sites.points = state.points;
  return {by_rank(std::move(sites)), std::nullopt};
}

// ---- The plane

PlanarWorld::PlanarWorld(const PlanarDomain& domain) : domain_(domain) { require_domain(domain); }

Begun PlanarWorld::begin(const Points2Ref& start, const CvtOptions& options) {
  Sites sites = make_planar_sites(start, options.duplicates, options.merge_within);
  require_triangle(sites);
  require_fixed(sites, options.fixed);
  State state;
  state.fixed = options.fixed;
  set_places(state, sites);
  state.site_of_input = std::move(sites.site_of_input);
  state.bisections_left = options.bisections;
  return {std::move(state), {}};
}

Density PlanarWorld::density(const Density& density) const {
  const Density planar = planar_density(density, domain_);
  const Eigen::Vector2d some =
      domain_.periodic() ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(domain_.rings[0].col(0));
  evaluate(planar, Points3(Eigen::Vector3d(some.x(), some.y(), 0)));
  return planar;
}

void PlanarWorld::require_points(const State& state) const {
  if (!state.points.allFinite() || !state.points.row(2).isZero(0) || !all_inside(state.points))
    refuse_state();
}

PlanarMesh PlanarWorld::triangulated(const Points3& points) const {
  const Points2 places = in_domain(points);
  return domain_.periodic() ? periodic_delaunay(places, domain_.period) : planar_delaunay(places);
}

PlanarMesh PlanarWorld::mesh(const Points3& points, Connectivity&& canonical) const {
  return {in_domain(points), std::move(canonical.triangles), std::move(canonical.neighbours),
          themselves(points.cols()), domain_.period};
}

Level PlanarWorld::set_bisected(State& state, const PlanarMesh& coarse) const {
  const Mesh whole = mesh_detail::spatial(PlanarMesh(coarse), domain_);
  const Sites sites = make_planar_sites(bisect(whole).topRows<2>(), Duplicates::refuse, 0);
  set_places(state, sites);
  if (!domain_.periodic()) // a part of the midpoints
    return {};
  return {std::nullopt,
          bisected_mesh(coarse.triangles, coarse.neighbours, coarse.points.cols(), sites)};
}

Level PlanarWorld::set_split_and_collapsed(State& state, const PlanarMesh& mesh,
                                           const Density& density,
                                           const EdgeChanges& changes) const {
  set_places(state, make_planar_sites(split_and_collapsed(mesh, domain_, density, changes),
                                      Duplicates::refuse, 0));
  return {};
}

bool PlanarWorld::all_inside(const Points3& points) const {
  try {
    if (!domain_.periodic())
      require_inside(points.topRows<2>(), domain_);
  } catch (const Error&) {
    return false;
  }
  return true;
}

Points2 PlanarWorld::in_domain(const Points3& points) const {
  Points2 places = points.topRows<2>();
  for (Eigen::Index i = 0; domain_.periodic() && i < places.cols(); ++i)
    for (int k = 0; k < 2; ++k)
      places(k, i) = wrapped(places(k, i), domain_.period[k]);
  return places;
}

} // namespace calotte::cvt_detail
