// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/generators.h>

#include "base/points.h"
#include "base/require.h"
#include "density/demanded_spacing.h"
#include "density/hexagons.h"
#include "domain/rings.h"
#include "domain/spherical_outline.h"
#include "domain/surface.h"
#include "generators/room.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace calotte {
namespace {

using namespace generators_detail;
using base_detail::require;

/// A place of a ring, by the number of demanded edges from the ring's start to it.
struct Mark {
  double edges;
  const Arc* arc;
  double along; ///< angle from the arc's start
  bool corner;
};

double length_of(const Arc& arc) {
  return 2 * std::asin(std::min(1.0, norm(arc.to - arc.from) / 2));
}

Vec3 left_of(const Arc& arc) { return normalised(cross(arc.from, arc.to)); }

Vec3 place_at(const Arc& arc, double along) {
  if (along == 0)
    return arc.from;
  return normalised(std::sin(length_of(arc) - along) * arc.from + std::sin(along) * arc.to);
}

/// The ring that consists of some arcs, as marks that are a tenth of an edge apart. The last one is
/// the first again.
class Walk {
public:
  Walk(const DemandedSpacing& spacing, std::span<const Arc> arcs) : spacing_(spacing) {
    for (const Arc& arc : arcs)
      walk(arc);
    marks_.push_back({edges_, arcs.data(), 0, true});
  }
  std::vector<Mark> marks() { return std::move(marks_); }

private:
  /// Demanded edges in a radian.
  double rate_at(const Arc& arc, double along) const {
    return 1 / hexagon_width(std::pow(spacing_.at(place_at(arc, along)), 2));
  }

  void walk(const Arc& arc) {
    constexpr double step = 0.1, longest = 0.01;
    const double length = length_of(arc);
    double rate = rate_at(arc, 0);
    for (double along = 0; along < length;) {
      marks_.push_back({edges_, &arc, along, along == 0});
      const double next = std::min({length, along + step / rate, along + longest});
      const double there = rate_at(arc, next);
      edges_ += (next - along) * (rate + there) / 2;
      rate = there;
      along = next;
    }
  }

  const DemandedSpacing& spacing_;
  double edges_ = 0;
  std::vector<Mark> marks_;
};

/// The corners that generators keep, as indices of marks: the boundary turns there by 20 degrees or
/// more, and two of them are two thirds of an edge or more apart. The sharper one goes first.
std::vector<std::size_t> kept_corners(const std::vector<Mark>& marks, std::span<const Arc> arcs) {
  constexpr double straight = 0.94; // cosine of 20 degrees
  constexpr double apart = 2.0 / 3;
  struct Corner {
    double cosine;
    std::size_t mark;
  };
  std::vector<Corner> corners;
  for (std::size_t k = 0; k + 1 < marks.size(); ++k)
    if (marks[k].corner) {
      const Arc* before = marks[k].arc == arcs.data() ? &arcs.back() : marks[k].arc - 1;
      const double cosine = dot(left_of(*before), left_of(*marks[k].arc));
      if (cosine < straight)
        corners.push_back({cosine, k});
    }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.cosine < b.cosine; });
  const double whole = marks.back().edges;
  std::vector<std::size_t> kept;
  for (const Corner& corner : corners) {
    const bool near = std::any_of(kept.begin(), kept.end(), [&](std::size_t other) {
      const double distance = std::abs(marks[other].edges - marks[corner.mark].edges);
      return std::min(distance, whole - distance) < apart;
    });
    if (!near)
      kept.push_back(corner.mark);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

/// The place after a number of edges.
class Ruler {
public:
  Ruler(const std::vector<Mark>& marks, const SphericalOutline& outline)
      : marks_(marks), outline_(outline) {}

  /// \param edges ascending from call to call.
  Vec3 place(double edges) {
    while (at_ + 2 < marks_.size() && marks_[at_ + 1].edges <= edges)
      ++at_;
    const Mark &mark = marks_[at_], &next = marks_[at_ + 1];
    const double end = next.arc == mark.arc && next.along > 0 ? next.along : length_of(*mark.arc);
    const double share =
        next.edges > mark.edges ? (edges - mark.edges) / (next.edges - mark.edges) : 0;
    return inside(*mark.arc, mark.along + std::clamp(share, 0.0, 1.0) * (end - mark.along));
  }

private:
  /// Rounding may put a place outside; some roundoffs farther in it is inside.
  Vec3 inside(const Arc& arc, double along) const {
    const Vec3 on = place_at(arc, along), left = left_of(arc);
    Vec3 x = on;
    for (int shift = 1; outline_.side(x) == Side::outside && shift <= 8; ++shift)
      x = normalised(on + (shift * 0x1p-53) * left);
    return x;
  }

  const std::vector<Mark>& marks_;
  const SphericalOutline& outline_;
  std::size_t at_ = 0;
};

/// Generators at the corners of a ring and at equal numbers of edges between two of them; three or
/// more.
void add_ring(const std::vector<Mark>& marks, std::vector<std::size_t> corners,
              const SphericalOutline& outline, std::vector<Vec3>& places) {
  constexpr double fewest = 3;
  const double whole = marks.back().edges;
  constexpr double slack = 0.25; // longer edges would let other generators come between their ends
  const auto number = [](double edges) { return std::max(1.0, std::ceil(edges - slack)); };
  if (corners.empty())
    corners.push_back(0);
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    sum +=
        number(k + 1 < corners.size() ? marks[corners[k + 1]].edges - marks[corners[k]].edges
                                      : whole - marks[corners[k]].edges + marks[corners[0]].edges);
  if (sum < fewest)
    corners.resize(1);
  Ruler ruler(marks, outline);
  std::vector<double> stops;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const double from = marks[corners[k]].edges, to = k + 1 < corners.size()
                                                          ? marks[corners[k + 1]].edges
                                                          : whole + marks[corners[0]].edges;
    const double count = std::max(number(to - from), corners.size() == 1 ? fewest : 1);
    for (double j = 0; j < count; ++j)
      stops.push_back(from + j / count * (to - from));
  }
  for (double& stop : stops)
    stop = stop < whole ? stop : stop - whole;
  std::sort(stops.begin(), stops.end());
  for (const double stop : stops)
    places.push_back(ruler.place(stop));
}

/// Marks of all rings.
std::vector<std::vector<Mark>> walk_all(const Rings& rings, const DemandedSpacing& spacing) {
  std::vector<std::vector<Mark>> all;
  for (std::int64_t r = 0; r < rings.arcs.size(); ++r)
    all.push_back(Walk(spacing, rings.arcs[r]).marks());
  return all;
}

/// The number of cells in a lattice without a boundary that has the spacing of n generators, b of
/// which are on the boundary and have half a cell each. b is inverse to the spacing: with b_0 edges
/// for the spacing of n such cells, n s^2 - b_0 s / 2 - n = 0 for the ratio s of the spacings.
double whole_cells(double n, double edges) {
  const double s = (edges / 2 + std::sqrt(edges * edges / 4 + 4 * n * n)) / (2 * n);
  return n / (s * s);
}

} // namespace

Points3 boundary_points(const Surface& surface, std::int64_t cells, const Density& density) {
  domain_detail::require_sphere(surface, "generators along the boundary are");
  constexpr std::int64_t samples = 65536;
  require(cells >= 4 && cells <= most_points, "the number of cells is " + std::to_string(cells) +
                                                  "; give 4 to " + std::to_string(most_points));
  if (!surface.is_bounded())
    return Points3(3, 0);
  const SphericalOutline& outline = *outline_of<Sphere>(surface);
  const Rings rings = rings_of(surface.rings());
  const auto n = static_cast<double>(cells);
  double edges = 0;
  for (const std::vector<Mark>& marks :
       walk_all(rings, DemandedSpacing(surface, density, n, samples)))
    edges += marks.back().edges;
  std::vector<Vec3> places;
  const DemandedSpacing spacing(surface, density, whole_cells(n, edges), samples);
  const std::vector<std::vector<Mark>> all = walk_all(rings, spacing);
  for (std::size_t r = 0; r < all.size(); ++r) {
    require(all[r].back().edges > 0, "the density is zero along ring " + std::to_string(r) +
                                         " of the boundary; make it positive");
    add_ring(all[r], kept_corners(all[r], rings.arcs[static_cast<std::int64_t>(r)]), outline,
             places);
  }
  require(std::ssize(places) < cells, "the boundary takes " + std::to_string(places.size()) +
                                          " of the " + std::to_string(cells) +
                                          " generators; give more cells");
  Points3 points(3, std::ssize(places));
  for (std::size_t i = 0; i < places.size(); ++i)
    base_detail::set_column(points, static_cast<std::int64_t>(i), places[i]);
  return points;
}

} // namespace calotte
