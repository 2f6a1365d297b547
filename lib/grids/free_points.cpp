// SPDX-License-Identifier: GPL-3.0-or-later
#include "grids/free_points.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "cvt/darts.h"
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

/// Candidates that follow the density, and where they are among the fixed generators.
struct Placed {
  Candidates candidates;
  Array<std::int32_t> nearest; ///< fixed generator
  DoubleVector distance;       ///< from that generator, over the demanded distance of neighbours
  std::vector<double> fixed_width; ///< the demanded distance at each fixed generator
};

/// The input that depends on the surface.
struct Supply {
  const Points3& fixed;
  const Surface& surface;
  const Density& sites;

  Points3 draw(std::int64_t n, std::uint64_t seed) const {
    return random_points(n, surface, sites, seed);
  }
  Sites sorted(const Points3& points) const {
    return surface.is_sphere()
               ? delaunay_detail::make_sites(points, Duplicates::merge, 0)
               : delaunay_detail::make_planar_sites(points.topRows<2>(), Duplicates::merge, 0);
  }
  /// The fixed generators in the frame of sites, then their copies in a periodic plane.
  std::vector<Vec3> centres(const Sites& in) const {
    std::vector<Vec3> points;
    if (surface.is_sphere()) {
      for (Eigen::Index k = 0; k < fixed.cols(); ++k)
        points.push_back(normalised(column(fixed, k)));
      return points;
    }
    const Eigen::Vector2d& period = surface.period();
    for (const int shift : {0, -1, 1})
      for (const int up : {0, -1, 1})
        if ((shift == 0 || period.x() > 0) && (up == 0 || period.y() > 0))
          for (const auto& p : fixed.colwise())
            points.push_back((*in.frame)(p.x() + shift * period.x(), p.y() + up * period.y()));
    return points;
  }
};

/// Draws candidates. The mean of 1/density over points that follow the density is area / integral,
/// which gives the spacing.
Placed placed_candidates(const Supply& from, std::int64_t n, std::int64_t cells,
                         std::uint64_t seed) {
  Placed out{{from.draw(n, seed), DoubleVector(n), std::vector<std::uint64_t>(n)},
             Array<std::int32_t>(n),
             DoubleVector(n),
             {}};
  const DoubleVector inverse =
      evaluate(from.sites, out.candidates.points, from.surface).cwiseInverse();
  const double scale = from.surface.area() / (inverse.mean() * static_cast<double>(cells));
  for (const double density : evaluate(from.sites, from.fixed, from.surface))
    out.fixed_width.push_back(density_detail::hexagon_width(scale / density));
  const Sites sites = from.sorted(out.candidates.points);
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
      double& width = out.candidates.width[i];
      width = density_detail::hexagon_width(scale * inverse[i]);
      out.candidates.keys[static_cast<std::size_t>(i)] = static_cast<std::uint64_t>(r);
      out.nearest[i] = owner[r] % static_cast<std::int32_t>(from.fixed.cols());
      out.distance[i] = apart / width;
    }
  });
  return out;
}

/// Whether candidates are farther than some distance from the fixed generators, next to a gap. In a
/// lattice of hexagons, no point is farther than 0.577 of the distance of neighbours from the
/// nearest centre: beyond 0.65 there is a gap.
std::vector<bool> have_room(const Placed& in, std::int64_t fixed, double distance) {
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

/// The number of candidates: enough per cell to find gaps, as far as memory allows.
std::int64_t candidates_for(std::int64_t cells) {
  constexpr std::int64_t most = 4'000'000, for_each_cell = 32;
  return std::max(cells, std::min(most, for_each_cell * cells));
}

} // namespace

Points3 free_points(std::int64_t count, std::int64_t cells, const Points3& fixed,
                    const Surface& surface, const Density& sites, std::uint64_t seed) {
  const Supply from{fixed, surface, sites};
  if (fixed.cols() == 0 || count == 0)
    return from.draw(count, seed);
  const Placed in = placed_candidates(from, candidates_for(cells), cells, seed);
  Darts darts(in.candidates, surface);
  for (Eigen::Index k = 0; k < fixed.cols(); ++k)
    darts.put(surface.is_sphere() ? normalised(column(fixed, k)) : Vec3(column(fixed, k)),
              in.fixed_width[static_cast<std::size_t>(k)]);
  return in.candidates.points(Eigen::all, darts.take(count));
}

std::int64_t cells_beside_fixed(const Points3& fixed, std::int64_t cells, const Surface& surface,
                                const Density& sites) {
  constexpr double radius_of_hexagon = 0.525; // of a disc of its area
  base_detail::require_count(cells, 1, "the number of cells");
  if (fixed.cols() == 0)
    return cells;
  const Placed in =
      placed_candidates(Supply{fixed, surface, sites}, candidates_for(cells), cells, 1);
  const std::vector<bool> room = have_room(in, fixed.cols(), radius_of_hexagon);
  const double share = static_cast<double>(std::count(room.begin(), room.end(), true)) /
                       static_cast<double>(room.size());
  return fixed.cols() + std::llround(share * static_cast<double>(cells));
}

} // namespace calotte::grids_detail
