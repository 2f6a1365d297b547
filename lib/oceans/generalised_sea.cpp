// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/generalise.h>

#include "base/elementary.h"
#include "base/require.h"
#include "density/hexagons.h"
#include "domain/lines.h"
#include "domain/surface.h"
#include "oceans/fitted_rings.h"
#include "oceans/level_rings.h"
#include "oceans/openings.h"
#include "oceans/parts.h"
#include "oceans/passages.h"
#include "oceans/shore_points.h"
#include "oceans/small_land.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace oceans_detail;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The coast without what is small at the local widths.
LargeCoast without_small_cells(const Coast& coast, const Widths& widths, double least_cells) {
  const std::vector<std::vector<Arc>> lines = closed_lines(coast);
  require(!lines.empty(), "the coast has no shore; give rings of land");
  Points3 firsts(3, std::ssize(lines));
  for (std::size_t k = 0; k < lines.size(); ++k)
    set_column(firsts, static_cast<Eigen::Index>(k), lines[k].front().from);
  std::vector<double> least = demanded_at(widths, firsts);
  for (double& each : least)
    each = least_cells * density_detail::hexagon_area(each);
  LargeCoast large = large_lines(coast, lines, least);
  require(!large.coast.rings.empty() || large.lakes == 0,
          "no part of the sea is as wide as a cell; give smaller widths");
  require(!large.coast.rings.empty(),
          "all land of the coast is smaller than the least island that counts; give smaller "
          "widths, or a smaller least island");
  return large;
}

std::vector<double> areas_of(const ShoreMesh& shore, const Parts& parts) {
  std::vector<double> areas(parts.sizes.size());
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (parts.of_cell[site] >= 0)
      areas[static_cast<std::size_t>(parts.of_cell[site])] += shore.area(site);
  return areas;
}

/// The part that a seed lies in, or within a quarter of a width of: a site has no coast nearer than
/// its own distance from it.
std::int32_t part_of_seed(const ShoreMesh& shore, const Parts& parts, const Points3& seeds,
                          Eigen::Index number) {
  constexpr double slack = 0.25; // of widths
  require(seeds.col(number).allFinite() && !seeds.col(number).isZero(0),
          "seed {} is no direction; give three finite numbers that are not all 0", number);
  const Vec3 seed = normalised(column(seeds, number));
  require(shore.seas.sides.is_sea(seed), "seed {} is on land; give a point in the sea", number);
  require(shore.seas.has(seed), "seed {} is outside the region; give a point in its sea", number);
  double least = infinity;
  std::int32_t part = -1;
  for (std::int64_t site = 0; site < shore.size(); ++site) {
    if (parts.of_cell[site] < 0)
      continue;
    const double chord = norm(column(shore.at.points, site) - seed),
                 away = 2 * base_detail::arc_sine(std::min(1.0, 0.5 * chord)) -
                        shore.from_coast(site) - slack * shore.width(site);
    if (away < least) {
      least = away;
      part = parts.of_cell[site];
    }
  }
  require(least <= 0,
          "seed {} is in a part of the sea that is narrower than a cell; give a point where the "
          "sea is wider, or smaller widths",
          number);
  return part;
}

/// Whether each part of the open sites is kept: those of the seeds, or the largest.
std::vector<bool> seeded_parts(const ShoreMesh& shore, const Parts& parts, const Points3& seeds) {
  const std::vector<double> areas = areas_of(shore, parts);
  require(!areas.empty(), "no part of the sea is as wide as a cell; give smaller widths");
  std::vector<bool> kept(areas.size());
  for (Eigen::Index k = 0; k < seeds.cols(); ++k)
    kept[static_cast<std::size_t>(part_of_seed(shore, parts, seeds, k))] = true;
  if (seeds.cols() == 0)
    kept[static_cast<std::size_t>(std::max_element(areas.begin(), areas.end()) - areas.begin())] =
        true;
  return kept;
}

bool is_kept(const Parts& parts, const std::vector<bool>& kept, std::int64_t site) {
  const std::int32_t part = parts.of_cell[site];
  return part >= 0 && kept[static_cast<std::size_t>(part)];
}

/// The passages that reach a kept part, and the numbers of the others.
struct Passages {
  std::vector<Points3> lines;
  std::vector<std::int64_t> stranded;
};

Passages connected_passages(const ShoreMesh& shore, const std::vector<Points3>& lines,
                            const SiteTest& is_kept) {
  std::vector<Vec3> sites; // of the passages in kept parts
  std::vector<double> reach;
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (is_kept(site) && shore.at.from_passage[static_cast<std::size_t>(site)] < infinity) {
      sites.push_back(column(shore.at.points, site));
      reach.push_back(0.5 * shore.width(site));
    }
  Passages passages;
  std::vector<double> away(sites.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const LineDistance line({lines[k]}, {});
    line(sites, away);
    bool reaches = false;
    for (std::size_t i = 0; i < sites.size(); ++i)
      reaches |= away[i] <= reach[i];
    if (reaches)
      passages.lines.push_back(lines[k]);
    else
      passages.stranded.push_back(static_cast<std::int64_t>(k));
  }
  return passages;
}

/// The selected parts, largest first.
std::vector<ClosedSea> closed_seas(const ShoreMesh& shore, const Parts& parts,
                                   const std::vector<bool>& selected) {
  const std::vector<double> areas = areas_of(shore, parts);
  std::vector<std::int64_t> middles(areas.size(), -1);
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (const std::int32_t part = parts.of_cell[site]; part >= 0) {
      std::int64_t& middle = middles[static_cast<std::size_t>(part)];
      if (middle < 0 || shore.from_coast(site) > shore.from_coast(middle))
        middle = site;
    }
  std::vector<ClosedSea> seas;
  for (std::size_t part = 0; part < areas.size(); ++part)
    if (selected[part])
      seas.push_back({shore.at.points.col(middles[part]), areas[part]});
  std::stable_sort(seas.begin(), seas.end(),
                   [](const ClosedSea& a, const ClosedSea& b) { return a.area > b.area; });
  return seas;
}

/// The narrow parts of the sea that lead from the sea of the grid to another side of it, or to a
/// part that is left out.
/// \param inside distances from the whole core. \param in_sea distances from that of the sea.
/// \param values not negative in the sea, such as in a passage.
std::vector<ClosedSea> closed_straits(const ShoreMesh& shore, const std::vector<double>& inside,
                                      const std::vector<double>& in_sea,
                                      const std::vector<double>& values) {
  const auto is_far = [&](const std::vector<double>& distances, std::int64_t site) {
    return distances[static_cast<std::size_t>(site)] < -beyond * shore.width(site);
  };
  const Narrows narrows = find_narrows(
      shore.neighbours,
      [&](std::int32_t site) { return shore.from_coast(site) > 0 && is_far(inside, site); },
      [&](std::int32_t site) { return shore.from_coast(site) > 0 && !is_far(inside, site); });
  std::vector<bool> selected;
  for (std::size_t part = 0; part < narrows.ends.size(); ++part) {
    const std::vector<std::int32_t>& ends = narrows.ends[part];
    selected.push_back(narrows.sides[part] > 1 &&
                       !std::all_of(ends.begin(), ends.end(),
                                    [&](std::int32_t site) { return is_far(in_sea, site); }));
  }
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (const std::int32_t part = narrows.parts.of_cell[site];
        part >= 0 && values[static_cast<std::size_t>(site)] >= 0)
      selected[static_cast<std::size_t>(part)] = false;
  return closed_seas(shore, narrows.parts, selected);
}

/// The rings where values are 0. Their corners may move to the coast, but along passages, which are
/// wider than it.
std::vector<FineRing> fine_rings(const ShoreMesh& shore, const std::vector<double>& values,
                                 const std::vector<double>& from_passage) {
  constexpr double farthest = 0.5;
  std::vector<FineRing> rings;
  for (const std::vector<LevelPoint>& ring : level_rings(shore.mesh, values)) {
    FineRing& fine = rings.emplace_back();
    for (const LevelPoint& point : ring) {
      const double width = point.value(shore.at.widths);
      const bool moves = from_passage[static_cast<std::size_t>(point.above)] > beyond * width;
      fine.points.push_back(point.position(shore.at.points));
      fine.widths.push_back(width);
      fine.reaches.push_back(moves ? farthest * width : 0);
    }
  }
  return rings;
}

void set_changed_areas(const ShoreMesh& shore, GeneralisedSea& result) {
  const std::vector<double> sums =
      base_detail::sums_over_blocks(shore.size(), 2, [&](base_detail::Part part, auto sum) {
        for (std::int64_t site = part.begin; site != part.end; ++site) {
          const bool was = shore.from_coast(site) > 0,
                     is = result.sea.contains(shore.at.points.col(site));
          if (was != is)
            sum[was ? 1 : 0] += shore.area(site);
        }
      });
  result.land_to_sea += sums[0];
  result.sea_to_land += sums[1];
}

void set_displacements(const ShoreMesh& shore, const Widths& widths,
                       const std::vector<Points3>& passages, GeneralisedSea& result) {
  std::vector<Vec3> along;
  for (const DoubleMatrix& ring : result.sea.rings())
    for (Eigen::Index k = 0; k < ring.cols(); ++k)
      for (const double share : {0.0, 1.0 / 3, 2.0 / 3}) {
        const Eigen::Vector3d at =
            (1 - share) * ring.col(k) + share * ring.col(k + 1 < ring.cols() ? k + 1 : 0);
        along.push_back(normalised({at.x(), at.y(), at.z()}));
      }
  Points3 points(3, std::ssize(along));
  for (std::size_t k = 0; k < along.size(); ++k)
    set_column(points, static_cast<Eigen::Index>(k), along[k]);
  const std::vector<double> width = demanded_at(widths, points),
                            away = distances_at(shore.coast, points),
                            from_passage = passages.empty()
                                               ? std::vector<double>(along.size(), infinity)
                                               : distances_at(LineDistance(passages, {}), points);
  std::vector<double> displaced;
  for (std::size_t k = 0; k < along.size(); ++k)
    if (from_passage[k] > beyond * width[k])
      displaced.push_back(away[k] / width[k]);
  if (displaced.empty())
    return;
  std::sort(displaced.begin(), displaced.end());
  result.displacement = displaced.back();
  result.usual_displacement = displaced[(95 * displaced.size() - 1) / 100];
}

/// Distances of all sites from passages, which end at the border of the seas.
std::vector<double> from_lines(const ShoreMesh& shore, const std::vector<Points3>& lines) {
  std::vector<double> distances = near_distances_at(LineDistance(lines, {}), shore.at);
  if (shore.seas.border)
    for (std::int64_t site = 0; site < shore.size(); ++site)
      if (!shore.seas.within.contains(shore.at.points.col(site)))
        distances[static_cast<std::size_t>(site)] = infinity;
  return distances;
}

/// Whether no corner of a line is in a part of the sphere.
bool is_beyond(const Surface& within, const Points3& line) {
  for (const auto& corner : line.colwise())
    if (within.contains(corner))
      return false;
  return true;
}

void require_options(const Widths& widths, const GeneraliseOptions& options) {
  require(std::isfinite(options.least_island) && options.least_island >= 0.25,
          "the least island has {} cells; give 0.25 or more", options.least_island);
  require(!widths.is_of_plane(), "coasts are of the sphere; give widths of it");
  domain_detail::require_sphere(options.within, "the sea of a coast is");
  for (std::size_t k = 0; k < options.passages.size(); ++k)
    domain_detail::checked_line(options.passages[k], static_cast<std::int64_t>(k), true);
}

} // namespace

GeneralisedSea generalised_sea(const Coast& coast, const Widths& widths,
                               const GeneraliseOptions& options) {
  require_options(widths, options);
  const LargeCoast large = without_small_cells(coast, widths, options.least_island);
  ShoreMesh shore(large.coast, widths, options.passages, options.within);
  const std::vector<Points3> lines = continued_passages(shore, options.passages);
  if (!lines.empty())
    shore.at.from_passage = from_lines(shore, lines);
  const Parts open =
      find_parts(shore.neighbours, [&](std::int32_t site) { return shore.is_open(site); });
  const std::vector<bool> kept = seeded_parts(shore, open, options.seeds);
  const auto in_sea = [&](std::int64_t site) { return is_kept(open, kept, site); };
  const Passages passages = connected_passages(shore, lines, in_sea);

  const std::vector<double> inside = from_core(shore, in_sea);
  const std::vector<double> from_passage = passages.lines.empty()
                                               ? std::vector<double>(inside.size(), infinity)
                                               : from_lines(shore, passages.lines);
  std::vector<double> values = sea_values(shore, inside, from_passage);
  remove_capes(shore, values);
  remove_pieces(shore, in_sea, options.least_island, values);

  GeneralisedSea result;
  result.islands = large.islands;
  result.lakes = large.lakes;
  result.stranded_passages = passages.stranded;
  std::erase_if(result.stranded_passages, [&](std::int64_t passage) {
    return is_beyond(options.within, options.passages[static_cast<std::size_t>(passage)]);
  });
  result.land_to_sea = large.islands_area;
  result.sea_to_land = large.lakes_area;
  result.sea =
      Surface::sphere().within(fitted_rings(fine_rings(shore, values, from_passage), shore.coast));
  std::vector<bool> severed(kept.size()); // passages without effect are no parts of the sea
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (open.of_cell[site] >= 0 && shore.core(site) >= 0 && !in_sea(site))
      severed[static_cast<std::size_t>(open.of_cell[site])] = true;
  result.parts = closed_seas(shore, open, severed);
  result.straits =
      closed_straits(shore, from_core(shore, [](std::int64_t) { return true; }), inside, values);
  set_changed_areas(shore, result);
  set_displacements(shore, widths, passages.lines, result);
  return result;
}

} // namespace calotte
