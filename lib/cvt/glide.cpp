// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/glide.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "cvt/cells.h"
#include "density/hexagons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace calotte::cvt_detail {
namespace {

/// A Delaunay edge ab that is about to flip, and the vertices c and d across from it: cd is nearly
/// Delaunay, too.
struct Brink {
  double ratio; ///< Voronoi over Delaunay edge
  std::int32_t a, b, c, d;
  std::array<std::int32_t, 2> triangles; ///< abc and bad, counter-clockwise or not
};

/// The triangles within some steps across edges, the nearer ones first.
std::vector<std::int32_t> triangles_around(const Connectivity& mesh, const Brink& brink,
                                           int steps) {
  std::vector<std::int32_t> found(brink.triangles.begin(), brink.triangles.end());
  std::ptrdiff_t before = 0, front = 0; // where the last but one step begins, and the last
  for (int step = 0; step < steps; ++step) {
    const std::ptrdiff_t end = std::ssize(found);
    for (std::ptrdiff_t k = front; k < end; ++k)
      for (int v = 0; v < 3; ++v)
        if (const std::int32_t u = mesh.neighbours(v, found[static_cast<std::size_t>(k)]); u >= 0)
          found.push_back(u);
    const auto known = found.begin() + before, fresh = found.begin() + end;
    std::sort(fresh, found.end());
    found.erase(std::unique(fresh, found.end()), found.end());
    found.erase(std::remove_if(fresh, found.end(),
                               [&](std::int32_t t) { return std::find(known, fresh, t) != fresh; }),
                found.end());
    before = std::exchange(front, end);
  }
  return found;
}

template <Space S> class Glide {
public:
  Glide(Tessellation<S>& tessellation, Points3& points, const Integrand& integrand,
        const std::vector<std::uint8_t>& fixed, const ShapeLimits& limits, Effort& effort)
      : tessellation_(tessellation), points_(points), integrand_(integrand), fixed_(fixed),
        limits_(limits), effort_(effort) {}

  /// Tries a step at some brinks that are far from each other. Returns their number.
  std::int64_t step() {
    const std::vector<Brink> chosen = distant(brinks());
    if (chosen.empty())
      return 0;
    Division all = release(chosen);
    for (const Brink& brink : chosen)
      push(brink);
    relax();
    tessellation_.resume(std::move(all));
    return std::ssize(chosen);
  }

private:
  const Connectivity& mesh() const { return tessellation_.mesh(); }
  const Cells<S>& cells() const { return tessellation_.cells(); }
  bool is_free(std::int32_t site) const {
    return site < points_.cols() && (fixed_.empty() || fixed_[static_cast<std::size_t>(site)] == 0);
  }

  bool has_centre(std::int32_t t) const {
    const auto sites = mesh().triangles.col(t);
    return cells().has_centre(sites[0], sites[1], sites[2]);
  }

  /// The cotangent of a triangle's angle at its vertex v.
  double cotangent(std::int32_t t, int v) const {
    const auto at = [&](int i) { return cells().place(mesh().triangles(i, t)); };
    const Vec3 u = cells().offset(at(v), at(next_vertex(v))),
               w = cells().offset(at(v), at(previous_vertex(v)));
    return dot(u, w) / norm(cross(u, w));
  }

  /// The shortest Voronoi edges first: an order that the triangulation alone determines.
  std::vector<Brink> brinks() const {
    const std::int64_t count = mesh().triangles.cols();
    std::vector<std::vector<Brink>> parts(static_cast<std::size_t>(block_count(count)));
    for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      for (auto t = static_cast<std::int32_t>(begin); t != end; ++t)
        for (int v = 0; v < 3; ++v)
          add_if_brink(t, v, parts[static_cast<std::size_t>(block)]);
    });
    std::vector<Brink> all;
    for (const std::vector<Brink>& part : parts)
      all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end(), [](const Brink& e, const Brink& f) {
      return std::tie(e.ratio, e.a, e.b) < std::tie(f.ratio, f.a, f.b);
    });
    return all;
  }

  /// Adds the edge across from vertex v of triangle t, if its other triangle does not.
  void add_if_brink(std::int32_t t, int v, std::vector<Brink>& out) const {
    const std::int32_t u = mesh().neighbours(v, t);
    const double here = cotangent(t, v);
    if (u < 0 || here >= std::max(limits_.least_edge, limits_.least_cotangent))
      return;
    const int w = vertex_across(mesh().neighbours, u, t);
    const double beyond = cotangent(u, w), ratio = (here + beyond) / 2;
    const bool theirs = beyond < here || (beyond == here && u < t);
    if (theirs || (ratio >= limits_.least_edge && here >= limits_.least_cotangent))
      return;
    const std::array<std::int32_t, 2> ends{mesh().triangles(next_vertex(v), t),
                                           mesh().triangles(previous_vertex(v), t)};
    const std::int32_t c = mesh().triangles(v, t), d = mesh().triangles(w, u);
    const bool free = is_free(ends[0]) && is_free(ends[1]) && is_free(c) && is_free(d);
    if (free && has_centre(t) && has_centre(u))
      out.push_back({ratio, std::min(ends[0], ends[1]), std::max(ends[0], ends[1]), c, d, {t, u}});
  }

  /// The first ones whose generators are not near those of another.
  std::vector<Brink> distant(std::vector<Brink>&& all) const {
    constexpr int apart = 3; // triangles
    std::vector<Brink> chosen;
    if (all.empty())
      return chosen;
    std::vector<std::uint8_t> taken(static_cast<std::size_t>(cells().places()), 0);
    const auto is_taken = [&](std::int32_t site) {
      return taken[static_cast<std::size_t>(site)] != 0;
    };
    for (const Brink& brink : all) {
      if (is_taken(brink.a) || is_taken(brink.b) || is_taken(brink.c) || is_taken(brink.d))
        continue;
      for (const std::int32_t t : triangles_around(mesh(), brink, apart))
        for (const std::int32_t site : mesh().triangles.col(t))
          taken[static_cast<std::size_t>(site)] = 1;
      chosen.push_back(brink);
    }
    return chosen;
  }

  /// Focuses on the generators around the brinks, which may move. Returns the division before.
  Division release(const std::vector<Brink>& chosen) {
    constexpr int reach = 12; // triangles, as wide as half as many cells
    Array<std::int32_t> owner(cells().places());
    for_each_block(owner.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      std::fill(owner.begin() + begin, owner.begin() + end, -1);
    });
    std::vector<std::vector<std::int32_t>> around(chosen.size());
    for_each_task(std::ssize(chosen), [&](std::int64_t k) {
      const auto brink = static_cast<std::size_t>(k);
      around[brink] = triangles_around(mesh(), chosen[brink], reach);
    });
    for (std::size_t k = 0; k < chosen.size(); ++k)
      for (const std::int32_t t : around[k])
        for (const std::int32_t site : mesh().triangles.col(t))
          if (is_free(site) && owner[site] < 0)
            owner[site] = static_cast<std::int32_t>(k);
    Division all = tessellation_.focus(std::move(owner), static_cast<std::int32_t>(chosen.size()));
    moving_.clear();
    begin_.clear();
    for (const std::vector<std::int32_t>& own : tessellation_.division().ownership.owned) {
      begin_.push_back(std::ssize(moving_));
      moving_.insert(moving_.end(), own.begin(), own.end());
    }
    return all;
  }

  /// Moves a and b apart, and c and d together, so that cd replaces ab.
  void push(const Brink& brink) {
    constexpr double share = 0.16; // of the width of the cells, about the length of ab over sqrt(2)
    const Vec3 ab = cells().offset(cells().place(brink.a), cells().place(brink.b)),
               cd = cells().offset(cells().place(brink.c), cells().place(brink.d));
    const double step = share / std::numbers::sqrt2 * norm(ab);
    const std::array<std::int32_t, 4> sites{brink.a, brink.b, brink.c, brink.d};
    const Vec3 apart = (1 / norm(ab)) * ab, together = (1 / norm(cd)) * cd;
    const std::array<Vec3, 4> ways{-1 * apart, apart, together, -1 * together};
    Points3 x(3, 4), d(3, 4), to(3, 4);
    for (std::size_t k = 0; k < sites.size(); ++k) {
      x.col(static_cast<Eigen::Index>(k)) = points_.col(sites[k]);
      set_column(d, static_cast<Eigen::Index>(k), ways[k]);
    }
    cells().retract(x, step, d, to);
    for (std::size_t k = 0; k < sites.size(); ++k)
      points_.col(sites[k]) = to.col(static_cast<Eigen::Index>(k));
  }

  /// Sets Lloyd's map of the moving generators. Returns the largest distance to it, in widths of
  /// the cells.
  double map(Points3& centroids) {
    std::vector<double> farthest(begin_.size(), 0);
    const auto receive = [&](const Patch& patch, const Array<Vec3>& x,
                             const Array<CellMoments>& moments) {
      const auto region = static_cast<std::size_t>(patch.region);
      farthest[region] = 0;
      for (std::int32_t i = 0; i < patch.owned; ++i) {
        const Vec3& from = Cells<S>::places_wrap
                               ? column(points_, patch.sites[static_cast<std::size_t>(i)])
                               : x[i];
        const Pull pull = Cells<S>::pull(from, moments[i]);
        const bool valid = pull.mass > 0 && moments[i].energy > 0;
        const Vec3 to = valid ? pull.centroid : from, way = to - from;
        set_column(centroids, begin_[region] + i, to);
        if (valid) // the energy of a hexagon of area A is hexagon_energy A times its mass
          farthest[region] =
              std::max(farthest[region], dot(way, way) * pull.mass / moments[i].energy);
      }
    };
    tessellation_.move(points_);
    tessellation_.integrate_repaired(
        integrand_, [](bool) {}, receive, effort_);
    return std::sqrt(density_detail::hexagon_energy *
                     *std::max_element(farthest.begin(), farthest.end()));
  }

  /// Lloyd's map with constant momentum (Nesterov, 1983) until all are near their centroids.
  void relax() {
    constexpr int most = 60;
    constexpr double near = 0.001, momentum = 0.8;
    const std::int64_t n = std::ssize(moving_);
    Points3 centroids(3, n), before, next(3, n);
    for (int k = 0; k < most; ++k) {
      const bool ended = map(centroids) <= near || k + 1 == most;
      if (before.cols() == n && !ended)
        cells().retract(centroids, momentum, centroids - before, next);
      else
        next = centroids;
      for (std::int64_t i = 0; i < n; ++i)
        points_.col(moving_[static_cast<std::size_t>(i)]) = next.col(i);
      if (ended)
        break;
      before = centroids;
    }
    tessellation_.move(points_);
    tessellation_.make_delaunay(effort_);
  }

  Tessellation<S>& tessellation_;
  Points3& points_;
  const Integrand& integrand_;
  const std::vector<std::uint8_t>& fixed_;
  const ShapeLimits& limits_;
  Effort& effort_;
  std::vector<std::int32_t> moving_; ///< the generators of all brinks of a step, by brink
  std::vector<std::int64_t> begin_;  ///< by brink: its first one there
};

} // namespace

template <Space S>
std::int64_t glide(Tessellation<S>& tessellation, Points3& points, const Integrand& integrand,
                   const std::vector<std::uint8_t>& fixed, const ShapeLimits& limits) {
  constexpr int most_rounds = 8; // a step may bring another dislocation to its brink
  Effort effort;
  tessellation.move(points);
  tessellation.make_delaunay(effort);
  Glide<S> glide(tessellation, points, integrand, fixed, limits, effort);
  std::int64_t steps = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const std::int64_t tried = glide.step();
    if (tried == 0)
      break;
    steps += tried;
  }
  return steps;
}

template std::int64_t glide(Tessellation<Sphere>&, Points3&, const Integrand&,
                            const std::vector<std::uint8_t>&, const ShapeLimits&);
template std::int64_t glide(Tessellation<Plane>&, Points3&, const Integrand&,
                            const std::vector<std::uint8_t>&, const ShapeLimits&);

} // namespace calotte::cvt_detail
