// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/glide.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "cvt/cells.h"
#include "cvt/positioned_mesh.h"
#include "cvt/subdomain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace calotte::cvt_detail {
namespace {

/// A Delaunay edge ab that is about to flip, with the vertices c and d across from it: cd is nearly
/// Delaunay, too.
struct Brink {
  double ratio; ///< Voronoi over Delaunay edge
  std::int32_t a, b, c, d;
  std::array<std::int32_t, 2> triangles; ///< abc and bad, counter-clockwise or not
};

/// The shortest Voronoi edges first: an order that the triangulation alone determines.
bool is_shorter(const Brink& e, const Brink& f) {
  return std::tie(e.ratio, e.a, e.b) < std::tie(f.ratio, f.a, f.b);
}

/// Finds brinks in a mesh.
template <Space S> struct Search {
  const PositionedMesh<S> in;
  const ShapeLimits& limits;

  /// The cotangent of a triangle's angle at its vertex v.
  double cotangent(std::int32_t t, int v) const {
    const Vec3 u = in.offset(in.site(t, v), in.site(t, next_vertex(v))),
               w = in.offset(in.site(t, v), in.site(t, previous_vertex(v)));
    return dot(u, w) / norm(cross(u, w));
  }

  /// Adds the edge across from vertex v of triangle t, unless its other triangle adds it.
  /// \param is_free tells whether a site may move.
  template <class IsFree>
  void add_if_brink(std::int32_t t, int v, const IsFree& is_free, std::vector<Brink>& out) const {
    const std::int32_t u = in.across(t, v);
    const double here = cotangent(t, v);
    if (u < 0 || here >= std::max(limits.least_edge, limits.least_cotangent))
      return;
    const int w = vertex_across(in.mesh.neighbours, u, t);
    const double beyond = cotangent(u, w), ratio = (here + beyond) / 2;
    const std::int32_t c = in.site(t, v), d = in.site(u, w);
    const bool theirs = beyond < here || (beyond == here && d < c);
    if (theirs || (ratio >= limits.least_edge && here >= limits.least_cotangent))
      return;
    const std::int32_t a = in.site(t, next_vertex(v)), b = in.site(t, previous_vertex(v));
    const bool free = is_free(a) && is_free(b) && is_free(c) && is_free(d);
    if (free && in.has_centre(t) && in.has_centre(u))
      out.push_back({ratio, std::min(a, b), std::max(a, b), c, d, {t, u}});
  }
};

/// Moves a and b apart, and c and d together, so that cd replaces ab.
template <Space S> Points3 pushed(const Subdomain<S>& part, const Brink& brink) {
  constexpr double share = 0.16; // of the width of the cells, about the length of ab over sqrt(2)
  const PositionedMesh<S> at = part.positioned();
  const Vec3 ab = at.offset(brink.a, brink.b), cd = at.offset(brink.c, brink.d);
  const Vec3 apart = (1 / norm(ab)) * ab, together = (1 / norm(cd)) * cd;
  Points3 ways = Points3::Zero(3, part.movable()), to(3, part.movable());
  set_column(ways, brink.a, -1 * apart);
  set_column(ways, brink.b, apart);
  set_column(ways, brink.c, together);
  set_column(ways, brink.d, -1 * together);
  part.retract(part.points(), share / std::numbers::sqrt2 * norm(ab), ways, to);
  return to;
}

template <Space S> class Glide {
public:
  Glide(Tessellation<S>& tessellation, Points3& points, const LocalInput& input,
        const ShapeLimits& limits)
      : tessellation_(tessellation), points_(points), input_(input), limits_(limits) {}

  /// Follows dislocations at brinks until there are none. Returns the number of steps.
  std::int64_t run() {
    tessellation_.change_mesh(
        points_, [&](Connectivity& mesh) -> std::optional<std::vector<std::int32_t>> {
          constexpr int most_rounds = 12; // those near each other follow one after another
          std::vector<Brink> brinks = all_brinks();
          for (int round = 0; round < most_rounds && !brinks.empty(); ++round)
            if (!step(mesh, brinks))
              return std::nullopt;
          return std::move(changed_);
        });
    return steps_;
  }

private:
  bool is_free(std::int32_t site) const {
    return site < points_.cols() &&
           (input_.fixed.empty() || input_.fixed[static_cast<std::size_t>(site)] == 0);
  }

  /// Adds the brinks of a triangle of the mesh.
  void add_brinks(std::int32_t t, std::vector<Brink>& out) const {
    const Search<S> search{tessellation_.positioned(), limits_};
    for (int v = 0; v < 3; ++v)
      search.add_if_brink(
          t, v, [&](std::int32_t site) { return is_free(site); }, out);
  }

  std::vector<Brink> all_brinks() const {
    const std::int64_t count = tessellation_.mesh().triangles.cols();
    std::vector<std::vector<Brink>> parts(static_cast<std::size_t>(block_count(count)));
    for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      for (auto t = static_cast<std::int32_t>(begin); t != end; ++t)
        add_brinks(t, parts[static_cast<std::size_t>(block)]);
    });
    std::vector<Brink> all;
    for (const std::vector<Brink>& part : parts)
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  /// Follows brinks that are far from each other, and replaces all brinks by those that are left.
  /// False if the mesh has become unusable.
  bool step(Connectivity& mesh, std::vector<Brink>& brinks) {
    std::sort(brinks.begin(), brinks.end(), is_shorter);
    std::vector<std::array<std::int32_t, 2>> seeds;
    for (const Brink& brink : brinks)
      seeds.push_back(brink.triangles);
    const DisjointSurroundings around = choose_disjoint(mesh, seeds);
    const std::vector<Surroundings>& chosen = around.chosen;
    std::vector<std::vector<Ends>> tried(chosen.size());
    std::vector<std::int64_t> steps(chosen.size(), 0);
    const auto task = [&](std::size_t index, Subdomain<S>& part) {
      const bool sound = follow(brinks[chosen[index].seed], part, tried[index]);
      steps[index] = sound ? std::ssize(tried[index]) : 0;
      return sound;
    };
    if (!work_in<S>(chosen, task, input_, tessellation_, mesh, points_, changed_))
      return false;
    steps_ += std::accumulate(steps.begin(), steps.end(), std::int64_t{0});
    for (const std::vector<Ends>& edges : tried)
      tried_.insert(tried_.end(), edges.begin(), edges.end());
    std::sort(tried_.begin(), tried_.end());
    std::vector<Brink> next;
    for (const std::size_t k : around.left)
      next.push_back(brinks[k]);
    for (const Surroundings& some : chosen)
      for (const std::int32_t t : some.triangles)
        add_brinks(t, next);
    std::erase_if(next, [&](const Brink& brink) {
      return std::binary_search(tried_.begin(), tried_.end(), Ends{brink.a, brink.b});
    });
    brinks = std::move(next);
    return true;
  }

  /// Follows a dislocation step by step while it is inside a subdomain. False if the mesh has
  /// become unusable. \param tried the edges at its steps are added.
  bool follow(const Brink& first, Subdomain<S>& part, std::vector<Ends>& tried) const {
    constexpr std::ptrdiff_t most_steps = 6;
    constexpr int most_evaluations = 12;
    constexpr double near = 0.002; // of the width of a cell
    tried.emplace_back(first.a, first.b);
    std::optional<Brink> brink = local(part, first);
    while (brink) {
      const Evaluation last =
          descend(part, pushed(part, *brink), input_, {}, [&](const Evaluation& here, int count) {
            return here.iteration.linf <= near || count >= most_evaluations;
          });
      if (!std::isfinite(last.iteration.energy))
        return false;
      brink = std::ssize(tried) < most_steps ? next(part, tried) : std::nullopt;
      if (brink)
        tried.push_back(ends(part, *brink));
    }
    return true;
  }

  static Ends ends(const Subdomain<S>& part, const Brink& brink) {
    return std::minmax(part.sites()[static_cast<std::size_t>(brink.a)],
                       part.sites()[static_cast<std::size_t>(brink.b)]);
  }

  /// A brink by local numbers; none if its generators are on the edge of the subdomain.
  static std::optional<Brink> local(const Subdomain<S>& part, const Brink& brink) {
    const auto sites = part.sites().first(static_cast<std::size_t>(part.movable()));
    Brink out = brink;
    for (std::int32_t* const site : {&out.a, &out.b, &out.c, &out.d}) {
      const auto at = std::lower_bound(sites.begin(), sites.end(), *site);
      if (at == sites.end() || *at != *site)
        return std::nullopt;
      *site = static_cast<std::int32_t>(at - sites.begin());
    }
    return out;
  }

  /// The shortest brink inside that has not been tried.
  std::optional<Brink> next(const Subdomain<S>& part, const std::vector<Ends>& tried) const {
    const Search<S> search{part.positioned(), limits_};
    std::vector<Brink> found;
    for (std::int32_t t = 0; t < part.triangles(); ++t)
      for (int v = 0; v < 3; ++v)
        search.add_if_brink(
            t, v, [&](std::int32_t site) { return site < part.movable(); }, found);
    std::erase_if(found, [&](const Brink& brink) {
      return std::find(tried.begin(), tried.end(), ends(part, brink)) != tried.end();
    });
    const auto shortest = std::min_element(found.begin(), found.end(), is_shorter);
    return shortest == found.end() ? std::nullopt : std::optional(*shortest);
  }

  Tessellation<S>& tessellation_;
  Points3& points_;
  const LocalInput& input_;
  const ShapeLimits& limits_;
  std::int64_t steps_ = 0;
  std::vector<Ends> tried_;           ///< ascending
  std::vector<std::int32_t> changed_; ///< triangles
};

} // namespace

template <Space S>
std::int64_t glide(Tessellation<S>& tessellation, Points3& points, const LocalInput& input,
                   const ShapeLimits& limits) {
  Effort effort;
  tessellation.move(points);
  tessellation.make_delaunay(effort);
  return Glide<S>(tessellation, points, input, limits).run();
}

template std::int64_t glide(Tessellation<Sphere>&, Points3&, const LocalInput&, const ShapeLimits&);
template std::int64_t glide(Tessellation<Plane>&, Points3&, const LocalInput&, const ShapeLimits&);

} // namespace calotte::cvt_detail
