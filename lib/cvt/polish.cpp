// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/polish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {
namespace {

using Seeds = std::vector<std::array<std::int32_t, 2>>;
using Sites3 = std::array<std::int32_t, 3>; ///< sites, ascending

Sites3 ascending_corners(const Connectivity& mesh, std::int32_t t) {
  Sites3 sites{mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
  std::sort(sites.begin(), sites.end());
  return sites;
}

/// The triangles with shapes farther beyond the limits than `beyond`, the worst ones first. The
/// triangulation alone determines the order.
template <Space S>
Seeds worst_shapes(const Tessellation<S>& tessellation, const Points3& points,
                   const LocalInput& input, const ShapePenalty& penalty,
                   double beyond = polished_excess) {
  const DoubleVector inverse_spacing =
      evaluate(input.density, points).cwiseSqrt().cwiseSqrt() / penalty.spacing;
  const ShapeInput<S> shapes{tessellation.positioned(), inverse_spacing, penalty.limits,
                             input.fixed};
  struct Shape {
    double excess;
    Sites3 sites;
    std::int32_t triangle;
  };
  std::vector<Shape> found;
  for (const std::int32_t t : distorted(shapes))
    if (const double excess = shape_excess(shapes, t); excess > beyond)
      found.push_back({excess, ascending_corners(tessellation.mesh(), t), t});
  std::sort(found.begin(), found.end(), [](const Shape& a, const Shape& b) {
    return std::tie(b.excess, a.sites) < std::tie(a.excess, b.sites);
  });
  Seeds seeds;
  for (const Shape& shape : found)
    seeds.push_back({shape.triangle, shape.triangle});
  return seeds;
}

/// Descends with the penalty, which is raised where it does not suffice. False if no mesh is left,
/// or one that ends elsewhere than before: beside land narrower than a cell, generators that slide
/// may lose an edge of the boundary.
template <Space S>
bool polish_part(Subdomain<S>& part, const LocalInput& input, ShapePenalty penalty) {
  constexpr int least = 20, most = 40, most_raised = 2; // the least spread what moves
  constexpr double raise = 4;
  const std::int64_t inner = part.may_slide() ? part.inner_triangles() : 0;
  for (int raised = 0; raised <= most_raised; ++raised, penalty.factors.shapes *= raise) {
    const Evaluation last =
        descend(part, part.points(), input, penalty, [&](const Evaluation& here, int evaluations) {
          return (here.shapes.worst <= polished_excess && evaluations >= least) ||
                 evaluations >= most;
        });
    if (!std::isfinite(last.iteration.energy))
      return false;
    if (last.shapes.worst <= polished_excess)
      break;
  }
  return !part.may_slide() || part.inner_triangles() == inner;
}

} // namespace

template <Space S>
std::vector<std::uint8_t> released(const Tessellation<S>& tessellation, const Points3& points,
                                   const LocalInput& input, const ShapePenalty& penalty,
                                   std::uint8_t firmest) {
  std::vector<std::uint8_t> fixed = input.fixed;
  for (const auto& [triangle, same] :
       worst_shapes(tessellation, points, input, penalty, accepted_excess))
    for (const std::int32_t site : tessellation.mesh().triangles.col(triangle))
      if (site < std::ssize(fixed))
        if (std::uint8_t& pin = fixed[static_cast<std::size_t>(site)];
            pin >= pinned_on_line && pin <= firmest)
          pin = 0;
  return fixed;
}

template <Space S>
std::int64_t polish(Tessellation<S>& tessellation, Points3& points, const LocalInput& input,
                    const ShapePenalty& penalty) {
  // Shapes near each other are polished one after another, each once.
  constexpr int most_rounds = 4;
  std::int64_t count = 0;
  const auto task = [&](std::size_t, Subdomain<S>& part) {
    return polish_part(part, input, penalty);
  };
  tessellation.change_mesh(
      points, [&](Connectivity& mesh) -> std::optional<std::vector<std::int32_t>> {
        std::vector<std::int32_t> changed;
        std::set<Sites3> tried;
        const auto corners = [&](std::int32_t t) { return ascending_corners(mesh, t); };
        for (int round = 0; round < most_rounds; ++round) {
          Seeds seeds = worst_shapes(tessellation, points, input, penalty);
          std::erase_if(seeds, [&](const auto& seed) { return tried.contains(corners(seed[0])); });
          const auto chosen = choose_disjoint(mesh, seeds).chosen;
          if (chosen.empty())
            break;
          for (const Surroundings& some : chosen)
            tried.insert(corners(seeds[some.seed][0]));
          count += std::ssize(chosen);
          if (!work_in<S>(chosen, task, input, tessellation, mesh, points, changed))
            return std::nullopt;
        }
        return changed;
      });
  return count;
}

template std::vector<std::uint8_t> released(const Tessellation<Sphere>&, const Points3&,
                                            const LocalInput&, const ShapePenalty&, std::uint8_t);
template std::vector<std::uint8_t> released(const Tessellation<Plane>&, const Points3&,
                                            const LocalInput&, const ShapePenalty&, std::uint8_t);
template std::int64_t polish(Tessellation<Sphere>&, Points3&, const LocalInput&,
                             const ShapePenalty&);
template std::int64_t polish(Tessellation<Plane>&, Points3&, const LocalInput&,
                             const ShapePenalty&);

} // namespace calotte::cvt_detail
