// SPDX-License-Identifier: GPL-3.0-or-later
#include "grids/free_points.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "delaunay/owners.h"
#include "delaunay/sites.h"
#include "density/hexagons.h"
#include "exact/predicates.h"

#include <calotte/cvt.h>
#include <calotte/generators.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace calotte::grids_detail {
namespace {

using delaunay_detail::owners;

/// Places that follow the density, and what is next to them.
template <class Points> struct Candidates {
  Points places;
  Array<std::int32_t> nearest; ///< fixed generator
  DoubleVector distance;       ///< from it, over the demanded distance of neighbours
};

/// The sphere, or a region of it.
struct SphericalSupply {
  const Points3& fixed;
  const Region& region;
  const Density& sites;

  Points3 draw(std::int64_t n, std::uint64_t seed) const {
    return random_sphere(n, region, sites, seed);
  }
  DoubleVector density(const Points3& places) const { return evaluate(sites, places); }
  double area() const { return calotte::area(region); }
  Sites sorted(const Points3& places) const {
    return delaunay_detail::make_sites(places, Duplicates::merge, 0);
  }
  std::vector<Vec3> centres(const Sites&) const {
    std::vector<Vec3> units(static_cast<std::size_t>(fixed.cols()));
    for (std::size_t k = 0; k < units.size(); ++k)
      units[k] = normalised(column(fixed, static_cast<Eigen::Index>(k)));
    return units;
  }
};

/// A domain of the plane.
struct PlanarSupply {
  const Points2& fixed;
  const PlanarDomain& domain;
  const Density& sites;

  Points2 draw(std::int64_t n, std::uint64_t seed) const {
    return random_places(n, domain, sites, seed);
  }
  DoubleVector density(const Points2& places) const { return evaluate(sites, domain, places); }
  double area() const { return calotte::area(domain); }
  Sites sorted(const Points2& places) const {
    return delaunay_detail::make_planar_sites(places, Duplicates::merge, 0);
  }
  /// In the frame of sites: the fixed ones, then their copies in a periodic box.
  std::vector<Vec3> centres(const Sites& in) const {
    std::vector<Vec3> places;
    for (const int shift : {0, -1, 1})
      for (const int up : {0, -1, 1})
        if ((shift == 0 || domain.period.x() > 0) && (up == 0 || domain.period.y() > 0))
          for (const auto& p : fixed.colwise())
            places.push_back(
                (*in.frame)(p.x() + shift * domain.period.x(), p.y() + up * domain.period.y()));
    return places;
  }
};

/// The mean of 1/density over places that follow it is area / integral, whence the spacing.
template <class Supply>
auto candidates(const Supply& from, std::int64_t n, std::int64_t cells, std::uint64_t seed) {
  Candidates<decltype(from.draw(n, seed))> out{from.draw(n, seed), Array<std::int32_t>(n),
                                               DoubleVector(n)};
  const DoubleVector inverse = from.density(out.places).cwiseInverse();
  const double scale = from.area() / (inverse.mean() * static_cast<double>(cells));
  const Sites sites = from.sorted(out.places);
  const std::vector<Vec3> centres = from.centres(sites);
  const Array<std::int32_t> owner = owners(sites.cells, sites.unit, centres);
  const double unit = sites.frame ? sites.frame->half / sites.frame->scale : 1;
  Array<std::int64_t> rank(sites.size());
  for (std::int64_t r = 0; r < sites.size(); ++r)
    rank[sites.id[r]] = r;
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const std::int64_t r = rank[sites.site_of_input[static_cast<std::size_t>(i)]];
      const double apart = unit * norm(sites.unit[r] - centres[static_cast<std::size_t>(owner[r])]);
      out.nearest[i] = owner[r] % static_cast<std::int32_t>(from.fixed.cols());
      out.distance[i] = apart / density_detail::hexagon_width(scale * inverse[i]);
    }
  });
  return out;
}

/// Whether candidates are farther than some distance from the fixed generators, next to a gap. The
/// centres of hexagons are no farther than 0.577 of their distance from any place: beyond 0.65
/// there is a gap.
template <class Points>
std::vector<bool> have_room(const Candidates<Points>& in, std::int64_t fixed, double distance) {
  constexpr double gap = 0.65;
  std::vector<bool> next_to_gap(static_cast<std::size_t>(fixed), false);
  for (std::int64_t i = 0; i < in.nearest.size(); ++i)
    if (in.distance[i] > gap)
      next_to_gap[static_cast<std::size_t>(in.nearest[i])] = true;
  std::vector<bool> room(static_cast<std::size_t>(in.nearest.size()));
  for (std::size_t i = 0; i < room.size(); ++i) {
    const auto k = static_cast<std::int64_t>(i);
    room[i] = in.distance[k] > distance && next_to_gap[static_cast<std::size_t>(in.nearest[k])];
  }
  return room;
}

/// Candidates per cell tell the gaps, as far as memory allows.
std::int64_t candidates_for(std::int64_t cells) {
  constexpr std::int64_t most = 4'000'000, for_each_cell = 32;
  return std::max(cells, std::min(most, for_each_cell * cells));
}

/// Columns of candidates: those with room in the order of the draw, then the farthest others. In
/// the pockets between fixed generators none starts: it might be one too many there, which could
/// not leave. A descent moves others there if there is room.
template <class Points>
std::vector<std::int64_t> best(const Candidates<Points>& in, std::int64_t fixed,
                               std::int64_t count) {
  constexpr double beyond_pockets = 0.85;
  const std::vector<bool> room = have_room(in, fixed, beyond_pockets);
  std::vector<std::int64_t> order(room.size());
  std::iota(order.begin(), order.end(), 0);
  const auto others = std::stable_partition(order.begin(), order.end(), [&](std::int64_t i) {
    return room[static_cast<std::size_t>(i)];
  });
  if (others - order.begin() < count)
    std::stable_sort(others, order.end(), [&](std::int64_t i, std::int64_t j) {
      return in.distance[i] > in.distance[j];
    });
  order.resize(static_cast<std::size_t>(count));
  return order;
}

template <class Supply>
auto free_points_of(const Supply& from, std::int64_t count, std::int64_t cells,
                    std::uint64_t seed) {
  if (from.fixed.cols() == 0 || count == 0)
    return from.draw(count, seed);
  const auto in = candidates(from, candidates_for(cells), cells, seed);
  const std::vector<std::int64_t> chosen = best(in, from.fixed.cols(), count);
  return decltype(in.places)(in.places(Eigen::all, chosen));
}

template <class Supply> std::int64_t cells_beside_fixed(const Supply& from, std::int64_t cells) {
  constexpr double radius_of_hexagon = 0.525; // of a disc of its area
  base_detail::require_count(cells, 1, "the number of cells");
  if (from.fixed.cols() == 0)
    return cells;
  const auto in = candidates(from, candidates_for(cells), cells, 1);
  const std::vector<bool> room = have_room(in, from.fixed.cols(), radius_of_hexagon);
  const double share = static_cast<double>(std::count(room.begin(), room.end(), true)) /
                       static_cast<double>(room.size());
  return from.fixed.cols() + std::llround(share * static_cast<double>(cells));
}

} // namespace

Points3 free_points(std::int64_t count, std::int64_t cells, const Points3& fixed,
                    const Region& region, const Density& sites, std::uint64_t seed) {
  return free_points_of(SphericalSupply{fixed, region, sites}, count, cells, seed);
}

Points2 free_points(std::int64_t count, std::int64_t cells, const Points2& fixed,
                    const PlanarDomain& domain, const Density& sites, std::uint64_t seed) {
  return free_points_of(PlanarSupply{fixed, domain, sites}, count, cells, seed);
}

std::int64_t cells_beside_fixed(const Points3& fixed, std::int64_t cells, const Region& region,
                                const Density& sites) {
  return cells_beside_fixed(SphericalSupply{fixed, region, sites}, cells);
}

std::int64_t cells_beside_fixed(const Points2& fixed, std::int64_t cells,
                                const PlanarDomain& domain, const Density& sites) {
  return cells_beside_fixed(PlanarSupply{fixed, domain, sites}, cells);
}

} // namespace calotte::grids_detail
