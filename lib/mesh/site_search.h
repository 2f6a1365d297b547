// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "curve/box_tree.h"
#include "exact/space.h"
#include "mesh/faces.h"
#include "mesh/room.h"
#include "mesh/seen_mesh.h"
#include "mesh/triangle_grid.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace calotte::mesh_detail {

/// The sites of a mesh that are near positions: by a walk from neighbour to neighbour, and where
/// the mesh lacks neighbours by a tree of all sites, which is made once a position needs it.
///
/// It refers to what it is made from.
template <Space S> class SiteSearch {
public:
  using Position = typename S::Position;

  /// \param seen of the mesh. \param grid of the mesh.
  SiteSearch(const SeenMesh<S>& seen, const TriangleGrid<S>& grid)
      : mesh_(seen.mesh()), seen_(seen), grid_(grid), faces_(faces_of(mesh_)) {}

  /// A site, and a triangle near it.
  struct Near {
    std::int32_t site, triangle;
  };

  /// The nearest site, the lowest of those that are equally near. \param t a triangle near p.
  Near nearest(const Position& p, std::int32_t t) const {
    const End end = walk_to_nearest(p, t);
    return {!end.all   ? nearest_of_all(p)
            : end.tied ? lowest_tie(p, end.corner)
                       : site_at(faces_, end.corner),
            end.corner.triangle};
  }

  /// Fills a list with the nearest sites, by distance, equally near ones by id.
  /// \param t a triangle near p.
  /// \param list at most as long as the mesh has sites.
  /// \returns a triangle near p.
  std::int32_t nearest_few(const Position& p, std::int32_t t, std::span<std::int32_t> list) const {
    const bool copied = !mesh_.surface.period().isZero();
    const End end = copied ? End{{t, 0}, false, false} : walk_to_nearest(p, t);
    Nearest nearest(*this, p, list.size());
    if (!end.all || !visit_neighbours(p, end, nearest) || nearest.found().size() < list.size())
      consider_all(p, nearest);
    std::ranges::transform(nearest.found(), list.begin(), &Candidate::site);
    return end.corner.triangle;
  }

  /// Calls body(site) once for each site within a distance of p.
  template <class Body>
  void for_each_within(const Position& p, double distance, const Body& body) const {
    const double chord = S::on_sphere ? 2 * std::sin(distance / 2) : distance,
                 square = chord * chord, limit = beyond(p, square);
    const Vec3 seen = seen_.seen(p);
    std::vector<std::int32_t> found; // where a box has copies
    for_each_near(p, limit, [&](std::int32_t site) {
      if (square_of(p, seen, site) > square || std::ranges::find(found, site) != found.end())
        return;
      if (S::copies > 1)
        found.push_back(site);
      body(site);
    });
  }

  /// SeenMesh::has_convex_boundary(), asked once.
  bool convex() const {
    look_at_boundary();
    return convex_;
  }

private:
  /// Calls body(neighbour, corner at it) for the neighbours of a site. Returns whether these are
  /// all neighbours that it has in a triangulation of the whole space: the mesh has no boundary
  /// there.
  template <class Body> bool for_each_neighbour(Corner corner, const Body& body) const {
    const Corner last = walk_both_ways(faces_, corner, [&](Corner c) {
      body(following_site(faces_, c), Corner{c.triangle, next_vertex(c.vertex)});
    });
    if (exists(last))
      body(preceding_site(faces_, last), Corner{last.triangle, previous_vertex(last.vertex)});
    return !exists(last) || has_all_sites();
  }

  /// The end of a walk from site to site.
  struct End {
    Corner corner; ///< at a site than which none of its neighbours is nearer
    bool all;      ///< whether the mesh has all of its neighbours
    bool tied;     ///< whether some are equally near
  };

  /// Walks from site to site, each nearer than the previous one. A site of a Delaunay triangulation
  /// is the nearest if none of its neighbours is nearer.
  End walk_to_nearest(const Position& p, std::int32_t t) const {
    for (Corner here{t, 0};;) {
      Corner best = here;
      bool tied = false;
      const bool all = for_each_neighbour(here, [&](std::int32_t site, Corner corner) {
        const int order = seen_.compare(p, site, site_at(faces_, best));
        if (order < 0)
          best = corner;
        tied = tied || order == 0;
      });
      if (site_at(faces_, best) == site_at(faces_, here))
        return {here, all, tied};
      here = best;
    }
  }

  /// Adds corners at the sites that are as near as the one that is found. Their circle is empty, so
  /// that edges connect them.
  /// \returns false where the mesh lacks neighbours.
  bool add_ties(const Position& p, std::vector<Corner>& found) const {
    const std::int32_t first = site_at(faces_, found.front());
    for (std::size_t k = 0; k < found.size(); ++k) {
      const bool all = for_each_neighbour(Corner(found[k]), [&](std::int32_t site, Corner corner) {
        const bool known = std::any_of(found.begin(), found.end(),
                                       [&](Corner c) { return site_at(faces_, c) == site; });
        if (!known && seen_.compare(p, site, first) == 0)
          found.push_back(corner);
      });
      if (!all)
        return false;
    }
    return true;
  }

  /// The lowest of the equally near sites.
  std::int32_t lowest_tie(const Position& p, Corner from) const {
    std::vector<Corner> found{from};
    if (!add_ties(p, found))
      return nearest_of_all(p);
    std::int32_t lowest = site_at(faces_, from);
    for (const Corner& corner : found)
      lowest = std::min(lowest, site_at(faces_, corner));
    return lowest;
  }

  /// Calls body(site) for the sites whose boxes are nearer to p than a limit, which the body may
  /// lower, roughly from the nearest on; in a box for those of copies, too.
  template <class Body>
  void for_each_near(const Position& p, const double& limit, const Body& body) const {
    for (int k = 0; k < S::copies; ++k) {
      const Vec3 at = seen_.coordinates(seen_.copy(p, k));
      tree().visit_nearest([&](const Box3& box) { return square_from(box, at); }, limit, body);
    }
  }

  /// The square of a distance that is larger than one of some square by more than rounding.
  double beyond(const Position& p, double square) const {
    const Vec3 at = seen_.coordinates(p);
    const double size = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}),
                 reach = std::sqrt(square) * (1 + 1e-9) + 1e-14 * size + 1e-300;
    return reach * reach;
  }

  /// \param seen p, as SeenMesh::seen() gives it.
  double square_of(const Position& p, const Vec3& seen, std::int32_t site) const {
    const Vec3 apart = seen_.seen(site, p) - seen;
    return dot(apart, apart);
  }

  /// A site, and the square of its distance up to rounding.
  struct Candidate {
    double square, beyond; ///< beyond(square)
    std::int32_t site;
    Corner corner = no_corner; ///< at the site, until its neighbours have been visited
  };

  /// The nearest sites to a position, sorted: equally near ones by id.
  class Nearest {
  public:
    Nearest(const SiteSearch& in, const Position& p, std::size_t count)
        : in_(in), p_(p), seen_(in.seen_.seen(p)), count_(count) {
      found_.reserve(count + 1);
    }

    /// Sites beyond are not among the nearest.
    const double& limit() const { return limit_; }

    /// Does nothing for a site that is known.
    void consider(std::int32_t site, Corner corner = no_corner) {
      const double square = in_.square_of(p_, seen_, site);
      if (square > limit_)
        return;
      const Candidate candidate{square, in_.beyond(p_, square), site, corner};
      const auto at =
          std::upper_bound(found_.begin(), found_.end(), candidate,
                           [&](const Candidate& a, const Candidate& b) { return is_before(a, b); });
      if (at != found_.begin() && (at - 1)->site == site)
        return;
      unvisited_ = std::min(unvisited_, static_cast<std::size_t>(at - found_.begin()));
      found_.insert(at, candidate);
      if (found_.size() > count_)
        found_.pop_back();
      if (found_.size() == count_)
        limit_ = found_.back().beyond;
    }

    /// A corner at the nearest site whose neighbours have not been visited; then they have. None if
    /// there is no such site.
    Corner next() {
      while (unvisited_ < found_.size())
        if (Candidate& candidate = found_[unvisited_++]; exists(candidate.corner))
          return std::exchange(candidate.corner, no_corner);
      return no_corner;
    }

    const std::vector<Candidate>& found() const { return found_; }

  private:
    bool is_before(const Candidate& a, const Candidate& b) const {
      if (a.square > b.beyond || b.square > a.beyond)
        return a.square < b.square;
      const int order = in_.seen_.compare(p_, a.site, b.site);
      return order < 0 || (order == 0 && a.site < b.site);
    }

    const SiteSearch& in_;
    const Position& p_;
    Vec3 seen_; ///< p
    std::size_t count_;
    double limit_ = std::numeric_limits<double>::infinity();
    std::vector<Candidate> found_;
    std::size_t unvisited_ = 0; ///< the neighbours of the sites before have been visited
  };

  /// Considers the nearest sites and their neighbours, from all that are nearest on: each site that
  /// is not the nearest has a neighbour that is nearer, and so one of the list if it is. This does
  /// not hold for the nearest: an edge may lead to one only from others that the list has no room
  /// for.
  /// \returns false where the mesh lacks neighbours.
  bool visit_neighbours(const Position& p, const End& end, Nearest& nearest) const {
    nearest.consider(site_at(faces_, end.corner), end.corner);
    if (end.tied) {
      std::vector<Corner> ties{end.corner};
      if (!add_ties(p, ties))
        return false;
      for (const Corner& corner : ties)
        nearest.consider(site_at(faces_, corner), corner);
    }
    for (Corner here = nearest.next(); exists(here); here = nearest.next())
      if (!for_each_neighbour(
              here, [&](std::int32_t site, Corner corner) { nearest.consider(site, corner); }))
        return false;
    return true;
  }

  /// Considers all sites, including those without triangles.
  void consider_all(const Position& p, Nearest& nearest) const {
    for_each_near(p, nearest.limit(), [&](std::int32_t site) { nearest.consider(site); });
  }

  std::int32_t nearest_of_all(const Position& p) const {
    Nearest nearest(*this, p, 1);
    consider_all(p, nearest);
    return nearest.found().front().site;
  }

  /// Whether sites at the boundary have all neighbours that they have in a triangulation of the
  /// whole space.
  bool has_all_sites() const {
    look_at_boundary();
    return has_all_sites_;
  }

  void look_at_boundary() const {
    std::call_once(asked_, [&] {
      convex_ = seen_.has_convex_boundary();
      std::vector<std::uint8_t> seen(static_cast<std::size_t>(mesh_.points.cols()));
      for (const std::int32_t site : mesh_.triangles.reshaped())
        seen[static_cast<std::size_t>(site)] = 1;
      has_all_sites_ = convex_ && std::find(seen.begin(), seen.end(), 0) == seen.end();
    });
  }

  const BoxTree& tree() const {
    std::call_once(made_, [&] {
      const auto count = static_cast<std::size_t>(mesh_.points.cols());
      std::vector<Box3> boxes(count);
      std::vector<std::uint64_t> keys(count);
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3 x = seen_.vertex(static_cast<std::int32_t>(i));
        boxes[i] = {x, x};
        keys[i] = grid_.key_of(x);
      }
      tree_ = BoxTree(boxes, keys);
    });
    return tree_;
  }

  const Mesh& mesh_;
  const SeenMesh<S>& seen_;
  const TriangleGrid<S>& grid_;
  Faces faces_;
  mutable std::once_flag asked_;
  mutable bool convex_ = false, has_all_sites_ = false; ///< once a position is near the boundary
  mutable std::once_flag made_;
  mutable BoxTree tree_; ///< of all sites
};

} // namespace calotte::mesh_detail
