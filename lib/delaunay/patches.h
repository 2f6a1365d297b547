// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/conflict_query.h"
#include "delaunay/coverage.h"

#include <vector>

/// Certificates for many triangles at once, where sites are so close together that rounding makes
/// the circumcap of each useless in doubles.
namespace calotte::delaunay_detail {

/// Certifies patches of faces that are surrounded by certified faces, if the disc around a patch
/// contains only members of the region.
///
/// The rim of a patch consists of edges of certified triangles, which no edge of the triangulation
/// of all sites crosses, and no site but members lies within. Both that triangulation and the
/// region's divide the patch, with the same sites, and each of their inner edges is locally
/// Delaunay: they are the constrained Delaunay triangulation of the patch, of which there is one
/// only, because no four sites are cocircular to the predicates (Lee and Lin, 1986). The plane of
/// the argument is the region's view; a cap that does not contain its focus is a disc there.
template <class Chart> class Patches {
public:
  Patches(Triangulation<Chart>& triangulation, const Sites& sites, const std::vector<Run>& members,
          const std::vector<HalfSpace>& covered)
      : triangulation_(triangulation), sites_(sites), members_(members), covered_(covered) {}

  /// The faces of the patch that contains a face, each marked by its number. None if the patch
  /// reaches the hull, or if a disc around it may contain a site that is not a member.
  const std::vector<FaceOf<Chart>>& around(FaceOf<Chart> face) {
    patch_.assign(1, face);
    face->number = seen;
    marked_.push_back(face);
    bool bounded = true;
    for (std::size_t f = 0; f < patch_.size(); ++f) {
      bounded = bounded && !triangulation_.is_infinite(patch_[f]);
      for (int i = 0; i < 3; ++i)
        add(patch_[f]->neighbor(i));
    }
    if (!bounded || !contains_only_members())
      patch_.clear();
    return patch_;
  }

  bool is_marked(FaceOf<Chart> face) const { return face->number == seen; }

  /// Removes all marks.
  ~Patches() {
    for (const FaceOf<Chart> face : marked_)
      face->number = -1;
  }
  Patches(const Patches&) = delete;
  Patches& operator=(const Patches&) = delete;

private:
  static constexpr std::int32_t seen = 0;

  void add(FaceOf<Chart> face) {
    if (is_marked(face) || face->certified ||
        (!triangulation_.is_infinite(face) && is_covered(face, covered_)))
      return;
    face->number = seen;
    marked_.push_back(face);
    patch_.push_back(face);
  }

  bool contains_only_members() {
    Vec3 least = patch_.front()->vertex(0)->point.unit, most = least;
    for_each_corner([&](const Vec3& x) {
      least = {std::min(least.x, x.x), std::min(least.y, x.y), std::min(least.z, x.z)};
      most = {std::max(most.x, x.x), std::max(most.y, x.y), std::max(most.z, x.z)};
    });
    centre_ = 0.5 * (least + most);
    double square = 0;
    for_each_corner(
        [&](const Vec3& x) { square = std::max(square, dot(x - centre_, x - centre_)); });
    // Rounded up by more than the errors of units and of this sum.
    radius_ = (1 + 1e-12) * std::sqrt(square) + 1e-14;
    const int top = sites_.boxes.levels() - 1;
    return is_before_focus(triangulation_.chart()) &&
           are_members_within(top, 0, sites_.boxes.nodes(top));
  }

  template <class Body> void for_each_corner(const Body& body) const {
    for (const FaceOf<Chart> face : patch_)
      for (int i = 0; i < 3; ++i)
        body(face->vertex(i)->point.unit);
  }

  bool is_before_focus(const SphereChart& chart) const {
    return !chart.view().from_centre &&
           norm(centre_ - normalised(chart.view().focus)) > 2 * radius_;
  }
  static bool is_before_focus(const PlaneChart&) { return true; }

  /// Whether all sites within the disc, of the nodes begin to end - 1 of a level, are members.
  bool are_members_within(int level, std::int64_t begin, std::int64_t end) const {
    const double most = radius_ * radius_ * (1 + 1e-12);
    for (std::int64_t i = begin; i != end; ++i) {
      const std::int64_t first = i * SiteBoxes::width, last = first + SiteBoxes::width;
      if (square_distance(sites_.boxes.box(level, i), centre_) > most ||
          are_members(members_, sites_, level, i))
        continue;
      if (level > 0) {
        if (!are_members_within(level - 1, first, std::min(last, sites_.boxes.nodes(level - 1))))
          return false;
        continue;
      }
      for (std::int64_t r = first; r != std::min(last, sites_.size()); ++r)
        if (dot(sites_.unit[r] - centre_, sites_.unit[r] - centre_) <= most &&
            !are_members(members_, r, r + 1))
          return false;
    }
    return true;
  }

  Triangulation<Chart>& triangulation_;
  const Sites& sites_;
  const std::vector<Run>& members_;
  const std::vector<HalfSpace>& covered_;
  std::vector<FaceOf<Chart>> patch_, marked_;
  Vec3 centre_{};
  double radius_ = 0; ///< a chord
};

} // namespace calotte::delaunay_detail
